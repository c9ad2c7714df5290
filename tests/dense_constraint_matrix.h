// What tests of constrained vertices share: their constraint_matrix as a dense matrix.
#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "harness/base/conversions.h"
#include "harness/mesh/constraints.h"

namespace cutbench {

/// C, dense, for `dimension` values per vertex and unknown.
inline Eigen::MatrixXd dense_constraint_matrix(const Constraints& constraints, std::size_t vertices,
                                               Eigen::Index dimension) {
  const auto n = dimension * to_index(vertices);
  Eigen::MatrixXd c = Eigen::MatrixXd::Zero(n, n + dimension * to_index(constraints.phantoms.size()));
  c.leftCols(n).setIdentity();
  for (const Constraint& constraint : constraints.constraints)
    for (Eigen::Index k = 0; k < dimension; ++k) {
      const Eigen::Index row = dimension * constraint.vertex.value + k;
      c(row, row) = 0;
      for (std::size_t l = 0; l < 3; ++l) c(row, dimension * constraint.masters[l].value + k) += constraint.weights[l];
    }
  return c;
}

}  // namespace cutbench
