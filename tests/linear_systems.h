// What tests of linear solvers share: systems as dense matrices, the same as the solvers want them, and one solve.
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/base/random.h"
#include "harness/fem/elements/element_table.h"
#include "harness/fem/linear/linear_solver.h"
#include "harness/fem/solvers/solver_table.h"

namespace cutbench {

/// A system as dense matrices, from which the sparse ones are made: `blocks` over all unknowns, `scalar` over vertices.
template <int D>
struct System {
  Eigen::MatrixXd blocks;
  struct Scalar {
    double factor;
    Eigen::MatrixXd matrix;
  };
  std::vector<Scalar> scalar;
  std::vector<std::uint8_t> held;
  ElementTable elements;

  Eigen::Index vertices() const { return blocks.rows() / D; }
  bool is_held(Eigen::Index u) const { return held[to_size(u)] != 0; }
  /// Everything added up; held unknowns have rows and columns of the identity.
  Eigen::MatrixXd dense() const {
    Eigen::MatrixXd all = blocks;
    for (const auto& [factor, matrix] : scalar)
      for (Eigen::Index i = 0; i < vertices(); ++i)
        for (Eigen::Index j = 0; j < vertices(); ++j)
          all.block<D, D>(D * i, D * j).diagonal().array() += factor * matrix(i, j);
    for (Eigen::Index u = 0; u < all.rows(); ++u)
      if (is_held(u)) {
        all.row(u).setZero();
        all.col(u).setZero();
        all(u, u) = 1;
      }
    return all;
  }
  Field projected(Field b) const {
    for (Eigen::Index u = 0; u < b.size(); ++u)
      if (is_held(u)) b[u] = 0;
    return b;
  }
  Field oracle(const Field& b) const { return dense().llt().solve(projected(b)); }
  double residual(const Field& b, const Field& x) const {
    return (projected(b) - dense() * x).norm() / projected(b).norm();
  }
};

/// The same as the solvers want it. Blocks of zeros are not in the pattern, and columns come in no order.
template <int D>
class Sparse {
 public:
  explicit Sparse(const System<D>& system) : scalar_(system.scalar.size()) { assign(system); }
  Sparse(const Sparse&) = delete;
  Sparse& operator=(const Sparse&) = delete;
  void assign(const System<D>& system) {
    fill(system.blocks, blocks_);
    for (std::size_t k = 0; k < scalar_.size(); ++k) fill(system.scalar[k].matrix, scalar_[k]);
    held_ = system.held;
    elements_ = system.elements;
    matrix_.blocks = &blocks_;
    matrix_.held = &held_;
    matrix_.elements = &elements_;
    matrix_.scalar.clear();
    for (std::size_t k = 0; k < scalar_.size(); ++k) matrix_.scalar.push_back({system.scalar[k].factor, &scalar_[k]});
  }
  SystemMatrix<D>& matrix() { return matrix_; }

 private:
  template <int B>
  static void fill(const Eigen::MatrixXd& from, BlockMatrix<B>& to) {
    const Eigen::Index n = from.rows() / B;
    to.resize(to_size(n));
    for (Eigen::Index i = 0; i < n; ++i) {
      std::vector<std::int32_t> columns;
      for (Eigen::Index j = n - 1; j >= 0; --j)
        if (!from.template block<B, B>(B * i, B * j).isZero(0)) columns.push_back(to_int32(j));
      const auto diagonal = std::find(columns.begin(), columns.end(), to_int32(i));
      if (diagonal != columns.end()) std::iter_swap(columns.begin(), diagonal);
      const auto row = to_size(i);
      to.set_row(row, columns);
      for (std::int32_t j : columns) to.block(to.find(row, j)) = from.template block<B, B>(B * i, B * j);
    }
  }

  BlockMatrix<D> blocks_;
  std::deque<BlockMatrix<1>> scalar_;
  std::vector<std::uint8_t> held_;
  ElementTable elements_;
  SystemMatrix<D> matrix_;
};

/// Symmetric, positive definite by dominance, on the graph of a grid of `side` x `side` vertices, those at most `reach`
/// apart along both axes joined. b x b blocks.
inline Eigen::MatrixXd random_matrix(Random& random, int side, int reach, int b) {
  const Eigen::Index n = side * side;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(b * n, b * n);
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < i; ++j) {
      if (std::abs(i % side - j % side) > reach || std::abs(i / side - j / side) > reach) continue;
      for (Eigen::Index k = 0; k < b; ++k)
        for (Eigen::Index l = 0; l < b; ++l) a(b * i + k, b * j + l) = a(b * j + l, b * i + k) = random.between(-1, 1);
    }
  for (Eigen::Index u = 0; u < b * n; ++u) a(u, u) = a.row(u).cwiseAbs().sum() + random.between(0.05, 0.15);
  return a;
}

/// Every solver; those whose preconditioner is a factor with Eigen's as well.
inline std::vector<SolverOptions> all_solvers() {
  std::vector<SolverOptions> all;
  for (const std::string& name : solver_names()) {
    all.push_back({.name = name});
    if (name == "multigrid" || name == "cholmod_stale" || name == "constant_factor")
      all.push_back({.name = name, .factor = FactorBy::eigen});
  }
  return all;
}

template <int D>
struct Solved {
  Field x;
  SolveReport report;
};

template <int D>
Solved<D> solved(LinearSolver<D>& solver, const SystemMatrix<D>& a, const Field& b) {
  Solved<D> s;
  solver.setup(a);
  s.report = solver.solve(b, s.x);
  return s;
}

template <int D>
Solved<D> solved(const SolverOptions& options, const System<D>& system, const Field& b) {
  Sparse<D> sparse(system);
  return solved(*make_solver<D>(options), sparse.matrix(), b);
}

}  // namespace cutbench
