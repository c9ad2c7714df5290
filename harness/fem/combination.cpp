#include "harness/fem/combination.h"

#include <algorithm>
#include <utility>

#include "harness/fem/linear_solver.h"

namespace cutbench {

Combination::Combination(const Ties& ties, std::size_t vertices) : rows_(vertices), phantoms_(ties.phantoms) {
  for (std::size_t i = 0; i < vertices; ++i) rows_[i] = {{static_cast<std::int32_t>(i)}, {1}, 1};
  for (const Tie& tie : ties.ties) {
    Row& row = rows_[tie.vertex()];
    row.size = 0;
    for (std::size_t k = 0; k < 3; ++k)
      if (tie.weights[k] != 0) row.unknown[row.size] = tie.masters[k].value, row.weight[row.size++] = tie.weights[k];
    tied_.push_back(tie.vertex.value);
  }
  std::sort(tied_.begin(), tied_.end());
}

void Combination::expand(int dimension, const Field& q, Field& x) const {
  x.setZero(static_cast<Eigen::Index>(vertices()) * dimension);
  for (std::size_t i = 0; i < vertices(); ++i)
    for (std::size_t k = 0; k < rows_[i].size; ++k)
      x.segment(static_cast<Eigen::Index>(i) * dimension, dimension) +=
          rows_[i].weight[k] * q.segment(rows_[i].unknown[k] * dimension, dimension);
}

void Combination::reduce(int dimension, const Field& f, Field& r) const {
  r.setZero(static_cast<Eigen::Index>(unknowns()) * dimension);
  for (std::size_t i = 0; i < vertices(); ++i)
    for (std::size_t k = 0; k < rows_[i].size; ++k)
      r.segment(rows_[i].unknown[k] * dimension, dimension) +=
          rows_[i].weight[k] * f.segment(static_cast<Eigen::Index>(i) * dimension, dimension);
}

template <int D>
void TiedSystem<D>::set_pattern(const SystemMatrix<D>& a) {
  std::vector<std::vector<std::int32_t>> columns(combination_.unknowns());
  const auto collect = [&](const auto& part) {
    for (std::size_t i = 0; i < part.rows(); ++i)
      for (const std::int32_t j : part.columns(i)) {
        const auto &row = combination_.row(i), &column = combination_.row(static_cast<std::size_t>(j));
        for (std::size_t k = 0; k < row.size; ++k)
          for (std::size_t l = 0; l < column.size; ++l)
            columns[static_cast<std::size_t>(row.unknown[k])].push_back(column.unknown[l]);
      }
  };
  collect(*a.blocks);
  for (const auto& term : a.scalar) collect(*term.matrix);
  for (const GhostEdge& ghost : ghosts_)
    for (const DeformedIndex u : ghost.unknown)
      for (const DeformedIndex v : ghost.unknown) columns[u()].push_back(v.value);
  blocks_.resize(columns.size());
  for (std::size_t u = 0; u < columns.size(); ++u) {
    auto& all = columns[u];
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    const auto own = std::find(all.begin(), all.end(), static_cast<std::int32_t>(u));
    if (own != all.end()) std::rotate(all.begin(), own, own + 1);
    blocks_.set_row(u, all);
  }
  find_places(a);
}

template <int D>
void TiedSystem<D>::find_places(const SystemMatrix<D>& a) {
  places_.clear();
  if (!a.places) return;
  places_ = *a.places;
  places_.resize(combination_.unknowns());
  std::vector<double> dependents(places_.size(), 0);
  for (const std::int32_t v : combination_.tied()) {
    const auto& row = combination_.row(static_cast<std::size_t>(v));
    for (std::size_t k = 0; k < row.size; ++k)
      if (const auto u = static_cast<std::size_t>(row.unknown[k]); combination_.is_phantom(row.unknown[k]))
        places_[u] = places_[u] + (*a.places)[static_cast<std::size_t>(v)], ++dependents[u];
  }
  for (std::size_t u = combination_.vertices(); u < places_.size(); ++u) places_[u] = 1 / dependents[u] * places_[u];
}

/// Block (i, j) of A, to where its vertices' unknowns meet.
template <int D>
void TiedSystem<D>::add(std::size_t i, std::size_t j, typename BlockMatrix<D>::Block block) {
  for (std::size_t k = 0; k < D; ++k) {
    if (held_vertices_[D * i + k]) block.row(static_cast<Eigen::Index>(k)).setZero();
    if (held_vertices_[D * j + k]) block.col(static_cast<Eigen::Index>(k)).setZero();
  }
  const auto &row = combination_.row(i), &column = combination_.row(j);
  for (std::size_t k = 0; k < row.size; ++k)
    for (std::size_t l = 0; l < column.size; ++l)
      blocks_.block(blocks_.find(static_cast<std::size_t>(row.unknown[k]), column.unknown[l])) +=
          row.weight[k] * column.weight[l] * block;
}

template <int D>
void TiedSystem<D>::assemble(const SystemMatrix<D>& a, double stiffness) {
  if (blocks_.rows() == 0) set_pattern(a);
  blocks_.set_zero();
  pattern_ = a.pattern, held_vertices_ = *a.held;
  using Block = typename BlockMatrix<D>::Block;
  for (std::size_t i = 0; i < a.vertices(); ++i) {
    std::int32_t slot = a.blocks->first_slot(i);
    for (const std::int32_t j : a.blocks->columns(i)) add(i, static_cast<std::size_t>(j), a.blocks->block(slot++));
    for (const auto& term : a.scalar) {
      slot = term.matrix->first_slot(i);
      for (const std::int32_t j : term.matrix->columns(i))
        add(i, static_cast<std::size_t>(j), term.factor * term.matrix->block(slot++)(0) * Block::Identity());
    }
  }
  held_ = held_vertices_;
  held_.resize(D * combination_.unknowns(), 0);
  for (const std::int32_t v : combination_.tied()) std::fill_n(held_.begin() + D * v, D, static_cast<std::uint8_t>(1));
  for (std::size_t u = 0; u < blocks_.rows(); ++u)
    for (std::size_t k = 0; k < D; ++k) {
      const auto c = static_cast<Eigen::Index>(k);
      if (blocks_.columns(u).empty() || blocks_.block(blocks_.first_slot(u))(c, c) == 0) held_[D * u + k] = 1;
    }
  ghost_stiffness_ = stiffness;
  for (const GhostEdge& ghost : ghosts_)
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t l = 0; l < 4; ++l)
        for (std::size_t axis = 0; axis < D; ++axis)
          if (const auto c = static_cast<Eigen::Index>(axis); acts(ghost, axis))
            blocks_.block(blocks_.find(ghost.unknown[k](), ghost.unknown[l].value))(c, c) +=
                stiffness * ghost.stiffness * ghost.jump[k] * ghost.jump[l];
}

