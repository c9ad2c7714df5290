// The oracle accepts correct cuts, made here by hand, and rejects every seeded fault.

#include "harness/measure/oracle.h"

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <random>
#include <stdexcept>

#include "harness/measure/exact.h"
#include "harness/measure/expected_pieces.h"
#include "harness/measure/flatten.h"

namespace cutbench::oracle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// ------------------------------------------------------------------ a cutter for lines, as simple as it can be

/// The unit square in n x n squares, each divided by its rising diagonal.
Mesh grid(int n) {
  Mesh mesh;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) mesh.rest.push_back({double(x) / n, double(y) / n});
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int a = y * (n + 1) + x, b = a + 1, c = a + n + 2, d = a + n + 1;
      mesh.triangles.push_back({a, b, c});
      mesh.triangles.push_back({a, c, d});
    }
  return mesh;
}

/// Splits the triangles of a welded sheet along the whole line through p and q.
Mesh split(const Mesh& mesh, const Point& p, const Point& q) {
  Mesh out{mesh.rest, {}};
  std::map<std::pair<int, int>, int> crossing;
  const auto cut = [&](int a, int b) {
    if (a > b) std::swap(a, b);
    const auto [it, fresh] = crossing.try_emplace({a, b}, static_cast<int>(out.rest.size()));
    if (fresh) {
      const Point d = minus(q, p), u = minus(mesh.rest[a], p), v = minus(mesh.rest[b], p);
      out.rest.push_back(between(mesh.rest[a], mesh.rest[b], cross(d, u) / (cross(d, u) - cross(d, v))));
    }
    return it->second;
  };
  for (const auto& t : mesh.triangles) {
    int side[3], k = 0;
    for (int i = 0; i < 3; ++i) side[i] = orientation(p, q, mesh.rest[t[i]]);
    if (side[0] * side[1] >= 0 && side[1] * side[2] >= 0 && side[2] * side[0] >= 0) {
      out.triangles.push_back(t);
      continue;
    }
    const bool through_vertex = side[0] * side[1] * side[2] == 0;
    while (through_vertex ? side[k] != 0 : side[k] * side[(k + 1) % 3] > 0 || side[k] * side[(k + 2) % 3] > 0) ++k;
    const int a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3];
    if (through_vertex) {
      const int m = cut(b, c);
      out.triangles.insert(out.triangles.end(), {{a, b, m}, {a, m, c}});
    } else {
      const int ab = cut(a, b), ac = cut(a, c);
      out.triangles.insert(out.triangles.end(), {{a, ab, ac}, {ab, b, ac}, {ac, b, c}});
    }
  }
  return out;
}

using Chooser = std::function<bool(const Point&, const Point&)>;

/// Opens the chosen edges of a welded sheet: every fan between two of them gets a vertex of its own.
Mesh open(const Mesh& mesh, const Chooser& chosen) {
  std::vector<int> parent(3 * mesh.triangles.size());
  std::iota(parent.begin(), parent.end(), 0);
  const std::function<int(int)> root = [&](int i) { return parent[i] == i ? i : parent[i] = root(parent[i]); };
  std::map<std::pair<int, int>, int> half_edge;
  for (int e = 0; e < int(parent.size()); ++e)
    half_edge[{mesh.triangles[e / 3][e % 3], mesh.triangles[e / 3][(e + 1) % 3]}] = e;
  const auto next = [](int e) { return e % 3 == 2 ? e - 2 : e + 1; };
  for (const auto& [ends, e] : half_edge) {
    const auto other = half_edge.find({ends.second, ends.first});
    if (other == half_edge.end() || chosen(mesh.rest[ends.first], mesh.rest[ends.second])) continue;
    parent[root(e)] = root(next(other->second));
    parent[root(next(e))] = root(other->second);
  }
  Mesh out = mesh;
  std::vector<char> taken(mesh.rest.size(), 0);
  std::map<int, int> vertex_of_fan;
  for (int e = 0; e < int(parent.size()); ++e) {
    const int v = mesh.triangles[e / 3][e % 3];
    const auto [it, fresh] = vertex_of_fan.try_emplace(root(e), v);
    if (fresh && taken[v]) {
      it->second = int(out.rest.size());
      out.rest.push_back(mesh.rest[v]);
    }
    taken[v] = 1;
    out.triangles[e / 3][e % 3] = it->second;
  }
  return out;
}

