// What a cut must not change, whatever the path: the deformed surface, and the whole sheet where the cut fails.

#include <gtest/gtest.h>

#include "harness/cases/cut_families.h"
#include "harness/mesh/families.h"
#include "methods/registry.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

/// These two only divide triangles, so that each part keeps its parent's deformation, and with it the membrane energy.
TEST(Invariants, DividingTrianglesKeepsTheDeformedSurface) {
  for (const std::string method : {"conventional_split", "bowyer_watson"})
    for (const std::string family : cut_families())
      for (const auto& [name, mesh] : test_meshes(6))
        for (std::size_t i = 0; i < scaled(3); ++i) {
          SCOPED_TRACE(method + ", " + family + " " + std::to_string(i) + ", " + name);
          Sheet sheet(lifted(mesh));
          Locator locator(sheet);
          Cutter cutter;
          const auto cut = find_method(method).make(find_method(method).parameter.value);
          for (const Curve& curve : make_case(family, 77, i, sheet)) {
            const double area = surface_area(sheet);
            cutter.cut(sheet, locator, curve, *cut, {});
            EXPECT_NEAR(surface_area(sheet), area, 1e-12 * area);
          }
        }
}

/// Each triangle of the result is an affine piece of the old triangle it lies in: same map, tested at its corners.
TEST(Invariants, TheLogGivesTheDeformedPositions) {
  for (const MethodRow& row : all_methods())
    for (const std::string family : cut_families()) {
      SCOPED_TRACE(row.name + ", " + family);
      Sheet sheet(lifted(make_sheet("delaunay", 6)));
      Locator locator(sheet);
      Cutter cutter;
      const auto cut = row.make(row.parameter.value);
      for (const Curve& curve : make_case(family, 78, 0, sheet)) {
        std::vector<Point3> position;
        for (std::size_t d = 0; d < sheet.deformed_slots(); ++d) position.push_back(sheet.position(DeformedIndex(d)));
        cutter.cut(sheet, locator, curve, *cut, {});
        position.resize(sheet.deformed_slots());
        for (const auto& [vertex, parents, weights] : sheet.log().ancestry) {
          Point3 x;
          double sum = 0;
          for (std::size_t i = 0; i < 3; ++i) {
            sum += weights[i];
            EXPECT_GE(weights[i], -1e-9);
            if (parents[i].valid()) x = x + weights[i] * position[parents[i]()];
          }
          EXPECT_NEAR(sum, 1, 1e-12);
          position[vertex()] = x;
        }
        for (std::size_t d = 0; d < position.size(); ++d)
          if (sheet.rest_vertex(DeformedIndex(d)).valid()) {
            EXPECT_EQ(position[d], sheet.position(DeformedIndex(d)));
          }
      }
    }
}

/// New and moved vertices lie on the deformed sheet where the old map takes them: an affine one shows whether the place
/// in rest space is the one that was mapped.
TEST(Invariants, AnAffineStateStaysAffine) {
  const auto affine = [](Point2 p) {
    return Point3{1.3 * p.x + 0.2 * p.y, 0.1 * p.x - 0.8 * p.y, 0.5 * p.x + 2 * p.y};
  };
  for (const MethodRow& row : all_methods())
    for (const std::string family : {"curved", "partial", "cut_out", "recut", "several", "u_turn"})
      for (std::size_t i = 0; i < scaled(4); ++i) {
        SCOPED_TRACE(row.name + ", " + family + ", " + std::to_string(i));
        Sheet sheet(make_sheet("grid", 16));
        for (std::size_t d = 0; d < sheet.deformed_slots(); ++d)
          sheet.set_position(DeformedIndex(d), affine(sheet.rest(sheet.rest_vertex(DeformedIndex(d)))));
        Locator locator(sheet);
        Cutter cutter;
        const auto cut = row.make(row.parameter.value);
        for (const Curve& curve : make_case(family, 80, i, sheet)) cutter.cut(sheet, locator, curve, *cut, {});
        double farthest = 0;
        for (std::size_t d = 0; d < sheet.deformed_slots(); ++d) {
          if (!sheet.rest_vertex(DeformedIndex(d)).valid()) continue;
          const auto [x, y, z] = sheet.position(DeformedIndex(d));
          const auto [u, v, w] = affine(sheet.rest(sheet.rest_vertex(DeformedIndex(d))));
          farthest = std::max({farthest, std::abs(x - u), std::abs(y - v), std::abs(z - w)});
        }
        EXPECT_LT(farthest, 1e-12);
      }
}

