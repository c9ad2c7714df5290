// Functions for the tips of incisions: their values across edges and lips, their stiffness, the solve, K from their
// coefficients, and what refuses them. The oracles evaluate complex roots, integrate in polar coordinates and
// differentiate energies; they share no code with the functions.

#include "harness/fem/tips/tip_functions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

#include "harness/base/conversions.h"
#include "harness/base/random.h"
#include "harness/cut/constraint_source.h"
#include "harness/fem/tips/tip_quadrature.h"
#include "harness/fem/tips/tip_system.h"
#include "harness/mesh/families.h"
#include "harness/problems/common/members.h"
#include "harness/problems/common/stress_intensity.h"
#include "harness/problems/in_plane/static_solve.h"
#include "tests/truth_helpers.h"

namespace cutbench {
namespace {

constexpr double pi = std::numbers::pi;
using std::sqrt;

Budget with_tips() { return {.tip_functions = true}; }

const std::vector<std::string> cracks{"centre_crack", "inclined_crack", "arc_crack_60", "edge_crack_40"};

/// Integral of r^power over a triangle with the tip at corner 0, by polar coordinates: over the side opposite, at a
/// distance h sinh(t) from the foot of the height h, of h^(power + 2) cosh(t)^(power + 1) / (power + 2), by Simpson's
/// rule.
double of_power(const std::array<Point2, 3>& c, double power) {
  const Point2 u = c[1] - c[0], v = c[2] - c[0];
  const double side = sqrt(squared_length(v - u)), height = cross(u, v) / side;
  const double from = std::asinh(dot(u, v - u) / side / height), to = std::asinh(dot(v, v - u) / side / height);
  constexpr int steps = 2000;
  double sum = 0;
  for (int i = 0; i <= steps; ++i)
    sum += (i == 0 || i == steps ? 1
            : i % 2 == 1         ? 4
                                 : 2) *
           std::pow(std::cosh(from + (to - from) * i / steps), power + 1);
  return std::pow(height, power + 2) * sum * (to - from) / steps / 3 / (power + 2);
}

TEST(TipQuadrature, OfPowersOfTheDistance) {
  for (const auto& c : {std::array<Point2, 3>{{{0.1, 0.2}, {1, 0}, {0.4, 1}}},
                        {{{0, 0}, {1, -1e-3}, {-0.7, 1e-3}}},  // seen at a wide angle
                        {{{0, 0}, {1, 0}, {0.5, 1e-6}}}})      // a sliver
    for (const double power : {-1.0, -0.5, 0.0, 0.5}) {
      double sum = 0;
      const Point2 tip = c[0];
      const auto add = [&](Point2 p, double weight) { sum += weight * std::pow(squared_length(p - tip), power / 2); };
      integrate_near_tips(c, {&tip, 1}, 10, add);
      const double exact = of_power(c, power);
      EXPECT_NEAR(sum, exact, 2e-7 * exact) << power;
      sum = 0;  // the same as two triangles, one of which is beside the tip
      const Point2 a = c[0] + 0.3 * (c[1] - c[0]);
      integrate_near_tips({c[0], a, c[2]}, {&tip, 1}, 10, add);
      integrate_near_tips({a, c[1], c[2]}, {&tip, 1}, 10, add);
      EXPECT_NEAR(sum, exact, 2e-7 * exact) << power;
    }
}

/// A cut sheet of one of the problems.
struct Case {
  Specimen specimen;
  Sheet sheet;
  Constraints constraints;
};
Case made(const std::string& problem, const std::string& family, int n, std::size_t index,
          const std::string& method = "conventional_split") {
  const Specimen specimen = find_problem(problem).specimen(family, n, 1, index);
  const double parameter = find_method(method).parameter.value;
  const Sheet sheet = cut_by(specimen, method, parameter);
  return {specimen, sheet, constraints_of(*find_method(method).make(parameter), Sheet(specimen.mesh), sheet)};
}

Eigen::VectorXd some_coefficients(const TipFunctions& functions, std::uint64_t seed = 3) {
  Random random(seed);
  Eigen::VectorXd c(to_index(functions.unknowns()));
  for (double& x : c) x = 2 * random.unit() - 1;
  return c;
}

TEST(TipFunctions, AreWhereIncisionsEndInsideTheSheet) {
  for (const std::string method : {"conventional_split", "warp_and_refine", "cut_polygons"})
    for (const auto& [problem, tips] : {std::pair<std::string, std::size_t>{"centre_crack", 2},
                                        {"arc_crack_60", 2},
                                        {"two_cuts_one_geometry", 2},
                                        {"edge_crack_40", 1},
                                        {"kirsch_hole", 0}}) {
      const auto [specimen, sheet, constraints] = made(problem, "delaunay", 20, 1, method);
      const TipFunctions functions(sheet);
      ASSERT_EQ(functions.tips().size(), tips) << problem << ' ' << method;
      for (const auto& tip : functions.tips()) {
        const auto& ends = specimen.cuts;
        EXPECT_TRUE(sqrt(squared_length(tip.at - ends.front().points.front())) < 1e-9 ||
                    sqrt(squared_length(tip.at - ends.back().points.back())) < 1e-9);
        for (const auto& other : functions.tips()) {
          if (&other != &tip) {
            EXPECT_LT(tip.radius, sqrt(squared_length(tip.at - other.at)));
          }
        }
        if (problem == "edge_crack_40") continue;
        for (const double to_border : {tip.at.x, tip.at.y, 1 - tip.at.x, 1 - tip.at.y})
          EXPECT_LT(tip.radius, to_border);
      }
    }
}

/// Across every edge that is not opened the functions are continuous. Across the tip's own incision they change sign,
/// and where that is straight all but sqrt(r) sin(theta/2) are zero there.
TEST(TipFunctions, JumpAcrossTheIncisionAlone) {
  for (const std::string& problem : cracks)
    for (const std::string family : {"grid", "delaunay"})
      for (std::size_t index = 0; index < 4; ++index) {
        SCOPED_TRACE(problem + ' ' + family + ' ' + std::to_string(index));
        const auto [specimen, sheet, constraints] = made(problem, family, 20, index);
        const TipFunctions functions(sheet);
        std::size_t lips = 0;
        for (std::size_t slot = 0; slot < sheet.triangle_slots(); ++slot) {
          const TriangleIndex t(slot);
          if (!sheet.triangle(t).alive()) continue;
          for (int k = 0; k < 3; ++k) {
            const HalfEdge h = half_edge(t, k);
            if (sheet.on_border(h)) continue;
            const TriangleIndex o = triangle_of(sheet.opposite(h));
            const Point2 p = 0.3 * sheet.rest(sheet.origin(h)) + 0.7 * sheet.rest(sheet.target(h));
            for (std::size_t tip = 0; tip < functions.tips().size(); ++tip)
              for (std::size_t j = 0; j < TipFunctions::per_tip; ++j) {
                Eigen::VectorXd c = Eigen::VectorXd::Zero(to_index(functions.unknowns()));
                c[to_index(8 * tip + 2 * j)] = 1;
                const double here = functions.displacement(t, p, c).value.x(),
                             across = functions.displacement(o, p, c).value.x();
                const bool opened = sheet.mark(h) == EdgeMark::incision;
                EXPECT_NEAR(here, opened ? -across : across, 1e-12);
                const double r = sqrt(squared_length(p - functions.tips()[tip].at)),
                             s = std::min(1.0, r / functions.tips()[tip].radius),
                             expected = opened && j == 0 ? sqrt(r) * (1 - s) * (1 - s) : 0;
                if (opened && problem != "arc_crack_60") {
                  EXPECT_NEAR(std::abs(here), expected, 1e-7);
                }
                lips += expected > 0;
              }
          }
        }
        EXPECT_GT(lips, 10u);
      }
}

/// The functions as complex roots: F = Im, Re of w, and sin(theta) times these; w the square root of z, of either sign.
TEST(TipFunctions, AreRootsWithTheRightDerivatives) {
  const auto [specimen, sheet, constraints] = made("arc_crack_60", "delaunay", 20, 1);
  const TipFunctions functions(sheet);
  std::size_t seen = 0;
  for (std::size_t slot = 0; slot < sheet.triangle_slots(); ++slot)
    for (const auto& reach : functions.reaching(TriangleIndex(slot))) {
      const auto& tip = functions.tips()[reach.tip];
      const auto corners = sheet.corners(TriangleIndex(slot));
      const Point2 p = 0.2 * corners[0] + 0.5 * corners[1] + 0.3 * corners[2];
      // Ahead: away from the one opened edge at the tip.
      std::complex<double> ahead;
      for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
        for (int k = 0; k < 3; ++k)
          if (const HalfEdge h = half_edge(TriangleIndex(t), k);
              sheet.origin(h) == tip.vertex && sheet.mark(h) == EdgeMark::incision)
            ahead = {tip.at.x - sheet.rest(sheet.target(h)).x, tip.at.y - sheet.rest(sheet.target(h)).y};
      ahead /= std::abs(ahead);
      const auto at = [&](Point2 q) {
        const std::complex<double> z = std::complex<double>(q.x - tip.at.x, q.y - tip.at.y) / ahead, w = sqrt(z);
        const double r = std::abs(z), s = r / tip.radius, sine = z.imag() / r;
        const double chi = std::pow(std::max(0.0, 1 - s), 2);
        return std::array{chi * w.imag(), chi * w.real(), chi * w.imag() * sine, chi * w.real() * sine};
      };
      const auto here = functions.at(TriangleIndex(slot), reach, p);
      const auto expected = at(p);
      const double sign =
          std::abs(here[1].value) + std::abs(expected[1]) > 0 && here[1].value * expected[1] < 0 ? -1 : 1;
      constexpr double step = 1e-6;
      const auto right = at(p + Point2{step, 0}), left = at(p + Point2{-step, 0}), up = at(p + Point2{0, step}),
                 down = at(p + Point2{0, -step});
      for (std::size_t j = 0; j < 4; ++j) {
        EXPECT_NEAR(here[j].value, sign * expected[j], 1e-12);
        if (std::abs(right[1] - left[1]) > 0.1 || std::abs(up[1] - down[1]) > 0.1 || std::abs(up[0] - down[0]) > 0.1 ||
            std::abs(right[0] - left[0]) > 0.1)
          continue;  // the root's own branch cut
        EXPECT_NEAR(here[j].gradient.x(), sign * (right[j] - left[j]) / (2 * step), 1e-4);
        EXPECT_NEAR(here[j].gradient.y(), sign * (up[j] - down[j]) / (2 * step), 1e-4);
      }
      ++seen;
    }
  EXPECT_GT(seen, 200u);
}

Model<2> model_of(const Sheet& sheet, const Constraints& constraints) {
  Model<2> model(sheet, {.stiffness = sheet_material.young, .poisson = sheet_material.poisson},
                 {.dimension = 2, .strain = Strain::linear}, {}, {});
  model.constrain(sheet, constraints);
  return model;
}

struct Energies {
  Model<2> model;
  TipFunctions functions;
  TipSystem system;
  explicit Energies(const Sheet& sheet, const Constraints& constraints = {})
      : model(model_of(sheet, constraints)),
        functions(sheet),
        system(sheet, model.elements(), functions, lame_of(model.material(), Plane::stress)) {}
};

/// Energy of the functions of one tip alone, in polar coordinates round it. It does not depend on where the branch cut
/// is: turning round the tip once changes the sign of all functions.
TEST(TipFunctions, HaveTheEnergyOfTheirFields) {
  for (const std::string& problem : cracks)
    for (const std::size_t index : {0u, 1u}) {
      SCOPED_TRACE(problem);
      const auto [specimen, sheet, constraints] = made(problem, "delaunay", 16, index);
      const Energies energies(sheet);
      for (std::size_t tip = 0; tip < energies.functions.tips().size(); ++tip) {
        Eigen::VectorXd c = some_coefficients(energies.functions);
        for (Eigen::Index i = 0; i < c.size(); ++i)
          if (i / 8 != to_index(tip)) c[i] = 0;
        const double radius = energies.functions.tips()[tip].radius;
        // theta is measured from the incision's first edge.
        const auto field = [&](double r, double theta) {
          const double s = r / radius, chi = (1 - s) * (1 - s);
          const double sine = std::sin(theta / 2), cosine = std::cos(theta / 2);
          Eigen::Vector4d f(sine, cosine, sine * std::sin(theta), cosine * std::sin(theta));
          const auto place = to_index(8 * tip);
          Eigen::Vector2d u(0, 0);
          for (Eigen::Index j = 0; j < 4; ++j) u += chi * sqrt(r) * f[j] * c.segment<2>(place + 2 * j);
          return u;
        };
        double ahead = 0;
        for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
          for (int k = 0; k < 3; ++k)
            if (const HalfEdge h = half_edge(TriangleIndex(t), k);
                sheet.origin(h) == energies.functions.tips()[tip].vertex && sheet.mark(h) == EdgeMark::incision) {
              const Point2 along = sheet.rest(sheet.target(h)) - sheet.rest(sheet.origin(h));
              ahead = std::atan2(-along.y, -along.x);
            }
        constexpr int rings = 400, spokes = 128;
        double exact = 0;
        for (int i = 0; i < rings; ++i)
          for (int j = 0; j < spokes; ++j) {
            const double r = radius * (i + 0.5) / rings, theta = -pi + 2 * pi * (j + 0.5) / spokes, step = 1e-5;
            const Eigen::Vector2d by_r = (field(r + step * r, theta) - field(r - step * r, theta)) / (2 * step * r),
                                  by_theta = (field(r, theta + step) - field(r, theta - step)) / (2 * step);
            const Eigen::Vector2d outward(std::cos(theta + ahead), std::sin(theta + ahead)),
                around(-outward.y(), outward.x());
            const Eigen::Matrix2d gradient = by_r * outward.transpose() + by_theta / r * around.transpose();
            const Eigen::Matrix2d strain = (gradient + gradient.transpose()) / 2;
            exact +=
                sheet_material.stress(strain).cwiseProduct(strain).sum() / 2 * r * (radius / rings) * (2 * pi / spokes);
          }
        const double energy = energies.system.energy(Field::Zero(to_index(2 * sheet.deformed_slots())), c);
        EXPECT_NEAR(energy, exact, 1e-4 * exact);
      }
    }
}

/// With a rigid motion of the sheet the functions exchange no energy, and with a uniform stress only through what it
/// does to the lips: none along the cut.
TEST(TipFunctions, RigidMotionsAndStressAlongTheCutDoNothing) {
  for (const std::string method : {"conventional_split", "cut_polygons"})
    for (std::size_t index = 0; index < 4; ++index) {
      const auto [specimen, sheet, constraints] = made("centre_crack", "delaunay", 20, index, method);
      const Energies energies(sheet, constraints);
      const Eigen::VectorXd c = some_coefficients(energies.functions);
      const auto moved = [&](const Eigen::Matrix2d& gradient) {
        Field u = Field::Zero(to_index(2 * sheet.deformed_slots()));
        for (std::size_t d = 0; d < sheet.deformed_slots(); ++d)
          if (const VertexIndex v = sheet.rest_vertex(DeformedIndex(d)); v.valid())
            u.segment<2>(to_index(2 * d)) =
                gradient * Eigen::Vector2d(sheet.rest(v).x, sheet.rest(v).y) + Eigen::Vector2d(1, 2);
        return u;
      };
      const double alone = energies.system.energy(moved(Eigen::Matrix2d::Zero()), c);
      Eigen::Matrix2d turn, stress;
      turn << 0, -1, 1, 0;
      EXPECT_NEAR(energies.system.energy(moved(turn), c), alone, 1e-11 * alone);
      const Eigen::Vector2d along(std::cos(specimen.angle), std::sin(specimen.angle));
      stress = along * along.transpose();
      const Eigen::Matrix2d strain = sheet_material.strain(stress * sheet_material.young);
      EXPECT_NEAR(energies.system.energy(moved(strain), c), alone, 1e-5 * alone);  // quadrature
      EXPECT_GT(std::abs(energies.system.energy(
                             moved(sheet_material.strain(turn * stress * turn.transpose() * sheet_material.young)), c) -
                         alone),
                1e-3 * alone);
    }
}

/// What the solve finds has the least energy: no change of the free unknowns or coefficients has a first-order effect.
TEST(TipFunctions, TheSolutionHasTheLeastEnergy) {
  for (const std::string& problem : cracks) {
    if (problem == "edge_crack_40") continue;       // loaded, not held
    for (const std::size_t index : {0u, 1u, 2u}) {  // even ones have slivers beside the tip
      const auto [specimen, sheet, constraints] = made(problem, "grid", 12, index);
      Energies energies(sheet);
      StaticSolve solve(sheet, sheet_material);
      solve.hold_border([](Point2 p, Point2) { return Eigen::Vector2d(p.x * p.y, 0.3 * p.y - p.x * p.x); });
      const Budget budget = with_tips();
      solve.make_tip_functions({&budget, 1});
      const auto solution = solve.solve(budget);
      ASSERT_EQ(solution.answer.verdict, Verdict::ok);
      const auto energy = [&](const Field& u, const Eigen::VectorXd& c) {
        energies.model.rotate(u);
        return energies.model.energy(u, Field::Zero(u.size())).membrane + energies.system.energy(u, c);
      };
      Random random(5);
      const double least = energy(solution.displacement, solution.of_tips);
      for (int trial = 0; trial < 10; ++trial) {
        // Smooth, so that slivers take no more of the energy than others, and zero on the border.
        Field du = Field::Zero(solution.displacement.size());
        const double a = random.unit(), b = random.unit(), both = random.unit();
        for (std::size_t d = 0; d < sheet.deformed_slots(); ++d)
          if (const VertexIndex v = sheet.rest_vertex(DeformedIndex(d)); v.valid()) {
            const Point2 p = sheet.rest(v);
            const double bump = 1e-2 * p.x * (1 - p.x) * p.y * (1 - p.y);
            du.segment<2>(to_index(2 * d)) << bump * (a + p.x), bump * (b - both * p.y);
          }
        const Eigen::VectorXd dc = 1e-2 * some_coefficients(energies.functions, 10 + static_cast<std::uint64_t>(trial));
        const double plus = energy(solution.displacement + du, solution.of_tips + dc),
                     minus = energy(solution.displacement - du, solution.of_tips - dc);
        EXPECT_NEAR(plus, minus, 1e-9 * (plus + minus));
        EXPECT_GT(plus, least);
      }
    }
  }
}

TEST(TipFunctions, KFromTheirCoefficients) {
  const auto [specimen, sheet, constraints] = made("williams_mode_1", "delaunay", 20, 1);
  const TipFunctions functions(sheet);
  ASSERT_EQ(functions.tips().size(), 1u);
  // The displacements of Williams, as coefficients in their frame.
  const double k1 = 1.7, k2 = -0.6, mu = sheet_material.mu(), kappa = sheet_material.kappa();
  const ElasticField exact = williams_field(sheet_material, {specimen.origin, specimen.angle}, {k1, k2});
  const double factor = 1 / (2 * mu * sqrt(2 * pi));
  const std::array<Eigen::Vector2d, 4> local{
      {{k2 * (kappa + 1), k1 * (kappa + 1)}, {k1 * (kappa - 1), k2 * (1 - kappa)}, {k1, k2}, {k2, -k1}}};
  const Eigen::Rotation2Dd turn(specimen.angle);
  Eigen::VectorXd c(8);
  for (Eigen::Index j = 0; j < 4; ++j) c.segment<2>(2 * j) = factor * (turn * local[to_size(j)]);
  for (std::size_t slot = 0; slot < sheet.triangle_slots(); ++slot)
    for (const auto& reach : functions.reaching(TriangleIndex(slot))) {
      const auto corners = sheet.corners(TriangleIndex(slot));
      const Point2 p = 1.0 / 3 * (corners[0] + corners[1] + corners[2]);
      const double s = sqrt(squared_length(p - functions.tips()[reach.tip].at)) / functions.tips()[reach.tip].radius;
      const Eigen::Vector2d expected = std::pow(std::max(0.0, 1 - s), 2) * exact.displacement(p);
      EXPECT_LT((functions.displacement(TriangleIndex(slot), p, c).value - expected).norm(), 1e-9 * factor);
    }
  const Tip tip{specimen.origin, specimen.angle};
  const auto found = intensity_of_coefficients(functions, c, tip, sheet_material, 0.01);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->k1, k1, 1e-12);
  EXPECT_NEAR(found->k2, k2, 1e-12);
  EXPECT_FALSE(intensity_of_coefficients(functions, c, {specimen.origin + Point2{0.1, 0}}, sheet_material, 0.01));
}

double error_of(const Answer& answer, const std::string& name) { return measure_of(answer, name).error; }

/// The exact near field held on the border: the functions leave a small part of the error, for K from either source.
TEST(TipFunctions, ReproduceTheFieldAtATip) {
  for (const std::string mode : {"1", "2"})
    for (const std::string method : {"conventional_split", "warp_and_refine", "cut_polygons"})
      for (std::size_t index = 0; index < 4; ++index) {
        SCOPED_TRACE("mode " + mode + ' ' + method + ' ' + std::to_string(index));
        const Problem& problem = find_problem("williams_mode_" + mode);
        const auto [specimen, sheet, constraints] = made("williams_mode_" + mode, "delaunay", 40, index, method);
        const std::array<Budget, 2> budgets{Budget{}, with_tips()};
        const auto answers = problem.answer(specimen, sheet, budgets, constraints);
        ASSERT_EQ(answers[1].verdict, Verdict::ok);
        EXPECT_EQ(answers[1].unknowns, answers[0].unknowns + 8);
        EXPECT_LT(error_of(answers[1], "energy_norm"), 0.6 * error_of(answers[0], "energy_norm"));
        // The linear functions take over part of the opening, polygons at the tip more of it.
        EXPECT_LT(error_of(answers[1], "tip_k" + mode), method == "cut_polygons" ? 0.4 : 0.15);
        EXPECT_LT(error_of(answers[1], "k" + mode), 0.01);
      }
}

/// Of the energy, in h: 1 without.
TEST(TipFunctions, TheRateOfConvergenceIsBetter) {
  for (const auto& [problem, measure, power] :
       {std::tuple<std::string, std::string, int>{"centre_crack", "released_energy", 1},
        {"inclined_crack", "released_energy", 1},
        {"arc_crack_60", "released_energy", 1},
        {"edge_crack_50", "released_energy", 1},
        {"williams_mode_1", "energy_norm", 2},
        {"williams_mode_2", "energy_norm", 2}}) {
    double off[2] = {0, 0}, on[2] = {0, 0};
    for (int level = 0; level < 2; ++level)
      for (std::size_t index = 0; index < 4; ++index) {
        const auto [specimen, sheet, constraints] = made(problem, "delaunay", 24 << level, index);
        const std::array<Budget, 2> budgets{Budget{}, with_tips()};
        const auto answers = find_problem(problem).answer(specimen, sheet, budgets);
        off[level] += std::pow(error_of(answers[0], measure), power);
        on[level] += std::pow(error_of(answers[1], measure), power);
      }
    EXPECT_LT(std::log2(off[0] / off[1]), 1.2) << problem;
    EXPECT_GT(std::log2(on[0] / on[1]), 1.4) << problem;
    EXPECT_LT(on[1], 0.4 * off[1]) << problem;
  }
}

TEST(TipFunctions, AStressAlongTheCutStaysExact) {
  for (const std::string family : sheet_families())
    for (std::size_t index = 0; index < 4; ++index) {
      const Problem& problem = find_problem("parallel_stress");
      const auto [specimen, sheet, constraints] = made("parallel_stress", family, 16, index);
      const Budget budget = with_tips();
      const Answer answer = problem.answer(specimen, sheet, {&budget, 1}).front();
      EXPECT_EQ(answer.verdict, Verdict::ok);
      EXPECT_LT(error_of(answer, "energy_norm"), 1e-5);
    }
}

TEST(TipFunctions, AreRefusedWhereTheyHaveNoPlace) {
  const auto reason = [](const std::string& problem_name, const std::string& method) {
    const Problem& problem = find_problem(problem_name);
    const auto [specimen, sheet, constraints] = made(problem_name, "grid", 12, 0, method);
    const std::array<Budget, 2> budgets{Budget{}, with_tips()};
    const auto answers = problem.answer(specimen, sheet, budgets, constraints);
    EXPECT_FALSE(answers[0].refused);
    EXPECT_FALSE(answers[0].measures.empty());
    EXPECT_EQ(answers[1].refused, answers[1].measures.empty());
    return answers[1].reason;
  };
  EXPECT_EQ(reason("centre_crack", "conventional_split"), "");
  EXPECT_NE(reason("centre_crack", "phantom_node").find("constrains"), std::string::npos);
  EXPECT_NE(reason("centre_crack", "split_and_tie").find("constrains"), std::string::npos);
  EXPECT_NE(reason("centre_crack", "element_deletion").find("no incision ends"), std::string::npos);
  EXPECT_NE(reason("kirsch_hole", "conventional_split").find("no incision ends"), std::string::npos);
}

}  // namespace
}  // namespace cutbench
