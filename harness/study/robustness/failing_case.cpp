#include "harness/study/robustness/failing_case.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>

#include "harness/cut/cut_all.h"
#include "harness/cut/cut_program.h"
#include "harness/files/mesh_file.h"
#include "harness/files/path_file.h"
#include "harness/judge/judged_sheet.h"
#include "harness/processes/subprocess.h"

namespace cutbench {

namespace {

/// What `cutbench cut` does with the files, in a process of its own, in a line.
std::string outcome_of_command(const Variant& variant, const std::filesystem::path& mesh,
                               const std::filesystem::path& path, const CutOptions& options, double time_limit_s) {
  const SharedArray<std::array<char, 400>> said(1);
  const auto run_command = [&](std::size_t) {
    const auto say = [&](const std::string& text) { text.copy(said[0].data(), said[0].size() - 1); };
    const Sheet before(read_mesh(mesh));
    const std::vector<Curve> cuts = read_path(path);
    Sheet sheet = before;
    Locator locator(sheet);
    Cutter cutter;
    const auto method = variant.row->make(variant.parameter);
    const CutRun run = cut_all(sheet, locator, cutter, cuts, *method, options);
    if (run.status == Status::failed) return say("failed (" + std::string(name_of(run.verdict)) + "): " + run.reason);
    if (run.status == Status::refused) return say("refused: " + run.reason);
    const Judgement judgement =
        judge_one_by_one(before, sheet, cuts, variant.row->promises, variant.row->make(variant.parameter), options);
    say(judgement.ok ? std::string(name_of(run.status)) + ": the result passes"
                     : "failed (" + std::string(name_of(judgement.verdict)) + "): " + judgement.problems.front());
  };
  switch (run_isolated(1, {1, time_limit_s}, run_command).front()) {
    case Fate::done:
      return said[0].data();
    case Fate::timed_out:
      return "(does not end)";
    case Fate::crashed:
    case Fate::not_begun:
    case Fate::under_way:
      break;
  }
  return "(crashes)";
}

std::string command(const Variant& variant, const std::filesystem::path& stem, const CutOptions& options) {
  char chord[32];
  std::snprintf(chord, sizeof chord, "%.17g", options.chord_tolerance);
  const std::string parameter = variant.parameter_text();
  const auto made = variant.row->make(variant.parameter);
  const CutProgram* const program = made->program();
  const std::string method = program
                                 ? "--command " + quoted(program->command())
                                 : "--method " + variant.row->name + (parameter.empty() ? "" : " --set " + parameter);
  return "build/release/cutbench cut --mesh " + stem.string() + ".obj --path " + stem.string() + ".json " + method +
         " --chord-tolerance " + chord + " --out result.obj";
}

}  // namespace

std::string Fault::text() const {
  return "cut " + std::to_string(cut + 1) + " " + count_names[kind] + (verdict.empty() ? "" : " (" + verdict + ")") +
         (reason.empty() ? "" : ": " + reason);
}

Fault fault_of(const CaseResult& result, Fate fate) {
  if (fate == Fate::timed_out) return {Count::timed_out, "", "", result.cut};
  if (fate != Fate::done) return {Count::crashed, "signal", "", result.cut};
  return {result.fault, result.verdict.data(), result.reason.data(), result.cut};
}

Fault try_in_isolation(const Contender& contender, const CutCase& cut_case, const CutOptions& options,
                       double time_limit_s) {
  const SharedArray<CaseResult> result(1);
  const auto fate = run_isolated(1, {1, time_limit_s}, [&](std::size_t) {
    try_case(contender, Sheet(cut_case.mesh), cut_case.cuts, options, result[0]);
  });
  return fault_of(result[0], fate.front());
}

void save(const FailingCase& failing, const std::filesystem::path& folder, const Contender& contender,
          const CutOptions& options, double time_limit_s, double shrinking_s) {
  std::string text = failing.title + "\n" + failing.fault.text() + "\n";
  const auto write = [&](const std::string& name, const CutCase& cut_case) {
    const std::filesystem::path stem = folder / name, mesh = stem.string() + ".obj", path = stem.string() + ".json";
    write_mesh(cut_case.mesh, mesh);
    write_path(cut_case.cuts, path);
    const CutCase again{read_mesh(mesh), read_path(path)};
    const Fault fault = try_in_isolation(contender, again, options, time_limit_s);
    text += "\n" + name + ": " + std::to_string(cut_case.mesh.triangles.size()) + " triangles, " +
            std::to_string(cut_case.cuts.size()) +
            " cuts\nread back: " + (fault.same_as(failing.fault) ? "the same, " : "NOT the same, ") + fault.text() +
            "\n";
    if (contender.variant)
      text += command(*contender.variant, stem, options) +
              "\nprints: " + outcome_of_command(*contender.variant, mesh, path, options, time_limit_s) + "\n";
    else
      text += "made by the cross-check: no command makes it\n";
  };
  write(failing.name, failing.cut_case);

  const double trial_s = std::min(time_limit_s, shrinking_s / 10);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::duration<double>(shrinking_s);
  const auto still_fails = [&](const CutCase& part) {
    return std::chrono::steady_clock::now() < deadline &&
           try_in_isolation(contender, part, options, trial_s).same_as(failing.fault);
  };
  write(failing.name + ".small", shrunk(failing.cut_case, still_fails));

  const std::filesystem::path file = folder / (failing.name + ".txt");
  std::ofstream out(file);
  out << text;
  out.flush();
  if (!out) throw InputError(file.string() + ": can't be written; check that the folder may be written and has room");
}

}  // namespace cutbench
