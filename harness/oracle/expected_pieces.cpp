#include "harness/oracle/expected_pieces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "harness/oracle/conversions.h"
#include "harness/oracle/exact.h"
#include "harness/oracle/planar_map.h"
#include "harness/oracle/search.h"

namespace cutbench::oracle {
namespace {

/// From an open end of a path a little further on, so that a path which ends just short of something reaches it.
void add_extension(const Point& end, const Point& before, double length, std::vector<Segment>& extensions) {
  const Point d = direction(before, end);
  const Point beyond{end[0] + length * d[0], end[1] + length * d[1]};
  extensions.push_back({end, beyond});
}

/// From each end of a segment that lies within `tolerance` of another segment across that one, or to its end, where one
/// of the two is of a path (those that have its number; others have -1): what nearly touches does. Segments of one of
/// the `tiny` paths are left alone with each other. Returns how many stretches of paths nearly touch other pieces of
/// their own path.
int add_near_touches(const std::vector<Segment>& segments, const std::vector<int>& path, const std::vector<char>& tiny,
                     double tolerance, std::vector<Segment>& extensions) {
  const SegmentSearch search(segments);
  std::set<std::pair<Point, int>> done;
  int stretches = 0;
  std::size_t behind_stretch = 0;
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (const Point& p : segments[i])
      search.for_each_in({{p[0] - tolerance, p[1] - tolerance}, {p[0] + tolerance, p[1] + tolerance}}, [&](int j) {
        const Segment& s = segments[j];
        if (p == s[0] || p == s[1] || (path[i] == path[j] && (path[i] < 0 || tiny[path[i]]))) return;
        if (distance(p, s) > tolerance || !done.insert({p, j}).second) return;
        if (path[i] == path[j]) {
          stretches += stretches == 0 || i > behind_stretch;
          behind_stretch = i + 1;
        }
        const Point d = direction(s[0], s[1]);
        const auto is_beyond = [&](const Point& end, double way) {
          return way * ((p[0] - end[0]) * d[0] + (p[1] - end[1]) * d[1]) > 0;
        };
        if (is_beyond(s[0], -1)) {
          extensions.push_back({p, s[0]});
        } else if (is_beyond(s[1], 1)) {
          extensions.push_back({p, s[1]});
        } else {
          for (const double way : {-2 * tolerance, 2 * tolerance})  // two, so that p itself is an end of both
            extensions.push_back({p, Point{p[0] - way * d[1], p[1] + way * d[0]}});
        }
      });
  return stretches;
}

/// How many tips of older incisions lie within `touch` of the path, which may go round them instead of across, and not
/// at its ends: no more of them than it crosses incisions.
int count_tips_passed(const std::vector<Segment>& path, const std::vector<Segment>& incisions,
                      const SegmentSearch& older, const PieceTolerances& tolerances) {
  const SegmentSearch search(path);
  int tips = 0, crossings = 0;
  for (const Segment& incision : incisions) {
    search.for_each_in({{std::min(incision[0][0], incision[1][0]), std::min(incision[0][1], incision[1][1])},
                        {std::max(incision[0][0], incision[1][0]), std::max(incision[0][1], incision[1][1])}},
                       [&](int i) { crossings += meet(path[to_size(i)], incision); });
    for (const Point& p : incision) {
      if (search.distance(p) > tolerances.touch) continue;
      if (std::min(distance(p, path.front()[0]), distance(p, path.back()[1])) <= tolerances.tip) continue;
      int ends = 0;
      older.for_each_in({p, p}, [&](int i) {
        const Segment& s = older.segments()[to_size(i)];
        ends += p == s[0] || p == s[1];
      });
      tips += ends == 1;
    }
  }
  return std::min(tips, crossings);
}

/// How often the path comes within `tolerance` of an older line and goes back without having crossed it: it may as well
/// not touch it.
int count_grazes(const std::vector<Segment>& path, const std::vector<Segment>& older, const SegmentSearch& search,
                 double tolerance) {
  const auto nearest_to = [&](const Point& p) {
    int nearest = -1;
    double least = tolerance;
    search.for_each_in({{p[0] - tolerance, p[1] - tolerance}, {p[0] + tolerance, p[1] + tolerance}}, [&](int i) {
      if (const double d = distance(p, older[to_size(i)]); d <= least) {
        nearest = i;
        least = d;
      }
    });
    return nearest;
  };
  int count = 0, line = nearest_to(path.front()[0]);
  const Point* before = line < 0 ? &path.front()[0] : nullptr;  // the last point away from all lines
  bool crosses = false;
  for (const Segment& s : path) {
    const Point& p = s[1];
    const int now = nearest_to(p);
    if (now >= 0) line = now;
    if (line >= 0 && before) {
      const Segment& met = older[to_size(line)];
      crosses |= orientation(met[0], met[1], *before) * orientation(met[0], met[1], p) < 0;
    }
    if (now >= 0) continue;
    count += line >= 0 && before && !crosses;
    before = &p;
    line = -1;
    crosses = false;
  }
  return count;
}

/// How often the path passes a corner of the older lines within `tolerance`, all lines of the corner on the same side
/// of it: it may as well leave the corner on that side.
int count_corners_passed(const std::vector<Segment>& path, const std::vector<Segment>& older,
                         const SegmentSearch& search, double tolerance) {
  std::map<Point, std::set<int>> passed;  // the corners, and the path's segments near each
  for (int i = 0; i < to_int(path.size()); ++i) {
    const auto& [a, b] = path[to_size(i)];
    const BoxTree::Box box{{std::min(a[0], b[0]) - tolerance, std::min(a[1], b[1]) - tolerance},
                           {std::max(a[0], b[0]) + tolerance, std::max(a[1], b[1]) + tolerance}};
    search.for_each_in(box, [&](int line) {
      for (const Point& p : older[to_size(line)])
        if (distance(p, path[to_size(i)]) <= tolerance) passed[p].insert(i);
    });
  }
  int count = 0;
  for (const auto& entry : passed) {
    const Point& corner = entry.first;
    const std::set<int>& near = entry.second;
    std::vector<Point> ends;  // of the corner's lines, away from it
    search.for_each_in({corner, corner}, [&](int line) {
      const Segment& s = older[to_size(line)];
      if (s[0] == corner || s[1] == corner) ends.push_back(s[0] == corner ? s[1] : s[0]);
    });
    if (ends.size() < 2) continue;
    for (auto first = near.begin(); first != near.end();) {  // one time that the path passes: segments in a row
      auto last = first;
      while (std::next(last) != near.end() && *std::next(last) == *last + 1) ++last;
      const Point &before = path[to_size(*first)][0], &after = path[to_size(*last)][1];
      Point turn = before;
      for (auto i = first; i != last; ++i)
        if (const Point& p = path[to_size(*i)][1]; turn == before || distance(p, corner) < distance(turn, corner))
          turn = p;
      const auto is_left = [&](const Point& p) {
        if (first == last) return orientation(before, after, p) > 0;
        const bool one = orientation(before, turn, p) > 0, other = orientation(turn, after, p) > 0;
        return orientation(before, turn, after) > 0 ? one && other : one || other;
      };
      const auto runs_along = [&](const Point& p) {
        return std::any_of(first, std::next(last), [&](int i) { return distance(p, path[to_size(i)]) <= tolerance; });
      };
      const auto left = std::count_if(ends.begin(), ends.end(), is_left);
      const bool on_one_side = left == 0 || left == to_index(ends.size());
      count += on_one_side && std::none_of(ends.begin(), ends.end(), runs_along);
      first = std::next(last);
    }
  }
  return count;
}

/// How many of the path's points lie on another piece of it, or within `tolerance`, which is none of their own: they
/// may as well fall short of it.
int count_points_on_itself(const std::vector<Segment>& path, double tolerance) {
  const SegmentSearch search(path);
  std::set<Point> found;
  for (const Segment& segment : path)
    for (const Point& p : segment)
      search.for_each_in({{p[0] - tolerance, p[1] - tolerance}, {p[0] + tolerance, p[1] + tolerance}}, [&](int i) {
        const Segment& s = path[to_size(i)];
        if (p != s[0] && p != s[1] && distance(p, s) <= tolerance) found.insert(p);
      });
  return to_int(found.size());
}

/// How many ends of an open path are the tip of an older incision, and within `tolerance` of another line: the path may
/// end at that one instead.
int count_ends_between(const std::vector<Segment>& path, const std::vector<Segment>& older, const SegmentSearch& search,
                       double tolerance) {
  int count = 0;
  for (const Point& p : {path.front()[0], path.back()[1]}) {
    int ends = 0;
    bool beside = false;
    search.for_each_in({{p[0] - tolerance, p[1] - tolerance}, {p[0] + tolerance, p[1] + tolerance}}, [&](int i) {
      const Segment& s = older[to_size(i)];
      const bool ends_here = p == s[0] || p == s[1];
      ends += ends_here;
      beside |= !ends_here && distance(p, s) <= tolerance;
    });
    count += ends == 1 && beside;
  }
  return count;
}

/// The longer side of the bounding box.
double extent(const std::vector<Segment>& path) {
  double longest = 0;
  for (const std::size_t axis : {0, 1}) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Segment& s : path)
      for (const Point& p : s) {
        low = std::min(low, p[axis]);
        high = std::max(high, p[axis]);
      }
    longest = std::max(longest, high - low);
  }
  return longest;
}

