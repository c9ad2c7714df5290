// The linear system of a sheet at rest in its plane with functions for its tips (tip_functions.h): two more block rows,
//   [ K_uu  K_uc ] [ u ]   [ f ]
//   [ K_cu  K_cc ] [ c ] = [ 0 ],
// with K_uu that of the sheet alone. Loads act on the border, where the functions are zero.
#pragma once

#include <Eigen/Core>

#include "harness/fem/elements/element_table.h"
#include "harness/fem/elements/membrane.h"
#include "harness/fem/linear/linear_solver.h"
#include "harness/fem/tips/tip_functions.h"

namespace cutbench {

class TipSystem {
 public:
  /// In an element of several triangles K_uc is of its linear map. \param lame  of the sheet, per thickness
  TipSystem(const Sheet& sheet, const ElementTable& elements, const TipFunctions& functions, const Lame& lame);

  /// J: the part of the energy that is not of u alone, u' K_uc c + c' K_cc c / 2.
  double energy(const Field& u, const Eigen::VectorXd& c) const;

  /// By block elimination: S = K_cc - K_cu K_uu^-1 K_uc, S c = -K_cu given - K_cu K_uu^-1 right,
  /// u = K_uu^-1 (right - K_uc c). One solve for `right` and one for each function.
  /// \param solver  set up for K_uu
  /// \param given   values of the held vertices, zero elsewhere
  /// \param right   f - K_uu given
  /// \param u       zero where held
  /// \return of all solves together; not converged either where S is not positive definite
  SolveReport solve(LinearSolver<2>& solver, const Field& given, const Field& right, Field& u,
                    Eigen::VectorXd& c) const;

 private:
  Eigen::MatrixXd border_, corner_;  // K_uc and K_cc
};

}  // namespace cutbench
