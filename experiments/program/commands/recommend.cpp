// The options of `cutbench recommend`, whose work is in experiments/advice/recommend.cpp.
#include "experiments/advice/recommend.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "experiments/advice/which_method.h"
#include "experiments/program/commands/command.h"
#include "experiments/program/commands/method_options.h"
#include "harness/base/errors.h"
#include "harness/fem/solvers/solver_table.h"
#include "harness/files/whole_file.h"
#include "harness/records/context.h"
#include "harness/scenes/scene_file.h"
#include "harness/scenes/toml_reader.h"

namespace cutbench {

namespace {

struct RecommendArguments {
  std::vector<std::string> yes, no;  // answers, where there is no scene
  std::string scene, report, quantity, calibration;
  bool reference = false;
  ChordTolerance chord_tolerance;
  RecommendOptions options{
      .methods = {"adaptive_remesh", "conventional_split", "snap_or_split", "warp_and_refine", "delaunay_refine",
                  "cut_polygons", "active_node", "vertex_snap", "cisamr", "edge_release"},
      .solvers = {"cg_sliver_blocks", "cg", "multigrid"}};
};

/// Of the options, or of the next lines of standard input.
bool answer(const RecommendArguments& arguments, const Question& question) {
  const auto has = [&](const std::vector<std::string>& keys) {
    return std::find(keys.begin(), keys.end(), question.key) != keys.end();
  };
  if (has(arguments.yes)) return true;
  if (has(arguments.no)) return false;
  std::string line;
  do {
    std::fprintf(stderr, "%s [y/n] ", question.asks.c_str());
    std::getline(std::cin, line);
    if (line == "y" || line == "yes") return true;
    if (line == "n" || line == "no") return false;
  } while (std::cin);
  throw InputError("\"" + question.asks + "\" has no answer: give --yes " + question.key + " or --no " + question.key);
}

Exit run_choice(const RecommendArguments& arguments) {
  if (arguments.options.max_error > 0 || arguments.reference || !arguments.report.empty())
    throw InputError(
        "--max-error, --reference and --report are for a scene: give one, or answer questions without them");
  const WhichMethod table = which_method_table();
  std::vector<std::string> keys;
  for (const Question& question : table.questions) keys.push_back(question.key);
  check_names(arguments.yes, keys, "--yes");
  check_names(arguments.no, keys, "--no");
  print_choice(choose_method(table, [&](const Question& question) { return answer(arguments, question); }));
  return done;
}

Exit run_recommendation(RecommendArguments& arguments, const Scene* given) {
  if (arguments.scene.empty()) return run_choice(arguments);
  RecommendOptions& options = arguments.options;
  if (!arguments.report.empty()) check_writable(arguments.report, "--report");
  if (!arguments.reference && options.max_error == 0)
    throw InputError("give --max-error E, such as 0.05 for 5 %, or --reference for the converged value alone");
  const Scene scene = given ? *given : read_scene(arguments.scene);
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
  return result.chosen && result.beyond.empty() ? done : fell_short;
}

}  // namespace

Command add_recommend(Options& app, const Scene* given) {
  auto arguments = std::make_shared<RecommendArguments>();
  auto command = app.add_subcommand("recommend",
                                    "the cheapest method, solver, resolution and step for a scene whose error is small "
                                    "enough; without a scene: a method");
  command.add_option("scene", arguments->scene, "scene file (TOML); without one, a few questions lead to a method");
  command
      .add_option("--yes", arguments->yes,
                  "answers, without a scene: explicit, diagonal, exact_path, fixed_vertices, many_cuts, error_first")
      .comma_separated();
  command.add_option("--no", arguments->no, "likewise; what is left open is asked").comma_separated();
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
  command.add_option("--calibration", arguments->calibration,
                     "how well extrapolated values are known (TOML), instead of the built-in one");
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
      "  cutbench recommend --yes explicit --no diagonal\n"
      "exit codes:\n"
      "  0  a choice whose error is small enough for certain, or a method without a scene\n"
      "  1  unknown, a guess for a scene unlike those of the calibration, or a file can't be written\n"
      "  2  bad input: an option or a file");
  return {command, [arguments, given](const std::string&) { return run_recommendation(*arguments, given); }};
}

}  // namespace cutbench
