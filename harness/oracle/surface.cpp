#include "harness/oracle/surface.h"

#include <map>
#include <numeric>
#include <set>

#include "harness/oracle/conversions.h"
#include "harness/oracle/flatten.h"
#include "harness/oracle/planar_map.h"
#include "harness/oracle/search.h"
#include "harness/oracle/sheet_topology.h"

namespace cutbench::oracle {
namespace {

/// Shares of a seam's length. Places nearer than this are one: both sides have theirs by rounding.
constexpr double same_place = 1e-7;
/// For the least and the most pieces.
constexpr double rounding = 1e-12, doubtful = 1e-4;

/// One side of a seam, from the same end as the other side.
struct Side {
  int seam;
  bool second;
  Segment line;
};

/// What lies along a part of a side.
struct Along {
  int side;
  double low, high;  ///< shares
  int owner;         ///< a face or a piece
};

class Seams {
 public:
  Seams(const Surface& surface, const HalfEdges& edges) : sides_(sides_of(surface, edges)), search_(lines()) {}

  const std::vector<Side>& sides() const { return sides_; }

  /// Calls visit(side, share of the first end, of the second one) for the sides that a segment lies on.
  template <class Visit>
  void for_each_under(const Segment& s, Visit visit) const {
    const BoxTree::Box box{{std::min(s[0][0], s[1][0]), std::min(s[0][1], s[1][1])},
                           {std::max(s[0][0], s[1][0]), std::max(s[0][1], s[1][1])}};
    const double margin = near_ends();
    search_.for_each_in({{box.low[0] - margin, box.low[1] - margin}, {box.high[0] + margin, box.high[1] + margin}},
                        [&](int i) {
                          const Segment& line = sides_[to_size(i)].line;
                          const double near = same_place * distance(line[0], line[1]);
                          if (oracle::distance(s[0], line) <= near && oracle::distance(s[1], line) <= near)
                            visit(i, share(line, s[0]), share(line, s[1]));
                        });
  }

  /// `owners` are joined where they lie opposite each other along more than `overlap`; returns how many there are then.
  int count_joined(const std::set<int>& owners, const std::vector<Along>& parts, double overlap) const {
    std::map<int, int> parent;
    for (const int owner : owners) parent[owner] = owner;
    const auto root = [&parent](int i) {
      while (parent[i] != i) i = parent[i] = parent[parent[i]];
      return i;
    };
    int count = to_int(owners.size());
    std::map<int, std::vector<Along>> of_seam;
    for (const Along& part : parts) of_seam[sides_[to_size(part.side)].seam].push_back(part);
    for (const auto& [seam, all] : of_seam)
      for (const Along& a : all)
        for (const Along& b : all) {
          if (sides_[to_size(a.side)].second || !sides_[to_size(b.side)].second) continue;
          if (std::min(a.high, b.high) - std::max(a.low, b.low) <= overlap) continue;
          const int from = root(a.owner), to = root(b.owner);
          count -= from != to;
          parent[from] = to;
        }
    return count;
  }

  static double share(const Segment& line, const Point& p) {
    const Point along = minus(line[1], line[0]);
    return dot(minus(p, line[0]), along) / dot(along, along);
  }

 private:
  static std::vector<Side> sides_of(const Surface& surface, const HalfEdges& edges) {
    std::vector<Side> sides;
    for (int i = 0; i < to_int(surface.seams.size()); ++i)
      for (const bool second : {false, true}) sides.push_back({i, second, surface.seams[to_size(i)][second ? 1 : 0]});
    if (!sides.empty()) return sides;
    std::map<std::array<int, 2>, Segment> first;
    int seams = 0;
    for (int e = 0; e < to_int(edges.opposite.size()); ++e) {
      if (edges.opposite[to_size(e)] >= 0) continue;
      const auto& corners = surface.mesh.triangles[to_size(e / 3)];
      int a = corners[to_size(e % 3)], b = corners[to_size((e + 1) % 3)];
      if (surface.point[to_size(a)] > surface.point[to_size(b)]) std::swap(a, b);
      const std::array<int, 2> points{surface.point[to_size(a)], surface.point[to_size(b)]};
      const Segment line{surface.mesh.rest[to_size(a)], surface.mesh.rest[to_size(b)]};
      const auto [other, is_first] = first.try_emplace(points, line);
      if (is_first || points[0] == points[1] || other->second == line) continue;  // equal: the lips of an incision
      sides.push_back({seams, false, other->second});
      sides.push_back({seams, true, line});
      ++seams;
    }
    return sides;
  }

  std::vector<Segment> lines() const {
    std::vector<Segment> result;
    for (const Side& side : sides_) result.push_back(side.line);
    return result;
  }

  double near_ends() const {
    double longest = 0;
    for (const Side& side : sides_) longest = std::max(longest, distance(side.line[0], side.line[1]));
    return same_place * longest;
  }

  std::vector<Side> sides_;
  SegmentSearch search_;
};

/// Where a curve begins or ends on a side.
struct End {
  int curve;
  Point point;
  int side;
  double share;
};

class SurfaceJudge {
 public:
  SurfaceJudge(const Surface& before, const std::vector<Curve>& cuts, const Mesh& after, double tip)
      : before_(before), after_(after), tip_(tip), edges_(half_edges(before.mesh)), seams_(before, edges_) {
    const double tolerance = 1e-4 * edge_lengths(before.mesh, edges_).mean;
    for (const Curve& cut : cuts) {
      std::vector<Segment>& path = paths_.emplace_back();
      for (const PathSegment& s : flatten(cut, tolerance)) path.push_back(s.segment);
      if (path.empty() || path.front()[0] == path.back()[1]) continue;
      find_ends(to_int(paths_.size()) - 1);
    }
  }

