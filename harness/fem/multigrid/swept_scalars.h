// Which scalars the sweeps of a level take.
//
// Bending couples each vertex to some 35 others, most of them hardly at all. So the sweeps are those of a matrix
// without the small scalars. These are added to its diagonal, and a row times a translation stays what it was. Coarser
// levels are made of that matrix, too.
#pragma once

#include <algorithm>
#include <cmath>

#include "harness/fem/multigrid/level_rows.h"

namespace cutbench {

class SweptScalars {
 public:
  /// Takes the scalars of these rows that are not small.
  void follow(const LevelRows& rows, std::span<const std::int32_t> changed);
  void follow(const LevelRows& rows);  ///< all rows, with room to grow by half
  std::size_t size() const { return near_.size(); }

  /// Columns of the scalars that are not small, in the order of the sweeps.
  const SweepRows& rows() const { return near_; }
  /// Per slot of rows(). On the diagonal the small ones are added.
  const std::vector<double>& values() const { return values_; }
  /// What the diagonal of row i has more: the sum of its small scalars.
  double left_out(std::size_t i) const { return left_out_[i]; }
  /// Whether a scalar beside the diagonal is small. Both rows of an entry leave it out, or none does.
  bool is_small(std::size_t i, std::size_t j, double value) const {
    return std::abs(value) < small * std::min(scale_[i], scale_[j]);
  }

 private:
  static constexpr double small = 0.01;  // of the smaller of two rows' scales

  void find_scales(const LevelRows& rows, std::span<const std::int32_t> changed);
  void take(const LevelRows& rows, std::size_t i);

  SweepRows near_;
  std::vector<double> values_;
  std::vector<double> scale_;  // per row: what its scalars are compared with; 0 where it is empty
  double median_scale_ = 0;
  std::vector<double> left_out_;       // per row
  std::vector<std::int32_t> columns_;  // working storage of take(), with the next
  std::vector<double> taken_;
};

}  // namespace cutbench