/// Does its work and fails then.
class Failing : public CuttingMethod {
 public:
  Failing(std::unique_ptr<CuttingMethod> method, bool in_improve)
      : method_(std::move(method)), in_improve_(in_improve) {}
  void adapt(Sheet& sheet, Subdivision& trace, const Polyline& path) override { method_->adapt(sheet, trace, path); }
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override {
    method_->embed(sheet, trace, notes);
    if (!in_improve_) throw CutFailed(Verdict::inverted, "on purpose");
  }
  void improve(Sheet& sheet, MethodNotes& notes) override {
    method_->improve(sheet, notes);
    throw CutFailed(Verdict::leak, "on purpose");
  }

 private:
  std::unique_ptr<CuttingMethod> method_;
  bool in_improve_;
};

TEST(Invariants, AFailedCutLeavesTheSheetAsItWas) {
  for (const MethodRow& row : all_methods())
    for (const std::string family : cut_families())
      for (bool in_improve : {false, true}) {
        SCOPED_TRACE(row.name + ", " + family);
        Sheet sheet(lifted(make_sheet("grid", 6)));
        Locator locator(sheet);
        Cutter cutter;
        Failing failing(row.make(row.parameter.value), in_improve);
        const auto method = row.make(row.parameter.value);
        for (const Curve& curve : make_case(family, 79, 1, sheet)) {
          const Sheet before = sheet;
          const CutOutcome outcome = cutter.cut(sheet, locator, curve, failing, {});
          EXPECT_EQ(difference(before, sheet), "");
          EXPECT_EQ(faults(sheet), "");
          if (outcome.status != Status::noop) {
            EXPECT_EQ(outcome.status, Status::failed);
            EXPECT_EQ(outcome.verdict, in_improve ? Verdict::leak : Verdict::inverted);
            EXPECT_EQ(outcome.reason, "on purpose");
          }
          // And nothing stays behind: the cut that follows is the one a fresh cutter makes of a fresh sheet.
          Sheet fresh = before;
          Locator fresh_locator(fresh);
          Cutter().cut(fresh, fresh_locator, curve, *row.make(row.parameter.value), {});
          cutter.cut(sheet, locator, curve, *method, {});
          EXPECT_EQ(difference(fresh, sheet), "");
        }
      }
}

TEST(Invariants, ARefusedCutLeavesTheSheetAsItWas) {
  struct Refusing : CuttingMethod {
    std::optional<std::string> why_unsupported(const Sheet&) const override { return "not today"; }
    void embed(Sheet&, Subdivision&, MethodNotes&) override {}
  } refusing;
  Sheet sheet(make_sheet("grid", 3));
  Locator locator(sheet);
  const Sheet before = sheet;
  const CutOutcome outcome =
      Cutter().cut(sheet, locator, {Curve::Kind::polyline, false, {{0, 0.4}, {1, 0.6}}}, refusing, {});
  EXPECT_EQ(outcome.status, Status::refused);
  EXPECT_EQ(outcome.reason, "not today");
  EXPECT_EQ(difference(before, sheet), "");
}

