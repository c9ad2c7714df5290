// The energy of cylinders, saddles and domes: by patches as the plate's, by hinges as the mesh has it. Patch tests.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "harness/fem/elements/bending.h"
#include "harness/mesh/families.h"
#include "tests/bending_helpers.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

constexpr double directions[] = {0, 30, 45, 90, 135};  // degrees, of the axis of the cylinder

bool separates(const Triangle& t, std::size_t k) { return !t.opposite[k].valid() || t.mark[k] == EdgeMark::incision; }

/// Edges from the border and the incisions, per deformed vertex, up to `most`.
std::vector<int> rings(const Sheet& sheet, int most) {
  std::vector<int> ring(sheet.deformed_slots(), most);
  for_each_triangle(sheet, [&](const Triangle& t, const auto&) {
    for (std::size_t k = 0; k < 3; ++k)
      if (separates(t, k)) ring[t.deformed[k]()] = ring[t.deformed[(k + 1) % 3]()] = 0;
  });
  for (int r = 1; r < most; ++r) {
    const auto before = ring;
    for_each_triangle(sheet, [&](const Triangle& t, const auto&) {
      for (const DeformedIndex d : t.deformed)
        for (const DeformedIndex other : t.deformed)
          if (before[other()] == r - 1) ring[d()] = std::min(ring[d()], r);
    });
  }
  return ring;
}

/// Area of the triangles all three of whose corners lie on the border or an incision. In a strip one triangle wide
/// these are on two lines, where no vertex tells how the strip is curved across.
double blind_area(const Sheet& sheet) {
  const auto ring = rings(sheet, 1);
  double sum = 0;
  for_each_triangle(sheet, [&](const Triangle& t, const auto& c) {
    const auto& d = t.deformed;
    if (ring[d[0]()] == 0 && ring[d[1]()] == 0 && ring[d[2]()] == 0) sum += area(c);
  });
  return sum;
}

/// Of a cylinder of curvature 2 on the unit square; Poisson's ratio drops out: (1 - nu) k^2 + nu k^2.
constexpr double exact = rigidity / 2 * 4;

TEST(Bending, CylindersAreExactWhateverTheMesh) {
  for (const std::string family : sheet_families())
    for (int n : {3, 10, 40}) {
      SCOPED_TRACE(family + " " + std::to_string(n));
      const Sheet sheet(make_sheet(family, n));
      const Bending bending = patches(sheet);
      for (double degrees : directions) {
        const Field z = cylinder(sheet, degrees, 2);
        EXPECT_NEAR(bending.energy(z, 1) / exact, 1, 1e-12);
        EXPECT_NEAR(form(bending.matrix(), z) / exact, 1, 1e-9);
      }
    }
}

/// Also a saddle and a dome, where Poisson's ratio counts.
TEST(Bending, SaddlesAndDomesAreExact) {
  const Sheet sheet(make_sheet("delaunay", 12));
  const Bending bending = patches(sheet);
  const auto energy = [&](double xx, double xy, double yy) {
    return bending.energy(
        sampled(sheet, [=](Point2 p) { return xx / 2 * p.x * p.x + xy * p.x * p.y + yy / 2 * p.y * p.y; }), 1);
  };
  EXPECT_NEAR(energy(1, 0, 1), rigidity * (1 + poisson), 1e-12);
  EXPECT_NEAR(energy(1, 0, -1), rigidity * (1 - poisson), 1e-12);
  EXPECT_NEAR(energy(0, 1, 0), rigidity * (1 - poisson), 1e-12);
}

