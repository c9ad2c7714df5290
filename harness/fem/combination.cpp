#include "harness/fem/combination.h"

#include <algorithm>
#include <cmath>
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

/// Rows that ties change: of what is tied, of its masters and neighbours, of phantom nodes and ghost penalties.
template <int D>
void TiedSystem<D>::find_near(const SystemMatrix<D>& a) {
  near_.assign(combination_.unknowns(), 0);
  std::fill(near_.begin() + static_cast<std::ptrdiff_t>(combination_.vertices()), near_.end(), 1);
  for (const std::int32_t v : combination_.tied()) {
    const auto row = static_cast<std::size_t>(v);
    near_[row] = 1;
    for (std::size_t k = 0; k < combination_.row(row).size; ++k)
      near_[static_cast<std::size_t>(combination_.row(row).unknown[k])] = 1;
    const auto mark = [&](const auto& part) {
      for (const std::int32_t j : part.columns(row)) near_[static_cast<std::size_t>(j)] = 1;
    };
    mark(*a.blocks);
    for (const auto& term : a.scalar) mark(*term.matrix);
  }
  for (const GhostEdge& ghost : ghosts_)
    for (const DeformedIndex u : ghost.unknown) near_[u()] = 1;
}

/// Calls act(part, i, j, slot, u, v, weight) for what each entry (i, j) of A in the rows above adds to entry (u, v).
template <int D>
template <class Act>
void TiedSystem<D>::for_each_share(const SystemMatrix<D>& a, const Act& act) const {
  const auto visit = [&](std::size_t number, const auto& part) {
    for (std::size_t i = 0; i < a.vertices(); ++i) {
      if (!near_[i]) continue;
      std::int32_t slot = part.first_slot(i);
      const Combination::Row& row = combination_.row(i);
      for (const std::int32_t j : part.columns(i)) {
        const Combination::Row& column = combination_.row(static_cast<std::size_t>(j));
        for (std::size_t k = 0; k < row.size; ++k)
          for (std::size_t l = 0; l < column.size; ++l)
            act(number, i, static_cast<std::size_t>(j), slot, static_cast<std::size_t>(row.unknown[k]),
                column.unknown[l], row.weight[k] * column.weight[l]);
        ++slot;
      }
    }
  };
  visit(0, *a.blocks);
  for (std::size_t k = 0; k < a.scalar.size(); ++k) visit(k + 1, *a.scalar[k].matrix);
}

/// Vertices that are tied on some axes and held on others: C differs by the axis.
template <int D>
bool TiedSystem<D>::is_split(std::size_t vertex) const {
  const auto held = held_vertices_.begin() + static_cast<std::ptrdiff_t>(D * vertex);
  return combination_.is_tied(vertex) && std::find(held, held + D, 1) != held + D;
}

