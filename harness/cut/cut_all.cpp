#include "harness/cut/cut_all.h"

#include <ctime>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

double cpu_time_us() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return 1e6 * to_double(t.tv_sec) + 1e-3 * to_double(t.tv_nsec);
}

}  // namespace

CutRun cut_all(Sheet& sheet, Locator& locator, Cutter& cutter, std::span<const Curve> cuts, CuttingMethod& method,
               const CutOptions& options, const std::function<void(std::size_t)>& after_cut) {
  CutRun run;
  run.status = Status::noop;
  for (const Curve& curve : cuts) {
    const double start = cpu_time_us();
    const CutOutcome outcome = cutter.cut(sheet, locator, curve, method, options);
    run.cpu_us += cpu_time_us() - start;
    run.time_us += outcome.time_us;
    run.crossed_triangles += outcome.crossed_triangles;
    run.recovered_segments += outcome.recovered_segments;
    run.carefully |= outcome.carefully;
    run.verdict = outcome.verdict;
    const bool says_more = !outcome.reason.empty() || run.status == Status::noop;
    if (says_more && (outcome.status != Status::noop || run.status == Status::noop)) run.reason = outcome.reason;
    if (outcome.status != Status::noop) run.status = outcome.status;
    if (run.status == Status::failed || run.status == Status::refused) break;
    if (after_cut && outcome.status != Status::noop) after_cut(to_size(&curve - cuts.data()));
  }
  return run;
}

}  // namespace cutbench
