// What the oracle is made of: exact predicates, flattening, the number of pieces.

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "harness/base/conversions.h"
#include "harness/oracle/exact.h"
#include "harness/oracle/expected_pieces.h"
#include "harness/oracle/flatten.h"
#include "tests/oracle_cases.h"

namespace cutbench::oracle {
namespace {

int rational_orientation(const Point& a, const Point& b, const Point& c) {
  const mpq_class ax(a[0]), ay(a[1]), bx(b[0]), by(b[1]), cx(c[0]), cy(c[1]);
  return sgn(mpq_class((bx - ax) * (cy - ay) - (by - ay) * (cx - ax)));
}

TEST(Exact, OrientationWithinUlpsOfALine) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  std::uniform_int_distribution<int> steps(-2, 2);
  int zeros = 0;
  for (int i = 0; i < 30000; ++i) {
    const double scale = std::ldexp(1.0, i % 3 == 0 ? 0 : int(random() % 1800) - 900);
    const Point a{any(random) * scale, any(random) * scale}, b{any(random) * scale, any(random) * scale};
    Point c = between(a, b, i % 2 ? any(random) : 0.5);
    for (double& x : c)
      for (int k = steps(random); k != 0; k += k < 0 ? 1 : -1) x = std::nextafter(x, k < 0 ? -infinity : infinity);
    const int expected = rational_orientation(a, b, c);
    zeros += expected == 0;
    EXPECT_EQ(orientation(a, b, c), expected);
    EXPECT_EQ(orientation(b, a, c), -expected);
    EXPECT_EQ(orientation(c, a, b), expected);
  }
  EXPECT_GT(zeros, 100);  // the sample reaches the exact branch
}

TEST(Exact, OrientationWithDenormalsAndHugeNumbers) {
  const double least = std::numeric_limits<double>::denorm_min(), most = std::numeric_limits<double>::max();
  EXPECT_EQ(orientation({0, 0}, {least, 0}, {0, least}), 1);
  EXPECT_EQ(orientation({0, 0}, {1e-200, 1e-200}, {2e-200, std::nextafter(2e-200, 0)}), -1);
  EXPECT_EQ(orientation({-most, -most}, {most, most}, {-most, most}), 1);
  EXPECT_EQ(orientation({-most, -most}, {most, most}, {0, 0}), 0);
}

TEST(Exact, AreaFarFromTheOrigin) {
  Mesh mesh = grid(20);
  for (Point& p : mesh.rest) p = {p[0] * 1024 + 0x1p40, p[1] * 1024 - 0x1p40};
  EXPECT_NEAR(to_double(area(mesh) / (1024.0L * 1024.0L)), 1, 1e-15);
}

TEST(Flatten, StaysWithinToleranceAndKeepsEnds) {
  const Curve curve{true, false, {{0, 0}, {2, 1}, {-1, 1}, {1, 0}, {1.5, -0.25}, {1, -1}, {0, -1}}};
  const auto segments = flatten(curve, 1e-3);
  EXPECT_EQ(segments.front().segment[0], curve.points.front());
  EXPECT_EQ(segments.back().segment[1], curve.points.back());
  for (int piece : {0, 1})
    for (double t = 0; t <= 1; t += 1.0 / 256) {
      const Point* p = &curve.points[3 * piece];
      Point at{0, 0};
      for (int i : {0, 1})
        at[i] = std::pow(1 - t, 3) * p[0][i] + 3 * t * (1 - t) * (1 - t) * p[1][i] + 3 * t * t * (1 - t) * p[2][i] +
                t * t * t * p[3][i];
      double nearest = infinity;
      for (const auto& s : segments) nearest = std::min(nearest, distance(at, s.segment));
      EXPECT_LE(nearest, 1e-3);
    }
  for (const auto& s : segments) {
    const Point chord = direction(s.segment[0], s.segment[1]);
    EXPECT_GT(dot(s.tangent_start, chord), 0.9);
    EXPECT_GT(dot(s.tangent_end, chord), 0.9);
  }
}

TEST(Flatten, DropsWhatHasNoLength) {
  EXPECT_TRUE(flatten({true, false, {{1, 1}, {1, 1}, {1, 1}, {1, 1}}}, 1e-3).empty());
  EXPECT_EQ(flatten({false, false, {{0, 0}, {0, 0}, {1, 0}, {1, 0}}}, 1e-3).size(), 1u);
  EXPECT_EQ(flatten({false, true, {{0, 0}, {1, 0}, {0, 1}}}, 1e-3).size(), 3u);
}

std::vector<Segment> chain(std::vector<Point> points) {
  std::vector<Segment> result;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) result.push_back({points[i], points[i + 1]});
  return result;
}

