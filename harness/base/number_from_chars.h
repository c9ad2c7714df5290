// std::from_chars and std::to_chars for double, which libc++ has from versions 20 and 14 on.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <type_traits>

namespace cutbench {

/// As std::from_chars; without it by strtod, so in the C locale only.
inline std::from_chars_result number_from_chars(const char* first, const char* last, double& value) {
#ifdef __cpp_lib_to_chars
  return std::from_chars(first, last, value);
#else
  const std::string text(first, last);
  // What strtod takes and from_chars does not: space or a plus in front, hexadecimal digits.
  if (text.find_first_of(" \t\n\v\f\r+") == 0 || text.find_first_of("xX") != std::string::npos)
    return {first, std::errc::invalid_argument};
  char* end = nullptr;
  const double read = std::strtod(text.c_str(), &end);
  const auto length = end - text.c_str();
  if (length == 0) return {first, std::errc::invalid_argument};
  const bool names_infinity = std::string_view(text).find_first_of("iI") != std::string_view::npos;
  const bool is_zero = text.substr(0, text.find_first_of("eE")).find_first_of("123456789") == std::string::npos;
  if ((std::isinf(read) && !names_infinity) || (read == 0 && !is_zero))
    return {first + length, std::errc::result_out_of_range};
  value = read;
  return {first + length, std::errc()};
#endif
}

/// The end of the shortest text that reads back the same bits; without std::to_chars by snprintf, which may write
/// another one of them (1e+06 for 1000000).
template <class Number>
char* number_to_chars(char* first, char* last, Number value) {
#ifndef __cpp_lib_to_chars
  if constexpr (std::is_floating_point_v<Number>) {
    int length = 0;
    double read = 0;
    for (int digits = 1; digits <= 17; ++digits) {
      length = std::snprintf(first, static_cast<std::size_t>(last - first), "%.*g", digits, value);
      number_from_chars(first, first + length, read);
      if (read == value) break;
    }
    return first + length;
  } else
#endif
    return std::to_chars(first, last, value).ptr;
}

}  // namespace cutbench
