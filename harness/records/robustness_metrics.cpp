#include "harness/records/metrics.h"

namespace cutbench {

std::vector<Metric> robustness_metrics() {
  using enum Direction;
  constexpr Group group = Group::robustness;
  return {
      {"tried", "", "cuts", none, group, "Cuts; the sum of the next eight."},
      {"ok", "", "ok", none, group, "Cuts with status ok, judged by the oracle against the sheet right before each."},
      {"noop", "", "nothing to do", none, group, "Cuts with nothing to do, judged likewise."},
      {"deviated", "", "deviated", lower, group,
       "Cuts that deviated by the declared policy, judged likewise, except that the number of pieces may differ."},
      {"refused", "", "refused", lower, group, "Cuts that were refused; they are left out, and the case goes on."},
      {"failed", "", "failed", lower, group, "Cuts that failed; they are left out, and the case goes on."},
      {"wrong", "", "wrong", lower, group,
       "Whatever the status: refused by the oracle or the sheet's own check, or not bit-unchanged after "
       "noop, refused, failed. Ends the case."},
      {"crashed", "", "crashed", lower, group, "The process died, by a signal or an exception. Ends the case."},
      {"timed_out", "", "timed out", lower, group, "Took longer than `time_limit_s`. Ends the case."},
      {"carefully", "", "embedded carefully", lower, group,
       "Of `tried`: points were too close for the method's own way, so that the harness embedded the path "
       "(harness/cut/embed_carefully.h)."},
      {"cases", "", "cases", none, group, "Cases: one to five cuts, one after the other."},
      {"near_event_cases", "", "near cases", none, group, "Cases with an event nearer than 1e-9 mean edges."},
      {"slowest_us", "us", "slowest cut", lower, group, "Time of the slowest cut, without its judgement."}};
}

}  // namespace cutbench
