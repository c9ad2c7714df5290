#include "methods/tools/path_curve.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "harness/mesh/star.h"

namespace cutbench {

void PathCurve::read(const Subdivision& trace) {
  const std::size_t n = trace.nodes.size();
  parameter_of_.clear(0);  // no vertex is known yet
  chord_tolerance_ = trace.chord_tolerance;
  points_.clear(), goes_on_.assign(n, 0);
  for (const auto& node : trace.nodes) points_.push_back(node.place.point);
  degree_.assign(n, 0);
  const auto link = [&](int from, int to) {
    for (const int end : {from, to})
      if (std::uint8_t& d = degree_[static_cast<std::size_t>(end)]; d < 3) ++d;
    if (std::abs(from - to) == 1) goes_on_[static_cast<std::size_t>(std::min(from, to))] = 1;
  };
  for (const auto& face : trace.faces)
    for (int s = face.segments; s >= 0; s = trace.segment(s).next) link(trace.segment(s).from, trace.segment(s).to);
  for (const auto& along : trace.along) link(along.from, along.to);
  for (std::size_t i = 0; i < n; ++i) {
    if (degree_[i] <= 2) continue;
    goes_on_[i] = 0;
    if (i > 0) goes_on_[i - 1] = 0;
  }
}

void PathCurve::find_vertices(const Sheet& sheet, const Subdivision& trace) {
  if (parameter_of_.size() < sheet.vertex_slots()) parameter_of_.grow(2 * sheet.vertex_slots());
  std::size_t i = 0;
  for (const auto& node : trace.nodes) {
    std::size_t found = i;  // nodes keep their order, but for some that are left out
    while (found < points_.size() && points_[found] != node.place.point) ++found;
    if (found == points_.size()) continue;
    i = found;
    parameter_of_.set(node.vertex, static_cast<double>(found));
  }
}

Point2 PathCurve::at(double s) const {
  const auto i = static_cast<std::size_t>(s);
  const double f = s - static_cast<double>(i);
  return f == 0 ? points_[i] : (1 - f) * points_[i] + f * points_[i + 1];
}

bool PathCurve::stays_near(double from, double to, Point2 a, Point2 b, double tolerance) const {
  if (from > to) std::swap(from, to);
  if (from < 0) return false;
  const double most = tolerance * tolerance;
  for (auto i = static_cast<std::size_t>(from); static_cast<double>(i) < to; ++i) {
    if (!goes_on_[i]) return false;
    if (static_cast<double>(i) > from && squared_distance(points_[i], a, b) > most) return false;
  }
  return true;
}

}  // namespace cutbench
