#include <algorithm>
#include <map>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/mesh/seam_pairs.h"

namespace cutbench {

namespace {

/// Consecutive edges of the border, by their vertices.
using BorderLine = std::vector<std::int32_t>;

class SeamFinder {
 public:
  explicit SeamFinder(const MeshData& mesh) : mesh_(mesh), next_(mesh.rest.size(), -1) { find_border(); }

  std::vector<Seam> find() {
    std::vector<BorderLine> edges;
    for (const auto& [a, b] : border_) edges.push_back({a, b});
    join(edges);
    join(straight_lines());
    return std::move(seams_);
  }

 private:
  std::int32_t point(std::int32_t v) const { return mesh_.sewn[to_size(v)]; }
  Point2 rest(std::int32_t v) const { return mesh_.rest[to_size(v)]; }
  Point3 in_space(std::int32_t v) const { return mesh_.deformed[to_size(v)]; }

  void find_border() {
    using Edge = std::pair<std::int32_t, std::int32_t>;
    std::map<Edge, int> uses;
    const auto for_each_edge = [&](const auto& act) {
      for (const auto& t : mesh_.triangles)
        for (std::size_t k = 0; k < 3; ++k) act(t[k], t[(k + 1) % 3]);
    };
    for_each_edge([&](std::int32_t a, std::int32_t b) { ++uses[std::minmax(a, b)]; });
    for_each_edge([&](std::int32_t a, std::int32_t b) {
      if (uses[std::minmax(a, b)] == 1) border_.emplace_back(a, b);
    });
    std::map<std::int32_t, std::int32_t> first;
    shared_.assign(mesh_.rest.size(), false);
    for (const auto& [a, b] : border_) {
      next_[to_size(a)] = b;
      places_.insert({{rest(a).x, rest(a).y}, a});
      const auto [other, is_first] = first.try_emplace(point(a), a);
      if (!is_first) shared_[to_size(a)] = shared_[to_size(other->second)] = true;
    }
  }

  /// Lines between the same two points are a seam, each later one with the first; the lips of an incision are none.
  void join(const std::vector<BorderLine>& lines) {
    std::map<std::pair<std::int32_t, std::int32_t>, const BorderLine*> first_of;  // by the numbers of the points
    for (const BorderLine& line : lines) {
      const std::int32_t p = point(line.front()), q = point(line.back());
      const auto [other, is_first] = first_of.try_emplace(std::minmax(p, q), &line);
      if (is_first || p == q) continue;
      const Seam seam{side(*other->second), side(line)};
      if (seam.first == seam.second) continue;
      seams_.push_back(seam);
      for (const BorderLine* joined : {other->second, &line}) next_[to_size(joined->front())] = -1;
    }
  }

  /// The rest positions of its ends, in the order of their points.
  std::array<Point2, 2> side(const BorderLine& line) const {
    const std::array ends{rest(line.front()), rest(line.back())};
    return point(line.front()) < point(line.back()) ? ends : std::array{ends[1], ends[0]};
  }

  /// From vertex to vertex that another side has, too, over those that this side alone has.
  std::vector<BorderLine> straight_lines() const {
    std::vector<BorderLine> lines;
    for (const auto& [a, b] : border_) {
      if (!shared_[to_size(a)] || next_[to_size(a)] != b) continue;
      BorderLine line{a, b};
      while (!shared_[to_size(line.back())])
        if (const std::int32_t next = straight_on(line); next >= 0)
          line.push_back(next);
        else
          break;
      if (shared_[to_size(line.back())] && is_straight(line)) lines.push_back(line);
    }
    return lines;
  }

  /// The next vertex of the border; past an incision that ends here, of its other lip. -1: none
  std::int32_t straight_on(const BorderLine& line) const {
    const Point2 at = rest(line.back()), way = at - rest(line.front());
    for (auto [twin, end] = places_.equal_range({at.x, at.y}); twin != end; ++twin) {
      const std::int32_t next = next_[to_size(twin->second)];
      if (next < 0) continue;
      const Point2 step = rest(next) - at;
      if (dot(way, step) > 0 && std::abs(cross(way, step)) <= beside_line * dot(way, step)) return next;
    }
    return -1;
  }

  /// At rest and in space, with the same shares of the length.
  bool is_straight(const BorderLine& line) const {
    const Point2 from = rest(line.front()), way = rest(line.back()) - from;
    const Point3 from_in_space = in_space(line.front()), way_in_space = in_space(line.back()) + -1.0 * from_in_space;
    return std::all_of(line.begin(), line.end(), [&](std::int32_t v) {
      const double share = dot(way, rest(v) - from) / squared_length(way);
      const Point3 off = in_space(v) + -1.0 * (from_in_space + share * way_in_space);
      return length(rest(v) - from - share * way) <= beside_line * length(way) &&
             length(off) <= beside_line * length(way_in_space);
    });
  }

  const MeshData& mesh_;
  std::vector<std::pair<std::int32_t, std::int32_t>> border_;
  std::vector<std::int32_t> next_;  // per vertex, along the border where it is on no seam yet; -1: none
  std::vector<bool> shared_;        // per vertex: another one of the border is sewn to it
  std::multimap<std::pair<double, double>, std::int32_t> places_;  // vertices of the border
  std::vector<Seam> seams_;
};

}  // namespace

std::vector<Seam> seams_of(const MeshData& mesh) {
  return mesh.sewn.empty() ? std::vector<Seam>() : SeamFinder(mesh).find();
}

}  // namespace cutbench
