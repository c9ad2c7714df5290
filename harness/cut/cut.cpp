#include "harness/cut/cut.h"

#include "harness/base/conversions.h"
#include "harness/base/stop_watch.h"
#include "harness/cut/cut_phases.h"

namespace cutbench {

namespace {

CutOutcome nothing_done(Status status, const std::string& reason) {
  CutOutcome outcome;
  outcome.status = status;
  outcome.reason = reason;
  return outcome;
}

}  // namespace

const char* name_of(Status status) {
  constexpr const char* names[] = {"ok", "noop", "deviated", "refused", "failed"};
  return names[to_size(status)];
}

CutOutcome Cutter::cut(Sheet& sheet, Locator& locator, const Curve& curve, CuttingMethod& method,
                       const CutOptions& options) {
  if (const auto reason = method.why_unsupported(sheet)) return nothing_done(Status::refused, *reason);
  StopWatch watch;
  try {
    CutUnderWay cut(tracer_, polyline_, sheet, locator, curve, method, options);
    for (const CutPhase& phase : cut_phases) {
      if (!(cut.*phase.run)()) return cut.outcome;
      const double us = watch.lap();
      if (phase.time) cut.outcome.time_us.*phase.time += us;
    }
    cut.finish();
    return cut.outcome;
  } catch (const TooClose& reason) {
    sheet.rollback();
    return nothing_done(Status::refused, reason.what());
  } catch (const CutRefused& reason) {
    sheet.rollback();
    return nothing_done(Status::refused, reason.what());
  } catch (const CutFailed& failure) {
    sheet.rollback();
    CutOutcome outcome = nothing_done(Status::failed, failure.what());
    outcome.verdict = failure.verdict;
    return outcome;
  }
}

}  // namespace cutbench
