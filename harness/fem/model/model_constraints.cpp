// Constrained vertices of the model, triangles that become one element, phantom nodes, and the copied elements that
// they are the corners of.
#include <algorithm>
#include <utility>

#include "harness/fem/constraints/with_seams.h"
#include "harness/fem/model/model.h"

namespace cutbench {

namespace {

/// Before phantom nodes there is room for so many more vertices, a share of those that there are: else each cut would
/// give them new numbers, and the whole system with them.
constexpr double room_for_vertices = 0.125;

/// With phantom nodes behind the model's room for vertices instead of right behind the sheet's.
Constraints with_room(const Constraints& constraints, std::size_t slots, std::size_t first_phantom) {
  Constraints moved = constraints;
  const auto move = [&](DeformedIndex& u) {
    if (u.valid() && u() >= slots) u = DeformedIndex(u() + first_phantom - slots);
  };
  for (Constraint& constraint : moved.constraints)
    for (DeformedIndex& master : constraint.masters) move(master);
  for (GhostEdge& ghost : moved.ghosts)
    for (DeformedIndex& unknown : ghost.unknown) move(unknown);
  for (CopiedElement& element : moved.copied)
    for (DeformedIndex& unknown : element.unknown) move(unknown);
  for (LumpedArea& lumped : moved.lumped) move(lumped.unknown);
  return moved;
}

}  // namespace

template <int D>
void Model<D>::constrain(const Sheet& sheet, const Constraints& constraints) {
  membrane_.check_takes(constraints);
  begin_marking();
  for (const TriangleIndex t : elements_.merge(sheet, constraints, regrouped_)) membrane_.join(elements_, t);
  mark_regrouped();
  refresh_vertices(sheet);
  if (!bending_) refresh_added_mass();
  if (!regrouped_.triangles.empty()) update_bending(sheet);
  take_phantoms(sheet, constraints.phantoms);
  const bool is_moved = !phantoms_.empty() && first_phantom_ > sheet.deformed_slots();
  const Constraints moved = is_moved ? with_room(constraints, sheet.deformed_slots(), first_phantom_) : Constraints();
  const Constraints& own = is_moved ? moved : constraints;
  take_masses(sheet, own);
  if (bending_ && !own.copied.empty()) take_copied_bending(sheet, own);
  if (sheet.seams().empty())
    set_constraints(own);
  else
    set_constraints(with_seams(own, sheet, pinned_vertices()));
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

/// Those of before that are copies of the same vertices stay as they are.
template <int D>
void Model<D>::take_phantoms(const Sheet& sheet, const std::vector<DeformedIndex>& phantoms) {
  if (phantoms_.empty()) first_phantom_ = std::max(first_phantom_, sheet.deformed_slots());
  if (mass_.size() < first_phantom_ + phantoms.size()) {
    mass_.resize(first_phantom_ + phantoms.size());
    resize(sheet);
  }
  history_.begin_change();
  for (std::size_t i = phantoms.size(); i < phantoms_.size(); ++i) clear_vertex(first_phantom_ + i);
  const std::vector<DeformedIndex> before = std::exchange(phantoms_, phantoms);
  for (std::size_t i = 0; i < phantoms_.size(); ++i) {
    if (i < before.size() && before[i] == phantoms_[i]) continue;
    const std::size_t v = first_phantom_ + i;
    const std::int32_t own = to_int32(v);
    blocks_.set_row(v, {&own, 1});
    if (consistent_mass_) consistent_mass_->set_row(v, {});
    places_[v] = sheet.rest(sheet.rest_vertex(phantoms_[i]));
    set_mass(sheet, v, 0);
  }
}

/// Where the sheet outgrows the room before them: they get other numbers, behind more room.
template <int D>
void Model<D>::move_phantoms(const Sheet& sheet) {
  if (phantoms_.empty() || sheet.deformed_slots() <= first_phantom_) return;
  history_.begin_change();
  for (std::size_t i = 0; i < phantoms_.size(); ++i) clear_vertex(first_phantom_ + i);
  phantoms_.clear();
  if (bending_) {
    copied_bending_.clear();
    bending_->clear_replaced();
    for (const std::int32_t v : bending_->written_rows()) history_.mark(to_size(v));
  }
  first_phantom_ =
      sheet.deformed_slots() + static_cast<std::size_t>(room_for_vertices * to_double(sheet.deformed_slots()));
}

/// \pre history_.begin_change()
template <int D>
void Model<D>::clear_vertex(std::size_t v) {
  blocks_.set_row(v, {});
  mass_[v] = 0;
  for (std::size_t k = 0; k < D; ++k) {
    external_[D * v + k] = 0;
    held_[D * v + k] = 1;
  }
  history_.mark(v);
}

/// Masses of copied elements in place of those of their triangles, where mass is lumped.
template <int D>
void Model<D>::take_masses(const Sheet& sheet, const Constraints& constraints) {
  std::vector<std::pair<DeformedIndex, double>> masses;
  if (physics_.mass != Mass::consistent && !constraints.lumped.empty()) {
    for (const Constraint& constraint : constraints.constraints) masses.emplace_back(constraint.vertex, 0);
    for (const auto& [unknown, area] : constraints.lumped) masses.emplace_back(unknown, material_.density * area);
  }
  std::sort(masses.begin(), masses.end());
  begin_marking();
  for (const DeformedIndex v : own_mass_) {
    const auto at = std::lower_bound(masses.begin(), masses.end(), std::pair(v, 0.0));
    if (at == masses.end() || at->first != v) mark({&v, 1});
  }
  own_mass_.clear();
  refresh_vertices(sheet);
  for (const auto& [v, mass] : masses) {
    if (v() < first_phantom_) own_mass_.push_back(v);
    if (mass_[v()] != mass) set_mass(sheet, v(), mass);
  }
}

template <int D>
void Model<D>::take_copied_bending(const Sheet& sheet, const Constraints& constraints) {
  const bool is_first = copied_bending_.empty();
  bending_->replace(is_first ? copied_bending_.all(sheet, constraints, *bending_)
                             : copied_bending_.next(sheet, constraints, *bending_, bending_->rebuilt()),
                    vertices());
  for (const std::int32_t v : bending_->written_rows()) history_.mark(to_size(v));
}

/// \pre history_.begin_change()
template <int D>
void Model<D>::set_mass(const Sheet& sheet, std::size_t v, double mass) {
  mass_[v] = mass;
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
template void Model<2>::move_phantoms(const Sheet&);
template void Model<3>::move_phantoms(const Sheet&);

}  // namespace cutbench
