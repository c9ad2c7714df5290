// Paths that begin, end or turn on vertices of a net of seams, and what a file keeps of such cuts.
#include <gtest/gtest.h>

#include "harness/base/random.h"
#include "harness/cut/cut_all.h"
#include "harness/judge/assessment.h"
#include "harness/judge/judged_sheet.h"
#include "harness/mesh/mesh_text.h"
#include "harness/path/clear_of_seams.h"
#include "methods/registry.h"
#include "tests/helpers.h"
#include "tests/sewn_sheets.h"

namespace cutbench {
namespace {

using Path = std::vector<AnyCurve>;

Path through(std::initializer_list<Point3> places) {
  PickedCurve curve{Curve::Kind::polyline, false, {}};
  for (const Point3& p : places) curve.picks.push_back({p, {}});
  return {curve};
}

/// Cut in place; the verdict is that of `score` on the file that is written. \return  points that were added
std::size_t cut_and_score(MeshData& mesh, const Path& path, const std::string& name) {
  clear_of_seams(mesh, "mesh", path, "path");
  const Sheet before(mesh);
  const std::vector<Curve> curves = curves_at_rest(path, before, "path").curves;
  const MethodRow row = find_method(name);
  const auto method = row.make(row.parameter.value);
  Sheet sheet = before;
  Locator locator(sheet);
  Cutter cutter;
  const CutRun run = cut_all(sheet, locator, cutter, curves, *method, {});
  if (run.status == Status::noop) return 0;  // along the border, or an older incision
  EXPECT_TRUE(run.status == Status::ok || run.status == Status::deviated) << run.reason;
  const std::string text = obj_text(sheet.to_mesh_data());
  const Assessment a =
      assess_result(before, read_obj(text, "result", true, {RestFrom::vt}), curves, promises_of_everybody, {});
  EXPECT_TRUE(a.judgement.ok) << name << ": " << a.judgement.problems.front();
  const std::size_t pieces = count_pieces(sheet);
  mesh = read_obj(text, "result");
  check_and_repair(mesh, "result");
  EXPECT_EQ(count_pieces(Sheet(mesh)), pieces) << name;
  EXPECT_EQ(a.judgement.pieces, to_int(pieces));
  return points_in_space(sheet) - points_in_space(before);
}

std::vector<MeshData> curved() {
  const MeshData dome = surface(7, 6, false, [](double u, double v) {
    return Point3{u, v, 0.4 * std::sin(4 * u) * std::sin(3 * v)};
  });
  return {tube(8, 4, 2), cone(8, 4), dome, sphere(2), torus(8, 5)};
}

TEST(SeamTips, OneEdgeOpens) {
  Random random(7);
  for (const MeshData& raw : curved())
    for (std::size_t i = 0; i < scaled(10); ++i) {
      const auto& t = raw.triangles[random.below(raw.triangles.size())];
      const std::size_t k = random.below(3);
      const Point3 a = raw.deformed[to_size(t[k])], b = raw.deformed[to_size(t[(k + 1) % 3])];
      const Point3 c = raw.deformed[to_size(t[(k + 2) % 3])];
      const Point3 middle = (1.0 / 3) * (a + b + c);
      MeshData mesh = unrolled(raw);
      EXPECT_GT(cut_and_score(mesh, through({a, middle}), "conventional_split"), 1u);
      const auto uses = std::count_if(raw.triangles.begin(), raw.triangles.end(), [&](const auto& other) {
        return std::count(other.begin(), other.end(), t[k]) + std::count(other.begin(), other.end(), t[(k + 1) % 3]) ==
               2;
      });
      if (uses < 2) continue;  // on the border
      mesh = unrolled(raw);
      EXPECT_GT(cut_and_score(mesh, through({a, b}), "conventional_split"), 0u);
    }
}

/// Between places on edges, which may be seams, and on vertices. Then between two places in triangles of the file.
TEST(SeamTips, CutsFromSeamToSeamAndAgain) {
  Random random(8);
  for (const MeshData& raw : curved())
    for (const char* method : {"conventional_split", "warp_and_refine", "cut_polygons"})
      for (std::size_t i = 0; i < scaled(6); ++i) {
        MeshData mesh = unrolled(raw);
        const auto place = [&](double third) {
          const auto& t = mesh.triangles[random.below(mesh.triangles.size())];
          const std::size_t k = random.below(3);
          const double share = std::min(1.0, 1.5 * random.unit());  // a third of them on vertices
          const auto corner = [&](std::size_t c) { return mesh.deformed[to_size(t[(k + c) % 3])]; };
          return (1 - third) * ((1 - share) * corner(0) + share * corner(1)) + third * corner(2);
        };
        cut_and_score(mesh, through({place(0), place(0)}), method);
        cut_and_score(mesh, through({place(0.3), place(0.3)}), "conventional_split");
      }
}

}  // namespace
}  // namespace cutbench
