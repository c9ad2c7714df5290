// Searching among many segments or triangles: the nearest, those in a box, the one that holds a point. It uses
// trees of boxes, because a refined mesh may be a million times denser in one place than in another, which no uniform
// grid can handle.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "harness/oracle/plane.h"

namespace cutbench::oracle {

/// Items, given by their bounding boxes.
class BoxTree {
 public:
  struct Box {
    Point low, high;
  };

  explicit BoxTree(const std::vector<Box>& boxes);

  /// Calls visit(item) for the items whose boxes meet the box, and perhaps for some beside it.
  template <class Visit>
  void for_each_in(const Box& box, Visit visit) const {
    if (!nodes_.empty()) visit_in(0, box, visit);
  }

  /// Calls visit(item) for items near p first, until every one not yet visited is farther than the number that visit
  /// returned last (a distance, infinity to go on).
  template <class Visit>
  void for_each_outwards(const Point& p, Visit visit) const {
    double enough = std::numeric_limits<double>::infinity();
    if (!nodes_.empty()) visit_outwards(0, p, enough, visit);
  }

 private:
  struct Node {
    Box box;
    int first, count;  // of items_, in a leaf
    int right = 0;     // the left one is the next node; 0 in a leaf
  };

  int build(const std::vector<Box>& boxes, int first, int count);

  template <class Visit>
  void visit_in(int n, const Box& box, Visit& visit) const {
    const Node& node = nodes_[n];
    for (int i : {0, 1})
      if (node.box.low[i] > box.high[i] || node.box.high[i] < box.low[i]) return;
    if (node.right == 0) {
      for (int i = node.first; i < node.first + node.count; ++i) visit(items_[i]);
      return;
    }
    visit_in(n + 1, box, visit);
    visit_in(node.right, box, visit);
  }

  template <class Visit>
  void visit_outwards(int n, const Point& p, double& enough, Visit& visit) const {
    const Node& node = nodes_[n];
    if (node.right == 0) {
      for (int i = node.first; i < node.first + node.count; ++i) enough = visit(items_[i]);
      return;
    }
    const double left = clearance(nodes_[n + 1].box, p), right = clearance(nodes_[node.right].box, p);
    const auto go = [&](int child, double away) {
      if (away < enough) visit_outwards(child, p, enough, visit);
    };
    if (left <= right) {
      go(n + 1, left);
      go(node.right, right);
    } else {
      go(node.right, right);
      go(n + 1, left);
    }
  }

  /// No more than the distance from p to the box.
  static double clearance(const Box& box, const Point& p) {
    return std::max({0.0, box.low[0] - p[0], p[0] - box.high[0], box.low[1] - p[1], p[1] - box.high[1]});
  }

  std::vector<Node> nodes_;
  std::vector<int> items_;
};

class SegmentSearch {
 public:
  explicit SegmentSearch(std::vector<Segment> segments);

  /// To the nearest segment; infinite where there are none.
  double distance(const Point& p) const;

  /// Whether a segment lies on these (up to `tolerance`): judged at its ends and three points between.
  bool covers(const Segment& s, double tolerance) const;

  /// Calls visit(index) for the segments that may meet the box.
  template <class Visit>
  void for_each_in(const BoxTree::Box& box, Visit visit) const {
    tree_.for_each_in(box, visit);
  }

  const std::vector<Segment>& segments() const { return segments_; }

 private:
  std::vector<Segment> segments_;
  BoxTree tree_;
};

class TriangleSearch {
 public:
  /// Keeps a reference to the mesh.
  explicit TriangleSearch(const Mesh& mesh);

  /// Whether some triangle holds p, its boundary included. Exact.
  bool holds(const Point& p) const;

 private:
  const Mesh& mesh_;
  BoxTree tree_;
};

}  // namespace cutbench::oracle
