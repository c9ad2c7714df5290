// Arrays of numpy: views of what Python holds, and copies into the library. The Python files have checked their shapes.
#pragma once

#include <pybind11/numpy.h>

#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/mesh/types.h"

namespace cutbench::python {

namespace py = pybind11;

template <class Number>
using Array = py::array_t<Number, py::array::c_style>;

inline void make_read_only(py::array& array) {
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
}

/// Rows of N numbers that stay where they are as long as `owner` lives: read-only, shared, no copy.
template <class Number, class Row>
Array<Number> view_of(const std::vector<Row>& rows, const py::handle owner) {
  constexpr auto width = static_cast<py::ssize_t>(sizeof(Row) / sizeof(Number));
  std::vector<py::ssize_t> shape{std::ssize(rows)};
  if (width > 1) shape.push_back(width);
  Array<Number> array(shape, reinterpret_cast<const Number*>(rows.data()), owner);
  make_read_only(array);
  return array;
}

/// Rows that the array takes over.
template <class Number, class Row>
Array<Number> array_of(std::vector<Row> rows) {
  auto* const held = new std::vector<Row>(std::move(rows));
  const py::capsule owner(held, [](void* p) { delete static_cast<std::vector<Row>*>(p); });
  return view_of<Number>(*held, owner);
}

/// Nothing where the library could not take it as it is, or it is of a subclass, as masked arrays are.
template <class Number>
std::optional<Array<Number>> plain_rows(const py::handle given, py::ssize_t fewest_columns, py::ssize_t most_columns) {
  const bool exactly = Py_TYPE(given.ptr()) == py::detail::npy_api::get().PyArray_Type_;
  if (!exactly || !Array<Number>::check_(given)) return {};
  auto array = py::reinterpret_borrow<Array<Number>>(given);
  const bool fits =
      array.ndim() == 2 && array.shape(0) > 0 && array.shape(1) >= fewest_columns && array.shape(1) <= most_columns;
  return fits ? std::optional(std::move(array)) : std::nullopt;
}

template <class Row, class Number>
std::vector<Row> rows_of(const Array<Number>& array) {
  const auto* const first = reinterpret_cast<const Row*>(array.data());
  return {first,
          first + array.size() * static_cast<py::ssize_t>(sizeof(Number)) / static_cast<py::ssize_t>(sizeof(Row))};
}

}  // namespace cutbench::python
