// The one problem in motion with an exact answer: its exact solution by modes, and what cut sheets make of it.

#include "harness/problems/in_motion/severed_strip.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <numbers>

#include "tests/truth_helpers.h"

namespace cutbench {
namespace {

constexpr double pi = std::numbers::pi;

double error_of(const Problem& problem, const Specimen& specimen, const Sheet& sheet, const std::string& measure) {
  return measure_of(solved(problem, specimen, sheet), measure).error;
}

/// Modes of a bar clamped at 0 and free at L: sin(k x), k = (2 m + 1) pi / 2 L; the stretch eps x at t = 0 has the
/// coefficients 2 eps (-1)^m / L k^2.
TEST(SeveredStrip, TheLipMovesAsTheSumOfItsModes) {
  for (const double length : {0.3, 1.0})
    for (double time = 0; time < 9 * length; time += 0.0371) {
      double sum = 0;
      for (int m = 0; m < 20000; ++m) {
        const double k = (2 * m + 1) * pi / 2 / length;
        sum += 2 * 0.1 / (length * k * k) * std::cos(k * time);  // sin(k L) = (-1)^m
      }
      EXPECT_NEAR(released_end(0.1, length, time), sum, 1e-5 * length) << time;
    }
}

/// A kink of the triangle wave is smeared over t^1/3 h^2/3 by the dispersion of the midpoint rule and the lumped mass,
/// and over (t h)^1/2 by the damping of backward Euler, where the displacement is wrong by c times that: root mean
/// squares go like h and, in the limit, h^3/4.
TEST(SeveredStrip, ErrorsOfTheFittedMeshFallAtTheRateOfTheIntegrator) {
  struct Case {
    Integrator integrator;
    double rate, last;
  };
  for (const auto& [integrator, rate, last] :
       {Case{Integrator::midpoint, 0.75, 0.03}, Case{Integrator::backward_euler, 0.45, 0.25}}) {
    const auto problem = severed_strip(integrator);
    SCOPED_TRACE(problem->name());
    double before = 0;
    for (const int n : {8, 16, 32}) {
      const Specimen specimen = problem->specimen("grid", n, 1, 1);
      const double error = error_of(*problem, specimen, body_fitted(specimen), "lip_motion");
      if (n > 8) {
        EXPECT_GT(std::log2(before / error), rate) << n;
      }
      before = error;
    }
    EXPECT_LT(before, last);
  }
}

/// Backward Euler takes the energy of a mode with angular frequency w to 1 / (1 + w^2 h^2) of it in each step; mode m
/// of the stretched bar has 8 / (pi (2 m + 1))^2 of its energy, and a bar energy as its length.
TEST(SeveredStrip, BackwardEulerDampsTheModesOfABar) {
  constexpr int n = 24;
  for (const double step : {1.0, 0.5, 0.25}) {
    const auto problem = severed_strip(Integrator::backward_euler, step);
    const Specimen specimen = problem->specimen("delaunay", n, 1, 1);
    const double cut = specimen.origin.x, h = step / n;
    double kept = 0;
    for (const double length : {cut, 1 - cut})
      for (int m = 0; m < 2000; ++m) {
        const double w = (2 * m + 1) * pi / 2 / length, share = 8 / std::pow(pi * (2 * m + 1), 2);
        kept += length * share * std::pow(1 + w * w * h * h, -std::ceil(4 * std::max(cut, 1 - cut) / h));
      }
    const Answer answer = solved(*problem, specimen, body_fitted(specimen));
    EXPECT_NEAR(measure_of(answer, "energy_kept").value, kept, 0.02 * kept) << step;
  }
}

TEST(SeveredStrip, TheMidpointRuleKeepsTheEnergyOnSlivers) {
  const auto problem = severed_strip(Integrator::midpoint);
  for (std::size_t index = 0; index < 4; ++index) {
    const Specimen specimen = problem->specimen("alternating", 10, 1, index);
    EXPECT_LT(error_of(*problem, specimen, cut_by(specimen, "conventional_split"), "energy_kept"), 1e-8);
  }
}

TEST(SeveredStrip, SpeedAndArrivalAreThoseOfAWave) {
  const auto problem = severed_strip(Integrator::midpoint);
  const Specimen specimen = problem->specimen("grid", 32, 1, 1);
  const Answer answer = solved(*problem, specimen, cut_by(specimen, "conventional_split"));
  EXPECT_LT(measure_of(answer, "lip_speed").error, 0.02);
  EXPECT_LT(measure_of(answer, "arrival").error, 0.05);
}

TEST(SeveredStrip, WrongCutsHaveLargerErrors) {
  const auto problem = severed_strip(Integrator::midpoint);
  Specimen specimen = problem->specimen("grid", 16, 1, 1);
  const double right = error_of(*problem, specimen, cut_by(specimen, "conventional_split"), "lip_motion");
  EXPECT_GT(error_of(*problem, specimen, cut_by(specimen, "element_deletion"), "lip_motion"), 1.2 * right);
  // Half of the left bar is torn, too.
  specimen.cuts.push_back({Curve::Kind::polyline, false, {{0.21, -0.1}, {0.21, 0.5}}});
  EXPECT_GT(error_of(*problem, specimen, cut_by(specimen, "conventional_split"), "lip_motion"), 3 * right);
  // The cut does not reach the other side.
  specimen.cuts = {{Curve::Kind::polyline, false, {{0.51, -0.1}, {0.51, 0.9}}}};
  const Budget direct;
  EXPECT_EQ(problem->answer(specimen, cut_by(specimen, "conventional_split"), {&direct, 1}).front().verdict,
            Verdict::not_severed);
}

/// A path on a column of vertices cuts through no triangle: what it errs by beyond the fitted mesh is due to the sheet.
TEST(SeveredStrip, SliversDoNotShowAndAMovedPathDoes) {
  const auto problem = severed_strip(Integrator::midpoint);
  constexpr int n = 30;
  for (const char* family : {"grid", "alternating"})
    for (const double off : {0.0, 1e-5, 1e-3, 0.1, 0.3, 0.5}) {
      Specimen specimen = problem->specimen(family, n, 1, 1);
      const double a = (15 + off) / n;
      specimen.origin = {a, 0};
      specimen.cuts = {{Curve::Kind::polyline, false, {{a, -0.1}, {a, 1.1}}}};
      const double fitted = error_of(*problem, specimen, body_fitted(specimen), "lip_motion");
      const double split = error_of(*problem, specimen, cut_by(specimen, "conventional_split"), "lip_motion");
      const double released = error_of(*problem, specimen, cut_by(specimen, "edge_release"), "lip_motion");
      std::cout << family << ", " << off << " squares from a column: conventional_split " << 100 * (split / fitted - 1)
                << " %, edge_release " << 100 * (released / fitted - 1) << " % over the fitted mesh\n";
      EXPECT_LT(split, 1.1 * fitted) << off;
      if (off < 0.01) {
        EXPECT_NEAR(released, split, 0.01 * split) << off;
      }
      if (off > 0.2) {
        EXPECT_GT(released, 1.5 * split) << off;
      }
    }
}

}  // namespace
}  // namespace cutbench
