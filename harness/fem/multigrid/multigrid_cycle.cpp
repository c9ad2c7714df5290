// The cycle of multigrid: sweeps on each level, and between them what the coarser ones make of the residual.
#include <array>
#include <type_traits>

#include "harness/base/conversions.h"
#include "harness/fem/multigrid/multigrid.h"

namespace cutbench {

/// z from r on a level; `next` is the number of the next coarser one.
template <int D>
template <class S>
void Multigrid<D>::cycle(Level<S>& level, std::size_t next) {
  if (next == coarse_.size() && next > 0 && solves_coarsest_) {
    const auto n = to_index(D * level.matrix.size());
    using Values = Eigen::Matrix<S, Eigen::Dynamic, 1>;
    Eigen::VectorXd x = Eigen::Map<const Values>(level.r.data(), n).template cast<double>();
    coarsest_.solveInPlace(x);
    Eigen::Map<Values>(level.z.data(), n) = x.template cast<S>();
    return;
  }
  level.matrix.sweep_forwards(level.r, level.z, level.t);
  level.set_idle_zero(level.t);
  if (next == 0) clusters_.correct_forwards(level.matrix, level.z, level.t);
  if (next < coarse_.size()) correct(level, next);
  if (next == 0) clusters_.correct_backwards(level.matrix, level.r, level.z);
  level.matrix.sweep_backwards(level.r, level.z);
}

/// Adds to z what the coarser levels make of the residual t.
template <int D>
template <class S>
void Multigrid<D>::correct(Level<S>& level, std::size_t next) {
  CoarseLevel& coarse = coarse_[next];
  level.set_idle_zero(level.t);
  for (std::size_t k = 0; k < coarse.matrix.size(); ++k) {
    std::array<S, D> sum{};
    for (const auto& [i, weight] : coarse.from.members(k))
      for (std::size_t c = 0; c < D; ++c) sum[c] += S(weight) * level.t[D * to_size(i) + c];
    for (std::size_t c = 0; c < D; ++c) coarse.r[D * k + c] = static_cast<float>(sum[c]);
  }
  cycle(static_cast<Level<float>&>(coarse), next + 1);
  for (std::size_t i = 0; i < level.matrix.size(); ++i)
    for (const auto& [k, weight] : coarse.from.parents(i))
      for (std::size_t c = 0; c < D; ++c) level.z[D * i + c] += S(weight) * S(coarse.z[D * to_size(k) + c]);
  level.set_idle_zero(level.z);
}

template <int D>
void Multigrid<D>::apply(const Field& r, Field& z) {
  const auto run = [&](auto& level) {
    using S = std::decay_t<decltype(level.r[0])>;
    const double scale = r.cwiseAbs().maxCoeff();  // so that floats hold it
    const double inverse = scale > 0 ? 1 / scale : 0;
    for (Eigen::Index u = 0; u < r.size(); ++u) level.r[to_size(u)] = static_cast<S>(inverse * r[u]);
    cycle(level, 0);
    for (Eigen::Index u = 0; u < r.size(); ++u) z[u] = scale * to_double(level.z[to_size(u)]);
  };
  if (in_doubles_)
    run(finest_in_doubles_);
  else
    run(finest_);
}

// multigrid.cpp instantiates the rest of the class.
template void Multigrid<2>::apply(const Field&, Field&);
template void Multigrid<3>::apply(const Field&, Field&);

}  // namespace cutbench
