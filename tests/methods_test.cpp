// The property test: every method of the table, over all families of cuts and sheets, judged by check() and the oracle.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/cut/constraint_source.h"
#include "harness/judge/oracle_request.h"
#include "harness/judge/same_sheet.h"
#include "harness/mesh/families.h"
#include "harness/mesh/one_ring.h"
#include "methods/registry.h"
#include "methods/variants.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

constexpr std::uint64_t seed = 20180507;

struct Variant {
  const MethodRow* row;
  double parameter;
};

std::string name_of_variant(const Variant& v) {
  if (v.row->parameter.name.empty()) return v.row->name;
  std::ostringstream value;
  value << v.parameter;
  std::string name = v.row->name + "_" + v.row->parameter.name + "_" + value.str();
  std::replace(name.begin(), name.end(), '.', '_');
  return name;
}

/// Every row at its default, and with its parameter at zero.
std::vector<Variant> all_variants() {
  std::vector<Variant> variants;
  for (const MethodRow& row : all_methods()) {
    variants.push_back({&row, row.parameter.value});
    if (!row.parameter.name.empty() && row.parameter.value != 0) variants.push_back({&row, 0});
  }
  return variants;
}

class EveryMethod : public testing::TestWithParam<std::tuple<Variant, const char*>> {};

TEST_P(EveryMethod, CutsWithoutFault) {
  const auto& [variant, family] = GetParam();
  static const std::vector<NamedMesh> small = test_meshes(6), large = test_meshes(13);
  std::size_t cuts = 0, noops = 0, failures = 0;
  for (std::size_t i = 0; i < std::max<std::size_t>(2, scaled(10)); ++i)
    for (std::size_t m = 0; m < small.size(); ++m) {
      Random random(1000 * i + m);
      const auto& [name, mesh] = (i % 2 == 0 ? small : large)[m];
      Table table(i % 4 < 2 ? mesh : lifted(mesh), *variant.row, variant.parameter);
      const double chord = random.coin() ? 0.05 : infinite;
      const std::uint64_t case_seed = seed + m;
      std::size_t k = 0;
      for (const Curve& curve : make_case(family, case_seed, i, table.sheet)) {
        const std::string what = table.cut(curve, chord);
        ++cuts;
        noops += table.outcome.status == Status::noop;
        if (!what.empty()) {
          ADD_FAILURE() << what << "\nfamily " << family << ", seed " << case_seed << ", case " << i << ", cut " << k
                        << ", sheet " << name << ", method " << name_of_variant(variant) << ", chord tolerance "
                        << chord << "\n"
                        << text_of(curve);
          if (++failures == 5) FAIL() << "and so on";
          break;
        }
        ++k;
      }
    }
  RecordProperty("cuts", to_int(cuts));
  RecordProperty("noops", to_int(noops));
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod,
                         testing::Combine(testing::ValuesIn(all_variants()),
                                          testing::ValuesIn(cut_families().begin(), cut_families().end())),
                         [](const auto& parameters) {
                           return name_of_variant(std::get<0>(parameters.param)) + "_" + std::get<1>(parameters.param);
                         });

/// What the ablation is made of: no experiment with all methods has them.
TEST(Ablation, EveryCombinationCutsWithoutFault) {
  for (const MethodRow& row : ablation_methods()) {
    const auto method = row.make(row.parameter.value);
    bool constrained = false;
    for (const std::string family : sheet_families())
      for (const std::string cuts : {"curved", "several"}) {
        SCOPED_TRACE(row.name + ", " + family + ", " + cuts);
        Table table(make_sheet(family, 10), row, row.parameter.value);
        const Sheet before = table.sheet;
        for (const Curve& curve : make_case(cuts, seed, 0, before)) EXPECT_EQ(table.cut(curve, 0.05), "");
        constrained |= !constraints_of(*method, before, table.sheet).empty();
      }
    EXPECT_EQ(constrained, method->constraint_source() != nullptr) << row.name;
  }
}

/// A path from border to border with corners inside triangles is rounded to edges: nothing is divided.
TEST(EdgeRelease, LeavesCornersInsideTrianglesOut) {
  for (const std::string family : sheet_families()) {
    SCOPED_TRACE(family);
    Table table(make_sheet(family, 10), find_method("edge_release"), 0);
    const std::size_t triangles = table.sheet.triangle_count();
    const Curve path{
        Curve::Kind::polyline, false, {{-0.1, 0.31}, {0.237, 0.353}, {0.514, 0.468}, {0.787, 0.611}, {1.1, 0.63}}};
    EXPECT_EQ(table.cut(path, infinite), "");
    EXPECT_EQ(table.sheet.triangle_count(), triangles);
  }
}

