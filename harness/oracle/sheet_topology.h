// Neighbours, fans, pieces and borders of an opened sheet, from its triangle list alone.
//
// Half-edge 3 t + k runs from corner k to corner k + 1 (mod 3) of triangle t.
#pragma once

#include <vector>

#include "harness/oracle/plane.h"

namespace cutbench::oracle {

/// Round the triangle.
inline int next(int half_edge) { return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1; }
inline int previous(int half_edge) { return half_edge % 3 == 0 ? half_edge + 2 : half_edge - 1; }

struct HalfEdges {
  std::vector<int> opposite;  ///< #3T; -1 on a border
  std::vector<int> repeated;  ///< half-edges whose directed edge some other triangle has too: not a manifold
};

/// Border half-edges, sorted by what they are in rest space.
struct Borders {
  std::vector<int> single;               ///< no other border half-edge has the same two rest points
  std::vector<std::array<int, 2>> lips;  ///< exactly two, in opposite directions: the lips of an incision
  std::vector<int> ambiguous;            ///< more than two, or two in the same direction
};

/// Precondition (of all below too): indices in range, no triangle repeats one.
HalfEdges half_edges(const Mesh& mesh);

/// Vertices with more than one fan of triangles (bow-ties). Precondition: nothing is repeated.
std::vector<int> bow_ties(const Mesh& mesh, const HalfEdges& edges);

/// Vertices that no triangle has.
std::vector<int> unused_vertices(const Mesh& mesh);

/// For each triangle the number of its piece, a set connected through shared edges; from 0 on without gaps.
std::vector<int> pieces_of_triangles(const HalfEdges& edges);

Borders borders(const Mesh& mesh, const HalfEdges& edges);

/// Rest segment of a half-edge, start first.
Segment segment(const Mesh& mesh, int half_edge);

struct EdgeLengths {
  double mean = 0, longest = 0;  ///< rest units, over undirected edges
};
EdgeLengths edge_lengths(const Mesh& mesh, const HalfEdges& edges);

}  // namespace cutbench::oracle
