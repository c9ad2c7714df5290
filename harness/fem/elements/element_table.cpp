#include "harness/fem/elements/element_table.h"

#include <algorithm>
#include <cmath>

namespace cutbench {

namespace {

Element element_of(const Sheet& sheet, TriangleIndex t) {
  if (!sheet.triangle(t).alive()) return {};
  Element e;
  e.vertex = sheet.triangle(t).deformed;
  const auto c = sheet.corners(t);
  const double twice = cross(c[1] - c[0], c[2] - c[0]);
  e.area = twice / 2;
  // Each shape function rises across the triangle, at right angles to the edge opposite its corner.
  for (std::size_t k = 0; k < 3; ++k) {
    const Point2 edge = c[(k + 2) % 3] - c[(k + 1) % 3];
    e.gradient[k] = {-edge.y / twice, edge.x / twice};
  }
  return e;
}

}  // namespace

ElementTable::ElementTable(const Sheet& sheet) : rows_(sheet.triangle_slots()) {
  for (std::size_t t = 0; t < rows_.size(); ++t) rows_[t] = element_of(sheet, TriangleIndex(t));
}

void ElementTable::update(const Sheet& sheet) {
  const EditLog& log = sheet.log();
  rows_.resize(sheet.triangle_slots());
  for (const auto& touched : log.touched) rows_[touched.slot()] = element_of(sheet, touched.slot);
  for (std::size_t t = log.triangles_before; t < rows_.size(); ++t) rows_[t] = element_of(sheet, TriangleIndex(t));
}

void ElementTable::add_strong_couplings(double aspect_ratio, std::vector<StrongCoupling>& all) const {
  for (const Element& e : rows_) {
    if (!e.is_triangle()) continue;
    // |gradient| = opposite edge / (2 area), so AR = longest edge^2 / (2 area) = 2 area (largest |gradient|)^2.
    const std::array<double, 3> squared{squared_length(e.gradient[0]), squared_length(e.gradient[1]),
                                        squared_length(e.gradient[2])};
    if (!(2 * e.area * *std::max_element(squared.begin(), squared.end()) > aspect_ratio)) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3;
      const auto [low, high] = std::minmax({e.vertex[k].value, e.vertex[l].value});
      all.push_back({2 * e.area * std::sqrt(squared[k] * squared[l]), low, high});
    }
  }
}

std::size_t ElementTable::add_polygon(const Sheet& sheet, const Polygon& polygon) {
  std::size_t slot = polygons_.size();
  if (free_polygons_.empty())
    polygons_.emplace_back();
  else
    slot = free_polygons_.back(), free_polygons_.pop_back();
  polygons_[slot] = PolygonElement(sheet, polygon);
  for (const TriangleIndex t : polygon.triangles) rows_[t()].polygon = static_cast<std::int32_t>(slot);
  return slot;
}

bool ElementTable::is_inside(TriangleIndex t, DeformedIndex vertex) const {
  const std::int32_t polygon = rows_[t()].polygon;
  if (polygon < 0) return false;
  const auto& inside = polygons_[static_cast<std::size_t>(polygon)].polygon.inside;
  return std::find(inside.begin(), inside.end(), vertex) != inside.end();
}

void ElementTable::dissolve(std::size_t polygon) {
  for (const TriangleIndex t : polygons_[polygon].polygon.triangles) rows_[t()].polygon = -1;
  polygons_[polygon] = {};
  free_polygons_.push_back(polygon);
}

}  // namespace cutbench
