// Plates that bend like beams: clamped, supported, and slit lengthwise.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/fem/elements/bending.h"
#include "harness/mesh/families.h"
#include "methods/registry.h"
#include "tests/bending_helpers.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

Field uniform_load(const Sheet& sheet) {
  Field load = Field::Zero(to_index(sheet.deformed_slots()));
  for_each_triangle(sheet, [&](const Triangle& t, const auto& c) {
    for (const DeformedIndex d : t.deformed) load[to_index(d())] += area(c) / 3;
  });
  return load;
}

/// Under a load of 1 N/m2, D = 1 N m, nu = 0; the vertices in `holds` are held at f.
Field bent(const Sheet& sheet, const std::function<bool(Point2)>& holds, const std::function<double(Point2)>& f) {
  const Bending bending(sheet, BendingKind::patches, 1, 0);
  std::vector<bool> held;
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d) {
    const VertexIndex v = sheet.rest_vertex(DeformedIndex(d));
    held.push_back(v.valid() && holds(sheet.rest(v)));
  }
  return equilibrium(sheet, bending.matrix(), held, sampled(sheet, f), uniform_load(sheet));
}

double mean_at(const Sheet& sheet, const Field& z, double x) {
  double sum = 0, n = 0;
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d)
    if (const VertexIndex v = sheet.rest_vertex(DeformedIndex(d)); v.valid() && sheet.rest(v).x == x) {
      sum += z[to_index(d)];
      ++n;
    }
  return sum / n;
}

/// Deflection of a beam clamped at x = 0, free at x = 1.
double cantilever(Point2 p) { return p.x * p.x * (p.x * p.x - 4 * p.x + 6) / 24; }

/// Tip over beam theory, the first two rows of vertices held on the exact deflection.
double tip(const Sheet& sheet, int n) {
  return 8 * mean_at(sheet,
                     bent(
                         sheet, [=](Point2 p) { return p.x < 1.2 / n; }, cantilever),
                     1);
}

TEST(Bending, ACantileverBendsLikeABeam) {
  const double at_least[] = {0.9, 0.94, 0.965};
  for (const std::string family : sheet_families()) {
    double before = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const int n = 10 << i;
      const double now = tip(Sheet(make_sheet(family, n)), n);
      std::printf("cantilever, %s %d: tip %.4f of the beam's\n", family.c_str(), n, now);
      EXPECT_GT(now, std::max(at_least[i], before));
      EXPECT_LT(now, 1);
      before = now;
    }
  }
}

/// Held over more than two rows the error is of second order; the clamp lies between the last two of them, half a row
/// behind the last. (Two rows alone, at the border: first order.)
TEST(Bending, AClampOfSeveralRowsLiesBetweenTheLastTwo) {
  for (const std::string family : {"grid", "alternating"})
    for (int n : {10, 20, 40}) {
      const Sheet sheet(make_sheet(family, n));
      const double held = 0.2, length = 1 - held + 0.5 / n;
      const auto clamped = [=](double x) {
        return 8 / std::pow(length, 4) *
               mean_at(sheet,
                       bent(
                           sheet, [=](Point2 p) { return p.x < x + 1e-9; }, [](Point2) { return 0.0; }),
                       1);
      };
      std::printf("clamped up to 0.2, %s %d: tip %.4f of the beam's; two rows alone, no shift: %.4f\n", family.c_str(),
                  n, clamped(held), clamped(1.0 / n) * std::pow(length, 4));
      EXPECT_NEAR(clamped(held), 1, 0.6 / (n * n));
    }
}

/// Beam on two supports: free edges all round, as moments vanish over the supports.
TEST(Bending, ASupportedPlateBendsLikeABeam) {
  for (const std::string family : {"grid", "alternating"})
    for (int n : {10, 20, 40}) {
      const Sheet sheet(make_sheet(family, n));
      const Field z = bent(
          sheet, [](Point2 p) { return p.x == 0 || p.x == 1; }, [](Point2) { return 0.0; });
      EXPECT_NEAR(mean_at(sheet, z, 0.5) * 384 / 5, 1, 0.6 / (n * n)) << family << n;
    }
}

TEST(Bending, ASlitLengthwiseCostsNothing) {
  for (const MethodRow& row : whole_sheet_methods())
    for (const std::string family : {"grid", "alternating", "delaunay"}) {
      const int n = 20;
      Sheet sheet(make_sheet(family, n));
      const double whole = tip(sheet, n);
      Locator locator(sheet);
      const double y = 0.5 + 0.3 / n;
      const CutOutcome outcome = Cutter().cut(sheet, locator, {Curve::Kind::polyline, false, {{0.33, y}, {1.1, y}}},
                                              *row.make(row.parameter.value), {});
      ASSERT_EQ(outcome.status, Status::ok);
      // Where it may wander, it is not quite lengthwise; and another mesh bends otherwise by its own error.
      const bool is_exact = row.promises.exact_incision, same_mesh = row.promises.keeps_vertices;
      EXPECT_NEAR(tip(sheet, n) / whole, 1, !is_exact ? 5e-3 : same_mesh ? 1e-3 : 2e-2) << row.name << ", " << family;
    }
}

}  // namespace
}  // namespace cutbench