template <int D>
SystemMatrix<D> TiedSystem<D>::system() const {
  SystemMatrix<D> a;
  a.blocks = &blocks_, a.held = &held_, a.pattern = pattern_;
  if (!places_.empty()) a.places = &places_;
  return a;
}

template <int D>
void TiedSystem<D>::reduce(const std::vector<std::uint8_t>& held, const Field& f, Field& r) const {
  Field free;
  project(held, f, free);
  combination_.reduce(D, free, r);
  for (std::size_t u = 0; u < held.size(); ++u)
    if (held[u]) r[static_cast<Eigen::Index>(u)] = 0;
}

/// Not where it would be alone in saying where a phantom is.
template <int D>
bool TiedSystem<D>::acts(const GhostEdge& ghost, std::size_t axis) const {
  return std::none_of(ghost.unknown.begin(), ghost.unknown.end(),
                      [&](DeformedIndex u) { return combination_.is_phantom(u.value) && held_[D * u() + axis]; });
}

template <int D>
void TiedSystem<D>::subtract_ghosts(const Field& given, Field& r) const {
  const auto vertices = combination_.vertices();
  for (const GhostEdge& ghost : ghosts_)
    for (std::size_t k = 0; k < 4; ++k)
      for (std::size_t l = 0; l < 4; ++l)
        for (std::size_t axis = 0; axis < D; ++axis) {
          const std::size_t from = D * ghost.unknown[l]() + axis, to = D * ghost.unknown[k]() + axis;
          if (ghost.unknown[l]() >= vertices || !held_vertices_[from] || held_[to] || !acts(ghost, axis)) continue;
          r[static_cast<Eigen::Index>(to)] -= ghost_stiffness_ * ghost.stiffness * ghost.jump[k] * ghost.jump[l] *
                                              given[static_cast<Eigen::Index>(from)];
        }
}

template <int D>
void TiedSystem<D>::expand(const Field& q, Field& x) const {
  combination_.expand(D, q, x);
  for (std::size_t u = 0; u < held_vertices_.size(); ++u)
    if (held_vertices_[u]) x[static_cast<Eigen::Index>(u)] = 0;
}

template <int D>
void TiedSystem<D>::extrapolate(std::int32_t tied, const std::vector<std::uint8_t>& held, Field& x) const {
  const auto& row = combination_.row(static_cast<std::size_t>(tied));
  for (std::int32_t k = 0; k < D; ++k) {
    if (held[static_cast<std::size_t>(D * tied + k)]) continue;
    double sum = 0;
    for (std::size_t l = 0; l < row.size; ++l)
      if (!combination_.is_phantom(row.unknown[l])) sum += row.weight[l] * x[D * row.unknown[l] + k];
    x[D * tied + k] = sum;
  }
}

template <int D>
void TiedSystem<D>::extrapolate(const std::vector<std::uint8_t>& held, Field& x) const {
  for (const std::int32_t v : combination_.tied()) extrapolate(v, held, x);
}

template <int D>
void TiedSystem<D>::transfer_forces(const std::vector<std::uint8_t>& held, Field& f) const {
  for (const std::int32_t v : combination_.tied()) {
    const auto& row = combination_.row(static_cast<std::size_t>(v));
    for (std::int32_t k = 0; k < D; ++k) {
      if (held[static_cast<std::size_t>(D * v + k)]) continue;
      const double force = std::exchange(f[D * v + k], 0);
      for (std::size_t l = 0; l < row.size; ++l)
        if (!combination_.is_phantom(row.unknown[l])) f[D * row.unknown[l] + k] += row.weight[l] * force;
    }
  }
}

template <int D>
void TiedSystem<D>::satisfy(const std::vector<std::uint8_t>& held, Field& x) const {
  for (const std::int32_t v : combination_.tied()) {
    const auto& row = combination_.row(static_cast<std::size_t>(v));
    const auto end = row.unknown.begin() + static_cast<std::ptrdiff_t>(row.size);
    if (std::none_of(row.unknown.begin(), end, [&](std::int32_t u) { return combination_.is_phantom(u); }))
      extrapolate(v, held, x);
  }
}

template class TiedSystem<2>;
template class TiedSystem<3>;

}  // namespace cutbench
