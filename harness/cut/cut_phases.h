// A cut under way, phase by phase: what Cutter::cut() runs and times, and what performance tracking counts one by one.
#pragma once

#include "harness/cut/cut.h"
#include "harness/path/walk.h"

namespace cutbench {

/// One cut. The phases are to be called in the order of `cut_phases`. Each returns whether the cut goes on: where it
/// does not, `outcome` says why, and the sheet is as it was. They throw TooClose, CutRefused and CutFailed; then the
/// sheet is to be rolled back.
class CutUnderWay {
 public:
  /// Keeps references to all of them. \param tracer, polyline  working storage
  /// \pre as Cutter::cut(); CuttingMethod::why_unsupported() has no reason against it.
  CutUnderWay(Tracer& tracer, Polyline& polyline, Sheet& sheet, Locator& locator, const Curve& curve,
              CuttingMethod& method, const CutOptions& options);

  bool flatten();  ///< begins the cut, too
  bool locate();   ///< the first triangle; may be repeated
  bool trace();
  bool count();  ///< the triangles that are met: no part of a cut
  bool embed();
  bool improve();
  bool open();
  bool follow();  ///< brings the locator up to date
  /// What the method noted: after all phases.
  void finish();

  CutOutcome outcome;  ///< without times, but for those of a program of its own

 private:
  bool end(Status status, const char* reason);
  void divide_lone_edge();

  Tracer& tracer_;
  Polyline& polyline_;
  Sheet& sheet_;
  Locator& locator_;
  const Curve& curve_;
  CuttingMethod& method_;
  CutProgram* const program_;  // null: the method cuts by itself
  const CutOptions& options_;
  Walk walk_;
  Subdivision* trace_ = nullptr;
  MethodNotes notes_;
  double program_us_ = 0;
};

struct CutPhase {
  const char* name;
  bool (CutUnderWay::*run)();
  double PhaseTimes::*time;  ///< where its time counts; null: nowhere
};

/// In their order.
inline constexpr CutPhase cut_phases[] = {
    {"flatten", &CutUnderWay::flatten, &PhaseTimes::trace}, {"locate", &CutUnderWay::locate, &PhaseTimes::locate},
    {"trace", &CutUnderWay::trace, &PhaseTimes::trace},     {"count", &CutUnderWay::count, nullptr},
    {"embed", &CutUnderWay::embed, &PhaseTimes::embed},     {"improve", &CutUnderWay::improve, &PhaseTimes::improve},
    {"open", &CutUnderWay::open, &PhaseTimes::open},        {"follow", &CutUnderWay::follow, &PhaseTimes::locate}};

}  // namespace cutbench
