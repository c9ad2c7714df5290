// `cutbench columns`: the table of metrics (harness/records/metrics.h), as the documents show it.
#include <iostream>
#include <memory>

#include "experiments/program/commands/command.h"
#include "harness/records/metrics.h"

namespace cutbench {

Command add_columns(Options& app) {
  auto as_json = std::make_shared<bool>(false);
  auto command = app.add_subcommand("columns", "the columns of records and reports, with what each means");
  command.add_flag("--json", *as_json, "as JSON (results/columns.json)");
  command.footer(
      "example:\n"
      "  cutbench columns --json\n"
      "exit codes:\n"
      "  0  done\n"
      "  1  standard output can't be written\n"
      "  2  bad input: an unknown option");
  return {command, [as_json](const std::string&) {
            std::cout << (*as_json ? columns_as_json() : columns_as_markdown());
            return done;
          }};
}

}  // namespace cutbench