/// Edges that lie on one of the polylines.
Chooser on(std::vector<std::vector<Point>> lines) {
  return [lines](const Point& a, const Point& b) {
    for (const auto& line : lines)
      for (std::size_t i = 0; i + 1 < line.size(); ++i)
        if (distance(a, Segment{line[i], line[i + 1]}) < 1e-12 && distance(b, Segment{line[i], line[i + 1]}) < 1e-12)
          return true;
    return false;
  };
}

Curve polyline(std::vector<Point> points, bool closed = false) { return {false, closed, std::move(points)}; }

struct Case {
  Request request;
  Mesh after;
};

Request request(Mesh before, std::vector<Curve> cuts) {
  return {.before = std::move(before), .cuts = std::move(cuts), .tolerance = 0, .snap = 1e-12, .vertex_tolerance = 0};
}

/// A slanted cut through the whole sheet.
Case straight(int n = 8) {
  const Point p{-0.1, 0.237}, q{1.1, 0.811};
  return {request(grid(n), {polyline({p, q})}), open(split(grid(n), p, q), on({{p, q}}))};
}

/// A cut from the left border to a tip on the edge between the third and the fourth column.
Case partial(int n = 8) {
  const Point p{0, 0.3}, q{1, 0.8};
  const Point tip{0.375, 0.4875};
  return {request(grid(n), {polyline({p, tip})}), open(split(grid(n), p, q), on({{p, tip}}))};
}

/// A square of four grid squares in the middle, along mesh edges.
Case cut_out() {
  const std::vector<Point> square{{0.25, 0.25}, {0.75, 0.25}, {0.75, 0.75}, {0.25, 0.75}};
  std::vector<Point> loop(square);
  loop.push_back(square.front());
  return {request(grid(4), {polyline(square, true)}), open(grid(4), on({loop}))};
}

Case crossing() {
  const Point a{-1, 0.21}, b{2, 0.83}, c{0.32, -1}, d{0.67, 2};
  const Mesh welded = split(split(grid(8), a, b), c, d);
  return {request(grid(8), {polyline({a, b}), polyline({c, d})}), open(welded, on({{a, b}, {c, d}}))};
}

std::string explain(const Judgement& j) {
  std::string text = j.verdict;
  for (const std::string& p : j.problems) text += "\n  " + p;
  return text;
}

void expect_ok(const Case& c, int pieces) {
  const Judgement j = judge(c.request, c.after);
  EXPECT_TRUE(j.ok) << explain(j);
  EXPECT_EQ(j.verdict, "ok");
  EXPECT_EQ(j.pieces, pieces);
  EXPECT_EQ(j.expected_pieces, pieces);
  EXPECT_LT(std::abs(j.area_change), 1e-14);
  EXPECT_LT(j.incision_error, 1e-12);
}

void expect_verdict(const std::string& verdict, const Case& c) {
  const Judgement j = judge(c.request, c.after);
  EXPECT_EQ(j.verdict, verdict) << explain(j);
  EXPECT_FALSE(j.ok);
  EXPECT_FALSE(j.problems.empty());
}

int vertex_at(const Mesh& mesh, const Point& p) {
  for (int v = 0; v < int(mesh.rest.size()); ++v)
    if (distance(mesh.rest[v], p) < 1e-9) return v;
  throw std::logic_error("no such vertex");
}

// ------------------------------------------------------------------ correct cuts

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
  EXPECT_EQ(loop(2.2e-12 / extent).verdict, "incision");
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