/// The aspect ratio after a cut of two tips whose last tip stops close before an edge, as those of the stability
/// sweeps.
double worst_aspect_before_an_edge(const std::string& method, const std::string& family, Point2 from, double gap) {
  Table table(make_sheet(family, 20), find_method(method), find_method(method).parameter.value);
  VertexIndex v{0};
  const auto off_centre = [&](VertexIndex w) { return squared_length(table.sheet.rest(w) - Point2{0.5, 0.5}); };
  for (std::size_t w = 0; w < table.sheet.vertex_slots(); ++w)
    if (off_centre(VertexIndex(w)) < off_centre(v)) v = VertexIndex(w);
  const HalfEdge edge = Sheet::next(table.sheet.first_outgoing(v));
  const Point2 a = table.sheet.rest(table.sheet.origin(edge)), b = table.sheet.rest(table.sheet.target(edge));
  const Point2 at = a + 0.45 * (b - a), back = from - at;
  const Curve path{Curve::Kind::polyline, false, {from, at + gap / length(back) * back}};
  EXPECT_EQ(table.cut(path, infinite), "") << method << ", " << family;
  double worst = 0;
  for (std::size_t t = 0; t < table.sheet.triangle_slots(); ++t)
    if (table.sheet.triangle(TriangleIndex(t)).alive()) {
      const auto c = table.sheet.corners(TriangleIndex(t));
      worst = std::max(worst, oriented_aspect(c[0], c[1], c[2]));
    }
  return worst;
}

/// The tip of a long cut goes to a vertex, or a vertex to the tip: what is before it makes no sliver.
TEST(Tips, GoToVerticesOrVerticesToThem) {
  for (const std::string family : {"grid", "alternating", "delaunay"})
    for (const Point2 from : {Point2{0.113, 0.377}, Point2{0.871, 0.231}, Point2{0.413, 0.913}})
      for (const double gap : {1e-4, 1e-8}) {
        SCOPED_TRACE(family + ", from " + std::to_string(from.x) + ", gap " + std::to_string(gap));
        EXPECT_LT(worst_aspect_before_an_edge("edge_release", family, from, gap), 15);
        EXPECT_LT(worst_aspect_before_an_edge("vertex_snap", family, from, gap), 300);
      }
}

/// The path turns round the vertex that comes to its tip: what would be left out is farther away than promised.
TEST(Tips, OfVertexSnapKeepToItsBound) {
  Table table(make_sheet("alternating", 20), find_method("vertex_snap"), 0.5);
  const Curve path{Curve::Kind::polyline,
                   false,
                   {{0.83323716128191, 0.667448869474236}, {0.8833970235220973, 0.616602976477904}, {0.2, 0.8}}};
  EXPECT_EQ(table.cut(path, 0.05), "");
}

/// A snap tolerance takes a tip to a vertex of its triangle, but to no edge.
TEST(Tips, OfSnapOrSplitGoToVerticesWithinTheTolerance) {
  const MethodRow& row = find_method("snap_or_split");
  for (const double tolerance : {0.1, 0.25}) {
    Table table(make_sheet("grid", 10), row, tolerance);
    const auto vertices = table.sheet.vertex_count();
    EXPECT_EQ(table.cut({Curve::Kind::polyline, false, {{0.3, 0.3}, {0.5, 0.5}, {0.618, 0.604}}}, infinite), "");
    EXPECT_EQ(table.sheet.vertex_count() == vertices, tolerance == 0.25) << tolerance;
  }
}

/// The other readings of the paper's local split keep its promises, and reach its bound as little.
TEST(SplitReadings, KeepThePathAndNotTheBound) {
  for (const char* name : {"bowyer_watson:grouped", "bowyer_watson:region", "bowyer_watson:longest_edge"})
    for (const std::string family : sheet_families())
      for (const std::string cuts : {"curved", "several", "self_crossing", "cut_out"}) {
        SCOPED_TRACE(std::string(name) + ", " + family + ", " + cuts);
        Table table(make_sheet(family, 10), find_method(name), 2);
        const std::size_t before = table.sheet.vertex_count();
        for (const Curve& curve : make_case(cuts, seed, 0, Sheet(table.sheet))) EXPECT_EQ(table.cut(curve, 0.05), "");
        EXPECT_GT(table.sheet.vertex_count(), before);
        double worst = 0;
        for (std::size_t t = 0; t < table.sheet.triangle_slots(); ++t)
          if (table.sheet.triangle(TriangleIndex(t)).alive()) {
            const auto c = table.sheet.corners(TriangleIndex(t));
            worst = std::max(worst, oriented_aspect(c[0], c[1], c[2]));
          }
        EXPECT_GT(worst, 3);
      }
}

