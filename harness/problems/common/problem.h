// A problem with a known answer: a sheet, a cut, what holds and pulls at it, and what the cut sheet must then do. Each
// shows one effect. Sources: in the files of the problems, in plane in exact_fields.h.
//
// A problem has many members: the same cut at another place and angle relative to the mesh. One lucky position proves
// nothing, so errors are published over ensembles.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "harness/base/verdict.h"
#include "harness/fem/linear/solver_options.h"
#include "harness/mesh/constraints.h"
#include "harness/mesh/mesh_data.h"
#include "harness/mesh/sheet.h"
#include "harness/path/curve.h"

namespace cutbench {

/// A quantity compared with its exact value. SI units.
struct Measure {
  std::string name;  ///< of the problem's measures()
  double value = 0;  ///< from the finite elements
  double exact = 0;  ///< of the requested curve, whatever the method opened; 0 for a norm of an error
  double error = 0;  ///< |value - exact| over the problem's scale of it; a norm over that of the exact field
};

/// What one solver made of one cut sheet. Microseconds, steady clock, one thread.
struct Answer {
  Verdict verdict = Verdict::ok;  ///< or solver_stalled, not_finite; a fixed budget of iterations never stalls
  std::string reason;
  bool refused = false;      ///< nothing was solved; the reason says why
  std::size_t unknowns = 0;  ///< free ones
  double assemble_us = 0, setup_us = 0, solve_us = 0;
  int iterations = 0;
  double residual = 0;  ///< |b - A x| / |b|
  std::vector<Measure> measures;
};

/// How to solve. A budget runs so many iterations of `solver.name` from zero, whatever is reached by then.
struct Budget {
  SolverOptions solver{.name = "cholmod"};
  int iterations = 0;  ///< 0: until solved
  /// Beside the linear shape functions (harness/fem/tips/tip_functions.h). \pre the problem takes budgets; iterations
  /// is 0.
  bool tip_functions = false;
};

/// One member of the ensemble, before any method touched it.
struct Specimen {
  MeshData mesh;
  std::vector<Curve> cuts;  ///< made one after the other
  Point2 origin{};          ///< of the exact solution's frame, in rest space
  double angle = 0;         ///< of its x axis, radians
};

/// Measures that problems with tips have besides their own where a budget has tip functions: K at the tips from the
/// functions' coefficients.
inline constexpr std::array<const char*, 2> tip_measures{"tip_k1", "tip_k2"};

class Problem {
 public:
  virtual ~Problem() = default;
  virtual std::string name() const = 0;
  virtual std::string effect() const = 0;  ///< one line: the one effect it shows
  virtual std::string truth() const = 0;   ///< one line: the answer and its source
  /// What answer() measures, the primary one first: that which ranks. In the plane it is the energy norm of the error
  /// (at an edge crack the root of the missing energy), and the second one is another norm: it has no sign in which
  /// errors cancel.
  virtual std::vector<std::string> measures() const = 0;
  virtual bool takes_budgets() const { return true; }  ///< false: several linear solves, solved directly only
  /// False: it bends, which it does at the sheet's own vertices alone.
  virtual bool takes_constraints() const { return takes_budgets(); }
  virtual bool in_motion() const { return false; }       ///< not at rest: "all" of an experiment leaves it out
  virtual bool takes_compounds() const { return true; }  ///< false: it changes the cut sheet once more

  /// Member `index` on a sheet of `family` (sheet_families()) with 2 n^2 triangles; depends on the arguments alone.
  virtual Specimen specimen(const std::string& family, int n, std::uint64_t seed, std::size_t index) const = 0;
  /// Loads the opened sheet, solves it once per budget, and compares. One assembly serves all budgets.
  /// \pre `sheet` is that of `specimen` with its cuts made, by whatever method, or body_fitted() to them; `constraints`
  /// are those of the method: no vertex is constrained unless takes_constraints(), and no triangles merged unless
  /// takes_compounds().
  virtual std::vector<Answer> answer(const Specimen& specimen, const Sheet& sheet, std::span<const Budget> budgets,
                                     const Constraints& constraints) const = 0;
  std::vector<Answer> answer(const Specimen& specimen, const Sheet& sheet, std::span<const Budget> budgets) const {
    return answer(specimen, sheet, budgets, {});
  }
};

/// All problems, in the order of the tables.
const std::vector<std::unique_ptr<const Problem>>& all_problems();
/// Throws InputError, naming the known ones.
const Problem& find_problem(const std::string& name);

/// The measuring stick of excess errors: the specimen's sheet meshed anew to fit its cuts, with nearly as many
/// triangles and an even size (CGAL's Delaunay refinement, incisions as constraints), opened along them.
Sheet body_fitted(const Specimen& specimen);
/// The same with nearly as many triangles, small at the ends of cuts inside the sheet and at the corners in them,
/// larger elsewhere: what a fitted mesh can do that knows where stresses have no bound. Without such places it is
/// body_fitted(). \pre the sheet is a rectangle.
Sheet graded_at_tips(const Specimen& specimen);

}  // namespace cutbench
