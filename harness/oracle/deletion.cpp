#include "harness/oracle/deletion.h"

#include <algorithm>
#include <limits>

#include "harness/oracle/conversions.h"
#include "harness/oracle/exact.h"
#include "harness/oracle/search.h"

namespace cutbench::oracle {

namespace {

using Corners = std::array<Point, 3>;

Corners corners(const Mesh& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return {mesh.rest[to_size(a)], mesh.rest[to_size(b)], mesh.rest[to_size(c)]};
}

/// The corners of all triangles, each from its smallest on, sorted.
std::vector<Corners> sorted(const Mesh& mesh) {
  std::vector<Corners> all;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) all.push_back(corners(mesh, t));
  for (Corners& c : all) std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
  std::sort(all.begin(), all.end());
  return all;
}

bool holds(const std::vector<Corners>& all, Corners c) {
  std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
  return std::binary_search(all.begin(), all.end(), c);
}

double from_path(const Segment& s, const Corners& c) {
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = true;
  for (std::size_t k = 0; k < 3; ++k) {
    const Segment side{c[k], c[(k + 1) % 3]};
    inside &= orientation(side[0], side[1], s[0]) > 0;
    if (meet(s, side)) return 0;
    nearest =
        std::min({nearest, oracle::distance(s[0], side), oracle::distance(s[1], side), oracle::distance(side[0], s)});
  }
  return inside ? 0 : nearest;
}

/// Is some part of s inside the triangle, and farther than `near` from all of its sides?
bool is_deep_inside(const Segment& s, const Corners& c, double near) {
  double begin = 0, end = 1;  // of that part
  for (std::size_t k = 0; k < 3; ++k) {
    const Point along = direction(c[k], c[(k + 1) % 3]);
    const double first = cross(along, minus(s[0], c[k])) - near, last = cross(along, minus(s[1], c[k])) - near;
    if (first <= 0 && last <= 0) return false;
    if (first < 0) begin = std::max(begin, first / (first - last));
    if (last < 0) end = std::min(end, first / (first - last));
  }
  return begin < end;
}

}  // namespace

Deletion judge_deletion(const Mesh& before, const Mesh& after, const std::vector<Segment>& path, double near) {
  const SegmentSearch search(path);
  const auto on_path = [&](const Corners& c, auto meets) {
    BoxTree::Box box{c[0], c[0]};
    for (const Point& p : c)
      for (std::size_t i = 0; i < 2; ++i) {
        box.low[i] = std::min(box.low[i], p[i] - near);
        box.high[i] = std::max(box.high[i], p[i] + near);
      }
    bool found = false;
    search.for_each_in(box, [&](int i) { found = found || meets(path[to_size(i)]); });
    return found;
  };

  const std::vector<Corners> old = sorted(before), kept = sorted(after);
  Deletion result;
  for (std::size_t t = 0; t < after.triangles.size(); ++t) {
    const Corners c = corners(after, t);
    if (!holds(old, c)) result.invented.push_back(to_int(t));
    if (on_path(c, [&](const Segment& s) { return is_deep_inside(s, c, near); })) result.left.push_back(to_int(t));
  }
  for (std::size_t t = 0; t < before.triangles.size(); ++t) {
    const Corners c = corners(before, t);
    if (!holds(kept, c) && !on_path(c, [&](const Segment& s) { return from_path(s, c) <= near; }))
      result.unasked.push_back(to_int(t));
  }
  return result;
}

}  // namespace cutbench::oracle
