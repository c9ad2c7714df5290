#include "harness/cut/cut.h"

#include <algorithm>
#include <limits>

#include "harness/base/stop_watch.h"
#include "harness/cut/cut_program.h"
#include "harness/cut/embed_carefully.h"
#include "harness/cut/open.h"
#include "harness/cut/patch.h"
#include "harness/mesh/tolerances.h"

namespace cutbench {

namespace {

/// The longer side of the points' bounding box.
double reach_of(const std::vector<Point2>& points) {
  Point2 low = points.front(), high = low;
  for (Point2 p : points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return std::max(high.x - low.x, high.y - low.y);
}

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
    flatten(curve, std::numeric_limits<double>::infinity(), 0, polyline_);  // to a hundredth of its own size
    const double reach = reach_of(polyline_.points);
    if (reach <= meeting_tolerance * sheet.snap()) return nothing_done(Status::noop, "the path has no length");
    if (reach > longest_path_reach * sheet.size())
      return nothing_done(Status::refused, "the path reaches over 1000 times the sheet's size; cut it off nearer");
    flatten(curve, options.flatten_tolerance * sheet.mean_edge(), sheet.snap(), polyline_);
    outcome.time_us.trace = watch.lap();
    Walk walk(sheet, locator);
    walk.locate(polyline_.points.front());
    outcome.time_us.locate = watch.lap();

    const double chord_tolerance = options.chord_tolerance * sheet.mean_edge();
    Subdivision& trace = tracer_.trace(sheet, polyline_, walk, chord_tolerance);
    outcome.time_us.trace += watch.lap();
    outcome.crossed_triangles = trace.crossed_triangles();  // of the path as asked for, whatever becomes of it
    if (outcome.crossed_triangles == 0 && trace.along.empty())
      return nothing_done(Status::noop, "the path lies outside the sheet, or where it is open already");
    watch.lap();  // counting is no part of a cut

    CutProgram* const program = method.program();
    MethodNotes notes;
    double program_us = 0;
    try {
      if (program) {
        program_us = program->run(sheet, trace, curve, options);
      } else {
        method.adapt(sheet, trace, polyline_);
        method.embed(sheet, trace, notes);
      }
      mark_along(sheet, trace);
    } catch (const TooClose&) {
      sheet.rollback();
      sheet.begin_cut();
      notes = {}, outcome.carefully = true;
      Walk again(sheet, locator);
      again.locate(polyline_.points.front());  // adapt() may have moved vertices, and the trace with them
      outcome.deviation = embed_carefully(sheet, tracer_.trace(sheet, polyline_, again, chord_tolerance));
    }
    outcome.time_us.embed = watch.lap();
    if (!program) method.improve(sheet, notes);
    outcome.time_us.improve = watch.lap();
    open_path(sheet);
    outcome.time_us.open = watch.lap();
    locator.update(sheet);
    outcome.time_us.locate += watch.lap();

    if (notes.stopped_early) outcome.reason = "the triangles were improved in part only, up to the method's limit";
    if (outcome.deviation > line_tolerance * sheet.snap()) {
      outcome.status = Status::deviated;
      outcome.reason = "a crossing was moved out of a wedge between older cuts that is too thin for doubles";
    }
    outcome.recovered_segments = notes.recovered_segments;
    if (program_us > 0) outcome.time_us = {.program = program_us};
  } catch (const TooClose& reason) {
    sheet.rollback();
    outcome = nothing_done(Status::refused, reason.what());
  } catch (const CutRefused& reason) {
    sheet.rollback();
    outcome = nothing_done(Status::refused, reason.what());
  } catch (const CutFailed& failure) {
    sheet.rollback();
    outcome = nothing_done(Status::failed, failure.what());
    outcome.verdict = failure.verdict;
  }
  return outcome;
}

}  // namespace cutbench
