// The audit of forced zones finds what a person would, and excuses nothing else.

#include "harness/oracle/forced_zones.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "tests/oracle_cases.h"

namespace cutbench::oracle {
namespace {

constexpr double degree = std::numbers::pi / 180;

constexpr double h = 0.1;  // of grid(10), nearly

std::vector<ForcedCorner> corners(std::vector<Curve> cuts) { return forced_corners(grid(10), cuts, h); }

Point turned(double degrees, double length) {
  return {length * std::cos(degrees * degree), length * std::sin(degrees * degree)};
}

/// A cut from the middle of the bottom border, at so many degrees to it.
Curve from_bottom(double degrees, double length = 0.45) {
  const Point d = turned(degrees, length);
  return polyline({{0.5, 0}, {0.5 + d[0], d[1]}});
}

TEST(ForcedCorners, NoneWithoutSharpAngles) {
  EXPECT_TRUE(corners({}).empty());
  EXPECT_TRUE(corners({polyline({{0.1, -1}, {0.3, 2}})}).empty());
  EXPECT_TRUE(corners({polyline({{0.2, 0.2}, {0.8, 0.8}}), polyline({{0.2, 0.8}, {0.8, 0.2}})}).empty());
  EXPECT_TRUE(corners({polyline({{2, 0}, {3, 1}, {2, 0.01}})}).empty());  // sharp, but outside
}

TEST(ForcedCorners, WithTheBorder) {
  for (const double degrees : {0.01, 1.0, 5.0, 19.0}) {
    const auto found = corners({from_bottom(degrees)});
    ASSERT_EQ(found.size(), 1u) << degrees;
    EXPECT_NEAR(found[0].angle, degrees * degree, 1e-9);
    EXPECT_LT(distance(found[0].apex, Point{0.5, 0}), 1e-9);
    EXPECT_NEAR(found[0].leg1[0], 1, 1e-12);
    EXPECT_GT(found[0].leg2[1], 0);
  }
  EXPECT_TRUE(corners({from_bottom(20)}).empty());
  EXPECT_EQ(corners({from_bottom(170)}).size(), 1u);
  // crossing the border from outside: the angle outside the sheet is nobody's concern
  EXPECT_EQ(corners({polyline({{0.1, -0.05}, {0.9, 0.05}})}).size(), 1u);
}

TEST(ForcedCorners, CrossingsHaveTwo) {
  EXPECT_EQ(corners({polyline({{0.2, 0.5}, {0.8, 0.5}}), polyline({{0.2, 0.45}, {0.8, 0.55}})}).size(), 2u);
  // the same as one self-crossing polyline
  EXPECT_EQ(corners({polyline({{0.2, 0.5}, {0.8, 0.5}, {0.8, 0.9}, {0.1, 0.9}, {0.1, 0.43}, {0.8, 0.55}})}).size(), 2u);
}

TEST(ForcedCorners, BundleThroughOnePoint) {
  std::vector<Curve> lines;
  for (const double degrees : {30.0, 31.0, 32.0, 80.0}) {
    const Point d = turned(degrees, 0.4);
    lines.push_back(polyline({{0.5 - d[0], 0.5 - d[1]}, {0.5 + d[0], 0.5 + d[1]}}));
  }
  EXPECT_EQ(corners(lines).size(), 4u);
}

TEST(ForcedCorners, SharpCornerOfAPath) {
  const auto found = corners({polyline({{0.2, 0.5}, {0.7, 0.5}, {0.2, 0.6}})});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].apex, (Point{0.7, 0.5}));
  EXPECT_NEAR(found[0].angle, std::atan2(0.1, 0.5), 1e-12);
  EXPECT_EQ(corners({polyline({{0.2, 0.5}, {0.7, 0.5}, {0.3, 0.6}}, true)}).size(), 1u);
}

