#include "experiments/live/live_sheet.h"

#include <utility>

#include "experiments/live/method_maker.h"
#include "harness/base/errors.h"
#include "harness/cut/constraint_source.h"
#include "harness/mesh/quality.h"
#include "harness/path/pick.h"
#include "methods/registry.h"

namespace cutbench::live {

using nlohmann::json;

namespace {

Quality quality_of(const Sheet& sheet) {
  std::vector<std::array<Point2, 3>> all;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    if (sheet.triangle(TriangleIndex(t)).alive()) all.push_back(sheet.corners(TriangleIndex(t)));
  return quality(all);
}

}  // namespace

LiveSheet::LiveSheet(const Scene& scene)
    : scene_(scene),
      now_(scene_),
      cuts_(scene_, now_),
      stepper_({scene_.integrator, scene_.step, scene_.newton, scene_.sweeps, scene_.solver, scene_.robust}),
      triangles_before_(now_.sheet.triangle_count()) {
  now_.model.reserve_spare();
}

int LiveSheet::step(int steps) {
  for (int i = 0; i < steps; ++i) {
    if (!fault_.empty()) return i;
    if (!grabbed_.empty()) pull();
    const StepReport report = stepper_.step(now_.model, now_.state);
    if (report.verdict != Verdict::ok) fault_ = std::string(name_of(report.verdict)) + ": " + report.reason;
  }
  return fault_.empty() ? steps : steps - 1;
}

json LiveSheet::cut(const std::string& method, double parameter, const std::vector<Curve>& curves) {
  const MethodRow& row = find_method(method);
  for (const Curve& curve : curves) check_curve(curve, "the stroke");
  auto next = make_method(row, parameter);
  // Constraints are found from those of the cut before: by one method, or none.
  if (method_ && method != method_name_ && (method_->constraint_source() || next->constraint_source()))
    throw InputError("the sheet was cut by " + method_name_ + ", and can't be cut on by " + method +
                     "; make a new one");
  method_ = std::move(next);
  method_name_ = method;
  release();
  if (saved_.size() == most_saved) saved_.erase(saved_.begin());
  saved_.push_back(std::make_unique<MovingSheet<3>>(now_));
  const std::size_t triangles = now_.sheet.triangle_count();
  MotionCut made;
  try {
    made = cuts_.cut(now_, curves, cutter_, *method_, {});
  } catch (...) {  // Boost's numbers refuse the infinite ones that CGAL makes of subnormal coordinates
    now_ = *saved_.back();
    throw;
  }
  json result = numbers();
  result["status"] = name_of(made.cut.status);
  result["verdict"] = name_of(made.verdict);
  result["reason"] = made.reason;
  result["added"] = to_index(now_.sheet.triangle_count()) - to_index(triangles);
  result["crossed"] = made.cut.crossed_triangles;
  return result;
}

bool LiveSheet::undo() {
  if (saved_.empty()) return false;
  release();
  now_ = *saved_.back();
  saved_.pop_back();
  now_.model.reserve_spare();
  fault_.clear();
  return true;
}

Point2 LiveSheet::pick(Point3 origin, Point3 direction) const {
  return Picker(now_.posed()).rest_point({origin, direction}, "the pick");
}

TriangleIndex LiveSheet::holder_of(Point2 rest) const {
  return triangle_at(now_.sheet, now_.locator.near(now_.sheet, rest), rest);
}

Point3 LiveSheet::place(Point2 p) const {
  const TriangleIndex t = holder_of(p);
  const auto [a, b, c] = now_.sheet.corners(t);
  const double area = cross(b - a, c - a);
  const std::array<double, 3> weight{cross(c - b, p - b) / area, cross(a - c, p - c) / area,
                                     cross(b - a, p - a) / area};
  std::array<double, 3> x{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      x[axis] += weight[k] * now_.state.x[to_index(3 * now_.sheet.triangle(t).deformed[k]() + axis)];
  return {x[0], x[1], x[2]};
}

json LiveSheet::numbers() const {
  const Quality q = quality_of(now_.sheet);
  std::size_t polygons = 0;
  for (std::size_t p = 0; p < now_.model.elements().polygon_slots(); ++p)
    polygons += !now_.model.elements().polygon(p).polygon.triangles.empty();
  return {{"triangles", now_.sheet.triangle_count()},
          {"triangles_before", triangles_before_},
          {"vertices", now_.sheet.deformed_count()},
          {"aspect_ratio", q.ar_max},
          {"pieces", count_pieces(now_.sheet)},
          {"polygons", polygons},
          {"time", now_.state.time}};
}

}  // namespace cutbench::live
