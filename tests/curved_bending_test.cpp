// Hinges of sheets that are curved at rest, and over seams.
#include "harness/fem/elements/curved_bending.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>

#include "harness/fem/model/model.h"
#include "harness/mesh/unroll.h"
#include "harness/path/pick.h"
#include "tests/bending_helpers.h"
#include "tests/fem_helpers.h"
#include "tests/helpers.h"
#include "tests/sewn_sheets.h"

namespace cutbench {
namespace {

const double pi = std::acos(-1.0);

Sheet unrolled_sheet(const MeshData& mesh) { return Sheet(unrolled(mesh)); }

/// A strip round a cylinder, half as wide as it is long, of area 2 for any radius.
MeshData strip(int n, double radius) {
  return surface(n, n / 2, false, [=](double u, double v) {
    return Point3{radius * std::sin((2 * u - 1) / radius), v, radius * (std::cos((2 * u - 1) / radius) - 1)};
  });
}

MeshData half_sphere(int n) {
  return surface(n, n, false, [](double u, double v) {
    const double x = 1.6 * u - 0.8, y = 1.6 * v - 0.8, r = std::sqrt(1 + x * x + y * y);
    return Point3{x / r, y / r, 1 / r};
  });
}

Model<3> model_of(const Sheet& sheet, double bending = 0.1) {
  return {sheet, {.stiffness = 100, .bending = bending}, {.bending = BendingKind::hinges, .gravity = {}}, {}, {}};
}

Field places(const MeshData& mesh) {
  Field x(3 * to_index(mesh.deformed.size()));
  for (std::size_t v = 0; v < mesh.deformed.size(); ++v)
    x.segment<3>(3 * to_index(v)) = Eigen::Vector3d(mesh.deformed[v].x, mesh.deformed[v].y, mesh.deformed[v].z);
  return x;
}

Field force(Model<3>& model, const Field& x) {
  Field f = Field::Zero(x.size());
  model.rotate(x);
  model.add_internal_force(x, f);
  return f;
}

Energy energy(Model<3>& model, const Field& x) {
  model.rotate(x);
  return model.energy(x, Field::Zero(x.size()));
}

Field noise(Eigen::Index size, double scale) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-scale, scale);
  Field x(size);
  for (double& value : x) value = number(random);
  return x;
}

const std::vector<Sheet>& sheets() {
  static const std::vector<Sheet> all{unrolled_sheet(strip(12, 1)), unrolled_sheet(tube(12, 5, 2)),
                                      unrolled_sheet(half_sphere(6))};
  return all;
}

TEST(CurvedBending, RigidMotionHasNoForce) {
  for (const Sheet& sheet : sheets()) {
    Model<3> model = model_of(sheet);
    const Field rest = model.positions(sheet);
    const Eigen::Matrix3d turn = Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix();
    Field x = rest;
    for (Eigen::Index i = 0; i < x.size(); i += 3)
      x.segment<3>(i) = turn * rest.segment<3>(i) + Eigen::Vector3d(3, 1, 2);
    EXPECT_LT(force(model, x).lpNorm<Eigen::Infinity>(), 1e-12 * 100 * 2);
    EXPECT_LT(energy(model, x).bending, 1e-12);
  }
}

TEST(CurvedBending, ForceIsTheSlopeOfTheEnergy) {
  for (const Sheet& sheet : sheets()) {
    Model<3> model = model_of(sheet);
    const Field x = model.positions(sheet) + noise(3 * to_index(sheet.deformed_slots()), 0.02);
    const Field way = noise(x.size(), 1) + 0.3 * x, f = force(model, x);
    const double h = 1e-6;
    const double slope = (energy(model, x + h * way).total() - energy(model, x - h * way).total()) / (2 * h);
    EXPECT_NEAR(slope, -f.dot(way), 1e-7 * f.norm() * way.norm());
    for (int axis = 0; axis < 3; ++axis) {  // no force and no torque on the whole
      double sum = 0, torque = 0;
      for (Eigen::Index i = 0; i < x.size(); i += 3) {
        sum += f[i + axis];
        torque += x.segment<3>(i).cross(f.segment<3>(i))[axis];
      }
      EXPECT_NEAR(sum, 0, 1e-11 * f.norm());
      EXPECT_NEAR(torque, 0, 1e-11 * f.norm());
    }
  }
}

TEST(CurvedBending, TheTangentIsThatOfTheForceAtRest) {
  for (const Sheet& sheet : sheets()) {
    Model<3> model = model_of(sheet);
    const Field x = model.positions(sheet), way = noise(x.size(), 1);
    const double h = 1e-6;
    const Field by_forces = (force(model, x - h * way) - force(model, x + h * way)) / (2 * h);
    model.rotate(x);
    model.assemble(0, 1);
    Field by_matrix = Field::Zero(x.size());
    model.system().add_product(way, by_matrix);
    EXPECT_LT((by_forces - by_matrix).norm(), 1e-6 * by_matrix.norm());
  }
}

