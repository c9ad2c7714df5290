// The oracle rejects every seeded fault.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "harness/base/conversions.h"
#include "tests/oracle_cases.h"

namespace cutbench::oracle {
namespace {

TEST(Rejects, FlippedTriangle) {
  for (int t : {0, 5, 100}) {
    Case c = straight();
    std::swap(c.after.triangles[t][0], c.after.triangles[t][1]);
    expect_verdict(Verdict::inverted, c);
  }
}

TEST(Rejects, ZeroArea) {
  Case c = straight();
  const auto& t = c.after.triangles[3];
  c.after.rest[t[2]] = c.after.rest[t[0]];
  expect_verdict(Verdict::inverted, c);
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
  expect_verdict(Verdict::inverted, c);
}

TEST(Rejects, EveryDroppedTriangle) {
  const Case good = straight(4);
  for (std::size_t t = 0; t < good.after.triangles.size(); ++t) {
    Case c = good;
    c.after.triangles.erase(c.after.triangles.begin() + long(t));
    const Verdict verdict = judge(c.request, c.after).verdict;
    EXPECT_TRUE(verdict == Verdict::leak || verdict == Verdict::non_manifold || verdict == Verdict::unused_vertex)
        << t << " " << verdict;
  }
}

TEST(Rejects, EveryDuplicatedTriangle) {
  const Case good = straight(4);
  for (std::size_t t = 0; t < good.after.triangles.size(); ++t) {
    Case c = good;
    c.after.triangles.push_back(c.after.triangles[t]);
    expect_verdict(Verdict::non_manifold, c);
  }
}

TEST(Rejects, OverlappingTriangleWithItsOwnVertices) {
  Case c = straight();
  const int first = int(c.after.rest.size());
  for (int v : c.after.triangles[9]) c.after.rest.push_back(Point(c.after.rest[v]));
  c.after.triangles.push_back({first, first + 1, first + 2});
  expect_verdict(Verdict::leak, c);
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
    const Verdict verdict = judge(c.request, c.after).verdict;
    const bool on_border = c.after.rest[p][1] == c.after.rest[q][1] && std::fmod(c.after.rest[p][1], 1.0) == 0;
    const bool on_side = c.after.rest[p][0] == c.after.rest[q][0] && std::fmod(c.after.rest[p][0], 1.0) == 0;
    if (on_border || on_side) {
      EXPECT_EQ(verdict, Verdict::ok);  // the border has no neighbour
    } else {
      EXPECT_TRUE(verdict == Verdict::leak || verdict == Verdict::inverted || verdict == Verdict::non_manifold)
          << t << " " << verdict;
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
      EXPECT_EQ(j.verdict, Verdict::non_manifold) << explain(j);
    }
}

TEST(Rejects, EdgesNotOpened) {
  Case c = straight();
  const Point p = c.request.cuts[0].points[0], q = c.request.cuts[0].points[1];
  c.after = open(split(grid(8), p, q), [&](const Point& a, const Point& b) {
    return on({{p, q}})(a, b) && !(std::min(a[0], b[0]) > 0.4 && std::max(a[0], b[0]) < 0.6);
  });
  expect_verdict(Verdict::wrong_pieces, c);
  c = partial();
  const Point tip = c.request.cuts[0].points[1];
  c.after = open(split(grid(8), {0, 0.3}, {1, 0.8}), on({{{0.125, 0.3625}, tip}}));
  expect_verdict(Verdict::incision, c);
}

TEST(Rejects, PathFromFarOutsideNotOpened) {
  for (double far : {1e9, 1e59}) {
    Case c{request(grid(4), {polyline({{-far, 0.25}, {0.75, 0.25}})}), grid(4)};
    expect_verdict(Verdict::incision, c);
    c.after = open(grid(4), on({{{0, 0.25}, {0.5, 0.25}}}));
    expect_verdict(Verdict::incision, c);
  }
}

TEST(Rejects, CutThatStopsShort) {
  Case c = partial();
  c.after = open(split(grid(8), {0, 0.3}, {1, 0.8}), on({{{0, 0.3}, {0.25, 0.425}}}));
  expect_verdict(Verdict::incision, c);
  c.after = grid(8);
  c.request.tolerance = infinity;
  expect_verdict(Verdict::incision, c);
}

TEST(Rejects, IncisionNobodyAskedFor) {
  Case c = partial();
  const std::vector<Point> extra{{0.25, 0.75}, {0.5, 0.75}};
  c.after = open(split(grid(8), {0, 0.3}, {1, 0.8}), on({{{0, 0.3}, {0.375, 0.4875}}, extra}));
  expect_verdict(Verdict::incision, c);
  expect_verdict(Verdict::incision, {request(grid(8), {}), open(grid(8), on({extra}))});
}

TEST(Rejects, ClosedOlderIncision) {
  const std::vector<Point> slit{{0.25, 0.5}, {0.75, 0.5}};
  Case c{request(open(grid(4), on({slit})), {}), grid(4)};
  c.request.keeps_vertices = false;
  expect_verdict(Verdict::incision, c);
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
  expect_verdict(Verdict::incision, c);
  c.request.vertex_tolerance = infinity;
  c.request.tolerance = 1e-4;
  expect_verdict(Verdict::incision, c);
}

TEST(Rejects, OneLipMovedByOneUlp) {
  Case c = partial();
  for (Point& p : c.after.rest)
    if (distance(p, Point{0.125, 0.3625}) < 1e-9) {
      p[1] = std::nextafter(p[1], 1.0);
      break;
    }
  expect_verdict(Verdict::leak, c);
}

TEST(Rejects, InputVertexMovedByOneUlp) {
  Case c = straight();
  const int v = vertex_at(c.after, {0.5, 0.125});
  c.after.rest[v][0] = std::nextafter(c.after.rest[v][0], 1.0);
  expect_verdict(Verdict::moved_vertex, c);
  c.request.keeps_vertices = false;
  EXPECT_TRUE(judge(c.request, c.after).ok);
}

TEST(Rejects, BorderVertexMoved) {
  Case c = straight();
  c.request.keeps_vertices = false;
  const int v = vertex_at(c.after, {0.5, 0});
  c.after.rest[v][1] = -1e-9;
  expect_verdict(Verdict::leak, c);
}

TEST(Rejects, UnusedVertex) {
  Case c = straight();
  c.after.rest.push_back({0.5, 0.5});
  expect_verdict(Verdict::unused_vertex, c);
}

TEST(Rejects, NotFinite) {
  for (const double bad : {infinity, -infinity, std::numeric_limits<double>::quiet_NaN()}) {
    Case c = straight();
    c.after.rest[7][1] = bad;
    expect_verdict(Verdict::not_finite, c);
  }
}

TEST(Rejects, BadIndex) {
  const int count = int(straight().after.rest.size());
  for (int bad : {-1, count, 1 << 30}) {
    Case c = straight();
    c.after.triangles[4][2] = bad;
    expect_verdict(Verdict::bad_index, c);
  }
  Case c = straight();
  c.after.triangles[4][2] = c.after.triangles[4][0];
  expect_verdict(Verdict::bad_index, c);
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

// --- deletion --------------------------------------------------------------------------------------------------------

/// What is left of a grid when all triangles with a piece of y = 0.55 in their interior are gone.
struct Deleted {
  Deleted() {
    before = grid(8);
    request.before = before;
    request.cuts = {{false, false, {{-0.1, 0.55}, {1.1, 0.55}}}};
    request.tolerance = 1e-9;
    request.keeps_area = false;
    request.keeps_vertices = false;
    for (std::size_t t = 0; t < before.triangles.size(); ++t) {
      double low = 1, high = 0;
      for (int v : before.triangles[t]) {
        low = std::min(low, before.rest[v][1]);
        high = std::max(high, before.rest[v][1]);
      }
      (low < 0.55 && high > 0.55 ? gone : stays).push_back(before.triangles[t]);
    }
  }
  Judgement judge(std::vector<std::array<int, 3>> triangles) const {
    Mesh after;
    std::map<int, int> number;
    for (auto& t : triangles)
      for (int& v : t) {
        const auto [it, fresh] = number.try_emplace(v, to_int(after.rest.size()));
        if (fresh) after.rest.push_back(before.rest[v]);
        v = it->second;
      }
    after.triangles = std::move(triangles);
    return oracle::judge(request, after);
  }

  Mesh before;
  Request request;
  std::vector<std::array<int, 3>> gone, stays;
};

TEST(Deletion, OfTheCrossedTrianglesIsRight) {
  const Deleted d;
  ASSERT_EQ(d.gone.size(), 16u);
  const Judgement found = d.judge(d.stays);
  EXPECT_TRUE(found.ok) << found.problems.front();
  EXPECT_EQ(found.pieces, 2);
  EXPECT_NEAR(found.area_change, -0.125, 1e-12);
}

TEST(Deletion, OfOneMoreOrOneLessIsNot) {
  const Deleted d;
  for (std::size_t t = 0; t < d.stays.size(); t += 3) {
    auto less = d.stays;
    less.erase(less.begin() + to_index(t));
    const Verdict verdict = d.judge(less).verdict;
    EXPECT_TRUE(verdict == Verdict::deletion || verdict == Verdict::non_manifold) << t << " " << verdict;
  }
  for (const auto& left : d.gone) {
    auto more = d.stays;
    more.push_back(left);
    const Verdict verdict = d.judge(more).verdict;
    EXPECT_TRUE(verdict == Verdict::deletion || verdict == Verdict::non_manifold) << verdict;
  }
}

TEST(Deletion, MakesNoNewTriangles) {
  Deleted d;
  auto other = d.stays;
  ASSERT_EQ(other[0], (std::array{0, 1, 10}));
  ASSERT_EQ(other[1], (std::array{0, 10, 9}));
  other[0] = {0, 1, 9};
  other[1] = {1, 10, 9};
  EXPECT_EQ(d.judge(other).verdict, Verdict::deletion);
}

}  // namespace
}  // namespace cutbench::oracle
