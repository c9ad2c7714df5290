// `cutbench merge` and `cutbench missing`: the shards of a run, whose work is in harness/records/merge.cpp.
#include "harness/records/merge.h"

#include <iostream>
#include <memory>

#include "experiments/program/commands/command.h"

namespace cutbench {

namespace {

struct MergeArguments {
  std::vector<std::string> shards;
  std::string out;
  int of = 0;

  std::vector<std::filesystem::path> folders() const { return {shards.begin(), shards.end()}; }
};

}  // namespace

Command add_merge(Options& app) {
  auto arguments = std::make_shared<MergeArguments>();
  auto command = app.add_subcommand("merge", "put the shards of a run together");
  command.add_option("shards", arguments->shards, "folders with records.csv and context.json").required();
  command.add_option("--out", arguments->out, "the folder for the whole").required();
  command.footer(
      "example:\n"
      "  cutbench merge shards/*/robustness --out results/robustness\n"
      "exit codes:\n"
      "  0  done\n"
      "  1  a file can't be written\n"
      "  2  bad input: an option, or a shard that is missing, unfinished, cut short, there twice or of another run");
  return {command, [arguments](const std::string&) {
            merge_shards(arguments->folders(), arguments->out);
            return done;
          }};
}

Command add_missing(Options& app) {
  auto arguments = std::make_shared<MergeArguments>();
  auto command = app.add_subcommand("missing", "the numbers of the shards that are still to be run");
  command.add_option("shards", arguments->shards, "folders of shards, finished or not").required();
  command.add_option("--of", arguments->of, "number of shards").required().positive();
  command.footer(
      "example:\n"
      "  cutbench missing --of 64 shards/*/robustness\n"
      "exit codes:\n"
      "  0  none is missing\n"
      "  1  some are; their numbers are printed with commas between them\n"
      "  2  bad input: an option, or a shard of another run");
  return {command, [arguments](const std::string&) {
            const std::vector<int> missing = missing_shards(arguments->folders(), arguments->of);
            for (const int n : missing) std::cout << (n == missing.front() ? "" : ",") << n;
            if (!missing.empty()) std::cout << '\n';
            return missing.empty() ? done : fell_short;
          }};
}

}  // namespace cutbench
