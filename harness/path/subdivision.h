// What is to be inserted into the rest mesh, sorted by triangle: points that will become vertices, and straight
// segments that will become edges. A trace makes one of a path; a refinement makes one of midpoints. Nothing of the
// mesh is changed by it.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/mesh/sheet.h"
#include "harness/mesh/stamped_table.h"
#include "harness/path/walk.h"

namespace cutbench {

/// The first half-edge of an edge, that the nodes on it are ordered along: the one with the smaller number.
inline HalfEdge first_half_edge(const Sheet& sheet, HalfEdge h) {
  const HalfEdge o = sheet.opposite(h);
  return o.valid() && o < h ? o : h;
}

/// Keeps its storage from one use to the next.
class Subdivision {
 public:
  struct Node {
    Place place;  ///< a vertex of the mesh, or a point on an edge or inside a triangle; edges by their first half
    VertexIndex vertex;  ///< of the sheet, once it is one
    int next = -1;       ///< next node on the same edge (in its order) or inside the same triangle
  };
  /// A straight piece across a triangle, from node to node.
  struct Segment {
    int from, to;
    int next = -1;  ///< next segment of the same triangle
  };
  /// A piece along an edge of the mesh, which needs no new edge but has others' nodes on it, perhaps.
  struct Along {
    int from, to;
    HalfEdge edge;  ///< its first half
  };
  /// A triangle with a node on its edges or inside it.
  struct Face {
    TriangleIndex triangle;
    std::array<int, 3> on_edge{-1, -1, -1};  ///< first node on edge k
    int inside = -1;                         ///< first node inside
    int segments = -1;                       ///< first segment
    int edge_nodes = 0;                      ///< on its three edges together
  };

  std::vector<Node> nodes;
  std::vector<Segment> segments;  ///< those that count are in the faces' lists; others were replaced
  std::vector<Along> along;
  std::vector<Face> faces;
  /// Of a trace: how far the path may be from its chords, rest units. Methods that change the path keep to it
  /// once more.
  double chord_tolerance = std::numeric_limits<double>::infinity();

  /// Empties it, but for the tolerance. The sheet must stay as it is until the next reset().
  void reset(const Sheet& sheet);

  int face_of(TriangleIndex t);
  bool has_face(TriangleIndex t) const { return face_of_.holds(t); }
  /// The face of t, -1 where there is none.
  int find_face(TriangleIndex t) const { return face_of_.get(t, -1); }
  /// The node at a place; one that lies within the snap distance on the same edge or in the same triangle is taken for
  /// it.
  int node_of(const Place& place) { return node_of(place, sheet_->snap()); }
  /// A node of its own at a place inside an edge or a triangle, however near the others are. \pre none is at that
  /// point.
  int add_node(const Place& place) { return node_of(place, -1); }
  void add_segment(int face, int from, int to);
  void add_along(int from, int to, HalfEdge edge);
  /// The first node on an edge, given by its first half; -1 where there is none.
  int first_on(HalfEdge first) const;
  /// The nodes of a piece along an edge from end to end, by way of those of others in between.
  std::vector<int> nodes_along(const Along& piece) const;
  /// The node at v, -1 where there is none.
  int node_at(VertexIndex v) const { return node_at_.get(v, -1); }

  const Node& node(int i) const { return nodes[to_size(i)]; }
  const Face& face(int i) const { return faces[to_size(i)]; }
  const Segment& segment(int i) const { return segments[to_size(i)]; }
  Face& face(int i) { return faces[to_size(i)]; }

  /// Triangles whose interior a segment crosses: for a trace, the unit of geometric cost.
  std::size_t crossed_triangles() const;

 private:
  int node_of(const Place& place, double merging_distance);
  int node_on_edge(Place place, double merging_distance);
  int node_inside(const Place& place, double merging_distance);

  const Sheet* sheet_ = nullptr;
  StampedTable<TriangleIndex, int> face_of_;
  StampedTable<VertexIndex, int> node_at_;
};

}  // namespace cutbench
