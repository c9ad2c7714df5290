// The sheet: one planar, welded triangulation of the rest shape, whose incision edges carry a mark, and the vertices of
// the opened, deformed sheet that its corners point to. A re-cut crosses an older incision like any other edge; the two
// lips of an incision share their rest vertices and differ in their deformed ones.
//
// Everything that changes the mesh goes through the editing calls below, and each of them keeps the log. Between two
// calls the mesh is a conforming triangulation again (check() says so); no call looks at more of the mesh than it
// edits.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/mesh/edge_table.h"
#include "harness/mesh/edit_log.h"
#include "harness/mesh/mesh_data.h"
#include "harness/mesh/seams.h"
#include "harness/mesh/types.h"

namespace cutbench {

class Sheet {
 public:
  Sheet() = default;
  /// Welds the lips of incisions (border edges with bit-equal rest ends, opposite in direction) into marked edges.
  /// Vertices that have seams are held. \pre `data` passed check_and_repair(): oriented, manifold, every triangle
  /// positive.
  explicit Sheet(const MeshData& data);
  /// The opened sheet, deformed vertices in order of their index (freed ones left out).
  MeshData to_mesh_data() const;

  // --- reading -------------------------------------------------------------------------------------------------------
  std::size_t triangle_slots() const { return triangles_.size(); }  ///< freed slots included
  std::size_t triangle_count() const { return triangles_.size() - free_triangles_.size() - freed_triangles_.size(); }
  std::size_t vertex_slots() const { return rest_.size(); }
  std::size_t vertex_count() const { return rest_.size() - free_vertices_.size() - freed_vertices_.size(); }
  std::size_t deformed_slots() const { return position_.size(); }
  std::size_t deformed_count() const { return position_.size() - free_deformed_.size() - freed_deformed_.size(); }

  const Triangle& triangle(TriangleIndex t) const { return triangles_[t()]; }
  Point2 rest(VertexIndex v) const { return rest_[v()]; }
  Point3 position(DeformedIndex d) const { return position_[d()]; }
  VertexIndex rest_vertex(DeformedIndex d) const { return vertex_of_deformed_[d()]; }
  /// Some triangle at v; invalid where v was freed.
  TriangleIndex triangle_of_vertex(VertexIndex v) const { return triangle_of_vertex_[v()]; }
  /// v is not there in `earlier`, of which this sheet is a copy that was cut: its slot may be one used before.
  bool is_newer(VertexIndex v, const Sheet& earlier) const { return born_in_[v()] > earlier.cuts_begun_; }
  std::array<Point2, 3> corners(TriangleIndex t) const;

  VertexIndex origin(HalfEdge h) const { return triangle(triangle_of(h)).vertex[corner(h)]; }
  VertexIndex target(HalfEdge h) const { return triangle(triangle_of(h)).vertex[next_corner(corner_of(h))]; }
  HalfEdge opposite(HalfEdge h) const { return triangle(triangle_of(h)).opposite[corner(h)]; }
  EdgeMark mark(HalfEdge h) const { return triangle(triangle_of(h)).mark[corner(h)]; }
  bool on_border(HalfEdge h) const { return !opposite(h).valid(); }
  /// The border, an opened incision, or a path that is embedded but still closed.
  bool separates(HalfEdge h) const { return on_border(h) || mark(h) != EdgeMark::none; }
  static HalfEdge next(HalfEdge h) { return half_edge(triangle_of(h), next_corner(corner_of(h))); }
  static HalfEdge previous(HalfEdge h) { return half_edge(triangle_of(h), previous_corner(corner_of(h))); }
  /// The next half-edge out of the same origin, counter-clockwise or clockwise; invalid past the border.
  HalfEdge next_outgoing(HalfEdge h) const { return opposite(previous(h)); }
  HalfEdge previous_outgoing(HalfEdge h) const { return on_border(h) ? HalfEdge() : next(opposite(h)); }
  /// A half-edge out of v; at a border vertex the one with the border on its right, so that next_outgoing() meets all.
  HalfEdge first_outgoing(VertexIndex v) const;

  /// Of the uncut sheet.
  std::span<const Seam> seams() const { return seams_ ? std::span<const Seam>(*seams_) : std::span<const Seam>(); }
  bool unrolled() const { return unrolled_; }  ///< MeshData::unrolled

  double mean_edge() const { return mean_edge_; }  ///< h: mean rest edge of the sheet as constructed
  double size() const { return size_; }            ///< diagonal of its rest bounding box
  /// The snap distance, the unit of the tolerances in harness/mesh/tolerances.h, rest units.
  double snap() const { return snap_; }

