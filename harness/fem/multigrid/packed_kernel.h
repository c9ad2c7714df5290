// What reads packed rows (packed_rows.h): the sweeps of Gauss-Seidel by the blocks of the unknowns, forwards before the
// coarse correction and backwards after it, so that the whole cycle is symmetric (Trottenberg, Oosterlee and Schueller,
// Multigrid, 2001, 2.5 and 2.7.2), and the product of conjugate gradients.
//
// With a sweep forwards W and a coarse correction C, the cycle is (W + W' - W' A W) + (I - W' A) C (I - A W), and
// W + W' - W' A W = W' (diagonal of A) W. So it is symmetric, and positive definite where C and the blocks on the
// diagonal of A are.
//
// No sum depends on the width of a processor's lanes. Of each pair of blocks, the first goes to one sum of four lanes
// and the second to another; columns have sums of their own, and so have the first and the second of two scalars.
#pragma once

#include <array>
#include <cstring>
#include <span>

#include "harness/fem/algebra/workers.h"
#include "harness/fem/multigrid/packed_rows.h"

namespace cutbench {

// --- lanes -----------------------------------------------------------------------------------------------------------

/// Eight lanes as two by four.
template <class S>
struct TwoFours {
  Quad<S> low{}, high{};
  /// Of two vertices.
  static TwoFours of(const S* one, const S* other) { return {load_quad(one), load_quad(other)}; }
  /// += entries times coordinate c of both vertices.
  template <int c>
  void add(const S* entries, const TwoFours& x) {
    low += load_quad(entries) * x.low[c];
    high += load_quad(entries + 4) * x.high[c];
  }
  TwoFours operator+(const TwoFours& with) const { return {low + with.low, high + with.high}; }
  Quad<S> total() const { return low + high; }
};

/// The same in one register.
struct Eight {
  using Register = float __attribute__((vector_size(32)));
  Register lanes{};
  static Eight of(const float* one, const float* other) {
    return {__builtin_shufflevector(load_quad(one), load_quad(other), 0, 1, 2, 3, 4, 5, 6, 7)};
  }
  template <int c>
  void add(const float* entries, const Eight& x) {
    Register a;
    std::memcpy(&a, entries, sizeof a);
    lanes += a * __builtin_shufflevector(x.lanes, x.lanes, c, c, c, c, c + 4, c + 4, c + 4, c + 4);
  }
  Eight operator+(const Eight& with) const { return {lanes + with.lanes}; }
  Quad<float> total() const {
    return __builtin_shufflevector(lanes, lanes, 0, 1, 2, 3) + __builtin_shufflevector(lanes, lanes, 4, 5, 6, 7);
  }
};

template <class S>
struct WidestOf {
  using Type = TwoFours<S>;
};
#ifdef __AVX__
template <>
struct WidestOf<float> {
  using Type = Eight;
};
#endif
/// What this processor reads fastest.
template <class S>
using Widest = typename WidestOf<S>::Type;

// Called once in each loop over rows: a call would keep no sum in a register.
#define CUTBENCH_INLINE [[gnu::always_inline]] inline

// --- products --------------------------------------------------------------------------------------------------------

template <class S>
CUTBENCH_INLINE Quad<S> scalar_sum(std::span<const TwoScalars<S>> all, const S* x) {
  Quad<S> first{}, second{};
  for (const auto& two : all) {
    first += two.value[0] * load_quad(x + two.offset[0]);
    second += two.value[1] * load_quad(x + two.offset[1]);
  }
  return first + second;
}

/// The entries of row i on one side of the diagonal, times a vector.
template <class Wide, int D, class S>
CUTBENCH_INLINE Quad<S> part_sum(const PackedPart<D, S>& part, std::size_t i, const S* x) {
  std::array<Wide, D> sums{};
  const auto* values = part.values.data() + D * part.pairs.begin(i);
  for (const PackedPair& pair : part.pairs[i]) {
    const Wide at = Wide::of(x + pair.offset[0], x + pair.offset[1]);
    sums[0].template add<0>(values[0].data(), at);
    sums[1].template add<1>(values[1].data(), at);
    if constexpr (D == 3) sums[2].template add<2>(values[2].data(), at);
    values += D;
  }
  Wide all = sums[0] + sums[1];
  if constexpr (D == 3) all = all + sums[2];
  return all.total() + scalar_sum(part.scalars[i], x);
}

/// A D x D block by its columns, times a vertex.
template <int D, class S>
Quad<S> times(const Quad<S>* columns, Quad<S> x) {
  Quad<S> sum = columns[0] * x[0];
  for (int c = 1; c < D; ++c) sum += columns[c] * x[c];
  return sum;
}

// --- sweeps ----------------------------------------------------------------------------------------------------------

/// Calls sweep(rows) for all rows, in the order of the sweeps or against it; for bands at the same time.
template <class Sweep>
void sweep_all(const SweepOrder& order, bool backwards, Workers& workers, const Sweep& sweep) {
  const auto take_turn = [&](std::size_t turn) {
    const auto bands = order.bands(turn);
    workers.run(bands.size(), [&](std::size_t k) { sweep(std::span(bands[k])); });
  };
  if (backwards) sweep(std::span(order.rest()));
  for (const std::size_t turn : {0, 1}) take_turn(backwards ? 1 - turn : turn);
  if (!backwards) sweep(std::span(order.rest()));
}

/// z = (L + diagonal)^-1 r and t = r - A z, which is what the upper triangle leaves.
template <class Wide, int D, class S>
void sweep_forwards(const PackedRows<D, S>& a, const PackedVector<S>& r, PackedVector<S>& z, PackedVector<S>& t,
                    Workers& workers = Workers::none()) {
  const S* const x = reinterpret_cast<const S*>(z.data());
  sweep_all(a.order(), false, workers, [&](std::span<const std::int32_t> rows) {
    for (const std::int32_t row : rows) {
      const auto i = to_size(row);
      z[i] = times<D, S>(a.inverse_columns(i), r[i] - part_sum<Wide>(a.below(), i, x));
    }
  });
  workers.for_ranges(a.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) t[i] = -part_sum<Wide>(a.above(), i, x);
  });
}

/// z += (U + diagonal)^-1 (r - A z): the diagonal times z, and z itself, cancel out.
template <class Wide, int D, class S>
void sweep_backwards(const PackedRows<D, S>& a, const PackedVector<S>& r, PackedVector<S>& z,
                     Workers& workers = Workers::none()) {
  const S* const x = reinterpret_cast<const S*>(z.data());
  sweep_all(a.order(), true, workers, [&](std::span<const std::int32_t> rows) {
    for (std::size_t k = rows.size(); k-- > 0;) {
      const auto i = to_size(rows[k]);
      const Quad<S> left = r[i] - part_sum<Wide>(a.below(), i, x);
      z[i] = times<D, S>(a.inverse_columns(i), left - part_sum<Wide>(a.above(), i, x));
    }
  });
}

/// Row i of A x, with the small scalars. \pre the rows keep them
template <class Wide, int D, class S>
Quad<S> row_product(const PackedRows<D, S>& a, std::size_t i, const PackedVector<S>& vector) {
  const S* const x = reinterpret_cast<const S*>(vector.data());
  const Quad<S> beside = part_sum<Wide>(a.below(), i, x) + part_sum<Wide>(a.above(), i, x);
  return (beside + times<D, S>(a.diagonal_columns(i), vector[i])) + scalar_sum(a.small()[i], x);
}

#undef CUTBENCH_INLINE

}  // namespace cutbench