TEST(ForcedCorners, OfTheBorderItself) {
  Mesh wedge{{{0, 0}, {1, 0}, {1, 0.2}}, {{0, 1, 2}}};
  const auto found = forced_corners(wedge, {}, h);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].apex, (Point{0, 0}));
  // a notch of the same angle takes nothing from the sheet
  const Mesh notched{{{0, 0}, {0.5, 0.5}, {0.6, 0}, {0.4, 0}, {1, 1}, {0, 1}, {1, 0}},
                     {{0, 3, 1}, {1, 2, 6}, {1, 6, 4}, {1, 4, 5}, {0, 1, 5}}};
  const auto none = forced_corners(notched, {}, h);
  for (const auto& c : none) EXPECT_GT(distance(c.apex, Point{0.5, 0.5}), 0.1);
}

/// An older incision along y = 0.5, opened, crossed and met at 10 degrees.
TEST(ForcedCorners, WithAnOlderIncision) {
  Mesh sheet = grid(10);
  const int first = int(sheet.rest.size());
  for (int x = 0; x <= 10; ++x) sheet.rest.push_back(Point(sheet.rest[5 * 11 + x]));
  for (std::size_t t = 100; t < 200; ++t)
    for (int& v : sheet.triangles[t])
      if (v >= 55 && v <= 65) v = first + v - 55;
  const Point d = turned(10, 0.4);
  const auto tee = forced_corners(sheet, {polyline({{0.5, 0.5}, {0.5 + d[0], 0.5 + d[1]}})}, h);
  EXPECT_EQ(tee.size(), 1u);
  const auto crossing = forced_corners(sheet, {polyline({{0.5 - d[0], 0.5 - d[1]}, {0.5 + d[0], 0.5 + d[1]}})}, h);
  EXPECT_EQ(crossing.size(), 2u);
  EXPECT_TRUE(forced_corners(sheet, {polyline({{0.2, 0.5}, {0.7, 0.5}})}, h).empty());  // along it
}

TEST(ForcedCorners, TangentsOfABezierCurve) {
  // leaves the border at 15 degrees and curves away at once; a chord of 0.1 h would already see another angle
  const Point d = turned(15, 0.1);
  const Curve curve{true, false, {{0.5, 0}, {0.5 + d[0], d[1]}, {0.6, 0.2}, {0.5, 0.3}}};
  const auto found = corners({curve});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].angle, 15 * degree, 1e-6);
}

TEST(ForcedCorners, RunningAlongTheBorderIsNone) {
  EXPECT_TRUE(corners({polyline({{0.2, 0}, {0.9, 0}})}).empty());
  for (const double off : {0.0, 1e-17, -1e-17, 1e-12, -1e-12}) {
    std::vector<Point> jagged;
    for (int i = 0; i <= 50; ++i) jagged.push_back({0.2 + 0.01 * i, i % 2 ? off : -off});
    EXPECT_TRUE(corners({polyline(jagged)}).empty()) << off;
    jagged.push_back({0.9, 0.03});  // and then leaves it
    EXPECT_EQ(corners({polyline(jagged)}).size(), 1u) << off;
  }
}

TEST(ForcedCorners, GrazingDoesNotExplode) {
  for (const double off : {1e-3, 1e-6, 1e-9, 1e-12, 1e-15}) {
    const auto line = corners({polyline({{0, -off}, {1, off}})});
    EXPECT_LE(line.size(), 1u) << off;
    const Curve bulge{true, false, {{0.1, 0.3}, {0.4, -0.1 - off}, {0.6, -0.1 - off}, {0.9, 0.3}}};
    EXPECT_LE(corners({bulge}).size(), 4u)
        << off;  // two, or both seen from either crossing where these are 1e-5 h apart
  }
}

// ------------------------------------------------------------------ zones

/// Sixty-degree fan round the apex from the border up, in steps.
Mesh fan(const Point& apex, std::vector<double> degrees, double radius) {
  Mesh mesh{{apex}, {}};
  for (double d : degrees) {
    const Point p = turned(d, radius);
    mesh.rest.push_back({apex[0] + p[0], apex[1] + p[1]});
  }
  for (int i = 1; i + 1 < int(mesh.rest.size()); ++i) mesh.triangles.push_back({0, i, i + 1});
  return mesh;
}

