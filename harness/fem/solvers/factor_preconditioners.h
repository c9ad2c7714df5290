// Preconditioners of conjugate gradients that factor a matrix seldom, and use the factor for many steps.
#pragma once

#include "harness/fem/linear/factor.h"
#include "harness/fem/linear/preconditioner.h"

namespace cutbench {

/// The factor of an older matrix (Courtecuisse et al., Real-time simulation of contact and cutting of heterogeneous
/// soft-tissues, Medical Image Analysis 18(2), 2014; there a second processor makes it, here the same one). It is made
/// anew where the pattern has changed, and after a solve that needed more than ten iterations.
template <int D>
class StaleFactor final : public Preconditioner<D> {
 public:
  using Preconditioner<D>::setup;
  explicit StaleFactor(FactorBy by = FactorBy::fastest) : factor_(make_factor<D>(by)) {}
  void setup(const SystemMatrix<D>& a) override;
  void apply(const Field& r, Field& z) override;

 private:
  std::unique_ptr<Factor<D>> factor_;
  bool factored_ = false;
  int uses_ = 0;  // since the last setup()
  Eigen::MatrixXd right_, solution_;
};

/// One factor that no rotation changes, as in the global step of local/global schemes: quasi-Newton methods (Liu,
/// Bouaziz and Kavan, Quasi-Newton methods for real-time simulation of hyperelastic materials, ACM TOG 36(3), 2017)
/// with the matrix of mass, Laplacian and bending. A co-rotational block R K R^T has the trace of K, and the traces of
/// a membrane's blocks are those of its Laplacian; so the matrix is that of the traces over D. It acts on each
/// coordinate alike: one factor of a D-th of the size, D right sides. It is made anew where the pattern, or the traces
/// by more than 1 %, have changed: another step, another material.
template <int D>
class ConstantFactor final : public Preconditioner<D> {
 public:
  using Preconditioner<D>::setup;
  explicit ConstantFactor(FactorBy by = FactorBy::fastest) : factor_(make_factor<1>(by)) {}
  void setup(const SystemMatrix<D>& a) override;
  void apply(const Field& r, Field& z) override;

 private:
  bool set_traces(const SystemMatrix<D>& a);

  BlockMatrix<1> traces_;
  SystemMatrix<1> matrix_;          // of the traces, and of A's scalar matrices
  std::vector<std::uint8_t> held_;  // per vertex: all its unknowns are held
  std::vector<double> factors_;     // of the scalar matrices
  const std::vector<std::uint8_t>* held_unknowns_ = nullptr;
  std::unique_ptr<Factor<1>> factor_;
  bool factored_ = false;
  Eigen::MatrixXd right_, solution_;
};

}  // namespace cutbench
