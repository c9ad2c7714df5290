// CISAMR at one level: on a structured grid, near nodes move onto the path and what is still crossed is divided, in one
// pass.
//
// How it works: for sheets whose triangles are, half of them at least, halves of equal squares along the axes; others
// are refused. Where a crossing lies at up to half its edge from an end, that end moves to the nearest crossing of any
// of its edges, nearest first (methods/tools/warp.h: where the path stays within the tolerance, nothing else of it
// meets the vertex's triangles, and no aspect ratio exceeds a million); the triangles that are crossed after that are
// divided, and where the relocation left a quadrilateral ill-shaped it gets its better diagonal, until none changes.
//
// Source: Soghrati, Xiao and Nagarajan, A conforming to interface structured adaptive mesh refinement technique for
// modeling fracture problems, Computational Mechanics 59, 2017: "non-iterative", with aspect ratios below 3, also where
// cracks branch. Built from descriptions of it, the text itself was not to be had: its definition of the aspect ratio
// and its rules for the order of diagonals are unknown to us, and its first stage, the refinement of the squares along
// the interface, is left out, for that is about resolution and not about shapes. results/ has the largest longest edge
// over altitude and the largest angle; by either the bound is missed where two relocated nodes face each other.
// Promises: area, conforming; neither the exact path (between nodes it takes short cuts) nor that vertices stay.
// Fails: on any other sheet; at tips and corners of the path, which nothing moves to; beside older incisions, whose
// vertices stay.
#pragma once

#include "harness/cut/cutting_method.h"
#include "methods/tools/path_curve.h"
#include "methods/tools/reshape.h"
#include "methods/tools/warp.h"

namespace cutbench {

class Cisamr : public CuttingMethod {
 public:
  std::optional<std::string> why_unsupported(const Sheet& sheet) const override;
  void adapt(Sheet& sheet, Subdivision& trace, const Polyline& path) override;
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override;
  void improve(Sheet& sheet, MethodNotes&) override;

 private:
  Warp warp_{{.reach = 0.5, .max_aspect = 1e6}};
  PathCurve curve_;
  Reshape reshape_{{}};
};

}  // namespace cutbench