/// The grid sheared so that its middle row follows a Bezier curve, and opened there.
Case along_bezier(int n) {
  const Curve wave{true, false, {{-0.2, 0.2}, {0.2, 1.6}, {0.6, -0.6}, {1.2, 0.8}}};
  const auto height = [&](double x) {
    double low = 0, high = 1;
    const auto at = [&](double t, int i) {
      const auto& p = wave.points;
      return std::pow(1 - t, 3) * p[0][i] + 3 * t * std::pow(1 - t, 2) * p[1][i] + 3 * t * t * (1 - t) * p[2][i] +
             t * t * t * p[3][i];
    };
    for (int i = 0; i < 60; ++i) (at((low + high) / 2, 0) < x ? low : high) = (low + high) / 2;
    return at(low, 1);
  };
  Mesh sheet = grid(n);
  Mesh after = open(sheet, on({{{0, 0.5}, {1, 0.5}}}));
  for (Mesh* mesh : {&sheet, &after})
    for (Point& p : mesh->rest) p[1] += height(p[0]) - 0.5;
  Case c{request(sheet, {wave}), after};
  c.request.tolerance = 0.05 / n, c.request.vertex_tolerance = 1e-9;
  return c;
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
  r.tolerance = infinity, r.vertex_tolerance = infinity;
  const Mesh after = open(grid(4), on({diamond}));
  const Judgement j = judge(r, after);
  EXPECT_TRUE(j.ok) << explain(j);
  EXPECT_EQ(j.expected_pieces, 2);
  EXPECT_NEAR(j.incision_error, 0.25 * (std::numbers::sqrt2 - 1), 2e-4);  // at the corners of the square
  r.tolerance = 0.1;
  EXPECT_EQ(judge(r, after).verdict, "incision");
  r.exact_incision = false;
  EXPECT_TRUE(judge(r, after).ok);
}

// ------------------------------------------------------------------ seeded faults

TEST(Rejects, FlippedTriangle) {
  for (int t : {0, 5, 100}) {
    Case c = straight();
    std::swap(c.after.triangles[t][0], c.after.triangles[t][1]);
    expect_verdict("inverted", c);
  }
}

TEST(Rejects, ZeroArea) {
  Case c = straight();
  const auto& t = c.after.triangles[3];
  c.after.rest[t[2]] = c.after.rest[t[0]];
  expect_verdict("inverted", c);
}

TEST(Rejects, SwappedIndices) {
  for (std::size_t t = 0; t + 9 < straight().after.triangles.size(); t += 7) {
    Case c = straight();
    std::swap(c.after.triangles[t][0], c.after.triangles[t + 9][1]);
    EXPECT_FALSE(judge(c.request, c.after).ok) << t;
  }
}

TEST(Rejects, VertexMovedAcrossTheOppositeEdge) {
  Case c = cut_out();
  c.after.rest[vertex_at(c.after, {0.5, 0.5})] = {0.5, 0.76};
  expect_verdict("inverted", c);
}

TEST(Rejects, EveryDroppedTriangle) {
  const Case good = straight(4);
  for (std::size_t t = 0; t < good.after.triangles.size(); ++t) {
    Case c = good;
    c.after.triangles.erase(c.after.triangles.begin() + long(t));
    const std::string verdict = judge(c.request, c.after).verdict;
    EXPECT_TRUE(verdict == "leak" || verdict == "non_manifold" || verdict == "unused_vertex") << t << " " << verdict;
  }
}

TEST(Rejects, EveryDuplicatedTriangle) {
  const Case good = straight(4);
  for (std::size_t t = 0; t < good.after.triangles.size(); ++t) {
    Case c = good;
    c.after.triangles.push_back(c.after.triangles[t]);
    expect_verdict("non_manifold", c);
  }
}

TEST(Rejects, OverlappingTriangleWithItsOwnVertices) {
  Case c = straight();
  const int first = int(c.after.rest.size());
  for (int v : c.after.triangles[9]) c.after.rest.push_back(Point(c.after.rest[v]));
  c.after.triangles.push_back({first, first + 1, first + 2});
  expect_verdict("leak", c);
}