TEST(ExpectedPieces, HandCounted) {
  const std::vector<Segment> square = chain({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}});
  const auto count = [&](const std::vector<Segment>& border, const std::vector<Segment>& incisions,
                         const std::vector<std::vector<Segment>>& paths) {
    const ExpectedPieces p = expected_pieces(border, incisions, paths, {1e-12, 1e-12, 1e-12});
    EXPECT_EQ(p.least, p.expected);
    EXPECT_EQ(p.most, p.expected);
    return p.expected;
  };
  EXPECT_EQ(count(square, {}, {}), 1);
  EXPECT_EQ(count(square, {}, {chain({{-1, 0.5}, {2, 0.6}})}), 2);
  EXPECT_EQ(count(square, {}, {chain({{0.1, 0.5}, {2, 0.6}})}), 1);
  EXPECT_EQ(count(square, chain({{0, 0.5}, {1, 0.5}}), {chain({{0.5, 0}, {0.5, 0.7}})}), 3);
  // a loop that crosses itself, along the border, and twice over itself
  EXPECT_EQ(count(square, {}, {chain({{0.2, 0.2}, {0.8, 0.8}, {0.8, 0.2}, {0.2, 0.8}, {0.2, 0.2}})}), 3);
  EXPECT_EQ(count(square, {}, {chain({{0, 0}, {1, 0}, {1, 0.5}, {0, 0.5}}), chain({{1, 0.5}, {0, 0.5}})}), 2);
  // a hole, and a cut from the hole to the border, then two
  std::vector<Segment> holed = chain({{0.4, 0.4}, {0.4, 0.6}, {0.6, 0.6}, {0.6, 0.4}, {0.4, 0.4}});
  holed.insert(holed.end(), square.begin(), square.end());
  EXPECT_EQ(count(holed, {}, {}), 1);
  EXPECT_EQ(count(holed, {}, {chain({{0.5, 0.5}, {0.5, 2}})}), 1);
  EXPECT_EQ(count(holed, {}, {chain({{0.5, -1}, {0.5, 2}})}), 2);
  // two squares with a common border, drawn once for each
  std::vector<Segment> pair = chain({{1, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 0.5}, {1, 0}});
  pair.insert(pair.end(), square.begin(), square.end());
  EXPECT_EQ(count(pair, {}, {}), 2);
}

TEST(ExpectedPieces, ThinPiecesAreUndecided) {
  const std::vector<Segment> square = chain({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}});
  const ExpectedPieces p = expected_pieces(square, {}, {chain({{0, 1e-14}, {1, 1e-14}})}, {1e-12, 1e-12, 1e-12});
  EXPECT_EQ(p.expected, 1);
  EXPECT_EQ(p.least, 1);
  EXPECT_EQ(p.most, 2);
}

TEST(ExpectedPieces, ThatAPathTurnsBackAtAnOlderTipIsUndecided) {
  const std::vector<Segment> square = chain({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}});
  const ExpectedPieces p = expected_pieces(square, chain({{0, 0.5}, {0.5, 0.5}}),
                                           {chain({{1, 0.6}, {0.5 + 1e-14, 0.5}, {1, 0.4}})}, {1e-12, 1e-12, 1e-12});
  EXPECT_EQ(p.expected, 2);
  EXPECT_EQ(p.least, 2);
  EXPECT_EQ(p.most, 3);
}

TEST(ExpectedPieces, OnWhichSideAPathPassesAnOlderTipIsUndecided) {
  const std::vector<Segment> square = chain({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}});
  const auto least_at = [&](double x) {
    const ExpectedPieces p =
        expected_pieces(square, chain({{0, 0.5}, {0.5, 0.5}}), {chain({{x, -1}, {x, 2}})}, {1e-12, 1e-12, 1e-12});
    EXPECT_EQ(p.expected, 3);
    EXPECT_EQ(p.most, 3);
    return p.least;
  };
  EXPECT_EQ(least_at(0.5 - 1e-14), 2);
  EXPECT_EQ(least_at(0.5 - 1e-11), 3);
}

TEST(ExpectedPieces, WhetherACurveTouchesALineIsUndecided) {
  const std::vector<Segment> square = chain({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}});
  const auto least_at = [&](double top) {
    const ExpectedPieces p =
        expected_pieces(square, chain({{0, 0.5}, {1, 0.5}}),
                        {chain({{0, 0}, {0.2, 0.2}, {0.5, top}, {0.8, 0.2}, {1, 0}})}, {1e-14, 1e-6, 1e-6});
    EXPECT_EQ(p.expected, top < 0.5 ? 3 : top > 0.5 ? 5 : 4);
    return p.least;
  };
  EXPECT_EQ(least_at(0.5 - 1e-5), 3);
  EXPECT_EQ(least_at(0.5), 3);
  EXPECT_EQ(least_at(0.5 + 1e-7), 3);
  EXPECT_EQ(least_at(0.6), 5);
}

TEST(ExpectedPieces, WhetherTwoLinesThatNearlyCoincideCrossIsUndecided) {
  const std::vector<Segment> square = chain({{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}});
  const auto most_at = [&](double apart) {
    const ExpectedPieces p = expected_pieces(
        square, {}, {chain({{-1, 0.5}, {2, 0.5}, {2, 0.5 + apart}, {-1, 0.5 + apart}})}, {1e-14, 1e-6, 1e-6});
    EXPECT_EQ(p.expected, 3);
    return p.most;
  };
  EXPECT_EQ(most_at(1e-7), 3 + 1);
  EXPECT_EQ(most_at(1e-5), 3);
}

}  // namespace
}  // namespace cutbench::oracle
