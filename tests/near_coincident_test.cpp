// A cut, the same cut shifted by eps, and a third across both: where constrained triangulations lose their constraints.
// Every method, with CGAL's whole-sheet triangulation beside them in the table that experiments/near_coincident prints.

#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "harness/judge/oracle_request.h"
#include "harness/mesh/families.h"
#include "harness/mesh/tolerances.h"
#include "harness/study/robustness/cgal_check.h"
#include "methods/registry.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

/// Of all cuts by one method at one eps.
struct Row {
  std::size_t tried = 0;
  std::map<std::string, std::size_t> outcomes;  ///< status, or `wrong` where the oracle says so
  double incision_error = 0;                    ///< largest, in sides of the square
  double moved = 0;                             ///< what the cross-check says about itself
  std::string problem;                          ///< the first
};

/// The three cuts of case i; those of all eps are the same but for the shift.
std::array<Curve, 3> cuts_of_case(std::size_t i, double eps) {
  Random random(20180507 + i);
  const auto anywhere = [&] { return Point2{random.between(-0.2, 1.2), random.between(-0.2, 1.2)}; };
  const auto inside = [](Point2 p) { return std::min(p.x, p.y) > 0.1 && std::max(p.x, p.y) < 0.9; };
  Point2 a = anywhere(), b = anywhere();
  while (squared_length(b - a) < 0.1 || !inside(0.5 * a + 0.5 * b)) {
    a = anywhere();
    b = anywhere();
  }
  const Point2 along = 1 / std::sqrt(squared_length(b - a)) * (b - a);
  Point2 across = random.direction();
  while (std::abs(dot(across, along)) > 0.9) across = random.direction();
  const Point2 middle = a + random.between(0.4, 0.6) * (b - a);
  const Point2 shift = (random.coin() ? eps : -eps) * Point2{-along.y, along.x};
  const Point2 far = middle + random.between(0.2, 0.8) * across;
  const Point2 near = middle - random.between(0.2, 0.8) * across;
  const auto line = [](Point2 p, Point2 q) { return Curve{Curve::Kind::polyline, false, {p, q}}; };
  return {line(a, b), line(a + shift, b + shift), line(near, far)};
}

void cut_by_method(const MeshData& mesh, const MethodRow& method, const std::array<Curve, 3>& cuts, Row& row) {
  Table table(mesh, method, method.parameter.value);
  for (const Curve& curve : cuts) {
    const std::string what = table.cut(curve, 0);
    const Status status = table.outcome.status;
    const bool changed = status != Status::refused && status != Status::failed;
    const bool wrong = changed && !what.empty();
    ++row.tried;
    ++row.outcomes[wrong ? "wrong" : name_of(status)];
    if (changed) row.incision_error = std::max(row.incision_error, table.judgement.incision_error);
    if (!what.empty() && row.problem.empty()) row.problem = what + "; " + text_of(curve);
    if (wrong) return;
  }
}

/// Judged with the slack of the methods' declared snapping, though it snaps nothing.
void cut_by_cross_check(const MeshData& data, const std::array<Curve, 3>& cuts, Row& row) {
  const double snap = line_tolerance * Sheet(data).snap();
  oracle::Mesh mesh = for_oracle(data);
  for (const Curve& curve : cuts) {
    const oracle::CrossCheckResult result = oracle::cgal_whole_sheet_cut(mesh, for_oracle(curve), snap);
    const oracle::Request request{
        .before = mesh, .cuts = {for_oracle(curve)}, .tolerance = 2 * snap, .snap = snap, .vertex_tolerance = snap};
    const oracle::Judgement judgement = oracle::judge(request, result.mesh);
    const bool noop = result.mesh.triangles == mesh.triangles;
    ++row.tried;
    ++row.outcomes[result.refused ? "refused" : !judgement.ok ? "wrong" : noop ? "noop" : "ok"];
    row.moved = std::max(row.moved, result.moved);
    if (!result.refused) row.incision_error = std::max(row.incision_error, judgement.incision_error);
    if (!judgement.ok && row.problem.empty()) row.problem = judgement.problems.front() + "; " + text_of(curve);
    if (!judgement.ok && !result.refused) return;
    mesh = result.mesh;
  }
}

void print(std::FILE* out, double eps, const std::string& name, const Row& row) {
  std::fprintf(out, "%-7.0e %-20s %6zu", eps, name.c_str(), row.tried);
  for (const char* outcome : {"ok", "noop", "deviated", "refused", "failed", "wrong"}) {
    const auto found = row.outcomes.find(outcome);
    std::fprintf(out, " %8zu", found == row.outcomes.end() ? 0 : found->second);
  }
  std::fprintf(out, "  %14.2g", row.incision_error);
  if (name == "cross_check") std::fprintf(out, "  %15.2g", row.moved);
  std::fprintf(out, "\n");
}

TEST(NearCoincident, ACutItsShadowAndAThirdAcross) {
  const char* path = std::getenv("CUTBENCH_NEAR_COINCIDENT_TABLE");
  std::FILE* out = path ? std::fopen(path, "w") : stdout;
  ASSERT_NE(out, nullptr) << path;
  const std::size_t cases = scaled(12);
  std::fprintf(out,
               "A cut of the unit square (128 triangles, all families), the same cut shifted by eps, a third across "
               "both: %zu cases an eps\ncross_check: CGAL's constrained triangulation of the whole sheet\n\n"
               "eps     method                tried       ok     noop deviated  refused   failed    wrong  "
               "incision error  constraint moved\n",
               cases);
  std::vector<MeshData> meshes;
  for (const char* family : sheet_families()) meshes.push_back(make_sheet(family, 8));
  const double promised = line_tolerance * Sheet(meshes.front()).snap() + 8 * std::numeric_limits<double>::epsilon();
  for (int k = 2; k <= 18; ++k) {
    const double eps = k == 18 ? 0 : std::pow(10.0, -k);
    for (const MethodRow& method : whole_sheet_methods()) {
      Row row;
      for (std::size_t i = 0; i < cases; ++i)
        cut_by_method(meshes[i % meshes.size()], method, cuts_of_case(i, eps), row);
      print(out, eps, method.name, row);
      EXPECT_EQ(row.outcomes["ok"] + row.outcomes["noop"], row.tried)
          << method.name << ", " << eps << ": " << row.problem;
      if (method.promises.exact_incision) {
        EXPECT_LE(row.incision_error, promised) << method.name << ", " << eps;
      }
    }
    Row row;
    for (std::size_t i = 0; i < cases; ++i) cut_by_cross_check(meshes[i % meshes.size()], cuts_of_case(i, eps), row);
    print(out, eps, "cross_check", row);
  }
  if (path) std::fclose(out);
}

/// Found with more cases than the test above has, each by another method.
TEST(NearCoincident, TenTimesTheSnapDistanceApart) {
  const auto families = sheet_families();
  for (std::size_t i : {21, 26, 208})
    for (const MethodRow& method : whole_sheet_methods()) {
      Row row;
      cut_by_method(make_sheet(families[i % families.size()], 8), method, cuts_of_case(i, 1e-11), row);
      EXPECT_EQ(row.problem, "") << method.name << ", case " << i;
    }
}

}  // namespace
}  // namespace cutbench
