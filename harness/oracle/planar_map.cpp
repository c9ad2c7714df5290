#include "harness/oracle/planar_map.h"

#include <map>
#include <numeric>
#include <optional>

#include "harness/oracle/conversions.h"
#include "harness/oracle/exact.h"
#include "harness/oracle/numbers.h"
#include "harness/oracle/search.h"

namespace cutbench::oracle {
namespace {

using ExactPoint = std::array<Rational, 2>;

/// A point of the map: a double, or an intersection with the double next to it on the side of zero. Rounding keeps the
/// order of numbers, so where doubles differ, they tell it.
struct Node {
  Point rounded;
  std::optional<ExactPoint> exact;  ///< none: that is `rounded`
  std::vector<int> outgoing;        ///< half-edges, counter-clockwise from straight down, which is not included
};

Rational coordinate(const Node& v, std::size_t axis) {
  return v.exact ? (*v.exact)[axis] : as_rational(v.rounded[axis]);
}

int compare(const Node& a, const Node& b, std::size_t axis) {
  if (a.rounded[axis] != b.rounded[axis]) return a.rounded[axis] < b.rounded[axis] ? -1 : 1;
  return a.exact || b.exact ? order(coordinate(a, axis), coordinate(b, axis)) : 0;
}

/// From left to right, and upwards.
bool before(const Node& a, const Node& b) {
  const int x = compare(a, b, 0);
  return x != 0 ? x < 0 : compare(a, b, 1) < 0;
}

bool in_box(const Point& p, const Segment& s) {
  for (std::size_t axis = 0; axis < 2; ++axis)
    if (p[axis] < std::min(s[0][axis], s[1][axis]) || p[axis] > std::max(s[0][axis], s[1][axis])) return false;
  return true;
}

bool boxes_meet(const Segment& s, const Segment& t) {
  for (std::size_t axis = 0; axis < 2; ++axis)
    if (std::max(s[0][axis], s[1][axis]) < std::min(t[0][axis], t[1][axis]) ||
        std::max(t[0][axis], t[1][axis]) < std::min(s[0][axis], s[1][axis]))
      return false;
  return true;
}

/// A segment, scaled to integers.
struct Line {
  Integer ax, ay, ux, uy;  // from a along u
  Line(const Segment& s, int exponent)
      : ax(as_integer(s[0][0], exponent)),
        ay(as_integer(s[0][1], exponent)),
        ux(as_integer(s[1][0], exponent) - ax),
        uy(as_integer(s[1][1], exponent) - ay) {}
};

/// Precondition: the lines aren't parallel. `exponent`: of the scaling.
ExactPoint intersection(const Line& s, const Line& t, int exponent) {
  const Integer across = s.ux * t.uy - s.uy * t.ux;
  const Integer along = (t.ax - s.ax) * t.uy - (t.ay - s.ay) * t.ux;
  const Integer x = s.ax * across + along * s.ux, y = s.ay * across + along * s.uy;
  return {fraction(x, across, exponent), fraction(y, across, exponent)};
}

/// Of a line, in the integers. Precondition: it isn't upright.
Rational height_at(const Line& s, const Integer& x) {
  const Integer above = (x - s.ax) * s.uy;
  return s.ay + fraction(above, s.ux, 0);
}

/// Half-edge 2 e runs along edge e from left to right (or upwards), 2 e + 1 back.
class Builder {
 public:
  explicit Builder(const std::vector<Segment>& segments) : segments_(segments), on_(segments.size()) {
    for (Segment& s : segments_) {
      if (s[1] < s[0]) std::swap(s[0], s[1]);
      for (const Point& p : s)
        for (const double x : p) exponent_ = std::min(exponent_, lowest_bit(x));
    }
  }

  PlanarMap build() {
    add_ends();
    intersect();
    add_edges();
    sort_outgoing();
    find_cycles();
    add_faces();
    map_.vertices = to_int(vertices_.size());
    return std::move(map_);
  }

 private:
  struct Cycle {
    double area = 0, perimeter = 0;
    int face = -1;
  };

  int vertex(const Point& p) {
    for (int v : known_[p])
      if (!vertices_[v].exact) return v;
    return add_vertex({p, {}, {}});
  }

  int vertex(ExactPoint p) {
    const Point rounded{toward_zero(p[0]), toward_zero(p[1])};
    for (int v : known_[rounded])
      if (coordinate(vertices_[v], 0) == p[0] && coordinate(vertices_[v], 1) == p[1]) return v;
    return add_vertex({rounded, std::move(p), {}});
  }

  int add_vertex(Node v) {
    known_[v.rounded].push_back(to_int(vertices_.size()));
    vertices_.push_back(std::move(v));
    return to_int(vertices_.size()) - 1;
  }

