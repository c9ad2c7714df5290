// Small clusters of vertices that are stiffer than the rest of the sheet: round slivers, and where edges are so
// short that bending, which grows with 1/length^2, exceeds all else. A cluster that moves against its neighbours hardly
// strains them, but the sweeps move one vertex at a time, so they take very many to find that out, and the hats of the
// coarse levels are too wide. Each cluster is therefore solved exactly, with its surroundings held: a subspace
// correction (Xu, SIAM Review 34(4), 1992) before and after that of the coarse levels.
#pragma once

#include <Eigen/Cholesky>
#include <vector>

#include "harness/fem/multigrid/packed_rows.h"

namespace cutbench {

template <int D>
class StiffClusters {
 public:
  /// Finds the clusters of a matrix with these rows. Call it whenever they have changed.
  /// \param sizes   per vertex: the trace of its diagonal block, 0 where its row is empty
  /// \param median  of the finite ones of rows that are not empty
  void find(const std::vector<double>& sizes, double median, const LevelRows& rows);
  /// Factors the blocks of the clusters; one that is not positive definite is left out.
  template <class S>
  void factor(const PackedRows<D, S>& a, const std::vector<std::uint8_t>& held);
  std::size_t size() const { return clusters_.size(); }
  /// Of all factors, over the matrix's own diagonal: 1 where there are none, 0 where one is not positive definite.
  double smallest_pivot() const { return smallest_pivot_; }

  template <class S>
  using Vector = PackedVector<S>;
  /// z += the corrections from the residual t, one cluster after the other; t stays the residual.
  template <class S>
  void correct_forwards(const PackedRows<D, S>& a, Vector<S>& z, Vector<S>& t);
  /// z += the corrections from the residual r - A z, in the reverse order.
  template <class S>
  void correct_backwards(const PackedRows<D, S>& a, const Vector<S>& r, Vector<S>& z);

 private:
  struct Cluster {
    std::vector<std::int32_t> vertices;
    std::vector<Eigen::Index> held;  ///< unknowns of it that are not corrected
    Eigen::LLT<Eigen::MatrixXd> factor;
    bool is_positive = false;
  };
  void solve(const Cluster& cluster);  // in correction_
  template <class S, class Visit>
  void for_each_outside(const PackedRows<D, S>& a, std::size_t vertex, const Visit& visit) const;

  std::vector<Cluster> clusters_;
  std::vector<std::int32_t> cluster_of_;  // per vertex: its number, or -1
  double smallest_pivot_ = 1;
  // Working storage.
  std::vector<std::int32_t> place_;  // per vertex: in the cluster at hand, or -1
  std::vector<std::uint8_t> is_stiff_;
  Eigen::VectorXd correction_;
};

}  // namespace cutbench
