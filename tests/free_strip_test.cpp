// A strip cut out of a sheet: the constants of a free beam, and the rates at which its frequency and shape converge.

#include "harness/problems/in_motion/free_strip.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <map>

#include "tests/truth_helpers.h"

namespace cutbench {
namespace {

/// cosh b cos b = 1; no moment and no force at both ends.
TEST(FreeStrip, ABeamAsInTheBooks) {
  double low = 4.5, high = 5;
  for (int i = 0; i < 60; ++i) {
    const double b = (low + high) / 2;
    (std::cosh(b) * std::cos(b) < 1 ? low : high) = b;
  }
  EXPECT_NEAR(low, 4.730040744862704, 1e-12);
  const double ratio = (std::cosh(low) - std::cos(low)) / (std::sinh(low) - std::sin(low));
  EXPECT_NEAR(ratio, 0.982502214576238, 1e-12);
  for (const double s : {0.0, low}) {
    EXPECT_NEAR(std::cosh(s) - std::cos(s) - ratio * (std::sinh(s) - std::sin(s)), 0, 1e-9);
    EXPECT_NEAR(std::sinh(s) + std::sin(s) - ratio * (std::cosh(s) - std::cos(s)), 0, 1e-9);
  }
}

TEST(FreeStrip, Converges) {
  const auto problem = free_strip();
  for (const std::string method : {"body_fitted", "conventional_split"}) {
    std::map<std::string, std::array<double, 3>> error;
    for (int level = 0; level < 3; ++level)
      for (std::size_t i = 0; i < 2; ++i) {
        const Specimen specimen = problem->specimen("delaunay", 16 << level, 1, i);
        for (const Measure& m : solved(*problem, specimen, cut_by(specimen, method)).measures)
          error[m.name][to_size(level)] += m.error / 2;
      }
    for (const auto& [name, of] : error)
      std::cout << method << ' ' << name << ' ' << of[0] << ' ' << of[1] << ' ' << of[2] << ", rate "
                << std::log2(of[0] / of[2]) / 2 << '\n';
    EXPECT_GT(std::log2(error["frequency"][0] / error["frequency"][2]) / 2, 0.8) << method;
    EXPECT_GT(std::log2(error["mode"][0] / error["mode"][2]) / 2, 0.8) << method;
    EXPECT_LT(error["spin"][2], 1e-2) << method;
  }
}

}  // namespace
}  // namespace cutbench
