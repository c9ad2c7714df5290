// What warping and reshaping must not do, and what they are for.

#include <gtest/gtest.h>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/judge/assessment.h"
#include "harness/judge/judged_sheet.h"
#include "harness/mesh/families.h"
#include "harness/mesh/tolerances.h"
#include "methods/registry.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

constexpr const char* families[] = {"straight", "curved", "partial", "cut_out", "recut"};

TEST(Reshape, HeldVerticesStayWhereTheyAre) {
  std::size_t moved_when_free = 0;
  for (const char* name : {"warp_and_refine", "active_node"})
    for (const std::string family : families)
      for (std::size_t i = 0; i < scaled(5); ++i)
        for (const bool held : {false, true}) {
          Sheet sheet(make_sheet("delaunay", 12));
          if (held)
            for (std::size_t v = 0; v < sheet.vertex_slots(); ++v) sheet.hold(VertexIndex(v));
          const Sheet before = sheet;
          Locator locator(sheet);
          Cutter cutter;
          const auto method = find_method(name).make(find_method(name).parameter.value);
          for (const Curve& curve : make_case(family, 5, i, sheet)) cutter.cut(sheet, locator, curve, *method, {});
          for (std::size_t k = 0; k < before.vertex_slots(); ++k) {
            const VertexIndex v(k);
            const bool stays = sheet.triangle_of_vertex(v).valid() && sheet.rest(v) == before.rest(v);
            moved_when_free += !held && !stays;
            EXPECT_TRUE(!held || stays) << name << ", " << family << " " << i << ", vertex " << k;
          }
        }
  EXPECT_GT(moved_when_free, scaled(100));
}

/// Cuts that once left triangles beyond an aspect ratio of 3 where no angle forces them: chords that enclose less than
/// the curves, a crossing close beside a vertex of an older incision, and triangles whose off-centre left them as they
/// were, because the mesh between was not Delaunay.
TEST(WarpAndRefine, LeavesNothingIllShapedThatNothingForces) {
  struct Case {
    const char* family;
    int n;
    std::size_t i;
    std::uint64_t seed;
  };
  for (const Case& c :
       {Case{"several", 20, 14, 28438054750209}, Case{"several", 30, 14, 28438054750209},
        Case{"several", 50, 7, 28438054750209}, Case{"several", 20, 16, 12}, Case{"several", 20, 24, 11},
        Case{"recut", 20, 0, 15}, Case{"recut", 30, 1, 14}, Case{"recut", 40, 2, 20}, Case{"curved", 80, 4, 13}}) {
    Sheet sheet(make_sheet("grid", c.n));
    const Sheet before = sheet;
    const auto cuts = make_case(c.family, c.seed, c.i, sheet);
    Locator locator(sheet);
    Cutter cutter;
    const MethodRow& row = find_method("warp_and_refine");
    const auto method = row.make(row.parameter.value);
    for (const Curve& curve : cuts) EXPECT_EQ(cutter.cut(sheet, locator, curve, *method, {}).status, Status::ok);
    const Assessment found =
        assess(before, sheet, judge_one_by_one(before, sheet, cuts, row.promises, row.make(row.parameter.value), {}),
               forced_corners_of(before, cuts));
    EXPECT_TRUE(found.judgement.ok) << found.judgement.verdict;
    EXPECT_LT(found.ar_max_away_from_wedges, 3) << c.family << " " << c.n << " " << c.i;
  }
}

/// The incision of a curved cut is nowhere farther from the requested curve than the chord tolerance: what the trace
/// leaves out and what later steps move or merge share one budget.
TEST(WarpAndRefine, KeepsTheChordToleranceOfCurves) {
  for (const char* name : {"warp_and_refine", "cisamr", "active_node"})
    for (const std::string sheet_family : sheet_families())
      for (const char* family : {"curved", "cut_out"})
        for (const double tolerance : {0.05, 0.01})
          for (std::size_t i = 0; i < scaled(6); ++i) {
            const MethodRow& row = find_method(name);
            const Sheet before(make_sheet(sheet_family, i % 2 == 0 ? 20 : 33));
            const CutOptions options{.chord_tolerance = tolerance};
            JudgedSheet sheet(before, row.promises, row.make(row.parameter.value));
            if (sheet.why_unsupported()) continue;
            const double allowed =
                (tolerance + options.flatten_tolerance) * before.mean_edge() + meeting_tolerance * before.snap();
            for (const Curve& curve : make_case(family, 7, i, before)) {
              const auto finding = sheet.cut(curve, options);
              EXPECT_TRUE(finding.ok()) << finding.reason;
              EXPECT_LE(sheet.judgement.incision_error, allowed)
                  << name << ", " << sheet_family << ", " << family << " " << i << ", tolerance " << tolerance;
            }
          }
}

