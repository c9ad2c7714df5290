#include "harness/fem/linear/conjugate_gradients.h"
#include "harness/fem/linear/linear_solver.h"
#include "harness/fem/multigrid/multigrid.h"
#include "harness/fem/solvers/cholmod_solver.h"
#include "harness/fem/solvers/eigen_solvers.h"
#include "harness/fem/solvers/factor_preconditioners.h"
#include "harness/fem/solvers/sliver_blocks.h"
#include "harness/mesh/mesh_data.h"

namespace cutbench {

namespace {

template <int D>
struct SolverRow {
  const char* name;
  std::unique_ptr<LinearSolver<D>> (*make)(const SolverOptions&);
};

template <int D, class... Preconditioners>
std::unique_ptr<LinearSolver<D>> conjugate_gradients(const SolverOptions& options) {
  std::vector<typename ConjugateGradients<D>::Trial> trials;
  (trials.push_back({.preconditioner = std::make_unique<Preconditioners>()}), ...);
  return std::make_unique<ConjugateGradients<D>>(options, std::move(trials));
}

/// Where a sheet is cut to pieces the V-cycle stalls; the constant factor does not, but costs more where the cycle works.
template <int D>
std::unique_ptr<LinearSolver<D>> multigrid(const SolverOptions& options) {
  std::vector<typename ConjugateGradients<D>::Trial> trials;
  trials.push_back({.preconditioner = std::make_unique<Multigrid<D>>(), .most_iterations = 100});
  trials.push_back({.preconditioner = std::make_unique<ConstantFactor<D>>()});
  return std::make_unique<ConjugateGradients<D>>(options, std::move(trials));
}

template <int D, FactorOrder order>
std::unique_ptr<LinearSolver<D>> cholmod(const SolverOptions&) {
  return std::make_unique<CholmodSolver<D>>(order);
}

template <int D, EigenPreconditioner preconditioner>
std::unique_ptr<LinearSolver<D>> eigen_cg(const SolverOptions& options) {
  return make_eigen_cg<D>(options, preconditioner);
}

template <int D>
constexpr SolverRow<D> rows[] = {
    {"cg", conjugate_gradients<D>},
    {"cg_sliver_blocks", conjugate_gradients<D, SliverBlocks<D>>},
    {"multigrid", multigrid<D>},
    {"cholmod", cholmod<D, FactorOrder::anew>},
    {"cholmod_same_order", cholmod<D, FactorOrder::extended>},
    {"cholmod_stale", conjugate_gradients<D, StaleFactor<D>>},
    {"local_global", conjugate_gradients<D, ConstantFactor<D>>},
    {"eigen_cg", eigen_cg<D, EigenPreconditioner::diagonal>},
    {"eigen_cg_ichol", eigen_cg<D, EigenPreconditioner::incomplete_cholesky>},
    {"eigen_ldlt", [](const SolverOptions&) { return make_eigen_ldlt<D>(); }},
};

}  // namespace

const std::vector<std::string>& solver_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& row : rows<2>) all.emplace_back(row.name);
    return all;
  }();
  return names;
}

template <int D>
std::unique_ptr<LinearSolver<D>> make_solver(const SolverOptions& options) {
  std::string known;
  for (const auto& row : rows<D>) {
    if (options.name == row.name) return row.make(options);
    known += (known.empty() ? "" : ", ") + std::string(row.name);
  }
  throw InputError("unknown solver \"" + options.name + "\"; known are " + known);
}

template std::unique_ptr<LinearSolver<2>> make_solver(const SolverOptions&);
template std::unique_ptr<LinearSolver<3>> make_solver(const SolverOptions&);

void project(const std::vector<std::uint8_t>& held, const Eigen::Ref<const Field>& b, Field& projected) {
  projected.resize(b.size());
  for (Eigen::Index u = 0; u < b.size(); ++u) projected[u] = held[static_cast<std::size_t>(u)] ? 0 : b[u];
}

}  // namespace cutbench
