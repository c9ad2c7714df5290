// The table of methods, and functions of Python as methods.
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <map>

#include "experiments/python/arrays.h"
#include "experiments/python/held.h"
#include "harness/base/errors.h"
#include "harness/cut/cut_program.h"
#include "harness/path/cut_failed.h"
#include "harness/programs/program.h"
#include "methods/registry.h"

namespace cutbench::python {

namespace {

/// Held by threads that may not have the interpreter.
using Function = std::shared_ptr<py::function>;

Function shared(py::function function) {
  return {new py::function(std::move(function)), [](py::function* last) {
            const py::gil_scoped_acquire interpreter;
            delete last;
          }};
}

[[noreturn]] void fail(const py::error_already_set& error) {
  if (error.matches(PyExc_KeyboardInterrupt) || error.matches(PyExc_SystemExit)) throw error;
  std::string text = py::str(error.value());
  std::replace(text.begin(), text.end(), '\n', ' ');
  if (error.matches(py::module_::import("cutbench.errors").attr("Refused"))) throw CutRefused(text);
  const std::string type = py::str(error.type().attr("__name__"));
  throw CutFailed(Verdict::crashed, text.empty() ? type : type + ": " + text);
}

/// Asks for the whole cut, as a program of its own would be: what it returns is judged, and taken over.
class FunctionMethod final : public CuttingMethod, public CutProgram {
 public:
  FunctionMethod(std::string name, Function function, bool deletes)
      : name_("python: " + std::move(name)), function_(std::move(function)), deletes_(deletes) {}

  CutProgram* program() override { return this; }
  const std::string& command() const override { return name_; }

  double run(Sheet& sheet, Subdivision& trace, const Curve& curve, const CutOptions& options) override {
    const auto held = std::make_shared<HeldSheet>(sheet.to_mesh_data());
    const auto start = std::chrono::steady_clock::now();
    const MeshData result = ask(held, curve, options.chord_tolerance);
    const std::chrono::duration<double, std::micro> us = std::chrono::steady_clock::now() - start;
    take_over(sheet, trace, result, curve, options, deletes_);
    return us.count();
  }

 private:
  /// The function, as it is wrapped in cutbench/method.py, returns vertices, triangles and rest as checked arrays.
  MeshData ask(const std::shared_ptr<HeldSheet>& sheet, const Curve& curve, double chord_tolerance) const {
    const py::gil_scoped_acquire interpreter;
    try {
      const auto [vertices, triangles, rest] =
          (*function_)(sheet, curve, chord_tolerance)
              .cast<std::tuple<Array<double>, Array<std::int32_t>, Array<double>>>();
      MeshData mesh;
      mesh.rest = rows_of<Point2>(rest);
      mesh.deformed = rows_of<Point3>(vertices);
      mesh.triangles = rows_of<std::array<std::int32_t, 3>>(triangles);
      return mesh;
    } catch (const py::error_already_set& error) {
      fail(error);
    }
  }

  std::string name_;
  Function function_;
  bool deletes_;
};

HeldMethod method_of_function(const std::string& name, py::function function, bool deletes) {
  const Function held = shared(std::move(function));
  MethodRow row{
      .name = name,
      .summary = "a function of Python",
      .parameter = {},
      .promises = deletes ? promises_of_deleting_programs : promises_of_programs,
      .factory = [name, held, deletes](double) { return std::make_unique<FunctionMethod>(name, held, deletes); }};
  return {std::move(row), 0};
}

HeldMethod named_method(const std::string& name, const std::map<std::string, double>& settings) {
  const MethodRow& row = find_method(name);
  HeldMethod method{row, row.parameter.value};
  for (const auto& [key, value] : settings) {
    if (row.parameter.name.empty()) throw InputError(key + ": method \"" + name + "\" has no parameter");
    if (key != row.parameter.name)
      throw InputError(key + ": the parameter of \"" + name + "\" is " + row.parameter.name);
    method.parameter = value;
  }
  method.make();  // throws where the value is out of range
  return method;
}

py::list table() {
  py::list rows;
  for (const MethodRow& m : all_methods()) {
    py::dict row;
    row["method"] = m.name;
    row["summary"] = m.summary;
    row["parameter"] = m.parameter.name;
    row["default"] = m.parameter.name.empty() ? py::object(py::none()) : py::float_(m.parameter.value);
    row["range"] = m.parameter.name.empty() ? "" : m.parameter.range.text();
    row["meaning"] = m.parameter.meaning;
    row["exact_incision"] = m.promises.exact_incision;
    row["keeps_area"] = m.promises.keeps_area;
    row["conforming"] = m.promises.conforming;
    row["keeps_vertices"] = m.promises.keeps_vertices;
    rows.append(row);
  }
  return rows;
}

}  // namespace

void bind_methods(py::module_& m) {
  py::class_<HeldMethod>(m, "Method").def_property_readonly("name", [](const HeldMethod& method) {
    return method.row.name;
  });
  m.def("named_method", &named_method);
  m.def("method_of_function", &method_of_function);
  m.def("method_table", &table);
}

}  // namespace cutbench::python
