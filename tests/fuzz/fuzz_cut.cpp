// libFuzzer target: bytes -> a mesh file and a path file -> every method. Whatever the bytes, the readers throw
// InputError or each cut passes JudgedSheet; anything else, and all that a sanitizer finds, ends the program.
//
// An input is the text of a mesh (OFF, PLY or OBJ) and after it that of a path; the first '{' begins the path.
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "harness/files/mesh_file.h"
#include "harness/files/path_file.h"
#include "harness/judge/judged_sheet.h"
#include "harness/mesh/predicates.h"
#include "methods/registry.h"

namespace cutbench {
namespace {

// One input shouldn't take longer than a second or so.
constexpr std::size_t most_triangles = 200, most_cuts = 5, most_points = 40;
constexpr double farthest = 4;  ///< a Bezier may reach out of the sheet, in sizes of it

/// Readers take file names: a folder in memory, where there is one, that goes when the program ends.
struct Folder {
  std::filesystem::path path = (std::filesystem::is_directory("/dev/shm") ? std::filesystem::path("/dev/shm")
                                                                          : std::filesystem::temp_directory_path()) /
                               ("cutbench_fuzz_" + std::to_string(getpid()));
  Folder() { std::filesystem::create_directory(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path); }

  std::filesystem::path write(const std::string& name, std::string_view text) const {
    std::ofstream(path / name, std::ios::binary) << text;
    return path / name;
  }
};

std::size_t point_count(const std::vector<Curve>& cuts) {
  std::size_t count = 0;
  for (const Curve& curve : cuts) count += curve.points.size();
  return count;
}

/// Flattening it would take a million points.
bool reaches_far(const Curve& curve, const Sheet& sheet) {
  const Point2 centre = sheet.rest(VertexIndex(0));
  return curve.kind == Curve::Kind::bezier && std::any_of(curve.points.begin(), curve.points.end(), [&](Point2 p) {
           return std::abs(p.x - centre.x) > farthest * sheet.size() ||
                  std::abs(p.y - centre.y) > farthest * sheet.size();
         });
}

using Corners = std::array<Point2, 3>;

/// An edge of `a` has all of `b` on its right or on its line.
bool is_beside(const Corners& a, const Corners& b) {
  for (std::size_t i = 0; i < 3; ++i)
    if (std::all_of(b.begin(), b.end(), [&](Point2 p) { return orientation(a[i], a[(i + 1) % 3], p) <= 0; }))
      return true;
  return false;
}

/// Readers don't look for triangles that overlap without sharing an edge, and the oracle can't judge them.
bool overlaps_itself(const Sheet& sheet) {
  std::vector<Corners> triangles;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) triangles.push_back(sheet.corners(TriangleIndex(t)));
  for (std::size_t i = 0; i < triangles.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (!is_beside(triangles[i], triangles[k]) && !is_beside(triangles[k], triangles[i])) return true;
  return false;
}

void end_unless(bool right, const std::string& what) {
  if (right) return;
  std::cerr << "fuzz_cut: " << what << '\n';
  std::abort();
}

void cut_unjudged(const Sheet& uncut, const std::vector<Curve>& cuts, const MethodRow& row) {
  Sheet sheet = uncut;
  Locator locator(sheet);
  Cutter cutter;
  const auto method = row.make(row.parameter.value);
  for (const Curve& curve : cuts) {
    cutter.cut(sheet, locator, curve, *method, {});
    end_unless(check(sheet).empty(), row.name + ": check() finds faults");
  }
}

void cut_judged(const Sheet& sheet, const std::vector<Curve>& cuts, const MethodRow& row) {
  JudgedSheet judged(sheet, row.promises, row.make(row.parameter.value));
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const auto finding = judged.cut(cuts[i], {});
    end_unless(finding.ok(),
               row.name + ", cut " + std::to_string(i) + ": " + name_of(finding.verdict) + ": " + finding.reason);
  }
}

void cut_by_every_method(const Sheet& sheet, const std::vector<Curve>& cuts) {
  if (std::any_of(cuts.begin(), cuts.end(), [&](const Curve& curve) { return reaches_far(curve, sheet); })) return;
  const bool can_be_judged = std::getenv("CUTBENCH_FUZZ_JUDGE") && sheet.size() > 1e-140 && !overlaps_itself(sheet);
  for (const MethodRow& row : all_methods()) (can_be_judged ? cut_judged : cut_unjudged)(sheet, cuts, row);
}

/// By how its text begins.
std::string mesh_file_name(std::string_view text) {
  return text.starts_with("ply") ? "mesh.ply" : text.starts_with("OFF") ? "mesh.off" : "mesh.obj";
}

}  // namespace
}  // namespace cutbench

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace cutbench;
  static const Folder folder;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::string_view mesh_text = text.substr(0, text.find('{'));
  try {
    const auto path = folder.write("path.json", text.substr(mesh_text.size()));
    const auto mesh = folder.write(mesh_file_name(mesh_text), mesh_text);
    const std::vector<Curve> cuts = read_path(path);
    const MeshData sheet = read_mesh(mesh);
    if (sheet.triangles.size() <= most_triangles && cuts.size() <= most_cuts && point_count(cuts) <= most_points)
      cut_by_every_method(Sheet(sheet), cuts);
  } catch (const InputError&) {  // what bad input must end in
  }
  return 0;
}