TEST(ForcedZones, CornerTriangles) {
  const auto found = corners({from_bottom(12)});
  const Mesh after = fan({0.5, 0}, {0, 6, 12, 60, 120, 180}, 0.3);
  const ForcedZones zones = forced_zones(found, after, h);
  EXPECT_EQ(zones.in_corner, (std::vector<char>{1, 1, 0, 0, 0}));
  EXPECT_EQ(zones.corner_triangles, 2);
  EXPECT_NEAR(zones.corner_area, 2 * 0.5 * 0.09 * std::sin(6 * degree), 1e-12);
  // the same triangles elsewhere are nobody's excuse
  EXPECT_EQ(forced_zones(found, fan({0.2, 0}, {0, 6, 12, 60}, 0.1), h).zone_triangles, 0);
}

TEST(ForcedZones, WedgeEndsWhereItIsWide) {
  const double angle = 5;  // 0.3 h apart at 0.344
  const auto found = corners({from_bottom(angle)});
  ASSERT_EQ(found.size(), 1u);
  const auto small_triangle = [&](double x, double y) {
    return Mesh{{{x, y}, {x + 1e-4, y}, {x, y + 1e-4}}, {{0, 1, 2}}};
  };
  const auto in_zone = [&](double x, double y) {
    return forced_zones(found, small_triangle(x, y), h).zone_triangles == 1;
  };
  EXPECT_TRUE(in_zone(0.8, 0.01));    // between the legs
  EXPECT_FALSE(in_zone(0.9, 0.01));   // too wide there
  EXPECT_FALSE(in_zone(0.8, 0.05));   // above
  EXPECT_FALSE(in_zone(0.3, 0.001));  // behind the apex
  EXPECT_TRUE(in_zone(0.48, 0.005));  // in the disc
  EXPECT_TRUE(in_zone(0.5, 0.024));
  EXPECT_FALSE(in_zone(0.5, 0.026));
  const auto near_zone = [&](double x, double y) {
    return forced_zones(found, small_triangle(x, y), h).near_zone.front() == 1;
  };
  const double leg = 0.3 * std::tan(angle * degree);  // above x = 0.8
  EXPECT_FALSE(in_zone(0.8, leg + 0.0015));
  EXPECT_TRUE(near_zone(0.8, leg + 0.0015));
  EXPECT_FALSE(near_zone(0.8, leg + 0.0025));
  EXPECT_TRUE(near_zone(0.8, 0.01));
  EXPECT_TRUE(near_zone(0.5, 0.024)) << "in the disc";
  EXPECT_FALSE(near_zone(0.5, 0.026));
}

/// The wedge follows a curved leg: between the border and a curve that bends away from it.
TEST(ForcedZones, WedgeFollowsACurve) {
  const Curve curve{true, false, {{0.1, 0}, {0.3, 0.01}, {0.5, 0.05}, {0.6, 0.4}}};
  const auto found = corners({curve});
  ASSERT_EQ(found.size(), 1u);
  for (const Point& p : found[0].wedge) EXPECT_LT(p[1], 0.031);
  EXPECT_LT(found[0].wedge[found[0].wedge.size() / 2][0], 0.5);
}

TEST(ForcedZones, WedgeEndsWithTheCut) {
  const auto found = corners({from_bottom(1, 0.1)});
  ASSERT_EQ(found.size(), 1u);
  for (const Point& p : found[0].wedge) EXPECT_LT(p[0], 0.6 + 1e-9);
}

/// No assertion on time: prints it.
TEST(ForcedZones, Speed) {
  const Curve wave{true, false, {{-0.1, 0.2}, {0.5, 1.4}, {0.5, -0.6}, {1.1, 0.8}}};
  const Mesh sheet = grid(80);
  const auto start = std::chrono::steady_clock::now();
  const auto found = forced_corners(sheet, {wave, polyline({{-1, -0.03}, {2, 0.04}})}, 1.138 / 80);
  const ForcedZones zones = forced_zones(found, sheet, 1.138 / 80);
  const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
  std::printf("%zu corners, %d triangles: %.1f ms\n", found.size(), zones.zone_triangles, taken.count());
  EXPECT_GT(found.size(), 0u);
}

}  // namespace
}  // namespace cutbench::oracle
