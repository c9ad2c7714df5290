#include "harness/fem/multigrid.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace cutbench {

namespace {

constexpr double strong = 0.5;       // share of a vertex's stiffness; 1/4 in a square grid, 1/6 in a regular one
constexpr double first_spacing = 2;  // of the lattice, in median edges
constexpr std::size_t fewest_coarsened = 40;  // unknowns that are not coarsened any further
constexpr std::size_t most_factored = 200;    // unknowns of a dense factorisation
constexpr double widest_for_floats = 1e5;     // largest diagonal block over the median one

double median_edge(const SparseRows& links, const std::vector<Point2>& places) {
  std::vector<double> lengths;
  for (std::size_t i = 0; i < links.size(); ++i)
    for (const std::int32_t j : links[i])
      if (static_cast<std::size_t>(j) > i)
        if (const double l = length(places[static_cast<std::size_t>(j)] - places[i]); l > 0 && std::isfinite(l))
          lengths.push_back(l);
  if (lengths.empty()) return 0;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

/// The inverse of a block, or zero where it is not positive definite.
template <class Block>
Block inverse_of(const Block& block) {
  Block inverse = block.inverse();
  constexpr int last = Block::RowsAtCompileTime - 1;
  const bool positive = block(0, 0) > 0 && block.determinant() > 0 && inverse(last, last) > 0;
  if (!positive || !inverse.allFinite()) inverse.setZero();
  return inverse;
}

}  // namespace

// --- pattern ---------------------------------------------------------------------------------------------------------

/// The rows of A; the scalar matrices in one, each with its factor.
template <int D>
void Multigrid<D>::read_rows(const SystemMatrix<D>& a) {
  rows_.blocks.clear(), rows_.scalars.clear(), rows_.scalar.clear(), slots_.clear(), factors_.clear();
  for (const auto& term : a.scalar) factors_.push_back(term.factor);
  std::vector<std::int32_t> order, columns, place(a.vertices(), -1);
  std::vector<double> values;
  for (std::size_t i = 0; i < a.vertices(); ++i) {
    rows_.blocks.add_row(a.blocks->columns(i), order);
    for (const std::int32_t k : order) slots_.push_back(a.blocks->first_slot(i) + k);
    columns.clear(), values.clear();
    for (const auto& term : a.scalar) {
      std::int32_t slot = term.matrix->first_slot(i);
      for (const std::int32_t j : term.matrix->columns(i)) {
        auto& at = place[static_cast<std::size_t>(j)];
        if (at < 0) at = static_cast<std::int32_t>(columns.size()), columns.push_back(j), values.push_back(0);
        values[static_cast<std::size_t>(at)] += term.factor * term.matrix->block(slot++)(0);
      }
    }
    for (const std::int32_t j : columns) place[static_cast<std::size_t>(j)] = -1;
    rows_.scalars.add_row(columns, order);
    for (const std::int32_t k : order) rows_.scalar.push_back(values[static_cast<std::size_t>(k)]);
  }
}

template <int D>
void Multigrid<D>::find_held(const SystemMatrix<D>& a) {
  has_held_.assign(a.vertices(), 0), held_.clear();
  for (std::size_t u = 0; u < a.held->size(); ++u)
    if ((*a.held)[u] && !a.blocks->columns(u / D).empty()) has_held_[u / D] = 1, held_.push_back(u);
}

/// Vertices that slivers tie together: one has more than `strong` of its stiffness from the other. Neither the hats nor
/// the sweeps move them together against their neighbours.
template <int D>
SparseRows Multigrid<D>::groups(const SystemMatrix<D>& a) const {
  UnionFind joined(a.vertices());
  const auto trace = [&](std::size_t k) { return a.blocks->block(slots_[k]).trace(); };
  for (std::size_t i = 0; i < a.vertices(); ++i) {
    if (rows_.blocks[i].empty()) continue;
    const double own = a.blocks->block(a.blocks->first_slot(i)).trace();
    for (auto k = static_cast<std::size_t>(rows_.blocks.begin[i]);
         k < static_cast<std::size_t>(rows_.blocks.begin[i + 1]); ++k)
      if (-trace(k) > strong * own) joined.join(i, static_cast<std::size_t>(rows_.blocks.column[k]));
  }
  std::vector<std::vector<std::int32_t>> members(a.vertices());
  for (std::size_t i = 0; i < a.vertices(); ++i)
    if (joined.size(i) > 1) members[joined.find(i)].push_back(static_cast<std::int32_t>(i));
  SparseRows groups;
  for (const auto& group : members)
    if (!group.empty()) groups.column.insert(groups.column.end(), group.begin(), group.end()), groups.end_row();
  return groups;
}

template <int D>
void Multigrid<D>::find_levels(const SystemMatrix<D>& a) {
  read_rows(a);
  coarse_.clear(), float_is_new_ = double_is_new_ = true;
  if (!a.places) return;
  std::vector<Point2> places = *a.places;
  const Point2 nowhere{std::numeric_limits<double>::quiet_NaN(), 0};
  places.resize(a.vertices(), nowhere);
  for (std::size_t i = 0; i < places.size(); ++i) {  // a vertex that is held altogether needs no correction
    const auto held = a.held->begin() + static_cast<std::ptrdiff_t>(D * i);
    if (std::find(held, held + D, 0) == held + D) places[i] = nowhere;
  }
  double spacing = first_spacing * median_edge(rows_.blocks, places);
  if (!(spacing > 0)) return;
  for (const Rows* fine = &rows_; fine->blocks.size() > fewest_coarsened; spacing *= 2) {
    CoarseLevel level;
    level.from.build(fine->blocks, places, spacing, coarse_.empty() ? groups(a) : SparseRows());
    places = level.from.coarse_places();
    if (places.empty() || static_cast<double>(places.size()) > 0.8 * static_cast<double>(fine->blocks.size())) break;
    level.from.coarse_pattern(fine->blocks, level.rows.blocks);
    level.from.multiply(fine->scalars, fine->scalar, level.rows.scalars, level.rows.scalar);
    level.set(level.rows);
    coarse_.push_back(std::move(level));
    fine = &coarse_.back().rows;
  }
}

template <int D>
template <class S>
void Multigrid<D>::Level<S>::set(const Rows& rows) {
  matrix.set_pattern(rows.blocks, rows.scalars);
  for (std::size_t k = 0; k < rows.scalar.size(); ++k) matrix.scalar(k) = static_cast<S>(rows.scalar[k]);
  for (auto* field : {&r, &z, &t}) field->assign(D * matrix.size() + LevelMatrix<D, S>::padding, S{0});
}

// --- values ----------------------------------------------------------------------------------------------------------

template <int D>
bool Multigrid<D>::needs_doubles(const SystemMatrix<D>& a) {
  std::vector<double> sizes;
  for (std::size_t i = 0; i < a.vertices(); ++i)
    if (!a.blocks->columns(i).empty()) sizes.push_back(a.diagonal(i).trace());
  if (sizes.empty()) return false;
  const double largest = *std::max_element(sizes.begin(), sizes.end());
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());

