// The cross-check must be right where cuts are ordinary: else the robustness run would show its mistakes as CGAL's.

#include "harness/study/robustness/cgal_check.h"

#include <gtest/gtest.h>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/judge/oracle_request.h"
#include "harness/mesh/families.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

constexpr double flattening = 1e-5;  // of the unit square

/// Cuts with the cross-check and returns what the oracle finds wrong; empty: nothing.
std::string cut(oracle::Mesh& mesh, const oracle::Curve& curve, int* pieces = nullptr) {
  const oracle::CrossCheckResult result = oracle::cgal_whole_sheet_cut(mesh, curve, flattening);
  if (result.refused) return "refused: " + result.reason;
  const double tolerance = curve.bezier ? flattening : 1e-14;  // paths begin several sheets away
  // Its crossings are rounded to the length of the path.
  const oracle::Request request{
      .before = mesh, .cuts = {curve}, .tolerance = tolerance, .snap = 1e-14, .vertex_tolerance = tolerance};
  const oracle::Judgement judgement = oracle::judge(request, result.mesh);
  if (pieces) *pieces = judgement.pieces;
  mesh = result.mesh;
  return judgement.ok ? "" : judgement.problems.front();
}

bool same(const oracle::Mesh& a, const oracle::Mesh& b) { return a.rest == b.rest && a.triangles == b.triangles; }

class CgalCheck : public testing::TestWithParam<const char*> {};

TEST_P(CgalCheck, IsRightInEveryFamilyOfCuts) {
  std::size_t cuts = 0;
  for (std::size_t i = 0; i < scaled(3); ++i)
    for (const auto& [name, data] : test_meshes(8)) {
      oracle::Mesh mesh = for_oracle(data);
      std::size_t k = 0;
      for (const Curve& curve : make_case(GetParam(), 1, i, Sheet(data))) {
        ++cuts;
        const std::string what = cut(mesh, for_oracle(curve));
        ASSERT_EQ(what, "") << name << ", case " << i << ", cut " << k << ": " << text_of(curve);
        ++k;
      }
    }
  RecordProperty("cuts", to_int(cuts));
}

INSTANTIATE_TEST_SUITE_P(Families, CgalCheck, testing::ValuesIn(cut_families().begin(), cut_families().end()),
                         [](const auto& parameter) { return std::string(parameter.param); });

TEST(CgalCheckTest, CrossingCutsAndLoops) {
  oracle::Mesh mesh = for_oracle(make_sheet("delaunay", 8));
  int pieces = 0;
  EXPECT_EQ(cut(mesh, {false, false, {{-0.1, 0.41}, {1.1, 0.52}}}, &pieces), "");
  EXPECT_EQ(pieces, 2);
  EXPECT_EQ(cut(mesh, {false, false, {{0.3, -0.1}, {0.37, 1.1}}}, &pieces), "");
  EXPECT_EQ(pieces, 4);
  EXPECT_EQ(cut(mesh, {false, true, {{0.2, 0.2}, {0.8, 0.25}, {0.7, 0.7}}}, &pieces), "");
  EXPECT_EQ(pieces, 8);  // the loop leaves a corner between the two cuts to itself
  EXPECT_EQ(cut(mesh, {true, true, {{0.51, 0.1}, {0.7, 0.1}, {0.6, 0.2}, {0.51, 0.1}}}, &pieces), "");
  EXPECT_EQ(pieces, 9);
}

TEST(CgalCheckTest, HolesStayHoles) {
  oracle::Mesh mesh = for_oracle(read_mesh(CUTBENCH_TEST_CASES "/meshes/mfem_square-disc.off"));
  oracle::Point middle{0, 0};
  for (const auto& [x, y] : mesh.rest) {
    middle[0] += x / to_double(mesh.rest.size());
    middle[1] += y / to_double(mesh.rest.size());
  }
  int pieces = 0;
  EXPECT_EQ(
      cut(mesh, {false, false, {{middle[0] - 0.8, middle[1] - 0.1}, {middle[0] + 0.8, middle[1] + 0.1}}}, &pieces), "");
  EXPECT_EQ(pieces, 2);
}

TEST(CgalCheckTest, ChangesNothingWhereNothingOpens) {
  oracle::Mesh mesh = for_oracle(make_sheet("graded", 6));
  const oracle::Curve across{false, false, {{-0.1, 0.41}, {1.1, 0.52}}};
  ASSERT_EQ(cut(mesh, across), "");
  for (const oracle::Curve& curve : {oracle::Curve{false, false, {{-0.5, 1.5}, {1.5, 1.25}}},  // outside
                                     oracle::Curve{false, false, {{-0.5, 0}, {1.5, 0}}},       // along the border
                                     oracle::Curve{false, false, {{0.3, 0.3}, {0.3, 0.3}}},    // no length
                                     across}) {
    const oracle::CrossCheckResult result = oracle::cgal_whole_sheet_cut(mesh, curve, flattening);
    EXPECT_FALSE(result.refused);
    EXPECT_TRUE(same(result.mesh, mesh)) << curve.points[0][0] << " " << curve.points[0][1];
  }
}

TEST(CgalCheckTest, OpensASlitOfOneEdge) {
  oracle::Mesh mesh = for_oracle(make_sheet("grid", 4));
  EXPECT_EQ(cut(mesh, {false, false, {{0.3, 0.27}, {0.4, 0.3}}}), "");
  EXPECT_EQ(cut(mesh, {false, false, {{0.6, 0.6}, {0.9, 0.85}, {0.6, 0.6}}}), "");
}

TEST(CgalCheckTest, SaysHowFarItMovedAConstraint) {
  const oracle::Mesh mesh = for_oracle(make_sheet("grid", 4));
  EXPECT_LT(oracle::cgal_whole_sheet_cut(mesh, {false, false, {{-0.1, 0.41}, {1.1, 0.52}}}, flattening).moved, 1e-15);
}

}  // namespace
}  // namespace cutbench
