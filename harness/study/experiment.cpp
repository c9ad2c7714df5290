#include "harness/study/experiment.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/fem/solvers/solver_table.h"
#include "harness/mesh/families.h"
#include "harness/problems/common/problem.h"
#include "harness/scenes/toml_reader.h"

namespace cutbench {

namespace {

// --- which keys there are --------------------------------------------------------------------------------------------

/// A kind of study, in the order in which a file is asked for its mark.
struct Kind {
  const char* name;                ///< in messages
  const char* mark;                ///< the key that makes a file this kind's; empty: no other kind's mark is there
  std::vector<std::string> keys;   ///< of the file, besides those of all kinds
  std::vector<std::string> inner;  ///< of the section [mark]
};
const std::vector<std::string> common_keys{"claim", "sheets", "resolutions", "methods", "seed", "chord_tolerance"};
const Kind robustness_kind{
    "robustness runs", "robustness", {"robustness", "cases"}, {"mesh_files", "time_limit_s", "cross_check"}};
const Kind accuracy_kind{"accuracy runs",
                         "accuracy",
                         {"accuracy"},
                         {"problems", "direct", "preconditioners", "iterations", "members", "members_nonlinear",
                          "tip_functions", "reference", "graded_reference"}};
const Kind stability_kind{"stability sweeps", "sweeps", {"sweeps", "cases", "time_limit_s"}, {}};
const Kind cut_kind{"cut families",
                    "",
                    {"cases", "own_cuts", "cut_families", "repetitions", "times", "cold", "quality", "eigenvalue_cases",
                     "every_edge", "scene", "cut_time", "scene_cases"},
                    {}};
const std::array<const Kind*, 4> kinds{&robustness_kind, &accuracy_kind, &stability_kind, &cut_kind};

const Kind& kind_of(const toml::table& table) {
  return **std::find_if(kinds.begin(), kinds.end() - 1, [&](const Kind* kind) { return table.contains(kind->mark); });
}

bool contains(const std::vector<std::string>& keys, const std::string& key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

/// Throws InputError for a key of `table` that is known, but of another kind or at another place.
void check_place(const toml::table& table, const Kind& kind, bool within_section, const std::string& where) {
  for (const auto& entry : table) {
    const std::string key(entry.first.str()), quoted = where + ": \"" + key + "\"";
    const bool of_file = contains(common_keys, key) || contains(kind.keys, key), of_section = contains(kind.inner, key);
    if (within_section ? of_section : of_file) continue;
    if (of_file) throw InputError(quoted + " belongs above [" + kind.mark + "]; move it there");
    if (of_section) throw InputError(quoted + " belongs below [" + kind.mark + "]; move it there");
    std::string owners;
    for (const Kind* other : kinds)
      if (contains(other->keys, key) || contains(other->inner, key))
        owners += (owners.empty() ? "" : " and ") + std::string(other->name);
    if (!owners.empty())
      throw InputError(quoted + " is for " + owners + ", but this experiment is for " + kind.name + "; leave it out");
  }
}

TomlReader section_of(const TomlReader& experiment, const Kind& kind) {
  if (const toml::table* section = experiment.table[kind.mark].as_table())
    check_place(*section, kind, true, experiment.where + ", [" + kind.mark + "]");
  return experiment.section(kind.mark, kind.inner);
}

// --- methods ---------------------------------------------------------------------------------------------------------

ProgramSettings read_program(const TomlReader& reader, const std::filesystem::path& folder) {
  ProgramSettings program{reader.value<std::string>("name"), reader.value<std::string>("command"), folder, {}};
  if (program.folder.empty()) program.folder = ".";
  program.limits.time_s = reader.positive("time_limit_s", program.limits.time_s);
  program.limits.memory_mb = reader.positive("memory_limit_mb", program.limits.memory_mb);
  program.deletes = reader.value<bool>("deletes", program.deletes);
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
    check_keys(*table, {"name", "command", "time_limit_s", "memory_limit_mb", "deletes"}, reader.where);
    e.programs.push_back(read_program(reader, file.parent_path()));
    return e.methods.push_back({e.programs.back().name, {}});
  }
  check_keys(*table, {"name", "parameter"}, reader.where);
  e.methods.push_back({reader.value<std::string>("name"),
                       table->contains("parameter") ? reader.list<double>("parameter") : std::vector<double>{}});
}

// --- the kinds -------------------------------------------------------------------------------------------------------

/// The records of two equal entries could not be told apart.
template <class T>
void refuse_repeated(std::vector<T> entries, const std::string& what) {
  std::sort(entries.begin(), entries.end());
  if (std::adjacent_find(entries.begin(), entries.end()) != entries.end())
    throw InputError(what + " names something twice; delete one");
}

RobustnessStudy read_robustness(const TomlReader& experiment, const std::filesystem::path& folder) {
  RobustnessStudy robustness;
  robustness.cases = experiment.count("cases", robustness.cases);
  const TomlReader reader = section_of(experiment, robustness_kind);
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

AccuracyStudy read_accuracy(const TomlReader& experiment, const std::vector<int>& resolutions) {
  AccuracyStudy accuracy;
  const TomlReader reader = section_of(experiment, accuracy_kind);
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
  accuracy.graded_reference = reader.value<bool>("graded_reference", accuracy.graded_reference);
  refuse_repeated(accuracy.problems, experiment.where + ": \"problems\"");
  refuse_repeated(accuracy.direct, experiment.where + ": \"direct\"");
  refuse_repeated(accuracy.preconditioners, experiment.where + ": \"preconditioners\"");
  refuse_repeated(accuracy.iterations, experiment.where + ": \"iterations\"");
  return accuracy;
}

StabilityStudy read_stability(const TomlReader& reader, const std::filesystem::path& folder, const Experiment& e) {
  StabilityStudy stability;
  stability.cases = reader.count("cases", stability.cases);
  stability.time_limit_s = reader.positive("time_limit_s", stability.time_limit_s);
  stability.sweeps = read_sweeps(reader, folder);
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

void read_scene_into(CutStudy& cuts, const TomlReader& reader, const std::filesystem::path& folder) {
  cuts.scene = read_scene_for_experiment(folder / reader.value<std::string>("scene"));
  if (!cuts.scene->mesh_file.empty())
    reader.refuse("\"scene\" has a sheet from a file, but the sheets are the experiment's; use a family");
  cuts.scene_cases = reader.count("scene_cases", cuts.cases);
  cuts.cut_time = reader.value<double>("cut_time");
  if (!(cuts.cut_time >= 0 && cuts.cut_time < cuts.scene->duration))
    reader.refuse("\"cut_time\" must lie within the scene's duration");
}

CutStudy read_cuts(const TomlReader& reader, const std::filesystem::path& folder) {
  CutStudy cuts;
  cuts.cut_families = reader.list<std::string>("cut_families");
  check_names(cuts.cut_families, cut_families(), reader.where + ": cut family");
  refuse_repeated(cuts.cut_families, reader.where + ": \"cut_families\"");
  cuts.cases = reader.count("cases", cuts.cases);
  cuts.own_cuts = reader.value<bool>("own_cuts", cuts.own_cuts);
  cuts.repetitions = reader.count("repetitions", cuts.repetitions);
  cuts.times = reader.value<bool>("times", cuts.times);
  cuts.cold = reader.value<bool>("cold", cuts.cold);
  cuts.quality = reader.value<bool>("quality", cuts.quality);
  cuts.eigenvalue_cases = reader.count("eigenvalue_cases", cuts.eigenvalue_cases, 0);
  cuts.every_edge = reader.value<bool>("every_edge", cuts.every_edge);
  for (const char* key : {"repetitions", "cold", "every_edge", "scene"})
    if (!cuts.times && reader.has(key))
      reader.refuse("\"" + std::string(key) + "\" is for times, but \"times\" is false; leave one of them out");
  if (reader.has("scene")) read_scene_into(cuts, reader, folder);
  return cuts;
}

// --- the whole -------------------------------------------------------------------------------------------------------

std::string text_of_file(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The file's keys in alphabetic order with their values, and the texts of the files that it names.
std::string text_of_what_was_asked(const toml::table& table, const std::filesystem::path& folder, const Experiment& e) {
  std::ostringstream text;
  text << toml::json_formatter{table};
  if (const auto* cuts = std::get_if<CutStudy>(&e.study); cuts && cuts->scene)
    text << text_of_file(folder / *table["scene"].value<std::string>());
  if (const auto* robustness = std::get_if<RobustnessStudy>(&e.study))
    for (const auto& mesh : robustness->mesh_files) text << text_of_file(mesh);
  if (const auto* stability = std::get_if<StabilityStudy>(&e.study))
    for (const Sweep& sweep : stability->sweeps) text << text_of_file(sweep.scene_file);
  return text.str();
}

}  // namespace

std::vector<Experiment::SizedSheet> Experiment::sized_sheets() const {
  std::vector<SizedSheet> all;
  for (const std::string& sheet : sheets)
    for (const int resolution : resolutions) all.push_back({sheet, resolution});
  return all;
}

bool Experiment::records_times() const {
  const auto* cuts = std::get_if<CutStudy>(&study);
  return cuts ? cuts->times : !std::holds_alternative<RobustnessStudy>(study);
}

std::string identity_of_methods(const Experiment& experiment) {
  nlohmann::json methods;
  for (const auto& entry : experiment.methods) methods.push_back({entry.method, entry.parameter_values});
  for (const auto& program : experiment.programs) methods.push_back({program.name, fingerprint_of_program(program)});
  return methods.dump();
}

Experiment read_experiment(const std::filesystem::path& file) {
  const std::string name = file.string();
  const std::filesystem::path folder = file.parent_path();
  const toml::table table = parse_toml(file);
  const Kind& kind = kind_of(table);
  check_place(table, kind, false, name);
  std::vector<std::string> known = common_keys;
  known.insert(known.end(), kind.keys.begin(), kind.keys.end());
  check_keys(table, known, name);
  const TomlReader reader{table, name};
  Experiment e;
  e.stem = file.stem().string();
  e.claim = reader.value<std::string>("claim");
  e.sheets = reader.list<std::string>("sheets");
  check_names(e.sheets, sheet_families(), name + ": sheet");
  for (auto triangles : reader.list<std::int64_t>("resolutions")) {
    squares_per_side(triangles);
    e.resolutions.push_back(to_int(triangles));
  }
  refuse_repeated(e.sheets, name + ": \"sheets\"");
  refuse_repeated(e.resolutions, name + ": \"resolutions\"");
  if (table["methods"].value<std::string>() != "all")
    for (const auto& node : reader.array("methods")) read_entry(node, file, e);
  e.seed = static_cast<std::uint64_t>(reader.value<std::int64_t>("seed", 1));
  e.chord_tolerance = reader.value<double>("chord_tolerance", 0.05);  // TOML has inf
  if (!(e.chord_tolerance > 0)) reader.refuse("\"chord_tolerance\" must be positive, or inf");
  if (&kind == &robustness_kind) e.study = read_robustness(reader, folder);
  if (&kind == &accuracy_kind) e.study = read_accuracy(reader, e.resolutions);
  if (&kind == &stability_kind) e.study = read_stability(reader, folder, e);
  if (&kind == &cut_kind) e.study = read_cuts(reader, folder);
  e.asked = text_of_what_was_asked(table, folder, e);
  return e;
}

}  // namespace cutbench