  SurfaceJudgement run() {
    count_expected();
    count_found();
    judge_crossings();
    return result_;
  }

 private:
  void find_ends(int curve) {
    std::vector<Segment>& path = paths_[to_size(curve)];
    bool ends[2] = {false, false}, at_vertex[2] = {false, false};
    for (const bool last : {false, true}) {
      const Point p = last ? path.back()[1] : path.front()[0];
      seams_.for_each_under({p, p}, [&](int side, double share, double) {
        ends_.push_back({curve, p, side, share});
        ends[last] = true;
        const Segment& line = seams_.sides()[to_size(side)].line;
        at_vertex[last] |= p == line[0] || p == line[1];
      });
    }
    // By rounding it may end on this side of the seam: a little further. At a vertex there is no rounding, and where
    // the sheet reaches round the vertex a path beyond it might pass it by on the wrong side.
    if (ends[0] && !at_vertex[0]) path.front()[0] = beyond(path.front()[1], path.front()[0]);
    if (ends[1] && !at_vertex[1]) path.back()[1] = beyond(path.back()[0], path.back()[1]);
  }

  Point beyond(const Point& from, const Point& end) const {
    const double length = distance(from, end);
    return between(from, end, (length + tip_) / length);
  }

  void count_expected() {
    std::vector<Segment> segments;
    const Borders borders = oracle::borders(before_.mesh, edges_);
    const auto add_border = [&](const std::vector<int>& half_edges) {
      for (const int e : half_edges) segments.push_back(segment(before_.mesh, e));
    };
    add_border(borders.single);
    add_border(borders.ambiguous);
    const std::size_t border_count = segments.size();
    for (const auto& lips : borders.lips) segments.push_back(segment(before_.mesh, lips[0]));
    for (const auto& path : paths_) segments.insert(segments.end(), path.begin(), path.end());

    const PlanarMap map = planar_map(segments);
    const std::vector<char> inside = inside_faces(map, border_count);
    std::set<int> faces;
    for (std::size_t i = 1; i < map.faces.size(); ++i)
      if (inside[i] && 2 * map.faces[i].area > tip_ * map.faces[i].perimeter) faces.insert(to_int(i));
    std::vector<Along> parts;
    for (const PlanarMap::Edge& edge : map.edges) {
      if (edge.segments.front() >= to_int(border_count)) continue;
      const int face = faces.count(edge.left) > 0 ? edge.left : edge.right;
      if (faces.count(face) == 0) continue;
      seams_.for_each_under(edge.ends, [&](int side, double from, double to) {
        parts.push_back({side, std::min(from, to), std::max(from, to), face});
      });
    }
    result_.expected = seams_.count_joined(faces, parts, same_place);
    result_.least = seams_.count_joined(faces, parts, rounding);
    result_.most = seams_.count_joined(faces, parts, doubtful);
  }

  void count_found() {
    const HalfEdges edges = half_edges(after_);
    const std::vector<int> piece = pieces_of_triangles(edges);
    for (int e = 0; e < to_int(edges.opposite.size()); ++e) {
      if (edges.opposite[to_size(e)] >= 0) continue;
      seams_.for_each_under(segment(after_, e), [&](int side, double from, double to) {
        parts_.push_back({side, std::min(from, to), std::max(from, to), piece[to_size(e / 3)]});
        const auto& corners = after_.triangles[to_size(e / 3)];
        const int begin = corners[to_size(e % 3)], end = corners[to_size((e + 1) % 3)];
        vertices_.push_back(from < to ? std::array{begin, end} : std::array{end, begin});
      });
    }
    result_.pieces = seams_.count_joined({piece.begin(), piece.end()}, parts_, same_place);
  }

  void judge_crossings() {
    std::set<std::pair<int, Point>> met, all;
    for (const End& a : ends_) {
      if (is_inside(a)) all.insert({a.curve, a.point});
      const Side& side = seams_.sides()[to_size(a.side)];
      const bool goes_on = std::any_of(ends_.begin(), ends_.end(), [&](const End& b) {
        const Side& other = seams_.sides()[to_size(b.side)];
        return other.seam == side.seam && other.second != side.second && std::abs(b.share - a.share) <= same_place;
      });
      if (!goes_on || !met.insert({a.curve, a.point}).second) continue;
      ++result_.crossings;
      result_.unopened += is_inside(a) && is_whole_at(a);
    }
    for (const auto& end : met) all.erase(end);
    result_.alone = to_int(all.size());
  }

  /// Not at an end of the seam, where others begin.
  static bool is_inside(const End& end) { return end.share >= doubtful && end.share <= 1 - doubtful; }

  /// Whether the result's border runs through the place, without two vertices there.
  bool is_whole_at(const End& end) const {
    int before = -1, after = -1;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const Along& part = parts_[i];
      if (part.side != end.side) continue;
      if (part.low < end.share - doubtful && part.high > end.share + doubtful) return true;
      if (std::abs(part.high - end.share) <= same_place) before = vertices_[i][1];
      if (std::abs(part.low - end.share) <= same_place) after = vertices_[i][0];
    }
    return before >= 0 && before == after;
  }

  const Surface& before_;
  const Mesh& after_;
  double tip_;
  HalfEdges edges_;
  Seams seams_;
  std::vector<std::vector<Segment>> paths_;
  std::vector<End> ends_;
  std::vector<Along> parts_;                  // of the result
  std::vector<std::array<int, 2>> vertices_;  // of those, in order along the seam
  SurfaceJudgement result_;
};

}  // namespace

SurfaceJudgement judge_surface(const Surface& before, const std::vector<Curve>& cuts, const Mesh& after, double tip) {
  return SurfaceJudge(before, cuts, after, tip).run();
}

}  // namespace cutbench::oracle
