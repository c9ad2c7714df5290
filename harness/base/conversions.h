#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

/// Conversions between kinds of numbers, with names short enough for an index. Precondition: the value fits the kind
/// asked for, as with static_cast.
namespace cutbench {

template <typename T>
concept Number = std::is_arithmetic_v<T> || std::is_enum_v<T>;

constexpr std::size_t to_size(Number auto n) { return static_cast<std::size_t>(n); }
constexpr int to_int(Number auto n) { return static_cast<int>(n); }
constexpr std::int32_t to_int32(Number auto n) { return static_cast<std::int32_t>(n); }
constexpr std::int64_t to_int64(Number auto n) { return static_cast<std::int64_t>(n); }
constexpr double to_double(Number auto n) { return static_cast<double>(n); }

/// An index of Eigen, or a distance between iterators: both are std::ptrdiff_t.
constexpr std::ptrdiff_t to_index(Number auto n) { return static_cast<std::ptrdiff_t>(n); }

}  // namespace cutbench
