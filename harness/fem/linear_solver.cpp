#include "harness/fem/linear_solver.h"

#include "harness/fem/cholmod_solver.h"
#include "harness/fem/conjugate_gradients.h"
#include "harness/fem/multigrid.h"
#include "harness/fem/sliver_blocks.h"
#include "harness/mesh/mesh_data.h"

namespace cutbench {

const std::vector<std::string>& solver_names() {
  static const std::vector<std::string> names{"cg", "cg_sliver_blocks", "multigrid", "cholmod"};
  return names;
}

template <int D>
std::unique_ptr<LinearSolver<D>> make_solver(const SolverOptions& options) {
  if (options.name == "cg") return std::make_unique<ConjugateGradients<D>>(options, nullptr);
  if (options.name == "cg_sliver_blocks")
    return std::make_unique<ConjugateGradients<D>>(options, std::make_unique<SliverBlocks<D>>());
  if (options.name == "multigrid")
    return std::make_unique<ConjugateGradients<D>>(options, std::make_unique<Multigrid<D>>());
  if (options.name == "cholmod") return make_cholmod_solver<D>();
  std::string known;
  for (const auto& name : solver_names()) known += (known.empty() ? "" : ", ") + name;
  throw InputError("unknown solver \"" + options.name + "\"; known are " + known);
}

template std::unique_ptr<LinearSolver<2>> make_solver(const SolverOptions&);
template std::unique_ptr<LinearSolver<3>> make_solver(const SolverOptions&);

void project(const std::vector<std::uint8_t>& held, const Eigen::Ref<const Field>& b, Field& projected) {
  projected.resize(b.size());
  for (Eigen::Index u = 0; u < b.size(); ++u) projected[u] = held[static_cast<std::size_t>(u)] ? 0 : b[u];
}

}  // namespace cutbench
