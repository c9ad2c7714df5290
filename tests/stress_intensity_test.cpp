// K from fields that are known exactly and from computed ones: the extractor's own error, and that it does not depend
// on where it looks, on straight cuts and on arcs.

#include "harness/problems/common/stress_intensity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

#include "harness/base/conversions.h"
#include "harness/mesh/families.h"
#include "harness/problems/common/quadrature.h"
#include "harness/problems/in_plane/static_solve.h"
#include "tests/truth_helpers.h"

namespace cutbench {
namespace {

using Eigen::Matrix2d;

/// Integral of 1/r over a square with the tip anywhere: by its potential, sum over the sides.
TEST(Quadrature, OfASingularity) {
  for (const Point2 tip : {Point2{0.2, 0.3}, Point2{0, 0}, Point2{0.5, 0}, Point2{0.5, 1e-6}, Point2{-0.1, 0.4}}) {
    double sum = 0, exact = 0;
    const std::array<Point2, 4> c{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    for (const auto& triangle : {std::array{c[0], c[1], c[2]}, std::array{c[0], c[2], c[3]}})
      integrate(triangle, {&tip, 1}, 1,
                [&](Point2 p, double weight) { sum += weight / std::sqrt(squared_length(p - tip)); });
    for (std::size_t k = 0; k < 4; ++k) {
      const Point2 a = c[k] - tip, b = c[(k + 1) % 4] - tip, along = b - a;
      const double height = cross(a, b) / std::sqrt(squared_length(along));
      if (height == 0) continue;
      const double s = dot(a, along) / std::sqrt(squared_length(along)),
                   t = dot(b, along) / std::sqrt(squared_length(along));
      exact += height * (std::asinh(t / std::abs(height)) - std::asinh(s / std::abs(height)));
    }
    EXPECT_NEAR(sum, exact, 1e-3 * exact) << tip.x << ' ' << tip.y;
  }
}

constexpr Elastic rubber{.young = 7, .poisson = 0.3};

/// The exact field, known at the vertices of the opened sheet alone. Those nearly on an arc (of this radius round the
/// field's origin) are taken for points of it: chords are what a mesh has of it.
Field at_vertices(const ElasticField& field, const Sheet& sheet, double radius = 0) {
  const auto place = [&](Point2 p) {
    const Complex z = field.frame().to_local(p);
    return std::abs(std::abs(z) - radius) < 1e-4 ? field.frame().to_rest(radius * z / std::abs(z)) : p;
  };
  Field displacement = Field::Zero(to_index(2 * sheet.deformed_slots()));
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
    const auto corners = sheet.corners(TriangleIndex(t));
    const Point2 inside = 1.0 / 3 * (corners[0] + corners[1] + corners[2]);
    for (std::size_t k = 0; k < 3; ++k)
      displacement.segment<2>(2 * sheet.triangle(TriangleIndex(t)).deformed[k].value) =
          field.displacement(place(corners[k]), inside);
  }
  return displacement;
}

/// What the extractor makes of the exact field, known at the vertices alone: its own error, far below that of a
/// solution.
TEST(StressIntensity, OfTheExactFieldAtTheVertices) {
  for (const std::string family : {"grid", "delaunay"})
    for (std::size_t index = 0; index < 2; ++index) {
      const Specimen specimen = find_problem("williams_mode_1").specimen(family, 40, 1, index);
      const Sheet sheet = cut_by(specimen, "conventional_split");
      const ElasticField field = williams_field(rubber, {specimen.origin, specimen.angle}, {1.3, 0.8});
      const Field displacement = at_vertices(field, sheet);
      const Tip tip{specimen.origin, specimen.angle};
      const ElementTable elements(sheet);
      const auto [k1, k2] =
          InteractionIntegral(sheet, elements, rubber, tip, williams_modes(rubber, tip)).of(elements, displacement);
      std::cout << family << ' ' << index << ": extractor's own error " << k1 / 1.3 - 1 << ' ' << k2 / 0.8 - 1 << '\n';
      EXPECT_NEAR(k1, 1.3, 5e-3 * 1.3);
      EXPECT_NEAR(k2, 0.8, 5e-3 * 0.8);
    }
}

TEST(StressIntensity, DoesNotDependOnTheRing) {
  const Specimen specimen = find_problem("williams_mode_1").specimen("delaunay", 60, 1, 1);
  const Sheet sheet = cut_by(specimen, "cgal_cdt");
  const ElasticField field = williams_field(rubber, {specimen.origin, specimen.angle}, {1, 0.5});
  StaticSolve solve(sheet, rubber);
  solve.hold_border([&](Point2 p, Point2 inside) { return field.displacement(p, inside); });
  const Field u = solve.solve({}).displacement;
  const Tip tip{specimen.origin, specimen.angle};
  const StressIntensity usual =
      InteractionIntegral(sheet, solve.elements(), rubber, tip, williams_modes(rubber, tip)).of(solve.elements(), u);
  for (const Ring ring : {Ring{0.06, 0.15}, Ring{0.1, 0.25}, Ring{0.2, 0.4}}) {
    const StressIntensity k =
        InteractionIntegral(sheet, solve.elements(), rubber, tip, williams_modes(rubber, tip), ring)
            .of(solve.elements(), u);
    std::cout << ring.inner << " to " << ring.outer << ": " << k.k1 / usual.k1 - 1 << ' ' << k.k2 / usual.k2 - 1
              << '\n';
    EXPECT_NEAR(k.k1, usual.k1, 2e-3 * usual.k1);
    EXPECT_NEAR(k.k2, usual.k2, 2e-3 * usual.k2);
  }
}

/// An arc of radius 0.25 and half-angle 45 degrees in the sheet, under any stress: the end at +45 degrees, and the
/// modes of other stresses.
struct ArcInSheet {
  static constexpr double half = std::numbers::pi / 4;
  inline static const double radius = 0.2 / std::sin(half);
  Axes frame;
  ElasticField field;
  Tip tip;
  std::array<Mode, 2> modes;
  StressIntensity k;

