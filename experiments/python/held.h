// What Python holds of the library: sheets and cuts that never change, so that arrays can look into them, and methods.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/cut/cut_all.h"
#include "harness/cut/method_row.h"
#include "harness/judge/assessment.h"
#include "harness/mesh/mesh_data.h"
#include "harness/mesh/sheet.h"
#include "harness/mesh/texture.h"
#include "harness/path/curve.h"
#include "harness/path/pick.h"

namespace cutbench::python {

struct HeldSheet {
  /// \pre `mesh` passed check_and_repair()
  explicit HeldSheet(MeshData mesh);
  /// After a cut. \param uncut  the sheet before the first one; no slot of it has moved since
  HeldSheet(Sheet cut, std::shared_ptr<const Sheet> uncut);

  std::shared_ptr<const Sheet> sheet;
  std::shared_ptr<const Sheet> uncut;  ///< before its first cut: what a ConstraintSource counts from
  MeshData mesh;                       ///< of `sheet`, without free slots: a row each
  Texture texture = {};                ///< of `mesh`
};
using SheetPointer = std::shared_ptr<const HeldSheet>;

/// A method with a value of its parameter.
struct HeldMethod {
  MethodRow row;
  double parameter = 0;
  std::unique_ptr<CuttingMethod> make() const { return row.make(parameter); }
};

struct HeldCut {
  SheetPointer before, after;
  std::vector<Curve> curves;
  HeldMethod method;
  CutOptions options;
  CutRun run;
  double pick_us = 0;
};

/// A cut that was not made: the exception CutError of Python.
struct CutNotMade : std::runtime_error {
  CutNotMade(const std::string& what, Status status_of_cut, Verdict verdict_of_cut)
      : std::runtime_error(what), status(status_of_cut), verdict(verdict_of_cut) {}
  Status status;
  Verdict verdict;
};

/// Throws InputError: no curve, or one that is none.
void check_path(const std::vector<AnyCurve>& path);
/// The curves in rest space; picks are found on the sheet. Throws InputError, as check_path() does.
std::vector<Curve> in_rest_space(const std::vector<AnyCurve>& path, const Sheet& posed);
CutOptions options_of(double chord_tolerance);
/// Of arrays that Python has not checked. Warns of repairs. Null: they need conversion, or Python has to say what is
/// wrong.
SheetPointer sheet_of_plain(pybind11::handle vertices, pybind11::handle triangles);
std::optional<Curve> polyline_of_plain(pybind11::handle points);

// Each adds its part to the module.
void bind_sheets(pybind11::module_& m);
void bind_cuts(pybind11::module_& m);
void bind_methods(pybind11::module_& m);
void bind_simulations(pybind11::module_& m);
void bind_program(pybind11::module_& m);

}  // namespace cutbench::python
