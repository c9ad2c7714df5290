// The options of `cutbench compare`, whose work is in harness/records/compare.cpp.
#include "harness/records/compare.h"

#include <filesystem>
#include <iostream>
#include <memory>

#include "experiments/program/commands/command.h"
#include "harness/base/errors.h"
#include "harness/files/whole_file.h"
#include "harness/records/compare_runs.h"

namespace cutbench {

namespace {

struct CompareArguments {
  std::string base, head, markdown, json, thresholds, accepted;
};

Exit compare_folders(const CompareArguments& arguments) {
  if (!arguments.thresholds.empty() || !arguments.accepted.empty())
    throw InputError("--thresholds and --accepted are for files of experiments/track, and these are folders");
  const RunComparison comparison = compare_runs(arguments.base, arguments.head);
  std::cout << as_text(comparison);
  if (!arguments.markdown.empty()) WholeFile(arguments.markdown, as_markdown(comparison)).place();
  if (!arguments.json.empty()) WholeFile(arguments.json, as_json(comparison)).place();
  if (!comparison.not_comparable.empty()) return bad_input;
  if (comparison.is_slower()) return fell_short;
  return comparison.has_too_few_cases() ? bad_input : done;
}

Exit run_compare(const CompareArguments& arguments) {
  if (!arguments.markdown.empty()) check_writable(arguments.markdown, "--markdown");
  if (!arguments.json.empty()) check_writable(arguments.json, "--json");
  const bool folder = std::filesystem::is_directory(arguments.base);
  if (folder != std::filesystem::is_directory(arguments.head))
    throw InputError(arguments.base + " and " + arguments.head + ": one is a folder; give two files or two folders");
  if (folder) return compare_folders(arguments);
  const TrackFile base = read_track_file(arguments.base), head = read_track_file(arguments.head);
  const ThresholdTable thresholds =
      arguments.thresholds.empty() ? ThresholdTable() : ThresholdTable(arguments.thresholds);
  std::map<std::string, std::string> accepted;
  if (!arguments.accepted.empty()) accepted = read_accepted(text_of(arguments.accepted));
  const Comparison comparison = compare(base, head, thresholds, accepted);
  std::cout << as_text(comparison, base, head);
  if (!arguments.markdown.empty()) WholeFile(arguments.markdown, as_markdown(comparison, base, head)).place();
  if (!arguments.json.empty()) WholeFile(arguments.json, as_json(comparison, base, head)).place();
  if (!comparison.not_comparable.empty()) return bad_input;
  return comparison.is_slower() ? fell_short : done;
}

}  // namespace

Command add_compare(Options& app) {
  auto arguments = std::make_shared<CompareArguments>();
  auto command =
      app.add_subcommand("compare", "what became slower between two files of experiments/track, or two folders of run");
  command.add_option("base", arguments->base, "before: JSON of experiments/track, or a folder of cutbench run")
      .required();
  command.add_option("head", arguments->head, "after: likewise").required();
  command.add_option("--markdown", arguments->markdown, "the report as Markdown; none where it is not given");
  command.add_option("--json", arguments->json, "the report as JSON; none where it is not given");
  command.add_option("--thresholds", arguments->thresholds, "TOML, such as experiments/track.toml");
  command.add_option("--accepted", arguments->accepted,
                     "a commit message: a line \"slower: ROW, REASON\" accepts that row");
  command.footer(
      "example:\n"
      "  cutbench compare base.json head.json --thresholds experiments/track.toml\n"
      "  cutbench compare results/before results/table1_timing\n"
      "exit codes:\n"
      "  0  nothing is slower, or what is slower is accepted\n"
      "  1  something is slower, a verdict is worse, or a report can't be written\n"
      "  2  bad input: an option or a file; or files that don't compare: other tools, a row that is missing,\n"
      "     or too few cases to say anything: 6 are needed");
  return {command, [arguments](const std::string&) { return run_compare(*arguments); }};
}

}  // namespace cutbench