  return !(largest < widest_for_floats * *middle && largest < 1e30 && *middle > 1e-30);
}

/// The finest level: zero in rows and columns of held unknowns.
template <int D>
template <class S>
void Multigrid<D>::fill(const SystemMatrix<D>& a, Level<S>& level, bool& is_new) {
  if (is_new) level.set(rows_), is_new = false;
  const auto held = [&](std::size_t i, int c) { return (*a.held)[D * i + static_cast<std::size_t>(c)] != 0; };
  std::size_t k = 0;
  for (std::size_t i = 0; i < a.vertices(); ++i) {
    for (const std::int32_t column : rows_.blocks[i]) {
      const auto j = static_cast<std::size_t>(column);
      Eigen::Map<Eigen::Matrix<S, D, D>> block(level.matrix.block(k));
      block = a.blocks->block(slots_[k++]).template cast<S>();
      if (!has_held_[i] && !has_held_[j]) continue;
      for (int c = 0; c < D; ++c) {
        if (held(i, c)) block.row(c).setZero();
        if (held(j, c)) block.col(c).setZero();
      }
    }
    if (rows_.blocks[i].empty()) continue;
    Block inverse = inverse_of(Block(a.diagonal(i)));
    for (int c = 0; c < D && has_held_[i]; ++c)
      if (held(i, c)) inverse(c, c) = 0;
    level.matrix.set_inverse(i, inverse);
  }
}

/// P^T A P, row by row.
template <int D>
template <class S>
void Multigrid<D>::fill_coarse(const LevelMatrix<D, S>& fine, CoarseLevel& level) {
  using Column = Eigen::Array<S, 4, 1>;  // of a block, with one value too many
  std::vector<std::array<Column, D>> sums;
  place_.resize(std::max(place_.size(), level.from.coarse_size()));
  for (std::size_t i = 0; i < level.from.coarse_size(); ++i) {
    const auto columns = level.rows.blocks[i];
    for (std::size_t k = 0; k < columns.size(); ++k)
      place_[static_cast<std::size_t>(columns[k])] = static_cast<std::int32_t>(k);
    sums.resize(columns.size());
    for (auto& sum : sums) sum.fill(Column::Zero());
    for (const auto& member : level.from.members(i)) {
      const auto v = static_cast<std::size_t>(member.other);
      const S* block = fine.block(static_cast<std::size_t>(fine.block_rows().begin[v]));
      for (const std::int32_t j : fine.block_rows()[v]) {
        std::array<Column, D> part;
        for (int c = 0; c < D; ++c)
          part[static_cast<std::size_t>(c)] = S(member.weight) * Eigen::Map<const Column>(block + D * c);
        block += D * D;
        for (const auto& parent : level.from.parents(static_cast<std::size_t>(j))) {
          auto& sum = sums[static_cast<std::size_t>(place_[static_cast<std::size_t>(parent.other)])];
          for (std::size_t c = 0; c < D; ++c) sum[c] += S(parent.weight) * part[c];
        }
      }
    }
    float* to = level.matrix.block(static_cast<std::size_t>(level.rows.blocks.begin[i]));
    for (const auto& sum : sums)
      for (std::size_t c = 0; c < D; ++c, to += D)
        for (int k = 0; k < D; ++k) to[k] = static_cast<float>(sum[c][k]);
    level.matrix.set_inverse(i, inverse_of(level.matrix.diagonal(i)));
  }
}