/// Opening an arc costs what bending a flat strip by the difference of the curvatures does: D/2 (1/r - 1/R)^2 an area.
TEST(CurvedBending, AnArcIsOpenedAtTheCostOfItsChangeOfCurvature) {
  std::vector<double> error;
  for (const int n : {10, 20, 40}) {
    Model<3> arc = model_of(unrolled_sheet(strip(n, 1))), flat = model_of(unrolled_sheet(strip(n, 1e6)));
    const double opened = energy(arc, places(strip(n, 2))).bending;
    const double bent = energy(flat, places(strip(n, 2))).bending;
    error.push_back(std::abs(opened / bent - 1));
    EXPECT_NEAR(energy(arc, places(strip(n, 1e6))).bending / bent, 4, 0.3);
  }
  EXPECT_LT(error[2], 0.01);
  EXPECT_LT(error[2], error[0] / 8);  // second order
}

TEST(CurvedBending, HingesGoOverSeams) {
  for (const char* family : {"grid", "delaunay"}) {
    const MeshData whole = make_sheet(family, 12);
    const Sheet one(whole), sewn(in_panels(whole, in_quarters));
    ASSERT_FALSE(sewn.seams().empty());
    const auto height = [](Point3 p) { return std::sin(3 * p.x) * std::cos(2 * p.y); };
    const auto energy_of = [&](const Sheet& sheet) {
      Field z(to_index(sheet.deformed_slots()));
      for (std::size_t v = 0; v < sheet.deformed_slots(); ++v)
        z[to_index(v)] = height(sheet.position(DeformedIndex(v)));
      return hinges(sheet).energy(z, 1);
    };
    EXPECT_NEAR(energy_of(sewn) / energy_of(one), 1, 1e-12) << family;
  }
}

/// A cut sheet's hinges are those of a new model, and at rest nothing pulls where edges and their chords are kept.
TEST(CurvedBending, FollowsCuts) {
  PickedCurve ring{Curve::Kind::polyline, true, {}};
  for (int i = 0; i < 40; ++i) {  // rays from outside
    const Point3 out{0, std::cos(pi * i / 20), std::sin(pi * i / 20)};
    ring.picks.push_back({Point3{0.73, 0, 0} + 2.0 * out, -1.0 * out});
  }
  for (const char* method :
       {"conventional_split", "warp_and_refine", "cgal_cdt", "bowyer_watson", "element_deletion"}) {
    const Sheet uncut = unrolled_sheet(tube(24, 9, 2));
    Body<3> body(uncut.to_mesh_data(), {.stiffness = 1000, .bending = 0.1},
                 {.bending = BendingKind::hinges, .gravity = {}});
    for (const Curve& curve : Picker(uncut).rest_curves(ring, "ring")) body.cut(curve, method);
    ASSERT_EQ(count_pieces(body.sheet), 2u) << method;
    Model<3> fresh = body.fresh_model();
    const Field rest = fresh.positions(body.sheet), x = rest + noise(rest.size(), 0.01);
    EXPECT_LT((force(body.model, x) - force(fresh, x)).norm(), 1e-12 * force(fresh, x).norm()) << method;
    EXPECT_NEAR(energy(body.model, x).bending / energy(fresh, x).bending, 1, 1e-12) << method;
    for (Model<3>* const model : {&body.model, &fresh}) model->assemble(0, 1);
    Field product = Field::Zero(x.size()), fresh_product = product;
    body.model.system().add_product(x, product);
    fresh.system().add_product(x, fresh_product);
    EXPECT_LT((product - fresh_product).norm(), 1e-12 * product.norm()) << method;
    if (std::string(method) == "conventional_split") {
      EXPECT_LT(force(body.model, rest).lpNorm<Eigen::Infinity>(), 1e-12 * 1000 * 2);
    }
  }
}

/// Seams that it does not touch are left alone.
TEST(CurvedBending, ASmallCutRebuildsWhatIsNearIt) {
  Sheet sheet = unrolled_sheet(tube(24, 20, 4));
  Bending bending(sheet, BendingKind::hinges, 0.1, 0.3);
  ASSERT_EQ(bending.rebuilt().size(), sheet.triangle_slots());
  PickedCurve slit{Curve::Kind::polyline, false, {}};
  for (const double x : {2.07, 2.21}) slit.picks.push_back({{x, 0, 0}, Point3{0, -std::cos(0.1), -std::sin(0.1)}});
  const auto curves = Picker(sheet).rest_curves(slit, "slit");
  ASSERT_EQ(curves.size(), 1u);
  Locator locator(sheet);
  const auto method = find_method("conventional_split").make(0);
  ASSERT_EQ(Cutter().cut(sheet, locator, curves.front(), *method, {}).status, Status::ok);
  bending.update(sheet);
  EXPECT_GT(bending.rebuilt().size(), 4u);
  EXPECT_LT(bending.rebuilt().size(), 60u);
}
}  // namespace
}  // namespace cutbench
