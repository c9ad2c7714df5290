// What a cut changed. The state transfer, the matrix update, the counts in every table and the undo of a failed cut
// read this log. The sheet's editing calls write it; methods do not.
#pragma once

#include <array>
#include <vector>

#include "harness/mesh/types.h"

namespace cutbench {

/// What separates the two triangles of an edge: nothing, a path that is embedded but still closed, or an opened
/// incision.
enum class EdgeMark : std::uint8_t { none, path, incision };

/// One slot of the triangle array. A freed slot has an invalid first vertex.
struct Triangle {
  std::array<VertexIndex, 3> vertex;      ///< corners, counter-clockwise in rest space
  std::array<HalfEdge, 3> opposite;       ///< of half-edge k; invalid on the border
  std::array<DeformedIndex, 3> deformed;  ///< the corner's vertex in the opened sheet
  std::array<EdgeMark, 3> mark{};         ///< of half-edge k; both half-edges of an edge agree

  bool alive() const { return vertex[0].valid(); }
};

struct EditLog {
  /// A slot as it was before its first change in this cut, with its corners' entries of Sheet::triangle_of_vertex.
  struct Touched {
    TriangleIndex slot;
    Triangle before;
    std::array<TriangleIndex, 3> vertex_triangle;
  };
  /// A vertex of the opened sheet that the cut made or moved: position = sum of weights x positions before the edit.
  struct Ancestry {
    DeformedIndex vertex;
    std::array<DeformedIndex, 3> parents;  ///< unused ones are invalid, with weight 0
    std::array<double, 3> weights;         ///< add up to 1
  };
  struct Moved {
    VertexIndex vertex;
    Point2 from;  ///< rest position before the move
  };

  /// Deformed vertex whose position a move of its rest vertex changed.
  struct Displaced {
    DeformedIndex vertex;
    Point3 from;
  };

  std::size_t triangles_before = 0, vertices_before = 0, deformed_before = 0;  ///< slots; later ones were appended
  /// Slots that existed before the cut (freed ones included), in order. Those appended by it, from triangles_before on,
  /// are not listed here: readers must look at both.
  std::vector<Touched> touched;
  std::vector<VertexIndex> new_vertices;    ///< rest vertices made, in order
  std::vector<DeformedIndex> new_deformed;  ///< deformed vertices made, in order
  std::vector<Ancestry> ancestry;           ///< deformed vertices made or moved, in order; parents come before children
  std::vector<Moved> moved;                 ///< rest vertices moved, in order
  std::vector<Displaced> displaced;         ///< deformed vertices moved with them, in order
  std::size_t flips = 0, splits = 0;       ///< calls of flip(), and of split_edge() or split_triangle(), that succeeded
  std::vector<VertexIndex> path_vertices;  ///< ends of the edges marked as path, each once; collapsed ones stay in

  void clear() {
    touched.clear();
    new_vertices.clear();
    new_deformed.clear();
    ancestry.clear();
    moved.clear();
    displaced.clear();
    path_vertices.clear();
    flips = splits = 0;
  }
};

}  // namespace cutbench
