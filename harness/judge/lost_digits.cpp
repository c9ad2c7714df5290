#include "harness/judge/lost_digits.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

enum class Shortened { no, possibly, surely };  ///< possibly: so short that it may be exact, like 0.5

Shortened as_float(double x) {
  if (x != to_double(static_cast<float>(x))) return Shortened::no;
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent) * 65536;
  return mantissa == std::floor(mantissa) ? Shortened::possibly : Shortened::surely;
}

Shortened as_decimal(double x, int digits) {
  const auto is_rounded = [x](int n) {
    char text[400];
    std::snprintf(text, sizeof text, "%.*f", n, x);
    return std::strtod(text, nullptr) == x;
  };
  if (!is_rounded(digits)) return Shortened::no;
  return is_rounded(digits - 2) ? Shortened::possibly : Shortened::surely;
}

template <class Kind>
bool all_are(const std::set<double>& numbers, Kind kind) {
  int surely = 0;
  for (const double x : numbers) {
    const Shortened s = kind(x);
    if (s == Shortened::no) return false;
    surely += s == Shortened::surely;
  }
  return surely >= 4;
}

}  // namespace

std::string lost_digits(const std::vector<oracle::Point>& points, const std::set<double>& known) {
  std::set<double> numbers;
  for (const oracle::Point& p : points)
    for (const double x : p)
      if (!known.contains(x)) numbers.insert(x);
  if (all_are(numbers, as_float)) return "in single precision";
  for (const int digits : {5, 6, 7, 8})
    if (all_are(numbers, [digits](double x) { return as_decimal(x, digits); }))
      return "with " + std::to_string(digits) + " decimals";
  return {};
}

}  // namespace cutbench
