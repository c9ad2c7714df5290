// The mesh fitted to a cut, with which errors are compared.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "harness/base/conversions.h"
#include "tests/truth_helpers.h"

namespace cutbench {
namespace {

TEST(BodyFitted, IsACutSheetOfTheSameSize) {
  for (const auto& problem : all_problems()) {
    if (problem->name() == "two_cuts_one_geometry" || !problem->takes_budgets()) continue;
    SCOPED_TRACE(problem->name());
    const Specimen specimen = problem->specimen("grid", 30, 1, 1);
    const Sheet sheet = body_fitted(specimen), cut = cut_by(specimen, "conventional_split");
    EXPECT_TRUE(check(sheet).empty());
    EXPECT_EQ(count_pieces(sheet), count_pieces(cut));
    const auto wanted = to_double(specimen.mesh.triangles.size());
    EXPECT_NEAR(to_double(sheet.triangle_count()), wanted, 0.03 * wanted);
    double length = 0, length_cut = 0, area = 0, area_cut = 0, longest = 0;
    const auto measure = [&](const Sheet& of, double& edges, double& total) {
      for (std::size_t t = 0; t < of.triangle_slots(); ++t) {
        if (!of.triangle(TriangleIndex(t)).alive()) continue;
        const auto c = of.corners(TriangleIndex(t));
        total += cross(c[1] - c[0], c[2] - c[0]) / 2;
        for (std::size_t k = 0; k < 3; ++k) {
          const double edge = std::sqrt(squared_length(c[(k + 1) % 3] - c[k]));
          if (of.mark(half_edge(TriangleIndex(t), to_int(k))) == EdgeMark::incision) edges += edge / 2;
          if (&of == &sheet) longest = std::max(longest, edge);
        }
      }
    };
    measure(sheet, length, area);
    measure(cut, length_cut, area_cut);
    const bool slender = problem->name() == "elliptic_hole_3";  // its edges are chords of tight bends
    EXPECT_NEAR(length, length_cut, (slender ? 5e-3 : 2e-3) * length_cut);
    EXPECT_NEAR(area, area_cut, 1e-10);
    EXPECT_LE(longest, 2 * sheet.mean_edge());  // an even size
  }
}

TEST(BodyFitted, IsGradedAtTipsWithAsManyTriangles) {
  for (const std::string name : {"centre_crack", "arc_crack_45", "crossed_cracks", "corner_270"}) {
    SCOPED_TRACE(name);
    const Problem& problem = find_problem(name);
    const Specimen specimen = problem.specimen("grid", 30, 1, 1);
    const Sheet sheet = graded_at_tips(specimen), even = body_fitted(specimen);
    EXPECT_TRUE(check(sheet).empty());
    EXPECT_EQ(count_pieces(sheet), count_pieces(even));
    const auto wanted = to_double(specimen.mesh.triangles.size());
    EXPECT_NEAR(to_double(sheet.triangle_count()), wanted, 0.05 * wanted);
    double least = 1e300;
    for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto c = sheet.corners(TriangleIndex(t));
        least = std::min(least, std::sqrt(squared_length(c[(k + 1) % 3] - c[k])));
      }
    EXPECT_LT(least, 0.1 * even.mean_edge());
  }
  const Specimen hole = find_problem("kirsch_hole").specimen("grid", 12, 1, 1);
  EXPECT_EQ(graded_at_tips(hole).to_mesh_data().rest, body_fitted(hole).to_mesh_data().rest);
}

/// Whatever else the process has done: the addresses of a mesher's triangles must not be in the result.
TEST(BodyFitted, IsTheSameWhereverTheMemoryIs) {
  const Specimen specimen = find_problem("arc_crack_45").specimen("grid", 30, 1, 1);
  const std::vector<Point2> first = body_fitted(specimen).to_mesh_data().rest;
  std::vector<std::unique_ptr<std::vector<char>>> blocks;
  for (std::size_t i = 0; i < 600; ++i) blocks.push_back(std::make_unique<std::vector<char>>(i * 7919 % 100000));
  for (std::size_t i = 0; i < blocks.size(); i += 2) blocks[i].reset();  // so that the next ones are scattered
  EXPECT_EQ(body_fitted(specimen).to_mesh_data().rest, first);
}

}  // namespace
}  // namespace cutbench
