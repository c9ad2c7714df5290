// `cutbench run`: runs experiments, or a part of them.
#include <sched.h>

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "experiments/program/commands/command.h"
#include "harness/base/conversions.h"
#include "harness/base/errors.h"
#include "harness/fem/linear/factor.h"
#include "harness/processes/interrupt.h"
#include "harness/study/run_experiment.h"
#include "methods/registry.h"

namespace cutbench {

namespace {

struct RunArguments {
  std::vector<std::string> experiments, methods, more_methods, commands, deletes, sweeps;
  std::vector<int> resolutions;
  int cases = 0, repetitions = 0, jobs = 0;
  std::string seed, out = "results", shard = "1/1";
};

/// Keeps the entries of `all` that are named in `wanted`, unless that is empty.
template <class Entry, class Wanted, class Name>
void restrict_to(std::vector<Entry>& all, const std::vector<Wanted>& wanted, const std::string& option, Name name) {
  for (const Wanted& w : wanted)
    if (std::none_of(all.begin(), all.end(), [&](const Entry& e) { return name(e) == w; })) {
      std::ostringstream what;
      what << option << ' ' << w << " is not in the experiment; it has";
      const char* comma = " ";
      for (const Entry& e : all) what << std::exchange(comma, ", ") << name(e);
      throw InputError(what.str());
    }
  if (!wanted.empty())
    std::erase_if(all,
                  [&](const Entry& e) { return std::find(wanted.begin(), wanted.end(), name(e)) == wanted.end(); });
}

std::uint64_t seed_in(const std::string& text) {
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size() && value <= INT64_MAX) return value;
  throw InputError("--seed " + text + ": give a whole number from 0, or `commit`");
}

RunOptions run_options(const RunArguments& arguments, const std::string& command_line) {
  RunOptions options;
  options.out = arguments.out;
  options.command = command_line;
  options.workers = arguments.jobs;
  char more = 0;
  if (std::sscanf(arguments.shard.c_str(), "%d/%d%c", &options.shard, &options.shards, &more) != 2 ||
      options.shard < 1 || options.shard > options.shards)
    throw InputError("--shard " + arguments.shard + ": give i/N with 1 <= i <= N");
  return options;
}

/// NAME=COMMAND, run in the current folder.
ProgramSettings program_in(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw InputError("--command " + text + ": give NAME=COMMAND, such as: mine=python3 mine.py {mesh} {path} {out}");
  return {text.substr(0, equals), text.substr(equals + 1), ".", {}};
}

/// The options that rows depend on. All are named here, so that a new one can't be forgotten.
std::string text_of_options(const RunArguments& arguments) {
  const auto& [experiments, methods, more_methods, commands, deletes, sweeps, resolutions, cases, repetitions, jobs,
               seed, out, shard] = arguments;
  return nlohmann::json{methods, more_methods, commands, deletes, sweeps, resolutions, cases, repetitions, seed}.dump();
}

void set_cases(AccuracyStudy& study, int cases) {
  for (auto* members : {&study.members, &study.members_nonlinear})
    for (auto& [resolution, number] : *members)
      if (number > 0) number = cases;
}
void set_cases(auto& study, int cases) { study.cases = cases; }

/// The options that restrict or replace what kinds of studies have of their own.
void apply_to_study(Experiment& e, const RunArguments& arguments, bool with_cross_check) {
  if (arguments.cases > 0) std::visit([&](auto& study) { set_cases(study, arguments.cases); }, e.study);
  if (auto* cuts = std::get_if<CutStudy>(&e.study); cuts && arguments.repetitions > 0)
    cuts->repetitions = arguments.repetitions;
  if (auto* robustness = std::get_if<RobustnessStudy>(&e.study)) {
    if (!arguments.methods.empty()) robustness->cross_check = with_cross_check;
    if (!arguments.resolutions.empty()) robustness->mesh_files.clear();
  }
  if (auto* stability = std::get_if<StabilityStudy>(&e.study))
    restrict_to(stability->sweeps, arguments.sweeps, "--sweeps", [](const Sweep& s) { return s.name; });
}

Experiment read_part(const std::string& file, const RunArguments& arguments, const Context& context) {
  Experiment e = read_experiment(file);
  if (!arguments.sweeps.empty() && !std::holds_alternative<StabilityStudy>(e.study))
    throw InputError(file + ": --sweeps is for an experiment that has [[sweeps]]");
  if (arguments.repetitions > 0 && !std::holds_alternative<CutStudy>(e.study))
    throw InputError(file + ": --repetitions is for an experiment of cut families; leave it out");
  e.asked += text_of_options(arguments);
  if (e.methods.empty())
    for (const MethodRow& row : all_methods()) e.methods.push_back({row.name, {}});
  std::vector<std::string> methods = arguments.methods;
  const bool with_cross_check =
      std::holds_alternative<RobustnessStudy>(e.study) && std::erase(methods, "cross_check") > 0;
  std::vector<Experiment::Entry> more;  // they run whether --methods names them or not
  for (const std::string& command : arguments.commands) {
    e.programs.push_back(program_in(command));
    more.push_back({e.programs.back().name, {}});
  }
  for (const std::string& name : arguments.deletes) {
    const auto named = [&](const ProgramSettings& program) { return program.name == name; };
    const auto program = std::find_if(e.programs.begin(), e.programs.end(), named);
    if (program == e.programs.end()) throw InputError("--deletes " + name + ": is no program; name one of --command");
    program->deletes = true;
  }
  for (const std::string& one : arguments.more_methods) {
    const std::string name = one.substr(0, one.find('='));
    more.push_back({name, {}});
    std::erase_if(e.methods, [&](const auto& entry) { return entry.method == name; });
  }
  for (const auto& [name, values] : more) std::erase(methods, name);
  restrict_to(e.methods, methods, "--methods", [](const auto& m) { return m.method; });
  if (methods.empty() && !arguments.methods.empty()) e.methods.clear();
  e.methods.insert(e.methods.end(), more.begin(), more.end());
  restrict_to(e.resolutions, arguments.resolutions, "--resolutions", [](int r) { return r; });
  apply_to_study(e, arguments, with_cross_check);
  if (arguments.seed == "commit")
    e.seed = seed_of_commit(context);
  else if (!arguments.seed.empty())
    e.seed = seed_in(arguments.seed);
  variants_of(e, nameable_methods());  // throws where a method or its parameter is wrong
  return e;
}

/// While it lives, this process and those it starts stay on one core: the i-th for shard i, so that shards that run
/// side by side do not meet on one.
class OneCore {
 public:
  explicit OneCore(int shard) {
    if (sched_getaffinity(0, sizeof before_, &before_) != 0) return;
    std::vector<int> allowed;
    for (int core = 0; core < CPU_SETSIZE; ++core)
      if (CPU_ISSET(to_size(core), &before_)) allowed.push_back(core);
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(to_size(allowed.at(to_size(shard - 1) % allowed.size())), &one);
    sched_setaffinity(0, sizeof one, &one);
  }
  ~OneCore() { sched_setaffinity(0, sizeof before_, &before_); }
  OneCore(const OneCore&) = delete;
  OneCore& operator=(const OneCore&) = delete;

