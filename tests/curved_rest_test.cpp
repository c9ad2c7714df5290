// Sheets that are at rest as they lie in space: what they hold there, moved, stretched and cut.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "harness/mesh/families.h"
#include "harness/path/pick.h"
#include "harness/simulation/moving_sheet.h"
#include "harness/simulation/simulation.h"
#include "methods/registry.h"
#include "tests/helpers.h"
#include "tests/sewn_sheets.h"

namespace cutbench {
namespace {

const double pi = std::acos(-1.0);

/// With its vertices, which are at rest, put elsewhere.
Balance balance_at(const MeshData& mesh, const std::function<Point3(Point3)>& to) {
  Scene scene;
  scene.mesh.emplace(mesh);
  scene.physics.gravity = {};
  MovingSheet<3> moving(scene);
  for (Eigen::Index i = 0; i < moving.state.x.size(); i += 3) {
    const Point3 p = to({moving.state.x[i], moving.state.x[i + 1], moving.state.x[i + 2]});
    moving.state.x.segment<3>(i) << p.x, p.y, p.z;
  }
  return moving.balance();
}

TEST(CurvedRest, ATubeTurnedInSpaceHasNoForces) {
  const Balance balance = balance_at(unrolled(tube(24, 9, 2)), [](Point3 p) {
    return Point3{p.y + 3, 0.6 * p.z - 0.8 * p.x, 0.8 * p.z + 0.6 * p.x};
  });
  const double stiffness = Scene().material.stiffness;
  EXPECT_LT(balance.residual, 1e-12 * stiffness * 2);
  EXPECT_LT(balance.energy.membrane, 1e-12 * stiffness);
}

/// A tube and a dome that are blown up evenly hold what flat sheets of their area do, stretched by as much.
TEST(CurvedRest, AnEvenStretchCostsWhatItDoesInThePlane) {
  const auto energy_per_area = [&](const MeshData& mesh) {
    double area = 0;
    for (const auto& [a, b, c] : mesh.triangles) {
      const auto rest = [&](std::int32_t v) { return mesh.rest[to_size(v)]; };
      area += cross(rest(b) - rest(a), rest(c) - rest(a)) / 2;
    }
    return balance_at(mesh, [](Point3 p) { return 1.03 * p; }).energy.membrane / area;
  };
  const double flat = energy_per_area(make_sheet("delaunay", 8));
  EXPECT_NEAR(energy_per_area(unrolled(tube(24, 9, 2))) / flat, 1, 1e-12);
  EXPECT_NEAR(energy_per_area(unrolled(sphere(6))) / flat, 1, 1e-12);
}

/// By no method: triangles over creases, where it moved vertices or swapped edges, are at rest as they lie in space.
TEST(CurvedRest, ACutAtRestStoresNoEnergy) {
  const auto path_round = [](const std::function<Pick(double, double)>& ray) {
    PickedCurve path{Curve::Kind::polyline, true, {}};
    for (int i = 0; i < 7; ++i) path.picks.push_back(ray(std::cos(2 * pi * i / 7), std::sin(2 * pi * i / 7)));
    return path;
  };
  const PickedCurve round_x = path_round([](double c, double s) {
    return Pick{{0.9 + 0.2 * c, 0, 0}, Point3{0, c, s}};
  });
  const PickedCurve round_z = path_round([](double c, double s) {
    return Pick{{0, 0, 0.9 + 0.2 * c}, Point3{c, s, 0}};
  });
  const PickedCurve round_sphere = path_round([](double c, double s) { return Pick{{0, 0, 0.31}, Point3{c, s, 0}}; });
  std::size_t made = 0;
  MeshData in_a_file = cone(24, 7);  // of few digits: the two sides of its seam differ by as much in the plane
  for (Point3& p : in_a_file.deformed)
    p = {1e-6 * std::round(1e6 * p.x), 1e-6 * std::round(1e6 * p.y), 1e-6 * std::round(1e6 * p.z)};
  for (const auto& [raw, path] : {std::pair{tube(24, 9, 2), round_x}, std::pair{cone(24, 7), round_z},
                                  std::pair{in_a_file, round_z}, std::pair{sphere(6), round_sphere}})
    for (const MethodRow& row : all_methods()) {
      Scene scene;
      scene.mesh.emplace(unrolled(raw));
      scene.physics.gravity = {};
      scene.physics.bending = BendingKind::hinges;
      const auto motion = Simulation::start(scene);
      motion->watch();
      const auto tool = row.make(row.parameter.value);
      const std::vector<Curve> curves = Picker(motion->posed_sheet()).rest_curves(path, "it");
      if (motion->cut_now(curves, *tool).cut.status == Status::refused) continue;
      ++made;
      const Energy energy = motion->balance().energy;
      EXPECT_LT(energy.membrane, 1e-12 * scene.material.stiffness) << row.name << ", " << raw.triangles.size();
      EXPECT_LT(energy.bending, 1e-12 * scene.material.stiffness) << row.name << ", " << raw.triangles.size();
      motion->step();
      EXPECT_EQ(motion->outcome().verdict, Verdict::ok) << motion->outcome().text() << ", " << row.name;
    }
  EXPECT_GT(made, 4 * 10u);
}

TEST(CurvedRest, WhatCurvedSheetsCanNotHaveIsSaid) {
  Scene scene;
  scene.stem = "tube";
  scene.mesh.emplace(unrolled(tube(12, 3, 1)));
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