  // --- editing -------------------------------------------------------------------------------------------------------
  /// Forgets the log of the cut before and lets its freed slots be used again. Every cut starts with it.
  void begin_cut();
  const EditLog& log() const { return log_; }
  /// Undoes everything since begin_cut(); the sheet is bit-unchanged.
  void rollback();

  /// Makes a rest vertex at p on the edge of h (fraction `lambda` from its origin) or inside t, and its deformed
  /// vertices, one per side where the edge is an opened incision. The vertex is in no triangle until the next
  /// replace_cavity(), which must use it.
  VertexIndex new_vertex(HalfEdge h, double lambda, Point2 p);
  VertexIndex new_vertex(TriangleIndex t, Point2 p);

  struct NewTriangle {
    std::array<VertexIndex, 3> vertex;  ///< counter-clockwise
    int parent = -1;                 ///< position in `removed` of a triangle on the same side of every opened incision,
                                     ///< whose slot and corners are inherited; -1: none
    std::array<EdgeMark, 3> mark{};  ///< of edge k; ignored where the edge bounds the cavity
  };
  /// Replaces `removed` by `added`, which fill the same region. The first child of a parent keeps its slot.
  /// \pre every edge that bounds the region, or its parts where it lies on the border, is an edge of `added`.
  /// Completes the cut_off_corner() calls before it.
  void replace_cavity(std::span<const TriangleIndex> removed, std::span<const NewTriangle> added);

  /// The usual subdivision, without any search: cuts the corner at the origin of `apex` off along p - q, and splits the
  /// quadrilateral that is left by the diagonal from p or the one from q. The corner keeps the slot.
  /// \pre q is a new_vertex() on the edge of `apex`, p one on the edge before it, each the only one on its edge. Until
  /// the triangles across these edges are subdivided too, by this call or by the replace_cavity() that must follow, the
  /// mesh is not conforming.
  void cut_off_corner(HalfEdge apex, VertexIndex q, VertexIndex p, bool diagonal_from_p, EdgeMark mark);

  VertexIndex split_edge(HalfEdge h, double lambda, Point2 p);  ///< two triangles (one on the border) become four (two)
  VertexIndex split_triangle(TriangleIndex t, Point2 p);        ///< \pre p strictly inside t
  bool flip(HalfEdge h);  ///< false, unchanged: on the border, marked, or the four corners are not strictly convex
  bool move(VertexIndex v, Point2 to);  ///< false, unchanged: v is held, or a triangle at v would not stay positive
  /// Origin onto target, and out of the sheet. The origin may lie on the embedded path, where h is one of two pieces of
  /// it there: they become one, straight on from the target. False, unchanged: the origin is held, on the border, an
  /// incision or otherwise on the path, a triangle would not stay positive, or the path would close a triangle.
  bool collapse(HalfEdge h);

  /// Takes triangles out of the sheet, with what is left of their vertices. Where those that stay at a vertex are no
  /// longer one fan, each fan but the first gets a vertex of its own at the same place. An incision with nothing on its
  /// other side is border. \pre `removed` names each triangle once; no path is embedded.
  void remove(std::span<const TriangleIndex> removed);

  /// A held vertex does not move in rest space, because something is attached to it: a pin, a load, a mark of the user.
  void hold(VertexIndex v);
  bool is_held(VertexIndex v) const { return v() < held_.size() && held_[v()] != 0; }

  /// Frees a vertex that the last replace_cavity() left without triangles. \pre d was its one deformed vertex.
  void drop_vertex(VertexIndex v, DeformedIndex d) {
    free_vertex(v);
    free_deformed(d);
  }

  void set_mark(HalfEdge h, EdgeMark mark);  ///< of both half-edges; nothing on the border
  void set_deformed(TriangleIndex t, int corner, DeformedIndex d);
  DeformedIndex copy_deformed(DeformedIndex d);  ///< a new deformed vertex at the same place
  void set_position(DeformedIndex d, Point3 x) { position_[d()] = x; }

  /// Removes freed slots. Entry i of each map is the new index of slot i, invalid where it was freed.
  struct Compaction {
    std::vector<TriangleIndex> triangles;
    std::vector<VertexIndex> vertices;
    std::vector<DeformedIndex> deformed;
  };
  Compaction compact();

  void reserve(std::size_t triangles, std::size_t vertices, std::size_t deformed);

