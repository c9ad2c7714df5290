#include "harness/fem/constraints/constraint_matrix.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/base/conversions.h"

namespace cutbench {

std::vector<ConstraintMatrix::Changed> ConstraintMatrix::set(const std::vector<Constraint>& constraints,
                                                             std::size_t vertices, std::size_t phantoms) {
  const auto own = [](std::size_t i) { return Row{{to_int32(i)}, {1}, 1}; };
  std::vector<Changed> changed;
  const auto put = [&](std::size_t i, const Row& row) {
    if (rows_[i] == row) return;
    changed.push_back({i, rows_[i]});
    rows_[i] = row;
  };
  for (std::size_t i = rows_.size(); i < vertices; ++i) rows_.push_back(own(i));
  phantoms_ = phantoms;
  std::vector<std::int32_t> now;
  for (const Constraint& constraint : constraints) {
    Row row{};
    for (std::size_t k = 0; k < 3; ++k)
      if (constraint.weights[k] != 0) {
        row.unknown[row.size] = constraint.masters[k].value;
        row.weight[row.size++] = constraint.weights[k];
      }
    put(constraint.vertex(), row);
    now.push_back(constraint.vertex.value);
  }
  std::sort(now.begin(), now.end());
  constrained_.swap(now);
  for (const std::int32_t v : now)
    if (!is_constrained(to_size(v))) put(to_size(v), own(to_size(v)));
  return changed;
}

void ConstraintMatrix::expand(int dimension, const Field& q, Field& x) const {
  x.setZero(to_index(vertices()) * dimension);
  for (std::size_t i = 0; i < vertices(); ++i)
    for (std::size_t k = 0; k < rows_[i].size; ++k)
      x.segment(to_index(i) * dimension, dimension) +=
          rows_[i].weight[k] * q.segment(rows_[i].unknown[k] * dimension, dimension);
}

void ConstraintMatrix::reduce(int dimension, const Field& f, Field& r) const {
  r.setZero(to_index(unknowns()) * dimension);
  for (std::size_t i = 0; i < vertices(); ++i)
    for (std::size_t k = 0; k < rows_[i].size; ++k)
      r.segment(rows_[i].unknown[k] * dimension, dimension) +=
          rows_[i].weight[k] * f.segment(to_index(i) * dimension, dimension);
}

template <int D>
void ConstrainedSystem<D>::change(const Constraints& constraints, std::size_t vertices, std::size_t phantoms) {
  const auto changed = constraint_matrix_.set(constraints.constraints, vertices, phantoms);
  changed_.insert(changed_.end(), changed.begin(), changed.end());
  for (const GhostEdge& ghost : ghosts_)
    for (const DeformedIndex u : ghost.unknown) left_by_ghosts_.push_back(u.value);
  ghosts_ = constraints.ghosts;
  is_changed_ = true;
}

template <int D>
void ConstrainedSystem<D>::assemble(const SystemMatrix<D>& a, double stiffness) {
  held_vertices_ = *a.held;
  if (is_changed_) follow(a);
  factors_.clear();
  for (const auto& term : a.scalar) factors_.push_back(term.factor);
  for (std::size_t u = 0; u < constraint_matrix_.unknowns(); ++u) {
    if (near_[u]) {
      blocks_.set_row_zero(u);
      continue;
    }
    std::int32_t from = a.blocks->first_slot(u), to = blocks_.first_slot(u);
    for (std::size_t n = blocks_.columns(u).size(); n > 0; --n) blocks_.block(to++) = a.blocks->block(from++);
  }
  for (const std::size_t i : near_rows_) {
    if (i >= a.vertices()) break;
    for (const Share& share : shares_[i]) blocks_.block(share.to) += share.weight * a.blocks->block(share.from);
  }
  for (const SplitShare& split : split_shares_) {
    typename BlockMatrix<D>::Block block;
    if (split.part == 0)
      block = a.blocks->block(split.share.from);
    else
      block = a.scalar[split.part - 1].factor * a.scalar[split.part - 1].matrix->block(split.share.from)(0) *
              BlockMatrix<D>::Block::Identity();
    for (std::size_t k = 0; k < D; ++k) {
      if (held_vertices_[D * split.i + k]) block.row(to_index(k)).setZero();
      if (held_vertices_[D * split.j + k]) block.col(to_index(k)).setZero();
    }
    blocks_.block(split.share.to) += split.share.weight * block;
  }
  held_ = held_vertices_;
  held_.resize(D * constraint_matrix_.unknowns(), 0);
  for (const std::int32_t v : constraint_matrix_.constrained())
    std::fill_n(held_.begin() + D * v, D, static_cast<std::uint8_t>(1));
  for (std::size_t u = 0; u < blocks_.rows(); ++u) {
    double scalar = 0;
    for (const auto& matrix : scalars_)
      if (!matrix.columns(u).empty()) scalar += std::abs(matrix.block(matrix.first_slot(u))(0));
    for (std::size_t k = 0; k < D && scalar == 0; ++k) {
      const auto c = to_index(k);
      if (blocks_.columns(u).empty() || blocks_.block(blocks_.first_slot(u))(c, c) == 0) held_[D * u + k] = 1;
    }
  }
  ghost_stiffness_ = stiffness;
  for (const GhostEdge& ghost : ghosts_)
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t l = 0; l < 4; ++l)
        for (std::size_t axis = 0; axis < D; ++axis)
          if (const auto c = to_index(axis); acts(ghost, axis))
            blocks_.block(blocks_.find(ghost.unknown[k](), ghost.unknown[l].value))(c, c) +=
                stiffness * ghost.stiffness * ghost.jump[k] * ghost.jump[l];
}

