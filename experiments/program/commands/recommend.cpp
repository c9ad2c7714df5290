// The options of `cutbench recommend`, whose work is in experiments/advice/recommend.cpp.
#include "experiments/advice/recommend.h"

#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "experiments/program/commands/command.h"
#include "experiments/program/commands/method_options.h"
#include "harness/base/errors.h"
#include "harness/fem/solvers/solver_table.h"
#include "harness/files/scene_file.h"
#include "harness/files/toml_reader.h"
#include "harness/files/whole_file.h"
#include "harness/records/context.h"

namespace cutbench {

namespace {

struct RecommendArguments {
  std::string scene, report, quantity, calibration = "experiments/recommend_calibration.toml";
  bool reference = false;
  ChordTolerance chord_tolerance;
  RecommendOptions options{
      .methods = {"adaptive_remesh", "conventional_split", "snap_or_split", "warp_and_refine", "delaunay_refine"},
      .solvers = {"cg_sliver_blocks", "cg", "multigrid"}};
};

Exit run_recommendation(RecommendArguments& arguments) {
  RecommendOptions& options = arguments.options;
  if (!arguments.report.empty()) check_writable(arguments.report, "--report");
  if (!arguments.reference && options.max_error == 0)
    throw InputError("give --max-error E, such as 0.05 for 5 %, or --reference for the converged value alone");
  const Scene scene = read_scene(arguments.scene);
  if (scene.family.empty())
    throw InputError(
        "this scene's sheet is read from a file, and has no other resolutions; give a sheet with \"family\"");
  for (const std::string& method : options.methods) find_method(method);
  check_solver_names(options.solvers, "--solvers");
  options.cut = arguments.chord_tolerance.cut_options();
  options.quantity = (arguments.quantity.empty() ? scene.cuts.empty() : arguments.quantity == "deflection")
                         ? Quantity::deflection
                         : Quantity::gape;
  if (options.quantity == Quantity::gape && scene.cuts.empty())
    throw InputError("--quantity gape: this scene has no cuts; give deflection");
  const auto write = [&](const nlohmann::ordered_json& report) {
    if (!arguments.report.empty()) WholeFile(arguments.report, report.dump(2) + "\n").place();
  };
  if (arguments.reference) {
    const Converged converged = converge(scene, options);
    print_converged(converged, options.quantity);
    write(json_of(converged));
    return converged.missing.empty() ? done : fell_short;
  }
  const Calibration calibration = read_calibration(arguments.calibration);
  const double load = load_average();
  const Recommendation result = recommend(scene, options, calibration);
  print_recommendation(result, options, calibration);
  std::printf("ms: processor time of computing for a simulated second; of a solve at rest\n%s",
              busy_note(load).c_str());
  write(json_of(result));
  return result.chosen ? done : fell_short;
}

}  // namespace

Command add_recommend(Options& app) {
  auto arguments = std::make_shared<RecommendArguments>();
  auto command = app.add_subcommand(
      "recommend", "the cheapest method, solver, resolution and step for a scene whose error is small enough");
  command.add_option("scene", arguments->scene, "scene file (TOML)").required();
  command
      .add_option("--max-error", arguments->options.max_error,
                  "relative error of the quantity at the end, against its converged value, such as 0.05")
      .positive();
  command
      .add_option("--max-ms", arguments->options.max_ms,
                  "milliseconds of processor time for a simulated second; otherwise any")
      .positive();
  command
      .add_option("--quantity", arguments->quantity,
                  "gape or deflection, the largest; otherwise gape if there are cuts")
      .one_of({"gape", "deflection"});
  command.add_option("--methods", arguments->options.methods, "to choose from; the first makes the converged value")
      .comma_separated()
      .shows_default();
  command
      .add_option("--solvers", arguments->options.solvers,
                  "to choose from; where a run by the first errs too much, the others are not tried")
      .comma_separated()
      .shows_default();
  arguments->chord_tolerance.add_to(command, "as of `cutbench simulate`");
  command.add_option("--calibration", arguments->calibration, "how well extrapolated values are known (TOML)")
      .shows_default();
  command.add_flag("--reference", arguments->reference, "the converged value alone");
  command.add_flag("--exhaustive", arguments->options.everything,
                   "runs and times all, also what can't be the cheapest");
  command.add_option("--time-limit", arguments->options.time_limit, "seconds of processor time for each run")
      .shows_default()
      .positive();
  command.add_option("--report", arguments->report, "all runs as JSON; none where it is not given");
  command.footer(
      "example:\n"
      "  cutbench recommend experiments/scenes/fig8_edge_quality_patches.toml --max-error 0.1\n"
      "exit codes:\n"
      "  0  a choice whose error is small enough for certain\n"
      "  1  unknown, or a file can't be written\n"
      "  2  bad input: an option or a file");
  return {command, [arguments](const std::string&) { return run_recommendation(*arguments); }};
}

}  // namespace cutbench