  explicit ArcInSheet(const Axes& axes)
      : frame(axes),
        field(arc_crack_field(rubber, axes, radius, half, {1, 1, 0})),
        tip{axes.to_rest(std::polar(radius, half)), axes.angle + half + std::numbers::pi / 2, 1 / radius},
        modes{Mode{arc_crack_field(rubber, axes, radius, half, {1, 0, 0}), arc_intensity_along_axis(radius, half, 1)},
              Mode{arc_crack_field(rubber, axes, radius, half, {0, 1, 0}), across()}},
        k(arc_intensity_all_round(radius, half, 1)) {}
  static StressIntensity across() {
    const StressIntensity all = arc_intensity_all_round(radius, half, 1),
                          along = arc_intensity_along_axis(radius, half, 1);
    return {all.k1 - along.k1, all.k2 - along.k2};
  }
};

/// The specimen of the same arc in the sheet, extended at that end by `more` radians.
Specimen specimen_of_arc(const std::string& family, int n, const Axes& frame, double more = 0) {
  Curve curve{Curve::Kind::polyline, false, {}};
  constexpr int steps = 200;
  for (int i = 0; i <= steps; ++i)
    curve.points.push_back(
        frame.to_rest(std::polar(ArcInSheet::radius, -ArcInSheet::half + (2 * ArcInSheet::half + more) * i / steps)));
  return {make_sheet(family, n), {curve}, frame.origin, frame.angle};
}

TEST(StressIntensity, OfAnArcDoesNotDependOnTheRing) {
  const Specimen specimen = find_problem("arc_crack_45").specimen("delaunay", 60, 1, 1);
  const ArcInSheet arc({specimen.origin, specimen.angle});
  const Sheet sheet = cut_by(specimen, "body_fitted");
  const ElementTable elements(sheet);
  const Field exact = at_vertices(arc.field, sheet, arc.radius);
  for (const Ring ring : {Ring{}, Ring{0.06, 0.15}, Ring{0.1, 0.25}, Ring{0.15, 0.3}}) {
    const auto [k1, k2] = InteractionIntegral(sheet, elements, rubber, arc.tip, arc.modes, ring).of(elements, exact);
    std::cout << ring.inner << " to " << ring.outer << ": extractor's own error on the arc " << k1 / arc.k.k1 - 1 << ' '
              << k2 / arc.k.k2 - 1 << '\n';
    EXPECT_NEAR(k1, arc.k.k1, 2e-3 * arc.k.k1);
    EXPECT_NEAR(k2, arc.k.k2, 2.5e-3 * arc.k.k1);
  }
  // A straight cut's fields and growth are not those of an arc, which is why it has its own.
  Tip straight = arc.tip;
  straight.curvature = 0;
  const auto [k1, k2] =
      InteractionIntegral(sheet, elements, rubber, straight, williams_modes(rubber, straight)).of(elements, exact);
  std::cout << "by a straight cut's fields " << k1 / arc.k.k1 - 1 << ' ' << k2 / arc.k.k2 - 1 << '\n';
  EXPECT_GT(std::abs(k1 / arc.k.k1 - 1), 0.02);
}

/// K1^2 + K2^2 = E G, with G = -dU/da by two cuts at the same displacements of the border, of which the second goes a
/// little further.
TEST(StressIntensity, OfAnArcGoesWithTheEnergyOfTwoCuts) {
  const ArcInSheet arc({{0.31, 0.47}, 0.3});
  double energy[2], middle_k = 0;
  const double more = 0.16;
  for (const int further : {0, 1}) {
    const Sheet sheet = cut_by(specimen_of_arc("delaunay", 50, arc.frame, further * more), "body_fitted");
    StaticSolve solve(sheet, rubber);
    solve.hold_border([&](Point2 p, Point2 inside) { return arc.field.displacement(p, inside); });
    const Field u = solve.solve({}).displacement;
    energy[further] = 0;
    for (std::size_t e = 0; e < solve.elements().size(); ++e) {
      const Matrix2d gradient = displacement_gradient(solve.elements()[e], u);
      energy[further] += solve.elements()[e].material_area() / 2 *
                         rubber.stress((gradient + gradient.transpose()) / 2).cwiseProduct(gradient).sum();
    }
    Tip tip = arc.tip;
    tip.at = arc.frame.to_rest(std::polar(arc.radius, arc.half + further * more));
    tip.angle += further * more;
    // Fields of the longer arc for the longer arc: it is symmetric about another axis.
    const double half = arc.half + further * more / 2;
    const Axes axes{arc.frame.origin, arc.frame.angle + further * more / 2};
    const std::array<Mode, 2> modes{
        Mode{arc_crack_field(rubber, axes, arc.radius, half, {1, 1, 0}), arc_intensity_all_round(arc.radius, half, 1)},
        Mode{arc_crack_field(rubber, axes, arc.radius, half, {1, 0, 0}),
             arc_intensity_along_axis(arc.radius, half, 1)}};
    const auto [k1, k2] = InteractionIntegral(sheet, solve.elements(), rubber, tip, modes).of(solve.elements(), u);
    middle_k += (k1 * k1 + k2 * k2) / 2;
  }
  const double released = (energy[0] - energy[1]) / (arc.radius * more);
  std::cout << "-dU/da by two cuts over (K1^2 + K2^2) / E: " << released * rubber.young / middle_k << '\n';
  EXPECT_NEAR(released * rubber.young, middle_k, 0.03 * middle_k);
}

}  // namespace
}  // namespace cutbench