int root(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

/// For each face a representative of those it is joined to where the extensions, the last segments, are left out.
std::vector<int> faces_without_extensions(const PlanarMap& map, std::size_t first_extension) {
  std::vector<int> parent(map.faces.size());
  std::iota(parent.begin(), parent.end(), 0);
  for (const auto& [segments, left, right, ends] : map.edges)
    if (segments.front() >= to_int(first_extension)) parent[root(parent, left)] = root(parent, right);
  for (int i = 0; i < to_int(parent.size()); ++i) parent[i] = root(parent, i);
  return parent;
}

}  // namespace

ExpectedPieces expected_pieces(const std::vector<Segment>& border, const std::vector<Segment>& incisions,
                               const std::vector<std::vector<Segment>>& paths, const PieceTolerances& tolerances) {
  std::vector<Segment> segments = border, extensions;
  segments.insert(segments.end(), incisions.begin(), incisions.end());
  const std::vector<Segment> older = segments;
  const SegmentSearch search(older);
  std::vector<int> path_of(segments.size(), -1);
  std::vector<char> tiny;
  ExpectedPieces result;
  int may_fall_short = 0;
  for (const auto& path : paths) {
    segments.insert(segments.end(), path.begin(), path.end());
    path_of.resize(segments.size(), to_int(tiny.size()));
    // Where a path nearly touches itself almost everywhere, as many pieces as it has segments are enough to allow for.
    tiny.push_back(extent(path) <= 8 * tolerances.touch);
    if (tiny.back()) result.most += to_int(path.size());
    if (!path.empty()) may_fall_short += count_points_on_itself(path, tolerances.tip);
    if (path.empty() || tolerances.tip == 0) continue;
    may_fall_short += count_tips_passed(path, incisions, search, tolerances);
    if (tolerances.touch > tolerances.tip) {
      may_fall_short += count_grazes(path, older, search, tolerances.touch);
      may_fall_short += count_corners_passed(path, older, search, tolerances.touch);
    }
    if (path.front()[0] == path.back()[1]) continue;
    may_fall_short += count_ends_between(path, older, search, tolerances.touch);
    add_extension(path.front()[0], path.front()[1], tolerances.tip, extensions);
    add_extension(path.back()[1], path.back()[0], tolerances.tip, extensions);
  }
  if (tolerances.touch > 0) result.most += add_near_touches(segments, path_of, tiny, tolerances.touch, extensions);
  const std::size_t first_extension = segments.size();
  segments.insert(segments.end(), extensions.begin(), extensions.end());

  const PlanarMap map = planar_map(segments);
  const std::vector<char> inside = inside_faces(map, border.size());
  const std::vector<int> joined = faces_without_extensions(map, first_extension);
  std::set<int> expected, thick;
  std::map<int, PlanarMap::Face> whole;  // of each face, what the extensions made of it together
  for (std::size_t face = 1; face < map.faces.size(); ++face) {  // the first is the infinite one
    auto& [area, perimeter] = whole[joined[face]];
    area += map.faces[face].area;
    perimeter += map.faces[face].perimeter;
    if (!inside[face]) continue;
    const double width = 2 * map.faces[face].area / map.faces[face].perimeter;
    ++result.most;
    if (width >= tolerances.tip) expected.insert(joined[face]);
    if (width >= tolerances.thin) thick.insert(joined[face]);
  }
  result.expected = to_int(expected.size());
  whole.erase(joined.front());
  const auto slits = std::count_if(whole.begin(), whole.end(), [&](const auto& face) {
    return 2 * face.second.area < tolerances.touch * face.second.perimeter;
  });
  result.least = std::max(1, to_int(thick.size()) - to_int(slits) - may_fall_short);
  return result;
}

}  // namespace cutbench::oracle
