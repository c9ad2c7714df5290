// Sheets with seams, made from sheets without.
#pragma once

#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/mesh/check_and_repair.h"
#include "harness/mesh/families.h"
#include "harness/mesh/mesh_data.h"
#include "harness/mesh/sheet.h"
#include "harness/mesh/unroll.h"

namespace cutbench {

/// `whole`, whose rest positions are taken apart: each triangle belongs to the panel that `panel_of` says of its
/// centroid, and a panel lies turned and shifted at rest; every third one is turned over, too. In space nothing moves.
inline MeshData in_panels(const MeshData& whole, const std::function<int(Point2)>& panel_of) {
  MeshData mesh;
  std::map<std::pair<std::int32_t, int>, std::int32_t> number;
  const auto laid = [](Point2 p, int panel) {
    const double turn = 0.7 * panel, c = std::cos(turn), s = std::sin(turn), x = panel % 3 == 2 ? -p.x : p.x;
    return Point2{c * x - s * p.y + 4.0 * panel, s * x + c * p.y};
  };
  for (auto triangle : whole.triangles) {
    Point2 middle;
    for (const auto v : triangle) middle = middle + (1.0 / 3) * whole.rest[to_size(v)];
    const int panel = panel_of(middle);
    for (auto& v : triangle) {
      const auto [place, is_new] = number.try_emplace({v, panel}, to_int32(mesh.rest.size()));
      if (is_new) {
        mesh.rest.push_back(laid(whole.rest[to_size(v)], panel));
        mesh.deformed.push_back(whole.deformed[to_size(v)]);
        mesh.sewn.push_back(v);
      }
      v = place->second;
    }
    mesh.triangles.push_back(triangle);
  }
  mesh.file_vertices = mesh.sewn;
  check_and_repair(mesh, "panels");
  return mesh;
}

/// What is sewn together is one.
inline std::size_t points_in_space(const Sheet& sheet) {
  const MeshData mesh = sheet.to_mesh_data();
  return mesh.sewn.empty() ? mesh.deformed.size() : std::set(mesh.sewn.begin(), mesh.sewn.end()).size();
}

inline int in_quarters(Point2 p) { return (p.x > 0.5 ? 1 : 0) + (p.y > 0.5 ? 2 : 0); }

/// A regular grid of n x m squares, each two triangles, placed in space by `at` of (0..1, 0..1). Where u = 1 is the
/// place of u = 0, these are the same vertices.
inline MeshData surface(int n, int m, bool closed, const std::function<Point3(double, double)>& at) {
  MeshData mesh;
  const int columns = closed ? n : n + 1;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i < columns; ++i) mesh.deformed.push_back(at(to_double(i) / n, to_double(j) / m));
  const auto v = [&](int i, int j) { return to_int32(j * columns + i % columns); };
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      mesh.triangles.push_back({v(i, j), v(i + 1, j), v(i + 1, j + 1)});
      mesh.triangles.push_back({v(i, j), v(i + 1, j + 1), v(i, j + 1)});
    }
  return mesh;
}

/// Of radius 1, round the x axis.
inline MeshData tube(int round, int along, double length) {
  return surface(round, along, true, [=](double u, double v) {
    const double angle = 2 * std::acos(-1.0) * u;
    return Point3{length * v, std::cos(angle), std::sin(angle)};
  });
}

/// Of radii 1 and 0.4, round the z axis.
inline MeshData torus(int round, int along) {
  const double pi = std::acos(-1.0);
  MeshData mesh;
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < round; ++i) {
      const double u = 2 * pi * i / round, v = 2 * pi * j / along, r = 1 + 0.4 * std::cos(v);
      mesh.deformed.push_back({r * std::cos(u), r * std::sin(u), 0.4 * std::sin(v)});
    }
  const auto at = [&](int i, int j) { return to_int32((j % along) * round + i % round); };
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < round; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

/// From -1 to 1 along all axes, n x n squares a side, each two triangles.
inline MeshData cube(int n) {
  MeshData mesh;
  std::map<std::tuple<int, int, int>, std::int32_t> number;
  const auto vertex = [&](int x, int y, int z) {
    const auto [place, is_new] = number.try_emplace({x, y, z}, to_int32(mesh.deformed.size()));
    if (is_new) mesh.deformed.push_back({2.0 * x / n - 1, 2.0 * y / n - 1, 2.0 * z / n - 1});
    return place->second;
  };
  for (int side = 0; side < 6; ++side)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const auto at = [&](int a, int b) {
          const int w = side % 2 == 0 ? 0 : n;
          if (side < 2) return vertex(w, a, b);
          return side < 4 ? vertex(b, w, a) : vertex(a, b, w);
        };
        std::array<std::int32_t, 4> q{at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
        if (side % 2 == 0) std::swap(q[1], q[3]);
        mesh.triangles.push_back({q[0], q[1], q[2]});
        mesh.triangles.push_back({q[0], q[2], q[3]});
      }
  return mesh;
}

/// A cube blown up.
inline MeshData sphere(int n) {
  MeshData mesh = cube(n);
  for (Point3& p : mesh.deformed) p = (1 / length(p)) * p;
  return mesh;
}

/// Its own rest shape.
inline MeshData unrolled(MeshData mesh) {
  unroll(mesh, "it");
  check_and_repair(mesh, "it");
  return mesh;
}

/// From its tip, round the z axis.
inline MeshData cone(int round, int along) {
  const double pi = std::acos(-1.0);
  MeshData mesh = surface(round, along, true, [pi](double u, double v) {
    const double r = 0.1 + 0.9 * v;
    return Point3{r * std::cos(2 * pi * u), r * std::sin(2 * pi * u), 2 * r};
  });
  const auto tip = to_int32(mesh.deformed.size());
  mesh.deformed.push_back({0, 0, 0});
  for (int i = 0; i < round; ++i) mesh.triangles.push_back({tip, to_int32((i + 1) % round), to_int32(i)});
  return mesh;
}

}  // namespace cutbench