TEST(Invariants, MethodsSayWhatTheyRefuse) {
  struct Row {
    const char *method, *why;
    MeshData mesh;
  };
  for (const Row& row : {Row{"cisamr", "the sheet is no structured grid", make_sheet("delaunay", 6)},
                         Row{"element_deletion", "none would be left", make_sheet("grid", 1)}}) {
    Sheet sheet(row.mesh);
    Locator locator(sheet);
    const Sheet before = sheet;
    const CutOutcome outcome = Cutter().cut(sheet, locator, {Curve::Kind::polyline, false, {{-0.1, 0.4}, {1.1, 0.7}}},
                                            *find_method(row.method).make(0), {});
    EXPECT_EQ(outcome.status, Status::refused) << row.method;
    EXPECT_NE(outcome.reason.find(row.why), std::string::npos) << outcome.reason;
    EXPECT_EQ(difference(before, sheet), "");
  }
}

/// A cut sheet written out and read again is the same sheet: the next cut gives the same pieces.
TEST(Invariants, ACutSheetCanBeReadAndCutAgain) {
  for (const MethodRow& row : whole_sheet_methods())
    for (std::size_t i = 0; i < scaled(10); ++i) {
      SCOPED_TRACE(row.name + " " + std::to_string(i));
      Table table(make_sheet("delaunay", 6), row, row.parameter.value);
      const auto cuts = make_case("recut", 80, i, table.sheet);
      ASSERT_EQ(table.cut(cuts[0], 0.05), "");
      Table again(table.sheet.to_mesh_data(), row, row.parameter.value);
      EXPECT_EQ(count_pieces(again.sheet), count_pieces(table.sheet));
      EXPECT_EQ(again.sheet.deformed_count(), table.sheet.deformed_count());
      EXPECT_EQ(table.cut(cuts[1], 0.05), "");
      EXPECT_EQ(again.cut(cuts[1], 0.05), "");
      EXPECT_EQ(table.judgement.pieces, 4);
      EXPECT_EQ(again.judgement.pieces, 4);
    }
}

TEST(Invariants, ManyCutsInARow) {
  for (const MethodRow& row : all_methods()) {
    Table table(make_sheet("grid", 8), row, row.parameter.value);
    table.flatten_tolerance = 1e-5;  // finer than the pieces get
    for (std::size_t i = 0; i < cut_families().size() + scaled(cut_families().size()); ++i) {
      const std::string family = cut_families()[i % cut_families().size()];
      const Curve curve = make_case(family, 81, i, table.sheet).front();
      ASSERT_EQ(table.cut(curve, 0.05), "") << row.name << ", " << family << " " << i << "\n" << text_of(curve);
    }
  }
}

TEST(Cases, AreTheSameEverywhereAndLieWhereTheySay) {
  const Sheet sheet(make_sheet("delaunay", 10));
  for (const std::string family : cut_families())
    for (std::size_t i = 0; i < 20; ++i) {
      const auto once = make_case(family, 5, i, sheet), again = make_case(family, 5, i, sheet);
      ASSERT_EQ(once.size(), again.size());
      for (std::size_t k = 0; k < once.size(); ++k) {
        EXPECT_NO_THROW(check_curve(once[k], family));
        EXPECT_EQ(text_of(once[k]), text_of(again[k]));
      }
      EXPECT_NE(text_of(once[0]), text_of(make_case(family, 6, i, sheet)[0])) << family << " " << i;
      EXPECT_NE(text_of(once[0]), text_of(make_case(family, 5, i + 1, sheet)[0])) << family << " " << i;
    }
  for (std::size_t i = 0; i < 20; ++i) {
    const Curve curve = make_case("curved", 5, i, sheet)[0];
    for (Point2 tip : {curve.points.front(), curve.points.back()})
      EXPECT_TRUE(tip.x == 0 || tip.x == 1 || tip.y == 0 || tip.y == 1);
  }
  EXPECT_THROW(make_case("zigzag", 5, 0, sheet), InputError);
}

}  // namespace
}  // namespace cutbench
