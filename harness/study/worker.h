// One method at work on one sheet after another, with its storage kept warm: how every run takes the time of a cut.
#pragma once

#include <memory>
#include <vector>

#include "harness/cut/cut_all.h"
#include "harness/mesh/constraints.h"
#include "harness/study/variant.h"

namespace cutbench {

/// A sheet that is cut again and again, and its locator.
struct BaseSheet {
  Sheet sheet;
  Locator locator;
  explicit BaseSheet(Sheet s = {}) : sheet(std::move(s)), locator(sheet) {}
};

class Worker {
 public:
  explicit Worker(const Variant& v) : variant(v), method(v.row->make(v.parameter)) {}

  /// Another base sheet comes next; the worker's is not one cut away from it.
  void forget_base() { undoable_ = false; }
  /// Cuts the base sheet. What the method constrains is part of the price: it is found anew after each cut (polygons:
  /// once).
  CutRun cut(const BaseSheet& base, const std::vector<Curve>& cuts, const CutOptions& options);
  /// Cold: right after other work has driven everything out of the caches. Warm: the same cut, made and undone twice
  /// just before; a program runs once either way.
  CutRun measure(const BaseSheet& base, const std::vector<Curve>& cuts, const CutOptions& options, bool cold);

  Variant variant;
  std::unique_ptr<CuttingMethod> method;
  Cutter cutter;
  Sheet sheet;              ///< what the last cut made of the base sheet
  Constraints constraints;  ///< of it

 private:
  /// Makes the sheet the base sheet again: by undoing a single cut, so that the caches stay as they are.
  void restore(const BaseSheet& base, const std::vector<Curve>& cuts);
  CutRun cut_restored(const BaseSheet& base, const std::vector<Curve>& cuts, const CutOptions& options);

  Locator locator_;
  bool undoable_ = false;  // at most one cut away from the base sheet
};

}  // namespace cutbench
