#include "harness/fem/model/model.h"

#include <algorithm>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/union_find.h"

namespace cutbench {

template <int D>
Model<D>::Model(const Sheet& sheet, const Material& material, const Physics& physics, std::vector<Pin> pins,
                std::vector<Traction> tractions)
    : material_(material),
      physics_(physics),
      pins_(std::move(pins)),
      tractions_(std::move(tractions)),
      elements_(sheet),
      membrane_(law_of(material, physics), twist()) {
  if (physics.mass == Mass::consistent) consistent_mass_.emplace();
  resize(sheet);
  ++round_;
  for (std::size_t e = 0; e < elements_.size(); ++e)
    if (elements_[e].alive()) incidence_.add(elements_[e], e);
  for (std::size_t v = 0; v < vertices(); ++v) marked_.push_back(v);
  refresh_vertices(sheet);
  if (physics.bending != BendingKind::none)
    bending_.emplace(sheet, physics.bending, material.bending, material.poisson);
  if (bending_ && D == 3 && sheet.unrolled()) {
    curved_.emplace();
    refresh_curved_bending(sheet);
  }
  if (!adds_mass(physics.mass)) return;
  added_mass_.emplace(physics.mass, material.density, physics.mass_limit * element_modes().largest());
  refresh_added_mass();
}

template <int D>
void Model<D>::reserve_spare() {
  elements_.reserve_spare();
  blocks_.reserve_spare();
  incidence_.reserve_spare();
  membrane_.reserve_spare();
  cutbench::reserve_spare(mass_, external_, held_, pin_of_, places_, marked_in_);
  if (consistent_mass_) consistent_mass_->reserve_spare();
  if (bending_) bending_->reserve_spare();
}

template <int D>
void Model<D>::resize(const Sheet& sheet) {
  const std::size_t n = std::max(sheet.deformed_slots(), vertices());  // phantom nodes may leave free slots at the end
  incidence_.resize(n);
  blocks_.resize(n);
  marked_in_.resize(std::max(n, marked_in_.size()));
  if (consistent_mass_) consistent_mass_->resize(n);
  held_.resize(D * n, 1);
  pin_of_.resize(D * n, -1);
  places_.resize(n);
  membrane_.resize(elements_.size());
  mass_.resize(n);
  external_.resize(D * n);
}

template <int D>
ElementModes Model<D>::element_modes() const {
  const Lame lame = lame_of(material_, physics_.plane);
  return {&elements_, view_of(mass_), bending(), 2 * (lame.mu + lame.lambda) / material_.density};
}

/// The part of the mass that is not in the blocks; null: none.
template <int D>
const BlockMatrix<1>* Model<D>::mass_matrix() const {
  return consistent_mass_ ? &*consistent_mass_ : added_mass_ ? &added_mass_->matrix() : nullptr;
}

template <int D>
Field Model<D>::positions(const Sheet& sheet) const {
  Field x = Field::Zero(to_index(D * vertices()));
  for (std::size_t v = 0; v < sheet.deformed_slots(); ++v) {
    const auto p = coordinates(sheet.position(DeformedIndex(v)));
    for (std::size_t k = 0; k < D; ++k) x[to_index(D * v + k)] = p[k];
  }
  for (std::size_t i = 0; i < phantoms_.size(); ++i)
    x.template segment<D>(to_index(D * (first_phantom_ + i))) = x.template segment<D>(D * phantoms_[i].value);
  return x;
}

template <int D>
double Model<D>::held_displacement(std::size_t unknown, double time) const {
  const Pin& pin = pins_[to_size(pin_of_[unknown])];
  return coordinates(pin.displacement)[unknown % D] + held_velocity(unknown) * time;
}

template <int D>
double Model<D>::held_velocity(std::size_t unknown) const {
  return coordinates(pins_[to_size(pin_of_[unknown])].velocity)[unknown % D];
}

template <int D>
std::size_t Model<D>::unheld_pieces() const {
  UnionFind pieces(vertices());
  for (std::size_t v = 0; v < vertices(); ++v)
    for (const auto j : blocks_.columns(v)) pieces.join(v, to_size(j));
  if (is_constrained_) {
    const ConstraintMatrix& matrix = constrained_->constraint_matrix();
    for (const auto v : matrix.constrained())
      for (std::size_t k = 0; k < matrix.row(to_size(v)).size; ++k)
        pieces.join(to_size(v), to_size(matrix.row(to_size(v)).unknown[k]));
  }
  std::vector<std::uint8_t> is_held(vertices());
  for (std::size_t v = 0; v < vertices(); ++v)
    for (std::size_t k = 0; k < D; ++k) is_held[pieces.find(v)] |= held_[D * v + k];
  std::size_t unheld = 0;
  for (std::size_t v = 0; v < vertices(); ++v)
    unheld += pieces.find(v) == v && is_held[v] == 0 && !blocks_.columns(v).empty();
  return unheld;
}

// --- of a state ------------------------------------------------------------------------------------------------------

template <int D>
void Model<D>::rotate(const Field& x, Workers& workers) {
  forget_rotation();
  membrane_.rotate(elements_, x, workers);
  if (curved_) curved_->rotate(x);
}

template <int D>
void Model<D>::rotate_once(const Field& x, Workers& workers) {
  if (std::equal(x.begin(), x.end(), rotated_to_.begin(), rotated_to_.end())) return;
  rotate(x, workers);
  rotated_to_ = x;
}

template <int D>
void Model<D>::forget_rotation() {
  rotated_to_.resize(0);
  elastic_.reset();
}

template <int D>
void Model<D>::add_internal_force(const Field& x, Field& f) const {
  f += membrane_.force();
  if (curved_) curved_->add_force(1, f);
  if (const auto* matrix = bending_matrix()) add_product_per_coordinate(*matrix, D, -1, x, f);
}

template <int D>
void Model<D>::add_impulse(double h, const Field& x, double factor, const Field& v, Field& y, Workers& workers) {
  if (curved_) curved_->add_force(h, y);
  const BlockMatrix<1>* const bending = bending_matrix();
  const bool has_product = factor != 0;
  if (has_product) spread<D>(v, velocity_, workers);
  spread<D>(x, bent_, workers);
  workers.for_ranges(vertices(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {  // K_b (h x) and factor stiffness_factor K_b v at once
      bent_[i] *= h;
      if (has_product) bent_[i] += factor * stiffness_factor_ * velocity_[i];
    }
  });
  workers.for_ranges(vertices(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t ahead = std::min(i + rows_ahead, end - 1);
      if (has_product) blocks_.prefetch_row(ahead);
      if (bending) bending->prefetch_row(ahead);
      Lanes sum{};
      if (has_product) sum = factor * blocks_.row_product(i, velocity_);
      if (bending) sum += bending->row_product(i, bent_);
      for (std::size_t k = 0; k < D; ++k) {
        const auto u = to_index(D * i + k);
        y[u] = (y[u] + h * membrane_.force()[u]) - sum[k];
      }
    }
  });
  if (const auto* mass = mass_matrix(); mass && has_product)
    add_product_per_coordinate(*mass, D, -factor * mass_factor_, v, y);
}

