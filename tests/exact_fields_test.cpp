// The exact answers, by finite differences and by other formulas.

#include "harness/problems/common/exact_fields.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>

#include "harness/base/random.h"
#include "harness/problems/common/lips.h"
#include "harness/problems/in_plane/edge_crack.h"

namespace cutbench {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180;
constexpr Elastic rubber{.young = 7, .poisson = 0.3};
const Axes turned{{0.3, -0.2}, 0.7};

struct NamedField {
  std::string name;
  ElasticField field;
  std::vector<LipSample> lips;  ///< in the field's own frame
  std::function<bool(Complex)> hole{};
  LipLoad load{};  ///< on the lips of length 1
};

std::vector<LipSample> arc_lips(double radius, double half_angle) {
  std::vector<LipSample> lips;
  for (double t = -0.95 * half_angle; t < half_angle; t += 0.19 * half_angle)
    lips.push_back({{radius * std::cos(t), radius * std::sin(t)}, {std::cos(t), std::sin(t)}, 1});
  return lips;
}

/// Normals point into the sheet.
std::vector<LipSample> corner_lips(double half_angle) {
  std::vector<LipSample> lips;
  const double c = std::cos(half_angle), s = std::sin(half_angle);
  for (double r = 0.05; r < 1.5; r += 0.1) {
    lips.push_back({{r * c, r * s}, {s, -c}, 1});
    lips.push_back({{r * c, -r * s}, {s, c}, 1});
  }
  return lips;
}

constexpr Ellipse oval{0.5, 0.2};

std::vector<LipSample> oval_lips() {
  std::vector<LipSample> lips;
  for (double t = 0; t < 6.2; t += 0.1) {
    const Complex out = Complex(oval.b * std::cos(t), oval.a * std::sin(t));
    lips.push_back(
        {{oval.a * std::cos(t), oval.b * std::sin(t)}, {out.real() / std::abs(out), out.imag() / std::abs(out)}, 1});
  }
  return lips;
}

std::vector<NamedField> fields() {
  std::vector<LipSample> straight, behind;
  for (double x = -0.45; x < 0.5; x += 0.1) {
    straight.push_back({{x, 0}, {0, 1}, 1});
    behind.push_back({{x - 0.5, 0}, {0, 1}, 1});
  }
  std::vector<NamedField> all;
  all.push_back({"uniform", uniform_field(rubber, turned, {1, 2, 0.5}), {}});
  all.push_back({"williams", williams_field(rubber, turned, {1.3, 0.8}), behind});
  all.push_back({"straight", straight_crack_field(rubber, turned, 0.5, {0.7, 1.1, 0.4}), straight});
  for (const double half : {30 * degree, 60 * degree}) {
    all.push_back({"arc", arc_crack_field(rubber, turned, 0.6, half, {1.2, -0.4, 0.7}), arc_lips(0.6, half)});
    all.push_back({"arc", arc_crack_field(rubber, turned, 0.6, half, {1.2, 1.2, 0}), arc_lips(0.6, half)});
  }
  all.push_back(
      {"hole", hole_field(rubber, turned, 0.4, 1.5), arc_lips(0.4, pi), [](Complex z) { return std::abs(z) < 0.4; }});
  std::vector<LipSample> row;
  for (const double turn : {-1.3, 0.0, 1.3})
    for (const LipSample& lip : straight) row.push_back({lip.at + Point2{turn, 0}, lip.normal, 1});
  all.push_back({"collinear", collinear_cracks_field(rubber, turned, 0.5, 1.3, {0.7, 1.1, 0.4}), row});
  for (const LipLoad& load : {LipLoad{{1.1, 0}, {}}, LipLoad{{0.3, 0.7}, {}}, LipLoad{{0.6, 0}, {0.2, -0.5}}})
    all.push_back({"loaded", loaded_crack_field(rubber, turned, 0.5, load), straight, {}, load});
  std::vector<LipSample> crossed = straight;
  for (const LipSample& lip : straight) crossed.push_back({{0, lip.at.x}, {1, 0}, 1});
  all.push_back({"crossed", crossed_cracks_field(rubber, turned, 0.5, 1.2), crossed});
  for (const Corner& corner : {Corner{135 * degree}, Corner{135 * degree, true}, Corner{157.5 * degree}})
    all.push_back({"corner", corner_field(rubber, turned, corner, 1.2), corner_lips(corner.half_angle),
                   [=](Complex z) { return std::abs(std::arg(z)) > corner.half_angle; }});
  for (const PlaneStress& stress : {PlaneStress{0, 1, 0}, PlaneStress{0.6, -0.2, 0.7}})
    all.push_back({"ellipse", elliptic_hole_field(rubber, turned, oval, stress), oval_lips(),
                   [](Complex z) { return oval.holds(z); }});
  return all;
}

/// By central differences of the displacement alone.
Matrix2d difference_gradient(const ElasticField& field, Point2 p, double step) {
  Matrix2d g;
  g.col(0) = (field.displacement({p.x + step, p.y}) - field.displacement({p.x - step, p.y})) / (2 * step);
  g.col(1) = (field.displacement({p.x, p.y + step}) - field.displacement({p.x, p.y - step})) / (2 * step);
  return g;
}

/// Hooke's law in plane stress, written out.
Matrix2d hooke(const Matrix2d& g) {
  const double e = rubber.young, nu = rubber.poisson, c = e / (1 - nu * nu), shear = e / (2 * (1 + nu));
  const double xy = shear * (g(0, 1) + g(1, 0));
  return (Matrix2d() << c * (g(0, 0) + nu * g(1, 1)), xy, xy, c * (g(1, 1) + nu * g(0, 0))).finished();
}

TEST(ExactFields, AreInEquilibriumAndTheirStressIsThatOfTheirDisplacement) {
  Random random(3);
  for (const auto& [name, field, lips, hole, load] : fields()) {
    SCOPED_TRACE(name);
    for (int i = 0; i < 200; ++i) {
      const Point2 local{random.between(-1, 1), random.between(-1, 1)};
      double clear = 1;  // of the cut
      for (const LipSample& lip : lips) clear = std::min(clear, std::sqrt(squared_length(lip.at - local)));
      if (clear < 0.15 || (hole && hole({local.x, local.y}))) continue;
      const Point2 p = field.frame().to_rest({local.x, local.y});
      const Matrix2d stress = field.stress(p);
      EXPECT_LE((hooke(difference_gradient(field, p, 1e-4)) - stress).norm(), 1e-5);
      EXPECT_LE((difference_gradient(field, p, 1e-4) - field.gradient(p)).norm(), 1e-5);
      constexpr double step = 1e-3;
      const ElasticField& exact = field;  // clang 14 does not capture parts of a structured binding
      const auto at = [&](double x, double y) { return hooke(difference_gradient(exact, {p.x + x, p.y + y}, step)); };
      const Vector2d divergence =
          (at(step, 0).col(0) - at(-step, 0).col(0) + at(0, step).col(1) - at(0, -step).col(1)) / (2 * step);
      EXPECT_LE(divergence.norm(), 2e-3 * stress.norm() / clear);
    }
  }
}

TEST(ExactFields, HaveLipsWithoutTraction) {
  for (const auto& [name, field, lips, hole, load] : fields())
    for (const LipSample& lip : lips)
      for (const double side : {1, -1}) {
        if (hole && side < 0) continue;
        if (name == "crossed" && std::hypot(lip.at.x, lip.at.y) > 0.4) continue;  // as steep as one over the root
        constexpr double beside = 2e-5, step = 4e-6;
        const Complex at(lip.at.x + side * beside * lip.normal.x, lip.at.y + side * beside * lip.normal.y);
        const Complex out = std::polar(1.0, field.frame().angle) * Complex(lip.normal.x, lip.normal.y);
        const Matrix2d stress = hooke(difference_gradient(field, field.frame().to_rest(at), step));
        const Vector2d pressure = load.above(lip.at.x, 0.5), turned_load = Eigen::Rotation2Dd(turned.angle) * pressure;
        EXPECT_LE((stress * Vector2d(out.real(), out.imag()) + turned_load).norm(), 1e-2) << name;
      }
}

/// Nothing tears but the cut.
TEST(ExactFields, JumpOnTheCutOnly) {
  for (const auto& [name, field, lips, hole, load] : fields()) {
    if (name == "williams" || name == "collinear" || name == "corner") continue;  // cuts that never end
    for (const double radius : {0.75, 1.1, 2.0}) {
      constexpr int steps = 2000;
      double largest = 0;
      Vector2d last;
      for (int i = 0; i <= steps; ++i) {
        // Round a cut that is centred at the origin, or lies between it and (0.6, 0).
        const Complex z = Complex(name == "arc" ? 0.3 : 0, 0) + std::polar(radius, 2 * pi * i / steps);
        const Vector2d u = field.displacement(field.frame().to_rest(z));
        if (i > 0) largest = std::max(largest, (u - last).norm());
        last = u;
      }
      EXPECT_LE(largest, 4.0 * 2 * pi * radius / steps) << name;
    }
  }
}

TEST(ExactFields, AreUniformFarAway) {
  const Matrix2d all_round = 1.2 * Matrix2d::Identity();
  const ElasticField arc = arc_crack_field(rubber, turned, 0.6, 1, {1.2, 1.2, 0}),
                     pulled = arc_crack_field(rubber, {{}, 0}, 0.6, 1, {0.7, 1.1, 0.4});
  EXPECT_LE((arc.stress({3e3, 4e3}) - all_round).norm(), 1e-5);
  const ElasticField straight = straight_crack_field(rubber, {{}, 0}, 0.5, {0.7, 1.1, 0.4});
  const ElasticField hole = hole_field(rubber, {{}, 0}, 0.5, 1.5);
  EXPECT_LE((straight.stress({3e3, 4e3}) - (Matrix2d() << 0.7, 0.4, 0.4, 1.1).finished()).norm(), 1e-5);
  EXPECT_LE((pulled.stress({3e3, 4e3}) - (Matrix2d() << 0.7, 0.4, 0.4, 1.1).finished()).norm(), 1e-5);
  EXPECT_LE((hole.stress({3e3, 4e3}) - (Matrix2d() << 1.5, 0, 0, 0).finished()).norm(), 1e-5);
  const Matrix2d sheared = (Matrix2d() << 0.7, 0.4, 0.4, 1.1).finished();
  const PlaneStress of_it{0.7, 1.1, 0.4};
  EXPECT_LE((elliptic_hole_field(rubber, {{}, 0}, oval, of_it).stress({3e3, 4e3}) - sheared).norm(), 1e-5);
  EXPECT_LE((collinear_cracks_field(rubber, {{}, 0}, 0.5, 1.3, of_it).stress({0.2, 20}) - sheared).norm(), 1e-5);
  EXPECT_LE(loaded_crack_field(rubber, {{}, 0}, 0.5, {{1, 0.5}, {0.2, 0}}).stress({3e3, 4e3}).norm(), 1e-5);
  EXPECT_LE((crossed_cracks_field(rubber, {{}, 0}, 0.5, 1.2).stress({3e3, 4e3}) - all_round).norm(), 1e-5);
}

/// u = sqrt(r / 2 pi) / (2 mu) (K1 (cos(t/2) (k - 1 + 2 sin^2), sin(t/2) (k + 1 - 2 cos^2)) + K2 (...)).
TEST(ExactFields, WilliamsAsInTheBooks) {
  const ElasticField field = williams_field(rubber, {{}, 0}, {1.3, 0.8});
  const double k = rubber.kappa();
  for (const double r : {0.1, 0.7})
    for (double t = -3.1; t < 3.1; t += 0.31) {
      const double c = std::cos(t / 2), s = std::sin(t / 2), scale = std::sqrt(r / (2 * pi)) / (2 * rubber.mu());
      const Vector2d u = scale * (1.3 * Vector2d(c * (k - 1 + 2 * s * s), s * (k + 1 - 2 * c * c)) +
                                  0.8 * Vector2d(s * (k + 1 + 2 * c * c), -c * (k - 1 - 2 * s * s)));
      EXPECT_LE((field.displacement({r * std::cos(t), r * std::sin(t)}) - u).norm(), 1e-14);
    }
}

TEST(ExactFields, KirschAsInTheBooks) {
  const double a = 0.4, s = 1.5, k = rubber.kappa();
  const ElasticField field = hole_field(rubber, {{}, 0}, a, s);
  for (const double r : {0.4, 0.9})
    for (double t = 0; t < 6.2; t += 0.31) {
      const double q = a / r;
      const Vector2d u = s * a / (8 * rubber.mu()) *
                         Vector2d((k + 1) * std::cos(t) / q + 2 * q * ((1 + k) * std::cos(t) + std::cos(3 * t)) -
                                      2 * q * q * q * std::cos(3 * t),
                                  (k - 3) * std::sin(t) / q + 2 * q * ((1 - k) * std::sin(t) + std::sin(3 * t)) -
                                      2 * q * q * q * std::sin(3 * t));
      EXPECT_LE((field.displacement({r * std::cos(t), r * std::sin(t)}) - u).norm(), 1e-14);
    }
  for (double t = 0; t < 6.2; t += 0.31) {
    const Vector2d along(-std::sin(t), std::cos(t));
    EXPECT_NEAR(along.dot(field.stress({a * std::cos(t), a * std::sin(t)}) * along), s * (1 - 2 * std::cos(2 * t)),
                1e-12);
  }
}

/// The gape of a straight cut, (4 s / E) sqrt(a^2 - x^2), and what the lips give off: pi s^2 a^2 / E.
TEST(ExactFields, OpeningOfAStraightCut) {
  const ElasticField field = straight_crack_field(rubber, turned, 0.5, {0.7, 1.1, 0});
  double given_off = 0;
  constexpr int steps = 2000;
  for (int i = 0; i < steps; ++i) {
    const double x = -0.5 + (i + 0.5) / steps;
    const Point2 normal = Axes{{}, turned.angle}.to_rest({0, 1});
    const double gape = opening(field, {{turned.to_rest({x, 0}), normal, 1}}).front();
    EXPECT_NEAR(gape, 4 * 1.1 / rubber.young * std::sqrt(0.25 - x * x), 1e-12);
    given_off += 1.1 * gape / 2 / steps;
  }
  EXPECT_NEAR(given_off, pi * 1.1 * 1.1 * 0.25 / rubber.young, 1e-5);
}

/// Ahead of the tip of an arc the stress goes like K / sqrt(2 pi r); K to six digits from a singular integral equation,
/// pulled in all directions and along the axis. By the handbook's formulas, too.
TEST(ExactFields, IntensityOfAnArc) {
  struct Row {
    double half, k1, k2, k1_along, k2_along;
  };
  for (const Row& row :
       {Row{30, 1.134604, 0.304016, 0.974959, 0.585621}, Row{45, 1.201099, 0.497512, 0.810666, 0.906160},
        Row{60, 1.142775, 0.659782, 0.464252, 1.092763}})
    for (const bool all_round : {true, false})
      for (const double side : {1, -1}) {
        const double half = row.half * degree, r = 1e-8, tangent = side * (half + pi / 2);
        const double k1 = all_round ? row.k1 : row.k1_along, k2 = side * (all_round ? row.k2 : row.k2_along);
        const ElasticField field = arc_crack_field(rubber, {{}, 0}, 1, half, {1, all_round ? 1.0 : 0.0, 0});
        const Vector2d ahead(std::cos(tangent), std::sin(tangent)), normal(-ahead.y(), ahead.x());
        const Matrix2d stress = field.stress({std::cos(half) + r * ahead.x(), side * std::sin(half) + r * ahead.y()});
        EXPECT_NEAR(normal.dot(stress * normal) * std::sqrt(2 * pi * r), k1, 2e-4);
        EXPECT_NEAR(ahead.dot(stress * normal) * std::sqrt(2 * pi * r), k2, 2e-4);
        const StressIntensity k =
            all_round ? arc_intensity_all_round(1, half, 1) : arc_intensity_along_axis(1, half, 1);
        EXPECT_NEAR(k.k1, k1, 1e-6);
        EXPECT_NEAR(side * k.k2, k2, 1e-6);
      }
}

/// What crosses the axis at a short way r ahead of the end, times sqrt(2 pi r): K1 and K2.
StressIntensity ahead_of(const ElasticField& field, double end) {
  const double r = 1e-8;
  const Matrix2d stress = field.stress({end + std::copysign(r, end), 0});
  return {stress(1, 1) * std::sqrt(2 * pi * r), stress(0, 1) * std::sqrt(2 * pi * r)};
}

TEST(ExactFields, CollinearCracksAsInTheBooks) {
  const double a = 0.3, w = 0.8;
  const ElasticField field = collinear_cracks_field(rubber, {{}, 0}, a, w, {0, 1.1, 0.4});
  const double factor = std::sqrt(w * std::tan(pi * a / w));
  EXPECT_NEAR(ahead_of(field, a).k1, 1.1 * factor, 1e-3);
  EXPECT_NEAR(ahead_of(field, a).k2, 0.4 * factor, 1e-3);
  for (double x = -0.29; x < 0.3; x += 0.05) {
    const double gape = 4 * 1.1 * w / (pi * rubber.young) * std::acosh(std::cos(pi * x / w) / std::cos(pi * a / w));
    for (const double turns : {0, 1, -2})
      EXPECT_NEAR(opening(field, {{{x + turns * w, 0}, {0, 1}, 1}}).front(), gape, 1e-9);
  }
  for (const Point2 p : {Point2{0.1, 0.2}, Point2{-0.37, 0.05}})
    EXPECT_LE((field.stress(p) - field.stress({p.x + 3 * w, p.y})).norm(), 1e-12);
  // Cuts far apart know nothing of each other.
  const ElasticField far_apart = collinear_cracks_field(rubber, {{}, 0}, a, 1e4, {0, 1.1, 0.4}),
                     lone = straight_crack_field(rubber, {{}, 0}, a, {0, 1.1, 0.4});
  EXPECT_LE((far_apart.displacement({0.2, 0.1}) - lone.displacement({0.2, 0.1})).norm(), 1e-7);
  // The bridges bear all: the mean of the tension in one is s W / (W - 2 a).
  double sum = 0;
  constexpr int steps = 4000;
  for (int i = 0; i < steps; ++i) {
    const double angle = pi * (i + 0.5) / steps;  // crowded towards both ends
    const double x = w / 2 - (w / 2 - a) * std::cos(angle);
    sum += field.stress({x, 0})(1, 1) * (w / 2 - a) * std::sin(angle) * pi / steps;
  }
  EXPECT_NEAR(sum, 1.1 * w, 1e-4);
}

TEST(ExactFields, LoadedLipsAsInTheBooks) {
  const double a = 0.3, root = std::sqrt(pi * a);
  const ElasticField field = loaded_crack_field(rubber, {{}, 0}, a, {{1.1, 0.6}, {0.4, -0.2}});
  EXPECT_NEAR(ahead_of(field, a).k1, (1.1 + 0.3) * root, 1e-3);
  EXPECT_NEAR(ahead_of(field, -a).k1, (1.1 - 0.3) * root, 1e-3);
  EXPECT_NEAR(ahead_of(field, a).k2, (0.4 - 0.1) * root, 1e-3);
  EXPECT_NEAR(ahead_of(field, -a).k2, (0.4 + 0.1) * root, 1e-3);
  // A pressure opens as a tension far away does.
  const ElasticField pressed = loaded_crack_field(rubber, {{}, 0}, a, {{1.1, 0}, {}});
  for (double x = -0.25; x < 0.3; x += 0.1)
    EXPECT_NEAR(opening(pressed, {{{x, 0}, {0, 1}, 1}}).front(), 4 * 1.1 / rubber.young * std::sqrt(a * a - x * x),
                1e-12);
}

/// 0.8636 of Rooke and Sneddon; every arm alike.
TEST(ExactFields, IntensityOfCrossedCuts) {
  EXPECT_NEAR(crossed_cracks_factor(), 0.8636, 2e-4);
  const ElasticField field = crossed_cracks_field(rubber, {{}, 0}, 0.3, 1.2);
  for (const double end : {0.3, -0.3})
    EXPECT_NEAR(ahead_of(field, end).k1, crossed_cracks_factor() * 1.2 * std::sqrt(pi * 0.3), 1e-3);
  for (const Point2 p : {Point2{0.1, 0.2}, Point2{0.37, 0.05}}) {
    const Matrix2d here = field.stress(p), there = field.stress({-p.y, p.x});
    EXPECT_NEAR(here(0, 0), there(1, 1), 1e-12);
    EXPECT_NEAR(here(0, 1), -there(0, 1), 1e-12);
  }
}

/// Williams's exponents, and stresses that go like r^(q - 1).
TEST(ExactFields, CornersAsInTheBooks) {
  EXPECT_NEAR(Corner{135 * degree}.exponent(), 0.5444837, 1e-7);
  EXPECT_NEAR((Corner{135 * degree, true}.exponent()), 0.9085292, 1e-7);
  EXPECT_NEAR(Corner{179.9 * degree}.exponent(), 0.5, 1e-3);  // a cut
  for (const bool sliding : {false, true}) {
    const Corner corner{135 * degree, sliding};
    const ElasticField field = corner_field(rubber, {{}, 0}, corner, 1.2);
    for (const double r : {1e-3, 0.3}) {
      const double stress = 1.2 * std::pow(r, corner.exponent() - 1);
      EXPECT_NEAR(field.stress({r, 0})(1, sliding ? 0 : 1), stress, 1e-9 * stress);
      EXPECT_NEAR(field.stress({r, 0})(1, sliding ? 1 : 0), 0, 1e-9 * stress);
    }
  }
}

/// At the ends of its axes, pulled along y and along x; a circle is Kirsch's.
TEST(ExactFields, EllipticHoleAsInTheBooks) {
  const ElasticField across = elliptic_hole_field(rubber, {{}, 0}, oval, {0, 1.5, 0}),
                     along = elliptic_hole_field(rubber, {{}, 0}, oval, {1.5, 0, 0});
  EXPECT_NEAR(across.stress({oval.a, 0})(1, 1), 1.5 * (1 + 2 * oval.a / oval.b), 1e-9);
  EXPECT_NEAR(across.stress({0, oval.b})(0, 0), -1.5, 1e-9);
  EXPECT_NEAR(along.stress({0, oval.b})(0, 0), 1.5 * (1 + 2 * oval.b / oval.a), 1e-9);
  EXPECT_NEAR(along.stress({oval.a, 0})(1, 1), -1.5, 1e-9);
  const ElasticField nearly = elliptic_hole_field(rubber, turned, {0.4 + 1e-9, 0.4}, {1.5, 0, 0}),
                     round = hole_field(rubber, turned, 0.4, 1.5);
  for (const Point2 p : {Point2{0.9, 0.3}, Point2{-0.6, 0.5}}) {
    EXPECT_LE((nearly.stress(p) - round.stress(p)).norm(), 1e-7);
    EXPECT_LE((nearly.displacement(p) - round.displacement(p)).norm(), 1e-7);
  }
  const Complex t = oval.to_circle({0.3, 0.05}), rim = oval.from_circle(t / std::abs(t));
  EXPECT_LE((across.stress({0.3, 0.05}) - across.stress({rim.real(), rim.imag()})).norm(), 1e-9);
  EXPECT_LE((across.displacement({0.3, 0.05}) - across.displacement({rim.real(), rim.imag()})).norm(), 1e-12);
}

/// Two fits of a handbook, made independently.
TEST(ExactFields, EdgeCrackFitsAgree) {
  for (const double x : {0.15, 0.2, 0.35, 0.5, 0.55}) {
    const double other = 1.12 - 0.231 * x + 10.55 * x * x - 21.72 * std::pow(x, 3) + 30.39 * std::pow(x, 4);
    EXPECT_NEAR(edge_crack_factor(x), other, 0.006 * other);
  }
}

}  // namespace
}  // namespace cutbench
