// Cuts made again, backwards or in another order.

#include "harness/mesh/tolerances.h"
#include "tests/metamorphic.h"

namespace cutbench {
namespace {

class Repeated : public EveryVariant {
 protected:
  bool is_exact() const { return GetParam().row->promises.exact_incision; }
  static constexpr const char* inexact = "the incision is not where the path is, which therefore meets it elsewhere";
};

/// The same points, the other way round; a closed curve still begins where it began.
Curve reversed(Curve curve) {
  const bool keeps_first = curve.closed && curve.kind == Curve::Kind::polyline;
  std::reverse(curve.points.begin() + (keeps_first ? 1 : 0), curve.points.end());
  return curve;
}

/// Once more, or backwards once more: there is nothing left to open, also where later cuts have crossed it.
TEST_P(Repeated, PolylineIsANoop) {
  if (!is_exact()) GTEST_SKIP() << inexact;
  std::size_t repeated = 0;
  for_each_case(scaled(2), 421, [&](const TestCase& c) {
    if (HasFailure()) return;
    CutSheet cut = cut_with(GetParam(), *c.mesh, c.cuts, c.chord_tolerance);
    Locator locator(cut.sheet);
    Cutter cutter;
    const auto method = GetParam().row->make(GetParam().parameter);
    for (const Curve& curve : c.cuts) {
      if (curve.kind != Curve::Kind::polyline) continue;
      for (const Curve& again : {curve, reversed(curve)}) {
        const Sheet before = cut.sheet;
        const CutOutcome outcome =
            cutter.cut(cut.sheet, locator, again, *method, {.chord_tolerance = c.chord_tolerance});
        const bool noop = outcome.status == Status::noop && difference(before, cut.sheet).empty();
        EXPECT_TRUE(noop) << name_of(outcome.status) << " " << outcome.reason << ", " << difference(before, cut.sheet)
                          << "\n"
                          << text_of(again) << "\nof " << text_of(c);
        ++repeated;
      }
    }
  });
  EXPECT_GT(repeated, 100u);
}

/// It follows the chords that stand for it, both ways, also round a loop.
TEST_P(Repeated, BezierIsANoop) {
  if (!is_exact()) GTEST_SKIP() << inexact;
  if (GetParam().name == "bowyer_watson_rounds_3")
    GTEST_SKIP() << "three rounds of local split leave more edges along a chord than are followed";
  for_each_case(scaled(2), 424, [&](TestCase c) {
    c.cuts.resize(1);
    if (HasFailure() || c.cuts[0].kind != Curve::Kind::bezier) return;
    CutSheet cut = cut_with(GetParam(), *c.mesh, c.cuts, 0.05);
    Locator locator(cut.sheet);
    Cutter cutter;
    const auto method = GetParam().row->make(GetParam().parameter);
    for (const Curve& again : {c.cuts[0], reversed(c.cuts[0])}) {
      const Sheet before = cut.sheet;
      const CutOutcome outcome = cutter.cut(cut.sheet, locator, again, *method, {.chord_tolerance = 0.05});
      EXPECT_STREQ(name_of(outcome.status), "noop") << text_of(c);
      EXPECT_EQ(difference(before, cut.sheet), "") << text_of(c);
    }
  });
}

TEST_P(Repeated, BackwardsIsTheSameCut) {
  for_each_case(scaled(2), 422, [&](TestCase c) {
    if (HasFailure()) return;
    c.cuts.resize(1);
    const CutSheet forwards = cut_with(GetParam(), *c.mesh, c.cuts, c.chord_tolerance);
    const CutSheet backwards = cut_with(GetParam(), *c.mesh, {reversed(c.cuts[0])}, c.chord_tolerance);
    // A curve that comes to one edge in one triangle gets a node at its middle point; of two it takes the later one.
    const bool is_curved = c.cuts[0].kind == Curve::Kind::bezier && c.name.find("tiny_open") != std::string::npos;
    const double tolerance = is_curved ? 0.05 * forwards.sheet.mean_edge() : line_tolerance * forwards.sheet.snap();
    std::string what;
    if (is_exact())
      what = different_cut(shape_of(forwards.sheet), shape_of(backwards.sheet), tolerance);
    else if (count_pieces(forwards.sheet) != count_pieces(backwards.sheet))  // constraints go to the node met first
      what = "pieces";
    if (forwards.statuses != backwards.statuses) what = "another status";
    EXPECT_EQ(what, "") << text_of(c);
  });
}

/// Every two neighbours in the list of all cases. What stands for a curve between two edges is its chord, so that
/// curves which meet nearer than the chord tolerance may meet otherwise in the other order: it is small here.
TEST_P(Repeated, TwoCutsInEitherOrderGiveTheSamePieces) {
  if (!is_exact()) GTEST_SKIP() << inexact;
  std::map<const MeshData*, Curve> earlier;
  for_each_case(scaled(2), 423, [&](TestCase c) {
    if (HasFailure()) return;
    c.chord_tolerance = 1e-3;
    const Curve other = std::exchange(earlier[c.mesh], c.cuts[0]);
    if (other.points.empty()) return;
    c.cuts = {other, c.cuts[0]};
    const CutSheet one = cut_with(GetParam(), *c.mesh, c.cuts, c.chord_tolerance);
    const CutSheet two = cut_with(GetParam(), *c.mesh, {c.cuts[1], c.cuts[0]}, c.chord_tolerance);
    const auto is_straight = [](const Curve& curve) { return curve.kind == Curve::Kind::polyline; };
    const bool straight = std::all_of(c.cuts.begin(), c.cuts.end(), is_straight);
    std::string what;
    if (count_pieces(one.sheet) != count_pieces(two.sheet)) what = "pieces";
    if (straight) what = different_cut(shape_of(one.sheet), shape_of(two.sheet), line_tolerance * one.sheet.snap());
    EXPECT_EQ(what, "") << text_of(c);
  });
}

INSTANTIATE_TEST_SUITE_P(Methods, Repeated, testing::ValuesIn(all_variants()), name_of_variant);

}  // namespace
}  // namespace cutbench
