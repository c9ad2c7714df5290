#include "harness/fem/level_matrix.h"

#include <algorithm>

namespace cutbench {

template <int D, class S>
void LevelMatrix<D, S>::set_pattern(const SparseRows& rows, std::size_t values, Part& part) {
  part.rows = rows;
  part.diagonal.resize(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto row = rows[i];
    const auto at =
        std::find_if(row.begin(), row.end(), [i](std::int32_t j) { return j >= static_cast<std::int32_t>(i); });
    part.diagonal[i] = rows.begin[i] + static_cast<std::int32_t>(at - row.begin());
  }
  part.value.assign(values * rows.column.size() + padding, S{0});
}

template <int D, class S>
void LevelMatrix<D, S>::set_pattern(const SparseRows& blocks, const SparseRows& scalars) {
  set_pattern(blocks, D * D, blocks_), set_pattern(scalars, 1, scalars_);
  inverse_.assign(D * D * size() + padding, S{0});
}

template <int D, class S>
auto LevelMatrix<D, S>::diagonal(std::size_t i) const -> Block {
  Block all = Eigen::Map<const Eigen::Matrix<S, D, D>>(block(static_cast<std::size_t>(blocks_.diagonal[i])))
                  .template cast<double>();
  if (!scalars_.rows[i].empty())
    all.diagonal().array() += static_cast<double>(scalars_.value[static_cast<std::size_t>(scalars_.diagonal[i])]);
  return all;
}

template <int D, class S>
Eigen::MatrixXd LevelMatrix<D, S>::dense() const {
  const auto n = static_cast<Eigen::Index>(D * size());
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(n, n);
  std::size_t entry = 0, scalar = 0;
  for (Eigen::Index i = 0; i < n / D; ++i) {
    for (const std::int32_t j : blocks_.rows[static_cast<std::size_t>(i)])
      all.block<D, D>(D * i, D * j) += Eigen::Map<const Eigen::Matrix<S, D, D>>(block(entry++)).template cast<double>();
    for (const std::int32_t j : scalars_.rows[static_cast<std::size_t>(i)])
      all.block<D, D>(D * i, D * j).diagonal().array() += static_cast<double>(scalars_.value[scalar++]);
  }
  return all;
}

/// Subtracts entries times z from a sum. Four values at a time: the last of three belongs to the neighbour and is
/// ignored at the end. Several sums in turns, so that subtractions don't wait for each other.
template <int D, class S>
void LevelMatrix<D, S>::subtract_blocks(std::int32_t first, std::int32_t last, const Vector& z, Sum& sum) const {
  const S* a = blocks_.value.data() + D * D * first;
  Sum other = Sum::Zero();
  for (std::int32_t k = first; k < last; ++k, a += D * D) {
    const S* x = z.data() + D * blocks_.rows.column[static_cast<std::size_t>(k)];
    Sum part = Eigen::Map<const Sum>(a) * x[0];
    for (int c = 1; c < D; ++c) part += Eigen::Map<const Sum>(a + D * c) * x[c];
    (k % 2 == 0 ? sum : other) -= part;
  }
  sum += other;
}

template <int D, class S>
void LevelMatrix<D, S>::subtract_scalars(std::int32_t first, std::int32_t last, const Vector& z, Sum& sum) const {
  const auto term = [&](std::int32_t k) -> Sum {
    return scalars_.value[static_cast<std::size_t>(k)] *
           Eigen::Map<const Sum>(z.data() + D * scalars_.rows.column[static_cast<std::size_t>(k)]);
  };
  Sum other = Sum::Zero(), third = Sum::Zero(), fourth = Sum::Zero();
  std::int32_t k = first;
  for (; k + 4 <= last; k += 4) sum -= term(k), other -= term(k + 1), third -= term(k + 2), fourth -= term(k + 3);
  for (; k < last; ++k) other -= term(k);
  sum += (other + third) + fourth;
}

/// z at row i from the residual that the other rows leave.
template <int D, class S>
void LevelMatrix<D, S>::relax(std::size_t i, const Sum& residual, Vector& z) const {
  const S* inverse = inverse_.data() + D * D * i;
  Sum solved = Sum::Zero();
  for (int c = 0; c < D; ++c) solved += Eigen::Map<const Sum>(inverse + D * c) * residual[c];
  for (int c = 0; c < D; ++c) z[D * i + static_cast<std::size_t>(c)] = solved[c];
}

template <int D, class S>
void LevelMatrix<D, S>::sweep_forwards(const Vector& r, Vector& z, Vector& t) const {
  const bool has_scalars = !scalars_.rows.column.empty();
  for (std::size_t i = 0; i < size(); ++i) {
    Sum sum = Eigen::Map<const Sum>(r.data() + D * i);
    subtract_blocks(blocks_.rows.begin[i], blocks_.diagonal[i], z, sum);
    if (has_scalars) subtract_scalars(scalars_.rows.begin[i], scalars_.diagonal[i], z, sum);
    relax(i, sum, z);
  }
  for (std::size_t i = 0; i < size(); ++i) {
    Sum sum = Sum::Zero();
    subtract_blocks(blocks_.diagonal[i] + 1, blocks_.rows.begin[i + 1], z, sum);
    if (has_scalars) subtract_scalars(scalars_.diagonal[i] + 1, scalars_.rows.begin[i + 1], z, sum);
    for (int c = 0; c < D; ++c) t[D * i + static_cast<std::size_t>(c)] = sum[c];
  }
}

template <int D, class S>
void LevelMatrix<D, S>::sweep_backwards(const Vector& r, Vector& z) const {
  const bool has_scalars = !scalars_.rows.column.empty();
  for (std::size_t i = size(); i-- > 0;) {
    Sum sum = Eigen::Map<const Sum>(r.data() + D * i);
    subtract_blocks(blocks_.rows.begin[i], blocks_.diagonal[i], z, sum);
    subtract_blocks(blocks_.diagonal[i] + 1, blocks_.rows.begin[i + 1], z, sum);
    if (has_scalars) {
      subtract_scalars(scalars_.rows.begin[i], scalars_.diagonal[i], z, sum);
      subtract_scalars(scalars_.diagonal[i] + 1, scalars_.rows.begin[i + 1], z, sum);
    }
    relax(i, sum, z);
  }
}

template class LevelMatrix<2, float>;
template class LevelMatrix<3, float>;
template class LevelMatrix<2, double>;
template class LevelMatrix<3, double>;

}  // namespace cutbench
