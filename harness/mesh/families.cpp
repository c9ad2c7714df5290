#include "harness/mesh/families.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

#include "harness/base/conversions.h"
#include "harness/mesh/cgal_kernel.h"
#include "harness/mesh/predicates.h"

namespace cutbench {

namespace {

using Triangles = std::vector<std::array<std::int32_t, 3>>;

MeshData flat(std::vector<Point2> rest, Triangles triangles) {
  MeshData mesh;
  for (Point2 p : rest) mesh.deformed.push_back({p.x, p.y, 0});
  mesh.rest = std::move(rest);
  mesh.triangles = std::move(triangles);
  return mesh;
}

/// The n x n squares row by row; `rising(i, j)` says whether the diagonal of a square goes from lower left to upper
/// right.
MeshData squares(int n, const std::function<bool(int, int)>& rising) {
  std::vector<Point2> rest;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) rest.push_back({to_double(i) / n, to_double(j) / n});
  Triangles triangles;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const std::int32_t a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      if (rising(i, j))
        triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
      else
        triangles.insert(triangles.end(), {{a, b, d}, {b, c, d}});
    }
  return flat(std::move(rest), std::move(triangles));
}

MeshData grid(int n) {
  return squares(n, [](int, int) { return true; });
}

MeshData alternating(int n) {
  return squares(n, [](int i, int j) { return (i + j) % 2 == 0; });
}

/// Each point moves along its ray from the corner: r = max(x, y) becomes a r + (1-a) r^2. Lengths along the ray change
/// by a + 2 (1-a) r, across it by a + (1-a) r: triangles stretch less than twofold, sqrt(area) grows sqrt(2-a)/a fold.
MeshData graded(int n) {
  constexpr double a = 0.14;
  MeshData mesh = squares(n, [](int, int) { return false; });
  for (std::size_t v = 0; v < mesh.rest.size(); ++v) {
    Point2& p = mesh.rest[v];
    p = (a + (1 - a) * std::max(p.x, p.y)) * p;
    mesh.deformed[v] = {p.x, p.y, 0};
  }
  return mesh;
}

