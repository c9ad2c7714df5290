#include "harness/study/study.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace cutbench {

std::string identity_of(const Experiment& experiment, const Context& context, bool with_times) {
  return nlohmann::json{context.identity(with_times), experiment.stem, experiment.asked, experiment.seed,
                        identity_of_methods(experiment)}
      .dump();
}

Study::Study(const Experiment& experiment, const Context& context, const RunOptions& options, const Rows& rows)
    : experiment_(experiment),
      options_(options),
      file_(std::filesystem::path(options.out) / experiment.stem,
            identity_of(experiment, context, rows.with_times) + shard_line(options), rows.columns, rows.keys),
      context_(context),
      columns_(rows.columns) {}

bool Study::run() {
  if (!file_.note().empty() && !options_.quiet)
    std::fprintf(stderr, "%s: %s\n", experiment_.stem.c_str(), file_.note().c_str());
  Progress progress(experiment_.stem, case_count(), options_.quiet);
  run_cases(progress);
  file_.finish(context_, experiment_.stem, experiment_.claim, options_.command, experiment_.seed);
  RightResults results;
  for (const std::string& line : file_.lines()) add_row(Record(columns_, line), results);
  if (!options_.quiet) print_summary();
  const bool programs_work = results.report(experiment_, options_.quiet);
  return programs_work && all_ok();
}

}  // namespace cutbench
