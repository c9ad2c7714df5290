// Packed rows against plain loops: the same bits, by lanes of four and of eight, also after rows have changed.

#include "harness/fem/multigrid/packed_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/base/random.h"
#include "harness/fem/multigrid/packed_kernel.h"

namespace cutbench {
namespace {

template <int D, class S, class WideLanes>
struct Case {
  static constexpr int dimension = D;
  using Scalar = S;
  using Wide = WideLanes;
};

/// Rows of a level with an empty one, scalars beside blocks and without, large and small.
template <class C>
class Packed : public testing::Test {
 protected:
  static constexpr int D = C::dimension;
  static constexpr std::int32_t n = 60, empty = 7;
  using S = typename C::Scalar;
  using Wide = typename C::Wide;
  using Values = std::array<S, D>;

  Packed() {
    rows_.resize(n);
    for (std::int32_t i = 0; i < n; ++i) set_row(i, 5);
    swept_.follow(rows_);
    order_.follow(rows_, swept_);
    packed_.follow(rows_, swept_, order_, true);
    fill();
  }
  void set_row(std::int32_t i, int every) {
    std::vector<std::int32_t> blocks, scalars;
    std::vector<double> values;
    for (std::int32_t k = 0; k < n; ++k) {
      const std::int32_t j = (7 * k + i) % n;  // in any order
      if (i == empty || j == empty) continue;
      if (i == j || random_.between(0, every) < 1) blocks.push_back(j);
      if (i != j && random_.between(0, 3) > 1) continue;
      scalars.push_back(j);
      values.push_back(i == j ? random_.between(5, 9) : random_.between(-1, 1) * (j % 3 ? 1 : 0.01));
    }
    rows_.blocks.set(to_size(i), blocks);
    rows_.set_scalars(to_size(i), scalars, values);
  }
  void fill() {
    blocks_.resize(rows_.blocks.slots());
    for (auto& block : blocks_)
      for (double& value : block) value = random_.between(-1, 1);
    for (std::int32_t i = 0; i < n; ++i) {
      const auto row = to_size(i);
      packed_.fill_row(row, [&](std::size_t slot) { return columns_of<D>(blocks_[slot].data()); });
      typename PackedRows<D, S>::Block inverse;
      for (int k = 0; k < D * D; ++k) inverse(k) = random_.between(-1, 1);
      inverse_[row] = inverse.template cast<S>();
      if (i == empty) inverse_[row].setZero();
      packed_.set_inverse(row, inverse_[row].template cast<double>());
    }
  }

  /// A block of the swept matrix, and whether it is one or a scalar alone.
  struct Entry {
    bool is_block = false;
    Eigen::Matrix<S, D, D> block = Eigen::Matrix<S, D, D>::Zero();
  };
  std::map<std::int32_t, Entry> entries(std::size_t i) const {
    std::map<std::int32_t, Entry> all;
    std::map<std::int32_t, double> scalar;
    std::size_t slot = swept_.rows().first_slot(i);
    for (const std::int32_t j : swept_.rows()[i]) scalar[j] = swept_.values()[slot++];
    if (scalar.count(to_int32(i))) scalar[to_int32(i)] = rows_.scalar[rows_.scalars.diagonal_slot(i)];
    slot = rows_.blocks.first_slot(i);
    for (const std::int32_t j : rows_.blocks[i]) {
      Entry& entry = all[j];
      entry.is_block = true;
      const double added = scalar.count(j) ? to_double(static_cast<S>(scalar[j])) : 0;
      for (int k = 0; k < D * D; ++k)
        entry.block(k) = static_cast<S>(blocks_[slot][to_size(k)] + (k % (D + 1) == 0 ? added : 0));
      ++slot;
    }
    for (const auto& [j, value] : scalar)
      if (!all.count(j)) all[j].block.diagonal().setConstant(static_cast<S>(value));
    return all;
  }
  /// Two sums of scalars in turns.
  static Values sum_scalars(const std::vector<std::pair<std::int32_t, S>>& scalars, const std::vector<Values>& x) {
    Values sum{};
    for (std::size_t c = 0; c < D; ++c) {
      std::array<S, 2> two{};
      for (std::size_t k = 0; k < scalars.size(); ++k)
        two[k % 2] += scalars[k].second * x[to_size(scalars[k].first)][c];
      sum[c] = two[0] + two[1];
    }
    return sum;
  }
  /// The entries on one side of the diagonal: blocks, the farthest first, and scalars as the rows have them.
  Values sum_side(std::size_t i, bool below, const std::vector<Values>& x) const {
    const auto all = entries(i);
    std::vector<std::pair<std::int32_t, Entry>> side;
    for (const auto& entry : all)
      if (below ? entry.first < to_int32(i) : entry.first > to_int32(i)) side.push_back(entry);
    if (!below) std::reverse(side.begin(), side.end());
    std::vector<std::pair<std::int32_t, S>> scalars;
    for (const std::int32_t j : swept_.rows()[i])
      if ((below ? j < to_int32(i) : j > to_int32(i)) && !all.at(j).is_block)
        scalars.emplace_back(j, all.at(j).block(0));
    const Values by_scalars = sum_scalars(scalars, x);
    Values sum{};
    for (std::size_t k = 0; k < D; ++k) {
      std::array<std::array<S, D>, 2> columns{};  // of the first and of the second block of each pair
      std::size_t place = 0;
      for (const auto& [j, entry] : side) {
        if (!entry.is_block) continue;
        for (std::size_t c = 0; c < D; ++c)
          columns[place][c] += entry.block(to_index(k), to_index(c)) * x[to_size(j)][c];
        place = 1 - place;
      }
      std::array<S, 2> two{columns[0][0] + columns[0][1], columns[1][0] + columns[1][1]};
      if constexpr (D == 3) two = {two[0] + columns[0][2], two[1] + columns[1][2]};
      sum[k] = (two[0] + two[1]) + by_scalars[k];
    }
    return sum;
  }
  static Values times_block(const Eigen::Matrix<S, D, D>& block, const Values& x) {
    Values sum{};
    for (std::size_t k = 0; k < D; ++k) {
      sum[k] = block(to_index(k), 0) * x[0];
      for (std::size_t c = 1; c < D; ++c) sum[k] += block(to_index(k), to_index(c)) * x[c];
    }
    return sum;
  }
  std::vector<Values> random_values() {
    std::vector<Values> all(n);
    for (Values& at : all)
      for (S& value : at) value = static_cast<S>(random_.between(-1, 1));
    return all;
  }
  static PackedVector<S> packed(const std::vector<Values>& values) {
    PackedVector<S> all(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t c = 0; c < D; ++c) all[i][to_int(c)] = values[i][c];
    return all;
  }
  static std::vector<Values> plain(const PackedVector<S>& quads) {
    std::vector<Values> all(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t c = 0; c < D; ++c) all[i][c] = quads[i][to_int(c)];
    return all;
  }

