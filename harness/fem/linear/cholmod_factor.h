// Supernodal Cholesky factorisation by CHOLMOD (Chen, Davis, Hager and Rajamanickam, ACM TOMS 35(3), 2008) in METIS
// ordering (Karypis and Kumar, SIAM J. Sci. Comput. 20(1), 1998), on one thread.
#pragma once

#include <memory>

#include "harness/fem/linear/system_matrix.h"

namespace cutbench {

/// What becomes of the order of elimination when the pattern has changed. `extended`: a vertex that is new follows the
/// last of its neighbours, and the others keep their places, until the factor has outgrown that of the last new order
/// by a quarter.
enum class FactorOrder { anew, extended };

template <int D>
class CholmodFactor {
 public:
  explicit CholmodFactor(FactorOrder order = FactorOrder::anew);
  ~CholmodFactor();
  /// Factors the rows and columns of unknowns that are not held. The analysis (pattern, order, symbolic factor) is kept
  /// for as long as the pattern and the held unknowns stay the same. False: not positive definite, or not finite.
  bool factor(const SystemMatrix<D>& a);
  /// Whether factor() would make a new analysis of this matrix.
  bool is_new(const SystemMatrix<D>& a) const;
  /// x = A^-1 b for each column, zero where held. False where it fails. \pre the last factor() was true
  bool solve(const Eigen::MatrixXd& b, Eigen::MatrixXd& x);
  double largest_entry() const;  ///< of the matrix, by size
  std::size_t new_orders() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace cutbench
