#include "harness/study/experiment.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/fem/solvers/solver_table.h"
#include "harness/files/toml_reader.h"
#include "harness/mesh/families.h"
#include "harness/problems/common/problem.h"

namespace cutbench {

namespace {

ProgramSettings read_program(const TomlReader& reader, const std::filesystem::path& folder) {
  ProgramSettings program{reader.value<std::string>("name"), reader.value<std::string>("command"), folder, {}};
  if (program.folder.empty()) program.folder = ".";
  program.limits.time_s = reader.positive("time_limit_s", program.limits.time_s);
  program.limits.memory_mb = reader.positive("memory_limit_mb", program.limits.memory_mb);
  return program;
}

/// A method by its name, with values of its parameter, or a program.
void read_entry(const toml::node& node, const std::filesystem::path& file, Experiment& e) {
  const std::string where = file.string();
  if (const auto name = node.value<std::string>()) return e.methods.push_back({*name, {}});
  const toml::table* table = node.as_table();
  if (!table)
    throw InputError(
        where + ": an entry of \"methods\" is a name, {name = ..., parameter = [...]} or {name = ..., command = ...}");
  const TomlReader reader{*table, where + ", methods"};
  if (table->contains("command")) {
    check_keys(*table, {"name", "command", "time_limit_s", "memory_limit_mb"}, reader.where);
    e.programs.push_back(read_program(reader, file.parent_path()));
    return e.methods.push_back({e.programs.back().name, {}});
  }
  check_keys(*table, {"name", "parameter"}, reader.where);
  e.methods.push_back({reader.value<std::string>("name"),
                       table->contains("parameter") ? reader.list<double>("parameter") : std::vector<double>{}});
}

Experiment::Robustness read_robustness(const TomlReader& reader, const std::filesystem::path& folder) {
  Experiment::Robustness robustness;
  if (reader.has("mesh_files"))
    for (const auto& file : reader.list<std::string>("mesh_files")) {
      robustness.mesh_files.push_back(folder / file);
      if (std::error_code ignored; !std::filesystem::is_regular_file(folder / file, ignored))
        reader.refuse("there is no file " + (folder / file).string() +
                      "; \"mesh_files\" are relative to the experiment's folder");
    }
  robustness.time_limit_s = reader.positive("time_limit_s", robustness.time_limit_s);
  robustness.cross_check = reader.value<bool>("cross_check", robustness.cross_check);
  return robustness;
}

Experiment::Accuracy read_accuracy(const TomlReader& reader, const std::vector<int>& resolutions) {
  Experiment::Accuracy accuracy;
  const bool all = !reader.table["problems"].is_array() && reader.value<std::string>("problems", "all") == "all";
  if (all)
    for (const auto& problem : all_problems()) {
      if (!problem->in_motion()) accuracy.problems.push_back(problem->name());
    }
  else
    accuracy.problems = reader.list<std::string>("problems");
  for (const auto& name : accuracy.problems) find_problem(name);
  accuracy.direct = reader.list<std::string>("direct");
  if (reader.has("preconditioners")) accuracy.preconditioners = reader.list<std::string>("preconditioners");
  for (const auto* list : {&accuracy.direct, &accuracy.preconditioners})
    check_solver_names(*list, reader.where + ": solver");
  if (!accuracy.preconditioners.empty())
    for (const auto n : reader.list<std::int64_t>("iterations")) {
      if (n < 1 || n > 1000000) reader.refuse("\"iterations\" are whole numbers from 1 to 1000000");
      accuracy.iterations.push_back(to_int(n));
    }
  const auto read_members = [&](const char* key, std::int64_t least) {
    const auto members = reader.list<std::int64_t>(key);
    if (members.size() != resolutions.size())
      reader.refuse("\"" + std::string(key) + "\" must be as many numbers as \"resolutions\"");
    std::vector<std::pair<int, int>> of_resolution;
    for (std::size_t i = 0; i < members.size(); ++i) {
      if (members[i] < least || members[i] > 1000000)
        reader.refuse("\"" + std::string(key) + "\" are whole numbers from " + std::to_string(least) + " to 1000000");
      of_resolution.emplace_back(resolutions[i], to_int(members[i]));
    }
    return of_resolution;
  };
  accuracy.members = read_members("members", 1);
  accuracy.members_nonlinear =
      reader.has("members_nonlinear") ? read_members("members_nonlinear", 0) : accuracy.members;
  accuracy.tip_functions = reader.value<bool>("tip_functions", accuracy.tip_functions);
  accuracy.reference = reader.value<bool>("reference", accuracy.reference);
  return accuracy;
}

/// The records of two equal entries could not be told apart.
template <class T>
void refuse_repeated(std::vector<T> entries, const std::string& what) {
  std::sort(entries.begin(), entries.end());
  if (std::adjacent_find(entries.begin(), entries.end()) != entries.end())
    throw InputError(what + " names something twice; delete one");
}

std::string text_of_file(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

Experiment::Stability read_stability(const TomlReader& reader, const std::filesystem::path& file, const Experiment& e) {
  Experiment::Stability stability;
  stability.time_limit_s = reader.positive("time_limit_s", stability.time_limit_s);
  stability.sweeps = read_sweeps(reader, file.parent_path());
  std::vector<std::string> names, sheets;
  for (const Sweep& sweep : stability.sweeps) {
    names.push_back(sweep.name);
    sheets.insert(sheets.end(), sweep.sheets.begin(), sweep.sheets.end());
    for (const int resolution : sweep.resolutions)
      if (std::find(e.resolutions.begin(), e.resolutions.end(), resolution) == e.resolutions.end())
        reader.refuse("sweep \"" + sweep.name + "\": " + std::to_string(resolution) +
                      " is not one of the experiment's \"resolutions\"");
  }
  check_names(sheets, e.sheets, reader.where + ": a sweep's sheet");
  refuse_repeated(names, reader.where + ": the names of \"sweeps\"");
  return stability;
}

/// The file's keys in alphabetic order with their values, and the texts of the files that it names.
std::string text_of_what_was_asked(const toml::table& table, const std::filesystem::path& folder, const Experiment& e) {
  std::ostringstream text;
  text << toml::json_formatter{table};
  if (e.scene) text << text_of_file(folder / *table["scene"].value<std::string>());
  if (e.robustness)
    for (const auto& mesh : e.robustness->mesh_files) text << text_of_file(mesh);
  if (e.stability)
    for (const Sweep& sweep : e.stability->sweeps) text << text_of_file(sweep.scene_file);
  return text.str();
}

}  // namespace

std::string identity_of_methods(const Experiment& experiment) {
  nlohmann::json methods;
  for (const auto& entry : experiment.methods) methods.push_back({entry.method, entry.parameter_values});
  for (const auto& program : experiment.programs) methods.push_back({program.name, fingerprint_of_program(program)});
  return methods.dump();
}

Experiment read_experiment(const std::filesystem::path& file) {
  const std::string name = file.string();
  const toml::table table = parse_toml(file);
  const bool is_robustness = table.contains("robustness"), is_accuracy = table.contains("accuracy");
  const bool is_stability = table.contains("sweeps");
  std::vector<std::string> known{"claim", "sheets", "resolutions", "methods", "seed", "chord_tolerance"};
  if (is_robustness)
    known.insert(known.end(), {"robustness", "cases"});
  else if (is_accuracy)
    known.emplace_back("accuracy");
  else if (is_stability)
    known.insert(known.end(), {"sweeps", "cases", "time_limit_s"});
  else
    known.insert(known.end(), {"cases", "own_cuts", "cut_families", "repetitions", "times", "cold", "quality",
                               "eigenvalue_cases", "every_edge", "scene", "cut_time", "scene_cases"});
  check_keys(table, known, name);
  const TomlReader reader{table, name};
  Experiment e;
  e.stem = file.stem().string();
  e.claim = reader.value<std::string>("claim");
  e.sheets = reader.list<std::string>("sheets");
  if (is_robustness)
    e.robustness = read_robustness(reader.section("robustness", {"mesh_files", "time_limit_s", "cross_check"}),
                                   file.parent_path());
  else if (!is_accuracy && !is_stability)
    e.cut_families = reader.list<std::string>("cut_families");
  check_names(e.sheets, sheet_families(), name + ": sheet");
  check_names(e.cut_families, cut_families(), name + ": cut family");
  for (auto triangles : reader.list<std::int64_t>("resolutions")) {
    squares_per_side(triangles);
    e.resolutions.push_back(to_int(triangles));
  }
  refuse_repeated(e.sheets, name + ": \"sheets\"");
  refuse_repeated(e.cut_families, name + ": \"cut_families\"");
  refuse_repeated(e.resolutions, name + ": \"resolutions\"");
  if (is_accuracy) {
    const std::vector<std::string> keys{"problems",      "direct",   "preconditioners",
                                        "iterations",    "members",  "members_nonlinear",
                                        "tip_functions", "reference"};
    e.accuracy = read_accuracy(reader.section("accuracy", keys), e.resolutions);
    refuse_repeated(e.accuracy->problems, name + ": \"problems\"");
    refuse_repeated(e.accuracy->direct, name + ": \"direct\"");
    refuse_repeated(e.accuracy->preconditioners, name + ": \"preconditioners\"");
    refuse_repeated(e.accuracy->iterations, name + ": \"iterations\"");
  }
  if (is_stability) e.stability = read_stability(reader, file, e);
  if (table["methods"].value<std::string>() != "all")
    for (const auto& node : reader.array("methods")) read_entry(node, file, e);
  e.seed = static_cast<std::uint64_t>(reader.value<std::int64_t>("seed", 1));
  // Cuts: of each sheet, resolution and family. Robustness: of each sheet and resolution. Stability: the most seeded
  // places of a point, whose sweep says how many. Accuracy has `members` instead.
  e.cases = reader.count("cases", is_stability ? 1000000 : 1);
  e.repetitions = reader.count("repetitions", 1);
  e.cold = reader.value<bool>("cold", false);
  e.quality = reader.value<bool>("quality", true);
  e.own_cuts = reader.value<bool>("own_cuts", false);
  e.eigenvalue_cases = reader.count("eigenvalue_cases", 0, 0);
  e.every_edge = reader.value<bool>("every_edge", false);
  e.times = reader.value<bool>("times", true);
  for (const char* key : {"repetitions", "cold", "every_edge", "scene"})
    if (!e.times && table.contains(key))
      throw InputError(name + ": \"" + key + "\" is for times, but \"times\" is false; leave one of them out");
  e.chord_tolerance = reader.value<double>("chord_tolerance", 0.05);  // TOML has inf
  if (!(e.chord_tolerance > 0)) throw InputError(name + ": \"chord_tolerance\" must be positive, or inf");
  if (table.contains("scene")) {
    const auto scene_file = file.parent_path() / reader.value<std::string>("scene");
    e.scene = read_scene_for_experiment(scene_file);
    if (!e.scene->mesh_file.empty())
      throw InputError(name + ": \"scene\" has a sheet from a file, but the sheets are the experiment's; use a family");
    e.scene_cases = reader.count("scene_cases", e.cases);
    e.cut_time = reader.value<double>("cut_time");
    if (!(e.cut_time >= 0 && e.cut_time < e.scene->duration))
      throw InputError(name + ": \"cut_time\" must lie within the scene's duration");
  }
  e.asked = text_of_what_was_asked(table, file.parent_path(), e);
  return e;
}

}  // namespace cutbench
