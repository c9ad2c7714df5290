// The model after a cut: the rows, masses and loads of the vertices whose elements have changed, and no others.
#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/fem/model/model.h"

namespace cutbench {

template <int D>
void Model<D>::update(const Sheet& sheet) {
  const EditLog& log = sheet.log();
  is_constrained_ = false;
  elements_.begin_change();
  begin_marking();
  move_phantoms(sheet);
  if (added_mass_) mark(std::exchange(own_mass_, {}));  // it is added to that of the triangles
  for (const auto& touched : log.touched) {
    if (!touched.before.alive()) continue;
    elements_.release(touched.slot, regrouped_);
    mark_regrouped();
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
double Model<D>::update_bending(const Sheet& sheet, const PlacesAtCut* places) {
  forget_rotation();
  if (!bending_) {
    regrouped_.triangles.clear();
    return 0;
  }
  const double change = bending_->update(sheet, &elements_, regrouped_.triangles, places);
  regrouped_.triangles.clear();
  history_.begin_change();
  for (const std::int32_t v : bending_->written_rows()) history_.mark(to_size(v));
  if (curved_) refresh_curved_bending(sheet);
  if (!added_mass_) return change;
  for (const std::int32_t v : bending_->written_rows()) {
    const DeformedIndex d(to_size(v));
    mark({&d, 1});
  }
  refresh_added_mass();
  return change;
}

template <int D>
void Model<D>::begin_marking() {
  forget_rotation();
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
void Model<D>::mark_regrouped() {
  mark(regrouped_.vertices);
  regrouped_.vertices.clear();
}

template <int D>
void Model<D>::refresh_vertices(const Sheet& sheet) {
  for (const std::size_t v : marked_) {
    refresh_row(v);
    refresh_mass(v);
    refresh_loads(sheet, v);
  }
  history_.begin_change();
  for (const std::size_t v : marked_) history_.mark(v);
}

/// The pattern of row v, and where the elements round v find their blocks in it.
template <int D>
void Model<D>::refresh_row(std::size_t v) {
  const auto triangles = incidence_.at(v);
  columns_.clear();
  elements_.for_each_round(v, triangles, [&](std::span<const DeformedIndex> with) {
    if (columns_.empty()) columns_.push_back(to_int32(v));
    for (const auto d : with)
      if (std::find(columns_.begin(), columns_.end(), d.value) == columns_.end()) columns_.push_back(d.value);
  });
  if (curved_ && v < bending_->matrix().rows()) {  // else its stencils are yet to come
    for (const auto& [t, place] : bending_->stencils_of(v))
      for (const StencilTerm& term : bending_->stencil(to_size(t)))
        if (std::find(columns_.begin(), columns_.end(), term.vertex) == columns_.end()) columns_.push_back(term.vertex);
  }
  blocks_.set_row(v, columns_);
  membrane_.find_slots(elements_, v, triangles, blocks_);
}

/// After the bending: its blocks stand among the membrane's.
template <int D>
void Model<D>::refresh_curved_bending(const Sheet& sheet) {
  for (const std::int32_t v : bending_->written_rows()) refresh_row(to_size(v));
  curved_->update(sheet, *bending_);
}

template <int D>
void Model<D>::refresh_mass(std::size_t v) {
  const auto triangles = incidence_.at(v);
  mass_[v] = material_.density * elements_.area_round(v, triangles);
  if (!consistent_mass_) return;
  consistent_mass_->set_row(v, columns_);
  elements_.for_each_share(v, triangles, [&](DeformedIndex column, double area, int parts) {
    consistent_mass_->block(consistent_mass_->find(v, column.value))(0) += material_.density * area / parts;
  });
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
  const VertexIndex rest_vertex =
      v < sheet.deformed_slots() ? sheet.rest_vertex(DeformedIndex(v)) : VertexIndex();  // none: a phantom node
  const auto gravity = coordinates(physics_.gravity);
  for (std::size_t k = 0; k < D; ++k) {
    external_[D * v + k] = mass_[v] * gravity[k];
    if (rest_vertex.valid() && D * v + k < force_.size()) external_[D * v + k] += force_[D * v + k];
    held_[D * v + k] = v < first_phantom_ || v >= first_phantom_ + phantoms_.size();
    pin_of_[D * v + k] = -1;
  }
  if (!rest_vertex.valid()) return;
  const Point2 rest = places_[v] = sheet.rest(rest_vertex);
  if (blocks_.columns(v).empty()) return;  // inside an element
  for (std::size_t k = 0; k < D; ++k) {
    for (std::size_t p = 0; p < pins_.size() && pin_of_[D * v + k] < 0; ++p)
      if (pins_[p].axes[k] && pins_[p].where.contains(rest)) pin_of_[D * v + k] = to_int32(p);
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

template <int D>
void Model<D>::set_pins_and_force(const Sheet& sheet, std::vector<Pin> pins, std::vector<double> force) {
  pins_ = std::move(pins);
  force_ = std::move(force);
  const std::vector<std::uint8_t> held_before = held_;
  for (std::size_t v = 0; v < vertices(); ++v) refresh_loads(sheet, v);
  if (held_ == held_before) return;
  history_.begin_change();
  for (std::size_t v = 0; v < vertices(); ++v)
    if (!std::equal(&held_[D * v], &held_[D * v] + D, &held_before[D * v])) history_.mark(v);
}

// What the other files call; model.cpp instantiates the rest of the class.
template void Model<2>::update(const Sheet&);
template double Model<2>::update_bending(const Sheet&, const PlacesAtCut*);
template void Model<2>::begin_marking();
template void Model<2>::mark(std::span<const DeformedIndex>);
template void Model<2>::mark_regrouped();
template void Model<2>::refresh_vertices(const Sheet&);
template void Model<2>::refresh_added_mass();
template void Model<2>::refresh_curved_bending(const Sheet&);
template void Model<2>::set_pins_and_force(const Sheet&, std::vector<Pin>, std::vector<double>);
template void Model<3>::update(const Sheet&);
template double Model<3>::update_bending(const Sheet&, const PlacesAtCut*);
template void Model<3>::begin_marking();
template void Model<3>::mark(std::span<const DeformedIndex>);
template void Model<3>::mark_regrouped();
template void Model<3>::refresh_vertices(const Sheet&);
template void Model<3>::refresh_added_mass();
template void Model<3>::refresh_curved_bending(const Sheet&);
template void Model<3>::set_pins_and_force(const Sheet&, std::vector<Pin>, std::vector<double>);

}  // namespace cutbench
