// A method by its name and number, as the C API gives them.
#pragma once

#include <cmath>
#include <memory>

#include "harness/cut/method_row.h"

namespace cutbench::live {

/// \param parameter  NaN: the method's default
inline std::unique_ptr<CuttingMethod> make_method(const MethodRow& row, double parameter) {
  return row.make(std::isnan(parameter) ? row.parameter.value : parameter);
}

}  // namespace cutbench::live
