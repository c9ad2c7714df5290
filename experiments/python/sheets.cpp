// Sheets and paths.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <optional>
#include <utility>

#include "experiments/python/arrays.h"
#include "experiments/python/held.h"
#include "harness/base/errors.h"
#include "harness/cases/cut_families.h"
#include "harness/files/mesh_file.h"
#include "harness/files/path_file.h"
#include "harness/files/texture_file.h"
#include "harness/mesh/check_and_repair.h"
#include "harness/mesh/families.h"
#include "harness/mesh/mesh_text.h"
#include "harness/mesh/rest_choice.h"

namespace cutbench::python {

HeldSheet::HeldSheet(MeshData data) : sheet(std::make_shared<Sheet>(data)), uncut(sheet), mesh(std::move(data)) {}

HeldSheet::HeldSheet(Sheet cut, std::shared_ptr<const Sheet> before_all)
    : sheet(std::make_shared<Sheet>(std::move(cut))), uncut(std::move(before_all)), mesh(sheet->to_mesh_data()) {}

void check_path(const std::vector<AnyCurve>& path) {
  if (path.empty()) throw InputError("path: no curve; give at least one");
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::string name = "path, cut " + std::to_string(i);
    if (const auto* curve = std::get_if<Curve>(&path[i]))
      check_curve(*curve, name);
    else
      check_picks(std::get<PickedCurve>(path[i]), name);
  }
}

std::vector<Curve> in_rest_space(const std::vector<AnyCurve>& path, const Sheet& posed) {
  check_path(path);
  return curves_at_rest(path, posed, "path").curves;
}

namespace {

std::vector<Point3> in_space(const Array<double>& points) {
  if (points.shape(1) == 3) return rows_of<Point3>(points);
  std::vector<Point3> rows;
  rows.reserve(to_size(points.shape(0)));
  for (const Point2 p : rows_of<Point2>(points)) rows.push_back({p.x, p.y, 0});
  return rows;
}

std::vector<std::array<std::int32_t, 3>> corners_of(const Array<std::int32_t>& triangles) {
  return rows_of<std::array<std::int32_t, 3>>(triangles);
}

/// What 32 bits do not hold is -1.
std::vector<std::array<std::int32_t, 3>> corners_of(const Array<std::int64_t>& triangles) {
  std::vector<std::array<std::int32_t, 3>> rows(to_size(triangles.shape(0)));
  const std::int64_t* next = triangles.data();
  for (auto& row : rows)
    for (std::int32_t& corner : row) {
      const auto low = static_cast<std::int32_t>(*next);
      corner = low == *next ? low : -1;  // without a branch
      ++next;
    }
  return rows;
}

/// Where rest positions come from: positions of their own, two or three numbers each, or the plane that the sheet lies
/// in.
template <class Number>
MeshData mesh_of(const Array<double>& vertices, const Array<Number>& triangles,
                 const std::optional<Array<double>>& rest) {
  MeshData mesh;
  mesh.deformed = in_space(vertices);
  mesh.triangles = corners_of(triangles);
  if (!rest) return mesh;
  if (rest->shape(1) == 2) {
    mesh.rest = rows_of<Point2>(*rest);
    return mesh;
  }
  MeshData flat;
  flat.deformed = rows_of<Point3>(*rest);
  flat.triangles = mesh.triangles;
  take_rest_from_plane(flat, "rest");
  mesh.rest = std::move(flat.rest);
  return mesh;
}

/// \param sewn  per vertex, the same number where they are one point of the sheet (MeshData::sewn)
/// \param from  where rest positions come from without `rest`: one of rest_names. With it, "space": they are of an
/// unrolled sheet
template <class Number>
std::shared_ptr<HeldSheet> sheet_of(const Array<double>& vertices, const Array<Number>& triangles,
                                    const std::optional<Array<double>>& rest,
                                    const std::optional<Array<std::int32_t>>& sewn, const std::string& from) {
  MeshData mesh = mesh_of(vertices, triangles, rest);
  if (sewn) mesh.sewn.assign(sewn->data(), sewn->data() + sewn->size());
  const py::gil_scoped_release others_go_on;
  if (mesh.rest.empty())
    take_rest(mesh, "sheet", *value_named(rest_names, from));
  else
    mesh.unrolled = from == "space";
  check_and_repair(mesh, "sheet");
  return std::make_shared<HeldSheet>(std::move(mesh));
}

MeshData family_of(const std::string& family, std::int64_t triangles, double size) {
  MeshData mesh = make_sheet(family, squares_per_side(triangles));
  for (Point2& p : mesh.rest) p = size * p;
  for (Point3& p : mesh.deformed) p = size * p;
  return mesh;
}

/// \param corners  triangles x 6, in the order of the sheet's own triangles
void take_texture(HeldSheet& sheet, const Array<double>& corners) {
  sheet.texture = rows_of<std::array<Point2, 3>>(corners);
}

void write_sheet(const HeldSheet& sheet, const std::filesystem::path& file) {
  textured_file(sheet.mesh, sheet.texture, file).place();
}

Curve::Kind kind_of(bool bezier) { return bezier ? Curve::Kind::bezier : Curve::Kind::polyline; }

PickedCurve picked_of(bool bezier, const Array<double>& origins, const std::optional<Array<double>>& directions,
                      bool closed) {
  PickedCurve curve{kind_of(bezier), closed, {}};
  for (const Point3 p : rows_of<Point3>(origins)) curve.picks.push_back({p, {}});
  if (!directions) return curve;
  const auto rays = rows_of<Point3>(*directions);
  for (std::size_t i = 0; i < rays.size(); ++i) curve.picks[i].direction = rays[i];
  return curve;
}

}  // namespace

