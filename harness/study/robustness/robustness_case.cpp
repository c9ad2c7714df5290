#include "harness/study/robustness/robustness_case.h"

#include <algorithm>
#include <exception>
#include <span>

#include "harness/base/conversions.h"
#include "harness/base/stop_watch.h"
#include "harness/judge/judged_sheet.h"
#include "harness/judge/oracle_request.h"
#include "harness/programs/program.h"
#include "harness/study/robustness/cgal_check.h"

namespace cutbench {

namespace {

Count::Kind count_of(Status status) {
  constexpr Count::Kind counts[] = {Count::ok, Count::noop, Count::deviated, Count::refused, Count::failed};
  return counts[to_size(status)];
}

class MethodAtWork : public Subject {
 public:
  MethodAtWork(const Variant& variant, const Sheet& start, const CutOptions& options)
      : MethodAtWork(variant, start, options, variant.row->make(variant.parameter)) {}

  Result cut(const Curve& curve) override {
    const JudgedSheet::Finding finding = sheet_.cut(curve, options_);
    const CutOutcome& outcome = sheet_.outcome;
    const double us = outcome.time_us.total();
    if (!finding.ok()) return {Count::wrong, name_of(finding.verdict), finding.reason, us, outcome.carefully};
    const bool program_failed = is_program_ && outcome.status == Status::failed;
    return {program_failed ? fault_of_program(outcome.verdict) : count_of(outcome.status), name_of(outcome.verdict),
            outcome.reason, us, outcome.carefully};
  }

 private:
  MethodAtWork(const Variant& variant, const Sheet& start, const CutOptions& options,
               std::unique_ptr<CuttingMethod> method)
      : is_program_(method->program() != nullptr),
        sheet_(start, variant.row->promises, std::move(method)),
        options_(options) {}

  /// What a program made is judged before the sheet takes it over.
  static Count::Kind fault_of_program(Verdict verdict) {
    if (verdict == Verdict::crashed) return Count::crashed;
    if (verdict == Verdict::timed_out) return Count::timed_out;
    return verdict == Verdict::no_result ? Count::failed : Count::wrong;
  }

  bool is_program_;
  JudgedSheet sheet_;
  CutOptions options_;
};

class CrossCheckAtWork : public Subject {
 public:
  CrossCheckAtWork(const Sheet& start, const CutOptions& options)
      : start_(start), mesh_(for_oracle(start)), options_(options) {}

  Result cut(const Curve& curve) override {
    constexpr Promises promises{.exact_incision = true, .keeps_area = true, .conforming = true, .keeps_vertices = true};
    oracle::Request request = request_for(start_, {&curve, 1}, promises, options_, false);
    request.before = std::move(mesh_);
    StopWatch watch;
    oracle::CrossCheckResult result = oracle::cgal_whole_sheet_cut(request.before, for_oracle(curve),
                                                                   options_.flatten_tolerance * start_.mean_edge());
    const double us = watch.lap();
    mesh_ = std::move(result.mesh);
    if (result.refused) {
      mesh_ = std::move(request.before);
      return {Count::refused, "ok", result.reason, us};
    }
    const Judgement judgement = oracle::judge(request, mesh_);
    if (!judgement.ok) return {Count::wrong, name_of(judgement.verdict), judgement.problems.front(), us};
    return {Count::ok, "ok", "", us};
  }

 private:
  const Sheet& start_;  // for its lengths
  oracle::Mesh mesh_;
  CutOptions options_;
};

void copy_to_array(const std::string& text, std::span<char> to) {
  const std::size_t size = text.copy(to.data(), to.size() - 1);
  to[size] = 0;
}

void note_fault(CaseResult& result, std::int32_t cut, Count::Kind fault, const std::string& verdict,
                const std::string& reason) {
  if (result.fault != Count::ok) return;
  result.cut = cut;
  result.fault = fault;
  copy_to_array(verdict, result.verdict);
  copy_to_array(reason, result.reason);
}

}  // namespace

Contender contender_of(const Variant& variant) {
  return {variant.row->name, variant.parameter_text(), variant,
          [variant](const Sheet& start, const CutOptions& options) {
            return std::make_unique<MethodAtWork>(variant, start, options);
          }};
}

Contender cgal_check() {
  return {"cgal_whole_sheet (cross-check)", "", {}, [](const Sheet& start, const CutOptions& options) {
            return std::make_unique<CrossCheckAtWork>(start, options);
          }};
}

void try_case(const Contender& contender, const Sheet& sheet, const std::vector<Curve>& cuts, const CutOptions& options,
              CaseResult& result) {
  const auto subject = contender.start(sheet, options);
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    const auto number = to_int32(k);
    if (result.fault == Count::ok) result.cut = number;
    ++result.count[Count::tried];
    try {
      const Subject::Result made = subject->cut(cuts[k]);
      ++result.count[made.outcome];
      result.count[Count::carefully] += made.carefully;
      result.slowest_us = std::max(result.slowest_us, made.us);
      if (made.outcome == Count::refused) copy_to_array(made.reason, result.refusal);
      if (made.outcome >= Count::failed) note_fault(result, number, made.outcome, made.verdict, made.reason);
      if (made.outcome > Count::failed) return;
    } catch (const std::exception& error) {  // the program would end by it
      ++result.count[Count::crashed];
      note_fault(result, number, Count::crashed, "exception", error.what());
      return;
    }
  }
}

}  // namespace cutbench
