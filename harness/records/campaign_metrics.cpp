#include "harness/records/metrics.h"

namespace cutbench {

void add_campaign(std::vector<Metric>& t) {
  t.push_back({"tried", "", "cuts", Direction::none, Group::campaign, "Cuts; the sum of the next eight."});
  t.push_back({"ok", "", "ok", Direction::none, Group::campaign,
               "Cuts with status ok, judged by the oracle against the sheet right before each."});
  t.push_back(
      {"noop", "", "nothing to do", Direction::none, Group::campaign, "Cuts with nothing to do, judged likewise."});
  t.push_back({"deviated", "", "deviated", Direction::lower, Group::campaign,
               "Cuts that deviated by the declared policy, judged likewise, except that the number of pieces may "
               "differ."});
  t.push_back({"refused", "", "refused", Direction::lower, Group::campaign,
               "Cuts that were refused; they are left out, and the case goes on."});
  t.push_back({"failed", "", "failed", Direction::lower, Group::campaign,
               "Cuts that failed; they are left out, and the case goes on."});
  t.push_back({"wrong", "", "wrong", Direction::lower, Group::campaign,
               "Whatever the status: refused by the oracle or the sheet's own check, or not bit-unchanged after "
               "noop, refused, failed. Ends the case."});
  t.push_back({"crashed", "", "crashed", Direction::lower, Group::campaign,
               "The process died, by a signal or an exception. Ends the case."});
  t.push_back({"timed_out", "", "timed out", Direction::lower, Group::campaign,
               "Took longer than `time_limit_s`. Ends the case."});
  t.push_back({"carefully", "", "embedded carefully", Direction::lower, Group::campaign,
               "Of `tried`: points were too close for the method's own way, so that the harness embedded the path "
               "(harness/cut/embed_carefully.h)."});
  t.push_back(
      {"cases", "", "cases", Direction::none, Group::campaign, "Cases: one to five cuts, one after the other."});
  t.push_back({"near_event_cases", "", "near cases", Direction::none, Group::campaign,
               "Cases with an event nearer than 1e-9 mean edges."});
  t.push_back({"slowest_us", "us", "slowest cut", Direction::lower, Group::campaign,
               "Time of the slowest cut, without its judgement."});
}

}  // namespace cutbench
