// The stabilisation of polygons: what a value of tau means, and that no value spoils what a virtual element promises.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "harness/fem/model/model.h"
#include "tests/constrained_cut.h"
#include "tests/fem_helpers.h"
#include "tests/helpers.h"
#include "tests/sound_polygons.h"

namespace cutbench {
namespace {

constexpr double young = 900;

/// Of the unit square: a displacement x y along x, from its middle.
double energy_of_model(double poisson, const Constraints& constraints) {
  const Sheet sheet(make_sheet("grid", 1));
  Model<2> model(sheet, {.density = 1, .stiffness = young, .poisson = poisson},
                 {.dimension = 2, .strain = Strain::linear, .bending = BendingKind::none}, {}, {});
  model.constrain(sheet, constraints);
  Field x = model.positions(sheet);
  for (Eigen::Index v = 0; v < x.size(); v += 2) x[v] += (x[v] - 0.5) * (x[v + 1] - 0.5);
  model.rotate(x);
  return model.energy(x, Field::Zero(x.size())).membrane;
}

Constraints one_square(double tau) {
  const Sheet sheet(make_sheet("grid", 1));
  std::vector<DeformedIndex> corners;
  std::vector<TriangleIndex> triangles;
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d) corners.emplace_back(DeformedIndex(d));
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) triangles.emplace_back(TriangleIndex(t));
  const auto turn = [&](DeformedIndex d) {
    const Point2 p = sheet.rest(sheet.rest_vertex(d));
    return std::atan2(p.y - 0.5, p.x - 0.5);
  };
  std::sort(corners.begin(), corners.end(), [&](DeformedIndex a, DeformedIndex b) { return turn(a) < turn(b); });
  return {.polygons = {{corners, triangles, {}, tau}}};
}

/// By hand, of plane stress: strain xx = y and 2 xy = x, so E / (2 (1 - nu^2)) (y^2 + (1 - nu) / 2 x^2) per area, with
/// the mean of x^2 a twelfth.
double energy_of_bilinear(double poisson) {
  return young / (2 * (1 - poisson * poisson)) * (1. / 12 + (1 - poisson) / 2 / 12);
}

/// By hand: strain xx = -y is that of a beam of height 1 with the curvature 1, E / 24 per length.
double energy_of_bending() { return young / 24; }

double tau_of_bilinear(double poisson) { return (1 / (1 - poisson * poisson) + 1 / (2 * (1 + poisson))) / 3; }

TEST(Stabilisation, SaysWhichElementASquareIs) {
  for (const double poisson : {0.0, 0.3, 0.45}) {
    const double tau = tau_of_bilinear(poisson);
    EXPECT_NEAR(energy_of_model(poisson, one_square(1. / 3)), energy_of_bending(), 1e-9 * young);
    EXPECT_NEAR(energy_of_model(poisson, one_square(tau)), energy_of_bilinear(poisson), 1e-9 * young);
    EXPECT_NEAR(energy_of_model(poisson, one_square(3 * tau)), energy_of_model(poisson, {}), 1e-9 * young);
  }
  EXPECT_NEAR(tau_of_bilinear(0), 0.5, 1e-15);
  EXPECT_NEAR(tau_of_bilinear(0.3), 0.4945, 1e-4);
}

/// An affine displacement leaves no force inside, and costs what its strain costs.
TEST(Stabilisation, OfAnySizePassesThePatchTest) {
  for (const double tau : {0.125, 0.5, 2.0})
    for_each_constrained_cut({{"cut_polygons:stabilisation", tau}}, 6, 1, 877, [&](const ConstrainedCut& cut) {
      for (const Polygon& polygon : cut.constraints.polygons) EXPECT_EQ(polygon.stabilisation, tau);
      Model<2> model(cut.sheet(), {.density = 1, .stiffness = young, .poisson = 0.3},
                     {.dimension = 2, .strain = Strain::linear, .bending = BendingKind::none}, {}, {});
      Model<2> of_triangles = model;
      model.constrain(cut.sheet(), cut.constraints);
      Field x = model.positions(cut.sheet());
      Eigen::Matrix2d map;
      map << 1.1, 0.2, -0.1, 0.9;
      for (Eigen::Index v = 0; v < x.size(); v += 2) x.segment<2>(v) = (map * x.segment<2>(v)).eval();
      model.rotate(x);
      of_triangles.rotate(x);
      const double energy = of_triangles.energy(x, Field::Zero(x.size())).membrane;
      EXPECT_NEAR(model.energy(x, Field::Zero(x.size())).membrane, energy, 1e-9 * energy);
    });
}

TEST(Stabilisation, AllUnknownsStayWhereNoPolygonMayHaveAVertexInside) {
  std::size_t polygons = 0;
  for_each_constrained_cut({{"cut_polygons:all_unknowns", 0.7}}, 9, 2, 877, [&](const ConstrainedCut& cut) {
    expect_sound(cut.sheet(), cut.constraints.polygons);
    polygons += cut.constraints.polygons.size();
    for (const Polygon& polygon : cut.constraints.polygons) EXPECT_TRUE(polygon.inside.empty());
  });
  EXPECT_GT(polygons, scaled(300));
}

}  // namespace
}  // namespace cutbench