void expect_refused(const MethodRow& row, double value) {
  try {
    row.make(value);
    ADD_FAILURE() << row.name << " takes " << value;
  } catch (const InputError& error) {
    const std::string text = error.what();
    EXPECT_TRUE(text.starts_with(row.name + ": " + row.parameter.name + " must be ")) << text;
    EXPECT_NE(text.find(row.parameter.range.text()), std::string::npos) << text;
    EXPECT_NE(text.find("the default is "), std::string::npos) << text;
  }
}

TEST(Parameter, IsTakenWithinItsRangeAlone) {
  std::size_t parameters = 0;
  for (const MethodRow& row : nameable_methods()) {
    if (row.parameter.name.empty()) continue;
    SCOPED_TRACE(row.name);
    ++parameters;
    const Range& range = row.parameter.range;
    for (const double good : {range.least, range.most, row.parameter.value}) EXPECT_TRUE(row.make(good)) << good;
    const double below = std::nextafter(range.least, -infinite), above = std::nextafter(range.most, infinite);
    for (const double bad : {below, above, -1.0, -infinite, infinite, std::nan("")}) expect_refused(row, bad);
    if (range.whole) expect_refused(row, range.least + 0.5);
    if (range.or_zero) {
      EXPECT_TRUE(row.make(0));
    }
    if (range.or_zero) expect_refused(row, range.least / 2);
  }
  EXPECT_EQ(parameters, 26u);
}

TEST(Parameter, ARangeSaysWhatItHas) {
  EXPECT_EQ((Range{.least = 0, .most = 6, .whole = true}.text()), "a whole number from 0 to 6");
  EXPECT_EQ((Range{.least = 2, .most = 1000, .or_zero = true}.text()), "0, or a number from 2 to 1000");
  EXPECT_EQ((Range{.least = 0.5}.text()), "a number of at least 0.5");
  EXPECT_EQ((Range{.most = 0.5, .whole = true}.text()), "a whole number of at most 0.5");
  EXPECT_EQ(Range{}.text(), "a number");
  EXPECT_TRUE(Range{}.has(-1e300));
  EXPECT_FALSE(Range{}.has(infinite));
}

/// Four cuts whose exact curves make four pieces, but whose incisions, each within the tolerance of its curve, five.
TEST(JudgeOneByOne, ALaterCutMeetsTheIncisionNotTheCurve) {
  const Sheet before(make_sheet("alternating", 20));
  const auto cuts = make_case("several", 280895897728382, 0, before);
  const MethodRow& row = find_method("conventional_split");
  const CutOptions options;
  Sheet after = before;
  Locator locator(after);
  Cutter cutter;
  for (const Curve& curve : cuts) cutter.cut(after, locator, curve, *row.make(row.parameter.value), options);
  const oracle::Judgement whole =
      oracle::judge(request_for(before, cuts, row.promises, options, true), for_oracle(after));
  EXPECT_EQ(whole.verdict, oracle::Verdict::wrong_pieces);
  const Judgement each = judge_one_by_one(before, after, cuts, row.promises, row.make(row.parameter.value), options);
  EXPECT_TRUE(each.ok) << each.problems.front();
  EXPECT_EQ(each.pieces, whole.pieces);
  EXPECT_NEAR(each.area_change, whole.area_change, 1e-12);
  const Judgement another =
      judge_one_by_one(before, before, cuts, row.promises, row.make(row.parameter.value), options);
  EXPECT_EQ(another.verdict, Verdict::not_reproduced);
}

/// The default of every part of a method: the Delaunay split.
class SplitAlone : public CuttingMethod {};

/// The path runs past a row of vertices so closely that refinement gives up.
TEST(Methods, OneThatGivesUpSaysThatNothingWasImproved) {
  const Sheet before(make_sheet("grid", 4));
  const auto cut = [&](CuttingMethod& method, Sheet& sheet) {
    Locator locator(sheet);
    Cutter cutter;
    return cutter.cut(sheet, locator, {Curve::Kind::polyline, false, {{-0.1, 0.501}, {1.1, 0.5017}}}, method, {});
  };
  const MethodRow& row = find_method("cgal_refine");
  Sheet refined = before, split = before;
  const CutOutcome outcome = cut(*row.make(row.parameter.value), refined);
  SplitAlone alone;
  cut(alone, split);
  ASSERT_EQ(outcome.status, Status::ok);
  EXPECT_EQ(difference(refined, split), "") << "or else something was improved: the test needs another path";
  EXPECT_EQ(outcome.reason.find("no triangle was improved"), 0u) << outcome.reason;
}

}  // namespace
}  // namespace cutbench
