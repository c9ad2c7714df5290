// Triangles that the path passes through more than once, or turns round in: the passages are divided at their
// crossings, so that segments meet in nodes only.
#include <algorithm>
#include <cmath>

#include "harness/base/conversions.h"
#include "harness/mesh/predicates.h"
#include "harness/path/trace.h"

namespace cutbench {

namespace {

/// Comparisons in one triangle: half a second.
constexpr std::size_t most_work = 200'000'000;

/// p lies within `snap` of the segment a b, clear of its ends.
bool on_segment(Point2 a, Point2 b, Point2 p, double snap) {
  const Point2 ab = b - a;
  const double length = std::sqrt(squared_length(ab)), along = dot(p - a, ab) / length;
  return std::abs(cross(ab, p - a)) <= snap * length && along > 0 && along < length;
}

bool cross_properly(Point2 a, Point2 b, Point2 c, Point2 d) {
  return orientation(a, b, c) * orientation(a, b, d) < 0 && orientation(c, d, a) * orientation(c, d, b) < 0;
}

bool touch(Point2 a, Point2 b, Point2 c, Point2 d) {
  return orientation(a, b, c) * orientation(a, b, d) <= 0 && orientation(c, d, a) * orientation(c, d, b) <= 0;
}

Point2 intersection(Point2 a, Point2 b, Point2 c, Point2 d) {
  const double from = cross(d - c, a - c), to = cross(d - c, b - c);
  return a + from / (from - to) * (b - a);
}

/// Of a segment from node to node, or of a node.
struct Box {
  int from, to;
  Point2 low, high;
  bool is_node() const { return from == to; }
  /// Ends that the two have in common.
  int shared(const Box& other) const {
    return (from == other.from || from == other.to) + (!is_node() && (to == other.from || to == other.to));
  }
};

Box box_of(int from, int to, Point2 a, Point2 b) {
  return {from, to, {std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
}

/// No two of them come within `margin`, but for segments that share one end, and a node with its segments.
bool are_apart(std::vector<Box>& boxes, double margin) {
  std::sort(boxes.begin(), boxes.end(), [](const Box& a, const Box& b) { return a.low.x < b.low.x; });
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size() && boxes[j].low.x <= boxes[i].high.x + margin; ++j) {
      const Box &a = boxes[i], &b = boxes[j];
      const bool meet = a.low.y <= b.high.y + margin && b.low.y <= a.high.y + margin;
      if (meet && a.shared(b) != 1 && !(a.is_node() && b.is_node())) return false;
    }
  return true;
}

/// How often two polylines cross; more than once where they touch.
int count_crossings(const std::vector<Point2>& a, const std::vector<Point2>& b) {
  int crossings = 0;
  for (std::size_t i = 0; i + 1 < a.size(); ++i)
    for (std::size_t j = 0; j + 1 < b.size(); ++j)
      if (cross_properly(a[i], a[i + 1], b[j], b[j + 1]))
        ++crossings;
      else if (touch(a[i], a[i + 1], b[j], b[j + 1]))
        crossings += 100;
  return crossings;
}

}  // namespace

int Tracer::passages_of(int face) const {
  return to_size(face) < passages_of_face_.size() ? passages_of_face_[to_size(face)] : -1;
}

/// One straight passage and nothing else, or only nodes on the edges.
bool Tracer::is_simple(int f) const {
  if (passages_of(f) < 0) return true;
  const TrianglePassage& only = passage(passages_of(f));
  if (only.next >= 0 || trace_.segment(trace_.face(f).segments).next >= 0) return false;
  auto on_edge = [&](int n) { return trace_.node(n).place.kind == Place::Kind::edge ? 1 : 0; };
  return trace_.face(f).edge_nodes == on_edge(only.from) + on_edge(only.to);
}

void Tracer::arrange(int face) {
  if (!chords_tell_the_truth(face)) restore_all_points(face);
  resolve_crossings(face);
}

std::vector<Point2> Tracer::passage_points(const TrianglePassage& passage, bool all) const {
  std::vector<Point2> points{trace_.node(passage.from).place.point};
  if (all) {
    for (std::size_t i = 0; i < passage.count; ++i) points.push_back(point(passage.first + i));
    points.push_back(trace_.node(passage.to).place.point);
  } else {
    for (std::size_t s = passage.segments[0]; s < passage.segments[1]; ++s)
      points.push_back(trace_.node(trace_.segments[s].to).place.point);
  }
  return points;
}

/// Whether simplified passages cross as often as the parts of the path that they replace: otherwise a crossing would
/// lie off the path.
bool Tracer::chords_tell_the_truth(int face) const {
  for (int i = passages_of(face); i >= 0; i = passage(i).next)
    for (int j = passage(i).next; j >= 0; j = passage(j).next) {
      const TrianglePassage &a = passage(i), &b = passage(j);
      if (!a.simplified && !b.simplified) continue;
      const int truth = count_crossings(passage_points(a, true), passage_points(b, true));
      if (truth > 0 || truth != count_crossings(passage_points(a, false), passage_points(b, false))) return false;
    }
  return true;
}

/// Makes nodes of all points of all passages.
void Tracer::restore_all_points(int face) {
  trace_.face(face).segments = -1;
  for (int i = passages_of(face); i >= 0; i = passage(i).next) {
    int node = passage(i).from;
    for (std::size_t k = 0; k < passage(i).count; ++k) {
      const int next = trace_.node_of(place_in(trace_.face(face).triangle, point(passage(i).first + k)));
      trace_.add_segment(face, node, next);
      node = next;
    }
    trace_.add_segment(face, node, passage(i).to);
  }
}

/// The nodes of a face: on its edges, inside, and at its corners.
std::vector<int> Tracer::nodes_of(int f) const {
  std::vector<int> nodes;
  const Subdivision::Face& face = trace_.face(f);
  for (int head : {face.on_edge[0], face.on_edge[1], face.on_edge[2], face.inside})
    for (int n = head; n >= 0; n = trace_.node(n).next) nodes.push_back(n);
  for (auto v : sheet_->triangle(face.triangle).vertex)
    if (const int n = trace_.node_at(v); n >= 0) nodes.push_back(n);
  return nodes;
}

/// Nothing to resolve: no segment is near another or a node, and none lies on an edge.
bool Tracer::is_clear(int f) const {
  std::vector<Box> boxes;
  const auto at = [&](int n) { return trace_.node(n).place.point; };
  for (int s = trace_.face(f).segments; s >= 0; s = trace_.segment(s).next) {
    const auto [from, to, next] = trace_.segment(s);
    if (common_edge(trace_.face(f).triangle, trace_.node(from).place, trace_.node(to).place) >= 0) return false;
    boxes.push_back(box_of(from, to, at(from), at(to)));
  }
  for (const int n : nodes_of(f)) boxes.push_back(box_of(n, n, at(n), at(n)));
  return are_apart(boxes, 2 * sheet_->snap());
}

void Tracer::resolve_crossings(int f) {
  const TriangleIndex t = trace_.face(f).triangle;
  const auto at = [&](int n) { return trace_.node(n).place.point; };
  const double snap = sheet_->snap();
  if (is_clear(f)) return;

  std::vector<std::pair<int, int>> open, done;  // segments; those in `done` are clear of each other
  for (int s = trace_.face(f).segments; s >= 0;) {
    open.emplace_back(trace_.segment(s).from, trace_.segment(s).to);
    s = trace_.segment(s).next;
  }
  // Each split makes shorter segments or takes out a crossing; the bound is for coordinates that don't resolve.
  std::vector<int> nodes = nodes_of(f);
  std::size_t work = 0;
  for (std::size_t budget = 1000 + 100 * open.size() * open.size(); !open.empty(); --budget) {
    if (budget == 0) throw WalkLost();
    if ((work += nodes.size() + done.size()) > most_work)
      throw CutRefused("the path crosses itself too often in one triangle; give it fewer points there");
    const auto [a, b] = open.back();
    open.pop_back();
    if (a == b) continue;
    bool split = false;
    for (int n : nodes) {  // through a node: two segments
      if (n == a || n == b || !on_segment(at(a), at(b), at(n), snap)) continue;
      open.emplace_back(a, n);
      open.emplace_back(n, b);
      split = true;
      break;
    }
    for (std::size_t i = 0; i < done.size() && !split; ++i) {  // across another segment: four
      const auto [c, d] = done[i];
      if (a == c || a == d || b == c || b == d || !cross_properly(at(a), at(b), at(c), at(d))) continue;
      const int n = trace_.node_of(place_in(t, intersection(at(a), at(b), at(c), at(d))));
      nodes = nodes_of(f);
      done.erase(done.begin() + to_index(i));
      for (int end : {a, b, c, d})
        if (end != n) open.emplace_back(end, n);
      // A new node may lie on segments that were clear before.
      open.insert(open.end(), done.begin(), done.end());
      done.clear();
      split = true;
    }
    if (split) continue;
    const std::pair forward{a, b}, backward{b, a};
    const bool known =
        std::any_of(done.begin(), done.end(), [&](const auto& s) { return s == forward || s == backward; });
    if (!known) done.emplace_back(a, b);
  }

  trace_.face(f).segments = -1;
  for (const auto& [a, b] : done) {
    const Place from = trace_.node(a).place, to = trace_.node(b).place;
    if (const int common = common_edge(t, from, to); common >= 0)
      run_along(from, to, half_edge(t, common));
    else
      trace_.add_segment(f, a, b);
  }
}

}  // namespace cutbench
