// Which vertices a matrix couples far more strongly than others, for preconditioners that look at shapes.
#pragma once

#include <cstdint>
#include <vector>

namespace cutbench {

/// A pair of vertices of a thin element.
struct StrongCoupling {
  double weight;      ///< 2 area |gradient| |gradient| of the two, at most the element's aspect ratio
  std::int32_t a, b;  ///< a < b
};

/// The elements that a matrix was assembled from.
class CoupledElements {
 public:
  virtual ~CoupledElements() = default;
  /// Adds the pairs of the elements whose aspect ratio is above this, element by element.
  virtual void add_strong_couplings(double aspect_ratio, std::vector<StrongCoupling>& all) const = 0;
};

}  // namespace cutbench
