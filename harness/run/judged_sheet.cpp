#include "harness/run/judged_sheet.h"

#include <algorithm>
#include <cmath>

#include "harness/run/report.h"
#include "harness/run/same_sheet.h"

namespace cutbench {

JudgedSheet::JudgedSheet(Sheet start, const Promises& promises, std::unique_ptr<CuttingMethod> method)
    : sheet(std::move(start)), locator_(sheet), promises_(promises), method_(std::move(method)) {}

JudgedSheet::Finding JudgedSheet::cut(const Curve& curve, const CutOptions& options) {
  const Sheet before = sheet;
  outcome = cutter_.cut(sheet, locator_, curve, method_, options);
  const Status status = outcome.status;
  if (status != Status::ok && status != Status::deviated)
    if (const std::string what = difference(before, sheet); !what.empty())
      return {"changed", std::string(name_of(status)) + ", but changed: " + what};
  if (status == Status::refused || status == Status::failed) return {};
  if (const auto faults = check(sheet); !faults.empty()) return {"check", faults.front()};

  oracle::Request request;
  if (status == Status::noop) {  // justified where the path opens nothing
    CutOptions exact = options;  // a curve may follow an older incision, a polyline may not
    if (curve.kind == Curve::Kind::polyline || !std::isfinite(options.chord_tolerance)) exact.chord_tolerance = 0;
    request = request_for(before, {&curve, 1}, promises_, exact, false);
    request.tolerance += request.snap;
  } else {
    request = request_for(before, {&curve, 1}, promises_, options, method_.improved);
  }
  request.snap = std::max(request.snap, 2 * outcome.deviation);
  request.vertex_tolerance += outcome.deviation, request.tolerance += outcome.deviation;
  judgement = oracle::judge(request, for_oracle(sheet));
  const auto counts = [status](const std::string& problem) {
    return status != Status::deviated || !problem.starts_with("wrong_pieces");
  };
  const auto problem = std::find_if(judgement.problems.begin(), judgement.problems.end(), counts);
  if (problem == judgement.problems.end()) return {};
  return {problem->substr(0, problem->find(':')), std::string(name_of(status)) + ", but " + *problem};
}

oracle::Judgement judge_one_by_one(const Sheet& start, std::span<const Curve> cuts, const Promises& promises,
                                   std::unique_ptr<CuttingMethod> method, const CutOptions& options) {
  JudgedSheet sheet(start, promises, std::move(method));
  oracle::Judgement all;
  for (const Curve& curve : cuts) {
    sheet.judgement = {};
    const JudgedSheet::Finding finding = sheet.cut(curve, options);
    const oracle::Judgement& last = sheet.judgement;
    all.pieces = last.pieces, all.expected_pieces = last.expected_pieces;
    all.incision_error = std::max(all.incision_error, last.incision_error);
    all.area_change += (1 + all.area_change) * last.area_change;
    if (finding.ok()) continue;
    all.ok = false, all.verdict = finding.verdict;
    all.problems = last.ok ? std::vector{finding.reason} : last.problems;
    break;
  }
  return all;
}

}  // namespace cutbench
