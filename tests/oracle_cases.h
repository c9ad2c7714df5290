// Correct cuts for the tests of the oracle, made by a cutter as simple as it can be, which shares no code with what the
// oracle judges.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <stdexcept>

#include "harness/base/conversions.h"
#include "harness/oracle/exact.h"
#include "harness/oracle/oracle.h"

namespace cutbench::oracle {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The unit square in n x n squares, each divided by its rising diagonal.
inline Mesh grid(int n) {
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
inline Mesh split(const Mesh& mesh, const Point& p, const Point& q) {
  Mesh out{mesh.rest, {}};
  std::map<std::pair<int, int>, int> crossing;
  const auto cut = [&](int a, int b) {
    if (a > b) std::swap(a, b);
    const auto [it, fresh] = crossing.try_emplace({a, b}, to_int(out.rest.size()));
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
inline Mesh open(const Mesh& mesh, const Chooser& chosen) {
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
inline Chooser on(std::vector<std::vector<Point>> lines) {
  return [lines](const Point& a, const Point& b) {
    for (const auto& line : lines)
      for (std::size_t i = 0; i + 1 < line.size(); ++i)
        if (distance(a, Segment{line[i], line[i + 1]}) < 1e-12 && distance(b, Segment{line[i], line[i + 1]}) < 1e-12)
          return true;
    return false;
  };
}

inline Curve polyline(std::vector<Point> points, bool closed = false) { return {false, closed, std::move(points)}; }

struct Case {
  Request request;
  Mesh after;
};

inline Request request(Mesh before, std::vector<Curve> cuts) {
  return {.before = std::move(before), .cuts = std::move(cuts), .tolerance = 0, .snap = 1e-12, .vertex_tolerance = 0};
}

/// A slanted cut through the whole sheet.
inline Case straight(int n = 8) {
  const Point p{-0.1, 0.237}, q{1.1, 0.811};
  return {request(grid(n), {polyline({p, q})}), open(split(grid(n), p, q), on({{p, q}}))};
}

/// A cut from the left border to a tip on the edge between the third and the fourth column.
inline Case partial(int n = 8) {
  const Point p{0, 0.3}, q{1, 0.8};
  const Point tip{0.375, 0.4875};
  return {request(grid(n), {polyline({p, tip})}), open(split(grid(n), p, q), on({{p, tip}}))};
}

/// A square of four grid squares in the middle, along mesh edges.
inline Case cut_out() {
  const std::vector<Point> square{{0.25, 0.25}, {0.75, 0.25}, {0.75, 0.75}, {0.25, 0.75}};
  std::vector<Point> loop(square);
  loop.push_back(square.front());
  return {request(grid(4), {polyline(square, true)}), open(grid(4), on({loop}))};
}

inline Case crossing() {
  const Point a{-1, 0.21}, b{2, 0.83}, c{0.32, -1}, d{0.67, 2};
  const Mesh welded = split(split(grid(8), a, b), c, d);
  return {request(grid(8), {polyline({a, b}), polyline({c, d})}), open(welded, on({{a, b}, {c, d}}))};
}

inline std::string explain(const Judgement& j) {
  std::string text = name_of(j.verdict);
  for (const std::string& p : j.problems) text += "\n  " + p;
  return text;
}

inline void expect_ok(const Case& c, int pieces) {
  const Judgement j = judge(c.request, c.after);
  EXPECT_TRUE(j.ok) << explain(j);
  EXPECT_EQ(j.verdict, Verdict::ok);
  EXPECT_EQ(j.pieces, pieces);
  EXPECT_EQ(j.expected_pieces, pieces);
  EXPECT_LT(std::abs(j.area_change), 1e-14);
  EXPECT_LT(j.incision_error, 1e-12);
}

inline void expect_verdict(Verdict verdict, const Case& c) {
  const Judgement j = judge(c.request, c.after);
  EXPECT_EQ(j.verdict, verdict) << explain(j);
  EXPECT_FALSE(j.ok);
  EXPECT_FALSE(j.problems.empty());
}

inline int vertex_at(const Mesh& mesh, const Point& p) {
  for (int v = 0; v < int(mesh.rest.size()); ++v)
    if (distance(mesh.rest[v], p) < 1e-9) return v;
  throw std::logic_error("no such vertex");
}

/// The grid sheared so that its middle row follows a Bezier curve, and opened there.
inline Case along_bezier(int n) {
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
  c.request.tolerance = 0.05 / n;
  c.request.vertex_tolerance = 1e-9;
  return c;
}

}  // namespace cutbench::oracle
