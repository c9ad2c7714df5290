// Cuts, their judgement, and what the parts of a cut sheet were before.
#include <pybind11/stl.h>

#include "experiments/program/commands/misses.h"
#include "experiments/python/arrays.h"
#include "experiments/python/held.h"
#include "harness/base/errors.h"
#include "harness/base/stop_watch.h"
#include "harness/cut/constraint_source.h"
#include "harness/judge/judged_sheet.h"
#include "harness/judge/result_svg.h"
#include "harness/mesh/check_and_repair.h"
#include "harness/mesh/parents.h"
#include "harness/mesh/row_numbers.h"
#include "harness/mesh/texture.h"
#include "harness/path/clear_of_seams.h"
#include "harness/records/report_json.h"
#include "methods/registry.h"

namespace cutbench::python {

CutOptions options_of(double chord_tolerance) {
  if (!(chord_tolerance > 0)) throw InputError("chord_tolerance: must be positive, or inf");
  CutOptions options;
  options.chord_tolerance = chord_tolerance;
  return options;
}

namespace {

using Row = std::int32_t;

/// The sheet, or one that is unrolled anew for the path.
SheetPointer clear_of_seams(const SheetPointer& sheet, const std::vector<AnyCurve>& path) {
  if (!sheet->mesh.unrolled || sheet->sheet != sheet->uncut) return sheet;
  check_path(path);
  MeshData mesh = sheet->mesh;
  clear_of_seams(mesh, "sheet", path, "path");
  if (mesh.rest == sheet->mesh.rest) return sheet;
  const auto anew = std::make_shared<HeldSheet>(std::move(mesh));
  anew->texture = sheet->texture;
  return anew;
}

std::shared_ptr<HeldCut> cut(const SheetPointer& given, const std::vector<AnyCurve>& path, const HeldMethod& method,
                             double chord_tolerance, bool allow_miss) {
  auto made = std::make_shared<HeldCut>();
  const SheetPointer before = made->before = clear_of_seams(given, path);
  made->method = method;
  made->options = options_of(chord_tolerance);
  const auto maker = method.make();
  StopWatch watch;
  made->curves = in_rest_space(path, *before->sheet);
  made->pick_us = watch.lap();
  Sheet sheet = *before->sheet;
  Locator locator(sheet);
  Cutter cutter;
  made->run = cut_all(sheet, locator, cutter, made->curves, *maker, made->options);
  if (made->run.status == Status::noop || made->curves.size() > 1)  // else it has met the sheet
    for (std::size_t i = 0; i < made->curves.size(); ++i)
      Misses{allow_miss}.check(*before->sheet, made->curves[i], "path, cut " + std::to_string(i));
  if (made->run.status == Status::refused)
    throw CutNotMade(method.row.name + " refuses this cut: " + made->run.reason, made->run.status, Verdict::refused);
  if (made->run.status == Status::failed)
    throw CutNotMade("failed (" + std::string(name_of(made->run.verdict)) + "): " + made->run.reason, made->run.status,
                     made->run.verdict);
  Texture texture;
  if (!before->texture.empty())
    texture = carried_over(before->texture, *before->sheet, sheet, parents_of(*before->sheet, sheet));
  const auto after = std::make_shared<HeldSheet>(std::move(sheet), before->uncut);
  after->texture = std::move(texture);
  made->after = after;
  return made;
}

/// In one call: a sheet of some thousand triangles drives Python out of the caches, and it would have to come back
/// for each step in between. \return  null: as of sheet_of_plain()
std::shared_ptr<HeldCut> cut_of_arrays(const py::handle vertices, const py::handle triangles, const py::handle path,
                                       const HeldMethod& method, double chord_tolerance, bool allow_miss) {
  const std::optional<Curve> curve = polyline_of_plain(path);
  const SheetPointer before = curve ? sheet_of_plain(vertices, triangles) : nullptr;
  if (!before) return nullptr;
  const py::gil_scoped_release others_go_on;
  return cut(before, {*curve}, method, chord_tolerance, allow_miss);
}

std::string report(const HeldCut& cut) {
  const Sheet &before = *cut.before->sheet, &after = *cut.after->sheet;
  const Judgement judgement =
      judge_one_by_one(before, after, cut.curves, cut.method.row.promises, cut.method.make(), cut.options);
  const Assessment a = assess(before, after, judgement, forced_corners_of(before, cut.curves));
  return cut_as_json(cut.method.row.name, cut.run, cut.pick_us, a, before.mean_edge());
}

/// Each vertex of the result as a weighted mean of vertices before all of its cuts: entries first[i] to first[i + 1].
struct ParentRows {
  std::vector<Row> first{0}, vertices;
  std::vector<double> weights;
  std::vector<Row> triangles;  ///< per triangle of the result, the one before that holds its centroid
};

ParentRows parents(const HeldCut& cut) {
  const Sheet &before = *cut.before->sheet, &after = *cut.after->sheet;
  const Parents parents = parents_of(before, after);
  const RowNumbers old(before), now(after);
  ParentRows result;
  for (std::size_t d = 0; d < now.vertex.size(); ++d) {
    if (now.vertex[d] < 0) continue;
    for (const VertexPart& part : parents.vertices[d]) {
      result.vertices.push_back(old.of(part.vertex));
      result.weights.push_back(part.weight);
    }
    result.first.push_back(to_int32(result.vertices.size()));
  }
  for (std::size_t t = 0; t < now.triangle.size(); ++t)
    if (now.triangle[t] >= 0) result.triangles.push_back(old.triangle[parents.triangles[t]()]);
  return result;
}

/// Edges of the incision: the two vertices of one lip, and those of the other, at the same rest positions.
std::vector<std::array<Row, 4>> lips(const HeldSheet& held) {
  const Sheet& sheet = *held.sheet;
  const RowNumbers rows(sheet);
  const auto begin_of = [&](HalfEdge h) {
    return rows.of(sheet.triangle(triangle_of(h)).deformed[to_size(corner_of(h))]);
  };
  std::vector<std::array<Row, 4>> edges;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(TriangleIndex(t), k);
      if (!sheet.triangle(TriangleIndex(t)).alive() || sheet.mark(h) != EdgeMark::incision) continue;
      const HalfEdge o = sheet.opposite(h);
      if (h < o) edges.push_back({begin_of(h), begin_of(Sheet::next(h)), begin_of(Sheet::next(o)), begin_of(o)});
    }
  return edges;
}

/// In rows; phantom node i is row n + i of the masters, with n vertices.
py::dict constraints(const HeldCut& cut) {
  const Sheet& after = *cut.after->sheet;
  const Constraints all = constraints_of(*cut.method.make(), *cut.after->uncut, after);
  const RowNumbers rows(after);
  std::vector<Row> vertices;
  std::vector<std::array<Row, 3>> masters;
  std::vector<std::array<double, 3>> weights;
  for (const Constraint& c : all.constraints) {
    vertices.push_back(rows.of(c.vertex));
    std::array<Row, 3> three{};
    for (std::size_t i = 0; i < 3; ++i) three[i] = c.masters[i].valid() ? rows.of(c.masters[i]) : -1;
    masters.push_back(three);
    weights.push_back(c.weights);
  }
  py::list polygons, polygon_triangles;
  for (const Polygon& p : all.polygons) {
    std::vector<Row> corners, parts;
    for (const DeformedIndex d : p.corners) corners.push_back(rows.of(d));
    for (const TriangleIndex t : p.triangles) parts.push_back(rows.triangle[t()]);
    polygons.append(array_of<Row>(std::move(corners)));
    polygon_triangles.append(array_of<Row>(std::move(parts)));
  }
  py::dict result;
  result["vertices"] = array_of<Row>(std::move(vertices));
  result["masters"] = array_of<Row>(std::move(masters));
  result["weights"] = array_of<double>(std::move(weights));
  result["phantoms"] = all.phantoms.size();
  result["polygons"] = polygons;
  result["polygon_triangles"] = polygon_triangles;
  return result;
}

py::dict times(const HeldCut& cut) {
  const PhaseTimes& us = cut.run.time_us;
  py::dict result;
  for (const auto& [name, value] : {std::pair{"pick", cut.pick_us},
                                    {"locate", us.locate},
                                    {"trace", us.trace},
                                    {"embed", us.embed},
                                    {"improve", us.improve},
                                    {"open", us.open},
                                    {"program", us.program}})
    result[name] = value;
  result["total"] = us.total();
  return result;
}

/// Of a result that may be broken: nothing is repaired. \return  JSON, and the drawing as SVG
std::pair<std::string, std::string> score(const SheetPointer& before, const std::vector<Curve>& curves, MeshData result,
                                          double chord_tolerance, bool keeps_vertices, bool deletes) {
  Promises asked = deletes ? find_method("element_deletion").promises : promises_of_everybody;
  asked.keeps_vertices = keeps_vertices;
  if (result.rest.empty()) take_rest_from_plane(result, "result");
  const Assessment a = assess_result(*before->sheet, result, curves, asked, options_of(chord_tolerance));
  return {score_as_json(a, before->sheet->mean_edge()), result_as_svg(*before->sheet, result, curves, a.findings)};
}

}  // namespace

