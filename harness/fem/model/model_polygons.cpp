// Constrained vertices and polygons of the model: triangles become one element, and are elements of their own again.
#include <algorithm>

#include "harness/base/errors.h"
#include "harness/fem/model/model.h"

namespace cutbench {

template <int D>
void Model<D>::constraint(const Sheet& sheet, const Constraints& constraints) {
  begin_marking();
  merge(sheet, constraints.polygons);
  refresh_vertices(sheet);
  if (!bending_) refresh_added_mass();
  if (!regrouped_.empty()) update_bending(sheet);
  is_constrained_ = !constraints.constraints.empty();
  if (is_constrained_ && constrained_)
    constrained_->change(constraints, vertices());
  else if (is_constrained_)
    constrained_.emplace(constraints, vertices());
}

template <int D>
void Model<D>::merge(const Sheet& sheet, std::span<const Polygon> polygons) {
  if (physics_.strain == Strain::springs && !polygons.empty())
    throw InputError("a polygon has no springs: take another method than cut_polygons, or another \"strain\"");
  for (const Polygon& polygon : polygons) {
    const TriangleIndex first = polygon.triangles.front();
    if (std::ranges::equal(elements_.members(first), polygon.triangles)) continue;  // it is there already
    for (const TriangleIndex t : polygon.triangles)
      if (const auto old = elements_[t()].polygon; old >= 0) dissolve(static_cast<std::size_t>(old));
    const std::size_t slot = elements_.add_polygon(sheet, polygon);
    membrane_.polygons().reset(slot, elements_.polygon(slot));
    for (const TriangleIndex t : polygon.triangles) membrane_.clear_slots(t()), regrouped_.push_back(t);
    for (const DeformedIndex d : polygon.corners) polygons_of_.append(d(), static_cast<std::int32_t>(slot));
    mark(polygon.corners), mark(polygon.inside);
  }
}

template <int D>
void Model<D>::dissolve(std::size_t polygon) {
  const Polygon& gone = elements_.polygon(polygon).polygon;
  for (const DeformedIndex d : gone.corners) polygons_of_.erase(d(), static_cast<std::int32_t>(polygon));
  mark(gone.corners), mark(gone.inside);
  regrouped_.insert(regrouped_.end(), gone.triangles.begin(), gone.triangles.end());
  elements_.dissolve(polygon);
}

template <int D>
std::vector<Polygon> Model<D>::polygons() const {
  std::vector<Polygon> all;
  for (std::size_t p = 0; p < elements_.polygon_slots(); ++p)
    if (elements_.polygon(p).alive()) all.push_back(elements_.polygon(p).polygon);
  return all;
}

template <int D>
PolygonsLeft Model<D>::polygons_left() const {
  const auto of = [this](TriangleIndex t) {
    return elements_[t()].polygon < 0 ? std::span<const TriangleIndex>{} : elements_.members(t);
  };
  return {of, freed_};
}

template <int D>
void Model<D>::follow(Field& x) const {
  for (std::size_t p = 0; p < elements_.polygon_slots(); ++p) {
    const PolygonElement& polygon = elements_.polygon(p);
    if (polygon.inside.empty()) continue;
    const LinearMap<D> map = polygon.template map<D>(x);
    for (std::size_t i = 0; i < polygon.inside.size(); ++i)
      x.template segment<D>(D * polygon.polygon.inside[i].value) = map.at(polygon.inside[i]);
  }
}

// What the other files call; model.cpp instantiates the rest of the class.
template void Model<2>::constraint(const Sheet&, const Constraints&);
template void Model<2>::dissolve(std::size_t);
template std::vector<Polygon> Model<2>::polygons() const;
template PolygonsLeft Model<2>::polygons_left() const;
template void Model<2>::follow(Field&) const;
template void Model<3>::constraint(const Sheet&, const Constraints&);
template void Model<3>::dissolve(std::size_t);
template std::vector<Polygon> Model<3>::polygons() const;
template PolygonsLeft Model<3>::polygons_left() const;
template void Model<3>::follow(Field&) const;

}  // namespace cutbench
