#include "harness/cut/method_row.h"

#include <cmath>
#include <cstdio>

#include "harness/base/errors.h"

namespace cutbench {

namespace {

std::string text_of(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%g", value);
  return buffer;
}

}  // namespace

bool Range::has(double value) const {
  if (!std::isfinite(value) || (whole && value != std::floor(value))) return false;
  return (or_zero && value == 0) || (value >= least && value <= most);
}

std::string Range::text() const {
  std::string text = or_zero ? "0, or " : "";
  text += whole ? "a whole number" : "a number";
  const bool is_bounded_below = std::isfinite(least), is_bounded_above = std::isfinite(most);
  if (is_bounded_below && is_bounded_above) return text + " from " + text_of(least) + " to " + text_of(most);
  if (is_bounded_below) return text + " of at least " + text_of(least);
  if (is_bounded_above) return text + " of at most " + text_of(most);
  return text;
}

std::unique_ptr<CuttingMethod> MethodRow::make(double value) const {
  if (!parameter.name.empty() && !parameter.range.has(value))
    throw InputError(name + ": " + parameter.name + " must be " + parameter.range.text() + ", not " + text_of(value) +
                     "; the default is " + text_of(parameter.value));
  return factory(value);
}

}  // namespace cutbench
