// The exact answers, by finite differences and by other formulas; and what the harness computes beside them. Rates and
// extrapolated values say that the code is right, not that a method is good.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "harness/cut/cut.h"
#include "harness/mesh/errors.h"
#include "harness/mesh/families.h"
#include "harness/mesh/quality.h"
#include "harness/run/random.h"
#include "harness/truth/edge_crack.h"
#include "harness/truth/elastic_field.h"
#include "harness/truth/lips.h"
#include "harness/truth/problem.h"
#include "harness/truth/quadrature.h"
#include "harness/truth/static_solve.h"
#include "harness/truth/stress_intensity.h"
#include "methods/registry.h"

namespace cutbench {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double pi = std::numbers::pi;
constexpr double degree = pi / 180;
constexpr Elastic rubber{.young = 7, .poisson = 0.3};
const Axes turned{{0.3, -0.2}, 0.7};

// --- exact fields
// ----------------------------------------------------------------------------------------------------------

struct NamedField {
  std::string name;
  std::unique_ptr<ElasticField> field;
  std::vector<LipSample> lips;  ///< in the field's own frame
  bool hole = false;
};

std::vector<LipSample> arc_lips(double radius, double half_angle) {
  std::vector<LipSample> lips;
  for (double t = -0.95 * half_angle; t < half_angle; t += 0.19 * half_angle)
    lips.push_back({{radius * std::cos(t), radius * std::sin(t)}, {std::cos(t), std::sin(t)}, 1});
  return lips;
}

std::vector<NamedField> fields() {
  std::vector<LipSample> straight, behind;
  for (double x = -0.45; x < 0.5; x += 0.1)
    straight.push_back({{x, 0}, {0, 1}, 1}), behind.push_back({{x - 0.5, 0}, {0, 1}, 1});
  std::vector<NamedField> all;
  all.push_back({"uniform", std::make_unique<UniformField>(rubber, turned, 1, 2, 0.5), {}});
  all.push_back({"williams", std::make_unique<WilliamsField>(rubber, turned, 1.3, 0.8), behind});
  all.push_back({"straight", std::make_unique<StraightCrackField>(rubber, turned, 0.5, 0.7, 1.1, 0.4), straight});
  for (const double half : {30 * degree, 60 * degree})
    all.push_back({"arc", std::make_unique<ArcCrackField>(rubber, turned, 0.6, half, 1.2), arc_lips(0.6, half)});
  all.push_back({"hole", std::make_unique<HoleField>(rubber, turned, 0.4, 1.5), arc_lips(0.4, pi), true});
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
  for (const auto& [name, field, lips, hole] : fields()) {
    SCOPED_TRACE(name);
    for (int i = 0; i < 200; ++i) {
      const Point2 local{random.between(-1, 1), random.between(-1, 1)};
      double clear = 1;  // of the cut
      for (const LipSample& lip : lips) clear = std::min(clear, std::sqrt(squared_length(lip.at - local)));
      if (clear < 0.15 || (hole && std::hypot(local.x, local.y) < 0.5)) continue;
      const Point2 p = field->frame().to_rest({local.x, local.y});
      const Matrix2d stress = field->stress(p);
      EXPECT_LE((hooke(difference_gradient(*field, p, 1e-4)) - stress).norm(), 1e-5);
      EXPECT_LE((difference_gradient(*field, p, 1e-4) - field->gradient(p)).norm(), 1e-5);
      constexpr double step = 1e-3;
      const ElasticField& exact = *field;  // clang 14 does not capture parts of a structured binding
      const auto at = [&](double x, double y) { return hooke(difference_gradient(exact, {p.x + x, p.y + y}, step)); };
      const Vector2d divergence =
          (at(step, 0).col(0) - at(-step, 0).col(0) + at(0, step).col(1) - at(0, -step).col(1)) / (2 * step);
      EXPECT_LE(divergence.norm(), 2e-3 * stress.norm() / clear);
    }
  }
}

TEST(ExactFields, HaveLipsWithoutTraction) {
  for (const auto& [name, field, lips, hole] : fields())
    for (const LipSample& lip : lips)
      for (const double side : {1, -1}) {
        if (hole && side < 0) continue;
        constexpr double beside = 1e-4, step = 2e-5;
        const Complex at(lip.at.x + side * beside * lip.normal.x, lip.at.y + side * beside * lip.normal.y);
        const Complex out = std::polar(1.0, field->frame().angle) * Complex(lip.normal.x, lip.normal.y);
        const Matrix2d stress = hooke(difference_gradient(*field, field->frame().to_rest(at), step));
        EXPECT_LE((stress * Vector2d(out.real(), out.imag())).norm(), 1e-2) << name;
      }
}

/// Nothing tears but the cut.
TEST(ExactFields, JumpOnTheCutOnly) {
  for (const auto& [name, field, lips, hole] : fields()) {
    if (name == "williams") continue;  // its cut never ends
    for (const double radius : {0.75, 1.1, 2.0}) {
      constexpr int steps = 2000;
      double largest = 0;
      Vector2d last;
      for (int i = 0; i <= steps; ++i) {
        // Round a cut that is centred at the origin, or lies between it and (0.6, 0).
        const Complex z = Complex(name == "arc" ? 0.3 : 0, 0) + std::polar(radius, 2 * pi * i / steps);
        const Vector2d u = field->displacement(field->frame().to_rest(z));
        if (i > 0) largest = std::max(largest, (u - last).norm());
        last = u;
      }
      EXPECT_LE(largest, 4.0 * 2 * pi * radius / steps) << name;
    }
  }
}

TEST(ExactFields, AreUniformFarAway) {
  const Matrix2d all_round = 1.2 * Matrix2d::Identity();
  const ArcCrackField arc(rubber, turned, 0.6, 1, 1.2);
  EXPECT_LE((arc.stress({3e3, 4e3}) - all_round).norm(), 1e-5);
  const StraightCrackField straight(rubber, {{}, 0}, 0.5, 0.7, 1.1, 0.4);
  const HoleField hole(rubber, {{}, 0}, 0.5, 1.5);
  EXPECT_LE((straight.stress({3e3, 4e3}) - (Matrix2d() << 0.7, 0.4, 0.4, 1.1).finished()).norm(), 1e-5);
  EXPECT_LE((hole.stress({3e3, 4e3}) - (Matrix2d() << 1.5, 0, 0, 0).finished()).norm(), 1e-5);
}

/// u = sqrt(r / 2 pi) / (2 mu) (K1 (cos(t/2) (k - 1 + 2 sin^2), sin(t/2) (k + 1 - 2 cos^2)) + K2 (...)).
TEST(ExactFields, WilliamsAsInTheBooks) {
  const WilliamsField field(rubber, {{}, 0}, 1.3, 0.8);
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
  const HoleField field(rubber, {{}, 0}, a, s);
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
  const StraightCrackField field(rubber, turned, 0.5, 0.7, 1.1, 0);
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

/// Ahead of the tip of an arc the stress goes like K / sqrt(2 pi r); K to six digits from a singular integral equation.
TEST(ExactFields, IntensityOfAnArc) {
  const double table[3][3] = {{30, 1.134604, 0.304016}, {45, 1.201099, 0.497512}, {60, 1.142775, 0.659782}};
  for (const auto& [half, k1, k2] : table) {
    const ArcCrackField field(rubber, {{}, 0}, 1, half * degree, 1);
    const double tangent = (half + 90) * degree, r = 1e-8;
    const Vector2d ahead(std::cos(tangent), std::sin(tangent)), normal(-ahead.y(), ahead.x());
    const Matrix2d stress =
        field.stress({std::cos(half * degree) + r * ahead.x(), std::sin(half * degree) + r * ahead.y()});
    EXPECT_NEAR(normal.dot(stress * normal) * std::sqrt(2 * pi * r), k1, 2e-4);
    EXPECT_NEAR(std::abs(ahead.dot(stress * normal)) * std::sqrt(2 * pi * r), k2, 2e-4);
  }
}

/// Two fits of a handbook, made independently.
TEST(ExactFields, EdgeCrackFitsAgree) {
  for (const double x : {0.15, 0.2, 0.35, 0.5, 0.55}) {
    const double other = 1.12 - 0.231 * x + 10.55 * x * x - 21.72 * std::pow(x, 3) + 30.39 * std::pow(x, 4);
    EXPECT_NEAR(edge_crack_factor(x), other, 0.006 * other);
  }
}

// --- the tools
// -------------------------------------------------------------------------------------------------------------

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

Sheet cut_by(const Specimen& specimen, const std::string& method, double knob = 0) {
  if (method == "body_fitted") return body_fitted(specimen);
  Sheet sheet(specimen.mesh);
  Locator locator(sheet);
  const auto tool = find_method(method).make(knob);
  for (const Curve& cut : specimen.cuts)
    EXPECT_EQ(Cutter().cut(sheet, locator, cut, *tool, {}).status, Status::ok) << method;
  return sheet;
}

/// What the extractor makes of the exact field, known at the vertices alone: its own error, far below that of a
/// solution.
TEST(StressIntensity, OfTheExactFieldAtTheVertices) {
  for (const std::string family : {"grid", "delaunay"})
    for (std::size_t index = 0; index < 2; ++index) {
      const Specimen specimen = find_problem("williams_mode_1").specimen(family, 40, 1, index);
      const Sheet sheet = cut_by(specimen, "conventional_split");
      const WilliamsField field(rubber, {specimen.origin, specimen.angle}, 1.3, 0.8);
      Field displacement = Field::Zero(static_cast<Eigen::Index>(2 * sheet.deformed_slots()));
      for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
        const auto corners = sheet.corners(TriangleIndex(t));
        const Point2 inside = 1.0 / 3 * (corners[0] + corners[1] + corners[2]);
        for (std::size_t k = 0; k < 3; ++k)
          displacement.segment<2>(2 * sheet.triangle(TriangleIndex(t)).deformed[k].value) =
              field.displacement(corners[k], inside);
      }
      const Tip tip{specimen.origin, specimen.angle};
      const ElementTable elements(sheet);
      const auto [k1, k2] = InteractionIntegral(sheet, elements, rubber, tip).of(elements, displacement);
      std::cout << family << ' ' << index << ": extractor's own error " << k1 / 1.3 - 1 << ' ' << k2 / 0.8 - 1 << '\n';
      EXPECT_NEAR(k1, 1.3, 5e-3 * 1.3);
      EXPECT_NEAR(k2, 0.8, 5e-3 * 0.8);
    }
}

TEST(StressIntensity, DoesNotDependOnTheRing) {
  const Specimen specimen = find_problem("williams_mode_1").specimen("delaunay", 60, 1, 1);
  const Sheet sheet = cut_by(specimen, "cgal_cdt");
  const WilliamsField field(rubber, {specimen.origin, specimen.angle}, 1, 0.5);
  StaticSolve solve(sheet, rubber);
  solve.hold_border([&](Point2 p, Point2 inside) { return field.displacement(p, inside); });
  const Field u = solve.solve({}).displacement;
  const Tip tip{specimen.origin, specimen.angle};
  const StressIntensity usual = InteractionIntegral(sheet, solve.elements(), rubber, tip).of(solve.elements(), u);
  for (const Ring ring : {Ring{0.06, 0.15}, Ring{0.1, 0.25}, Ring{0.2, 0.4}}) {
    const StressIntensity k = InteractionIntegral(sheet, solve.elements(), rubber, tip, ring).of(solve.elements(), u);
    std::cout << ring.inner << " to " << ring.outer << ": " << k.k1 / usual.k1 - 1 << ' ' << k.k2 / usual.k2 - 1
              << '\n';
    EXPECT_NEAR(k.k1, usual.k1, 2e-3 * usual.k1);
    EXPECT_NEAR(k.k2, usual.k2, 2e-3 * usual.k2);
  }
}

TEST(BodyFitted, IsACutSheetOfTheSameSize) {
  for (const auto& problem : all_problems()) {
    if (problem->name() == "two_cuts_one_geometry" || !problem->takes_budgets()) continue;
    SCOPED_TRACE(problem->name());
    const Specimen specimen = problem->specimen("grid", 30, 1, 1);
    const Sheet sheet = body_fitted(specimen), cut = cut_by(specimen, "conventional_split");
    EXPECT_TRUE(check(sheet).empty());
    EXPECT_EQ(count_pieces(sheet), count_pieces(cut));
    const auto wanted = static_cast<double>(specimen.mesh.triangles.size());
    EXPECT_NEAR(static_cast<double>(sheet.triangle_count()), wanted, 0.03 * wanted);
    double length = 0, length_cut = 0, area = 0, area_cut = 0, longest = 0;
    const auto measure = [&](const Sheet& of, double& edges, double& total) {
      for (std::size_t t = 0; t < of.triangle_slots(); ++t) {
        if (!of.triangle(TriangleIndex(t)).alive()) continue;
        const auto c = of.corners(TriangleIndex(t));
        total += cross(c[1] - c[0], c[2] - c[0]) / 2;
        for (std::size_t k = 0; k < 3; ++k) {
          const double edge = std::sqrt(squared_length(c[(k + 1) % 3] - c[k]));
          if (of.mark(half_edge(TriangleIndex(t), static_cast<int>(k))) == EdgeMark::incision) edges += edge / 2;
          if (&of == &sheet) longest = std::max(longest, edge);
        }
      }
    };
    measure(sheet, length, area), measure(cut, length_cut, area_cut);
    EXPECT_NEAR(length, length_cut, 2e-3 * length_cut);
    EXPECT_NEAR(area, area_cut, 1e-10);
    EXPECT_LE(longest, 2 * sheet.mean_edge());  // an even size
  }
}

/// Whatever else the process has done: the addresses of a mesher's triangles must not be in the result.
TEST(BodyFitted, IsTheSameWhereverTheMemoryIs) {
  const Specimen specimen = find_problem("arc_crack_45").specimen("grid", 30, 1, 1);
  const std::vector<Point2> first = body_fitted(specimen).to_mesh_data().rest;
  std::vector<std::unique_ptr<std::vector<char>>> blocks;
  for (std::size_t i = 0; i < 600; ++i) blocks.push_back(std::make_unique<std::vector<char>>(i * 7919 % 100000));
  for (std::size_t i = 0; i < blocks.size(); i += 2) blocks[i].reset();  // so that the next ones are scattered
  EXPECT_EQ(body_fitted(specimen).to_mesh_data().rest, first);
}

// --- problems
// ------------------------------------------------------------------------------------------------------------

Answer solved(const Problem& problem, const Specimen& specimen, const Sheet& sheet) {
  const Budget direct;
  Answer answer = problem.answer(specimen, sheet, {&direct, 1}).front();
  EXPECT_EQ(answer.verdict, "ok") << answer.reason;
  return answer;
}

const Measure& measure_of(const Answer& answer, const std::string& name) {
  for (const Measure& measure : answer.measures)
    if (measure.name == name) return measure;
  throw std::out_of_range(name);
}

TEST(Problems, KeepTheContract) {
  for (const auto& problem : all_problems()) {
    SCOPED_TRACE(problem->name());
    EXPECT_EQ(&find_problem(problem->name()), problem.get());
    const Specimen a = problem->specimen("delaunay", 12, 7, 3), b = problem->specimen("delaunay", 12, 7, 3),
                   other = problem->specimen("delaunay", 12, 7, 5);
    EXPECT_EQ(a.mesh.triangles.size(), 2u * 12 * 12);
    ASSERT_FALSE(a.cuts.empty());
    EXPECT_EQ(a.cuts.front().points, b.cuts.front().points);
    EXPECT_NE(a.cuts.front().points, other.cuts.front().points);
    const Sheet sheet = cut_by(a, "conventional_split");
    std::vector<Budget> budgets{{}};
    if (problem->takes_budgets())
      budgets.push_back({{.name = "cg"}, 5}), budgets.push_back({{.name = "cg_sliver_blocks"}, 400});
    const auto answers = problem->answer(a, sheet, budgets);
    ASSERT_EQ(answers.size(), budgets.size());
    for (std::size_t i = 0; i < answers.size(); ++i) {
      EXPECT_EQ(answers[i].verdict, "ok");
      EXPECT_EQ(answers[i].iterations == budgets[i].iterations, problem->takes_budgets());
      ASSERT_EQ(answers[i].measures.size(), problem->measures().size());
      for (std::size_t m = 0; m < answers[i].measures.size(); ++m) {
        EXPECT_EQ(answers[i].measures[m].name, problem->measures()[m]);
        EXPECT_TRUE(std::isfinite(answers[i].measures[m].error));
      }
    }
    if (budgets.size() > 1) {
      EXPECT_GT(answers[1].measures[0].error, answers[0].measures[0].error);
    }
  }
  EXPECT_THROW(find_problem("no such"), InputError);
}

TEST(Problems, TheWorkAtTheBorderIsWhatTheLipsGiveOff) {
  const Specimen specimen = find_problem("centre_crack").specimen("grid", 8, 1, 1);
  const Answer answer = solved(find_problem("centre_crack"), specimen, cut_by(specimen, "cgal_cdt"));
  EXPECT_NEAR(measure_of(answer, "released_energy").exact, pi * 0.25 * 0.25 / 1000, 1e-9 * pi / 1000);
}

TEST(Problems, StressAlongACutIsExactWhateverTheShapes) {
  const Problem& problem = find_problem("parallel_stress");
  double worst_of_all = 0;
  for (const std::string family : sheet_families())
    for (const auto& row : all_methods())
      for (std::size_t index = 0; index < 10 && row.promises.exact_incision; ++index) {
        SCOPED_TRACE(family + ", " + row.name + ' ' + std::to_string(index));
        const Specimen specimen = problem.specimen(family, 8, 3, index);
        const Sheet sheet = cut_by(specimen, row.name);
        double worst = 0;
        for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
          if (sheet.triangle(TriangleIndex(t)).alive()) {
            const auto [a, b, c] = sheet.corners(TriangleIndex(t));
            worst = std::max(worst, aspect_ratio(a, b, c));
          }
        worst_of_all = std::max(worst_of_all, worst);
        const Answer answer = solved(problem, specimen, sheet);
        // Displacements to a unit in the last place or so, over the sliver's height.
        EXPECT_LE(measure_of(answer, "stress").error, 1e-13 * worst);
        EXPECT_LE(measure_of(answer, "displacement_l2").error, 1e-13 + 1e-15 * worst);
      }
  EXPECT_GT(worst_of_all, 1e5);
}

/// Mean errors over members, and the mean of (value / exact), for three sizes, each half the one before.
struct Series {
  double error[3] = {0, 0, 0}, ratio[3] = {0, 0, 0};
  double rate() const { return std::log2(error[0] / error[2]) / 2; }
  double extrapolated() const { return 2 * ratio[2] - ratio[1]; }  // errors like h
};

std::map<std::string, Series> series_of(const Problem& problem, const std::string& family, const std::string& method,
                                        int coarsest) {
  const std::size_t members = method == "body_fitted" ? 2 : 4;  // those meshes hardly differ
  std::map<std::string, Series> all;
  for (int level = 0; level < 3; ++level)
    for (std::size_t index = 0; index < members; ++index) {
      const Specimen specimen = problem.specimen(family, coarsest << level, 1, index);
      for (const Measure& m : solved(problem, specimen, cut_by(specimen, method)).measures) {
        all[m.name].error[level] += m.error / static_cast<double>(members);
        if (m.exact != 0) all[m.name].ratio[level] += m.value / m.exact / static_cast<double>(members);
      }
    }
  std::cout << problem.name() << ", " << family << ", " << method << ":";
  for (const auto& [name, series] : all) {
    std::cout << ' ' << name << " rate " << series.rate();
    if (series.ratio[0] != 0) std::cout << " to " << series.extrapolated();
  }
  std::cout << '\n';
  return all;
}

class Converges : public testing::TestWithParam<std::tuple<std::string, std::string>> {
 protected:
  std::map<std::string, Series> series(const std::string& problem, int coarsest = 16) const {
    return series_of(find_problem(problem), std::get<0>(GetParam()), std::get<1>(GetParam()), coarsest);
  }
};

TEST_P(Converges, CentreCrack) {
  auto all = series("centre_crack");
  EXPECT_NEAR(all["released_energy"].rate(), 1, 0.15);
  EXPECT_NEAR(all["energy_norm"].rate(), 0.5, 0.1);
  EXPECT_NEAR(all["displacement_l2"].rate(), 1, 0.15);
  EXPECT_NEAR(all["strain_energy"].extrapolated(), 1, 0.005);
  EXPECT_NEAR(all["released_energy"].extrapolated(), 1, 0.02);  // a small part of it
  EXPECT_NEAR(all["k1"].extrapolated(), 1, 0.005);
}

TEST_P(Converges, Williams) {
  for (const std::string mode : {"1", "2"}) {
    auto all = series("williams_mode_" + mode);
    EXPECT_NEAR(all["strain_energy"].rate(), 1, 0.15);
    EXPECT_NEAR(all["energy_norm"].rate(), 0.5, 0.1);
    EXPECT_NEAR(all["displacement_l2"].rate(), 1, 0.15);
    EXPECT_NEAR(all["strain_energy"].extrapolated(), 1, 0.005);
    EXPECT_NEAR(all["k" + mode].extrapolated(), 1, 0.005);
  }
}

TEST_P(Converges, Arc) {
  auto all = series("arc_crack_45");
  EXPECT_NEAR(all["released_energy"].rate(), 1, 0.15);
  EXPECT_NEAR(all["energy_norm"].rate(), 0.5, 0.1);
  EXPECT_NEAR(all["strain_energy"].extrapolated(), 1, 0.005);
  EXPECT_NEAR(all["released_energy"].extrapolated(), 1, 0.02);
}

TEST_P(Converges, EdgeCrack) {
  auto all = series("edge_crack_50", 24);
  EXPECT_NEAR(all["k1"].extrapolated(), 1, 0.01);
  EXPECT_NEAR(all["released_energy"].extrapolated(), 1, 0.01);
}

TEST_P(Converges, Hole) {
  auto all = series("kirsch_hole");
  EXPECT_NEAR(all["energy_norm"].rate(), 1, 0.15);
  EXPECT_GE(all["rim_stress"].rate(), 0.6);
}

using SheetAndMethod = std::tuple<std::string, std::string>;
INSTANTIATE_TEST_SUITE_P(Truth, Converges,
                         testing::Values(SheetAndMethod{"grid", "conventional_split"},
                                         SheetAndMethod{"grid", "cgal_cdt"}, SheetAndMethod{"grid", "body_fitted"},
                                         SheetAndMethod{"delaunay", "conventional_split"},
                                         SheetAndMethod{"delaunay", "cgal_cdt"}),
                         [](const auto& chosen) {
                           return std::get<0>(chosen.param) + "_" + std::get<1>(chosen.param);
                         });

/// A method that stops short pays for it: the truth is of the curve that was asked for.
TEST(Problems, TruthIsThatOfTheRequestedCurve) {
  const Problem& problem = find_problem("centre_crack");
  const Specimen specimen = problem.specimen("grid", 30, 1, 1);
  Specimen shorter = specimen;
  Point2& end = shorter.cuts.front().points.back();
  end = end + 0.1 * (shorter.cuts.front().points.front() - end);
  const Answer full = solved(problem, specimen, cut_by(specimen, "cgal_cdt"));
  const Answer lost = solved(problem, specimen, cut_by(shorter, "cgal_cdt"));
  for (std::size_t m = 0; m < 3; ++m) EXPECT_GT(lost.measures[m].error, 1.3 * full.measures[m].error);
}

/// The same final geometry by one cut and by two.
TEST(Problems, TwoCutsAreAsGoodAsOne) {
  for (const auto& row : all_methods())
    for (std::size_t index = 0; index < 4; ++index) {
      const Problem &one = find_problem("centre_crack"), &two = find_problem("two_cuts_one_geometry");
      const Specimen a = one.specimen("alternating", 24, 1, index), b = two.specimen("alternating", 24, 1, index);
      const Answer by_one = solved(one, a, cut_by(a, row.name)), by_two = solved(two, b, cut_by(b, row.name));
      EXPECT_NEAR(measure_of(by_two, "released_energy").value, measure_of(by_one, "released_energy").value,
                  0.02 * measure_of(by_one, "released_energy").exact)
          << row.name << ' ' << index;
    }
}

}  // namespace
}  // namespace cutbench
