// The program: joins the harness with the table of methods.
#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "experiments/score.h"
#include "experiments/simulate.h"
#include "harness/base/interrupt.h"
#include "harness/base/stop_watch.h"
#include "harness/cut/cut_all.h"
#include "harness/judge/assessment.h"
#include "harness/judge/judged_sheet.h"
#include "harness/mesh/families.h"
#include "harness/mesh/mesh_io.h"
#include "harness/path/pick.h"
#include "harness/records/report_json.h"
#include "harness/run_experiment.h"
#include "methods/registry.h"

namespace {

using namespace cutbench;

enum Exit { done = 0, fell_short = 1, bad_input = 2 };

// --- cutbench methods ------------------------------------------------------------------------------------------------

int list_methods(bool as_json) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const MethodRow& m : all_methods()) {
    const Promises& p = m.promises;
    std::vector<std::string> promises;
    for (const auto& [kept, name] : {std::pair{p.exact_incision, "exact_incision"},
                                     {p.keeps_area, "keeps_area"},
                                     {p.conforming, "conforming"},
                                     {p.keeps_vertices, "keeps_vertices"}})
      if (kept) promises.emplace_back(name);
    if (as_json) {
      nlohmann::ordered_json entry{{"name", m.name}, {"summary", m.summary}, {"knob", nullptr}, {"promises", promises}};
      entry["incision_bound"] = {{"longest_edges", p.incision_bound.longest_edges},
                                 {"chord_tolerances", p.incision_bound.chord_tolerances}};
      if (!m.knob.name.empty())
        entry["knob"] = {{"name", m.knob.name}, {"default", m.knob.value}, {"meaning", m.knob.meaning}};
      list.push_back(entry);
      continue;
    }
    std::printf("%-20s %s\n", m.name.c_str(), m.summary.c_str());
    if (!m.knob.name.empty())
      std::printf("%20s   knob %s = %g: %s\n", "", m.knob.name.c_str(), m.knob.value, m.knob.meaning.c_str());
    std::string text;
    for (const auto& name : promises) text += (text.empty() ? "" : ", ") + name;
    std::printf("%20s   promises %s\n", "", text.empty() ? "nothing" : text.c_str());
    std::printf("%20s   incision error at most", "");
    if (p.incision_bound.longest_edges > 0)
      std::printf(" %g x the sheet's longest edge +", p.incision_bound.longest_edges);
    std::printf(" %g x the chord tolerance\n", p.incision_bound.chord_tolerances);
  }
  if (as_json) std::cout << list.dump(2) << '\n';
  return done;
}

// --- cutbench cut ----------------------------------------------------------------------------------------------------

struct CutArguments {
  std::string mesh, path, method, out, report;
  std::vector<std::string> set;
  std::string chord_tolerance = "0.05";
};

double number(const std::string& text, const std::string& what) {
  std::size_t end = 0;
  double value = 0;
  try {
    value = std::stod(text, &end);
  } catch (const std::exception&) {
    end = std::string::npos;
  }
  if (end != text.size() || std::isnan(value)) throw InputError(what + ": \"" + text + "\" is not a number");
  return value;
}

double knob_value(const MethodRow& row, const std::vector<std::string>& settings) {
  double value = row.knob.value;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    const std::string name = setting.substr(0, equals);
    if (row.knob.name.empty()) throw InputError("--set " + setting + ": method \"" + row.name + "\" has no knob");
    if (equals == std::string::npos || name != row.knob.name)
      throw InputError("--set " + setting + ": the knob of \"" + row.name + "\" is set as " + row.knob.name + "=VALUE");
    value = number(setting.substr(equals + 1), "--set " + name);
  }
  return value;
}

CutOptions options_with(const std::string& chord_tolerance) {
  CutOptions options;
  options.chord_tolerance = number(chord_tolerance, "--chord-tolerance");
  if (!(options.chord_tolerance > 0)) throw InputError("--chord-tolerance: must be positive, or inf");
  return options;
}

void print_notes(const MeshData& mesh) {
  for (const auto& note : mesh.notes) std::cerr << "note: " << note << '\n';
}

