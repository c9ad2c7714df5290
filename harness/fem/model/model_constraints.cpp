// Constrained vertices of the model, triangles that become one element, phantom nodes, and the copied elements that
// they are the corners of.
#include <utility>

#include "harness/fem/constraints/with_seams.h"
#include "harness/fem/elements/copied_bending.h"
#include "harness/fem/model/model.h"

namespace cutbench {

template <int D>
void Model<D>::constrain(const Sheet& sheet, const Constraints& constraints) {
  membrane_.check_takes(constraints);
  begin_marking();
  for (const TriangleIndex t : elements_.merge(sheet, constraints, regrouped_)) membrane_.join(elements_, t);
  mark_regrouped();
  leave_phantoms();
  refresh_vertices(sheet);
  take_phantoms(sheet, constraints);
  if (!bending_) refresh_added_mass();
  if (!regrouped_.triangles.empty()) update_bending(sheet);
  if (sheet.seams().empty())
    set_constraints(constraints);
  else
    set_constraints(with_seams(constraints, sheet, pinned_vertices()));
}

template <int D>
void Model<D>::set_constraints(const Constraints& constraints) {
  is_constrained_ = !constraints.constraints.empty();
  if (is_constrained_ && constrained_)
    constrained_->change(constraints, vertices(), 0);
  else if (is_constrained_)
    constrained_.emplace(constraints, vertices(), 0);
}

template <int D>
std::vector<std::uint8_t> Model<D>::pinned_vertices() const {
  std::vector<std::uint8_t> result(vertices());
  for (std::size_t i = 0; i < D * vertices(); ++i)
    if (pinned(i)) result[i / D] = 1;
  return result;
}

/// What the copied elements had is that of the sheet's vertices and triangles again. \pre begin_marking()
template <int D>
void Model<D>::leave_phantoms() {
  mark(own_mass_);
  own_mass_.clear();
  if (phantoms_.empty()) return;
  history_.begin_change();
  for (std::size_t v = first_phantom_; v < first_phantom_ + phantoms_.size(); ++v) {
    blocks_.set_row(v, {});
    mass_[v] = 0;
    for (std::size_t k = 0; k < D; ++k) {
      external_[D * v + k] = 0;
      held_[D * v + k] = 1;
    }
    history_.mark(v);
  }
  phantoms_.clear();
}

template <int D>
void Model<D>::take_phantoms(const Sheet& sheet, const Constraints& constraints) {
  first_phantom_ = sheet.deformed_slots();
  phantoms_ = constraints.phantoms;
  if (mass_.size() < first_phantom_ + phantoms_.size()) {
    mass_.resize(first_phantom_ + phantoms_.size());
    resize(sheet);
  }
  history_.begin_change();
  for (std::size_t i = 0; i < phantoms_.size(); ++i) {
    const std::size_t v = first_phantom_ + i;
    const std::int32_t own = to_int32(v);
    blocks_.set_row(v, {&own, 1});
    if (consistent_mass_) consistent_mass_->set_row(v, {});
    places_[v] = sheet.rest(sheet.rest_vertex(phantoms_[i]));
    set_own_mass(sheet, v, 0);
  }
  if (physics_.mass != Mass::consistent && !constraints.lumped.empty()) {
    for (const Constraint& constraint : constraints.constraints) set_own_mass(sheet, constraint.vertex(), 0);
    for (const auto& [unknown, area] : constraints.lumped) set_own_mass(sheet, unknown(), material_.density * area);
  }
  if (!bending_ || constraints.copied.empty()) return;
  bending_->replace(copied_stencils(sheet, constraints, *bending_), vertices());
  for (const std::int32_t v : bending_->written_rows()) history_.mark(to_size(v));
}

template <int D>
void Model<D>::set_own_mass(const Sheet& sheet, std::size_t v, double mass) {
  mass_[v] = mass;
  if (v < first_phantom_) own_mass_.push_back(DeformedIndex(v));
  refresh_loads(sheet, v);
  history_.mark(v);
}

// What the other files call; model.cpp instantiates the rest of the class.
template void Model<2>::constrain(const Sheet&, const Constraints&);
template void Model<3>::constrain(const Sheet&, const Constraints&);
template void Model<2>::set_constraints(const Constraints&);
template void Model<3>::set_constraints(const Constraints&);
template std::vector<std::uint8_t> Model<2>::pinned_vertices() const;
template std::vector<std::uint8_t> Model<3>::pinned_vertices() const;
template void Model<2>::leave_phantoms();
template void Model<3>::leave_phantoms();

}  // namespace cutbench
