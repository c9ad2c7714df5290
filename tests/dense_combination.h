// What tests of tied vertices share: their combination as a dense matrix.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "harness/mesh/ties.h"

namespace cutbench {

/// C, dense, for `dimension` values per vertex and unknown.
inline Eigen::MatrixXd dense_combination(const Ties& ties, std::size_t vertices, Eigen::Index dimension) {
  const auto n = dimension * static_cast<Eigen::Index>(vertices);
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(n, n + dimension * static_cast<Eigen::Index>(ties.phantoms));
  c.leftCols(n).setIdentity();
  for (const Tie& tie : ties.ties)
    for (Eigen::Index k = 0; k < dimension; ++k) {
      const Eigen::Index row = dimension * tie.vertex.value + k;
      c(row, row) = 0;
      for (std::size_t l = 0; l < 3; ++l) c(row, dimension * tie.masters[l].value + k) += tie.weights[l];
    }
  return c;
}

}  // namespace cutbench
