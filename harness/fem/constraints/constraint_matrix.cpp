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

/// Rows that constraints change: of what is constrained, of its masters and neighbours, of phantom nodes and ghost
/// penalties.
template <int D>
void ConstrainedSystem<D>::find_near(const SystemMatrix<D>& a) {
  for (const std::size_t u : near_rows_) near_[u] = 0;
  near_rows_.clear();
  near_.resize(constraint_matrix_.unknowns());
  const auto mark = [&](std::size_t u) {
    if (!std::exchange(near_[u], 1)) near_rows_.push_back(u);
  };
  const auto mark_all = [&](std::span<const std::int32_t> rows) {
    for (const std::int32_t u : rows) mark(to_size(u));
  };
  for (std::size_t u = constraint_matrix_.vertices(); u < constraint_matrix_.unknowns(); ++u) mark(u);
  for (const std::int32_t v : constraint_matrix_.constrained()) {
    const ConstraintMatrix::Row& row = constraint_matrix_.row(to_size(v));
    mark(to_size(v));
    mark_all(row.unknowns());
    mark_all(a.blocks->columns(to_size(v)));
    for (const auto& term : a.scalar) mark_all(term.matrix->columns(to_size(v)));
  }
  for (const GhostEdge& ghost : ghosts_)
    for (const DeformedIndex u : ghost.unknown) mark(u());
  std::sort(near_rows_.begin(), near_rows_.end());
}

/// The rows that a changed row of A or C is a part of; all rows, where it is not known which have changed.
template <int D>
void ConstrainedSystem<D>::find_changed(const SystemMatrix<D>& a) {
  const std::size_t unknowns = constraint_matrix_.unknowns();
  for (const std::size_t u : changed_rows_) is_changed_row_[u] = 0;
  changed_rows_.clear();
  is_changed_row_.resize(unknowns);
  const auto mark = [&](std::span<const std::int32_t> rows) {
    for (const std::int32_t u : rows)
      if (!std::exchange(is_changed_row_[to_size(u)], 1)) changed_rows_.push_back(to_size(u));
  };
  const auto left_by_ghosts = std::exchange(left_by_ghosts_, {});
  const auto changed = std::exchange(changed_, {});
  const bool is_known =
      pattern_ > 0 && a.history && a.history->holds(pattern_) && unknowns == constraint_matrix_.vertices();
  if (!is_known) {
    blocks_ = {};
    scalars_.assign(a.scalar.size(), {});
    shares_ = {};
    split_shares_.clear();
    for (std::size_t u = 0; u < unknowns; ++u) {
      const std::int32_t row = to_int32(u);
      mark({&row, 1});
    }
    return;
  }
  const auto mark_near = [&](std::size_t i) {
    mark(constraint_matrix_.row(i).unknowns());
    for (const std::int32_t j : a.blocks->columns(i)) mark(constraint_matrix_.row(to_size(j)).unknowns());
    for (const auto& term : a.scalar)
      for (const std::int32_t j : term.matrix->columns(i)) mark(constraint_matrix_.row(to_size(j)).unknowns());
  };
  for (const auto& [vertex, before] : changed) {
    const std::int32_t own = to_int32(vertex);
    mark({&own, 1});
    mark(before.unknowns());
    mark_near(vertex);
  }
  mark(left_by_ghosts);
  for (const GhostEdge& ghost : ghosts_)
    for (const DeformedIndex u : ghost.unknown) mark({&u.value, 1});
  for (const std::int32_t i : a.history->changed_since(pattern_)) {
    mark({&i, 1});
    mark_near(to_size(i));
  }
  std::sort(changed_rows_.begin(), changed_rows_.end());
}

/// The rows of A that add to a changed row near constraints.
template <int D>
void ConstrainedSystem<D>::find_sources(const SystemMatrix<D>& a) {
  sources_.clear();
  for (const std::size_t i : near_rows_) {
    if (i >= a.vertices()) break;
    const auto unknowns = constraint_matrix_.row(i).unknowns();
    if (std::any_of(unknowns.begin(), unknowns.end(), [&](std::int32_t u) { return is_changed_row_[to_size(u)] != 0; }))
      sources_.push_back(i);
  }
}

/// Calls act(part, j, slot, u, v, weight) for what each entry (i, j) of A adds to entry (u, v).
template <int D>
template <class Act>
void ConstrainedSystem<D>::for_each_share(const SystemMatrix<D>& a, std::size_t i, const Act& act) const {
  const auto visit = [&](std::size_t number, const auto& part) {
    std::int32_t slot = part.first_slot(i);
    const ConstraintMatrix::Row& row = constraint_matrix_.row(i);
    for (const std::int32_t j : part.columns(i)) {
      const ConstraintMatrix::Row& column = constraint_matrix_.row(to_size(j));
      for (std::size_t k = 0; k < row.size; ++k)
        for (std::size_t l = 0; l < column.size; ++l)
          act(number, to_size(j), slot, to_size(row.unknown[k]), column.unknown[l], row.weight[k] * column.weight[l]);
      ++slot;
    }
  };
  visit(0, *a.blocks);
  for (std::size_t k = 0; k < a.scalar.size(); ++k) visit(k + 1, *a.scalar[k].matrix);
}

/// Vertices that are constrained on some axes and held on others: C differs by the axis.
template <int D>
bool ConstrainedSystem<D>::is_split(std::size_t vertex) const {
  const auto held = held_vertices_.begin() + to_index(D * vertex);
  return constraint_matrix_.is_constrained(vertex) && std::find(held, held + D, 1) != held + D;
}

