// A trace as a graph of nodes and pieces, and the changes that methods with an inexact incision make to it: what of the
// path passes close by a vertex is contracted to that vertex, and points inside triangles are left out.
//
// Each of these is an isotopy of the path: it is refused wherever the path would touch itself, the border or an
// older incision where it did not before, or leave one that it touched. So the pieces of the sheet stay those of the
// exact path, however many there are, one after the other. Whether the path then goes to the vertex or the
// vertex is moved to the path is the caller's choice. A tip, an end of the path that touches neither the border nor an
// older incision, may go to a vertex, too, or be left out.
#pragma once

#include <array>
#include <initializer_list>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/mesh/sheet.h"
#include "harness/mesh/tolerances.h"
#include "harness/path/subdivision.h"

namespace cutbench {

/// Keeps its working storage from one use to the next.
class PathGraph {
 public:
  /// Nodes of the path on neighbouring outgoing edges of a vertex, in path order, and the nodes before and after them.
  struct Run {
    VertexIndex vertex;
    std::vector<int> nodes;
    int before = -1, after = -1;  ///< -1: the path ends with the run, on the border or an older incision
    int piece_before = -1, piece_after = -1;
  };
  /// A crossing and how near it is to the nearer end of its edge.
  struct Approach {
    int node;
    VertexIndex vertex;
    double fraction;  ///< of the edge, 0 to 0.5
  };

  /// Reads a trace. \pre the sheet is as it was traced, and stays so but for moved vertices until write().
  void read(const Sheet& sheet, const Subdivision& trace);
  /// Crossings at most `reach` of their edge away from a vertex, the nearest first; none for reach 0.
  std::vector<Approach> approaches(double reach) const;

  /// What passes `vertex` together with `node`, a crossing of one of its outgoing edges: its neighbours on the path as
  /// long as they are crossings of neighbouring outgoing edges at most `reach` of the outgoing edge away from the
  /// vertex. False where the node is gone, or the run can't be contracted:
  /// - the path has a node at the vertex already, or on an outgoing edge of the run between the vertex and a few snap
  ///   distances behind the node of the run; or the outgoing edge ends within these;
  /// - it touches an edge there without crossing it, ends there in the open, crosses itself there, or goes round the
  ///   vertex to itself;
  /// - the vertex lies on the border or an older incision, and the run does not meet that exactly once;
  /// - something lies between the old way and the new one, or the new way would run along the border or an incision.
  bool find_run(int node, VertexIndex vertex, double reach, Run& run) const;

  /// Tips inside triangles and on edges, with the vertices of that triangle or edge where its barycentric coordinate is
  /// at least 1 - `reach`: tip by tip, the nearest vertex first. The fraction is 1 less that coordinate. Without the
  /// end of a path that goes on.
  std::vector<Approach> tips(double reach, const Polyline& path) const;
  /// What passes `vertex` on the way to a tip, the tip included, which is the first or the last node of the run and has
  /// nothing on its other side. False where find_run() would be, or
  /// - the vertex lies on the border or an older incision;
  /// - the tip's triangle holds another piece of the path, or a corner of it;
  /// - nothing but a single edge between tips would be left, which would not open.
  bool find_tip_run(int tip, VertexIndex vertex, double reach, Run& run) const;
  /// Takes a tip that is at no vertex out of the path, which then ends at the node before it, at `vertex`. False where
  /// that is another place, or one at which the path does not go on, or lies on the border or an older incision, or
  /// where a single edge between tips would be left.
  bool retract(int tip, VertexIndex vertex);
  /// Nothing but the run meets the outgoing edges of its vertex or lies inside its triangles, and the nodes before and
  /// after it lie on the rim of these: the vertex may take its edges with it to a point of the run.
  bool has_star_to_itself(const Run& run) const;
  /// Makes one node, at the vertex, of the run.
  void contract(const Run& run);
  /// Takes a node inside a triangle out of the path, which goes straight on from the node before to the one after; an
  /// isotopy, too. False where the node is none of this kind, is a tip or a crossing of the path with itself, or all
  /// that lies between its tips, or something lies between the old way and the new one, or the new way runs along an
  /// edge of a sliver.
  bool straighten(int node);

  int size() const { return to_int(nodes_.size()); }  ///< nodes, those that are gone included
  Point2 point(int node) const { return at(node).place.point; }
  const Place& place(int node) const { return at(node).place; }
  /// The trace of what the graph has become, nodes in the old order.
  void write(Subdivision& trace) const;

 private:
  struct Node {
    Place place;
    int degree = 0;
    std::array<int, 2> piece{-1, -1};  // where the degree is at most 2
    bool gone = false;
  };
  struct Piece {
    int from, to;
    TriangleIndex triangle;  // that it crosses; invalid: it runs along an edge
    HalfEdge edge;
    bool gone = false;
  };

  const Node& at(int node) const { return nodes_[to_size(node)]; }
  const Piece& piece(int i) const { return pieces_[to_size(i)]; }
  void add_piece(int from, int to, TriangleIndex triangle, HalfEdge edge);
  void add_along(const Subdivision::Along& along);
  int other_end(int piece, int node) const;
  bool is_end_of(HalfEdge h, VertexIndex v) const { return sheet_->origin(h) == v || sheet_->target(h) == v; }
  double fraction_from(VertexIndex v, const Place& place) const;
  bool may_move(int node) const;
  bool is_tip(int node) const;
  bool is_on_separator(VertexIndex v) const;
  bool has_triangle_to_itself(int tip) const;
  bool collect_run(int node, VertexIndex vertex, double reach, Run& run) const;
  bool extend(int node, int piece, VertexIndex vertex, double reach, int& next) const;
  bool is_nearest(int node, VertexIndex vertex) const;
  bool is_clear(HalfEdge edge, VertexIndex from, double up_to, int except = -1) const;
  bool is_clear_between(HalfEdge edge, int a, int b) const;
  bool is_beside_flat_triangle(HalfEdge edge) const;
  double coincidence() const { return coincidence_tolerance * sheet_->snap(); }
  bool holds_node(TriangleIndex t, const std::array<Point2, 3>& part, std::initializer_list<int> but) const;
  bool sweep_is_clear(int end, int piece, int node, VertexIndex vertex) const;

  const Sheet* sheet_ = nullptr;
  const Subdivision* trace_ = nullptr;
  std::vector<Node> nodes_;
  std::vector<Piece> pieces_;
  std::vector<VertexIndex> taken_;  // vertices that runs were contracted to, sorted
};

/// The path goes through the vertex instead of every crossing at most `tolerance` of its edge from it, the nearest
/// first, together with its neighbours as near as that. Before that its tips go to vertices as near as that
/// (PathGraph::tips()). `path` is working storage.
void snap_to_vertices(const Sheet& sheet, Subdivision& trace, const Polyline& asked, double tolerance, PathGraph& path);

}  // namespace cutbench
