#include "harness/study/study_run.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace cutbench {

std::string identity_of(const Experiment& experiment, const Context& context) {
  return nlohmann::json{context.identity(experiment.records_times()), experiment.stem, experiment.asked,
                        experiment.seed, identity_of_methods(experiment)}
      .dump();
}

StudyRun::StudyRun(const Experiment& experiment, const Context& context, const RunOptions& options,
                   const std::vector<std::string>& columns, std::size_t keys)
    : experiment_(experiment),
      options_(options),
      file_(std::filesystem::path(options.out) / experiment.stem,
            identity_of(experiment, context) + shard_line(options), columns, keys),
      context_(context),
      columns_(columns) {}

bool StudyRun::run() {
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

std::vector<std::size_t> StudyRun::next_ours(std::size_t n) {
  items_ += n;
  return options_.ours(items_ - n, n);
}

Record StudyRun::start_row(const std::string& sheet, std::int64_t resolution, const std::string& method,
                           const std::string& parameter) const {
  Record row(columns_);
  row.set("suite_version", std::string(suite_version));
  row.set("sheet", sheet);
  row.set("method", method);
  row.set("parameter", parameter);
  row.set("resolution", resolution);
  row.set("seed", to_int64(experiment_.seed));
  return row;
}

void StudyRun::set_fate(Record& row, Fate fate) {
  if (fate == Fate::done) return;
  row.set("verdict", std::string(name_of(fate == Fate::timed_out ? Verdict::timed_out : Verdict::crashed)));
}

}  // namespace cutbench
