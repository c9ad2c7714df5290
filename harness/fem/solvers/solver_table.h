// The solvers by name. A new one is a file that makes it and a row in solver_table.cpp, whose text is its help.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "harness/fem/algebra/workers.h"
#include "harness/fem/linear/solver_options.h"

namespace cutbench {

template <int D>
class LinearSolver;

/// Of the solvers that this build has: those by CHOLMOD only where it is there.
const std::vector<std::string>& solver_names();
/// Throws InputError where this build has no solver of one of these names; `where` says who named it.
void check_solver_names(const std::vector<std::string>& names, const std::string& where);
/// A line for each solver: its name and what it is.
std::string solver_help();

/// Throws InputError as check_solver_names() does.
/// \param workers  of solvers that use some; they must outlive it
template <int D>
std::unique_ptr<LinearSolver<D>> make_solver(const SolverOptions& options, Workers& workers = Workers::none());

}  // namespace cutbench
