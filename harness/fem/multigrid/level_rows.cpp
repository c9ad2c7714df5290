#include "harness/fem/multigrid/level_rows.h"

#include <algorithm>
#include <utility>

#include "harness/base/conversions.h"

namespace cutbench {

auto SweepRows::set(std::size_t i, std::span<const std::int32_t> columns) -> Placed {
  // Which side a column is on is a coin toss: branches would cost more than writing everything twice.
  const auto own = to_int32(i);
  const auto n = to_int32(columns.size());
  order_.resize(2 * columns.size() + 2);
  std::int32_t below = 0, above = n + 1, at = -1;
  for (std::int32_t k = 0; k < n; ++k) {
    const std::int32_t j = columns[to_size(k)];
    order_[to_size(below)] = order_[to_size(above)] = k;
    below += j < own;
    above += j > own;
    at = j == own ? k : at;
  }
  below_[i] = static_cast<std::uint32_t>(below);
  if (at >= 0) order_[to_size(below++)] = at;
  std::copy(order_.begin() + n + 1, order_.begin() + above, order_.begin() + below);
  order_.resize(columns.size());
  ordered_.resize(columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k) ordered_[k] = columns[to_size(order_[k])];
  const bool is_new = !std::equal(ordered_.begin(), ordered_.end(), columns_[i].begin(), columns_[i].end());
  if (is_new) columns_.set(i, ordered_);
  return {order_, is_new};
}

bool LevelRows::set_scalars(std::size_t i, std::span<const std::int32_t> columns, std::span<const double> values) {
  const auto [order, is_new] = scalars.set(i, columns);
  scalar.resize(scalars.slots());
  double* to = scalar.data() + scalars.first_slot(i);
  bool changes = is_new;
  for (const std::int32_t place : order) {
    const double value = values[to_size(place)];
    changes |= std::exchange(*to++, value) != value;
  }
  return changes;
}

}  // namespace cutbench
