// SPDX-License-Identifier: MIT
// The interface of a cutting method.
//
// The harness traces the path, calls adapt(), embed() and improve() in this order, opens the incision, takes the times
// and undoes a cut that failed. A method only changes triangles, through the sheet's editing calls, and holds no timer,
// counter, log or file. Every function has a default; together they are the Delaunay split of the traced path.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "harness/cut/patch.h"
#include "harness/mesh/constraints.h"
#include "harness/mesh/sheet.h"
#include "harness/path/curve.h"
#include "harness/path/subdivision.h"

namespace cutbench {

struct CutOptions;  // harness/cut/cut.h

/// What a method may tell about the cut under way; new for every cut.
struct MethodNotes {
  int recovered_segments = 0;  ///< path segments that the method's triangulation lacked, and flips brought in
  bool stopped_early = false;  ///< improve() met a limit of its own, and left the remaining triangles as they were
  double program_us = 0;       ///< a program of its own made the cut and took so long, by itself (harness/programs)
};

class CuttingMethod {
 public:
  virtual ~CuttingMethod() = default;

  /// A reason, known before the cut, why this method can't cut this sheet: the cut is refused and nothing changed.
  virtual std::optional<std::string> why_unsupported(const Sheet&) const { return {}; }

  /// The path as it is asked for, before it is traced: for a method that hands it on. The default does nothing.
  virtual void begin(const Curve& /*curve*/, const CutOptions& /*options*/) {}

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

  /// What constraints() may return for this method. It is asked before a cut, since not every solver supports every kind.
  enum class ConstraintKind : std::uint8_t {
    nothing,          ///< no constraints: every vertex has its own unknowns
    vertices,         ///< constraints of vertices of the sheet to triangles of the sheet
    polygons,         ///< triangles that are one element together
    phantoms,         ///< constraints to triangles with phantom nodes, which are not vertices of the sheet
    phantoms_at_rest  ///< the same, with terms in stiffness or mass that hold for a sheet at rest only
  };
  virtual ConstraintKind constraint_kind() const { return ConstraintKind::nothing; }
  /// The constraints between the vertices of a sheet that this method cut any number of times, and the polygons that it
  /// makes of triangles; none: every vertex has its own unknowns. Depends on the two sheets alone.
  /// \param before  the sheet before the first cut; no slot of it has moved since (Sheet::compact() would move them)
  virtual Constraints constraints(const Sheet& /*before*/, const Sheet& /*cut*/) const { return {}; }
  /// The same after one more cut, that of the log of `cut`. Returns all constraints, but only the new polygons: an old polygon
  /// stays unless it shares a triangle with a new one. The default returns the polygons of all cuts.
  virtual Constraints next_constraints(const Sheet& before, const Sheet& cut, const PolygonsLeft& /*left*/) const {
    return constraints(before, cut);
  }

 protected:
  PatchWork patch_work_;  ///< working storage of embed_patches(), kept from one cut to the next
};

/// The one number of a method that may be swept.
struct Parameter {
  std::string name;  ///< empty: the method has none
  double value = 0;  ///< default
  std::string meaning;
};

/// The largest incision error that a method promises: the sum of the terms, and at most the longest edge. The tolerance
/// of flattening and twice the snap distance come on top, for every method.
struct IncisionBound {
  double longest_edges = 0;     ///< times the longest rest edge of the sheet before the cut
  double chord_tolerances = 1;  ///< times the chord tolerance that the cut asks for
};

/// What a method guarantees for every cut it does not refuse. The tests hold it to that.
struct Promises {
  bool exact_incision = false;        ///< opens the traced path itself: no shortcut, no shift
  bool keeps_area = false;            ///< the rest area is unchanged
  bool conforming = false;            ///< the result is a conforming triangulation
  bool keeps_vertices = false;        ///< no vertex of the sheet moves in rest space
  IncisionBound incision_bound = {};  ///< the default is what the trace itself keeps, and so every exact incision
};

/// A row of the table of methods.
struct MethodRow {
  std::string name, summary;
  Parameter parameter;
  Promises promises;
  std::function<std::unique_ptr<CuttingMethod>(double parameter)> make;  ///< throws InputError: a value out of range
  std::string command = {};  ///< of the program that makes the cuts; empty: a class of this process
};

}  // namespace cutbench
