// A cut, in the steps that every method shares: locate, trace, embed (with adapt), improve, open. The times are taken
// here, for all methods alike, and a cut that fails leaves the sheet bit-unchanged.
#pragma once

#include <string>

#include "harness/cut/cutting_method.h"
#include "harness/mesh/locator.h"
#include "harness/mesh/tolerances.h"
#include "harness/path/curve.h"
#include "harness/path/trace.h"

namespace cutbench {

enum class Status {
  ok,
  noop,      ///< nothing to do, the sheet is bit-unchanged
  deviated,  ///< done, but not the requested topology, by a declared policy
  refused,   ///< known before the cut, the sheet is bit-unchanged
  failed,    ///< the sheet is bit-unchanged
};
const char* name_of(Status status);

struct CutOptions {
  // In mean rest edges of the sheet as constructed.
  double flatten_tolerance = default_flatten_tolerance;  ///< Bezier to polyline, for tracing only
  double chord_tolerance =
      default_chord_tolerance;  ///< curve points inside triangles become vertices beyond it; infinity: crossings only
};

/// Microseconds (steady clock) per phase. `trace` includes flattening; `locate` finding the first triangle and keeping
/// the locator up to date. Where a program of its own made the cut there is `program` instead of the phases before it.
struct PhaseTimes {
  double locate = 0, trace = 0, embed = 0, improve = 0, open = 0;
  double constrain = 0;  ///< of a ConstraintSource, which a solver asks: Cutter leaves it 0
  double program = 0;    ///< as it reports, else from its start to its end
  double total() const { return locate + trace + embed + improve + open + constrain + program; }
  PhaseTimes& operator+=(const PhaseTimes& o) {
    locate += o.locate;
    trace += o.trace;
    embed += o.embed;
    improve += o.improve;
    open += o.open;
    constrain += o.constrain;
    program += o.program;
    return *this;
  }
};

struct CutOutcome {
  Status status = Status::ok;
  Verdict verdict = Verdict::ok;      ///< of a failure
  std::string reason;                 ///< of a failure or a refusal or a noop, a note on what was done
  std::size_t crossed_triangles = 0;  ///< of the mesh before the cut: those whose interior the path meets
  int recovered_segments = 0;
  bool carefully = false;  ///< the method could not embed the path, and embed_carefully() did
  double deviation = 0;    ///< largest move of a crossing by embed_carefully(), rest units; beyond `line_tolerance`
                           ///< the status is `deviated`
  PhaseTimes time_us;
};

/// Cuts sheets; keeps its working storage, so that a warm cut allocates next to nothing.
class Cutter {
 public:
  /// \pre check_curve(curve); the locator is the sheet's and up to date.
  CutOutcome cut(Sheet& sheet, Locator& locator, const Curve& curve, CuttingMethod& method, const CutOptions& options);

 private:
  Tracer tracer_;
  Polyline polyline_;
};

}  // namespace cutbench
