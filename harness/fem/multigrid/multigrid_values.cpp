// The values of a multigrid hierarchy whose rows are known: its finest level, in floats where they do, the coarse
// matrices, and the factor of the coarsest.
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

#include "harness/base/conversions.h"
#include "harness/fem/multigrid/multigrid.h"

namespace cutbench {

namespace {

constexpr std::size_t most_factored = 200;                     // unknowns of a dense factorisation
constexpr double widest_for_floats = 1e5;                      // largest diagonal block over the median one
constexpr double stiffest_for_floats = 1 << 20;                // diagonal of a free piece over the sum of its entries
constexpr double smallest_pivot_for_floats = 1.0 / (1 << 20);  // of a stiff cluster, over its diagonal
constexpr double largest_for_product = 1000;                   // entry over the median diagonal: 6e-5 of that is lost
constexpr std::size_t most_parts_of_coarse_rows = 8;           // each has working storage of its own
constexpr double same_trace = 0.01;                            // a larger change shows another step or material

/// The inverse of a block, or zero where it is not positive definite.
template <class Block>
Block inverse_of(const Block& block) {
  Block inverse = block.inverse();
  constexpr int last = Block::RowsAtCompileTime - 1;
  const bool positive = block(0, 0) > 0 && block.determinant() > 0 && inverse(last, last) > 0;
  if (!positive || !inverse.allFinite()) inverse.setZero();
  return inverse;
}

template <class S, int D, class From>
BlockColumns<D, S> converted(const From& columns) {
  BlockColumns<D, S> all;
  for (std::size_t c = 0; c < D; ++c) all[c] = __builtin_convertvector(columns[c], Quad<S>);
  return all;
}

}  // namespace

/// The sizes of the diagonal blocks, by what is not held.
template <int D>
void Multigrid<D>::look_at_sizes(const SystemMatrix<D>& a, const Blocks& diagonals) {
  sizes_.assign(a.vertices(), 0);
  sorted_.clear();
  trace_ = median_size_ = 0;
  for (std::size_t i = 0; i < a.vertices(); ++i) {
    if (a.blocks->columns(i).empty()) continue;
    const Block& diagonal = diagonals[i];
    double sum = 0;
    int free = 0;
    for (int c = 0; c < D; ++c)
      if (!(*a.held)[D * i + to_size(c)]) {
        sum += diagonal(c, c);
        ++free;
      }
    if (free == 0) continue;
    sizes_[i] = D * sum / free;
    trace_ += sizes_[i];
    if (std::isfinite(sizes_[i])) sorted_.push_back(sizes_[i]);  // NaN has no place in an order
  }
  if (sorted_.empty()) return;
  const auto middle = sorted_.begin() + to_index(sorted_.size() / 2);
  std::nth_element(sorted_.begin(), middle, sorted_.end());
  median_size_ = *middle;
}

template <int D>
void Multigrid<D>::leave_out_small_pieces(const SystemMatrix<D>& a) {
  small_.factor(a, rows_, *workers_);
  largest_size_ = 0;
  for (std::size_t i = 0; i < sizes_.size(); ++i) {
    if (small_.holds(i)) sizes_[i] = 0;
    if (std::isfinite(sizes_[i])) largest_size_ = std::max(largest_size_, sizes_[i]);
  }
}

/// Whether floats do for the finest level.
template <int D>
void Multigrid<D>::choose_precision(const SystemMatrix<D>& a) {
  if (!changed_.empty() || !(std::abs(trace_ - trace_of_pieces_) <= same_trace * trace_of_pieces_)) {
    trace_of_pieces_ = trace_;
    has_light_piece_ = has_light_piece(a);
  }
  in_doubles_ = median_size_ > 0 && !(largest_size_ < widest_for_floats * median_size_ && largest_size_ < 1e30 &&
                                      median_size_ > 1e-30 && !has_light_piece_);
}

/// Whether the diagonal of a free piece that is not small exceeds the sum of its entries too far. The sum is what the
/// piece weighs: no stiffness resists a translation.
template <int D>
bool Multigrid<D>::has_light_piece(const SystemMatrix<D>& a) {
  const std::size_t n = a.vertices();
  const auto is_light = [](double stiffness, double weight) { return stiffness > stiffest_for_floats * weight; };
  weights_.assign(n, 0);
  bool any = false;
  for (std::size_t i = 0; i < n; ++i) {
    if (small_.holds(i)) continue;
    std::int32_t slot = a.blocks->first_slot(i);
    double sum = 0;
    for (std::size_t k = 0; k < a.blocks->columns(i).size(); ++k) sum += a.blocks->block(slot++).trace();
    std::size_t scalar = rows_.scalars.first_slot(i);
    for (std::size_t k = 0; k < rows_.scalars[i].size(); ++k) sum += D * rows_.scalar[scalar++];
    weights_[i] = sum;
    any |= is_light(sizes_[i], sum);
  }
  if (!any) return false;  // nor is a piece whose vertices are not
  struct Piece {
    double stiffness = 0, weight = 0;
    bool is_held = false;
  };
  std::vector<Piece> pieces(n);
  UnionFind joined(n);
  for (std::size_t i = 0; i < n; ++i)
    for (const std::int32_t j : rows_.blocks.below(i)) joined.join(i, to_size(j));
  for (std::size_t i = 0; i < n; ++i) {
    Piece& piece = pieces[joined.find(i)];
    piece.stiffness += sizes_[i];
    piece.weight += weights_[i];
    piece.is_held |= is_held_altogether(a, i);
  }
  return std::any_of(pieces.begin(), pieces.end(),
                     [&](const Piece& p) { return !p.is_held && is_light(p.stiffness, p.weight); });
}

/// Zero in rows and columns of held coordinates, and where the block is not positive definite.
template <int D>
template <class S>
void Multigrid<D>::set_inverse(Level<S>& level, std::size_t i, Block diagonal, const std::array<bool, D>& is_held) {
  for (int c = 0; c < D; ++c)
    if (is_held[to_size(c)]) {
      diagonal.row(c).setZero();
      diagonal.col(c).setZero();
      diagonal(c, c) = 1;
    }
  Block inverse = inverse_of(diagonal);
  for (std::size_t c = 0; c < D; ++c) {
    const auto k = to_int(c);
    level.is_idle[i][c] = is_held[c] || inverse(k, k) == 0;
    if (level.is_idle[i][c]) inverse(k, k) = 0;
  }
  level.matrix.set_inverse(i, inverse);
}

template <int D>
template <class S>
void Multigrid<D>::list_idle(Level<S>& level) {
  level.idle.clear();
  for (std::size_t i = 0; i < level.is_idle.size(); ++i)
    for (std::size_t c = 0; c < D; ++c)
      if (level.is_idle[i][c]) level.idle.push_back({i, to_int(c)});
}

/// The finest level. Rows and columns of held unknowns need not be zero: the sweeps leave these unknowns at zero.
template <int D>
template <class S>
void Multigrid<D>::fill(const SystemMatrix<D>& a, const Blocks& diagonals, Level<S>& level, bool& is_new) {
  if (is_new) {
    level.matrix.follow(rows_, swept_, order_, true);
    level.resize();
    is_new = false;
  }
  level.is_idle.assign(a.vertices(), {});
  const auto columns_at = [&](std::size_t slot) { return columns_of<D>(a.blocks->block(slots_[slot]).data()); };
  workers_->for_ranges(a.vertices(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      a.blocks->prefetch_row(std::min(i + rows_ahead, end - 1));
      level.matrix.fill_row(i, columns_at);
      if (rows_.blocks[i].empty()) continue;
      std::array<bool, D> is_held{};
      for (std::size_t c = 0; c < D; ++c) is_held[c] = (*a.held)[D * i + c] != 0 || small_.holds(i);
      set_inverse(level, i, diagonals[i] + swept_.left_out(i) * Block::Identity(), is_held);
    }
  });
  list_idle(level);
}

