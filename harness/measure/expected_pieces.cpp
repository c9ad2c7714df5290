#include "harness/measure/expected_pieces.h"

#include <CGAL/Arr_consolidated_curve_data_traits_2.h>
#include <CGAL/Arr_extended_dcel.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <utility>

#include "harness/measure/grids.h"

namespace cutbench::oracle {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using SegmentTraits = CGAL::Arr_segment_traits_2<Kernel>;
using Traits = CGAL::Arr_consolidated_curve_data_traits_2<SegmentTraits, int>;  // an edge knows all its curves' data
using Arrangement = CGAL::Arrangement_2<Traits, CGAL::Arr_face_extended_dcel<Traits, int>>;
using Circulator = Arrangement::Ccb_halfedge_const_circulator;

// The data of a curve: its number where it is a border edge, else one of these.
constexpr int incision = -1, extension = -2;

Traits::Curve_2 curve(const Segment& s, double scale, int data) {
  const auto point = [scale](const Point& p) { return Kernel::Point_2(scale * p[0], scale * p[1]); };
  return Traits::Curve_2(SegmentTraits::Curve_2(point(s[0]), point(s[1])), data);
}

/// From an open end of a path a little further on, so that a path which ends just short of something reaches it.
void add_extension(const Point& end, const Point& before, double length, double scale,
                   std::vector<Traits::Curve_2>& curves) {
  const Point d = direction(before, end);
  const Point beyond{end[0] + length * d[0], end[1] + length * d[1]};
  if (beyond != end) curves.push_back(curve({end, beyond}, scale, extension));
}

/// From each end of a segment that lies within `tolerance` of another segment across that one, where one of the two is
/// of a path (those from `first_of_path` on): what nearly touches does.
void add_near_touches(const std::vector<Segment>& segments, std::size_t first_of_path, double tolerance, double scale,
                      std::vector<Traits::Curve_2>& curves) {
  const SegmentGrid grid(segments);
  std::set<std::pair<Point, int>> done;
  for (std::size_t i = 0; i < segments.size(); ++i)
    for (const Point& p : segments[i])
      grid.for_each_in({{p[0] - tolerance, p[1] - tolerance}, {p[0] + tolerance, p[1] + tolerance}}, [&](int j) {
        const Segment& s = segments[static_cast<std::size_t>(j)];
        if (std::max(i, static_cast<std::size_t>(j)) < first_of_path || p == s[0] || p == s[1]) return;
        if (distance(p, s) > tolerance || !done.insert({p, j}).second) return;
        const Point d = direction(s[0], s[1]);
        for (const double way : {-2 * tolerance, 2 * tolerance})  // two, so that p itself is an end of both
          curves.push_back(curve({p, Point{p[0] - way * d[1], p[1] + way * d[0]}}, scale, extension));
      });
}

/// The power of two that brings the largest coordinate to about one. Without it CGAL 5.5's lazy kernel fails an
/// assertion where the intervals of its filters overflow (seen at 2^400).
double unit_scale(const std::vector<Segment>& segments) {
  double largest = std::numeric_limits<double>::min();
  for (const Segment& s : segments)
    for (const Point& p : s) largest = std::max({largest, std::abs(p[0]), std::abs(p[1])});
  return std::ldexp(1.0, -std::ilogb(largest));
}

int root(std::vector<int>& parent, int i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

/// Adds the area to the left of a boundary cycle, and its length.
void add_cycle(Circulator start, double& area, double& perimeter) {
  const auto point = [](Circulator c) {
    return Point{CGAL::to_double(c->target()->point().x()), CGAL::to_double(c->target()->point().y())};
  };
  const Point anchor = point(start);
  Point last = anchor;
  Circulator c = start;
  do {
    ++c;
    const Point p = point(c);
    area += cross(minus(last, anchor), minus(p, anchor)) / 2;
    perimeter += distance(last, p);
    last = p;
  } while (c != start);
}

/// About the width of a long thin face (in the arrangement's scale): 2 area / perimeter.
double thickness(Arrangement::Face_const_handle face) {
  double area = 0, perimeter = 0;
  for (auto cycle = face->outer_ccbs_begin(); cycle != face->outer_ccbs_end(); ++cycle)
    add_cycle(*cycle, area, perimeter);
  for (auto cycle = face->inner_ccbs_begin(); cycle != face->inner_ccbs_end(); ++cycle)
    add_cycle(*cycle, area, perimeter);
  return perimeter > 0 ? 2 * area / perimeter : 0;
}

/// For each face (its data is its number) whether it lies inside the sheet.
std::vector<char> inside_faces(const Arrangement& arrangement) {
  struct Crossing {
    int face;
    bool toggles;
  };
  std::vector<std::vector<Crossing>> neighbours(arrangement.number_of_faces());
  for (auto e = arrangement.edges_begin(); e != arrangement.edges_end(); ++e) {
    const auto& data = e->curve().data();
    const bool toggles = std::count_if(data.begin(), data.end(), [](int id) { return id >= 0; }) % 2 == 1;
    const int left = e->face()->data(), right = e->twin()->face()->data();
    neighbours[left].push_back({right, toggles});
    neighbours[right].push_back({left, toggles});
  }
  std::vector<char> inside(neighbours.size(), 0), seen(neighbours.size(), 0);
  std::vector<int> open{arrangement.unbounded_face()->data()};
  seen[open.front()] = 1;
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

/// For each face a representative of those it is joined to where the extensions are left out.
std::vector<int> faces_without_extensions(const Arrangement& arrangement) {
  std::vector<int> parent(arrangement.number_of_faces());
  std::iota(parent.begin(), parent.end(), 0);
  for (auto e = arrangement.edges_begin(); e != arrangement.edges_end(); ++e) {
    const auto& data = e->curve().data();
    if (std::all_of(data.begin(), data.end(), [](int id) { return id == extension; }))
      parent[root(parent, e->face()->data())] = root(parent, e->twin()->face()->data());
  }
  for (int i = 0; i < static_cast<int>(parent.size()); ++i) parent[i] = root(parent, i);
  return parent;
}

}  // namespace

ExpectedPieces expected_pieces(const std::vector<Segment>& border, const std::vector<Segment>& incisions,
                               const std::vector<std::vector<Segment>>& paths, const PieceTolerances& tolerances) {
  const double scale = unit_scale(border);
  std::vector<Traits::Curve_2> curves;
  for (const Segment& s : border) curves.push_back(curve(s, scale, static_cast<int>(curves.size())));
  for (const Segment& s : incisions) curves.push_back(curve(s, scale, incision));
  for (const auto& path : paths) {
    for (const Segment& s : path) curves.push_back(curve(s, scale, incision));
    if (path.empty() || path.front()[0] == path.back()[1] || tolerances.tip == 0) continue;
    add_extension(path.front()[0], path.front()[1], tolerances.tip, scale, curves);
    add_extension(path.back()[1], path.back()[0], tolerances.tip, scale, curves);
  }
  if (tolerances.touch > 0) {
    std::vector<Segment> all = border;
    all.insert(all.end(), incisions.begin(), incisions.end());
    const std::size_t first_of_path = all.size();
    for (const auto& path : paths) all.insert(all.end(), path.begin(), path.end());
    add_near_touches(all, first_of_path, tolerances.touch, scale, curves);
  }
  Arrangement arrangement;
  CGAL::insert(arrangement, curves.begin(), curves.end());
  int number = 0;
  for (auto face = arrangement.faces_begin(); face != arrangement.faces_end(); ++face) face->set_data(number++);

  const std::vector<char> inside = inside_faces(arrangement);
  const std::vector<int> joined = faces_without_extensions(arrangement);
  std::set<int> expected, thick;
  ExpectedPieces result;
  for (auto face = arrangement.faces_begin(); face != arrangement.faces_end(); ++face) {
    if (!inside[face->data()]) continue;
    const double width = thickness(face) / scale;
    ++result.most;
    if (width >= tolerances.tip) expected.insert(joined[face->data()]);
    if (width >= tolerances.thin) thick.insert(joined[face->data()]);
  }
  result.expected = static_cast<int>(expected.size());
  result.least = static_cast<int>(thick.size());
  return result;
}

}  // namespace cutbench::oracle
