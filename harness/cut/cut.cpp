#include "harness/cut/cut.h"

#include "harness/cut/open.h"
#include "harness/cut/patch.h"
#include "harness/measure/stop_watch.h"

namespace cutbench {

namespace {

CutOutcome nothing_done(Status status, const std::string& reason) {
  CutOutcome outcome;
  outcome.status = status, outcome.reason = reason;
  return outcome;
}

}  // namespace

const char* name_of(Status status) {
  constexpr const char* names[] = {"ok", "noop", "deviated", "refused", "failed"};
  return names[static_cast<std::size_t>(status)];
}

CutOutcome Cutter::cut(Sheet& sheet, Locator& locator, const Curve& curve, CuttingMethod& method,
                       const CutOptions& options) {
  if (const auto reason = method.why_unsupported(sheet)) return nothing_done(Status::refused, *reason);
  CutOutcome outcome;
  StopWatch watch;
  sheet.begin_cut();
  try {
    flatten(curve, options.flatten_tolerance * sheet.mean_edge(), sheet.snap(), polyline_);
    if (polyline_.points.size() < 2) return nothing_done(Status::noop, "the path has no length");
    outcome.time_us.trace = watch.lap();
    Walk walk(sheet, locator);
    walk.locate(polyline_.points.front());
    outcome.time_us.locate = watch.lap();

    Subdivision& trace = tracer_.trace(sheet, polyline_, walk, options.chord_tolerance * sheet.mean_edge());
    outcome.time_us.trace += watch.lap();
    if (trace.segments.empty() && trace.along.empty())
      return nothing_done(Status::noop, "the path lies outside the sheet, or where it is open already");

    method.embed(sheet, trace);
    mark_along(sheet, trace);
    outcome.time_us.embed = watch.lap();
    method.improve(sheet);
    outcome.time_us.improve = watch.lap();
    open_path(sheet);
    outcome.time_us.open = watch.lap();
    locator.update(sheet);
    outcome.time_us.locate += watch.lap();

    outcome.crossed_triangles = trace.crossed_triangles();
    outcome.recovered_segments = method.recovered_segments();
  } catch (const CutFailed& failure) {
    sheet.rollback();
    outcome = nothing_done(Status::failed, failure.what());
    outcome.verdict = failure.verdict;
  }
  return outcome;
}

}  // namespace cutbench
