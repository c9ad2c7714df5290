// Ways between two places of a closed surface, beside CGAL's exact shortest paths.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/base/random.h"
#include "harness/path/pick.h"
#include "tests/helpers.h"
#include "tests/sewn_sheets.h"

namespace cutbench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Shortest = CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>>;

struct PlaceOnSurface {
  std::size_t triangle;
  std::array<double, 3> weights;
};

Mesh for_cgal(const MeshData& mesh) {
  Mesh result;
  for (const Point3& p : mesh.deformed) result.add_vertex({p.x, p.y, p.z});
  for (const auto& [a, b, c] : mesh.triangles)
    result.add_face(Mesh::Vertex_index(a), Mesh::Vertex_index(b), Mesh::Vertex_index(c));
  return result;
}

/// Ours over the shortest, for random pairs of places.
std::vector<double> too_long(const MeshData& raw, int pairs) {
  const Sheet sheet(unrolled(raw));
  const Picker picker(sheet);
  const Mesh surface = for_cgal(raw);
  Random random(11);
  const auto any = [&] {
    double a = random.unit(), b = random.unit();
    if (a + b > 1) {
      a = 1 - a;
      b = 1 - b;
    }
    return PlaceOnSurface{to_size(random.unit() * to_double(raw.triangles.size())), {1 - a - b, a, b}};
  };
  const auto in_space = [&](const PlaceOnSurface& place) {
    Point3 p;
    for (std::size_t k = 0; k < 3; ++k)
      p = p + place.weights[k] * raw.deformed[to_size(raw.triangles[place.triangle][k])];
    return p;
  };
  const auto on_surface = [&](const PlaceOnSurface& place) {
    // CGAL's weights begin at the source of the face's half-edge.
    const Mesh::Face_index face(to_int32(place.triangle));
    const auto first = to_int32(std::size_t{surface.source(surface.halfedge(face))});
    const auto& corners = raw.triangles[place.triangle];
    const auto k = to_size(std::find(corners.begin(), corners.end(), first) - corners.begin());
    return std::pair(face, Shortest::Barycentric_coordinates{place.weights[k], place.weights[(k + 1) % 3],
                                                             place.weights[(k + 2) % 3]});
  };
  std::vector<double> ratios;
  for (int i = 0; i < pairs; ++i) {
    const PlaceOnSurface from = any(), to = any();
    Shortest shortest(surface);
    shortest.add_source_point(on_surface(from).first, on_surface(from).second);
    const double least = shortest.shortest_distance_to_source_points(on_surface(to).first, on_surface(to).second).first;
    double ours = 0;
    const PickedCurve path{Curve::Kind::polyline, false, {{in_space(from), {}}, {in_space(to), {}}}};
    for (const Curve& curve : picker.rest_curves(path, "it"))
      for (std::size_t k = 1; k < curve.points.size(); ++k) ours += length(curve.points[k] - curve.points[k - 1]);
    ratios.push_back(ours / least);
  }
  std::sort(ratios.begin(), ratios.end());
  return ratios;
}

TEST(ShortestWay, IsHardlyLongerThanTheShortest) {
  for (const MeshData& raw : {torus(24, 12), cube(4), sphere(5)}) {
    const std::vector<double> ratios = too_long(raw, to_int(scaled(100)));
    RecordProperty(std::to_string(raw.triangles.size()) + " triangles",
                   std::to_string(ratios[ratios.size() / 2]) + " " + std::to_string(ratios[ratios.size() * 9 / 10]) +
                       " " + std::to_string(ratios.back()));
    EXPECT_GT(ratios.front(), 1 - 1e-9);
    EXPECT_LT(ratios[ratios.size() * 3 / 4], 1 + 1e-9) << raw.triangles.size();
    EXPECT_LT(ratios.back(), 1.03) << raw.triangles.size();
  }
}

}  // namespace
}  // namespace cutbench
