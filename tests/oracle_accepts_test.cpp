// The oracle accepts correct cuts.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

#include "tests/oracle_cases.h"

namespace cutbench::oracle {
namespace {

TEST(Accepts, StraightCut) { expect_ok(straight(), 2); }
TEST(Accepts, PartialCut) { expect_ok(partial(), 1); }
TEST(Accepts, CutOut) { expect_ok(cut_out(), 2); }
TEST(Accepts, CrossingCuts) { expect_ok(crossing(), 4); }

TEST(Accepts, NothingToDo) {
  const Mesh sheet = grid(4);
  expect_ok({request(sheet, {}), sheet}, 1);
  expect_ok({request(sheet, {polyline({{2, 0}, {3, 1}})}), sheet}, 1);          // outside
  expect_ok({request(sheet, {polyline({{0.3, 0.3}, {0.3, 0.3}})}), sheet}, 1);  // no length
  expect_ok({request(sheet, {polyline({{0.2, 0}, {0.9, 0}})}), sheet}, 1);      // along the border
  expect_ok({request(sheet, {polyline({{-1, 1}, {1, -1}})}), sheet}, 1);        // touches a corner
}

/// A curve of about the size that asks for nothing may be found smaller than it is, where it is flattened more
/// coarsely.
TEST(Accepts, NothingOpenedForACurveWithHardlyAnySize) {
  const Mesh sheet = grid(4);
  const auto loop = [&](double size) {
    Request r = request(sheet, {Curve{true, true, {{0.3, 0.3}, {0.3 + size, 0.3}, {0.3, 0.3 + size}, {0.3, 0.3}}}});
    r.snap = 1e-12;
    return judge(r, sheet);
  };
  const double extent = 4.0 / 9;  // of the curve, in sizes
  EXPECT_TRUE(loop(2.04e-12 / extent).ok);
  EXPECT_EQ(loop(2.2e-12 / extent).verdict, Verdict::incision);
}

/// Where points may be merged that far, the slit needn't be there; but it may.
TEST(Accepts, OpenedThoughItAsksForNothing) {
  const std::vector<Point> slit{{0.25, 0.5}, {0.75, 0.5}};
  Request r = request(grid(4), {polyline(slit)});
  r.snap = 0.3;
  expect_ok({r, open(grid(4), on({slit}))}, 1);
}

TEST(Accepts, SlitInsideOfOneEdge) {
  const std::vector<Point> slit{{0.25, 0.5}, {0.75, 0.5}};
  expect_ok({request(grid(4), {polyline(slit)}), open(grid(4), on({slit}))}, 1);
}

TEST(Accepts, PiecesThatTouchInOnePoint) {
  const std::vector<Point> a{{0.25, 0.25}, {0.5, 0.25}, {0.5, 0.5}, {0.25, 0.5}};
  const std::vector<Point> b{{0.5, 0.5}, {0.75, 0.5}, {0.75, 0.75}, {0.5, 0.75}};
  const Chooser edges = on({{a[0], a[1], a[2], a[3], a[0]}, {b[0], b[1], b[2], b[3], b[0]}});
  expect_ok({request(grid(4), {polyline(a, true), polyline(b, true)}), open(grid(4), edges)}, 3);
}

TEST(Accepts, RecutAcrossAnOlderIncision) {
  const Point a{-1, 0.21}, b{2, 0.83}, c{0.32, -1}, d{0.67, 2};
  const Mesh once = split(grid(8), a, b);
  const Mesh after = open(split(once, c, d), on({{a, b}, {c, d}}));
  Case recut{request(open(once, on({{a, b}})), {polyline({c, d})}), after};
  recut.request.keeps_vertices = false;  // the helper numbers from the welded sheet
  expect_ok(recut, 4);
}

TEST(Accepts, SameCutAgain) {
  Case again = straight();
  again.request.before = again.after;
  expect_ok(again, 2);
}

TEST(Accepts, SheetWithAHoleAndTwoPieces) {
  Mesh sheet = open(grid(8), on({{{0.5, 0}, {0.5, 1}}}));
  for (auto& p : sheet.rest) p[0] = p[0] + p[1] / 8;
  Mesh holed{sheet.rest, {}};
  const auto in_hole = [&](const Point& p) { return std::abs(p[1] - 0.5) < 0.1 && p[0] < 0.3; };
  for (const auto& t : sheet.triangles)
    if (!in_hole(sheet.rest[t[0]]) && !in_hole(sheet.rest[t[1]]) && !in_hole(sheet.rest[t[2]]))
      holed.triangles.push_back(t);
  const Point p{-1, 0.31}, q{2, 0.31};
  const Mesh welded = split(holed, p, q);
  const Judgement j = judge(request(holed, {polyline({p, q})}), open(welded, on({{p, q}})));
  EXPECT_TRUE(j.ok) << explain(j);
  EXPECT_EQ(j.pieces, 4);
}

/// A path that ends a few ulps before the border: both answers are right.
TEST(Accepts, TipWithinSnapOfTheBorder) {
  Case c = straight();
  c.request.cuts = {polyline({{-0.1, 0.237}, between({-0.1, 0.237}, {1.1, 0.811}, 11.0 / 12 - 1e-13)})};
  const Judgement j = judge(c.request, c.after);
  EXPECT_TRUE(j.ok) << explain(j);
  EXPECT_EQ(j.pieces, 2);
  EXPECT_EQ(j.expected_pieces, 1);
}

TEST(Accepts, RandomLines) {
  std::mt19937 random(20240611);
  std::uniform_real_distribution<double> any(-0.2, 1.2);
  for (int i = 0; i < 200; ++i) {
    const Point p{-0.5, any(random)}, q{1.5, any(random)}, r{any(random), -0.5}, s{any(random), 1.5};
    const Mesh welded = split(split(grid(10), p, q), r, s);
    const Judgement j =
        judge(request(grid(10), {polyline({p, q}), polyline({r, s})}), open(welded, on({{p, q}, {r, s}})));
    EXPECT_TRUE(j.ok) << i << ": " << explain(j);
    EXPECT_EQ(j.pieces, j.expected_pieces);
  }
}

/// From border vertex to border vertex: through vertices, along edges, along the border; tips exactly on the border.
TEST(Accepts, BetweenAnyTwoBorderVertices) {
  const Mesh sheet = grid(4);
  const auto sides = [](const Point& p) {
    return (p[0] == 0) | (p[0] == 1) << 1 | (p[1] == 0) << 2 | (p[1] == 1) << 3;
  };
  for (const Point& p : sheet.rest)
    for (const Point& q : sheet.rest) {
      if (p == q || !sides(p) || !sides(q)) continue;
      expect_ok({request(sheet, {polyline({p, q})}), open(split(sheet, p, q), on({{p, q}}))},
                sides(p) & sides(q) ? 1 : 2);
    }
}

TEST(Accepts, FarFromTheOrigin) {
  const double offset = 0x1p20;
  Mesh sheet = grid(8);
  for (Point& p : sheet.rest) p = {p[0] + offset, p[1] - offset};
  const Point a{offset - 1, 0.21 - offset}, b{offset + 2, 0.83 - offset};
  const Mesh welded = split(sheet, a, b);
  const auto near_line = [&](const Point& p, const Point& q) {
    return distance(p, Segment{a, b}) < 1e-9 && distance(q, Segment{a, b}) < 1e-9;
  };
  Request r = request(sheet, {polyline({a, b})});
  r.snap = 0;
  const Judgement j = judge(r, open(welded, near_line));
  EXPECT_TRUE(j.ok) << explain(j);
  EXPECT_EQ(j.pieces, 2);
}

/// Scaling by a power of two changes nothing but the unit; an offset only costs digits.
/// The path's ends decide nothing, and don't blur it.
TEST(Accepts, PathFromFarOutside) {
  const std::vector<Point> row{{0, 0.25}, {1, 0.25}};
  for (double far : {2.0, 1e9, 1e59}) {
    SCOPED_TRACE(far);
    expect_ok({request(grid(4), {polyline({{-far, 0.25}, {far, 0.25}})}), open(grid(4), on({row}))}, 2);
    const Case away{request(grid(4), {polyline({{-far, 1.25}, {far, 1.25}})}), grid(4)};
    expect_ok(away, 1);
  }
  const double x = 1e9 + 0.5;  // and (0.5 +- x, 0.5 +- x / 1024) are doubles
  const Point p{0.5 - x, 0.5 - x / 1024}, q{0.5 + x, 0.5 + x / 1024}, near_p{-511.5, 0}, near_q{512.5, 1};
  expect_ok({request(grid(4), {polyline({p, q})}), open(split(grid(4), near_p, near_q), on({{near_p, near_q}}))}, 2);
}

TEST(Accepts, AnyScale) {
  for (const double scale : {0x1p-400, 0x1p-30, 0x1p30, 0x1p400}) {
    Case c = crossing();
    for (Mesh* mesh : {&c.request.before, &c.after})
      for (Point& p : mesh->rest) p = {scale * p[0], scale * p[1]};
    for (Curve& curve : c.request.cuts)
      for (Point& p : curve.points) p = {scale * p[0], scale * p[1]};
    c.request.snap *= scale;
    const Judgement j = judge(c.request, c.after);
    EXPECT_TRUE(j.ok) << scale << ": " << explain(j);
    EXPECT_EQ(j.pieces, 4);
  }
}

TEST(Accepts, BezierCut) {
  for (int n : {20, 40}) {
    const Case c = along_bezier(n);
    const Judgement j = judge(c.request, c.after);
    EXPECT_TRUE(j.ok) << explain(j);
    EXPECT_EQ(j.pieces, 2);
    EXPECT_LT(j.incision_error, 0.05 / n);
    EXPECT_GT(j.incision_error, 1e-6);
  }
}

/// A circle approximated by the grid's edges: the error is that of the edges, and the piece count is right.
TEST(Accepts, BezierWithinTolerance) {
  const double k = 4 * (std::numbers::sqrt2 - 1) / 3 * 0.25;
  const Curve circle{true,
                     true,
                     {{0.75, 0.5},
                      {0.75, 0.5 + k},
                      {0.5 + k, 0.75},
                      {0.5, 0.75},
                      {0.5 - k, 0.75},
                      {0.25, 0.5 + k},
                      {0.25, 0.5},
                      {0.25, 0.5 - k},
                      {0.5 - k, 0.25},
                      {0.5, 0.25},
                      {0.5 + k, 0.25},
                      {0.75, 0.5 - k},
                      {0.75, 0.5}}};
  const std::vector<Point> diamond{{0.75, 0.5},  {0.75, 0.75}, {0.5, 0.75}, {0.25, 0.5},
                                   {0.25, 0.25}, {0.5, 0.25},  {0.75, 0.5}};
  Request r = request(grid(4), {circle});
  r.tolerance = infinity;
  r.vertex_tolerance = infinity;
  const Mesh after = open(grid(4), on({diamond}));
  const Judgement j = judge(r, after);
  EXPECT_TRUE(j.ok) << explain(j);
  EXPECT_EQ(j.expected_pieces, 2);
  EXPECT_NEAR(j.incision_error, 0.25 * (std::numbers::sqrt2 - 1), 2e-4);  // at the corners of the square
  r.tolerance = 0.1;
  EXPECT_EQ(judge(r, after).verdict, Verdict::incision);
  r.exact_incision = false;
  r.tolerance = 0.11;  // what the method promises
  EXPECT_TRUE(judge(r, after).ok);
  r.tolerance = 0.1;
  EXPECT_EQ(judge(r, after).verdict, Verdict::incision);
}

/// No assertion: prints what a judgement costs on the paper's largest sheet.
TEST(Speed, TwelveThousandTriangles) {
  for (const Case& c : {straight(80), along_bezier(80)}) {
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < 10; ++i) EXPECT_TRUE(judge(c.request, c.after).ok);
    const std::chrono::duration<double, std::milli> taken = std::chrono::steady_clock::now() - start;
    std::printf("%zu triangles: %.1f ms a judgement\n", c.after.triangles.size(), taken.count() / 10);
  }
}

}  // namespace
}  // namespace cutbench::oracle
