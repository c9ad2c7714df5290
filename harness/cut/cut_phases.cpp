#include "harness/cut/cut_phases.h"

#include <algorithm>
#include <limits>

#include "harness/cut/cut_program.h"
#include "harness/cut/embed_carefully.h"
#include "harness/cut/open.h"
#include "harness/cut/patch.h"
#include "harness/mesh/one_ring.h"
#include "harness/mesh/tolerances.h"
#include "harness/path/tips.h"

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

}  // namespace

CutUnderWay::CutUnderWay(Tracer& tracer, Polyline& polyline, Sheet& sheet, Locator& locator, const Curve& curve,
                         CuttingMethod& method, const CutOptions& options)
    : tracer_(tracer),
      polyline_(polyline),
      sheet_(sheet),
      locator_(locator),
      curve_(curve),
      method_(method),
      program_(method.program()),
      options_(options),
      walk_(sheet, locator) {}

bool CutUnderWay::end(Status status, const char* reason) {
  outcome = {};
  outcome.status = status;
  outcome.reason = reason;
  return false;
}

bool CutUnderWay::flatten() {
  sheet_.begin_cut();
  cutbench::flatten(curve_, std::numeric_limits<double>::infinity(), 0, polyline_);  // to a hundredth of its own size
  const double reach = reach_of(polyline_.points);
  if (reach <= meeting_tolerance * sheet_.snap()) return end(Status::noop, "the path has no length");
  if (reach > longest_path_reach * sheet_.size())
    return end(Status::refused, "the path reaches over 1000 times the sheet's size; cut it off nearer");
  cutbench::flatten(curve_, options_.flatten_tolerance * sheet_.mean_edge(), sheet_.snap(), polyline_);
  return true;
}

bool CutUnderWay::locate() {
  walk_.locate(polyline_.points.front());
  return true;
}

bool CutUnderWay::trace() {
  trace_ = &tracer_.trace(sheet_, polyline_, walk_, options_.chord_tolerance * sheet_.mean_edge());
  return true;
}

bool CutUnderWay::count() {
  outcome.crossed_triangles = trace_->crossed_triangles();  // of the path as asked for, whatever becomes of it
  if (outcome.crossed_triangles > 0 || !trace_->along.empty()) return true;
  return end(Status::noop, "the path lies outside the sheet, or where it is open already");
}

bool CutUnderWay::embed() {
  try {
    if (program_) {
      program_us_ = program_->run(sheet_, *trace_, curve_, options_);
    } else {
      method_.adapt(sheet_, *trace_, polyline_);
      method_.embed(sheet_, *trace_, notes_);
    }
    mark_along(sheet_, *trace_);
  } catch (const TooClose&) {
    sheet_.rollback();
    sheet_.begin_cut();
    notes_ = {};
    outcome.carefully = true;
    Walk again(sheet_, locator_);
    again.locate(polyline_.points.front());  // adapt() may have moved vertices, and the trace with them
    const double chord_tolerance = options_.chord_tolerance * sheet_.mean_edge();
    outcome.deviation = embed_carefully(sheet_, tracer_.trace(sheet_, polyline_, again, chord_tolerance));
  }
  return true;
}

bool CutUnderWay::improve() {
  if (!program_) method_.improve(sheet_, notes_);
  return true;
}

/// What a method made of the path may be one edge between seams on which the path ends. In space these ends are tips,
/// so that nothing would open: as between other tips (Tracer) it gets a vertex in the middle.
void CutUnderWay::divide_lone_edge() {
  if (sheet_.seams().empty()) return;
  std::vector<VertexIndex> ends;
  for (const VertexIndex v : sheet_.log().path_vertices)
    if (sheet_.triangle_of_vertex(v).valid()) ends.push_back(v);
  if (ends.size() != 2) return;
  HalfEdge lone;
  const Point2 first = polyline_.points.front(), last = polyline_.points.back();
  for (const VertexIndex v : ends) {
    const Point2 p = sheet_.rest(v);
    const bool is_last = squared_length(p - last) < squared_length(p - first);
    for (const HalfEdge out : outgoing_edges(sheet_, v))
      for (const HalfEdge h : {out, Sheet::previous(out)})
        if (sheet_.mark(h) == EdgeMark::path)
          lone = h;
        else if (is_open(sheet_, h, is_last ? polyline_.goes_on : polyline_.continues))
          return;
  }
  if (!lone.valid()) return;
  const Point2 from = sheet_.rest(sheet_.origin(lone)), to = sheet_.rest(sheet_.target(lone));
  sheet_.split_edge(lone, 0.5, from + 0.5 * (to - from));
}

bool CutUnderWay::open() {
  divide_lone_edge();
  open_path(sheet_);
  return true;
}

bool CutUnderWay::follow() {
  locator_.update(sheet_);
  return true;
}

void CutUnderWay::finish() {
  if (notes_.stopped_early)
    outcome.reason = notes_.improved_nothing
                         ? "no triangle was improved: the method met its limit and left all as the split made them"
                         : "the triangles were improved in part only, up to the method's limit";
  if (outcome.deviation > line_tolerance * sheet_.snap()) {
    outcome.status = Status::deviated;
    outcome.reason = "a crossing was moved out of a wedge between older cuts that is too thin for doubles";
  }
  outcome.recovered_segments = notes_.recovered_segments;
  if (program_us_ > 0) outcome.time_us = {.program = program_us_};
}

}  // namespace cutbench
