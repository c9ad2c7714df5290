#include "experiments/program/command_line.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "experiments/program/commands/command.h"
#include "harness/base/errors.h"
#include "harness/base/names.h"
#include "harness/fem/linear/factor.h"
#include "harness/records/context.h"
#include "harness/records/record.h"
#include "methods/registry.h"

namespace {

using namespace cutbench;

// --- cutbench methods ------------------------------------------------------------------------------------------------

/// An end that is not there is null.
nlohmann::ordered_json json_of(const Range& range) {
  return {{"least", range.least}, {"most", range.most}, {"whole", range.whole}, {"or_zero", range.or_zero}};
}

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
      nlohmann::ordered_json entry{
          {"name", m.name}, {"summary", m.summary}, {"parameter", nullptr}, {"promises", promises}};
      entry["incision_bound"] = {{"longest_edges", p.incision_bound.longest_edges},
                                 {"chord_tolerances", p.incision_bound.chord_tolerances}};
      if (!m.parameter.name.empty())
        entry["parameter"] = {{"name", m.parameter.name},
                              {"default", m.parameter.value},
                              {"range", json_of(m.parameter.range)},
                              {"meaning", m.parameter.meaning}};
      list.push_back(entry);
      continue;
    }
    std::printf("%-20s %s\n", m.name.c_str(), m.summary.c_str());
    if (!m.parameter.name.empty())
      std::printf("%20s   parameter %s = %g, %s: %s\n", "", m.parameter.name.c_str(), m.parameter.value,
                  m.parameter.range.text().c_str(), m.parameter.meaning.c_str());
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

Command add_method_list(Options& app, bool& as_json) {
  auto command = app.add_subcommand("methods", "the methods, with what each promises");
  command.add_flag("--json", as_json, "as JSON");
  command.footer(
      "example:\n"
      "  cutbench methods --json\n"
      "exit codes:\n"
      "  0  done\n"
      "  1  standard output can't be written\n"
      "  2  bad input: an unknown option");
  return {command, [&as_json](const std::string&) { return static_cast<Exit>(list_methods(as_json)); }};
}

// --- what all subcommands share --------------------------------------------------------------------------------------

std::string version() {
  const Context context = gather_context(cholmod_version());
  std::string text = std::string("cutbench " CUTBENCH_VERSION ", suite version ") + suite_version + "\ncommit " +
                     context.commit.value_or("unknown") + (context.dirty.value_or(false) ? ", with changes" : "");
  return text + "\ncompiled by " + context.compiler + ", " + context.build_type + ", " + context.flags;
}

/// The parser does not say which word it took for a subcommand, nor which there are.
void check_subcommand(const Options& app, int argc, char** argv) {
  const std::vector<std::string> known = app.subcommands();
  if (argc < 2) throw InputError("no subcommand given; known are " + listed(known) + "; see cutbench --help");
  const std::string first = argv[1];
  if (first.starts_with('-') || std::find(known.begin(), known.end(), first) != known.end()) return;
  throw InputError("unknown subcommand \"" + first + "\"; known are " + listed(nearest_first(first, known)) +
                   "; see cutbench --help");
}

int run_subcommand(const std::vector<Command>& commands, int argc, char** argv) {
  std::string line = "cutbench";
  for (int i = 1; i < argc; ++i) line += std::string(" ") + argv[i];
  const auto chosen =
      std::find_if(commands.begin(), commands.end(), [](const Command& c) { return c.options.parsed(); });
  const int code = chosen->run(line);
  if (std::fflush(stdout) != 0 || !std::cout.flush())
    throw OutputError("standard output: can't be written; check where it goes");
  return code;
}

}  // namespace

namespace cutbench {

int command_line(int argc, char** argv, const std::vector<MethodRow>& more_methods, const Scene* scene) {
  std::signal(SIGXFSZ, SIG_IGN);  // a limit of the file size is then an error of the write, like a full disk
  Options app("cutbench: which way of cutting a deformable sheet to use");
  app.require_subcommand();
  app.set_version(version);
  app.footer(
      "example:\n"
      "  cutbench methods\n"
      "exit codes:\n"
      "  0  done\n"
      "  1  a cut or step failed, a result is wrong, or a file can't be written\n"
      "  2  bad input: an option or a file\n"
      "options of a subcommand: cutbench SUBCOMMAND --help");
  bool as_json = false;
  const std::vector<Command> commands{add_method_list(app, as_json),
                                      add_cut(app),
                                      add_score(app),
                                      add_simulate(app),
                                      add_ablate(app, scene),
                                      add_recommend(app, scene),
                                      add_run(app),
                                      add_reduce(app),
                                      add_merge(app),
                                      add_missing(app),
                                      add_columns(app),
                                      add_compare(app)};
  try {
    add_methods(more_methods);
    check_subcommand(app, argc, argv);
    if (const auto exit = app.parse(argc, argv)) return *exit;
    return run_subcommand(commands, argc, argv);
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

}  // namespace cutbench