SheetPointer sheet_of_plain(const py::handle vertices, const py::handle triangles) try {
  const auto places = plain_rows<double>(vertices, 2, 3);
  const auto wide = plain_rows<std::int64_t>(triangles, 3, 3);
  const auto narrow = plain_rows<std::int32_t>(triangles, 3, 3);
  if (!places || (!wide && !narrow)) return nullptr;
  const SheetPointer sheet =
      wide ? sheet_of(*places, *wide, {}, {}, "auto") : sheet_of(*places, *narrow, {}, {}, "auto");
  for (const std::string& note : sheet->mesh.notes) py::module_::import("cutbench.sheet").attr("warn")(note);
  return sheet;
} catch (const InputError&) {
  return nullptr;
}

std::optional<Curve> polyline_of_plain(const py::handle points) try {
  const auto rows = plain_rows<double>(points, 2, 2);
  if (!rows) return {};
  Curve curve{Curve::Kind::polyline, false, rows_of<Point2>(*rows)};
  check_curve(curve, "path");
  return curve;
} catch (const InputError&) {
  return {};
}

void bind_sheets(py::module_& m) {
  py::class_<HeldSheet, std::shared_ptr<HeldSheet>>(m, "Sheet")
      .def_property_readonly(
          "vertices",
          [](const py::object& self) { return view_of<double>(self.cast<const HeldSheet&>().mesh.deformed, self); })
      .def_property_readonly(
          "rest", [](const py::object& self) { return view_of<double>(self.cast<const HeldSheet&>().mesh.rest, self); })
      .def_property_readonly("triangles",
                             [](const py::object& self) {
                               return view_of<std::int32_t>(self.cast<const HeldSheet&>().mesh.triangles, self);
                             })
      .def_property_readonly("given", [](const HeldSheet& s) { return array_of<std::int32_t>(s.mesh.file_vertices); })
      .def_property_readonly("sewn", [](const HeldSheet& s) { return array_of<std::int32_t>(s.mesh.sewn); })
      .def_property_readonly(
          "texture",
          [](const py::object& self) { return view_of<double>(self.cast<const HeldSheet&>().texture, self); })
      .def("take_texture", &take_texture)
      .def_property_readonly("unrolled", [](const HeldSheet& s) { return s.mesh.unrolled; })
      .def_property_readonly("notes", [](const HeldSheet& s) { return s.mesh.notes; })
      .def_property_readonly("mean_edge", [](const HeldSheet& s) { return s.sheet->mean_edge(); })
      .def_property_readonly("pieces", [](const HeldSheet& s) { return array_of<std::int32_t>(pieces_of(s.mesh)); })
      .def("write", [](const HeldSheet& s, const std::filesystem::path& file) { write_sheet(s, file); })
      .def("random_cut", [](const HeldSheet& s, const std::string& family, std::uint64_t seed, std::size_t i) {
        return make_case(family, seed, i, *s.sheet);
      });
  m.def("sheet", &sheet_of<std::int32_t>);
  m.def("sheet", &sheet_of<std::int64_t>);
  m.def("read_sheet", [](const std::filesystem::path& file, const std::string& rest, bool triangulate,
                         const std::optional<double>& sew) {
    const std::optional<RestFrom> from = value_named(rest_names, rest);
    if (!from) throw InputError("rest: \"" + rest + "\" is not known; known are auto, vt, plane, space");
    const MeshReading reading{*from, triangulate, sew};
    const auto sheet = std::make_shared<HeldSheet>(read_mesh(file, reading));
    sheet->texture = read_texture(file, reading, sheet->mesh);
    return sheet;
  });
  m.def("family_sheet", [](const std::string& family, std::int64_t triangles, double size) {
    return std::make_shared<HeldSheet>(family_of(family, triangles, size));
  });
  m.attr("sheet_families") = std::vector<std::string>(sheet_families().begin(), sheet_families().end());
  m.attr("cut_families") = std::vector<std::string>(cut_families().begin(), cut_families().end());

  py::class_<Curve>(m, "Curve")
      .def(py::init([](bool bezier, const Array<double>& points, bool closed) {
        Curve curve{kind_of(bezier), closed, rows_of<Point2>(points)};
        check_curve(curve, "path");
        return curve;
      }))
      .def_property_readonly(
          "points", [](const Curve& c) { return array_of<double>(c.points); },
          "k x 2 floats, at rest: of a polyline, or control points.")
      .def_property_readonly(
          "bezier", [](const Curve& c) { return c.kind == Curve::Kind::bezier; },
          "It is a chain of cubic Bezier curves; else a polyline.")
      .def_readonly("closed", &Curve::closed)
      .def(
          "flattened",
          [](const Curve& c, double tolerance) {
            Polyline line;
            flatten(c, tolerance, 0, line);
            if (line.closed && !line.points.empty()) line.points.push_back(line.points.front());
            return array_of<double>(std::move(line.points));
          },
          py::arg("tolerance"),
          "k x 2 floats: the curve as a polyline that is nowhere farther from it than `tolerance`, in the unit of the "
          "sheet's rest positions; such as 0.05 * sheet.mean_edge. A closed one ends with its first point.");
  py::class_<PickedCurve>(m, "PickedCurve")
      .def(py::init(
          [](bool bezier, const Array<double>& origins, const std::optional<Array<double>>& directions, bool closed) {
            PickedCurve curve = picked_of(bezier, origins, directions, closed);
            check_picks(curve, "path");
            return curve;
          }));
  m.def("read_path", [](const std::filesystem::path& file) { return read_path_with_picks(file); });
  m.def("write_path",
        [](const std::vector<Curve>& path, const std::filesystem::path& file) { write_path(path, file); });
}

}  // namespace cutbench::python