  void expect_same_bits() {
    const auto right = random_values();
    PackedVector<S> z = packed(random_values()), t(n);  // whatever the last cycle left
    sweep_forwards<Wide>(packed_, packed(right), z, t);
    std::vector<Values> x(n), residual(n), product(n);
    for (std::size_t i = 0; i < n; ++i) {
      Values left = right[i];
      const Values side = sum_side(i, true, x);
      for (std::size_t c = 0; c < D; ++c) left[c] -= side[c];
      x[i] = times_block(inverse_[i], left);
    }
    for (std::size_t i = 0; i < n; ++i) {
      residual[i] = sum_side(i, false, x);
      for (S& value : residual[i]) value = -value;
    }
    EXPECT_EQ(plain(z), x);
    EXPECT_EQ(plain(t), residual);

    const auto start = random_values();
    z = packed(start);
    x = start;
    sweep_backwards<Wide>(packed_, packed(right), z);
    for (std::size_t i = n; i-- > 0;) {
      Values left = right[i];
      for (const bool below : {true, false}) {
        const Values side = sum_side(i, below, x);
        for (std::size_t c = 0; c < D; ++c) left[c] -= side[c];
      }
      x[i] = times_block(inverse_[i], left);
    }
    EXPECT_EQ(plain(z), x);

    for (std::size_t i = 0; i < n; ++i) t[i] = row_product<Wide>(packed_, i, packed(start));
    for (std::size_t i = 0; i < n; ++i) {
      std::map<std::int32_t, double> small;
      std::size_t slot = rows_.scalars.first_slot(i);
      std::vector<std::pair<std::int32_t, S>> scalars;
      for (const std::int32_t j : rows_.scalars[i]) {
        const double value = rows_.scalar[slot++];
        if (to_size(j) != i && swept_.is_small(i, to_size(j), value)) scalars.emplace_back(j, static_cast<S>(value));
      }
      const Values below = sum_side(i, true, start), above = sum_side(i, false, start),
                   by_small = sum_scalars(scalars, start);
      Values own{};
      if (!rows_.blocks[i].empty()) own = times_block(entries(i).at(to_int32(i)).block, start[i]);
      for (std::size_t c = 0; c < D; ++c) product[i][c] = ((below[c] + above[c]) + own[c]) + by_small[c];
    }
    EXPECT_EQ(plain(t), product);
  }

  Random random_{5};
  LevelRows rows_;
  SweptScalars swept_;
  SweepOrder order_;
  PackedRows<D, S> packed_;
  std::vector<std::array<double, D * D>> blocks_;
  std::vector<Eigen::Matrix<S, D, D>> inverse_{n, Eigen::Matrix<S, D, D>::Zero()};
};

using Cases =
    testing::Types<Case<2, float, TwoFours<float>>, Case<3, float, TwoFours<float>>, Case<2, float, Eight>,
                   Case<3, float, Eight>, Case<2, double, TwoFours<double>>, Case<3, double, TwoFours<double>>>;
TYPED_TEST_SUITE(Packed, Cases, );

TYPED_TEST(Packed, SameBitsAsPlainLoops) { this->expect_same_bits(); }

/// Rows that grow and move, that shrink, and that end.
TYPED_TEST(Packed, SameBitsAfterChanges) {
  const std::vector<std::int32_t> changed{3, 20, 21, 40, 59};
  for (const int every : {2, 20}) {
    for (const std::int32_t i : changed) this->set_row(i, every);
    this->swept_.follow(this->rows_, changed);
    this->packed_.follow(this->rows_, this->swept_, this->order_,
                         this->order_.follow(this->rows_, this->swept_, changed));
    this->fill();
    this->expect_same_bits();
  }
}

}  // namespace
}  // namespace cutbench
