// A sheet under the knife of one method, every cut of which is judged: what the tests, the campaign and all records are
// made of.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "harness/cut/cut.h"
#include "harness/measure/oracle.h"

namespace cutbench {

/// Passes everything that a cut asks for on to a method, and notes which of the two steps made vertices.
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

  bool improved = false;              ///< in the last cut
  std::size_t embedded_vertices = 0;  ///< by embed(), of all cuts

 private:
  std::unique_ptr<CuttingMethod> method_;
};

class JudgedSheet {
 public:
  JudgedSheet(Sheet start, const Promises& promises, std::unique_ptr<CuttingMethod> method);

  struct Finding {
    std::string verdict = "ok", reason;  ///< `changed`, `check`, or the oracle's
    bool ok() const { return verdict == "ok"; }
  };
  /// Cuts, and judges what came out whatever the status says: after noop, refused and failed the sheet must be
  /// bit-unchanged, and a noop must be justified; after ok it must pass check() and the oracle, and after deviated all
  /// of it but the number of pieces.
  Finding cut(const Curve& curve, const CutOptions& options);

  /// Why the method refuses the sheet as it is; empty: it doesn't.
  std::optional<std::string> why_unsupported() const { return method_.why_unsupported(sheet); }

  std::size_t embedded_vertices() const { return method_.embedded_vertices; }

  Sheet sheet;
  CutOutcome outcome;  ///< of the last cut
  oracle::Judgement
      judgement;  ///< of the last cut, where the oracle was asked, without what `deviated` forgives; rest units

 private:
  Locator locator_;
  Promises promises_;
  Watched method_;
  Cutter cutter_;
};

/// Judges what cuts, none of them refused, made of a sheet: makes them once more, and judges each on what the one
/// before left. An incision lies within the tolerance of its curve only, so that a later cut may rightly meet it
/// elsewhere than the curves meet. Ends with the first that is not ok; number of pieces after the last, largest
/// incision error, change of area in all. Verdict `not_reproduced` where that does not make `result`, bit for bit.
/// \param method  a new one, of the same kind
oracle::Judgement judge_one_by_one(const Sheet& start, const Sheet& result, std::span<const Curve> cuts,
                                   const Promises& promises, std::unique_ptr<CuttingMethod> method,
                                   const CutOptions& options);

}  // namespace cutbench
