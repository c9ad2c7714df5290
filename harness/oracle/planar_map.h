// The exact arrangement of segments: where they cut the plane into faces.
//
// CGAL's Arrangement_2 gives the same (tests/planar_map_test.cpp) and takes some twenty times as long, which was two
// thirds of the time of judging a cut.
#pragma once

#include <cstddef>
#include <vector>

#include "harness/oracle/plane.h"

namespace cutbench::oracle {

/// All decisions are made on the exact points of intersection, which are rational numbers.
struct PlanarMap {
  struct Edge {
    std::vector<int> segments;  ///< those that it is a part of, in rising order
    int left = 0, right = 0;    ///< faces
    Segment ends = {};          ///< rounded, from left to right, or upwards
  };
  /// A connected part of the plane without the segments; holes are cut out of it.
  struct Face {
    double area = 0;       ///< infinite faces: that of their holes, negative
    double perimeter = 0;  ///< an edge with the face on both sides counts twice
  };
  std::vector<Edge> edges;
  std::vector<Face> faces;  ///< the first one is the infinite one
  int vertices = 0;
};

/// Segments may cross, touch and overlap in any way; those without length are left out.
PlanarMap planar_map(const std::vector<Segment>& segments);

/// For each face whether it lies inside the sheet, whose border the first segments are: where a walk from the infinite
/// face has crossed an odd number of them.
std::vector<char> inside_faces(const PlanarMap& map, std::size_t border_count);

}  // namespace cutbench::oracle
