// The system of constrained vertices after a change: which rows of C^T A C follow, and which blocks of A they are of.
#include <algorithm>
#include <iterator>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/fem/constraints/constraint_matrix.h"

namespace cutbench {

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

template void ConstrainedSystem<2>::follow(const SystemMatrix<2>&);
template void ConstrainedSystem<3>::follow(const SystemMatrix<3>&);

}  // namespace cutbench