/// OUT may be the mesh that was read, which is a wish one can have; a report in place of a mesh or path is a slip.
void check_report_place(const CutArguments& arguments) {
  check_writable(arguments.report, "--report");
  const auto place = [](const std::string& file) { return std::filesystem::weakly_canonical(file); };
  for (const std::string& other : {arguments.mesh, arguments.path, arguments.out})
    if (place(other) == place(arguments.report))
      throw InputError("--report " + arguments.report + ": would take the place of " + other + "; give another name");
}

/// The path in rest space. Nothing moves between the cuts of a file, so all picks can be made on the sheet as it is
/// read.
std::vector<Curve> at_rest(const std::vector<std::variant<Curve, PickedCurve>>& path, const Sheet& sheet,
                           const std::string& name, double& pick_us) {
  std::vector<Curve> cuts;
  std::optional<Picker> picker;
  StopWatch watch;
  for (const auto& cut : path) {
    if (const auto* curve = std::get_if<Curve>(&cut)) {
      cuts.push_back(*curve);
      continue;
    }
    if (!picker) picker.emplace(sheet);
    cuts.push_back(picker->rest_curve(std::get<PickedCurve>(cut), name + ", cut " + std::to_string(cuts.size())));
  }
  pick_us = picker ? watch.lap() : 0;
  return cuts;
}

int cut(const CutArguments& arguments) {
  const MethodRow& row = find_method(arguments.method);
  const double knob = knob_value(row, arguments.set);
  const auto method = row.make(knob);
  const CutOptions options = options_with(arguments.chord_tolerance);
  check_mesh_place(arguments.out, "--out");
  if (!arguments.report.empty()) check_report_place(arguments);
  const auto path = read_path_with_picks(arguments.path);
  const MeshData data = read_mesh(arguments.mesh);
  print_notes(data);

  const Sheet before(data);
  double pick_us = 0;
  const std::vector<Curve> cuts = at_rest(path, before, arguments.path, pick_us);
  Sheet sheet = before;
  Locator locator(sheet);
  Cutter cutter;
  const CutRun run = cut_all(sheet, locator, cutter, cuts, *method, options);
  if (run.status == Status::refused) throw InputError(row.name + " refuses this cut: " + run.reason);
  if (run.status == Status::failed) {
    std::cerr << "failed (" << run.verdict << "): " << run.reason << '\n';
    return fell_short;
  }
  const Assessment a =
      assess(before, sheet, judge_one_by_one(before, sheet, cuts, row.promises, row.make(knob), options),
             forced_corners_of(before, cuts));
  WholeFile out = mesh_file(sheet.to_mesh_data(), arguments.out);
  if (!arguments.report.empty()) report_file(arguments.report, row.name, run, pick_us, a).place();  // both, or neither
  out.place();
  std::printf("%s: %zu triangles crossed, %td added, %d pieces, max aspect ratio of changed triangles %.3g, %.1f us\n",
              name_of(run.status), run.crossed_triangles, a.triangles_added, a.judgement.pieces, a.cut.ar_max,
              run.time_us.total());
  if (a.judgement.ok) return done;
  for (const auto& problem : a.judgement.problems)
    std::cerr << "failed (" << a.judgement.verdict << "): " << problem << '\n';
  return fell_short;
}

// --- cutbench simulate -----------------------------------------------------------------------------------------------

struct SimulateArguments {
  std::string scene, method = "conventional_split", out, frames;
  std::vector<std::string> set;
  std::string chord_tolerance = "0.05";
  int resolution = 0, every = 8;
};

int simulate(const SimulateArguments& arguments, const std::string& command) {
  if (!arguments.out.empty()) check_mesh_place(arguments.out, "--out");
  Scene scene = read_scene(arguments.scene);
  const MethodRow& row = find_method(arguments.method);
  const double knob = knob_value(row, arguments.set);
  const auto method = row.make(knob);
  if (arguments.resolution > 0) {
    squares_per_side(arguments.resolution);
    if (!scene.mesh_file.empty())
      throw InputError("--resolution: this scene's sheet is a file, whose triangles are what they are");
    scene.resolution = arguments.resolution;
  }
  if (!scene.mesh_file.empty()) print_notes(mesh_of(scene));
  char knob_text[64] = "";
  if (!row.knob.name.empty()) std::snprintf(knob_text, sizeof knob_text, " %s=%g", row.knob.name.c_str(), knob);
  const SimulateOptions options{.method = row.name + knob_text,
                                .command = command,
                                .out = arguments.out,
                                .frames = arguments.frames,
                                .every = arguments.every,
                                .cut = options_with(arguments.chord_tolerance)};
  return cutbench::simulate(scene, *method, options) ? done : fell_short;
}

