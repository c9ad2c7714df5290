// A plate with a hole, and with a cut in it: the exact shapes by differences, and the rates of their errors.

#include "harness/problems/out_of_plane/bent_plate.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <map>

#include "tests/truth_helpers.h"

namespace cutbench {
namespace {

using Polar = std::function<double(double r, double angle)>;

double laplacian(const Polar& w, double r, double p, double step) {
  const double rr = (w(r + step, p) - 2 * w(r, p) + w(r - step, p)) / (step * step),
               by_r = (w(r + step, p) - w(r - step, p)) / (2 * step * r),
               pp = (w(r, p + step) - 2 * w(r, p) + w(r, p - step)) / (step * step * r * r);
  return rr + by_r + pp;
}

/// The laws of a plate: its Laplacian is harmonic.
void expect_a_plate(const Polar& w, double r, double p) {
  constexpr double step = 2e-3;
  const Polar first = [&](double s, double t) { return laplacian(w, s, t, step); };
  EXPECT_NEAR(laplacian(first, r, p, 2e-2), 0, 2e-2) << r << ' ' << p;
}

TEST(BentPlate, AHoleAsInTheBooks) {
  constexpr double poisson = 0.3, a = 0.2, step = 1e-4;
  const Polar w = [=](double r, double p) { return bent_hole(std::polar(r, p), 1, a, poisson); };
  for (double p = 0.1; p < 6; p += 0.5) {
    expect_a_plate(w, 0.5, p);
    // At the rim no moment, and no force of Kirchhoff's.
    const auto rr = [&](double r, double t) { return (w(r + step, t) - 2 * w(r, t) + w(r - step, t)) / (step * step); };
    const auto hoop = [&](double r, double t) {
      return (w(r + step, t) - w(r - step, t)) / (2 * step * r) +
             (w(r, t + step) - 2 * w(r, t) + w(r, t - step)) / (step * step * r * r);
    };
    EXPECT_NEAR(rr(a, p) + poisson * hoop(a, p), 0, 1e-5);
    constexpr double wide = 4e-3;
    const auto twist = [&](double r, double t) {
      const auto slope = [&](double s) { return (w(s, t + wide) - w(s, t - wide)) / (2 * wide) / s; };
      return (slope(r + wide) - slope(r - wide)) / (2 * wide);
    };
    const double sum = (laplacian(w, a + wide, p, 1e-3) - laplacian(w, a - wide, p, 1e-3)) / (2 * wide) +
                       (1 - poisson) * (twist(a, p + wide) - twist(a, p - wide)) / (2 * wide) / a;
    EXPECT_NEAR(sum, 0, 2e-2);
  }
  // Goodier: the moment along the rim is largest across the bending, (5 + 3 nu) / (3 + nu) of what it is far away.
  const auto moment = [&](double p) {
    const double hoop = (w(a + step, p) - w(a - step, p)) / (2 * step * a) +
                        (w(a, p + step) - 2 * w(a, p) + w(a, p - step)) / (step * step * a * a);
    const double radial = (w(a + step, p) - 2 * w(a, p) + w(a - step, p)) / (step * step);
    return hoop + poisson * radial;
  };
  // The cylinder far away is M_x = D k and M_y = nu D k: two bendings at right angles.
  const double across = (5 + 3 * poisson) / (3 + poisson), along = (1 - poisson) / (3 + poisson);
  EXPECT_NEAR(moment(std::numbers::pi / 2), across + poisson * along, 1e-4);
  EXPECT_NEAR(moment(0), along + poisson * across, 1e-4);
  EXPECT_NEAR(bent_hole({30, 0}, 1, a, poisson), 450, 1);
}

TEST(BentPlate, TheEndOfACutAsInTheBooks) {
  constexpr double poisson = 0.3, step = 1e-4;
  const Polar w = [](double r, double p) { return bent_crack(r, p, poisson); };
  for (double p = -3; p < 3.1; p += 0.5) expect_a_plate(w, 0.5, p);
  for (const double p : {std::numbers::pi, -std::numbers::pi}) {
    const double r = 0.4;
    const double rr = (w(r + step, p) - 2 * w(r, p) + w(r - step, p)) / (step * step);
    const double pp = (w(r, p + step) - 2 * w(r, p) + w(r, p - step)) / (step * step * r * r);
    EXPECT_NEAR((w(r + step, p) - w(r - step, p)) / (2 * step * r) + pp + poisson * rr, 0, 1e-5);
    constexpr double wide = 2e-3;
    const auto twist = [&](double s) {
      const auto over = [&](double q) { return (w(q, p + wide) - w(q, p - wide)) / (2 * wide) / q; };
      return (over(s + wide) - over(s - wide)) / (2 * wide);
    };
    const double shear = (laplacian(w, r, p + wide, 1e-3) - laplacian(w, r, p - wide, 1e-3)) / (2 * wide) / r;
    EXPECT_NEAR(shear + (1 - poisson) * (twist(r + wide) - twist(r - wide)) / (2 * wide), 0, 1e-3);
  }
}

/// Errors over three sizes: the rate of a mesh that fits the cut.
TEST(BentPlate, ConvergesOnAFittedMesh) {
  for (const auto cut : {BentPlate::Cut::hole, BentPlate::Cut::crack}) {
    const BentPlate problem(cut);
    std::map<std::string, std::array<double, 3>> error;
    for (int level = 0; level < 3; ++level)
      for (std::size_t i = 0; i < 2; ++i) {
        const Specimen specimen = problem.specimen("delaunay", 16 << level, 1, i);
        for (const Measure& m : solved(problem, specimen, body_fitted(specimen)).measures)
          error[m.name][to_size(level)] += m.error / 2;
      }
    for (const auto& [name, of] : error)
      std::cout << problem.name() << ' ' << name << ' ' << of[0] << ' ' << of[1] << ' ' << of[2] << ", rate "
                << std::log2(of[0] / of[2]) / 2 << '\n';
    EXPECT_GT(std::log2(error["energy_norm"][0] / error["energy_norm"][2]) / 2, 0.4);
    EXPECT_GT(std::log2(error["deflection_l2"][0] / error["deflection_l2"][2]) / 2, 0.8);
  }
}

}  // namespace
}  // namespace cutbench
