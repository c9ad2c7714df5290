// Problems with exact answers, and what the harness computes beside them. Rates and extrapolated values say that the
// code is right, not that a method is good.

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <map>
#include <numbers>

#include "harness/base/conversions.h"
#include "harness/base/errors.h"
#include "harness/mesh/families.h"
#include "harness/mesh/quality.h"
#include "harness/problems/common/exact_fields.h"
#include "tests/truth_helpers.h"

namespace cutbench {
namespace {

constexpr double pi = std::numbers::pi;

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
    if (problem->takes_budgets()) {
      budgets.push_back({{.name = "cg"}, 5});
      budgets.push_back({{.name = "cg_sliver_blocks"}, 400});
    }
    const auto answers = problem->answer(a, sheet, budgets);
    ASSERT_EQ(answers.size(), budgets.size());
    for (std::size_t i = 0; i < answers.size(); ++i) {
      EXPECT_EQ(answers[i].verdict, Verdict::ok);
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
        // A sheet meshed anew has triangles as flat elsewhere, too.
        EXPECT_LE(measure_of(answer, "stress").error, (row.promises.keeps_vertices ? 1e-13 : 1e-12) * worst);
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
  const bool fitted = method == "body_fitted" || method == "graded_at_tips";
  const std::size_t members = fitted ? 2 : 4;  // those meshes hardly differ
  std::map<std::string, Series> all;
  for (int level = 0; level < 3; ++level)
    for (std::size_t index = 0; index < members; ++index) {
      const Specimen specimen = problem.specimen(family, coarsest << level, 1, index);
      for (const Measure& m : solved(problem, specimen, cut_by(specimen, method)).measures) {
        all[m.name].error[level] += m.error / to_double(members);
        if (m.exact != 0) all[m.name].ratio[level] += m.value / m.exact / to_double(members);
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
  EXPECT_NEAR(all["k1"].extrapolated(), 1, 0.005);
  EXPECT_NEAR(all["k2"].extrapolated(), 1, 0.04);  // a small part of both
}

TEST_P(Converges, EdgeCrack) {
  auto all = series("edge_crack_50", 24);
  EXPECT_NEAR(all["opening"].rate(), 1, 0.2);
  EXPECT_NEAR(all["k1"].extrapolated(), 1, 0.01);
  EXPECT_NEAR(all["released_energy"].extrapolated(), 1, 0.02);  // few members on small sheets
}

TEST_P(Converges, Hole) {
  auto all = series("kirsch_hole");
  EXPECT_NEAR(all["energy_norm"].rate(), 1, 0.15);
  EXPECT_GE(all["rim_stress"].rate(), 0.6);
}

TEST_P(Converges, CollinearCracks) {
  for (const std::string count : {"2", "3"}) {
    auto all = series("collinear_cracks_" + count);
    EXPECT_NEAR(all["energy_norm"].rate(), 0.5, 0.1);
    EXPECT_NEAR(all["displacement_l2"].rate(), 1, 0.2);
    EXPECT_NEAR(all["strain_energy"].extrapolated(), 1, 0.005);
    EXPECT_NEAR(all["released_energy"].extrapolated(), 1, 0.03);
  }
}

/// Energy is compared with half of the load times what the lips move.
TEST_P(Converges, LoadedLips) {
  for (const std::string load : {"pressure", "wedge", "sheared"}) {
    auto all = series("loaded_lips_" + load);
    EXPECT_NEAR(all["energy_norm"].rate(), 0.5, 0.1);
    EXPECT_NEAR(all["strain_energy"].rate(), 1, 0.2);
    EXPECT_NEAR(all["strain_energy"].extrapolated(), 1, 0.02);
  }
}

TEST_P(Converges, Corner) {
  // The square of the error is in proportion to h^2 times the integral of r^(2 q - 4), from r = h to 1: that has the
  // rate q at last, and long before, where q is nearly 1, this one.
  const auto rate = [&](const std::string& name, double degrees, bool sliding) {
    auto all = series("corner_" + name);
    const double q = Corner{degrees / 2 * pi / 180, sliding}.exponent(), power = std::pow(1.0 / 32, 2 * q - 2);
    EXPECT_NEAR(all["energy_norm"].rate(), 1 - (1 - q) * power / (power - 1), 0.06) << name;
    EXPECT_NEAR(all["strain_energy"].extrapolated(), 1, 0.005) << name;
  };
  rate("270", 270, false);
  rate("270_sliding", 270, true);
  rate("315", 315, false);
}

TEST_P(Converges, EllipticHole) {
  for (const std::string name : {"2", "2_oblique", "3"}) {
    auto all = series("elliptic_hole_" + name, name == "3" ? 32 : 16);
    EXPECT_NEAR(all["energy_norm"].rate(), 1, 0.2);
    EXPECT_GE(all["rim_stress"].rate(), 0.5);
    EXPECT_NEAR(all["released_energy"].extrapolated(), 1, 0.03);
  }
}

TEST_P(Converges, CrossedCracks) {
  auto all = series("crossed_cracks");
  EXPECT_NEAR(all["energy_norm"].rate(), 0.5, 0.1);
  EXPECT_NEAR(all["displacement_l2"].rate(), 1, 0.2);
  EXPECT_NEAR(all["strain_energy"].extrapolated(), 1, 0.005);
  EXPECT_NEAR(all["k1"].extrapolated(), 1, 0.01);
}

/// A mesh that is small at the tips has the rate of a smooth field in the energy norm, and is better from the start.
TEST(Problems, AGradedMeshHasTheFullRate) {
  for (const std::string name :
       {"centre_crack", "arc_crack_45", "collinear_cracks_3", "loaded_lips_wedge", "crossed_cracks", "corner_270"}) {
    auto graded = series_of(find_problem(name), "grid", "graded_at_tips", 16),
         even = series_of(find_problem(name), "grid", "body_fitted", 16);
    EXPECT_NEAR(graded["energy_norm"].rate(), 1, 0.2) << name;
    EXPECT_LT(graded["energy_norm"].error[2], 0.6 * even["energy_norm"].error[2]) << name;
  }
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

/// A finer and finer graded mesh goes on to the exact gape, where the released energy ends at the fit's error.
TEST(Problems, NoFitLimitsTheGapeOfAnEdgeCrack) {
  auto graded = series_of(find_problem("edge_crack_40"), "grid", "graded_at_tips", 24);
  EXPECT_NEAR(graded["opening"].rate(), 2, 0.4);
  EXPECT_LT(graded["opening"].error[2], 0.006);
}

/// A cut that goes too far, too: its missing energy has the other sign, its gape has none.
TEST(Problems, AnEdgeCrackThatIsTooShortOrTooLongGapesOtherwise) {
  const Problem& problem = find_problem("edge_crack_40");
  const Specimen specimen = problem.specimen("grid", 40, 1, 1);
  const double full = measure_of(solved(problem, specimen, cut_by(specimen, "cgal_cdt")), "opening").error;
  for (const double more : {-0.06, 0.06}) {
    Specimen other = specimen;
    other.cuts.front().points.back().x += more;
    EXPECT_GT(measure_of(solved(problem, specimen, cut_by(other, "cgal_cdt")), "opening").error, 1.5 * full) << more;
  }
}

/// The prescribed displacements jump where the method opened the border, not beside it: no edge of the border is torn.
TEST(Problems, AMovedMouthConvergesToo) {
  for (const std::string method : {"edge_release", "snap_or_split", "vertex_snap", "warp_and_refine"})
    for (const std::string mode : {"1", "2"}) {
      auto all = series_of(find_problem("williams_mode_" + mode), "delaunay", method, 16);
      EXPECT_GT(all["energy_norm"].rate(), 0.3) << method;
      EXPECT_LT(all["energy_norm"].error[2], 0.35) << method;
      EXPECT_NEAR(all["k" + mode].ratio[2], 1, 0.1) << method;
    }
}

/// The same final geometry by one cut and by two.
TEST(Problems, TwoCutsAreAsGoodAsOne) {
  for (const auto& row : whole_sheet_methods()) {
    if (row.name == "edge_release")
      continue;  // the first cut ends at a vertex, which is not where the second one begins
    for (std::size_t index = 0; index < 4; ++index) {
      const Problem &one = find_problem("centre_crack"), &two = find_problem("two_cuts_one_geometry");
      const Specimen a = one.specimen("alternating", 24, 1, index), b = two.specimen("alternating", 24, 1, index);
      const Answer by_one = solved(one, a, cut_by(a, row.name)), by_two = solved(two, b, cut_by(b, row.name));
      EXPECT_NEAR(measure_of(by_two, "released_energy").value, measure_of(by_one, "released_energy").value,
                  (row.promises.keeps_vertices ? 0.02 : 0.05) * measure_of(by_one, "released_energy").exact)
          << row.name << ' ' << index;
    }
  }
}

}  // namespace
}  // namespace cutbench
