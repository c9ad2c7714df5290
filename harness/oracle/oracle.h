// The oracle: judges a cut from the sheet before, the requested curves and the sheet after, and nothing else.
//
// It shares no code with what it judges: no header of harness/mesh or harness/cut, its own exact predicate (numbers.h),
// its own flattening, its own exact arrangement for the number of pieces.
#pragma once

#include <cstdint>
#include <limits>
#include <ostream>
#include <string>
#include <vector>

#include "harness/oracle/plane.h"

namespace cutbench::oracle {

/// What was asked, and what the method promises. Lengths in rest units.
struct Request {
  Mesh before;
  std::vector<Curve> cuts;
  /// Allowed incision error. Whatever it is (infinity: crossings only), more than the longest edge of the input fails.
  double tolerance = std::numeric_limits<double>::infinity();
  /// Points nearer than this may have been merged, so that a cut smaller than twice this asks for nothing; also the
  /// slack of every "lies on" below.
  double snap = 0;
  /// Pieces thinner than this may be missing: a curve may follow an older incision instead of running beside it.
  double thin = 0;
  bool keeps_vertices = true;  ///< the input's rest vertices are bit-equal at the same index
  bool exact_incision = true;  ///< the vertices of new opened edges lie on the path (vertex_tolerance)
  /// False: triangles may be taken out, those that the path crosses and no others (deletion.h), and the others stay as
  /// they are. That, and that the result is a manifold, is then all that is judged.
  bool keeps_area = true;
  /// Allowed distance of the vertices of new opened edges from the path, where the incision is exact. Must leave room
  /// for the flattening of Bezier curves by the code under test.
  double vertex_tolerance = std::numeric_limits<double>::infinity();
  /// How far a vertex of the result may lie from where it was computed, because its coordinates were written with few
  /// digits. Every decision stays exact for the places as they are written. The room is given to three distances alone:
  /// of a border edge from the input's border or an older incision, of the area (this times the length of the border),
  /// and of the incision from the path. No room is given to what rounding can't excuse: triangles are strictly
  /// counter-clockwise, neighbours share vertices, lips are bit-equal (equal numbers are written alike), the input's
  /// vertices, whose places are known, are bit-equal, and pieces are counted by shared edges and expected of the exact
  /// path. So with this r, right means: there are places within r of those written at which border, area and incision
  /// are what they would have to be without it.
  double rounding = 0;
};

enum class Verdict : std::uint8_t {
  ok,
  not_finite,
  bad_index,
  inverted,
  non_manifold,
  unused_vertex,
  leak,
  area,
  moved_vertex,
  wrong_pieces,
  deletion,
  incision
};
const char* name_of(Verdict verdict);
std::ostream& operator<<(std::ostream& out, Verdict verdict);

/// The verdict is that of the first problem, in this order:
///   not_finite     a rest coordinate of the result is NaN or infinite
///   bad_index      a triangle has an index out of range, or one twice
///   inverted       a triangle is not strictly counter-clockwise (exact, on the stored doubles)
///   non_manifold   a directed edge occurs twice, or a vertex joins two fans of triangles (bow-tie)
///   unused_vertex  no triangle has it (nor had in the input)
///   leak           a border edge that is neither on the input's border nor one of two lips: crack, T-junction,
///                  unsplit neighbour, missing triangle
///   area           total area changed by more than 1e-12 of it (and the rounding of points on the border)
///   moved_vertex   an input vertex is not bit-equal at its index
///   wrong_pieces   number of pieces other than that of the exact arrangement of border, incisions and path
///   deletion       a triangle is gone that the path does not cross, or there that it crosses, or new (!keeps_area)
///   incision       the opened edges and the path are too far apart, or an older incision has closed
struct Judgement {
  bool ok = true;
  Verdict verdict = Verdict::ok;
  std::vector<std::string> problems;  ///< one line each, which the name of a verdict begins; at most five per verdict
  int pieces = 0;                     ///< sets of triangles connected through shared edges
  int expected_pieces = 0;
  int least_pieces = 0, most_pieces = 0;  ///< allowed, where the number hangs on less than the tolerances
  /// Hausdorff distance between the path inside the sheet and the opened edges, both ways, sampled every 0.02 mean
  /// edges; the path is flattened to 1e-5 mean edges. Infinite where edges were opened and no path was given.
  double incision_error = 0;
  double area_change = 0;  ///< (after - before) / before
};

/// Judges `after`, whatever it holds. After not_finite, bad_index or a repeated edge the later checks make no sense and
/// are left out (numbers stay 0).
/// Precondition: the input covers no point of the plane twice, and its size is within 1e-140 .. 1e140.
/// Throws std::invalid_argument where the request itself is bad: a malformed curve, negative tolerances, an input with
/// no triangles, bad indices, inverted triangles, or that is not a manifold.
Judgement judge(const Request& request, const Mesh& after);

}  // namespace cutbench::oracle