template <int D>
void TiedSystem<D>::set_pattern(const SystemMatrix<D>& a) {
  find_near(a);
  const std::size_t unknowns = combination_.unknowns(), parts = 1 + a.scalar.size();
  blocks_.resize(unknowns), scalars_.assign(a.scalar.size(), {}), shares_.clear(), split_shares_.clear();
  for (auto& scalar : scalars_) scalar.resize(unknowns);
  for (std::size_t u = 0; u < combination_.vertices(); ++u) {
    if (near_[u]) continue;
    blocks_.set_row(u, a.blocks->columns(u));
    for (std::size_t k = 0; k < scalars_.size(); ++k) {
      scalars_[k].set_row(u, a.scalar[k].matrix->columns(u));
      std::int32_t from = a.scalar[k].matrix->first_slot(u), to = scalars_[k].first_slot(u);
      for (std::size_t n = scalars_[k].columns(u).size(); n > 0; --n)
        scalars_[k].block(to++) = a.scalar[k].matrix->block(from++);
    }
  }
  std::vector<std::size_t> place(unknowns);
  std::vector<std::size_t> rows;
  for (std::size_t u = 0; u < unknowns; ++u)
    if (near_[u]) place[u] = rows.size(), rows.push_back(u);
  std::vector<std::vector<std::int32_t>> columns(parts * rows.size());
  const auto part_of = [&](std::size_t part, std::size_t i, std::size_t j) {
    return is_split(i) || is_split(j) ? 0 : part;  // a scalar acts on all axes alike
  };
  for_each_share(a, [&](std::size_t part, std::size_t i, std::size_t j, std::int32_t, std::size_t u, std::int32_t v,
                        double) { columns[part_of(part, i, j) * rows.size() + place[u]].push_back(v); });
  for (const GhostEdge& ghost : ghosts_)
    for (const DeformedIndex u : ghost.unknown)
      for (const DeformedIndex v : ghost.unknown) columns[place[u()]].push_back(v.value);
  for (std::size_t part = 0; part < parts; ++part)
    for (std::size_t r = 0; r < rows.size(); ++r) {
      auto& all = columns[part * rows.size() + r];
      std::sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end()), all.end());
      const auto own = std::find(all.begin(), all.end(), static_cast<std::int32_t>(rows[r]));
      if (own != all.end()) std::rotate(all.begin(), own, own + 1);
      if (part == 0)
        blocks_.set_row(rows[r], all);
      else
        scalars_[part - 1].set_row(rows[r], all);
    }
  for_each_share(a, [&](std::size_t part, std::size_t i, std::size_t j, std::int32_t slot, std::size_t u,
                        std::int32_t v, double weight) {
    if (is_split(i) || is_split(j))
      split_shares_.push_back({{slot, blocks_.find(u, v), weight}, part, i, j});
    else if (part == 0)
      shares_.push_back({slot, blocks_.find(u, v), weight});
    else
      scalars_[part - 1].block(scalars_[part - 1].find(u, v)) += weight * a.scalar[part - 1].matrix->block(slot);
  });
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

template <int D>
void TiedSystem<D>::assemble(const SystemMatrix<D>& a, double stiffness) {
  pattern_ = a.pattern, held_vertices_ = *a.held;
  if (blocks_.rows() == 0) set_pattern(a);
  factors_.clear();
  for (const auto& term : a.scalar) factors_.push_back(term.factor);
  for (std::size_t u = 0; u < combination_.unknowns(); ++u) {
    if (near_[u]) {
      blocks_.set_row_zero(u);
      continue;
    }
    std::int32_t from = a.blocks->first_slot(u), to = blocks_.first_slot(u);
    for (std::size_t n = blocks_.columns(u).size(); n > 0; --n) blocks_.block(to++) = a.blocks->block(from++);
  }
  for (const Share& share : shares_) blocks_.block(share.to) += share.weight * a.blocks->block(share.from);
  for (const SplitShare& split : split_shares_) {
    typename BlockMatrix<D>::Block block;
    if (split.part == 0)
      block = a.blocks->block(split.share.from);
    else
      block = a.scalar[split.part - 1].factor * a.scalar[split.part - 1].matrix->block(split.share.from)(0) *
              BlockMatrix<D>::Block::Identity();
    for (std::size_t k = 0; k < D; ++k) {
      if (held_vertices_[D * split.i + k]) block.row(static_cast<Eigen::Index>(k)).setZero();
      if (held_vertices_[D * split.j + k]) block.col(static_cast<Eigen::Index>(k)).setZero();
    }
    blocks_.block(split.share.to) += split.share.weight * block;
  }
  held_ = held_vertices_;
  held_.resize(D * combination_.unknowns(), 0);
  for (const std::int32_t v : combination_.tied()) std::fill_n(held_.begin() + D * v, D, static_cast<std::uint8_t>(1));
  for (std::size_t u = 0; u < blocks_.rows(); ++u) {
    double scalar = 0;
    for (const auto& matrix : scalars_)
      if (!matrix.columns(u).empty()) scalar += std::abs(matrix.block(matrix.first_slot(u))(0));
    for (std::size_t k = 0; k < D && scalar == 0; ++k) {
      const auto c = static_cast<Eigen::Index>(k);
      if (blocks_.columns(u).empty() || blocks_.block(blocks_.first_slot(u))(c, c) == 0) held_[D * u + k] = 1;
    }
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
  for (std::size_t k = 0; k < scalars_.size(); ++k) a.scalar.push_back({factors_[k], &scalars_[k]});
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
