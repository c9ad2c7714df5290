// SPDX-License-Identifier: MIT
// The interface of a cutting method.
//
// The harness traces the path, calls adapt(), embed() and improve() in this order, opens the incision, takes the times
// and undoes a cut that failed. A method only changes triangles, through the sheet's editing calls, and holds no timer,
// counter, log or file. Every function has a default; together they are the Delaunay split of the traced path.
// What few methods need has a header of its own: constraints (constraint_source.h) and programs (cut_program.h). The
// table of methods is made of rows (method_row.h).
#pragma once

#include <optional>
#include <string>

#include "harness/cut/patch.h"
#include "harness/mesh/sheet.h"
#include "harness/path/curve.h"
#include "harness/path/subdivision.h"

namespace cutbench {

class ConstraintSource;  // harness/cut/constraint_source.h
class CutProgram;        // harness/cut/cut_program.h
struct Motion;           // harness/cut/motion.h

/// What a method may tell about the cut under way; new for every cut.
struct MethodNotes {
  int recovered_segments = 0;     ///< path segments that the method's triangulation lacked, and flips brought in
  bool stopped_early = false;     ///< improve() met a limit of its own, and left the remaining triangles as they were
  bool improved_nothing = false;  ///< with stopped_early: these are all
};

class CuttingMethod {
 public:
  virtual ~CuttingMethod() = default;

  /// A reason, known before the cut, why this method can't cut this sheet: the cut is refused and nothing changed.
  virtual std::optional<std::string> why_unsupported(const Sheet&) const { return {}; }

  /// How the sheet moves, told before each cut of a moving sheet; null after it. Without it the sheet is at rest where
  /// Sheet::position() has it. The default does not look. \param motion  valid until the next call
  virtual void see(const Motion* /*motion*/) {}

  /// Changes where the path goes, before anything is divided: moves vertices of the sheet to the path, or nodes of the
  /// trace to vertices. For methods that do not promise exact_incision; the default changes nothing. On return the
  /// trace is one of the sheet as it then is. Throws CutFailed, or CutRefused.
  /// \param path  the flattened requested path that was traced, to check the movement against
  virtual void adapt(Sheet& /*sheet*/, Subdivision& /*trace*/, const Polyline& /*path*/) {}

  /// Changes the mesh so that every segment of the trace is a chain of edges marked `path`. Sheet vertices made for the
  /// nodes are entered in them (Subdivision::Node::vertex). Pieces along edges are marked by the harness afterwards.
  /// The default is embed_by_delaunay_split() (harness/cut/delaunay_split.h). Throws CutFailed, or CutRefused.
  virtual void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes);

  /// Improves the triangles round the embedded path, which is still closed. May divide a marked edge. Must not flip or
  /// remove one, or move its ends, unless the incision error stays within Promises::incision_bound.
  virtual void improve(Sheet& /*sheet*/, MethodNotes& /*notes*/) {}

  /// Itself, where it gives constraints; null: every vertex has its own unknowns.
  virtual const ConstraintSource* constraint_source() const { return nullptr; }
  /// Itself, where it is a program of its own; null: the functions above make the cut.
  virtual CutProgram* program() { return nullptr; }

 protected:
  PatchWork patch_work_;  ///< working storage of embed_patches(), kept from one cut to the next
};

}  // namespace cutbench