  void add_ends() {
    for (std::size_t s = 0; s < segments_.size(); ++s)
      if (segments_[s][0] != segments_[s][1]) on_[s] = {vertex(segments_[s][0]), vertex(segments_[s][1])};
  }

  void intersect() {
    const SegmentSearch search(segments_);
    std::vector<int> near;
    for (int s = 0; s < to_int(segments_.size()); ++s) {
      const auto& [a, b] = segments_[s];
      near.clear();
      search.for_each_in({{a[0], std::min(a[1], b[1])}, {b[0], std::max(a[1], b[1])}}, [&](int t) {
        if (t > s && boxes_meet(segments_[s], segments_[t])) near.push_back(t);
      });
      std::sort(near.begin(), near.end());
      near.erase(std::unique(near.begin(), near.end()), near.end());
      for (int t : near)
        if (!on_[s].empty() && !on_[t].empty()) intersect(s, t);
    }
  }

  void intersect(int s, int t) {
    const auto& [a, b] = segments_[s];
    const auto& [c, d] = segments_[t];
    const int side_c = orientation(a, b, c), side_d = orientation(a, b, d);
    if (side_c * side_d > 0) return;
    const int side_a = orientation(c, d, a), side_b = orientation(c, d, b);
    if (side_c * side_d < 0 && side_a * side_b < 0) {
      const int v = vertex(intersection({segments_[s], exponent_}, {segments_[t], exponent_}, exponent_));
      on_[s].push_back(v);
      on_[t].push_back(v);
      return;
    }
    if (side_c == 0 && in_box(c, segments_[s])) on_[s].push_back(on_[t][0]);
    if (side_d == 0 && in_box(d, segments_[s])) on_[s].push_back(on_[t][1]);
    if (side_a == 0 && in_box(a, segments_[t])) on_[t].push_back(on_[s][0]);
    if (side_b == 0 && in_box(b, segments_[t])) on_[t].push_back(on_[s][1]);
  }

  void add_edges() {
    std::map<std::array<int, 2>, int> known;
    for (int s = 0; s < to_int(segments_.size()); ++s) {
      std::vector<int>& on = on_[s];
      std::sort(on.begin(), on.end());
      on.erase(std::unique(on.begin(), on.end()), on.end());
      std::sort(on.begin(), on.end(), [&](int v, int w) { return before(vertices_[v], vertices_[w]); });
      for (std::size_t i = 1; i < on.size(); ++i) {
        const auto [place, is_new] = known.try_emplace({on[i - 1], on[i]}, to_int(map_.edges.size()));
        if (is_new) {
          map_.edges.emplace_back();
          ends_.push_back(place->first);
        }
        map_.edges[place->second].segments.push_back(s);
      }
    }
  }

  const Segment& line(int half_edge) const { return segments_[map_.edges[half_edge / 2].segments.front()]; }
  int origin(int half_edge) const { return ends_[half_edge / 2][half_edge % 2]; }

  /// Whether one half-edge comes before another that leaves the same vertex.
  bool turns_before(int e, int f) const {
    if (e % 2 != f % 2) return e % 2 == 0;
    return turn(line(e), line(f)) > 0;
  }

  void sort_outgoing() {
    for (int e = 0; e < 2 * to_int(ends_.size()); ++e) vertices_[origin(e)].outgoing.push_back(e);
    next_.resize(2 * ends_.size());
    for (Node& v : vertices_) {
      std::sort(v.outgoing.begin(), v.outgoing.end(), [this](int e, int f) { return turns_before(e, f); });
      for (std::size_t i = 0; i < v.outgoing.size(); ++i)  // what arrives goes on by the next one clockwise
        next_[v.outgoing[i] ^ 1] = v.outgoing[(i + v.outgoing.size() - 1) % v.outgoing.size()];
    }
  }

  void find_cycles() {
    cycle_of_.assign(next_.size(), -1);
    for (int first = 0; first < to_int(next_.size()); ++first) {
      if (cycle_of_[first] >= 0) continue;
      Cycle cycle;
      const Point anchor = vertices_[origin(first)].rounded;
      for (int e = first; cycle_of_[e] < 0; e = next_[e]) {
        cycle_of_[e] = to_int(cycles_.size());
        const Point &p = vertices_[origin(e)].rounded, &q = vertices_[origin(e ^ 1)].rounded;
        cycle.area += cross(minus(p, anchor), minus(q, anchor)) / 2;
        cycle.perimeter += distance(p, q);
      }
      cycles_.push_back(cycle);
    }
  }

