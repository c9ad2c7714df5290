#include "harness/fem/algebra/block_matrix.h"

#include <algorithm>

#include "harness/base/conversions.h"

namespace cutbench {

template <int D>
void BlockMatrix<D>::set_row(std::size_t i, std::span<const std::int32_t> columns) {
  columns_.set(i, columns);
  blocks_.resize(columns_.slots());
  set_row_zero(i);
}

template <int D>
std::int32_t BlockMatrix<D>::find(std::size_t i, std::int32_t j) const {
  const auto all = columns(i);
  const auto at = std::find(all.begin(), all.end(), j);
  return at == all.end() ? -1 : first_slot(i) + to_int32(at - all.begin());
}

template <int D>
void BlockMatrix<D>::set_zero(Workers& workers) {
  workers.for_ranges(blocks_.size(), [&](std::size_t begin, std::size_t end) {
    std::fill(blocks_.begin() + to_index(begin), blocks_.begin() + to_index(end), Block::Zero());
  });
}

template <int D>
void BlockMatrix<D>::set_row_zero(std::size_t i) {
  std::fill_n(blocks_.begin() + first_slot(i), columns_[i].size(), Block::Zero());
}

template <int D>
std::size_t BlockMatrix<D>::block_count() const {
  std::size_t n = 0;
  for (std::size_t i = 0; i < rows(); ++i) n += columns_[i].size();
  return n;
}

template <int D>
void BlockMatrix<D>::add_product(double factor, const Field& x, Field& y) const {
  using Vector = Eigen::Matrix<double, D, 1>;
  for (std::size_t i = 0; i < rows(); ++i) {
    const Block* block = blocks_.data() + columns_.begin(i);
    Vector sum = Vector::Zero();
    for (const std::int32_t column : columns_[i])
      sum.noalias() += *block++ * Eigen::Map<const Vector>(x.data() + D * column);
    Eigen::Map<Vector>(y.data() + D * i) += factor * sum;
  }
}

template <int D>
void spread(const Field& x, std::vector<Lanes>& vertices, Workers& workers) {
  vertices.resize(to_size(x.size()) / D);
  workers.for_ranges(vertices.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Lanes at{};
      for (std::size_t k = 0; k < D; ++k) at[k] = x[to_index(D * i + k)];
      vertices[i] = at;
    }
  });
}

void add_product_per_coordinate(const BlockMatrix<1>& a, int dimension, double factor, const Field& x, Field& y,
                                Workers& workers) {
  const auto add = [&]<int D>(std::integral_constant<int, D>) {
    using Vector = Eigen::Matrix<double, D, 1>;
    workers.for_ranges(a.rows(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto columns = a.columns(i);
        std::int32_t slot = a.first_slot(i);
        Vector sum = Vector::Zero();
        for (const std::int32_t j : columns) sum += a.block(slot++)(0) * Eigen::Map<const Vector>(x.data() + D * j);
        Eigen::Map<Vector>(y.data() + D * i) += factor * sum;
      }
    });
  };
  if (dimension == 3)
    add(std::integral_constant<int, 3>());
  else if (dimension == 2)
    add(std::integral_constant<int, 2>());
  else
    a.add_product(factor, x, y);
}

template <int D>
double max_entry(const BlockMatrix<D>& a) {
  double largest = 0;
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (std::size_t k = 0; k < a.columns(i).size(); ++k)
      largest = std::max(largest, a.block(a.first_slot(i) + to_int32(k)).cwiseAbs().maxCoeff());
  return largest;
}

template <int D>
double max_difference(const BlockMatrix<D>& a, const BlockMatrix<D>& b) {
  using Block = typename BlockMatrix<D>::Block;
  double largest = 0;
  const auto compare = [&](const BlockMatrix<D>& one, const BlockMatrix<D>& other) {
    for (std::size_t i = 0; i < one.rows(); ++i)
      for (const std::int32_t j : one.columns(i)) {
        const std::int32_t there = i < other.rows() ? other.find(i, j) : -1;
        const Block missing = there >= 0 ? other.block(there) : Block(Block::Zero());
        largest = std::max(largest, (one.block(one.find(i, j)) - missing).cwiseAbs().maxCoeff());
      }
  };
  compare(a, b);
  compare(b, a);
  return largest;
}

template void spread<2>(const Field&, std::vector<Lanes>&, Workers&);
template void spread<3>(const Field&, std::vector<Lanes>&, Workers&);
template class BlockMatrix<1>;
template class BlockMatrix<2>;
template class BlockMatrix<3>;
template double max_entry(const BlockMatrix<1>&);
template double max_entry(const BlockMatrix<2>&);
template double max_entry(const BlockMatrix<3>&);
template double max_difference(const BlockMatrix<1>&, const BlockMatrix<1>&);
template double max_difference(const BlockMatrix<2>&, const BlockMatrix<2>&);
template double max_difference(const BlockMatrix<3>&, const BlockMatrix<3>&);

}  // namespace cutbench