/// Only its factors tell whether floats do for the clusters; those of the last time mostly do, too.
template <int D>
void Multigrid<D>::fill_finest(const SystemMatrix<D>& a, const Blocks& diagonals) {
  const auto is_soft = [&] { return clusters_.smallest_pivot() < smallest_pivot_for_floats; };
  in_doubles_ = in_doubles_ || clusters_need_doubles_;
  if (!in_doubles_) {
    fill(a, diagonals, finest_, float_is_new_);
    clusters_.factor(finest_.matrix, *a.held);
    in_doubles_ = is_soft();
  }
  if (in_doubles_) {
    fill(a, diagonals, finest_in_doubles_, double_is_new_);
    clusters_.factor(finest_in_doubles_.matrix, *a.held);
  }
  clusters_need_doubles_ = is_soft();
  if (!in_doubles_) list_stiff_rows(a);
}

/// Those of small pieces that are not solved, and those that can have an entry over largest_for_product: none exceeds
/// the root of both its diagonal blocks.
template <int D>
void Multigrid<D>::list_stiff_rows(const SystemMatrix<D>& a) {
  stiff_rows_.clear();
  stiff_blocks_.clear();
  const double largest = largest_for_product * median_size_;
  for (std::size_t i = 0; i < sizes_.size(); ++i) {
    if (sizes_[i] * largest_size_ < largest * largest && !(small_.holds(i) && !small_.solves(i))) continue;
    stiff_rows_.push_back({to_int32(i), stiff_blocks_.size()});
    const std::size_t first = rows_.blocks.first_slot(i);
    for (std::size_t k = 0; k < rows_.blocks[i].size(); ++k)
      stiff_blocks_.push_back(a.blocks->block(slots_[first + k]));
  }
}

