#include "harness/fem/solvers/solver_table.h"

#include <algorithm>

#include "harness/base/errors.h"
#include "harness/base/names.h"
#include "harness/fem/linear/conjugate_gradients.h"
#include "harness/fem/multigrid/multigrid.h"
#include "harness/fem/solvers/eigen_cg.h"
#include "harness/fem/solvers/factor_preconditioners.h"
#include "harness/fem/solvers/factor_solver.h"
#include "harness/fem/solvers/sliver_blocks.h"

namespace cutbench {

namespace {

template <int D>
using Solver = std::unique_ptr<LinearSolver<D>>;
template <int D>
using Trials = std::vector<typename ConjugateGradients<D>::Trial>;

template <int D>
Solver<D> conjugate_gradients(const SolverOptions& options, Workers& workers,
                              std::unique_ptr<Preconditioner<D>> preconditioner) {
  Trials<D> trials;
  trials.push_back({.preconditioner = std::move(preconditioner)});
  return std::make_unique<ConjugateGradients<D>>(options, std::move(trials), workers);
}

template <int D>
Solver<D> plain(const SolverOptions& options, Workers& workers) {
  return std::make_unique<ConjugateGradients<D>>(options, Trials<D>{}, workers);
}

template <int D>
Solver<D> sliver_blocks(const SolverOptions& options, Workers& workers) {
  return conjugate_gradients<D>(options, workers, std::make_unique<SliverBlocks<D>>());
}

template <int D>
Solver<D> stale_factor(const SolverOptions& options, Workers& workers) {
  return conjugate_gradients<D>(options, workers, std::make_unique<StaleFactor<D>>(options.factor));
}

template <int D>
Solver<D> constant_factor(const SolverOptions& options, Workers& workers) {
  return conjugate_gradients<D>(options, workers, std::make_unique<ConstantFactor<D>>(options.factor));
}

/// Where a sheet is cut to pieces the V-cycle stalls; the constant factor does not, but costs more where the cycle
/// works.
template <int D>
Solver<D> multigrid(const SolverOptions& options, Workers& workers) {
  Trials<D> trials;
  trials.push_back({.preconditioner = std::make_unique<Multigrid<D>>(workers), .most_iterations = 100});
  trials.push_back({.preconditioner = std::make_unique<ConstantFactor<D>>(options.factor)});
  return std::make_unique<ConjugateGradients<D>>(options, std::move(trials), workers);
}

template <int D, FactorOrder order>
Solver<D> cholmod(const SolverOptions&, Workers&) {
  return std::make_unique<FactorSolver<D>>(make_cholmod_factor<D>(order));
}

template <int D>
Solver<D> eigen_ldlt(const SolverOptions&, Workers&) {
  return std::make_unique<FactorSolver<D>>(make_eigen_factor<D>());
}

template <int D, EigenPreconditioner preconditioner>
Solver<D> eigen_cg(const SolverOptions& options, Workers&) {
  return make_eigen_cg<D>(options, preconditioner);
}

template <int D>
struct SolverRow {
  const char* name;
  const char* help;
  Solver<D> (*make)(const SolverOptions&, Workers&);
  bool by_cholmod = false;
  bool is_there() const { return !by_cholmod || has_cholmod(); }
};

template <int D>
constexpr SolverRow<D> rows[] = {
    {"cg", "conjugate gradients with the inverse diagonal blocks", plain<D>},
    {"cg_sliver_blocks", "the same; the vertices that slivers join share a block", sliver_blocks<D>},
    {"multigrid", "a V-cycle that knows the cuts; constant_factor where that takes over 100 iterations", multigrid<D>},
    {"cholmod", "direct", cholmod<D, FactorOrder::anew>, true},
    {"cholmod_same_order", "direct, keeps the order of elimination after a cut", cholmod<D, FactorOrder::extended>,
     true},
    {"cholmod_stale", "conjugate gradients with the factor of an older matrix", stale_factor<D>, true},
    {"constant_factor", "conjugate gradients with a factor that no rotation changes", constant_factor<D>},
    {"eigen_cg", "Eigen's conjugate gradients with the inverse diagonal", eigen_cg<D, EigenPreconditioner::diagonal>},
    {"eigen_cg_ichol", "the same with an incomplete Cholesky factor",
     eigen_cg<D, EigenPreconditioner::incomplete_cholesky>},
    {"eigen_ldlt", "direct, without supernodes", eigen_ldlt<D>},
};

}  // namespace

const std::vector<std::string>& solver_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& row : rows<2>)
      if (row.is_there()) all.emplace_back(row.name);
    return all;
  }();
  return names;
}

std::string solver_help() {
  constexpr std::size_t column = 20;
  std::string all;
  for (const auto& row : rows<2>) {
    if (!row.is_there()) continue;
    std::string name = row.name;
    name.resize(column, ' ');
    all += "  " + name + row.help + "\n";
  }
  return all;
}

void check_solver_names(const std::vector<std::string>& names, const std::string& where) {
  for (const auto& name : names) {
    const auto row = std::find_if(std::begin(rows<2>), std::end(rows<2>), [&](auto& r) { return name == r.name; });
    const std::string which = where + " \"" + name + "\"";
    if (row == std::end(rows<2>))
      throw InputError(which + " is not known; known are " + listed(nearest_first(name, solver_names())));
    if (!row->is_there())
      throw InputError(which + " needs CHOLMOD, which this build was made without (CUTBENCH_CHOLMOD)");
  }
}

template <int D>
std::unique_ptr<LinearSolver<D>> make_solver(const SolverOptions& options, Workers& workers) {
  check_solver_names({options.name}, "solver");
  const auto row =
      std::find_if(std::begin(rows<D>), std::end(rows<D>), [&](auto& r) { return options.name == r.name; });
  return row->make(options, workers);
}

template std::unique_ptr<LinearSolver<2>> make_solver(const SolverOptions&, Workers&);
template std::unique_ptr<LinearSolver<3>> make_solver(const SolverOptions&, Workers&);

}  // namespace cutbench
