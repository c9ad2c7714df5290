// Preconditioner blocks of the vertices that slivers join. In an element of aspect ratio r, vertices are coupled r
// times more strongly than in a good one; blocks of single vertices don't see that, and the iterations grow with r.
//
// Each pair of vertices of an element with AR > 10 is a join, weighted by 2 area |gradient| |gradient| of the two: how
// strongly the element couples them, at most its AR. Joins are made strongest first (of equal ones, lower vertices
// first); one that would make a group of more than 32 vertices is left out. So all vertices of a sliver are in one
// group unless the limit forbids it, and what is too long, such as a row of slivers along a line, is parted at its
// weakest joins.
#pragma once

#include <Eigen/Cholesky>
#include <cstdint>
#include <vector>

#include "harness/base/union_find.h"
#include "harness/fem/linear/preconditioner.h"

namespace cutbench {

template <int D>
class SliverBlocks final : public Preconditioner<D> {
 public:
  using Preconditioner<D>::setup;
  static constexpr double good_aspect_ratio = 10;  ///< up to here an element costs CG at most a fifth more iterations
  static constexpr std::int32_t largest_group = 32;

  struct Group {
    std::vector<std::int32_t> vertices;
    Eigen::LLT<Eigen::MatrixXd> factor;  ///< of the block of A; identity for held unknowns
  };

  /// Finds the groups from a.elements (none where they are not known) and factors their blocks. A group whose block is
  /// not positive definite is dropped.
  void setup(const SystemMatrix<D>& a) override;
  /// Changes z at the vertices in groups, to block^-1 r.
  void apply(const Field& r, Field& z) override;
  const std::vector<Group>& groups() const { return groups_; }

 private:
  void find_groups(const CoupledElements& elements);
  void factor(const SystemMatrix<D>& a, Group& group);

  std::vector<Group> groups_;
  // Working storage. Per vertex:
  UnionFind joined_;                 ///< the groups
  std::vector<std::int32_t> group_;  ///< -1: in none
  std::vector<std::int32_t> place_;  ///< in its group
  std::vector<StrongCoupling> joins_;
  Eigen::MatrixXd block_;
  Eigen::VectorXd gathered_;
};

}  // namespace cutbench
