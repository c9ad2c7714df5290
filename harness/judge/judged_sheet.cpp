#include "harness/judge/judged_sheet.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "harness/judge/on_surface.h"
#include "harness/judge/oracle_request.h"
#include "harness/judge/same_sheet.h"

namespace cutbench {

namespace {

/// Of a line of Judgement::problems, which begins with it.
Verdict verdict_of_problem(const std::string& problem) {
  return value_named(verdict_names, problem.substr(0, problem.find(':'))).value();
}

}  // namespace

JudgedSheet::JudgedSheet(Sheet start, const Promises& promises, std::unique_ptr<CuttingMethod> method)
    : sheet(std::move(start)), locator_(sheet), promises_(promises), method_(std::move(method)) {}

JudgedSheet::Finding JudgedSheet::cut(const Curve& curve, const CutOptions& options) {
  const Sheet before = sheet;
  judgement = {};
  outcome = cutter_.cut(sheet, locator_, curve, method_, options);
  const Status status = outcome.status;
  if (status != Status::ok && status != Status::deviated)
    if (const std::string what = difference(before, sheet); !what.empty())
      return {Verdict::changed, std::string(name_of(status)) + ", but changed: " + what};
  if (status == Status::refused || status == Status::failed) return {};
  if (const auto faults = check(sheet); !faults.empty()) return {Verdict::check, faults.front()};

  oracle::Request request;
  if (status == Status::noop) {  // justified where the path opens nothing
    CutOptions exact = options;  // a curve may follow an older incision, a polyline may not
    if (curve.kind == Curve::Kind::polyline || !std::isfinite(options.chord_tolerance)) exact.chord_tolerance = 0;
    Promises unchanged = promises_;  // the method did nothing: its own bound does not apply
    unchanged.incision_bound = {};
    request = request_for(before, {&curve, 1}, unchanged, exact, false);
    request.tolerance += request.snap;
  } else {
    request = request_for(before, {&curve, 1}, promises_, options, method_.improved);
  }
  request.snap = std::max(request.snap, 2 * outcome.deviation);
  request.vertex_tolerance += outcome.deviation;
  request.tolerance += outcome.deviation;
  judgement = oracle::judge(request, for_oracle(sheet));
  if (status == Status::deviated) {
    std::erase_if(judgement.problems, [](const std::string& problem) { return problem.starts_with("wrong_pieces"); });
    judgement.ok = judgement.problems.empty();
    judgement.verdict = judgement.ok ? Verdict::ok : verdict_of_problem(judgement.problems.front());
  }
  if (judgement.ok) return {};
  return {judgement.verdict, std::string(name_of(status)) + ", but " + judgement.problems.front()};
}

Judgement judge_one_by_one(const Sheet& start, const Sheet& result, std::span<const Curve> cuts,
                           const Promises& promises, std::unique_ptr<CuttingMethod> method, const CutOptions& options) {
  JudgedSheet again(start, promises, std::move(method));
  Judgement all;
  Leeway leeway;
  bool as_asked = true;
  const auto stop = [&all](Verdict verdict, std::vector<std::string> problems) {
    all.ok = false;
    all.verdict = verdict;
    all.problems = std::move(problems);
    return all;
  };
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const std::string which =
        cuts.size() > 1 ? "cut " + std::to_string(i + 1) + " of " + std::to_string(cuts.size()) + ": " : "";
    const JudgedSheet::Finding finding = again.cut(cuts[i], options);
    const Judgement& last = again.judgement;
    leeway.add(last);
    as_asked = as_asked && (again.outcome.status == Status::ok || again.outcome.status == Status::noop);
    all.pieces = last.pieces;
    all.expected_pieces = last.expected_pieces;
    all.incision_error = std::max(all.incision_error, last.incision_error);
    all.area_change += (1 + all.area_change) * last.area_change;
    if (!finding.ok()) {
      std::vector<std::string> problems =
          last.ok ? std::vector{std::string(name_of(finding.verdict)) + ": " + finding.reason} : last.problems;
      for (std::string& problem : problems) problem = which + problem;
      return stop(finding.verdict, std::move(problems));
    }
    if (again.outcome.status == Status::refused || again.outcome.status == Status::failed) break;  // unlike before
  }
  if (const std::string what = difference(again.sheet, result); !what.empty())
    return stop(Verdict::not_reproduced, {"not_reproduced: made once more, the cuts leave another sheet: " + what});
  if (as_asked) judge_on_surface(all, start, cuts, for_oracle(result), promises, leeway);
  return all;
}

}  // namespace cutbench