template <int D>
void Model<D>::assemble(double mass_factor, double stiffness_factor, Workers& workers) {
  mass_factor_ = mass_factor;
  stiffness_factor_ = stiffness_factor;
  blocks_.set_zero(workers);
  membrane_.add_stiffness(elements_, stiffness_factor, blocks_, workers);
  if constexpr (D == 3)
    if (curved_) curved_->add_stiffness(stiffness_factor, blocks_);
  if (consistent_mass_) return;
  workers.for_ranges(vertices(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v)
      if (!blocks_.columns(v).empty())
        blocks_.block(blocks_.first_slot(v)).diagonal().array() += mass_factor * mass_[v];
  });
}

template <int D>
SystemMatrix<D> Model<D>::system() const {
  SystemMatrix<D> a;
  a.blocks = &blocks_;
  a.held = &held_;
  a.elements = &elements_;
  a.places = &places_;
  a.pattern = history_.now();
  a.history = &history_;
  if (const auto* matrix = bending_matrix()) a.scalar.push_back({stiffness_factor_, matrix});
  if (const auto* mass = mass_matrix()) a.scalar.push_back({mass_factor_, mass});
  return a;
}

template <int D>
void Model<D>::add_mass_product(double factor, const Field& x, Field& y, Workers& workers) const {
  if (const auto* mass = mass_matrix()) add_product_per_coordinate(*mass, D, factor, x, y, workers);
  if (consistent_mass_) return;
  for (std::size_t v = 0; v < mass_.size(); ++v) {
    const auto at = to_index(D * v);
    y.template segment<D>(at) += factor * mass_[v] * x.template segment<D>(at);
  }
}

template <int D>
Energy Model<D>::energy(const Field& x, const Field& v, Workers& workers) {
  if (!elastic_) {
    elastic_ = Energy{.membrane = membrane_.energy(elements_, workers)};
    if (bending_) elastic_->bending = curved_ ? curved_->energy() : bending_->energy(x, D, workers);
  }
  Energy energy = *elastic_;
  Field momentum = Field::Zero(v.size());
  add_mass_product(1, v, momentum, workers);
  energy.kinetic = v.dot(momentum) / 2;
  energy.potential = -external_force().dot(x);
  return energy;
}

template class Model<2>;
template class Model<3>;

}  // namespace cutbench
