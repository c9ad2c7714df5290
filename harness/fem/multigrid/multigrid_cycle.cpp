// The cycle of multigrid: sweeps on each level, and between them what the coarser ones make of the residual.
#include <algorithm>
#include <type_traits>

#include "harness/base/conversions.h"
#include "harness/fem/multigrid/multigrid.h"
#include "harness/fem/multigrid/packed_kernel.h"

namespace cutbench {

namespace {

/// The D values of each vertex over the largest one, so that floats hold them; returns that.
template <int D, class Vector>
double take_scaled(const Field& field, Vector& packed, Workers& workers) {
  using S = std::decay_t<decltype(packed[0][0])>;
  struct Largest {
    double value = 0;
    void operator+=(const Largest& other) { value = std::max(value, other.value); }
  };
  const auto largest = [&](std::size_t begin, std::size_t end) -> Largest {
    return {begin == end ? 0 : field.segment(to_index(D * begin), to_index(D * (end - begin))).cwiseAbs().maxCoeff()};
  };
  const double scale = workers.sum_ranges(packed.size(), largest).value, inverse = scale > 0 ? 1 / scale : 0;
  workers.for_ranges(packed.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Quad<S> at{};
      for (int c = 0; c < D; ++c) at[c] = static_cast<S>(inverse * field[to_index(D * i) + c]);
      packed[i] = at;
    }
  });
  return scale;
}

template <int D, class AQuad>
void give_scaled(double scale, const AQuad& at, std::size_t i, Field& field) {
  for (int c = 0; c < D; ++c) field[to_index(D * i) + c] = scale * to_double(at[c]);
}

}  // namespace

/// z from r on a level; `next` is the number of the next coarser one.
template <int D>
template <class S>
void Multigrid<D>::cycle(Level<S>& level, std::size_t next) {
  if constexpr (std::is_same_v<S, float>)
    if (next == coarse_.size() && next > 0 && solves_coarsest_) return solve_coarsest(level);
  sweep_forwards<Widest<S>>(level.matrix, level.r, level.z, level.t, *workers_);
  level.set_idle_zero(level.t);
  if (next == 0) clusters_.correct_forwards(level.matrix, level.z, level.t);
  if (next < coarse_.size()) correct(level, next);
  if (next == 0) clusters_.correct_backwards(level.matrix, level.r, level.z);
  sweep_backwards<Widest<S>>(level.matrix, level.r, level.z, *workers_);
}

template <int D>
void Multigrid<D>::solve_coarsest(Level<float>& level) {
  Eigen::VectorXd x(to_index(D * level.matrix.size()));
  for (Eigen::Index u = 0; u < x.size(); ++u) x[u] = to_double(level.r[to_size(u / D)][u % D]);
  coarsest_.solveInPlace(x);
  for (Eigen::Index u = 0; u < x.size(); ++u) level.z[to_size(u / D)][u % D] = static_cast<float>(x[u]);
}

/// Adds to z what the coarser levels make of the residual t.
template <int D>
template <class S>
void Multigrid<D>::correct(Level<S>& level, std::size_t next) {
  CoarseLevel& coarse = coarse_[next];
  level.set_idle_zero(level.t);
  workers_->for_ranges(coarse.matrix.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      Quad<S> sum{};
      for (const auto& [i, weight] : coarse.from.members(k)) sum += S(weight) * level.t[to_size(i)];
      coarse.r[k] = __builtin_convertvector(sum, Quad<float>);
    }
  });
  cycle(static_cast<Level<float>&>(coarse), next + 1);
  workers_->for_ranges(level.matrix.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      for (const auto& [k, weight] : coarse.from.parents(i))
        level.z[i] += S(weight) * __builtin_convertvector(coarse.z[to_size(k)], Quad<S>);
  });
  level.set_idle_zero(level.z);
}

template <int D>
void Multigrid<D>::apply(const Field& r, Field& z) {
  const auto run = [&](auto& level) {
    const double scale = take_scaled<D>(r, level.r, *workers_);
    cycle(level, 0);
    workers_->for_ranges(level.z.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) give_scaled<D>(scale, level.z[i], i, z);
    });
  };
  if (in_doubles_)
    run(finest_in_doubles_);
  else
    run(finest_);
  small_.apply(r, z);
}

template <int D>
void Multigrid<D>::multiply_stiff_rows(const Field& x, Field& y) const {
  const auto at = [](auto& field, std::size_t i) { return field.template segment<D>(to_index(D * i)); };
  workers_->for_ranges(stiff_rows_.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t i = to_size(stiff_rows_[k].row);
      const Block* block = stiff_blocks_.data() + stiff_rows_[k].first_block;
      const double* scalar = rows_.scalar.data() + rows_.scalars.first_slot(i);
      Eigen::Matrix<double, D, 1> sum = Eigen::Matrix<double, D, 1>::Zero();
      for (const std::int32_t j : rows_.blocks[i]) sum += *block++ * at(x, to_size(j));
      for (const std::int32_t j : rows_.scalars[i]) sum += *scalar++ * at(x, to_size(j));
      at(y, i) = sum;
    }
  });
}

template <int D>
bool Multigrid<D>::multiply_roughly(const Field& x, Field& y) {
  const auto multiply = [&]<class S>(Level<S>& level) {
    const double scale = take_scaled<D>(x, level.t, *workers_);
    workers_->for_ranges(level.t.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        give_scaled<D>(scale, row_product<Widest<S>>(level.matrix, i, level.t), i, y);
    });
  };
  if (in_doubles_) {
    multiply(finest_in_doubles_);
  } else {
    multiply(finest_);
    multiply_stiff_rows(x, y);
  }
  for (const Eigen::Index u : held_) y[u] = 0;
  small_.set_zero(y);
  return true;
}

// multigrid.cpp instantiates the rest of the class.
template void Multigrid<2>::apply(const Field&, Field&);
template void Multigrid<3>::apply(const Field&, Field&);
template bool Multigrid<2>::multiply_roughly(const Field&, Field&);
template bool Multigrid<3>::multiply_roughly(const Field&, Field&);

}  // namespace cutbench
