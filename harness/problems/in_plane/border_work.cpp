#include "harness/problems/in_plane/border_work.h"

#include <algorithm>
#include <array>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

/// Panels of a side end where a cut crosses it: the field jumps there.
std::vector<double> panel_ends(Point2 a, Point2 b, const std::vector<Curve>& cuts) {
  constexpr int panels = 64;
  std::vector<double> ends;
  for (int i = 0; i <= panels; ++i) ends.push_back(to_double(i) / panels);
  for (const Curve& cut : cuts)
    for (std::size_t i = 0; i + 1 < cut.points.size(); ++i) {
      const Point2 p = cut.points[i], d = cut.points[i + 1] - p;
      const double det = cross(b - a, d);
      if (det == 0) continue;
      const double s = cross(p - a, d) / det, t = cross(p - a, b - a) / det;
      if (s > 0 && s < 1 && t > 0 && t < 1) ends.push_back(s);
    }
  std::sort(ends.begin(), ends.end());
  return ends;
}

}  // namespace

BorderWork border_work(const ElasticField& field, const ElasticField& before, const std::vector<Curve>& cuts,
                       const std::function<bool(Complex)>& cut_off) {
  constexpr std::array<std::array<double, 2>, 3> gauss{
      {{-0.774596669241483, 5.0 / 9}, {0, 8.0 / 9}, {0.774596669241483, 5.0 / 9}}};
  BorderWork work;
  const std::array<Point2, 5> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}};
  for (std::size_t k = 0; k < 4; ++k) {
    const Point2 a = corners[k], side = corners[k + 1] - a;
    const Eigen::Vector2d normal(side.y, -side.x);
    const auto ends = panel_ends(a, corners[k + 1], cuts);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
      for (const auto& [place, weight] : gauss) {
        const double half = (ends[i + 1] - ends[i]) / 2;
        const Point2 p = a + (ends[i] + half * (1 + place)) * side;
        if (cut_off && cut_off(field.frame().to_local(p))) continue;
        const Eigen::Vector2d u = field.displacement(p), t = field.stress(p) * normal;
        work.after += weight * half / 2 * t.dot(u);
        work.released += weight * half / 2 * (u.dot(before.stress(p) * normal) - t.dot(before.displacement(p)));
      }
  }
  return work;
}

}  // namespace cutbench
