// The module cutbench._core: what the package in Python (experiments/python/cutbench) is made of, and no more.
#include <malloc.h>

#include "experiments/python/held.h"
#include "harness/base/errors.h"

namespace py = pybind11;

namespace {

/// The classes of cutbench/errors.py.
py::object error_class(const char* name) { return py::module_::import("cutbench.errors").attr(name); }

// NOLINTNEXTLINE(performance-unnecessary-value-param): pybind11 asks for this signature
void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const cutbench::InputError& error) {
    PyErr_SetString(error_class("InputError").ptr(), error.what());
  } catch (const cutbench::OutputError& error) {
    PyErr_SetString(error_class("OutputError").ptr(), error.what());
  } catch (const cutbench::python::CutNotMade& error) {
    const py::object type = error_class("CutError");
    PyErr_SetObject(type.ptr(), type(error.what(), name_of(error.status), name_of(error.verdict)).ptr());
  }
}

/// A cut frees some MB that the next one needs again. glibc would hand them to the system and ask for them anew, page
/// by page: a quarter of the time at 12,800 triangles.
void keep_freed_memory() {
  mallopt(M_MMAP_THRESHOLD, 32 << 20);
  mallopt(M_TRIM_THRESHOLD, 64 << 20);
}

}  // namespace

PYBIND11_MODULE(_core, m) {
  keep_freed_memory();
  py::register_exception_translator(translate);
  cutbench::python::bind_sheets(m);
  cutbench::python::bind_methods(m);
  cutbench::python::bind_cuts(m);
  cutbench::python::bind_simulations(m);
  cutbench::python::bind_program(m);
}