/// One triangle is split at the middle of an edge, its neighbour is not: a T-junction.
TEST(Rejects, EveryUnsplitNeighbour) {
  const Case good = straight(4);
  for (std::size_t t = 0; t < good.after.triangles.size(); ++t) {
    Case c = good;
    const auto [p, q, r] = c.after.triangles[t];
    const int middle = int(c.after.rest.size());
    c.after.rest.push_back(between(c.after.rest[p], c.after.rest[q], 0.5));
    c.after.triangles[t] = {p, middle, r};
    c.after.triangles.push_back({middle, q, r});
    const std::string verdict = judge(c.request, c.after).verdict;
    const bool on_border = c.after.rest[p][1] == c.after.rest[q][1] && std::fmod(c.after.rest[p][1], 1.0) == 0;
    const bool on_side = c.after.rest[p][0] == c.after.rest[q][0] && std::fmod(c.after.rest[p][0], 1.0) == 0;
    if (on_border || on_side) {
      EXPECT_EQ(verdict, "ok");  // the border has no neighbour
    } else {
      EXPECT_TRUE(verdict == "leak" || verdict == "inverted" || verdict == "non_manifold") << t << " " << verdict;
    }
  }
}

TEST(Rejects, PathVertexNotDoubled) {
  Case c = straight();
  const Mesh& m = c.after;
  for (int v = 0; v < int(m.rest.size()); ++v)
    for (int w = v + 1; w < int(m.rest.size()); ++w) {
      if (m.rest[v] != m.rest[w]) continue;
      Case joined = c;
      for (auto& t : joined.after.triangles)
        for (int& i : t)
          if (i == w) i = v;
      const Judgement j = judge(joined.request, joined.after);
      EXPECT_EQ(j.verdict, "non_manifold") << explain(j);
    }
}

TEST(Rejects, EdgesNotOpened) {
  Case c = straight();
  const Point p = c.request.cuts[0].points[0], q = c.request.cuts[0].points[1];
  c.after = open(split(grid(8), p, q), [&](const Point& a, const Point& b) {
    return on({{p, q}})(a, b) && !(std::min(a[0], b[0]) > 0.4 && std::max(a[0], b[0]) < 0.6);
  });
  expect_verdict("wrong_pieces", c);
  c = partial();
  const Point tip = c.request.cuts[0].points[1];
  c.after = open(split(grid(8), {0, 0.3}, {1, 0.8}), on({{{0.125, 0.3625}, tip}}));
  expect_verdict("incision", c);
}

TEST(Rejects, PathFromFarOutsideNotOpened) {
  for (double far : {1e9, 1e59}) {
    Case c{request(grid(4), {polyline({{-far, 0.25}, {0.75, 0.25}})}), grid(4)};
    expect_verdict("incision", c);
    c.after = open(grid(4), on({{{0, 0.25}, {0.5, 0.25}}}));
    expect_verdict("incision", c);
  }
}

TEST(Rejects, CutThatStopsShort) {
  Case c = partial();
  c.after = open(split(grid(8), {0, 0.3}, {1, 0.8}), on({{{0, 0.3}, {0.25, 0.425}}}));
  expect_verdict("incision", c);
  c.after = grid(8);
  c.request.tolerance = infinity;
  expect_verdict("incision", c);
}

TEST(Rejects, IncisionNobodyAskedFor) {
  Case c = partial();
  const std::vector<Point> extra{{0.25, 0.75}, {0.5, 0.75}};
  c.after = open(split(grid(8), {0, 0.3}, {1, 0.8}), on({{{0, 0.3}, {0.375, 0.4875}}, extra}));
  expect_verdict("incision", c);
  expect_verdict("incision", {request(grid(8), {}), open(grid(8), on({extra}))});
}

TEST(Rejects, ClosedOlderIncision) {
  const std::vector<Point> slit{{0.25, 0.5}, {0.75, 0.5}};
  Case c{request(open(grid(4), on({slit})), {}), grid(4)};
  c.request.keeps_vertices = false;
  expect_verdict("incision", c);
}

