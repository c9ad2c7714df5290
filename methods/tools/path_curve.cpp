#include "methods/tools/path_curve.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/mesh/one_ring.h"
#include "harness/mesh/tolerances.h"

namespace cutbench {

namespace {

/// The point of a closed polyline that point k is, where k counts on past its end.
Point2 point_of(const Polyline& path, std::size_t k) { return path.points[k % path.points.size()]; }

double distance(Point2 a, Point2 b) { return std::sqrt(squared_length(b - a)); }

}  // namespace

void PathCurve::read(const Sheet& sheet, const Subdivision& trace, const Polyline& path) {
  const std::size_t n = trace.nodes.size();
  parameter_of_.clear(0);  // no vertex is known yet
  chord_tolerance_ = trace.chord_tolerance;
  closed_ = path.closed;
  simplified_ = path.curved && std::isfinite(chord_tolerance_);
  points_.clear();
  left_out_.clear();
  is_known_.assign(n, 0);
  for (const auto& node : trace.nodes) points_.push_back(node.place.point);
  degree_.assign(n, 0);
  const auto link = [&](int from, int to) {
    for (const int end : {from, to})
      if (std::uint8_t& d = degree_[to_size(end)]; d < 3) ++d;
    if (std::abs(from - to) == 1) is_known_[to_size(std::min(from, to))] = 1;
  };
  for (const auto& face : trace.faces)
    for (int s = face.segments; s >= 0; s = trace.segment(s).next) link(trace.segment(s).from, trace.segment(s).to);
  for (const auto& along : trace.along) link(along.from, along.to);
  if (simplified_) {
    locate_nodes(path, sheet.snap());
    for (std::size_t i = 0; i + 1 < n; ++i) add_left_out(i, path);
  }
  goes_on_ = is_known_;
  for (std::size_t i = 0; i < n; ++i) {
    if (degree_[i] <= 2) continue;
    goes_on_[i] = 0;
    if (i > 0) goes_on_[i - 1] = 0;
  }
}

/// Finds the nodes on the polyline, one after the other in its direction. Nodes on an older incision that the path
/// follows are not on it.
void PathCurve::locate_nodes(const Polyline& path, double snap) {
  constexpr std::size_t most = 4096;  // points of the polyline between two nodes that are looked at
  const double near2 = meeting_tolerance * meeting_tolerance * snap * snap;
  const std::size_t pieces = path.closed ? 2 * path.points.size() : path.points.size() - 1;
  place_.assign(points_.size(), -1);
  double last = 0;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    double nearest2 = near2;
    const auto first = to_size(last);
    for (std::size_t k = first; k < std::min(pieces, first + most); ++k) {
      const Point2 a = point_of(path, k), edge = point_of(path, k + 1) - a;
      const double least = k == first ? last - to_double(first) : 0;
      const double f = std::clamp(dot(points_[i] - a, edge) / squared_length(edge), least, 1.0);
      const double d2 = squared_length(points_[i] - (a + f * edge));
      if (d2 <= nearest2) {
        nearest2 = d2;
        place_[i] = to_double(k) + f;
      } else if (place_[i] >= 0)
        break;  // it leads away again
    }
    if (place_[i] >= 0) last = place_[i];
  }
}

/// Enters what the trace left out between a node and the next.
void PathCurve::add_left_out(std::size_t node, const Polyline& path) {
  const double from = place_[node], to = place_[node + 1];
  if (from < 0 || to < from) is_known_[node] = 0;
  if (!is_known_[node]) return;
  const std::size_t first = left_out_.size();
  double length = 0;
  Point2 before = points_[node];
  for (auto k = to_size(from) + 1; to_double(k) < to; ++k) {
    length += distance(before, point_of(path, k));
    before = point_of(path, k);
    left_out_.push_back({length, before});
  }
  length += distance(before, points_[node + 1]);
  for (std::size_t i = first; i < left_out_.size(); ++i)
    left_out_[i].s = to_double(node) + (length > 0 ? left_out_[i].s / length : 0);
}

void PathCurve::find_vertices(const Sheet& sheet, const Subdivision& trace) {
  if (parameter_of_.size() < sheet.vertex_slots()) parameter_of_.grow(2 * sheet.vertex_slots());
  std::size_t i = 0;
  for (const auto& node : trace.nodes) {
    std::size_t found = i;  // nodes keep their order, but for some that are left out
    while (found < points_.size() && points_[found] != node.place.point) ++found;
    if (found == points_.size()) continue;
    i = found;
    parameter_of_.set(node.vertex, to_double(found));
  }
}

/// The number of left out points up to s.
std::size_t PathCurve::first_behind(double s) const {
  const auto behind = std::upper_bound(left_out_.begin(), left_out_.end(), s,
                                       [](double value, const LeftOut& point) { return value < point.s; });
  return to_size(behind - left_out_.begin());
}

Point2 PathCurve::at(double s) const {
  const auto i = to_size(s);
  const double f = s - to_double(i);
  if (f == 0) return points_[i];
  LeftOut a{to_double(i), points_[i]}, b{to_double(i + 1), points_[i + 1]};
  const std::size_t next = first_behind(s);
  if (next > 0 && left_out_[next - 1].s > a.s) a = left_out_[next - 1];
  if (next < left_out_.size() && left_out_[next].s < b.s) b = left_out_[next];
  const double g = (s - a.s) / (b.s - a.s);
  return (1 - g) * a.point + g * b.point;
}

bool PathCurve::is_within(double from, double to, Point2 a, Point2 b, double tolerance) const {
  for (auto i = to_size(from); to_double(i) < to; ++i)
    if (to_double(i) > from && squared_distance(points_[i], a, b) > tolerance * tolerance) return false;
  if (left_out_.empty()) return true;
  const double most = std::max(tolerance, chord_tolerance_);
  for (std::size_t i = first_behind(from); i < left_out_.size() && left_out_[i].s < to; ++i)
    if (squared_distance(left_out_[i].point, a, b) > most * most) return false;
  return true;
}

bool PathCurve::may_divide(double from, double to, Point2 a, Point2 b, double tolerance) const {
  if (!is_piece(from, to)) return false;
  const double s = (from + to) / 2;
  const Point2 middle = at(s);
  return stays_near(from, s, a, middle, tolerance) && stays_near(s, to, middle, b, tolerance);
}

bool PathCurve::stays_near(double from, double to, Point2 a, Point2 b, double tolerance) const {
  if (from > to) std::swap(from, to);
  if (from < 0) return false;
  for (auto i = to_size(from); to_double(i) < to; ++i)
    if (!goes_on_[i]) return false;
  return is_within(from, to, a, b, tolerance);
}

bool PathCurve::stays_near_between_nodes(int from, int to, Point2 a, Point2 b, double tolerance) const {
  if (from > to) std::swap(from, to);
  for (int i = from; i < to; ++i)
    if (!is_known_[to_size(i)]) return !simplified_;
  return is_within(from, to, a, b, tolerance);
}

}  // namespace cutbench
