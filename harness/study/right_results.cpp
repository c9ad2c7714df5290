#include "harness/study/right_results.h"

#include <algorithm>
#include <cstdio>

#include "harness/cut/cut.h"

namespace cutbench {

void RightResults::add(const Record& row) {
  const std::string &status = row.get("status"), &verdict = row.get("verdict"), &reason = row.get("reason");
  if (status == name_of(Status::noop) && verdict == "ok") return;
  const bool refused = status == name_of(Status::refused);
  const bool right = verdict == "ok" && !refused && status != name_of(Status::failed);
  add(row.get("method"), right, !right,
      right ? "" : (refused ? "refused" : verdict) + (reason.empty() ? "" : ": " + reason));
}

void RightResults::add(const std::string& method, std::int64_t right, std::int64_t others, const std::string& why) {
  Counts& counts = methods_[method];
  counts.right += right;
  counts.others += others;
  if (!why.empty()) counts.why = why.substr(0, why.find('\n'));
}

bool RightResults::report(const Experiment& experiment, bool quiet) const {
  bool programs_work = true;
  for (const auto& entry : methods_) {
    const auto& method = entry.first;
    const auto& counts = entry.second;
    if (counts.right > 0 || counts.others == 0) continue;
    programs_work &= std::none_of(experiment.programs.begin(), experiment.programs.end(),
                                  [&](const ProgramSettings& program) { return program.name == method; });
    if (!quiet)
      std::fprintf(stderr, "%s: %s made none of its %lld results right; the last: %s\n", experiment.stem.c_str(),
                   method.c_str(), static_cast<long long>(counts.others), counts.why.c_str());
  }
  return programs_work;
}

}  // namespace cutbench
