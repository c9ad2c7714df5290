// The model after a cut: the rows, masses and loads of the vertices whose elements have changed, and no others.
#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/fem/model/model.h"

namespace cutbench {

template <int D>
void Model<D>::update(const Sheet& sheet) {
  const EditLog& log = sheet.log();
  is_constrained_ = false;
  freed_.clear();
  begin_marking();
  for (const auto& touched : log.touched) {
    if (!touched.before.alive()) continue;
    if (elements_[touched.slot()].polygon >= 0) {
      const auto members = elements_.members(touched.slot);
      freed_.insert(freed_.end(), members.begin(), members.end());
      dissolve(static_cast<std::size_t>(elements_[touched.slot()].polygon));
    }
    incidence_.remove(touched.before.deformed, touched.slot());
    mark(touched.before.deformed);
  }
  elements_.update(sheet);
  resize(sheet);
  const auto enter = [&](std::size_t e) {
    if (!elements_[e].alive()) return membrane_.clear_slots(e);
    incidence_.add(elements_[e], e);
    mark(elements_[e].vertex);
  };
  for (const auto& touched : log.touched) enter(touched.slot());
  for (std::size_t e = log.triangles_before; e < elements_.size(); ++e) enter(e);
  refresh_vertices(sheet);
  if (!bending_) refresh_added_mass();
}

template <int D>
void Model<D>::update_bending(const Sheet& sheet) {
  if (!bending_) return regrouped_.clear();
  bending_->update(sheet, &elements_, regrouped_);
  regrouped_.clear();
  history_.begin_change();
  for (const std::int32_t v : bending_->written_rows()) history_.mark(static_cast<std::size_t>(v));
  if (!added_mass_) return;
  for (const std::int32_t v : bending_->written_rows()) {
    const DeformedIndex d(static_cast<std::size_t>(v));
    mark({&d, 1});
  }
  refresh_added_mass();
}

template <int D>
void Model<D>::begin_marking() {
  ++round_;
  marked_.clear();
}

template <int D>
void Model<D>::mark(std::span<const DeformedIndex> vertices) {
  for (const auto d : vertices) {
    if (d() >= marked_in_.size()) marked_in_.resize(d() + 1);
    if (std::exchange(marked_in_[d()], round_) != round_) marked_.push_back(d());
  }
}

template <int D>
void Model<D>::refresh_vertices(const Sheet& sheet) {
  for (const std::size_t v : marked_) refresh_row(v), refresh_mass(v), refresh_loads(sheet, v);
  history_.begin_change();
  for (const std::size_t v : marked_) history_.mark(v);
}

/// The pattern of row v, and where the elements round v find their blocks in it.
template <int D>
void Model<D>::refresh_row(std::size_t v) {
  const auto corners = incidence_.at(v);
  columns_.clear();
  const auto add = [&](std::span<const DeformedIndex> with) {
    if (columns_.empty()) columns_.push_back(static_cast<std::int32_t>(v));
    for (const auto d : with)
      if (std::find(columns_.begin(), columns_.end(), d.value) == columns_.end()) columns_.push_back(d.value);
  };
  for (const auto c : corners)
    if (const Element& e = elements_[triangle_of(c)()]; e.is_triangle()) add(e.vertex);
  for (const std::int32_t p : polygons_of_[v]) add(elements_.polygon(static_cast<std::size_t>(p)).polygon.corners);
  blocks_.set_row(v, columns_);
  set_polygon_slots(v);
  for (const auto c : corners) {
    const std::size_t e = triangle_of(c)();
    if (!elements_[e].is_triangle()) continue;
    for (std::size_t j = 0; j < 3; ++j)
      membrane_.set_slot(e, static_cast<std::size_t>(corner_of(c)), j, blocks_.find(v, elements_[e].vertex[j].value));
  }
}

template <int D>
void Model<D>::set_polygon_slots(std::size_t v) {
  for (const std::int32_t p : polygons_of_[v]) {
    const auto slot = static_cast<std::size_t>(p);
    const auto& corners = elements_.polygon(slot).polygon.corners;
    polygon_slots_.clear();
    for (const auto d : corners) polygon_slots_.push_back(blocks_.find(v, d.value));
    const auto own = std::find(corners.begin(), corners.end(), DeformedIndex(v));
    membrane_.polygons().set_slots(slot, static_cast<std::size_t>(own - corners.begin()), polygon_slots_);
  }
}

template <int D>
void Model<D>::refresh_mass(std::size_t v) {
  double third = 0, of_polygons = 0;
  for (const auto c : incidence_.at(v))
    if (const Element& e = elements_[triangle_of(c)()]; e.is_triangle()) third += e.material_area();
  for (const std::int32_t p : polygons_of_[v])
    of_polygons += elements_.polygon(static_cast<std::size_t>(p)).corner_area();
  mass_[v] = material_.density * (third / 3 + of_polygons);
  if (!consistent_mass_) return;
  consistent_mass_->set_row(v, columns_);
  if (of_polygons > 0) consistent_mass_->block(consistent_mass_->first_slot(v))(0) += material_.density * of_polygons;
  for (const auto c : incidence_.at(v)) {
    const Element& e = elements_[triangle_of(c)()];
    if (!e.is_triangle()) continue;
    for (const auto d : e.vertex)
      consistent_mass_->block(consistent_mass_->find(v, d.value))(0) +=
          material_.density * e.material_area() / (d() == v ? 6 : 12);
  }
}

/// \pre the marked vertices are those whose mass, triangles or stencils changed.
template <int D>
void Model<D>::refresh_added_mass() {
  if (!added_mass_) return;
  added_mass_->update(element_modes(), incidence_, marked_);
  history_.begin_change();
  for (const std::size_t v : added_mass_->written_rows()) history_.mark(v);
}

template <int D>
void Model<D>::refresh_loads(const Sheet& sheet, std::size_t v) {
  const VertexIndex rest_vertex = sheet.rest_vertex(DeformedIndex(v));
  const auto gravity = coordinates(physics_.gravity);
  for (std::size_t k = 0; k < D; ++k) {
    external_[D * v + k] = mass_[v] * gravity[k];
    held_[D * v + k] = 1, pin_of_[D * v + k] = -1;
  }
  if (!rest_vertex.valid()) return;
  const Point2 rest = places_[v] = sheet.rest(rest_vertex);
  if (blocks_.columns(v).empty()) return;  // inside a polygon
  for (std::size_t k = 0; k < D; ++k) {
    for (std::size_t p = 0; p < pins_.size() && pin_of_[D * v + k] < 0; ++p)
      if (pins_[p].axes[k] && pins_[p].where.contains(rest)) pin_of_[D * v + k] = static_cast<std::int32_t>(p);
    held_[D * v + k] = pin_of_[D * v + k] >= 0;
  }
  if (tractions_.empty()) return;
  for (const auto c : incidence_.at(v))
    for (const HalfEdge h : {c, Sheet::previous(c)}) {
      if (!sheet.on_border(h)) continue;
      const Point2 a = sheet.rest(sheet.origin(h)), b = sheet.rest(sheet.target(h));
      for (const Traction& traction : tractions_) {
        if (!traction.where.contains(a) || !traction.where.contains(b)) continue;
        const auto force = coordinates(traction.force);
        for (std::size_t k = 0; k < D; ++k) external_[D * v + k] += force[k] * std::sqrt(squared_length(b - a)) / 2;
      }
    }
}

// What the other files call; model.cpp instantiates the rest of the class.
template void Model<2>::update(const Sheet&);
template void Model<2>::update_bending(const Sheet&);
template void Model<2>::begin_marking();
template void Model<2>::mark(std::span<const DeformedIndex>);
template void Model<2>::refresh_vertices(const Sheet&);
template void Model<2>::refresh_added_mass();
template void Model<3>::update(const Sheet&);
template void Model<3>::update_bending(const Sheet&);
template void Model<3>::begin_marking();
template void Model<3>::mark(std::span<const DeformedIndex>);
template void Model<3>::refresh_vertices(const Sheet&);
template void Model<3>::refresh_added_mass();

}  // namespace cutbench
