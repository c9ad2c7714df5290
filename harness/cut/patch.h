// One triangle of the mesh with the points and segments that a subdivision inserts into it, as a small problem of its
// own: points numbered from 0, the ring of its boundary, the segments that must become edges. Methods that work
// triangle by triangle solve patches; embed_patches() takes them from the mesh and puts the answers back.
#pragma once

#include <array>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/mesh/sheet.h"
#include "harness/path/cut_failed.h"
#include "harness/path/subdivision.h"

namespace cutbench {

struct Patch {
  TriangleIndex triangle;
  std::vector<Point2> points;         ///< 0, 1, 2: the corners; then points on the edges in ring order; then inside
  std::vector<VertexIndex> vertices;  ///< of the sheet
  std::vector<int> nodes;             ///< of the subdivision; -1 at corners that are none
  std::vector<int> ring;              ///< the points on the boundary, counter-clockwise, from corner 0
  std::vector<EdgeMark> ring_marks;   ///< of the piece from ring[i] to the next
  std::vector<int> ring_position;     ///< per point: place in the ring, -1 inside
  std::vector<int> path_order;        ///< the points but for the corners, in the order in which the path met them
  std::vector<std::array<int, 2>> segments;  ///< between points: must be edges of the answer

  std::vector<std::array<int, 3>> triangles;  ///< the answer: counter-clockwise, filling the ring

  std::size_t inside_count() const { return points.size() - ring.size(); }
  int edge_of(int point) const;  ///< the corner after which `point` comes in the ring: which edge it lies on
};

/// The half-edge from one vertex to another; none where there is no such edge, or only the other half of one on the
/// border.
HalfEdge find_half_edge(const Sheet& sheet, VertexIndex from, VertexIndex to);
/// Makes sheet vertices of the nodes that aren't yet.
void make_vertices(Sheet& sheet, Subdivision& subdivision);
/// Fills `patch` for face f. \pre make_vertices().
void make_patch(const Sheet& sheet, const Subdivision& subdivision, int f, Patch& patch);
/// The patch's triangles, checked by exact orientation, as triangles of the sheet with marks. `parent`: see Sheet.
/// Throws CutFailed where one is not positive, or a segment is not an edge.
void append_answer(const Patch& patch, int parent, std::vector<Sheet::NewTriangle>& added);
/// Marks the edges along which the path runs. \pre the subdivision is embedded.
void mark_along(Sheet& sheet, const Subdivision& subdivision);

/// The usual patch: one point on each of two edges, and nothing inside but the segment between them. It cuts off one
/// corner, the apex; what is left is the quadrilateral p, q, c, a (counter-clockwise; p on the edge a - apex, q on apex
/// - c), and the only choice is its diagonal.
struct Crossing {
  struct Corner {
    VertexIndex vertex;
    Point2 point;
  };
  HalfEdge edge;  ///< from the apex to c
  Corner apex, q, c, a, p;
  bool p_first;   ///< the path met p before q
  EdgeMark path;  ///< of the edge p - q: none where no segment joins them
};
/// False where face f is not such a patch. \pre make_vertices().
bool find_crossing(const Sheet& sheet, const Subdivision& subdivision, int f, Crossing& crossing);
/// Puts three triangles in its place, with the diagonal from p to c or from q to a. Throws CutFailed where one is not
/// positive.
void split_crossing(Sheet& sheet, const Crossing& crossing, bool diagonal_from_p);

/// Working storage of embed_patches().
struct PatchWork {
  Patch patch;
  Crossing crossing;
  std::vector<TriangleIndex> removed;
  std::vector<Sheet::NewTriangle> added;
};

/// Replaces each face of the subdivision: crossings with the diagonal that `diagonal_from_p` (Crossing -> bool)
/// chooses, all others by the answer of `solve`, which fills Patch::triangles.
template <class DiagonalFromP, class Solve>
void embed_patches(Sheet& sheet, Subdivision& subdivision, PatchWork& work, DiagonalFromP diagonal_from_p,
                   Solve solve) {
  make_vertices(sheet, subdivision);
  work.removed.clear();
  work.added.clear();
  for (int f = 0; f < to_int(subdivision.faces.size()); ++f) {
    if (find_crossing(sheet, subdivision, f, work.crossing)) {
      split_crossing(sheet, work.crossing, diagonal_from_p(work.crossing));
      continue;
    }
    make_patch(sheet, subdivision, f, work.patch);
    work.patch.triangles.clear();
    solve(work.patch);
    append_answer(work.patch, to_int(work.removed.size()), work.added);
    work.removed.push_back(subdivision.face(f).triangle);
  }
  sheet.replace_cavity(work.removed, work.added);
}

// --- moves on a patch's triangles, for methods -----------------------------------------------------------------------

/// The whole triangle, before anything is inserted.
void start_triangulation(Patch& patch);
/// Splits the triangle at the ring edge on which p lies into two. \pre p is on the ring and not inserted yet.
void insert_on_ring(Patch& patch, int p);
/// Splits the triangle that holds p into three, or, where p lies on an edge, the two there into four.
void insert_inside(Patch& patch, int p);
/// Flips edges until each segment is one; returns how many segments were missing (Sloan, Computers & Structures 47,
/// 1993). Throws CutFailed where that does not end.
int recover_segments(Patch& patch);

/// Triangle with the directed edge a -> b and the place of a in it; -1 where there is none.
struct PatchEdge {
  int triangle = -1, corner = 0;
};
PatchEdge find_edge(const Patch& patch, int a, int b);

}  // namespace cutbench