void bind_cuts(py::module_& m) {
  using Released = py::call_guard<py::gil_scoped_release>;
  py::class_<HeldCut, std::shared_ptr<HeldCut>>(m, "Cut")
      .def_property_readonly("before", [](const HeldCut& c) { return std::const_pointer_cast<HeldSheet>(c.before); })
      .def_property_readonly("after", [](const HeldCut& c) { return std::const_pointer_cast<HeldSheet>(c.after); })
      .def_readonly("curves", &HeldCut::curves)
      .def_property_readonly("status", [](const HeldCut& c) { return name_of(c.run.status); })
      .def_property_readonly("reason", [](const HeldCut& c) { return c.run.reason; })
      .def_property_readonly("crossed_triangles", [](const HeldCut& c) { return c.run.crossed_triangles; })
      .def_property_readonly("method", [](const HeldCut& c) { return c.method.row.name; })
      .def("times", &times)
      .def("report", &report, Released())
      .def("constraints", &constraints)
      .def("parents", [](const HeldCut& c) {
        ParentRows p = [&] {
          const py::gil_scoped_release others_go_on;
          return parents(c);
        }();
        return py::make_tuple(array_of<Row>(std::move(p.first)), array_of<Row>(std::move(p.vertices)),
                              array_of<double>(std::move(p.weights)), array_of<Row>(std::move(p.triangles)));
      });
  m.def("lips", [](const HeldSheet& sheet) { return array_of<Row>(lips(sheet)); });
  m.def("cut", &cut, Released());
  m.def("cut_of_arrays", &cut_of_arrays);
  m.def("score",
        [](const std::shared_ptr<HeldSheet>& before, const std::vector<Curve>& curves, const Array<double>& vertices,
           const Array<Row>& triangles, const std::optional<Array<double>>& rest, double chord_tolerance,
           bool keeps_vertices, bool deletes) {
          MeshData result;
          result.deformed = rows_of<Point3>(vertices);
          result.triangles = rows_of<std::array<Row, 3>>(triangles);
          if (rest) result.rest = rows_of<Point2>(*rest);
          const py::gil_scoped_release others_go_on;
          return score(before, curves, std::move(result), chord_tolerance, keeps_vertices, deletes);
        });
}

}  // namespace cutbench::python
