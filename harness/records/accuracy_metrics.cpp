#include "harness/records/metrics.h"

namespace cutbench {

void add_accuracy_run(std::vector<Metric>& t) {
  t.push_back({"problem", "", "problem", Direction::none, Group::accuracy_run,
               "Problem with a known answer, harness/truth/problem.h; takes the place of cut_family. `case` is the "
               "member of its ensemble."});
  t.push_back(
      {"solver", "", "solver", Direction::none, Group::accuracy_run, "Linear solver: harness/fem/linear_solver.h."});
  t.push_back({"budget", "", "iterations allowed", Direction::none, Group::accuracy_run,
               "Iterations from zero, whatever is reached by then; 0: until solved."});
  t.push_back(
      {"tip_functions", "", "tip functions", Direction::none, Group::accuracy_run,
       "1: solved with functions for the tips (harness/fem/tip_functions.h) beside the linear ones. Such rows have "
       "two measures more: `tip_k1` and `tip_k2`, K from the functions' coefficients."});
  t.push_back({"exact_incision", "", "exact incision", Direction::none, Group::accuracy_run,
               "1: the method promises to open the requested path itself."});
  t.push_back({"cut_us", "us", "cut", Direction::lower, Group::accuracy_run,
               "Geometry of the cut, warm. Of the reference: the meshing, with the search for its size."});
  t.push_back(
      {"total_us", "us", "total time", Direction::lower, Group::accuracy_run, "Cut, assembly, set-up and solve."});
  t.push_back({"unknowns", "", "unknowns", Direction::none, Group::accuracy_run, "Free unknowns of the system."});
  t.push_back({"triangles", "", "triangles", Direction::none, Group::accuracy_run, "Triangles of the cut sheet."});
  t.push_back({"iterations", "", "iterations", Direction::lower, Group::accuracy_run, "Iterations that were made."});
  t.push_back({"residual", "", "residual", Direction::lower, Group::accuracy_run,
               "True residual, relative to the right-hand side."});
  t.push_back(
      {"primary", "", "primary measure", Direction::none, Group::accuracy_run, "Name of the measure that ranks."});
  t.push_back({"error", "", "error", Direction::lower, Group::accuracy_run, "Error of the primary measure."});
  t.push_back({"excess_error", "", "excess error", Direction::lower, Group::accuracy_run,
               "error / that of the reference solved directly, minus one; empty where the reference's is below 1e-9, "
               "exact but for rounding."});
  t.push_back({"value_*", "", "value of a measure", Direction::none, Group::accuracy_run,
               "Value of each measure; the measures of problems are in harness/truth."});
  t.push_back({"exact_*", "", "exact of a measure", Direction::none, Group::accuracy_run,
               "Its exact value; 0 for a norm of an error."});
  t.push_back({"error_*", "", "error of a measure", Direction::lower, Group::accuracy_run, "Its error."});
  t.push_back({"excess_*", "", "excess of a measure", Direction::lower, Group::accuracy_run, "Its excess error."});
}

}  // namespace cutbench
