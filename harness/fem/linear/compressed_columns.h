// The matrix of a linear solve in the form that sparse libraries take.
#pragma once

#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/fem/linear/system_matrix.h"

namespace cutbench {

/// The lower triangle in compressed columns, over all unknowns. Held unknowns have 1 on the diagonal and nothing else.
template <int D>
class CompressedColumns {
 public:
  bool has_pattern(const SystemMatrix<D>& a) const;
  /// False where it has this pattern already.
  bool set_pattern(const SystemMatrix<D>& a);
  void set_values(const SystemMatrix<D>& a);
  double largest() const {  ///< |entry|, which no norm of the matrix is below
    double all = 0;
    for (const double v : values_) all = std::max(all, std::abs(v));
    return all;
  }
  bool all_finite() const { return Eigen::Map<const Field>(values_.data(), to_index(values_.size())).allFinite(); }
  std::size_t unknowns() const { return begin_.size() - 1; }
  Eigen::Map<const Eigen::SparseMatrix<double>> lower_triangle() const {  ///< refers to this
    const auto n = to_index(unknowns());
    return {n, n, to_index(rows_.size()), begin_.data(), rows_.data(), values_.data()};
  }
  /// Where each column begins, and its end; the row of each entry, rising in a column; the entries.
  const std::vector<std::int32_t>& begin() const { return begin_; }
  const std::vector<std::int32_t>& rows() const { return rows_; }
  const std::vector<double>& values() const { return values_; }
  /// The lower triangle of the pattern per vertex, likewise. Unknowns of one vertex share their neighbours: an order of
  /// the vertices serves them as well, and costs a D-th.
  const std::vector<std::int32_t>& graph_begin() const { return graph_begin_; }
  const std::vector<std::int32_t>& graph_rows() const { return graph_rows_; }

 private:
  /// Element `from` of a part's blocks, counted through all of them, is added to values_[to].
  struct Copy {
    std::int32_t from, to;
  };
  struct Source {
    std::int32_t column, part, slot;  ///< part 0: the blocks; k: scalar term k - 1
    bool operator<(const Source& other) const {
      return column != other.column ? column < other.column : part < other.part;
    }
  };
  void add_column(std::int32_t column, int coordinate);

  std::vector<std::int32_t> begin_, rows_;
  std::vector<double> values_;
  std::vector<std::int32_t> graph_begin_, graph_rows_;
  std::vector<std::int32_t> ones_;         // places of the held unknowns in values_
  std::vector<std::vector<Copy>> copies_;  // per part
  std::vector<Source> sources_;            // of one vertex, by column
  // What the pattern was made from.
  std::uint64_t pattern_ = 0;
  std::vector<std::uint8_t> held_;
  std::vector<const void*> parts_;
};

}  // namespace cutbench
