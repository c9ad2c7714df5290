// What tests of sheets and cuts share: sheets to cut, bit-exact comparison, and one cut with everything that must hold.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/base/random.h"
#include "harness/cut/cut.h"
#include "harness/files/mesh_file.h"
#include "harness/files/whole_file.h"
#include "harness/judge/judged_sheet.h"
#include "harness/judge/oracle_request.h"
#include "harness/judge/same_sheet.h"
#include "harness/mesh/families.h"
#include "harness/mesh/sheet.h"
#include "methods/registry.h"

namespace cutbench {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// How often to repeat what is usually done n times. CUTBENCH_TEST_SCALE: `small` for a tenth of the work, for
/// sanitizers; a number k for k times as much, to hunt for failures.
inline std::size_t scaled(std::size_t n) {
  const char* text = std::getenv("CUTBENCH_TEST_SCALE");
  const std::string scale = text ? text : "1";
  return scale == "small" ? std::max<std::size_t>(1, n / 10) : n * std::stoul(scale);
}

// --- sheets ----------------------------------------------------------------------------------------------------------

inline bool is_small_scale() { return scaled(10) == 1; }

/// All families; under sanitizers, where a dense matrix costs a hundred times as much, one of them, another each time.
inline std::vector<std::string> families_in_turn(std::size_t& turn) {
  const auto all = sheet_families();
  if (!is_small_scale()) return {all.begin(), all.end()};
  return {all[turn++ % all.size()]};
}

struct NamedMesh {
  std::string name;
  MeshData mesh;
};

/// The families at n squares a side, and every mesh in tests/cases/meshes.
inline std::vector<NamedMesh> test_meshes(int n) {
  std::vector<NamedMesh> meshes;
  for (const std::string family : sheet_families())
    meshes.push_back({family + std::to_string(n), make_sheet(family, n)});
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(CUTBENCH_TEST_CASES "/meshes"))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  for (const auto& file : files) meshes.push_back({file.stem().string(), read_mesh(file)});
  return meshes;
}

/// The sheet bent in space, by a map that is neither linear nor isometric.
inline MeshData lifted(MeshData mesh) {
  for (std::size_t v = 0; v < mesh.rest.size(); ++v) {
    const auto [x, y] = mesh.rest[v];
    mesh.deformed[v] = {1.1 * x + 0.1 * std::sin(2 * y), y - 0.05 * x * y, 0.3 * std::sin(3 * x) * std::cos(2 * y)};
  }
  return mesh;
}

inline double area_of(const std::array<Point3, 3>& c) {
  const Point3 u = c[1] + -1 * c[0], v = c[2] + -1 * c[0];
  return std::sqrt(std::pow(u.y * v.z - u.z * v.y, 2) + std::pow(u.z * v.x - u.x * v.z, 2) +
                   std::pow(u.x * v.y - u.y * v.x, 2)) /
         2;
}

/// Of the deformed surface.
inline double surface_area(const Sheet& sheet) {
  double area = 0;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
    const Triangle& triangle = sheet.triangle(TriangleIndex(t));
    if (!triangle.alive()) continue;
    const auto& d = triangle.deformed;
    area += area_of({sheet.position(d[0]), sheet.position(d[1]), sheet.position(d[2])});
  }
  return area;
}

inline TriangleIndex any_triangle(const Sheet& sheet, Random& random) {
  for (;;)
    if (const TriangleIndex t(random.below(sheet.triangle_slots())); sheet.triangle(t).alive()) return t;
}

inline HalfEdge any_half_edge(const Sheet& sheet, Random& random) {
  const TriangleIndex t = any_triangle(sheet, random);
  return half_edge(t, to_int(random.below(3)));
}

// --- comparison ------------------------------------------------------------------------------------------------------

/// What check() found, in one line; empty: nothing.
inline std::string faults(const Sheet& sheet, bool opened = true) {
  std::string all;
  for (const std::string& fault : check(sheet, opened)) all += (all.empty() ? "" : "; ") + fault;
  return all.substr(0, 500);
}

// --- one cut ---------------------------------------------------------------------------------------------------------

inline oracle::Mesh for_oracle(const MeshData& mesh) {
  oracle::Mesh result;
  for (Point2 p : mesh.rest) result.rest.push_back({p.x, p.y});
  for (const auto& [a, b, c] : mesh.triangles) result.triangles.push_back({a, b, c});
  return result;
}

/// A sheet under the knife of one method, which is expected to make every cut.
class Table : public JudgedSheet {
 public:
  Table(const MeshData& mesh, const MethodRow& row, double parameter)
      : JudgedSheet(Sheet(mesh), row.promises, row.make(parameter)), may_delete_(!row.promises.keeps_area) {}

  /// Cuts, and returns what is wrong with the outcome; empty: nothing. A sheet that the method doesn't support must be
  /// refused; one that takes triangles out may refuse to take all.
  std::string cut(const Curve& curve, double chord_tolerance) {
    const bool refuses = why_unsupported().has_value();
    const Finding finding =
        JudgedSheet::cut(curve, CutOptions{.flatten_tolerance = flatten_tolerance, .chord_tolerance = chord_tolerance});
    if (!finding.ok()) return std::string(name_of(finding.verdict)) + ": " + finding.reason;
    const bool done = outcome.status == Status::ok || outcome.status == Status::noop;
    if (refuses ? outcome.status == Status::refused : done) return {};
    if (may_delete_ && outcome.status == Status::refused) return {};
    return std::string(name_of(outcome.status)) + ", " + name_of(outcome.verdict) + ": " + outcome.reason;
  }

  double flatten_tolerance = CutOptions().flatten_tolerance;

 private:
  bool may_delete_;
};

/// The methods that cut any sheet and leave all of it: what pieces, places and mechanics of any sheet can be asked of.
/// Not those that refuse sheets (cisamr) or take triangles out (element_deletion).
inline const std::vector<MethodRow>& whole_sheet_methods() {
  static const std::vector<MethodRow> rows = [] {
    const Sheet irregular(make_sheet("delaunay", 4));
    std::vector<MethodRow> some;
    for (const MethodRow& row : all_methods())
      if (row.promises.keeps_area && !row.make(row.parameter.value)->why_unsupported(irregular)) some.push_back(row);
    return some;
  }();
  return rows;
}

inline std::string text_of(const Curve& curve) {
  std::string text = curve.kind == Curve::Kind::bezier ? "bezier" : "polyline";
  if (curve.closed) text += " closed";
  char number[64];
  for (Point2 p : curve.points) {
    std::snprintf(number, sizeof number, " {%.17g, %.17g}", p.x, p.y);
    text += number;
  }
  return text;
}

}  // namespace cutbench