TEST(Rejects, VertexMovedOffTheIncision) {
  Case c = partial();
  const Point at{0.125, 0.3625};
  c.request.tolerance = 0.01;
  for (Point& p : c.after.rest)
    if (distance(p, at) < 1e-9) p[1] += 1e-3;
  c.request.vertex_tolerance = infinity;
  EXPECT_TRUE(judge(c.request, c.after).ok);
  EXPECT_NEAR(judge(c.request, c.after).incision_error, 1e-3, 2e-4);
  c.request.vertex_tolerance = 1e-4;
  expect_verdict("incision", c);
  c.request.vertex_tolerance = infinity, c.request.tolerance = 1e-4;
  expect_verdict("incision", c);
}

TEST(Rejects, OneLipMovedByOneUlp) {
  Case c = partial();
  for (Point& p : c.after.rest)
    if (distance(p, Point{0.125, 0.3625}) < 1e-9) {
      p[1] = std::nextafter(p[1], 1.0);
      break;
    }
  expect_verdict("leak", c);
}

TEST(Rejects, InputVertexMovedByOneUlp) {
  Case c = straight();
  const int v = vertex_at(c.after, {0.5, 0.125});
  c.after.rest[v][0] = std::nextafter(c.after.rest[v][0], 1.0);
  expect_verdict("moved_vertex", c);
  c.request.keeps_vertices = false;
  EXPECT_TRUE(judge(c.request, c.after).ok);
}

TEST(Rejects, BorderVertexMoved) {
  Case c = straight();
  c.request.keeps_vertices = false;
  const int v = vertex_at(c.after, {0.5, 0});
  c.after.rest[v][1] = -1e-9;
  expect_verdict("leak", c);
}

TEST(Rejects, UnusedVertex) {
  Case c = straight();
  c.after.rest.push_back({0.5, 0.5});
  expect_verdict("unused_vertex", c);
}

TEST(Rejects, NotFinite) {
  for (const double bad : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
    Case c = straight();
    c.after.rest[7][1] = bad;
    expect_verdict("not_finite", c);
  }
}

TEST(Rejects, BadIndex) {
  const int count = int(straight().after.rest.size());
  for (int bad : {-1, count, 1 << 30}) {
    Case c = straight();
    c.after.triangles[4][2] = bad;
    expect_verdict("bad_index", c);
  }
  Case c = straight();
  c.after.triangles[4][2] = c.after.triangles[4][0];
  expect_verdict("bad_index", c);
}

TEST(Rejects, EmptyResult) {
  Case c = straight();
  c.after = {};
  EXPECT_FALSE(judge(c.request, c.after).ok);
}

TEST(Rejects, BadRequests) {
  const Case good = straight();
  const auto thrown = [&](auto change) {
    Case c = good;
    change(c.request);
    EXPECT_THROW(judge(c.request, c.after), std::invalid_argument);
  };
  thrown([](Request& r) { r.before.triangles.clear(); });
  thrown([](Request& r) { r.before.triangles[3][0] = -1; });
  thrown([](Request& r) { std::swap(r.before.triangles[3][0], r.before.triangles[3][1]); });
  thrown([](Request& r) { r.before.triangles.push_back(r.before.triangles[3]); });
  thrown([](Request& r) { r.before.rest[2][0] = infinity; });
  thrown([](Request& r) { r.snap = -1; });
  thrown([](Request& r) { r.cuts[0].points.clear(); });
  thrown([](Request& r) { r.cuts[0].bezier = true; });
  thrown([](Request& r) { r.cuts[0].points[0][0] = std::numeric_limits<double>::quiet_NaN(); });
  thrown([](Request& r) { r.cuts[0] = {true, true, {{0, 0}, {1, 0}, {1, 1}, {0, 1}}}; });
}

// ------------------------------------------------------------------ parts

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
  EXPECT_NEAR(static_cast<double>(area(mesh) / (1024.0L * 1024.0L)), 1, 1e-15);
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
