// The adversarial cuts of the robustness run: a published seed must give the same cases for ever.
#include "harness/cases/adversarial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "harness/cases/cut_families.h"
#include "harness/mesh/families.h"

namespace cutbench {
namespace {

/// Fails where a cut family was added to the adversarial cuts, removed from it or moved: that changes the cases of
/// every seed. A new family belongs into cut_families() alone.
TEST(Adversarial, DrawsFromItsOwnListOfCutFamilies) {
  const std::vector<std::string> published{
      "straight",      "curved",    "partial",   "border_inward", "cut_out",          "recut",      "several",
      "self_crossing", "tiny_loop", "tiny_open", "u_turn",        "through_vertices", "along_edges"};
  const auto list = adversarial_cut_families();
  EXPECT_EQ(std::vector<std::string>(list.begin(), list.end()), published);
  for (const auto& family : published)
    EXPECT_EQ(std::count(cut_families().begin(), cut_families().end(), family), 1) << family;
}

/// Numbers and kinds of curves and points, which do not depend on the last digits of the mathematics library.
TEST(Adversarial, GivesTheCasesThatItGave) {
  const Sheet sheet(make_sheet("grid", 10));
  std::uint64_t hash = 0;
  const auto add = [&](std::uint64_t value) { hash = (hash ^ value) * 0x100000001B3u; };
  for (std::size_t i = 0; i < 1000; ++i) {
    const std::vector<Curve> cuts = make_adversarial_case(7, i, sheet).cuts;
    add(cuts.size());
    for (const Curve& curve : cuts) {
      add(curve.points.size());
      add(2 * (curve.kind == Curve::Kind::bezier) + curve.closed);
    }
  }
  EXPECT_EQ(hash, 6133113836872028050u);
}

}  // namespace
}  // namespace cutbench
