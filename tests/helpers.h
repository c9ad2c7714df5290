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

#include "harness/cut/cut.h"
#include "harness/measure/oracle.h"
#include "harness/mesh/families.h"
#include "harness/mesh/mesh_io.h"
#include "harness/mesh/sheet.h"
#include "harness/run/random.h"

namespace cutbench {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// How often to repeat what is usually done n times. CUTBENCH_TEST_SCALE: `small` for a tenth of the work, for
/// sanitizers; a number k for k times as much, to hunt for failures.
inline std::size_t scaled(std::size_t n) {
  const char* text = std::getenv("CUTBENCH_TEST_SCALE");
  const std::string scale = text ? text : "1";
  return scale == "small" ? std::max<std::size_t>(1, n / 10) : n * std::stoul(scale);
}

// --- sheets
// ------------------------------------------------------------------------------------------------------------

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
  return half_edge(t, static_cast<int>(random.below(3)));
}

// --- comparison
// --------------------------------------------------------------------------------------------------------

template <class T>
bool same_bits(const T& a, const T& b) {
  return std::bit_cast<std::array<std::uint64_t, sizeof(T) / 8>>(a) ==
         std::bit_cast<std::array<std::uint64_t, sizeof(T) / 8>>(b);
}

/// The first difference between two sheets, looked at through all that the public interface shows; empty: none.
inline std::string difference(const Sheet& a, const Sheet& b) {
  if (a.triangle_slots() != b.triangle_slots() || a.triangle_count() != b.triangle_count()) return "triangle count";
  if (a.vertex_slots() != b.vertex_slots() || a.vertex_count() != b.vertex_count()) return "vertex count";
  if (a.deformed_slots() != b.deformed_slots() || a.deformed_count() != b.deformed_count()) return "deformed count";
  for (std::size_t i = 0; i < a.triangle_slots(); ++i) {
    const Triangle &t = a.triangle(TriangleIndex(i)), &u = b.triangle(TriangleIndex(i));
    const std::string name = " of triangle " + std::to_string(i);
    if (t.alive() != u.alive()) return "life" + name;
    if (!t.alive()) continue;
    if (t.vertex != u.vertex) return "vertices" + name;
    if (t.opposite != u.opposite) return "neighbours" + name;
    if (t.deformed != u.deformed) return "deformed vertices" + name;
    if (t.mark != u.mark) return "marks" + name;
  }
  for (std::size_t i = 0; i < a.vertex_slots(); ++i) {
    const VertexIndex v(i);
    if (a.triangle_of_vertex(v) != b.triangle_of_vertex(v)) return "triangle of vertex " + std::to_string(i);
    if (a.triangle_of_vertex(v).valid() && !same_bits(a.rest(v), b.rest(v))) return "rest vertex " + std::to_string(i);
  }
  for (std::size_t i = 0; i < a.deformed_slots(); ++i) {
    const DeformedIndex d(i);
    if (a.rest_vertex(d) != b.rest_vertex(d)) return "rest vertex of deformed vertex " + std::to_string(i);
    if (a.rest_vertex(d).valid() && !same_bits(a.position(d), b.position(d))) return "position " + std::to_string(i);
  }
  return a.mean_edge() == b.mean_edge() && a.size() == b.size() && a.snap() == b.snap() ? "" : "size";
}

/// What check() found, in one line; empty: nothing.
inline std::string faults(const Sheet& sheet, bool opened = true) {
  std::string all;
  for (const std::string& fault : check(sheet, opened)) all += (all.empty() ? "" : "; ") + fault;
  return all.substr(0, 500);
}

// --- one cut
// -----------------------------------------------------------------------------------------------------------

inline oracle::Mesh for_oracle(const MeshData& mesh) {
  oracle::Mesh result;
  for (Point2 p : mesh.rest) result.rest.push_back({p.x, p.y});
  for (const auto& [a, b, c] : mesh.triangles) result.triangles.push_back({a, b, c});
  return result;
}

inline oracle::Curve for_oracle(const Curve& curve) {
  oracle::Curve result{curve.kind == Curve::Kind::bezier, curve.closed, {}};
  for (Point2 p : curve.points) result.points.push_back({p.x, p.y});
  return result;
}

/// Passes everything on to a method, and notes whether improve() made vertices.
class Watched : public CuttingMethod {
 public:
  explicit Watched(std::unique_ptr<CuttingMethod> method) : method_(std::move(method)) {}
  std::optional<std::string> why_unsupported(const Sheet& sheet) const override {
    return method_->why_unsupported(sheet);
  }
  void embed(Sheet& sheet, Subdivision& trace) override { method_->embed(sheet, trace); }
  void improve(Sheet& sheet) override {
    const std::size_t before = sheet.log().new_vertices.size();
    method_->improve(sheet);
    improved = sheet.log().new_vertices.size() > before;
  }
  int recovered_segments() const override { return method_->recovered_segments(); }

  bool improved = false;

 private:
  std::unique_ptr<CuttingMethod> method_;
};

/// A sheet under the knife of one method.
class Table {
 public:
  Table(const MeshData& mesh, const MethodRow& row, double knob)
      : sheet(mesh), locator_(sheet), promises_(row.promises), method_(row.make(knob)) {}

  /// Cuts, and returns what is wrong with the outcome, by the sheet's own check and by the oracle; empty: nothing.
  std::string cut(const Curve& curve, double chord_tolerance) {
    const Sheet before = sheet;
    const CutOptions options{.flatten_tolerance = flatten_tolerance, .chord_tolerance = chord_tolerance};
    outcome = cutter_.cut(sheet, locator_, curve, method_, options);
    const double snap = std::max(2 * sheet.snap(), 2 * outcome.deviation);
    const double flattening = curve.kind == Curve::Kind::bezier ? options.flatten_tolerance * sheet.mean_edge() : 0;
    oracle::Request request{.before = for_oracle(before.to_mesh_data()),
                            .cuts = {for_oracle(curve)},
                            .tolerance = chord_tolerance * sheet.mean_edge() + flattening + snap,
                            .snap = snap,
                            .keeps_vertices = promises_.keeps_vertices,
                            .exact_incision = promises_.exact_incision,
                            .vertex_tolerance = flattening + snap};
    if (method_.improved) request.vertex_tolerance = request.tolerance;  // it may split chords of the path
    if (outcome.status == Status::noop) {                                // justified where the path opens nothing
      if (const std::string what = difference(before, sheet); !what.empty()) return "noop, but changed: " + what;
      request.tolerance = flattening + 2 * snap;
    } else if (outcome.status != Status::ok && outcome.status != Status::deviated) {
      return std::string(name_of(outcome.status)) + ", " + outcome.verdict + ": " + outcome.reason;
    }
    if (const std::string what = faults(sheet); !what.empty()) return "check: " + what;
    const oracle::Judgement judgement = oracle::judge(request, for_oracle(sheet.to_mesh_data()));
    pieces = judgement.pieces, incision_error = judgement.incision_error;
    if (judgement.ok) return {};
    return (outcome.status == Status::noop ? "noop, but " : "oracle: ") + judgement.problems.front();
  }

  Sheet sheet;
  double flatten_tolerance = CutOptions().flatten_tolerance;
  CutOutcome outcome;
  int pieces = 0;             // of the last cut that was judged
  double incision_error = 0;  // likewise

 private:
  Locator locator_;
  Promises promises_;
  Watched method_;
  Cutter cutter_;
};

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
