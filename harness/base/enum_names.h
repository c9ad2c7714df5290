// The names of an enum's values, in one table for reading and writing.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace cutbench {

template <class E>
struct EnumName {
  E value;
  const char* name;
};
template <class E, std::size_t N>
using EnumNames = std::array<EnumName<E>, N>;

/// \pre the table has the value; every enum's table has all.
template <class E, std::size_t N>
constexpr const char* name_of(const EnumNames<E, N>& names, E value) {
  for (const auto& entry : names)
    if (entry.value == value) return entry.name;
  return "unknown";
}

/// None: no value has that name.
template <class E, std::size_t N>
constexpr std::optional<E> value_named(const EnumNames<E, N>& names, std::string_view name) {
  for (const auto& entry : names)
    if (entry.name == name) return entry.value;
  return {};
}

}  // namespace cutbench
