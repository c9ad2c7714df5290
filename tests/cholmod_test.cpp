// What only CHOLMOD's factor does: not in a build without it.
#include <gtest/gtest.h>

#include <filesystem>
#include <iterator>

#include "harness/base/conversions.h"
#include "harness/base/random.h"
#include "harness/fem/linear/cholmod_factor.h"
#include "tests/fem_helpers.h"
#include "tests/linear_systems.h"
#include "tests/random_field.h"

namespace cutbench {
namespace {

TEST(Cholmod, StartsNoThreads) {
  const auto threads = [] {
    const auto tasks = std::filesystem::directory_iterator("/proc/self/task");
    return std::distance(begin(tasks), end(tasks));
  };
  const auto before = threads();
  Random random(4);
  System<3> system;
  system.blocks = random_matrix(random, 14, 7, 3);  // large dense fronts, which it splits among threads
  system.held.resize(to_size(system.blocks.rows()));
  const Field b = random_field(5, system.blocks.rows());
  EXPECT_TRUE(solved<3>({.name = "cholmod"}, system, b).report.converged);
  EXPECT_EQ(threads(), before);
}

/// The order of elimination follows the cuts for as long as the factor stays sparse.
TEST(Cholmod, ExtendedOrderIsSeldomMadeAnew) {
  CholmodFactor<3> kept(FactorOrder::extended), anew(FactorOrder::anew);
  const Material skin{.density = 2.2, .stiffness = 1000, .poisson = 0.45, .bending = 4.2e-4};
  Body<3> body(make_sheet("delaunay", 24), skin, {.bending = BendingKind::patches}, {{.where = {{-1, -1}, {1e-9, 2}}}});
  const std::vector<Curve> cuts{line({0.2, 0.31}, {0.9, 0.52}), line({0.5, 0.1}, {0.61, 0.93}),
                                polygon({{0.22, 0.63}, {0.41, 0.64}, {0.33, 0.81}})};
  for (const Curve& curve : cuts) {
    body.cut(curve, "conventional_split");
    body.model.rotate(body.model.positions(body.sheet));
    body.model.assemble(1, 1e-4);
    const SystemMatrix<3> a = body.model.system();
    ASSERT_TRUE(kept.factor(a));
    ASSERT_TRUE(anew.factor(a));
  }
  EXPECT_LT(kept.new_orders(), cuts.size());
  EXPECT_EQ(anew.new_orders(), cuts.size());
}

}  // namespace
}  // namespace cutbench