template <int D>
void Multigrid<D>::factor_coarsest() {
  solves_coarsest_ = false;
  if (coarse_.empty() || coarse_.back().matrix.size() > most_factored) return;
  Eigen::MatrixXd dense = coarse_.back().matrix.dense();
  for (Eigen::Index u = 0; u < dense.rows(); ++u)  // all its members are held
    if (dense(u, u) == 0) dense(u, u) = 1;
  coarsest_.compute(dense);
  solves_coarsest_ = coarsest_.info() == Eigen::Success;
}

template <int D>
void Multigrid<D>::setup(const SystemMatrix<D>& a) {
  const bool same_factors = std::equal(factors_.begin(), factors_.end(), a.scalar.begin(), a.scalar.end(),
                                       [](double factor, const auto& term) { return factor == term.factor; });
  find_held(a);
  if (a.pattern != pattern_ || rows_.blocks.size() != a.vertices() || !same_factors) find_levels(a);
  pattern_ = a.pattern;
  in_doubles_ = needs_doubles(a);
  if (in_doubles_)
    fill(a, finest_in_doubles_, double_is_new_);
  else
    fill(a, finest_, float_is_new_);
  for (std::size_t l = 0; l < coarse_.size(); ++l)
    if (l > 0)
      fill_coarse(coarse_[l - 1].matrix, coarse_[l]);
    else if (in_doubles_)
      fill_coarse(finest_in_doubles_.matrix, coarse_[l]);
    else
      fill_coarse(finest_.matrix, coarse_[l]);
  factor_coarsest();
}

// --- cycle -----------------------------------------------------------------------------------------------------------

/// z from r on a level; `next` is the number of the next coarser one.
template <int D>
template <class S>
void Multigrid<D>::cycle(Level<S>& level, std::size_t next) {
  if (next == coarse_.size() && next > 0 && solves_coarsest_) {
    const auto n = static_cast<Eigen::Index>(D * level.matrix.size());
    using Values = Eigen::Matrix<S, Eigen::Dynamic, 1>;
    Eigen::VectorXd x = Eigen::Map<const Values>(level.r.data(), n).template cast<double>();
    coarsest_.solveInPlace(x);
    Eigen::Map<Values>(level.z.data(), n) = x.template cast<S>();
    return;
  }
  level.matrix.sweep_forwards(level.r, level.z, level.t);
  if (next < coarse_.size()) correct(level, next);
  level.matrix.sweep_backwards(level.r, level.z);
}

/// Adds to z what the coarser levels make of the residual t.
template <int D>
template <class S>
void Multigrid<D>::correct(Level<S>& level, std::size_t next) {
  CoarseLevel& coarse = coarse_[next];
  if (next == 0)
    for (const std::size_t u : held_) level.t[u] = 0;
  for (std::size_t k = 0; k < coarse.matrix.size(); ++k) {
    std::array<S, D> sum{};
    for (const auto& [i, weight] : coarse.from.members(k))
      for (std::size_t c = 0; c < D; ++c) sum[c] += S(weight) * level.t[D * static_cast<std::size_t>(i) + c];
    for (std::size_t c = 0; c < D; ++c) coarse.r[D * k + c] = static_cast<float>(sum[c]);
  }
  cycle(static_cast<Level<float>&>(coarse), next + 1);
  for (std::size_t i = 0; i < level.matrix.size(); ++i)
    for (const auto& [k, weight] : coarse.from.parents(i))
      for (std::size_t c = 0; c < D; ++c)
        level.z[D * i + c] += S(weight) * S(coarse.z[D * static_cast<std::size_t>(k) + c]);
  if (next == 0)
    for (const std::size_t u : held_) level.z[u] = 0;
}

template <int D>
void Multigrid<D>::apply(const Field& r, Field& z) {
  const auto run = [&](auto& level) {
    using S = std::decay_t<decltype(level.r[0])>;
    const double scale = r.cwiseAbs().maxCoeff();  // so that floats hold it
    const double inverse = scale > 0 ? 1 / scale : 0;
    for (Eigen::Index u = 0; u < r.size(); ++u) level.r[static_cast<std::size_t>(u)] = static_cast<S>(inverse * r[u]);
    cycle(level, 0);
    for (Eigen::Index u = 0; u < r.size(); ++u)
      z[u] = scale * static_cast<double>(level.z[static_cast<std::size_t>(u)]);
  };
  if (in_doubles_)
    run(finest_in_doubles_);
  else
    run(finest_);
}

template class Multigrid<2>;
template class Multigrid<3>;

}  // namespace cutbench