  /// A connected component has one cycle with all of it on the right; any other one bounds a face.
  void add_faces() {
    map_.faces.emplace_back();
    std::vector<int> outermost;  // the first vertex of each component, in order
    for (int v : components()) {
      outermost.push_back(v);
      cycles_[outer_cycle(v)].face = 0;  // for now
    }
    for (Cycle& cycle : cycles_)
      if (cycle.face < 0) {
        cycle.face = to_int(map_.faces.size());
        map_.faces.emplace_back();
      }
    for (int v : outermost) cycles_[outer_cycle(v)].face = face_round(v);
    for (const Cycle& cycle : cycles_) {
      map_.faces[cycle.face].area += cycle.area;
      map_.faces[cycle.face].perimeter += cycle.perimeter;
    }
    for (std::size_t e = 0; e < ends_.size(); ++e) {
      map_.edges[e].ends = {vertices_[ends_[e][0]].rounded, vertices_[ends_[e][1]].rounded};
      map_.edges[e].left = face_left_of(2 * e);
      map_.edges[e].right = face_left_of(2 * e + 1);
    }
  }

  /// The first vertex of each, which is an end of a segment; in order.
  std::vector<int> components() {
    component_.resize(vertices_.size());
    std::iota(component_.begin(), component_.end(), 0);
    for (const auto& [v, w] : ends_) component_[root(v)] = root(w);
    std::vector<int> first(vertices_.size(), -1), result;
    for (int v = 0; v < to_int(vertices_.size()); ++v) {
      int& best = first[component_[v] = root(v)];
      if (best < 0 || before(vertices_[v], vertices_[best])) best = v;
    }
    std::copy_if(first.begin(), first.end(), std::back_inserter(result), [](int v) { return v >= 0; });
    std::sort(result.begin(), result.end(), [&](int v, int w) { return before(vertices_[v], vertices_[w]); });
    return result;
  }

  int root(int v) {
    while (component_[v] != v) v = component_[v] = component_[component_[v]];
    return v;
  }

  /// All half-edges of a component's first vertex lead to the right: on the left of the last one is what's round it.
  int outer_cycle(int v) const { return cycle_of_[vertices_[v].outgoing.back()]; }

  int face_left_of(std::size_t half_edge) const { return cycles_[cycle_of_[half_edge]].face; }

  /// The face that has a component in it: what is above the edge that one comes upon straight down from a point just
  /// left of the component's first vertex. Precondition: known for all components that begin before.
  int face_round(int v) const {
    const Integer x = as_integer(vertices_[v].rounded[0], exponent_);
    int best = -1;
    Rational highest;
    for (int e = 0; e < to_int(ends_.size()); ++e) {
      const auto& [from, to] = ends_[e];
      if (component_[from] == component_[v]) continue;
      if (compare(vertices_[from], vertices_[v], 0) >= 0 || compare(vertices_[v], vertices_[to], 0) > 0) continue;
      const Segment& s = line(2 * e);
      if (orientation(s[0], s[1], vertices_[v].rounded) < 0) continue;
      const Rational height = height_at({s, exponent_}, x);
      if (best < 0 || height > highest || (height == highest && turn(s, line(2 * best)) > 0)) {
        best = e;
        highest = height;
      }
    }
    return best < 0 ? 0 : face_left_of(2 * to_size(best));
  }

  int exponent_ = std::numeric_limits<int>::max();  // 2^that divides all coordinates
  std::vector<Segment> segments_;                   // from left to right, or upwards
  std::vector<std::vector<int>> on_;                // per segment, its vertices
  std::vector<Node> vertices_;
  std::map<Point, std::vector<int>> known_;  // vertices by what they are rounded to
  std::vector<std::array<int, 2>> ends_;     // of the edges
  std::vector<int> next_, cycle_of_;         // per half-edge
  std::vector<Cycle> cycles_;
  std::vector<int> component_;  // per vertex
  PlanarMap map_;
};

}  // namespace

PlanarMap planar_map(const std::vector<Segment>& segments) { return Builder(segments).build(); }

std::vector<char> inside_faces(const PlanarMap& map, std::size_t border_count) {
  struct Crossing {
    int face;
    bool toggles;
  };
  std::vector<std::vector<Crossing>> neighbours(map.faces.size());
  for (const auto& [segments, left, right, ends] : map.edges) {
    const auto of_border = std::lower_bound(segments.begin(), segments.end(), to_int(border_count)) - segments.begin();
    neighbours[left].push_back({right, of_border % 2 == 1});
    neighbours[right].push_back({left, of_border % 2 == 1});
  }
  std::vector<char> inside(neighbours.size(), 0), seen(neighbours.size(), 0);
  std::vector<int> open{0};
  seen.front() = 1;
  while (!open.empty()) {
    const int face = open.back();
    open.pop_back();
    for (const auto& [other, toggles] : neighbours[face]) {
      if (seen[other]) continue;
      seen[other] = 1;
      inside[other] = inside[face] != static_cast<char>(toggles);
      open.push_back(other);
    }
  }
  return inside;
}

}  // namespace cutbench::oracle