/// P^T A P, row by row: first that of P^T A, which is the sum of the members' rows, each times its weight; then columns
/// with the same parent become one. `add_row(v, weight, part_row)` adds to that of P^T A; `ask_for(i)` prefetches what
/// a row takes.
template <int D>
template <class S, class AskFor, class AddRow>
void Multigrid<D>::fill_coarse(std::vector<CoarseRow<S>>& rows, CoarseLevel& level, const AskFor& ask_for,
                               const AddRow& add_row) {
  const bool is_first = level.blocks.empty();
  level.blocks.resize(level.rows.blocks.slots());
  if (is_first) cutbench::reserve_spare(level.blocks);
  const std::size_t n = level.from.coarse_size();
  level.is_idle.assign(n, {});
  const auto columns_at = [&](std::size_t slot) { return level.blocks[slot]; };
  const auto compute = [&](CoarseRow<S>& row, std::size_t i) {
    const auto columns = level.rows.blocks[i];
    if (columns.empty()) return;
    for (std::size_t k = 0; k < columns.size(); ++k) row.place[to_size(columns[k])] = to_int32(k);
    row.sums.assign(columns.size(), Columns<S>{});
    row.part_row.clear();
    for (const auto& member : level.from.members(i)) add_row(to_size(member.other), S(member.weight), row.part_row);
    const auto fine_columns = row.part_row.columns();
    const auto part = row.part_row.sums();
    for (std::size_t k = 0; k < part.size(); ++k)
      for (const auto& parent : level.from.parents(to_size(fine_columns[k]))) {
        Columns<S>& sum = row.sums[to_size(row.place[to_size(parent.other)])];
        const S weight(parent.weight);
        for (std::size_t c = 0; c < D; ++c) sum[c] += weight * part[k][c];
      }
    Columns<float>* to = level.blocks.data() + level.rows.blocks.first_slot(i);
    for (const Columns<S>& sum : row.sums) *to++ = converted<float, D>(sum);
    level.matrix.fill_row(i, columns_at);
    const Block diagonal = level.matrix.diagonal(i);
    std::array<bool, D> is_held{};
    for (int c = 0; c < D; ++c) is_held[to_size(c)] = diagonal(c, c) == 0;  // all its members are
    set_inverse(level, i, diagonal, is_held);
  };
  const std::size_t parts = workers_->threads() == 1 ? 1 : most_parts_of_coarse_rows;
  if (rows.size() < parts) rows.resize(parts);
  workers_->run(parts, [&](std::size_t part) {
    CoarseRow<S>& row = rows[part];
    row.place.resize(std::max(row.place.size(), n));
    row.part_row.resize(level.from.fine_size());
    const std::size_t end = n * (part + 1) / parts;
    for (std::size_t i = n * part / parts; i < end; ++i) {
      ask_for(std::min(i + 1, end - 1));
      compute(row, i);
    }
  });
  list_idle(level);
}

