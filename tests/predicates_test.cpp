// Decisions on doubles against rational arithmetic, where the first filter gives in and where it must not.
#include "harness/mesh/predicates.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "harness/base/conversions.h"
#include "harness/base/random.h"

namespace cutbench {
namespace {

int rational_in_circle(Point2 a, Point2 b, Point2 c, Point2 d) {
  const mpq_class ax = mpq_class(a.x) - d.x, ay = mpq_class(a.y) - d.y, bx = mpq_class(b.x) - d.x;
  const mpq_class by = mpq_class(b.y) - d.y, cx = mpq_class(c.x) - d.x, cy = mpq_class(c.y) - d.y;
  return sgn(mpq_class((ax * ax + ay * ay) * (bx * cy - cx * by) + (bx * bx + by * by) * (cx * ay - ax * cy) +
                       (cx * cx + cy * cy) * (ax * by - bx * ay)));
}

double next(double x, int steps) {
  for (int i = 0; i < std::abs(steps); ++i) x = std::nextafter(x, steps > 0 ? 1e308 : -1e308);
  return x;
}

/// Four points of a circle, rounded, the last one some digits away; scaled and moved.
TEST(InCircle, AgreesWithRationalNumbersNearTheCircle) {
  Random random(1);
  for (const double scale : {1e-160, 1e-110, 1e-33, 1e-3, 1.0, 1e3, 1e68, 1e75, 1e100})
    for (const double away : {0.0, 0.5, 1e6})
      for (int i = 0; i < 400; ++i) {
        Point2 p[4];
        for (int k = 0; k < 4; ++k) {
          const double angle = k + random.unit();
          p[k] = {scale * (std::cos(angle) + away), scale * (std::sin(angle) + away)};
        }
        p[3].x = next(p[3].x, to_int(random.below(9)) - 4);
        const int expected = rational_in_circle(p[0], p[1], p[2], p[3]);
        ASSERT_EQ(in_circle(p[0], p[1], p[2], p[3]), expected) << scale << ' ' << away << ' ' << i;
        ASSERT_EQ(exact_in_circle(p[0], p[1], p[2], p[3]), expected) << scale << ' ' << away << ' ' << i;
      }
}

TEST(InCircle, IsZeroOnTheCircle) {
  for (const double scale : {0x1p-500, 0x1p-60, 1.0, 0x1p200})
    for (const Point2 d : {Point2{0, -5}, Point2{3, -4}, Point2{-4, -3}})
      EXPECT_EQ(in_circle({5 * scale, 0}, {3 * scale, 4 * scale}, {-5 * scale, 0}, {d.x * scale, d.y * scale}), 0);
}

TEST(InCircle, KnowsWhatUnderflowAndOverflowWouldHide) {
  constexpr double least = std::numeric_limits<double>::denorm_min(), huge = 1e200;
  EXPECT_EQ(in_circle({0, 0}, {1, 0}, {0, 1}, {1, 1 - 0x1p-53}), 1);
  EXPECT_EQ(in_circle({0, 0}, {least, 0}, {0, least}, {2 * least, 2 * least}), -1);
  EXPECT_EQ(in_circle({0, 0}, {huge, 0}, {0, huge}, {huge / 2, huge / 2}), 1);
  EXPECT_EQ(in_circle({0, 0}, {1e-200, 0}, {0, 1e200}, {1e-200, 1}),
            rational_in_circle({0, 0}, {1e-200, 0}, {0, 1e200}, {1e-200, 1}));
}

}  // namespace
}  // namespace cutbench
