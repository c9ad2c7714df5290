#include "harness/fem/elements/element_table.h"

#include <algorithm>
#include <cmath>

#include "harness/base/conversions.h"
#include "harness/fem/elements/rest_corners.h"

namespace cutbench {

namespace {

Element element_of(const Sheet& sheet, TriangleIndex t) {
  if (!sheet.triangle(t).alive()) return {};
  Element e;
  e.vertex = sheet.triangle(t).deformed;
  const auto c = rest_corners(sheet, t);
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
  polygons_of_.resize(sheet.deformed_slots());
}

ElementTable::ElementTable(const Sheet& sheet, const Constraints& merged) : ElementTable(sheet) {
  for (const Polygon& polygon : merged.polygons) add(sheet, polygon);
}

void ElementTable::update(const Sheet& sheet) {
  const EditLog& log = sheet.log();
  rows_.resize(sheet.triangle_slots());
  polygons_of_.resize(sheet.deformed_slots());
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

bool ElementTable::is_inside(TriangleIndex t, DeformedIndex vertex) const {
  const std::int32_t polygon = rows_[t()].polygon;
  if (polygon < 0) return false;
  const auto& inside = polygons_[to_size(polygon)].polygon.inside;
  return std::find(inside.begin(), inside.end(), vertex) != inside.end();
}

ElementShape ElementTable::shape(TriangleIndex t) const {
  const Element& e = rows_[t()];
  if (e.is_triangle()) return {e.vertex, e.gradient, {}};
  const PolygonElement& polygon = polygons_[to_size(e.polygon)];
  return {polygon.polygon.corners, polygon.gradient, polygon.offset};
}

double ElementTable::polygon_area_round(std::size_t vertex) const {
  double area = 0;
  for (const std::int32_t p : polygons_of_[vertex]) area += polygons_[to_size(p)].corner_area();
  return area;
}

double ElementTable::area_round(std::size_t vertex, std::span<const HalfEdge> triangles) const {
  double of_triangles = 0;
  for (const HalfEdge c : triangles)
    if (const Element& e = rows_[triangle_of(c)()]; e.is_triangle()) of_triangles += e.material_area();
  return of_triangles / 3 + polygon_area_round(vertex);
}

Field ElementTable::areas(std::size_t vertices) const {
  Field all = Field::Zero(to_index(vertices));
  for (const Element& e : rows_)
    if (e.is_triangle())
      for (const auto d : e.vertex) all[d.value] += e.area / 3;
  for (const PolygonElement& polygon : polygons_)
    for (const auto d : polygon.polygon.corners) all[d.value] += polygon.corner_area();
  return all;
}

// --- compounds: elements of several triangles ------------------------------------------------------------------------

std::size_t ElementTable::add(const Sheet& sheet, const Polygon& polygon) {
  std::size_t slot = polygons_.size();
  if (free_polygons_.empty()) {
    polygons_.emplace_back();
  } else {
    slot = free_polygons_.back();
    free_polygons_.pop_back();
  }
  polygons_[slot] = PolygonElement(sheet, polygon);
  for (const TriangleIndex t : polygon.triangles) rows_[t()].polygon = to_int32(slot);
  for (const DeformedIndex d : polygon.corners) polygons_of_.append(d(), to_int32(slot));
  return slot;
}

std::vector<TriangleIndex> ElementTable::merge(const Sheet& sheet, const Constraints& merged, Regrouped& regrouped) {
  std::vector<TriangleIndex> made;
  for (const Polygon& polygon : merged.polygons)
    if (merge_one(sheet, polygon, regrouped)) made.push_back(polygon.triangles.front());
  return made;
}

/// False: it is there already.
bool ElementTable::merge_one(const Sheet& sheet, const Polygon& polygon, Regrouped& regrouped) {
  const auto now = members(polygon.triangles.front());
  if (std::equal(now.begin(), now.end(), polygon.triangles.begin(), polygon.triangles.end())) return false;
  for (const TriangleIndex t : polygon.triangles)
    if (const auto old = rows_[t()].polygon; old >= 0) dissolve(to_size(old), regrouped);
  add(sheet, polygon);
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(regrouped.triangles, polygon.triangles);
  append(regrouped.vertices, polygon.corners);
  append(regrouped.vertices, polygon.inside);
  return true;
}

void ElementTable::release(TriangleIndex t, Regrouped& regrouped) {
  const std::int32_t polygon = rows_[t()].polygon;
  if (polygon < 0) return;
  const auto now = members(t);
  freed_.insert(freed_.end(), now.begin(), now.end());
  dissolve(to_size(polygon), regrouped);
}

void ElementTable::dissolve(std::size_t polygon, Regrouped& regrouped) {
  const Polygon& gone = polygons_[polygon].polygon;
  for (const DeformedIndex d : gone.corners) polygons_of_.erase(d(), to_int32(polygon));
  for (const TriangleIndex t : gone.triangles) rows_[t()].polygon = -1;
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(regrouped.triangles, gone.triangles);
  append(regrouped.vertices, gone.corners);
  append(regrouped.vertices, gone.inside);
  polygons_[polygon] = {};
  free_polygons_.push_back(polygon);
}

Constraints ElementTable::merged() const {
  Constraints all;
  for (const PolygonElement& element : polygons_)
    if (element.alive()) all.polygons.push_back(element.polygon);
  return all;
}

PolygonsLeft ElementTable::left_since_change() const {
  const auto of = [this](TriangleIndex t) {
    return rows_[t()].polygon < 0 ? std::span<const TriangleIndex>{} : members(t);
  };
  return {of, freed_};
}

template <int D>
void ElementTable::follow(Field& x) const {
  for (const PolygonElement& element : polygons_) {
    if (element.inside.empty()) continue;
    const LinearMap<D> map = element.map<D>(x);
    for (std::size_t i = 0; i < element.inside.size(); ++i)
      x.segment<D>(D * element.polygon.inside[i].value) = map.at(element.inside[i]);
  }
}

template <int D>
LinearPart<D> ElementTable::linear_part(TriangleIndex t, const Field& x) const {
  const Element& member = rows_[t()];
  const PolygonElement& polygon = polygons_[to_size(member.polygon)];
  const LinearMap<D> map = polygon.map<D>(x);
  return {map.at(polygon.offset_of(member.vertex[0])), map.gradient};
}

template LinearPart<2> ElementTable::linear_part<2>(TriangleIndex, const Field&) const;
template LinearPart<3> ElementTable::linear_part<3>(TriangleIndex, const Field&) const;
template void ElementTable::follow<2>(Field&) const;
template void ElementTable::follow<3>(Field&) const;

}  // namespace cutbench
