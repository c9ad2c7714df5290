#include "harness/study/worker.h"

#include "harness/base/stop_watch.h"
#include "harness/cut/constraint_source.h"
#include "harness/study/chill_caches.h"

namespace cutbench {

void Worker::restore(const BaseSheet& base, const std::vector<Curve>& cuts) {
  if (undoable_) {
    sheet.rollback();
  } else {
    sheet = base.sheet;
    sheet.reserve(4 * sheet.triangle_slots(), 4 * sheet.vertex_slots(), 4 * sheet.deformed_slots());
    sheet.begin_cut();  // so that a cut that is refused can be undone, too
  }
  locator_ = base.locator;
  undoable_ = cuts.size() == 1;
}

CutRun Worker::cut(const BaseSheet& base, const std::vector<Curve>& cuts, const CutOptions& options) {
  restore(base, cuts);
  return cut_restored(base, cuts, options);
}

CutRun Worker::measure(const BaseSheet& base, const std::vector<Curve>& cuts, const CutOptions& options, bool cold) {
  const bool is_program = method->program() != nullptr;  // a new process each time: nothing stays warm
  for (int i = 0; i < (is_program ? 0 : cold ? 1 : 2); ++i) cut(base, cuts, options);
  restore(base, cuts);
  if (cold) chill_caches();
  return cut_restored(base, cuts, options);
}

CutRun Worker::cut_restored(const BaseSheet& base, const std::vector<Curve>& cuts, const CutOptions& options) {
  double constrain_us = 0;
  constraints = {};
  const ConstraintSource* const source = method->constraint_source();
  const bool makes_polygons = source && source->constraint_kind() == ConstraintKind::polygons;
  const auto after_cut = [&](std::size_t /*cut*/) {
    StopWatch watch;
    constraints = source->next_constraints(base.sheet, sheet, constraints, {});
    constrain_us += watch.lap();
  };
  const bool follows = source && !makes_polygons;
  CutRun run = cut_all(sheet, locator_, cutter, cuts, *method, options,
                       follows ? std::function<void(std::size_t)>(after_cut) : nullptr);
  // A scene's polygons follow each cut, too, which takes about as long as all of them at once.
  if (makes_polygons && (run.status == Status::ok || run.status == Status::deviated)) {
    StopWatch watch;
    constraints = source->constraints(base.sheet, sheet);
    constrain_us += watch.lap();
  }
  run.time_us.constrain = constrain_us;
  return run;
}

}  // namespace cutbench
