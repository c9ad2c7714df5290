// Factors of a symmetric positive definite matrix, behind one interface: CHOLMOD's where SuiteSparse is there, and
// Eigen's.
#pragma once

#include <memory>
#include <string>

#include "harness/fem/linear/solver_options.h"
#include "harness/fem/linear/system_matrix.h"

namespace cutbench {

template <int D>
class Factor {
 public:
  virtual ~Factor() = default;
  /// Factors the rows and columns of unknowns that are not held. The analysis (pattern, order, symbolic factor) is kept
  /// for as long as the pattern and the held unknowns stay the same. False: not positive definite, or not finite.
  virtual bool factor(const SystemMatrix<D>& a) = 0;
  /// Whether factor() would make a new analysis of this matrix.
  virtual bool is_new(const SystemMatrix<D>& a) const = 0;
  /// x = A^-1 b for each column, zero where held. False where it fails. \pre the last factor() was true
  virtual bool solve(const Eigen::MatrixXd& b, Eigen::MatrixXd& x) = 0;
  virtual double largest_entry() const = 0;  ///< of the matrix, by size
};

/// What becomes of the order of elimination when the pattern has changed. `extended`: a vertex that is new follows the
/// last of its neighbours, and the others keep their places, until the factor has outgrown that of the last new order
/// by a quarter.
enum class FactorOrder { anew, extended };

/// Whether this build has CHOLMOD (CMake's CUTBENCH_CHOLMOD), and which; "none".
bool has_cholmod();
std::string cholmod_version();
/// Supernodal, in METIS order (cholmod_factor.h). Throws InputError where this build has none.
template <int D>
std::unique_ptr<Factor<D>> make_cholmod_factor(FactorOrder order);
/// Eigen::SimplicialLDLT in minimum degree order.
template <int D>
std::unique_ptr<Factor<D>> make_eigen_factor();

/// What preconditioners are made with.
template <int D>
std::unique_ptr<Factor<D>> make_factor(FactorBy by) {
  if (by == FactorBy::fastest && has_cholmod()) return make_cholmod_factor<D>(FactorOrder::anew);
  return make_eigen_factor<D>();
}

}  // namespace cutbench
