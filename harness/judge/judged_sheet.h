// A sheet that one method cuts, with a judgement of every cut. Tests, the robustness run and all records are made with
// it.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "harness/cut/cut.h"
#include "harness/cut/method_row.h"
#include "harness/judge/judgement.h"

namespace cutbench {

/// Forwards every call of a cut to a method, and records whether embed() or improve() made vertices.
class Watched : public CuttingMethod {
 public:
  explicit Watched(std::unique_ptr<CuttingMethod> method) : method_(std::move(method)) {}
  std::optional<std::string> why_unsupported(const Sheet& sheet) const override {
    return method_->why_unsupported(sheet);
  }
  void adapt(Sheet& sheet, Subdivision& trace, const Polyline& path) override { method_->adapt(sheet, trace, path); }
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override {
    improved = false;
    method_->embed(sheet, trace, notes);
    embedded_vertices += sheet.log().new_vertices.size();
  }
  void improve(Sheet& sheet, MethodNotes& notes) override {
    const std::size_t before = sheet.log().new_vertices.size();
    method_->improve(sheet, notes);
    improved = sheet.log().new_vertices.size() > before;
  }
  CutProgram* program() override { return method_->program(); }

  bool improved = false;              ///< in the last cut
  std::size_t embedded_vertices = 0;  ///< by embed(), of all cuts

 private:
  std::unique_ptr<CuttingMethod> method_;
};

class JudgedSheet {
 public:
  JudgedSheet(Sheet start, const Promises& promises, std::unique_ptr<CuttingMethod> method);

  struct Finding {
    Verdict verdict = Verdict::ok;  ///< `changed`, `check`, or the oracle's
    std::string reason;
    bool ok() const { return verdict == Verdict::ok; }
  };
  /// Cuts, and judges the result for every status: after noop, refused and failed the sheet must be bit-unchanged, and
  /// a noop must be justified; after ok it must pass check() and the oracle; after deviated the same, except for the
  /// number of pieces.
  Finding cut(const Curve& curve, const CutOptions& options);

  /// Why the method refuses the sheet as it is; empty if it does not.
  std::optional<std::string> why_unsupported() const { return method_.why_unsupported(sheet); }

  std::size_t embedded_vertices() const { return method_.embedded_vertices; }

  Sheet sheet;
  CutOutcome outcome;   ///< of the last cut
  Judgement judgement;  ///< of the last cut, where the oracle was asked, without what `deviated` forgives; rest units

 private:
  Locator locator_;
  Promises promises_;
  Watched method_;
  Cutter cutter_;
};

/// Judges a sheet that was cut several times, no cut refused: makes the cuts once more, and judges each on the sheet
/// that the one before left. (An incision lies only within the tolerance of its curve, so a later cut may rightly meet
/// it elsewhere than the curves meet.) Stops at the first cut that is not ok. Returns the number of pieces after the
/// last cut, the largest incision error and the total change of area. Of a sheet with seams the pieces are those of the
/// surface after all cuts (on_surface.h). Verdict `not_reproduced` where the cuts do not make `result`, bit for bit.
/// \param method  a new one, of the same kind
Judgement judge_one_by_one(const Sheet& start, const Sheet& result, std::span<const Curve> cuts,
                           const Promises& promises, std::unique_ptr<CuttingMethod> method, const CutOptions& options);

}  // namespace cutbench