template <int D>
SystemMatrix<D> ConstrainedSystem<D>::system() const {
  SystemMatrix<D> a;
  a.blocks = &blocks_;
  a.held = &held_;
  a.pattern = history_.now();
  a.history = &history_;
  for (std::size_t k = 0; k < scalars_.size(); ++k) a.scalar.push_back({factors_[k], &scalars_[k]});
  if (!places_.empty()) a.places = &places_;
  return a;
}

template <int D>
void ConstrainedSystem<D>::reduce(const std::vector<std::uint8_t>& held, const Field& f, Field& r) const {
  Field free;
  project(held, f, free);
  constraint_matrix_.reduce(D, free, r);
  for (std::size_t u = 0; u < held.size(); ++u)
    if (held[u]) r[to_index(u)] = 0;
}

/// Not where it would be alone in saying where a phantom is.
template <int D>
bool ConstrainedSystem<D>::acts(const GhostEdge& ghost, std::size_t axis) const {
  return std::none_of(ghost.unknown.begin(), ghost.unknown.end(),
                      [&](DeformedIndex u) { return constraint_matrix_.is_phantom(u.value) && held_[D * u() + axis]; });
}

template <int D>
void ConstrainedSystem<D>::subtract_ghosts(const Field& given, Field& r) const {
  const auto vertices = constraint_matrix_.vertices();
  for (const GhostEdge& ghost : ghosts_)
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t l = 0; l < 4; ++l)
        for (std::size_t axis = 0; axis < D; ++axis) {
          const std::size_t from = D * ghost.unknown[l]() + axis, to = D * ghost.unknown[k]() + axis;
          if (ghost.unknown[l]() >= vertices || !held_vertices_[from] || held_[to] || !acts(ghost, axis)) continue;
          r[to_index(to)] -= ghost_stiffness_ * ghost.stiffness * ghost.jump[k] * ghost.jump[l] * given[to_index(from)];
        }
}

template <int D>
void ConstrainedSystem<D>::expand(const Field& q, Field& x) const {
  constraint_matrix_.expand(D, q, x);
  for (std::size_t u = 0; u < held_vertices_.size(); ++u)
    if (held_vertices_[u]) x[to_index(u)] = 0;
}

template <int D>
void ConstrainedSystem<D>::extrapolate(std::int32_t constrained, const std::vector<std::uint8_t>& held,
                                       Field& x) const {
  const auto& row = constraint_matrix_.row(to_size(constrained));
  for (std::int32_t k = 0; k < D; ++k) {
    if (held[to_size(D * constrained + k)]) continue;
    double sum = 0;
    for (std::size_t l = 0; l < row.size; ++l)
      if (!constraint_matrix_.is_phantom(row.unknown[l])) sum += row.weight[l] * x[D * row.unknown[l] + k];
    x[D * constrained + k] = sum;
  }
}

template <int D>
void ConstrainedSystem<D>::extrapolate(const std::vector<std::uint8_t>& held, Field& x) const {
  for (const std::int32_t v : constraint_matrix_.constrained()) extrapolate(v, held, x);
}

template <int D>
void ConstrainedSystem<D>::transfer_forces(const std::vector<std::uint8_t>& held, Field& f) const {
  for (const std::int32_t v : constraint_matrix_.constrained()) {
    const auto& row = constraint_matrix_.row(to_size(v));
    for (std::int32_t k = 0; k < D; ++k) {
      if (held[to_size(D * v + k)]) continue;
      const double force = std::exchange(f[D * v + k], 0);
      for (std::size_t l = 0; l < row.size; ++l)
        if (!constraint_matrix_.is_phantom(row.unknown[l])) f[D * row.unknown[l] + k] += row.weight[l] * force;
    }
  }
}

template <int D>
void ConstrainedSystem<D>::satisfy(const std::vector<std::uint8_t>& held, Field& x) const {
  for (const std::int32_t v : constraint_matrix_.constrained()) {
    const auto& row = constraint_matrix_.row(to_size(v));
    const auto end = row.unknown.begin() + to_index(row.size);
    if (std::none_of(row.unknown.begin(), end, [&](std::int32_t u) { return constraint_matrix_.is_phantom(u); }))
      extrapolate(v, held, x);
  }
}

template class ConstrainedSystem<2>;
template class ConstrainedSystem<3>;

}  // namespace cutbench
