#include "harness/mesh/quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace cutbench {
namespace {

const double root3 = std::sqrt(3.0);

TEST(Quality, KnownTriangles) {
  const Point2 o{0, 0}, x{1, 0};
  EXPECT_DOUBLE_EQ(aspect_ratio(o, x, {0, 1}), 2);
  EXPECT_DOUBLE_EQ(aspect_ratio(o, {0, 1}, x), 2);  // clockwise
  EXPECT_DOUBLE_EQ(aspect_ratio(o, x, {0.5, root3 / 2}), 2 / root3);
  EXPECT_DOUBLE_EQ(aspect_ratio(o, x, {0.5, 0.01}), 100);  // a cap: longest edge 1, height on it 0.01
  EXPECT_TRUE(std::isinf(aspect_ratio(o, x, {2, 0})));

  const auto [a, b, c] = angles_deg(o, x, {0, 1});
  EXPECT_DOUBLE_EQ(a, 90);
  EXPECT_DOUBLE_EQ(b, 45);
  EXPECT_DOUBLE_EQ(c, 45);
  EXPECT_NEAR(smallest_angle_deg(o, {2, 0}, {0, 2 / root3}), 30, 1e-13);
  EXPECT_NEAR(largest_angle_deg(o, {2, 0}, {1, 1 / root3}), 120, 1e-13);
  EXPECT_DOUBLE_EQ(smallest_altitude(o, {3, 0}, {0, 4}), 2.4);
}

TEST(Quality, DoesNotDependOnScaleOrOnWhichCornerIsFirst) {
  const Point2 a{0.1, 0.2}, b{1.3, 0.4}, c{0.7, 1.9};
  for (double s : {1e-140, 1e-3, 1e60}) EXPECT_NEAR(aspect_ratio(s * a, s * b, s * c), aspect_ratio(a, b, c), 1e-13);
  EXPECT_NEAR(aspect_ratio(b, c, a), aspect_ratio(a, b, c), 1e-14);
  const auto angles = angles_deg(a, b, c);
  EXPECT_NEAR(angles[0] + angles[1] + angles[2], 180, 1e-12);
}

TEST(Quality, OfAList) {
  // Aspect ratios 2 (198 times), 5 and 100.
  std::vector<std::array<Point2, 3>> triangles(198, {Point2{0, 0}, Point2{1, 0}, Point2{0, 1}});
  triangles.push_back({Point2{0, 0}, Point2{1, 0}, Point2{0.5, 0.2}});
  triangles.push_back({Point2{0, 0}, Point2{1, 0}, Point2{0.5, 0.01}});
  const Quality q = quality(triangles);
  EXPECT_EQ(q.triangles, 200u);
  EXPECT_EQ(q.over_3, 2u);
  EXPECT_DOUBLE_EQ(q.ar_max, 100);
  EXPECT_DOUBLE_EQ(q.ar_mean, (198 * 2 + 5 + 100) / 200.0);
  EXPECT_DOUBLE_EQ(q.ar_p99, 2);  // rank 198 of 200
  EXPECT_NEAR(q.angle_min_deg, std::atan(0.02) * 180 / M_PI, 1e-12);
  EXPECT_NEAR(q.angle_max_deg, 180 - 2 * std::atan(0.02) * 180 / M_PI, 1e-12);
  EXPECT_DOUBLE_EQ(q.altitude_min, 0.01);

  triangles.push_back(triangles.back());  // now rank 199 of 201
  EXPECT_DOUBLE_EQ(quality(triangles).ar_p99, 5);
}

TEST(Quality, OfNoneAndOfOne) {
  const Quality none = quality({});
  EXPECT_EQ(none.triangles, 0u);
  EXPECT_EQ(none.ar_max, 0);
  EXPECT_EQ(none.angle_min_deg, 0);
  const std::array<Point2, 3> one[] = {{Point2{0, 0}, Point2{1, 0}, Point2{0, 1}}};
  EXPECT_DOUBLE_EQ(quality(one).ar_p99, 2);
}

}  // namespace
}  // namespace cutbench