/// A path across a square of four triangles round a vertex that it does not meet: its middle vertex can go, its ends
/// can't.
TEST(Sheet, APathVertexCollapsesAlongThePath) {
  Sheet sheet(make_sheet("grid", 2));
  sheet.begin_cut();
  const VertexIndex middle(std::size_t{4});
  ASSERT_EQ(sheet.rest(middle), (Point2{0.5, 0.5}));
  HalfEdge left, right;
  HalfEdge h = sheet.first_outgoing(middle);
  for (int i = 0; i < 6; ++i, h = sheet.next_outgoing(h)) {
    if (sheet.rest(sheet.target(h)) == Point2{0, 0.5}) left = h;
    if (sheet.rest(sheet.target(h)) == Point2{1, 0.5}) right = h;
  }
  const Point2 on_left{0.25, 0.5};
  const VertexIndex v = sheet.split_edge(left, 0.5, on_left);
  h = sheet.first_outgoing(v);
  HalfEdge towards_border, towards_middle, aside;
  for (int i = 0; i < 4; ++i, h = sheet.next_outgoing(h)) {
    const Point2 to = sheet.rest(sheet.target(h));
    (to == Point2{0, 0.5} ? towards_border : to == Point2{0.5, 0.5} ? towards_middle : aside) = h;
  }
  sheet.set_mark(towards_border, EdgeMark::path);
  EXPECT_FALSE(sheet.collapse(towards_border)) << "a tip";
  sheet.set_mark(towards_middle, EdgeMark::path);
  EXPECT_FALSE(sheet.collapse(aside)) << "off the path";
  const std::size_t vertices = sheet.vertex_count();
  ASSERT_TRUE(sheet.collapse(towards_middle));
  EXPECT_EQ(sheet.vertex_count() + 1, vertices);
  EXPECT_EQ(faults(sheet, false), "");
  bool joined = false;
  h = sheet.first_outgoing(middle);
  const HalfEdge first = h;
  do {
    if (sheet.rest(sheet.target(h)) == Point2{0, 0.5}) joined = sheet.mark(h) == EdgeMark::path;
    h = sheet.next_outgoing(h);
  } while (h.valid() && h != first);
  EXPECT_TRUE(joined);
}

/// The method's claim: below 3 where the input forces nothing, as the audit has it, which knows nothing of the method;
/// and few vertices. (Beside a forced corner the last triangle may be worse.)
TEST(WarpAndRefine, NoTriangleIsIllShapedAndFewVerticesAreAdded) {
  const MethodRow& row = find_method("warp_and_refine");
  std::size_t judged = 0, crossed = 0;
  std::ptrdiff_t added = 0;
  for (const int n : {20, 40})
    for (std::size_t i = 0; i < scaled(20); ++i) {
      Sheet sheet(make_sheet("grid", n));
      const Sheet before = sheet;
      Locator locator(sheet);
      const auto cuts = make_case("curved", 7, i, sheet);
      const CutOutcome outcome = Cutter().cut(sheet, locator, cuts[0], *row.make(row.parameter.value), {});
      ASSERT_EQ(outcome.status, Status::ok);
      const Assessment a = assess_result(before, sheet.to_mesh_data(), cuts, promises_of_everybody, {});
      crossed += outcome.crossed_triangles;
      added += a.vertices_added;
      if (a.forced_corners > 0) continue;
      ++judged;
      EXPECT_LT(a.outside_wedges.ar_max, 3) << "curved " << i << " on " << n;
    }
  EXPECT_GT(2 * judged, scaled(20));
  EXPECT_LT(to_double(added), 0.4 * to_double(crossed));
}

}  // namespace
}  // namespace cutbench