 private:
  static std::size_t corner(HalfEdge h) { return to_size(corner_of(h)); }
  Triangle& at(TriangleIndex t) { return triangles_[t()]; }
  void touch(TriangleIndex t);
  TriangleIndex new_triangle();
  VertexIndex new_rest_vertex(Point2 p);
  DeformedIndex new_deformed(VertexIndex v, const std::array<DeformedIndex, 3>& parents,
                             const std::array<double, 3>& weights);
  void free_vertex(VertexIndex v);
  void free_deformed(DeformedIndex d);
  void mend_vertex(VertexIndex v, std::span<const HalfEdge> outgoing);
  void link(HalfEdge h, HalfEdge o);
  void join_halves(VertexIndex v, HalfEdge first, HalfEdge second);
  void add_triangle(TriangleIndex slot, const NewTriangle& made, std::span<const TriangleIndex> removed);
  void link_by_vertices(HalfEdge h);
  bool was_removed(HalfEdge h) const { return work_.removed_in[triangle_of(h)()] == work_.call; }
  void put_on_path(VertexIndex v);
  void take_seams(const MeshData& data);
  DeformedIndex pending_deformed(VertexIndex v, TriangleIndex parent) const;
  DeformedIndex pending_deformed_left_of(HalfEdge rightmost) const;
  DeformedIndex old_deformed_beside(HalfEdge h, VertexIndex v, std::span<const TriangleIndex> removed) const;
  void inherit_round(HalfEdge outgoing, std::span<const TriangleIndex> removed);

  std::vector<Triangle> triangles_;
  std::vector<Point2> rest_;
  std::vector<TriangleIndex> triangle_of_vertex_;
  std::vector<std::uint32_t> born_in_;  // per vertex: the number of the cut that made it, 0: none
  std::vector<Point3> position_;
  std::vector<VertexIndex> vertex_of_deformed_;
  std::vector<std::uint8_t> held_;  // per vertex, as far as any is held
  // Free slots, and slots freed by the cut under way, which are not used again before the next one.
  std::vector<TriangleIndex> free_triangles_, freed_triangles_;
  std::vector<VertexIndex> free_vertices_, freed_vertices_;
  std::vector<DeformedIndex> free_deformed_, freed_deformed_;
  std::vector<VertexIndex> vertex_of_freed_;        // that freed_deformed_[i] belonged to
  std::shared_ptr<const std::vector<Seam>> seams_;  // null: none
  bool unrolled_ = false;
  double mean_edge_ = 0, size_ = 0, snap_ = 0;
  std::uint32_t cuts_begun_ = 0;  // never fewer, not by rollback() either
  EditLog log_;

  /// Working storage, kept between calls so that they don't allocate. No part of the value: copies start without.
  struct Work {
    Work() = default;
    Work(const Work&) {}
    Work& operator=(const Work&) { return *this; }  // epochs only grow, so old stamps stay harmless

    /// A vertex made by new_vertex() since the last replace_cavity().
    struct Pending {
      VertexIndex vertex;
      TriangleIndex left, right;  ///< right: invalid unless the vertex lies on an opened incision
      DeformedIndex at_left, at_right;
      Point2 along;                       ///< the edge it lies on, with `left` on the left; zero inside a triangle
      std::array<HalfEdge, 2> waiting{};  ///< halves of its edge, in order, whose other sides are still whole
    };
    std::vector<Pending> pending;
    std::vector<std::uint32_t> pending_of;  ///< per vertex: where in `pending` it would be
    std::vector<Triangle> old;              ///< the removed triangles
    std::vector<std::uint8_t> claimed;      ///< per removed triangle: its slot is used again
    std::vector<TriangleIndex> slot;        ///< per added triangle
    std::vector<std::uint32_t> removed_in;  ///< per slot: the call that removed it last
    std::uint32_t call = 0;
    std::vector<HalfEdge> unassigned;  ///< corners (as outgoing edges) whose deformed vertex is still to be found
    std::vector<TriangleIndex> star;   ///< of a vertex that is collapsed
    std::vector<NewTriangle> rest_of_star;
    /// What becomes of a deformed vertex when its rest vertex moves.
    struct Carried {
      EditLog::Ancestry from;
      double depth;  ///< smallest barycentric coordinate in the triangle taken: positive inside
    };
    std::vector<Carried> carried;
    EdgeTable edges;
    std::uint32_t epoch = 0;
    std::vector<std::uint32_t> touched_in;  ///< per slot: the epoch of the cut that touched it last
    std::vector<std::uint32_t> on_path_in;  ///< per vertex: the epoch of the cut whose path it was put on last
  };
  Work work_;
};

/// What is wrong with the sheet, one line each; empty when all is well. Looks at everything: for tests, and outside the
/// clock. `opened`: the log's path is opened too, so no mark `path` may be left and every fan has its own vertex.
std::vector<std::string> check(const Sheet& sheet, bool opened = true);

/// Pieces of the opened sheet: triangles connected through unmarked edges and seams. Looks at everything.
std::size_t count_pieces(const Sheet& sheet);

}  // namespace cutbench