/// SplitMix64 (Steele, Lea and Flood 2014): the same numbers everywhere, unlike the distributions of <random>.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// Uniform in [0, 1).
  double unit() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15u;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return to_double((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

/// Points in n x n boxes: whether a place is at least r <= 1/n from all others takes a look at nine boxes.
class SpacedPoints {
 public:
  explicit SpacedPoints(int n) : n_(n), boxes_(to_size(n * n)) {}

  const std::vector<Point2>& points() const { return points_; }

  void add(Point2 p) {
    boxes_[box(row(p.x), row(p.y))].push_back(p);
    points_.push_back(p);
  }

  bool has_room(Point2 p, double r) const {
    for (int j = std::max(0, row(p.y) - 1); j <= std::min(n_ - 1, row(p.y) + 1); ++j)
      for (int i = std::max(0, row(p.x) - 1); i <= std::min(n_ - 1, row(p.x) + 1); ++i)
        for (Point2 q : boxes_[box(i, j)])
          if (squared_length(p - q) < r * r) return false;
    return true;
  }

 private:
  int row(double x) const { return std::min(n_ - 1, to_int(x * n_)); }
  std::size_t box(int i, int j) const { return to_size(j * n_ + i); }

  int n_;
  std::vector<std::vector<Point2>> boxes_;
  std::vector<Point2> points_;
};

/// The border points counter-clockwise, then the interior points row by row (timings must not depend on a random
/// order). Dart throwing with a disc that shrinks when it has missed a thousand times (McCool and Fiume 1992): it ends
/// at exactly the number wanted.
std::vector<Point2> poisson_disc_points(int n) {
  constexpr double first_radius = 0.8, border_distance = 0.6;  // times 1/n; 0.8 is about the densest that darts reach
  SpacedPoints spaced(n);
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < n; ++i) {
      const double s = to_double(i) / n, e = to_double(n - i) / n;
      constexpr double low = 0, high = 1;
      spaced.add(side == 0   ? Point2{s, low}
                 : side == 1 ? Point2{high, s}
                 : side == 2 ? Point2{e, high}
                             : Point2{low, e});
    }
  Random random(1);
  const double margin = border_distance / n;
  double radius = first_radius / n;
  const auto wanted = to_size((n + 1) * (n + 1));
  for (int misses = 0; spaced.points().size() < wanted;) {
    const double x = random.unit(), y = random.unit();
    const Point2 p{margin + (1 - 2 * margin) * x, margin + (1 - 2 * margin) * y};
    if (spaced.has_room(p, radius)) {
      spaced.add(p);
      misses = 0;
    } else if (++misses == 1000) {
      radius *= 0.99;
      misses = 0;
    }
  }
  std::vector<Point2> points = spaced.points();
  std::sort(points.begin() + 4 * n, points.end(), [n](Point2 p, Point2 q) {
    const double row_p = std::floor(p.y * n), row_q = std::floor(q.y * n);
    return std::tuple(row_p, p.x, p.y) < std::tuple(row_q, q.x, q.y);
  });
  return points;
}

/// Sorted, each triangle beginning with its smallest vertex: the order doesn't depend on the version of CGAL.
Triangles delaunay_triangles(const std::vector<Point2>& points) {
  using Vertex = CGAL::Triangulation_vertex_base_with_info_2<std::int32_t, Kernel>;
  using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertex>>;
  std::vector<std::pair<Kernel::Point_2, std::int32_t>> numbered;
  for (Point2 p : points) numbered.emplace_back(to_cgal(p), to_int32(numbered.size()));
  const Delaunay delaunay(numbered.begin(), numbered.end());
  Triangles triangles;
  for (const auto& face : delaunay.finite_face_handles()) {
    auto& triangle = triangles.emplace_back();
    for (int k = 0; k < 3; ++k) triangle[to_size(k)] = face->vertex(k)->info();
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
  }
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

/// Moves each point from number `first` on to the centroid of the triangles round it (weighted by area).
void smooth(std::vector<Point2>& points, const Triangles& triangles, std::size_t first) {
  std::vector<Point2> sum(points.size());
  std::vector<double> weight(points.size());
  for (const auto& [a, b, c] : triangles) {
    const Point2 p = points[to_size(a)], q = points[to_size(b)], r = points[to_size(c)];
    const double area = cross(q - p, r - p);
    for (const auto v : {to_size(a), to_size(b), to_size(c)}) {
      sum[v] = sum[v] + area * (p + q + r);
      weight[v] += 3 * area;
    }
  }
  for (std::size_t v = first; v < points.size(); ++v) points[v] = {sum[v].x / weight[v], sum[v].y / weight[v]};
}

/// 4 n border points and (n-1)^2 others give 2 n^2 triangles whatever the triangulation (Euler).
MeshData delaunay(int n) {
  std::vector<Point2> points = poisson_disc_points(n);
  for (int pass = 0; pass < 2; ++pass) smooth(points, delaunay_triangles(points), to_size(4 * n));
  Triangles triangles = delaunay_triangles(points);
  return flat(std::move(points), std::move(triangles));
}

constexpr const char* names[] = {"grid", "alternating", "delaunay", "graded"};
constexpr MeshData (*makers[])(int) = {grid, alternating, delaunay, graded};

}  // namespace

std::span<const char* const> sheet_families() { return names; }

MeshData make_sheet(const std::string& family, int n) {
  if (n < 1 || n > 2000)
    throw InputError("sheet '" + family + "': n = " + std::to_string(n) + " squares a side; choose 1 to 2000");
  std::string known;
  for (std::size_t i = 0; i < std::size(names); ++i) {
    if (family == names[i]) return makers[i](n);
    known += (known.empty() ? "" : ", ") + std::string(names[i]);
  }
  throw InputError("sheet family '" + family + "' is unknown; choose one of " + known);
}

int squares_per_side(std::int64_t triangles) {
  constexpr std::int64_t most = 1000000;
  const auto n = triangles < 0 ? 0 : std::lround(std::sqrt(to_double(std::min(triangles, most)) / 2));
  if (n >= 1 && 2 * n * n == triangles) return to_int(n);
  throw InputError("resolution " + std::to_string(triangles) +
                   ": a sheet has 2 n^2 triangles, at most 1000000, such as 800, 1800, 3200, 5000, 7200, 9800, 12800");
}

}  // namespace cutbench
