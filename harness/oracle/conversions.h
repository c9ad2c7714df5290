#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

/// As harness/base/conversions.h: the oracle shares no code with what it judges. Precondition: the value fits the kind
/// asked for.
namespace cutbench::oracle {

template <typename T>
concept Number = std::is_arithmetic_v<T> || std::is_enum_v<T>;

constexpr std::size_t to_size(Number auto n) { return static_cast<std::size_t>(n); }
constexpr int to_int(Number auto n) { return static_cast<int>(n); }
constexpr std::int32_t to_int32(Number auto n) { return static_cast<std::int32_t>(n); }
constexpr std::int64_t to_int64(Number auto n) { return static_cast<std::int64_t>(n); }
constexpr double to_double(Number auto n) { return static_cast<double>(n); }

/// A distance between iterators.
constexpr std::ptrdiff_t to_index(Number auto n) { return static_cast<std::ptrdiff_t>(n); }

}  // namespace cutbench::oracle
