// The options of `cutbench ablate`, whose work is in experiments/advice/ablate.cpp.
#include "experiments/advice/ablate.h"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "experiments/program/commands/command.h"
#include "experiments/program/commands/method_options.h"
#include "harness/files/whole_file.h"
#include "harness/records/context.h"
#include "harness/scenes/scene_file.h"

namespace cutbench {

namespace {

struct AblateArguments {
  std::string scene, report;
  MethodOptions method{.method = "conventional_split", .settings = {}, .chord_tolerance = {}};
  int resolution = 0;
  double time_limit = 600;
};

Exit run_ablation(const AblateArguments& arguments, const Scene* given) {
  if (!arguments.report.empty()) check_writable(arguments.report, "--report");
  Scene scene = given ? *given : read_scene(arguments.scene);
  set_resolution(scene, arguments.resolution);
  const auto method = arguments.method.row().make(arguments.method.parameter());
  const double load = load_average();
  const auto rows = ablate(scene, *method, arguments.method.chord_tolerance.cut_options(), arguments.time_limit);
  print_ablations(rows);
  std::printf("ms/s: wall time of computing for a simulated second; of a solve at rest\n%s", busy_note(load).c_str());
  if (!arguments.report.empty()) WholeFile(arguments.report, json_of(rows).dump(2) + "\n").place();
  return rows.front().verdict == Verdict::ok ? done : fell_short;
}

}  // namespace

Command add_ablate(Options& app, const Scene* given) {
  auto arguments = std::make_shared<AblateArguments>();
  auto command =
      app.add_subcommand("ablate", "leave out one part of a scene's model at a time: what changes, what it saves");
  command.add_option("scene", arguments->scene, "scene file (TOML)").required();
  arguments->method.add_to(command);
  command.add_option("--resolution", arguments->resolution, "triangles of the sheet; otherwise those of the scene")
      .positive();
  command.add_option("--time-limit", arguments->time_limit, "seconds of processor time for each run")
      .shows_default()
      .positive();
  command.add_option("--report", arguments->report, "the table as JSON; none where it is not given");
  command.footer(
      "example:\n"
      "  cutbench ablate experiments/scenes/fig8_edge_quality_patches.toml\n"
      "exit codes:\n"
      "  0  the whole model ended as ok\n"
      "  1  it did not, or a file can't be written\n"
      "  2  bad input: an option or a file");
  return {command, [arguments, given](const std::string&) { return run_ablation(*arguments, given); }};
}

}  // namespace cutbench