/// The same for a cut with triangles no thinner than 0.1 h, to 2 %. Thinner ones, and hinges, are written down.
TEST(Bending, CylindersSurviveACut) {
  struct Range {
    std::size_t cuts = 0;
    double patches = 0, hinges = 0;  // largest relative error; largest ratio over the uncut sheet's
  };
  std::map<std::pair<std::string, double>, Range> ranges;
  std::map<std::string, double> hinge_before;
  for (const std::string family : sheet_families()) {
    const Sheet sheet(make_sheet(family, 10));
    for (double degrees : directions)
      hinge_before[family + std::to_string(degrees)] = hinges(sheet).energy(cylinder(sheet, degrees, 2), 1);
  }
  for (const Cut& cut : cut_sheets(10, scaled(3))) {
    SCOPED_TRACE(cut.name);
    const double altitude = smallest_altitude(cut.sheet);
    const double from = altitude >= 0.1 ? 0.1 : altitude >= 0.01 ? 0.01 : altitude >= 1e-3 ? 1e-3 : 0;
    Range& range = ranges[{cut.method, from}];
    ++range.cuts;
    const Bending bending = patches(cut.sheet), hinged = hinges(cut.sheet);
    const double blind = blind_area(cut.sheet);
    for (double degrees : directions) {
      const Field z = cylinder(cut.sheet, degrees, 2);
      const double error = bending.energy(z, 1) / exact - 1;
      if (from == 0.1) {
        EXPECT_LE(error, 0.02);  // adaptive_remesh, fine at tips: 1.5 %
        EXPECT_GE(error, -0.01 - blind);
      }
      range.patches = std::max(range.patches, std::abs(error));
      for (const std::string family : sheet_families())
        if (cut.name.find(family) != std::string::npos)
          range.hinges = std::max(range.hinges, hinged.energy(z, 1) / hinge_before[family + std::to_string(degrees)]);
    }
  }
  for (const auto& [key, range] : ranges)
    std::printf("cylinder after %s, smallest altitude >= %g h, %zu cuts: patches off by at most %.2e, hinges x %.3g\n",
                key.first.c_str(), key.second, range.cuts, range.patches, range.hinges);
}

/// Energy of a cylinder whose outer rings are held, the rest free, over the exact one. Two rings beside the border: no
/// rule that is exact up to the border can do with fewer, as it takes three rows of vertices to see the curvature
/// there.
double relaxed(const Sheet& sheet, const Bending& bending, double degrees) {
  const auto ring = rings(sheet, 3);
  std::vector<bool> held;
  for (int r : ring) held.push_back(r < 3);
  const Field z = cylinder(sheet, degrees, 2);
  const Field x = equilibrium(sheet, bending.matrix(), held, z, Field::Zero(z.size()));
  return bending.energy(x, 1) / exact;
}

TEST(Bending, PassesThePatchTest) {
  for (const std::string family : sheet_families())
    for (int n : {10, 40}) {
      SCOPED_TRACE(family + " " + std::to_string(n));
      const Sheet sheet(make_sheet(family, n));
      const Bending bending = patches(sheet);
      for (double degrees : directions) EXPECT_NEAR(relaxed(sheet, bending, degrees), 1, 1e-6);
    }
  std::map<std::pair<std::string, double>, double> worst;
  for (const Cut& cut : cut_sheets(14, 1)) {
    const double altitude = smallest_altitude(cut.sheet), from = altitude >= 0.1 ? 0.1 : altitude >= 0.01 ? 0.01 : 0;
    double& error = worst[{cut.method, from}];
    error = std::max(error, std::abs(relaxed(cut.sheet, patches(cut.sheet), 30) - 1));
  }
  for (const auto& [key, error] : worst)
    std::printf("patch test after %s, smallest altitude >= %g h: off by at most %.2e\n", key.first.c_str(), key.second,
                error);
}

/// What they are there to show.
TEST(Bending, HingesDependOnTheMesh) {
  std::map<std::string, std::pair<double, double>> extremes;
  for (const std::string family : sheet_families()) {
    const Sheet sheet(make_sheet(family, 40));
    const Bending bending = hinges(sheet);
    auto& [low, high] = extremes[family] = {infinite, 0};
    for (double degrees : directions) {
      const double ratio = bending.energy(cylinder(sheet, degrees, 2), 1) / exact;
      low = std::min(low, ratio);
      high = std::max(high, ratio);
      std::printf("hinges, %s, axis at %g degrees: %.3f of the plate's energy\n", family.c_str(), degrees, ratio);
    }
  }
  EXPECT_GT(extremes["grid"].second, 2 * extremes["grid"].first);
  // Axis along an edge of the grid, and along its diagonals: 3 and 9 as the mesh is refined.
  EXPECT_NEAR(extremes["grid"].second, 9, 0.2);
}

}  // namespace
}  // namespace cutbench
