// The working storage of methods that look at parts of a sheet: what it holds, and that it forgets.

#include "methods/tools/region.h"

#include <gtest/gtest.h>

#include <set>

#include "harness/base/conversions.h"
#include "harness/cut/cut.h"
#include "harness/mesh/families.h"
#include "harness/mesh/stamped_table.h"
#include "methods/registry.h"
#include "methods/tools/forced_wedges.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

TEST(StampedTable, ForgetsWhenCleared) {
  StampedTable<VertexIndex, int> table;
  const VertexIndex a(std::size_t{0}), b(std::size_t{4});
  table.clear(5);
  EXPECT_FALSE(table.holds(a));
  EXPECT_TRUE(table.insert(b, 7));
  EXPECT_FALSE(table.insert(b, 8));
  EXPECT_EQ(table.get(b, -1), 7);
  EXPECT_EQ(table.get(a, -1), -1);
  table.grow(100);
  EXPECT_EQ(table.at(b), 7);
  EXPECT_FALSE(table.holds(VertexIndex(std::size_t{99})));
  table.clear(5);
  EXPECT_FALSE(table.holds(b));
  EXPECT_EQ(table.size(), 100U);
}

/// A ring is what shares an edge; then come the other halves of the grid's squares, whose diagonals see right angles.
TEST(Region, GrowsByRingsAndForgets) {
  const Sheet sheet(make_sheet("grid", 10));
  const auto common_corners = [&](TriangleIndex s, TriangleIndex t) {
    int common = 0;
    for (const VertexIndex v : sheet.triangle(s).vertex)
      for (const VertexIndex w : sheet.triangle(t).vertex) common += v == w;
    return common;
  };
  const auto square = [&](TriangleIndex t) {
    const auto c = sheet.corners(t);
    const Point2 middle = 1.0 / 3 * (c[0] + c[1] + c[2]);
    return 10 * to_int(10 * middle.y) + to_int(10 * middle.x);
  };
  Region region;
  for (const std::size_t start : {0U, 77U, 199U}) {
    region.clear(sheet);
    region.add(TriangleIndex(start));
    region.add(TriangleIndex(start));
    ASSERT_EQ(region.triangles().size(), 1U);
    EXPECT_EQ(region.place_of(TriangleIndex(start)), 0);
    region.grow(sheet, 1);
    std::set<int> squares;
    for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
      if (common_corners(TriangleIndex(start), TriangleIndex(t)) >= 2) squares.insert(square(TriangleIndex(t)));
    for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
      const TriangleIndex i(t);
      EXPECT_EQ(region.holds(i), squares.contains(square(i))) << t;
      EXPECT_EQ(region.place_of(i) >= 0, region.holds(i));
    }
    for (std::size_t i = 0; i < region.triangles().size(); ++i)
      EXPECT_EQ(region.place_of(region.triangles()[i]), to_int(i));
  }
}

/// Looks at the wedges while the path is embedded and closed.
class Looks final : public CuttingMethod {
 public:
  explicit Looks(ForcedWedges& wedges) : wedges_(wedges) {}
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override { method_->embed(sheet, trace, notes); }
  void improve(Sheet& sheet, MethodNotes&) override { wedges_.find(sheet); }

 private:
  ForcedWedges& wedges_;
  std::unique_ptr<CuttingMethod> method_ = find_method("conventional_split").make({});
};

/// A drop: both legs of its only corner, at 10 degrees, are one closed loop.
TEST(ForcedWedges, LegsThatAreOneLoopEnd) {
  Sheet sheet(make_sheet("grid", 10));
  Locator locator(sheet);
  ForcedWedges wedges;
  Looks method(wedges);
  const double x = 0.3 * std::cos(0.0873), y = 0.3 * std::sin(0.0873);
  const Curve drop{Curve::Kind::polyline, true, {{0.305, 0.507}, {0.305 + x, 0.507 - y}, {0.305 + x, 0.507 + y}}};
  ASSERT_EQ(Cutter().cut(sheet, locator, drop, method, {}).status, Status::ok);
  const double h = sheet.mean_edge();
  EXPECT_TRUE(wedges.hold(Point2{0.305 + 0.5 * h, 0.507}));
  EXPECT_TRUE(wedges.hold(Point2{0.305 - 0.2 * h, 0.507}));
  EXPECT_FALSE(wedges.hold(Point2{0.305 + 2.9 * h, 0.507}));
  EXPECT_FALSE(wedges.hold(Point2{0.305 + 0.5 * h, 0.507 + 0.3 * h}));
}

}  // namespace
}  // namespace cutbench