/// From A itself. Rows and columns of held unknowns are zero here.
template <int D>
template <class S>
void Multigrid<D>::fill_first_coarse(const SystemMatrix<D>& a, std::vector<CoarseRow<S>>& rows) {
  const auto hold = [&](std::size_t i, std::size_t j, Columns<S>& columns) {
    for (std::size_t c = 0; c < D; ++c)
      for (std::size_t k = 0; k < D; ++k)
        if ((*a.held)[D * i + k] || (*a.held)[D * j + c]) columns[c][k] = 0;
  };
  const auto ask_for = [&](std::size_t i) {
    for (const auto& member : coarse_.front().from.members(i)) a.blocks->prefetch_row(to_size(member.other));
  };
  fill_coarse(rows, coarse_.front(), ask_for, [&](std::size_t v, S weight, RowSum<Columns<S>>& part_row) {
    std::size_t slot = rows_.blocks.first_slot(v);
    for (const std::int32_t j : rows_.blocks[v]) {
      Columns<S> columns = converted<S, D>(columns_of<D>(a.blocks->block(slots_[slot++]).data()));
      if (is_near_held_[v]) hold(v, to_size(j), columns);
      Columns<S>& sum = part_row[j];
      for (std::size_t c = 0; c < D; ++c) sum[c] += weight * columns[c];
    }
  });
}

template <int D>
Eigen::MatrixXd Multigrid<D>::CoarseLevel::dense() const {
  const auto n = to_index(D * rows.size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto at = to_index(D * i);
    std::size_t slot = rows.blocks.first_slot(i), scalar = rows.scalars.first_slot(i);
    for (const std::int32_t j : rows.blocks[i]) {
      for (int c = 0; c < D; ++c)
        for (int k = 0; k < D; ++k) all(at + k, D * j + c) += to_double(blocks[slot][to_size(c)][k]);
      ++slot;
    }
    for (const std::int32_t j : rows.scalars[i]) all.block<D, D>(at, D * j).diagonal().array() += rows.scalar[scalar++];
  }
  return all;
}

template <int D>
void Multigrid<D>::factor_coarsest() {
  solves_coarsest_ = false;
  if (coarse_.empty() || coarse_.back().matrix.size() > most_factored) return;
  Eigen::MatrixXd dense = coarse_.back().dense();
  for (Eigen::Index u = 0; u < dense.rows(); ++u)  // all its members are held
    if (dense(u, u) == 0) dense(u, u) = 1;
  coarsest_.compute(dense);
  solves_coarsest_ = coarsest_.info() == Eigen::Success;
}

template <int D>
void Multigrid<D>::fill_coarse_levels(const SystemMatrix<D>& a) {
  // Every other time the coarse matrices of the last time do: rotations change them little. They leave the trace alone,
  // so another trace shows another step or material.
  coarse_are_old_ =
      changed_.empty() && !coarse_are_old_ && std::abs(trace_ - coarse_trace_) <= same_trace * coarse_trace_;
  if (coarse_are_old_) return;
  coarse_trace_ = trace_;
  if (coarse_.empty()) return factor_coarsest();
  in_doubles_ ? fill_first_coarse(a, coarse_rows_in_doubles_) : fill_first_coarse(a, coarse_rows_);
  for (std::size_t l = 1; l < coarse_.size(); ++l) {
    const CoarseLevel& fine = coarse_[l - 1];
    const auto ask_for = [](std::size_t) {};  // these are small
    fill_coarse(coarse_rows_, coarse_[l], ask_for, [&](std::size_t v, float weight, RowSum<Columns<float>>& part_row) {
      const Columns<float>* block = fine.blocks.data() + fine.rows.blocks.first_slot(v);
      for (const std::int32_t j : fine.rows.blocks[v]) {
        Columns<float>& sum = part_row[j];
        for (std::size_t c = 0; c < D; ++c) sum[c] += weight * (*block)[c];
        ++block;
      }
    });
  }
  factor_coarsest();
}

// What setup() calls; multigrid.cpp instantiates the rest of the class.
template void Multigrid<2>::look_at_sizes(const SystemMatrix<2>&, const Blocks&);
template void Multigrid<2>::leave_out_small_pieces(const SystemMatrix<2>&);
template void Multigrid<2>::choose_precision(const SystemMatrix<2>&);
template void Multigrid<2>::fill_finest(const SystemMatrix<2>&, const Blocks&);
template void Multigrid<2>::fill_coarse_levels(const SystemMatrix<2>&);
template void Multigrid<3>::look_at_sizes(const SystemMatrix<3>&, const Blocks&);
template void Multigrid<3>::leave_out_small_pieces(const SystemMatrix<3>&);
template void Multigrid<3>::choose_precision(const SystemMatrix<3>&);
template void Multigrid<3>::fill_finest(const SystemMatrix<3>&, const Blocks&);
template void Multigrid<3>::fill_coarse_levels(const SystemMatrix<3>&);

}  // namespace cutbench
