// The options of `cutbench score`, whose work is in experiments/program/score.cpp.
#include "experiments/program/score.h"

#include <memory>

#include "experiments/program/commands/command.h"
#include "experiments/program/commands/method_options.h"
#include "harness/base/errors.h"
#include "harness/files/whole_file.h"

namespace cutbench {

Command add_score(Options& app) {
  struct ScoreOptions {
    ScoreArguments arguments;
    ChordTolerance tolerance;
    ReadingOptions reading;
  };
  auto options = std::make_shared<ScoreOptions>();
  auto command = app.add_subcommand("score", "judge a cut that any program made");
  command.add_option("--mesh", options->arguments.mesh, "the sheet before: OBJ, OFF or PLY").required();
  command.add_option("--path", options->arguments.path, "the path: JSON").required();
  command.add_option("--result", options->arguments.result, "the sheet after: OBJ, OFF or PLY").required();
  command.add_option("--report", options->arguments.report, "what was measured, as JSON; none where it is not given");
  command.add_option("--svg", options->arguments.svg,
                     "a drawing of the place where something is wrong, or of the whole sheet");
  command.add_flag("--json", options->arguments.json, "print JSON, the same as in the report");
  options->reading.add_to(command);
  options->tolerance.add_to(command, "allowed incision error in mean rest edges, or inf: the longest edge");
  auto digits = command.add_option("--digits", options->arguments.digits,
                                   "significant digits that the result was written with, 1 to 17 (default: strict)");
  command.add_flag("--keeps-vertices", options->arguments.keeps_vertices,
                   "the sheet's vertices must be there with the same numbers and rest positions");
  command.add_flag("--deletes", options->arguments.deletes,
                   "the triangles that the path crosses are to be taken out, instead of divided");
  command.footer(
      "example:\n"
      "  cutbench score --mesh experiments/examples/sheet.obj --path experiments/examples/path.json --result cut.obj\n"
      "exit codes:\n"
      "  0  the result is correct\n"
      "  1  the result is wrong, or the report can't be written\n"
      "  2  bad input: an option or a file");
  return {command, [options, digits](const std::string&) {
            const int given = options->arguments.digits;
            if (digits.given() && (given < 1 || given > 17))
              throw InputError("--digits " + std::to_string(given) + ": must be from 1 to 17");
            const std::string& report = options->arguments.report;
            options->arguments.reading = options->reading.reading();
            if (!report.empty()) check_writable(report, "--report");
            if (!options->arguments.svg.empty()) check_writable(options->arguments.svg, "--svg");
            return score(options->arguments, options->tolerance.cut_options()) ? done : fell_short;
          }};
}

}  // namespace cutbench
