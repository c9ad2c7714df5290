// A field of random values from -1 to 1.
#pragma once

#include <cstdint>

#include "harness/base/random.h"
#include "harness/fem/algebra/block_matrix.h"

namespace cutbench {

inline Field random_field(std::uint64_t seed, Eigen::Index size) {
  Random random(seed);
  Field f(size);
  for (double& value : f) value = random.between(-1, 1);
  return f;
}

}  // namespace cutbench
