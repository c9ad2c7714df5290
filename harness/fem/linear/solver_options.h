// How a system is to be solved: what a scene says of it. Needs none of the headers of linear algebra.
#pragma once

#include <optional>
#include <string>

namespace cutbench {

/// What preconditioners are made with: the fastest that this build has, or Eigen's all the same.
enum class FactorBy { fastest, eigen };

struct SolverOptions {
  std::string name = "cg";  ///< of harness/fem/solvers/solver_table.h
  double tolerance = 1e-2;  ///< of |b - A x| / |b|; a direct solver ignores it
  int max_iterations = 10000;
  FactorBy factor = FactorBy::fastest;  ///< of preconditioners that factor a matrix
  /// Of conjugate gradients, of `multigrid`, and of a step's loops over vertices and elements. They change no bit of
  /// any result. Where nobody says: one. WebAssembly has one in any case.
  std::optional<int> threads = {};
};

}  // namespace cutbench
