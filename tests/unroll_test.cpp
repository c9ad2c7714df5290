// Meshes whose rest shape is the mesh itself, as it lies in space.
#include "harness/mesh/unroll.h"

#include <gtest/gtest.h>

#include <set>

#include "harness/cut/cut_all.h"
#include "harness/mesh/rest_choice.h"
#include "harness/path/pick.h"
#include "harness/simulation/simulation.h"
#include "methods/registry.h"
#include "tests/helpers.h"
#include "tests/sewn_sheets.h"

namespace cutbench {
namespace {

const double pi = std::acos(-1.0);

MeshData unrolled(MeshData mesh) {
  unroll(mesh, "it");
  check_and_repair(mesh, "it");
  return mesh;
}

MeshData cone(int round, int along) {  // from its tip
  MeshData mesh = surface(round, along, true, [](double u, double v) {
    const double r = 0.1 + 0.9 * v;
    return Point3{r * std::cos(2 * pi * u), r * std::sin(2 * pi * u), 2 * r};
  });
  const auto tip = to_int32(mesh.deformed.size());
  mesh.deformed.push_back({0, 0, 0});
  for (int i = 0; i < round; ++i) mesh.triangles.push_back({tip, to_int32((i + 1) % round), to_int32(i)});
  return mesh;
}

MeshData sphere(int n) {  // a cube's sides blown up, in triangles
  MeshData mesh;
  std::map<std::tuple<int, int, int>, std::int32_t> number;
  const auto vertex = [&](int x, int y, int z) {
    const auto [place, is_new] = number.try_emplace({x, y, z}, to_int32(mesh.deformed.size()));
    const Point3 p{2.0 * x / n - 1, 2.0 * y / n - 1, 2.0 * z / n - 1};
    if (is_new) mesh.deformed.push_back((1 / length(p)) * p);
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

/// The largest |length at rest / length in space - 1| of all sides.
double distortion(const MeshData& mesh) {
  double largest = 0;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = to_size(t[k]), b = to_size(t[(k + 1) % 3]);
      const double there = length(mesh.deformed[b] + -1.0 * mesh.deformed[a]);
      largest = std::max(largest, std::abs(length(mesh.rest[b] - mesh.rest[a]) / there - 1));
    }
  return largest;
}

PickedCurve ring(const std::function<Point3(double)>& at, int points) {
  PickedCurve curve{Curve::Kind::polyline, true, {}};
  for (int i = 0; i < points; ++i) curve.picks.push_back({at(to_double(i) / points), {}});
  return curve;
}

struct Piece {
  std::size_t count;
  std::vector<double> areas;  // in rising order
};

Piece cut(const MeshData& mesh, const PickedCurve& path, const char* method) {
  const MethodRow row = find_method(method);
  const auto tool = row.make(row.parameter.value);
  Sheet sheet(mesh);
  Locator locator(sheet);
  Cutter cutter;
  const CutRun run = cut_all(sheet, locator, cutter, Picker(sheet).rest_curves(path, "it"), *tool, {});
  EXPECT_TRUE(run.status == Status::ok || run.status == Status::deviated) << method << ": " << run.reason;
  EXPECT_TRUE(check(sheet).empty());
  const MeshData after = sheet.to_mesh_data();
  const auto piece = pieces_of(after);
  Piece result{count_pieces(sheet), {}};
  std::map<std::int32_t, double> area;
  for (std::size_t t = 0; t < piece.size(); ++t) {
    const auto& [a, b, c] = after.triangles[t];
    const auto rest = [&](std::int32_t v) { return after.rest[to_size(v)]; };
    area[piece[t]] += cross(rest(b) - rest(a), rest(c) - rest(a)) / 2;
  }
  for (const auto& [number, size] : area) result.areas.push_back(size);
  std::sort(result.areas.begin(), result.areas.end());
  return result;
}

TEST(Unroll, ATubeHasOneSeamAndItsOwnLengths) {
  const MeshData mesh = unrolled(tube(24, 7, 2));
  EXPECT_LT(distortion(mesh), 1e-12);
  EXPECT_EQ(Sheet(mesh).seams().size(), 7u);
  EXPECT_EQ(count_pieces(Sheet(mesh)), 1u);
  EXPECT_TRUE(mesh.unrolled);
}

TEST(Unroll, AConeHasOneSeamToItsTip) {
  const MeshData mesh = unrolled(cone(24, 7));
  EXPECT_LT(distortion(mesh), 1e-12);
  EXPECT_EQ(Sheet(mesh).seams().size(), 8u);
}

TEST(Unroll, ASphereKeepsItsLengthsToo) {
  const MeshData mesh = unrolled(sphere(6));
  EXPECT_LT(distortion(mesh), 1e-12);
  EXPECT_EQ(count_pieces(Sheet(mesh)), 1u);
  EXPECT_GT(Sheet(mesh).seams().size(), 100u);
}

TEST(Unroll, ABentStripIsFlat) {
  const MeshData mesh = unrolled(surface(12, 5, false, [](double u, double v) {
    return Point3{std::sin(2 * u), v, std::cos(2 * u)};
  }));
  EXPECT_LT(distortion(mesh), 1e-12);
  EXPECT_TRUE(Sheet(mesh).seams().empty());
}

TEST(Unroll, WhatIsNoSurfaceIsRefused) {
  const auto error = [](const MeshData& mesh) {
    try {
      MeshData copy = mesh;
      unroll(copy, "it");
      return std::string();
    } catch (const InputError& e) {
      return std::string(e.what());
    }
  };
  MeshData fins = tube(8, 2, 1);
  fins.deformed.push_back({0.5, 0, 3});
  fins.triangles.push_back({8, 9, to_int32(fins.deformed.size() - 1)});
  EXPECT_NE(error(fins).find("three triangles meet"), std::string::npos) << error(fins);
  MeshData flat = tube(8, 2, 1);
  flat.deformed[to_size(flat.triangles[3][1])] = flat.deformed[to_size(flat.triangles[3][0])];
  EXPECT_NE(error(flat).find("zero area in space"), std::string::npos) << error(flat);
}

TEST(Unroll, ARingRoundATubeGivesTwoPieces) {
  const MeshData mesh = unrolled(tube(24, 9, 2));
  const auto at = [](double t) {  // on the facets: between two of the 24 corners
    const double u = 24 * t, i = std::floor(u), f = u - i;
    const auto corner = [](double k) { return Point3{0.73, std::cos(2 * pi * k / 24), std::sin(2 * pi * k / 24)}; };
    return (1 - f) * corner(i) + f * corner(i + 1);
  };
  const double round = 24 * 2 * std::sin(pi / 24);
  for (const char* method : {"conventional_split", "warp_and_refine", "cgal_cdt", "bowyer_watson", "cut_polygons",
                             "split_and_tie", "virtual_node", "delaunay_refine", "longest_edge"})
    for (const int points : {5, 7, 40}) {
      const Piece pieces = cut(mesh, ring(at, points), method);
      ASSERT_EQ(pieces.count, 2u) << method << ", " << points;
      EXPECT_NEAR(pieces.areas[0], 0.73 * round, 1e-9) << method;
      EXPECT_NEAR(pieces.areas[1], 1.27 * round, 1e-9) << method;
    }
}

TEST(Unroll, ARingRoundASphereGivesTwoPieces) {
  const MeshData mesh = unrolled(sphere(6));
  PickedCurve path = ring([](double) { return Point3{}; }, 16);
  for (std::size_t i = 0; i < path.picks.size(); ++i) {  // rays from outside, at the height 0.31
    const double angle = 2 * pi * to_double(i) / to_double(path.picks.size()) + 0.1;
    const Point3 out{std::cos(angle), std::sin(angle), 0};
    path.picks[i] = {2.0 * out + Point3{0, 0, 0.31}, -1.0 * out};
  }
  for (const char* method : {"conventional_split", "cgal_cdt", "cut_polygons"}) {
    const Piece pieces = cut(mesh, path, method);
    EXPECT_EQ(pieces.count, 2u) << method;
    double all = 0;
    for (const double area : pieces.areas) all += area;
    EXPECT_NEAR(all, 4 * pi, 0.4) << method;
  }
}

TEST(Unroll, ATubeTurnedInSpaceHasNoForces) {
  Scene scene;
  scene.mesh = unrolled(tube(24, 9, 2));
  scene.physics.gravity = {};
  for (Point3& p : scene.mesh->deformed) p = {p.y + 3, 0.6 * p.z - 0.8 * p.x, 0.8 * p.z + 0.6 * p.x};
  const auto motion = Simulation::start(scene);
  const Balance balance = motion->balance();
  EXPECT_LT(balance.residual, 1e-12 * scene.material.stiffness * 2);
  EXPECT_LT(balance.energy.membrane, 1e-12 * scene.material.stiffness);
}

TEST(Unroll, WhatCurvedSheetsCanNotHaveIsSaid) {
  Scene scene;
  scene.stem = "tube";
  scene.mesh = unrolled(tube(12, 3, 1));
  const auto error = [&] {
    try {
      Simulation::start(scene);
      return std::string();
    } catch (const InputError& e) {
      return std::string(e.what());
    }
  };
  EXPECT_EQ(error(), "");
  scene.cuts.emplace_back().curve = {Curve::Kind::polyline, false, {{0, 0}, {1, 1}}};
  EXPECT_NE(error().find("places at rest mean nothing"), std::string::npos);
  scene.cuts.clear();
  scene.integrator = Integrator::symplectic_euler;
  EXPECT_NE(error().find("has seams"), std::string::npos);
  scene.integrator = Integrator::backward_euler;
  scene.physics.bending = BendingKind::patches;
  EXPECT_NE(error().find("curved at rest"), std::string::npos);
}

}  // namespace
}  // namespace cutbench