 private:
  cpu_set_t before_{};
};

bool run_measured(const Experiment& e, const Context& context, const RunOptions& options) {
  const OneCore pinned(options.shard);
  const bool ok = run_experiment(e, nameable_methods(), context, options);
  if (const std::string note = busy_note(context.load); !note.empty())
    std::fprintf(stderr, "%s: %s", e.stem.c_str(), note.c_str());
  return ok;
}

Exit run_all(const RunArguments& arguments, const std::string& command_line) {
  explain_interruption();
  const RunOptions options = run_options(arguments, command_line);
  const Context context = gather_context(cholmod_version());
  std::vector<Experiment> experiments;  // all are read before any is run
  for (const auto& file : arguments.experiments) experiments.push_back(read_part(file, arguments, context));
  for (const Experiment& e : experiments)
    if (arguments.jobs > 1 && e.records_times())
      throw InputError(e.stem + ": records times, which other processes would disturb; leave --jobs out");
  bool ok = true;
  for (const Experiment& e : experiments)
    ok &=
        e.records_times() ? run_measured(e, context, options) : run_experiment(e, nameable_methods(), context, options);
  return ok ? done : fell_short;
}

}  // namespace

Command add_run(Options& app) {
  auto arguments = std::make_shared<RunArguments>();
  auto command = app.add_subcommand("run", "run experiments; what was interrupted goes on where it stopped");
  command.add_option("experiments", arguments->experiments, "experiment files (TOML)").required();
  command
      .add_option("--methods", arguments->methods,
                  "only these of the experiment, and names of --command, comma-separated")
      .comma_separated();
  command
      .add_option(
          "--more-methods", arguments->more_methods,
          "methods beside those of the experiment, comma-separated; NAME=VERSION: rows of another version of it "
          "are not taken over")
      .comma_separated();
  command.add_option("--command", arguments->commands,
                     "NAME=COMMAND: a program as one more method, such as: mine=python3 mine.py {mesh} {path} {out}");
  command
      .add_option("--deletes", arguments->deletes,
                  "names of --command that take triangles out instead of dividing them, comma-separated")
      .comma_separated();
  command.add_option("--resolutions", arguments->resolutions, "only these of the experiment (triangles)")
      .comma_separated();
  command.add_option("--sweeps", arguments->sweeps, "only these [[sweeps]] of the experiment").comma_separated();
  command
      .add_option("--cases", arguments->cases,
                  "number of cases, or of members of an accuracy run, instead of the experiment's")
      .positive();
  command.add_option("--repetitions", arguments->repetitions, "of each cut, instead of the experiment's").positive();
  command.add_option("--seed", arguments->seed,
                     "a number, or `commit`: from the commit's hash; otherwise the experiment's");
  command.add_option("--out", arguments->out, "results folder").shows_default();
  command
      .add_option("--jobs", arguments->jobs,
                  "processes of a robustness run, or of an experiment with `times = false`; all cores where it is not "
                  "given. Other experiments stay on one core")
      .positive();
  command.add_option("--shard", arguments->shard, "i/N: only one N-th of the cases, the i-th").shows_default();
  command.footer(
      "example, which takes less than a minute:\n"
      "  cutbench run experiments/method_comparison.toml --resolutions 800 --cases 2 --out results/small\n"
      "exit codes:\n"
      "  0  all cuts were judged correct\n"
      "  1  a method failed, a result is wrong, a --command made no cut, or a file can't be written\n"
      "  2  bad input: an option or a file");
  return {command, [arguments](const std::string& line) { return run_all(*arguments, line); }};
}

}  // namespace cutbench
