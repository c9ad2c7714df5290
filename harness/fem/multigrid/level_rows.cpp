#include "harness/fem/multigrid/level_rows.h"

#include <algorithm>
#include <utility>

namespace cutbench {

auto SweepRows::set(std::size_t i, std::span<const std::int32_t> columns) -> Placed {
  // Which side a column is on is a coin toss: branches would cost more than writing everything twice.
  const auto own = static_cast<std::int32_t>(i);
  const auto n = static_cast<std::int32_t>(columns.size());
  order_.resize(2 * columns.size() + 2);
  std::int32_t below = 0, above = n + 1, at = -1;
  for (std::int32_t k = 0; k < n; ++k) {
    const std::int32_t j = columns[static_cast<std::size_t>(k)];
    order_[static_cast<std::size_t>(below)] = order_[static_cast<std::size_t>(above)] = k;
    below += j<own, above += j> own;
    at = j == own ? k : at;
  }
  below_[i] = static_cast<std::uint32_t>(below);
  if (at >= 0) order_[static_cast<std::size_t>(below++)] = at;
  std::copy(order_.begin() + n + 1, order_.begin() + above, order_.begin() + below);
  order_.resize(columns.size()), ordered_.resize(columns.size());
  for (std::size_t k = 0; k < columns.size(); ++k) ordered_[k] = columns[static_cast<std::size_t>(order_[k])];
  const bool is_new = !std::ranges::equal(columns_[i], ordered_);
  if (is_new) columns_.set(i, ordered_);
  return {order_, is_new};
}

bool LevelRows::set_scalars(std::size_t i, std::span<const std::int32_t> columns, std::span<const double> values) {
  const auto [order, is_new] = scalars.set(i, columns);
  scalar.resize(scalars.slots());
  double* to = scalar.data() + scalars.first_slot(i);
  bool changes = is_new;
  for (const std::int32_t place : order) {
    const double value = values[static_cast<std::size_t>(place)];
    changes |= std::exchange(*to++, value) != value;
  }
  return changes;
}

}  // namespace cutbench