/// Those that have changed and are those of A.
template <int D>
void ConstrainedSystem<D>::copy_rows(const SystemMatrix<D>& a) {
  for (const std::size_t u : changed_rows_) {
    if (near_[u]) continue;
    blocks_.set_row(u, a.blocks->columns(u));
    for (std::size_t k = 0; k < scalars_.size(); ++k) {
      scalars_[k].set_row(u, a.scalar[k].matrix->columns(u));
      std::int32_t from = a.scalar[k].matrix->first_slot(u), to = scalars_[k].first_slot(u);
      for (std::size_t n = scalars_[k].columns(u).size(); n > 0; --n)
        scalars_[k].block(to++) = a.scalar[k].matrix->block(from++);
    }
  }
}

template <int D>
void ConstrainedSystem<D>::set_near_rows(const SystemMatrix<D>& a) {
  std::vector<std::size_t> rows;  // near constraints, and changed
  std::set_intersection(changed_rows_.begin(), changed_rows_.end(), near_rows_.begin(), near_rows_.end(),
                        std::back_inserter(rows));
  const std::size_t parts = 1 + a.scalar.size();
  const auto place = [&](std::size_t u) {
    return to_size(std::lower_bound(rows.begin(), rows.end(), u) - rows.begin());
  };
  std::vector<std::vector<std::int32_t>> columns(parts * rows.size());
  for (const std::size_t i : sources_)
    for_each_share(a, i, [&](std::size_t part, std::size_t j, std::int32_t, std::size_t u, std::int32_t v, double) {
      if (!is_changed_row_[u]) return;
      const bool split = is_split(i) || is_split(j);  // a scalar acts on all axes alike
      columns[(split ? 0 : part) * rows.size() + place(u)].push_back(v);
    });
  for (const GhostEdge& ghost : ghosts_)
    for (const DeformedIndex u : ghost.unknown)
      for (const DeformedIndex v : ghost.unknown) columns[place(u())].push_back(v.value);
  for (std::size_t part = 0; part < parts; ++part)
    for (std::size_t r = 0; r < rows.size(); ++r) {
      auto& all = columns[part * rows.size() + r];
      std::sort(all.begin(), all.end());
      all.erase(std::unique(all.begin(), all.end()), all.end());
      const auto own = std::find(all.begin(), all.end(), to_int32(rows[r]));
      if (own != all.end()) std::rotate(all.begin(), own, own + 1);
      if (part == 0)
        blocks_.set_row(rows[r], all);
      else
        scalars_[part - 1].set_row(rows[r], all);
    }
}

template <int D>
void ConstrainedSystem<D>::set_shares(const SystemMatrix<D>& a) {
  shares_.resize(constraint_matrix_.vertices());
  std::erase_if(split_shares_, [&](const SplitShare& split) {
    return !near_[split.i] || std::binary_search(sources_.begin(), sources_.end(), split.i);
  });
  std::vector<Share> shares;
  for (const std::size_t i : sources_) {
    shares.clear();
    for_each_share(
        a, i, [&](std::size_t part, std::size_t j, std::int32_t slot, std::size_t u, std::int32_t v, double weight) {
          if (is_split(i) || is_split(j))
            split_shares_.push_back({{slot, blocks_.find(u, v), weight}, part, i, j});
          else if (part == 0)
            shares.push_back({slot, blocks_.find(u, v), weight});
          else if (is_changed_row_[u])
            scalars_[part - 1].block(scalars_[part - 1].find(u, v)) += weight * a.scalar[part - 1].matrix->block(slot);
        });
    shares_.set(i, shares);
  }
  std::stable_sort(split_shares_.begin(), split_shares_.end(),
                   [](const SplitShare& x, const SplitShare& y) { return x.i < y.i; });
}

template <int D>
void ConstrainedSystem<D>::follow(const SystemMatrix<D>& a) {
  find_changed(a);
  find_near(a);
  find_sources(a);
  blocks_.resize(constraint_matrix_.unknowns());
  for (auto& scalar : scalars_) scalar.resize(constraint_matrix_.unknowns());
  copy_rows(a);
  set_near_rows(a);
  set_shares(a);
  find_places(a);
  history_.begin_change();
  for (const std::size_t u : changed_rows_) history_.mark(u);
  pattern_ = a.pattern;
  is_changed_ = false;
}

template <int D>
void ConstrainedSystem<D>::find_places(const SystemMatrix<D>& a) {
  places_.resize(a.places ? constraint_matrix_.unknowns() : 0);
  if (!a.places) return;
  const std::size_t first = constraint_matrix_.vertices();
  for (const std::size_t u : changed_rows_)
    if (u < first) places_[u] = (*a.places)[u];
  std::fill(places_.begin() + to_index(first), places_.end(), Point2{});
  std::vector<double> dependents(constraint_matrix_.unknowns() - first);
  for (const std::int32_t v : constraint_matrix_.constrained()) {
    const auto& row = constraint_matrix_.row(to_size(v));
    for (std::size_t k = 0; k < row.size; ++k)
      if (const auto u = to_size(row.unknown[k]); constraint_matrix_.is_phantom(row.unknown[k])) {
        places_[u] = places_[u] + (*a.places)[to_size(v)];
        ++dependents[u - first];
      }
  }
  for (std::size_t u = first; u < places_.size(); ++u) places_[u] = 1 / dependents[u - first] * places_[u];
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
