#include "harness/records/metrics.h"

namespace cutbench {

std::vector<Metric> accuracy_metrics() {
  using enum Direction;
  constexpr Group group = Group::accuracy_run;
  return {
      {"problem", "", "problem", none, group,
       "Problem with a known answer, harness/problems/common/problem.h; takes the place of cut_family. `case` is the "
       "member of its ensemble."},
      {"solver", "", "solver", none, group, "Linear solver: harness/fem/solvers/solver_table.cpp."},
      {"budget", "", "iterations allowed", none, group,
       "Iterations from zero, whatever is reached by then; 0: until solved."},
      {"tip_functions", "", "tip functions", none, group,
       "1: solved with functions for the tips (harness/fem/tips/tip_functions.h) beside the linear ones. Such rows "
       "have "
       "two measures more: `tip_k1` and `tip_k2`, K from the functions' coefficients."},
      shared_metric("status"),
      shared_metric("verdict"),
      shared_metric("reason"),
      {"exact_incision", "", "exact incision", none, group,
       "1: the method promises to open the requested path itself."},
      {"cut_us", "us", "cut", lower, group,
       "Geometry of the cut, warm. Of the reference: the meshing, with the search for its size."},
      shared_metric("assemble_us"),
      shared_metric("setup_us"),
      shared_metric("solve_us"),
      {"total_us", "us", "total time", lower, group, "Cut, assembly, set-up and solve."},
      {"unknowns", "", "unknowns", none, group, "Free unknowns of the system."},
      {"triangles", "", "triangles", none, group, "Triangles of the cut sheet."},
      shared_metric("vertices_added"),
      {"iterations", "", "iterations", lower, group, "Iterations that were made."},
      {"residual", "", "residual", lower, group, "True residual, relative to the right-hand side."},
      shared_metric("crossed_triangles"),
      shared_metric("incision_error_h"),
      shared_metric("ar_max_cut"),
      shared_metric("ar_max_all"),
      shared_metric("angle_max_deg_cut"),
      shared_metric("altitude_min_h_cut"),
      {"primary", "", "primary measure", none, group, "Name of the measure that ranks."},
      {"error", "", "error", lower, group, "Error of the primary measure."},
      {"excess_error", "", "excess error", lower, group,
       "error / that of the reference solved directly, minus one; empty where the reference's is below 1e-9, "
       "exact but for rounding."},
      {"value_*", "", "value of a measure", none, group,
       "Value of each measure; the measures of problems are in harness/problems."},
      {"exact_*", "", "exact of a measure", none, group, "Its exact value; 0 for a norm of an error."},
      {"error_*", "", "error of a measure", lower, group, "Its error."},
      {"excess_*", "", "excess of a measure", lower, group, "Its excess error."}};
}

}  // namespace cutbench