// --- cutbench run ----------------------------------------------------------------------------------------------------

struct RunArguments {
  std::vector<std::string> experiments, methods;
  std::vector<int> resolutions;
  int cases = 0, repetitions = 0;
  std::string seed, out = "results", shard = "1/1";
};

/// Keeps the entries of `all` that are named in `wanted`, unless that is empty.
template <class Entry, class Wanted, class Name>
void restrict_to(std::vector<Entry>& all, const std::vector<Wanted>& wanted, const std::string& option, Name name) {
  for (const Wanted& w : wanted)
    if (std::none_of(all.begin(), all.end(), [&](const Entry& e) { return name(e) == w; })) {
      std::ostringstream what;
      what << option << ' ' << w << " is not in the experiment";
      throw InputError(what.str());
    }
  if (!wanted.empty())
    std::erase_if(all,
                  [&](const Entry& e) { return std::find(wanted.begin(), wanted.end(), name(e)) == wanted.end(); });
}

std::uint64_t seed(const std::string& text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size() && value <= INT64_MAX) return value;
  throw InputError("--seed " + text + ": give a whole number from 0, or `commit`");
}

int run(const RunArguments& arguments, const std::string& command) {
  explain_interruption();
  RunOptions options;
  options.out = arguments.out, options.command = command;
  char more = 0;
  if (std::sscanf(arguments.shard.c_str(), "%d/%d%c", &options.shard, &options.shards, &more) != 2 ||
      options.shard < 1 || options.shard > options.shards)
    throw InputError("--shard " + arguments.shard + ": give i/N with 1 <= i <= N");
  const Context context = gather_context();
  std::vector<Experiment> experiments;
  for (const auto& file : arguments.experiments) {  // all are read before any is run
    Experiment& e = experiments.emplace_back(read_experiment(file));
    if (e.methods.empty())
      for (const MethodRow& row : all_methods()) e.methods.push_back({row.name, {}});
    std::vector<std::string> methods = arguments.methods;
    const bool with_peer = e.campaign && std::erase(methods, "peer") > 0;
    restrict_to(e.methods, methods, "--methods", [](const auto& m) { return m.method; });
    if (with_peer && methods.empty()) e.methods.clear();
    restrict_to(e.resolutions, arguments.resolutions, "--resolutions", [](int r) { return r; });
    if (e.campaign && !arguments.methods.empty()) e.campaign->peer = with_peer;
    if (e.campaign && !arguments.resolutions.empty()) e.campaign->mesh_files.clear();
    if (arguments.cases > 0) e.cases = arguments.cases;
    if (arguments.repetitions > 0) e.repetitions = arguments.repetitions;
    if (arguments.seed == "commit")
      e.seed = seed_of_commit(context);
    else if (!arguments.seed.empty())
      e.seed = seed(arguments.seed);
    variants_of(e, nameable_methods());
  }
  bool ok = true;
  for (const Experiment& e : experiments) ok &= run_experiment(e, nameable_methods(), context, options);
  return ok ? done : fell_short;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"cutbench: which way of cutting a deformable sheet to use"};
  app.require_subcommand(1);

  bool as_json = false;
  auto* methods_command = app.add_subcommand("methods", "the methods, with what each promises");
  methods_command->add_flag("--json", as_json);

  CutArguments cut_arguments;
  auto* cut_command = app.add_subcommand("cut", "cut a sheet along a path");
  cut_command->add_option("--mesh", cut_arguments.mesh, "OBJ, OFF or PLY")->required();
  cut_command->add_option("--path", cut_arguments.path, "JSON")->required();
  cut_command->add_option("--method", cut_arguments.method, "see `cutbench methods`")->required();
  cut_command->add_option("--set", cut_arguments.set, "knob=value");
  cut_command->add_option("--chord-tolerance", cut_arguments.chord_tolerance,
                          "in mean rest edges, or inf: edge crossings only");
  cut_command->add_option("--out", cut_arguments.out, "OBJ, OFF or VTU")->required();
  cut_command->add_option("--report", cut_arguments.report, "JSON");

  ScoreArguments score_arguments;
  std::string score_tolerance = "0.05";
  auto* score_command = app.add_subcommand("score", "judge a cut that any program made");
  score_command->add_option("--mesh", score_arguments.mesh, "the sheet before: OBJ, OFF or PLY")->required();
  score_command->add_option("--path", score_arguments.path, "JSON")->required();
  score_command->add_option("--result", score_arguments.result, "the sheet after: OBJ, OFF or PLY")->required();
  score_command->add_option("--report", score_arguments.report, "JSON");
  score_command->add_option("--chord-tolerance", score_tolerance,
                            "allowed incision error in mean rest edges, or inf: the longest edge");
  score_command->add_flag("--keeps-vertices", score_arguments.keeps_vertices,
                          "the sheet's vertices must be there with the same numbers and rest positions");

  SimulateArguments simulate_arguments;
  auto* simulate_command = app.add_subcommand("simulate", "run a scene with its cuts");
  simulate_command->add_option("scene", simulate_arguments.scene, "scene file (TOML)")->required();
  simulate_command->add_option("--method", simulate_arguments.method, "see `cutbench methods`");
  simulate_command->add_option("--set", simulate_arguments.set, "knob=value");
  simulate_command->add_option("--chord-tolerance", simulate_arguments.chord_tolerance,
                               "in mean rest edges, or inf: edge crossings only");
  simulate_command->add_option("--resolution", simulate_arguments.resolution, "triangles, instead of the scene's")
      ->check(CLI::PositiveNumber);
  simulate_command->add_option("--out", simulate_arguments.out, "the sheet in the end: OBJ, OFF or VTU");
  auto* frames_option = simulate_command->add_option("--frames", simulate_arguments.frames,
                                                     "folder for a time series: VTU, PVD, OBJ in the end");
  simulate_command->add_option("--every", simulate_arguments.every, "steps from frame to frame")
      ->check(CLI::PositiveNumber)
      ->needs(frames_option);

  RunArguments run_arguments;
  auto* run_command = app.add_subcommand("run", "run experiments");
  run_command->add_option("experiments", run_arguments.experiments, "experiment files (TOML)")->required();
  run_command->add_option("--methods", run_arguments.methods, "only these")->delimiter(',');
  run_command->add_option("--resolutions", run_arguments.resolutions, "only these (triangles)")->delimiter(',');
  run_command->add_option("--cases", run_arguments.cases, "instead of the experiment's")->check(CLI::PositiveNumber);
  run_command->add_option("--repetitions", run_arguments.repetitions, "instead of the experiment's")
      ->check(CLI::PositiveNumber);
  run_command->add_option("--seed", run_arguments.seed, "a number, or `commit`: from the commit's hash");
  run_command->add_option("--out", run_arguments.out, "results folder");
  run_command->add_option("--shard", run_arguments.shard, "i/N: only every N-th case");

  try {
    app.parse(argc, argv);
    std::string command = "cutbench";
    for (int i = 1; i < argc; ++i) command += std::string(" ") + argv[i];
    const auto run_score = [&] {
      if (!score_arguments.report.empty()) check_writable(score_arguments.report, "--report");
      return score(score_arguments, options_with(score_tolerance)) ? done : fell_short;
    };
    const int code = *methods_command    ? list_methods(as_json)
                     : *cut_command      ? cut(cut_arguments)
                     : *score_command    ? run_score()
                     : *simulate_command ? simulate(simulate_arguments, command)
                                         : run(run_arguments, command);
    if (std::fflush(stdout) != 0 || !std::cout.flush())
      throw OutputError("standard output: can't be written; check where it goes");
    return code;
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    std::cerr << error.what() << "; see cutbench --help\n";
  } catch (const InputError& error) {
    std::cerr << error.what() << '\n';
  } catch (const OutputError& error) {
    std::cerr << error.what() << '\n';
    return fell_short;
  } catch (const std::exception& error) {
    std::cerr << "internal error: " << error.what() << '\n';
    return fell_short;
  }
  return bad_input;
}
