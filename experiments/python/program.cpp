// The program itself, with functions of Python among its methods.
#include <pybind11/stl.h>

#include "experiments/program/command_line.h"
#include "experiments/python/held.h"
#include "harness/records/metrics.h"

namespace cutbench::python {

namespace {

namespace py = pybind11;

/// Keeps the interpreter: processes that it forks may call functions of Python.
int command_line_of(std::vector<std::string> arguments, const std::vector<const HeldMethod*>& more,
                    const Scene* scene) {
  arguments.insert(arguments.begin(), "cutbench");
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  std::vector<MethodRow> rows;
  for (const HeldMethod* method : more) rows.push_back(method->row);
  return command_line(static_cast<int>(argv.size()), argv.data(), rows, scene);
}

}  // namespace

void bind_program(py::module_& m) {
  m.def("command_line", &command_line_of);
  m.def("columns_json", [] { return columns_as_json(); });
}

}  // namespace cutbench::python
