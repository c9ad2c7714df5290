#include "harness/oracle/search.h"

#include <numeric>

#include "harness/oracle/conversions.h"
#include "harness/oracle/exact.h"

namespace cutbench::oracle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

void extend(BoxTree::Box& box, const Point& p) {
  for (int i : {0, 1}) {
    box.low[i] = std::min(box.low[i], p[i]);
    box.high[i] = std::max(box.high[i], p[i]);
  }
}

std::vector<BoxTree::Box> boxes(const std::vector<Segment>& segments) {
  std::vector<BoxTree::Box> result;
  for (const auto& [a, b] : segments) extend(result.emplace_back(BoxTree::Box{a, a}), b);
  return result;
}

std::vector<BoxTree::Box> boxes(const Mesh& mesh) {
  std::vector<BoxTree::Box> result;
  for (const auto& [a, b, c] : mesh.triangles) {
    BoxTree::Box& box = result.emplace_back(BoxTree::Box{mesh.rest[a], mesh.rest[a]});
    extend(box, mesh.rest[b]);
    extend(box, mesh.rest[c]);
  }
  return result;
}

}  // namespace

BoxTree::BoxTree(const std::vector<Box>& boxes) : items_(boxes.size()) {
  std::iota(items_.begin(), items_.end(), 0);
  if (!items_.empty()) build(boxes, 0, to_int(items_.size()));
}

/// Halves along the longer side, at the median.
int BoxTree::build(const std::vector<Box>& boxes, int first, int count) {
  constexpr int most_in_leaf = 4;
  const auto begin = items_.begin() + first, end = begin + count;
  Node node{boxes[*begin], first, count};
  for (auto i = begin; i != end; ++i) {
    extend(node.box, boxes[*i].low);
    extend(node.box, boxes[*i].high);
  }
  const int n = to_int(nodes_.size());
  nodes_.push_back(node);
  if (count <= most_in_leaf) return n;
  const int axis = node.box.high[0] - node.box.low[0] >= node.box.high[1] - node.box.low[1] ? 0 : 1, half = count / 2;
  const auto middle = [&](int item) { return boxes[item].low[axis] + boxes[item].high[axis]; };
  std::nth_element(begin, begin + half, end, [&](int a, int b) { return middle(a) < middle(b); });
  build(boxes, first, half);
  const int right = build(boxes, first + half, count - half);
  nodes_[n].right = right;
  return n;
}

SegmentSearch::SegmentSearch(std::vector<Segment> segments) : segments_(std::move(segments)), tree_(boxes(segments_)) {}

double SegmentSearch::distance(const Point& p) const {
  double nearest = infinity;
  tree_.for_each_outwards(p, [&](int i) {
    const Point there = oracle::nearest(p, segments_[i]);
    // hypot() is most of the time, and seldom needed to see that this one is farther.
    if (std::max(std::abs(there[0] - p[0]), std::abs(there[1] - p[1])) < nearest)
      nearest = std::min(nearest, oracle::distance(p, there));
    return nearest;
  });
  return nearest;
}

bool SegmentSearch::covers(const Segment& s, double tolerance) const {
  bool same = false;  // as most are: where a cut did not come, edges stay what they are
  tree_.for_each_in({s[0], s[0]},
                    [&](int i) { same |= segments_[i] == s || (segments_[i][0] == s[1] && segments_[i][1] == s[0]); });
  if (same) return true;
  for (double t : {0.0, 0.25, 0.5, 0.75, 1.0})
    if (!(distance(between(s[0], s[1], t)) <= tolerance)) return false;
  return true;
}

TriangleSearch::TriangleSearch(const Mesh& mesh) : mesh_(mesh), tree_(boxes(mesh)) {}

bool TriangleSearch::holds(const Point& p) const {
  bool found = false;
  tree_.for_each_in({p, p}, [&](int t) {
    if (found) return;
    const auto& [i, j, k] = mesh_.triangles[t];
    const Point &a = mesh_.rest[i], &b = mesh_.rest[j], &c = mesh_.rest[k];
    found = orientation(a, b, p) >= 0 && orientation(b, c, p) >= 0 && orientation(c, a, p) >= 0;
  });
  return found;
}

}  // namespace cutbench::oracle
