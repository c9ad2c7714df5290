// M^-1 for explicit steps where mass was added to thin elements (added_mass.h): only the vertices near them are
// coupled, in groups along the cuts, so that they are factored once after a cut, and the rest is divided.
#pragma once

#include <Eigen/SparseCholesky>
#include <array>
#include <vector>

#include "harness/fem/algebra/block_matrix.h"

namespace cutbench {

template <int D>
class MassSolver {
 public:
  /// Factors lumped + added for the vertices with added mass, without held unknowns. Cost: grows with all cuts so far.
  void setup(const FieldView& lumped, const BlockMatrix<1>& added, const std::vector<std::uint8_t>& held);
  /// dv = M^-1 p at the unknowns of those vertices that are not held; the others stay. \pre p has what held unknowns
  /// take along subtracted: p - M dv of them.
  void solve(const Field& p, Field& dv);

 private:
  /// Of the axes that hold the same vertices.
  struct Group {
    std::vector<std::int32_t> vertices;  ///< not held, with added mass
    std::vector<int> axes;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor;
    Eigen::MatrixXd values;  ///< working storage: a column for each axis
  };
  std::array<Group, D> groups_;
  std::size_t used_ = 0;
};

}  // namespace cutbench
