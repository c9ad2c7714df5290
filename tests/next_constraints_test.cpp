// Constraints that follow the last cut are those that a search of all cuts finds.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>
#include <vector>

#include "harness/cases/cut_families.h"
#include "tests/constrained_cut.h"

namespace cutbench {
namespace {

/// Without names that depend on the order in which phantom nodes are counted: each is named after the first element,
/// and the corner of it, that it belongs to.
class Canonical {
 public:
  Canonical(const Constraints& of, std::size_t vertices) : of_(of), vertices_(vertices) {
    for (const CopiedElement& element : of.copied)
      for (std::size_t k = 0; k < 3; ++k)
        if (element.unknown[k]() >= vertices)
          names_.emplace(element.unknown[k].value, Name{1 + element.triangles.front().value, element.parent.value, k});
  }
  using Name = std::tuple<std::int32_t, std::int32_t, std::size_t>;
  Name name(DeformedIndex u) const { return u() < vertices_ ? Name{0, u.value, 0} : names_.at(u.value); }

  std::map<DeformedIndex, std::vector<std::pair<Name, double>>> constraints() const {
    std::map<DeformedIndex, std::vector<std::pair<Name, double>>> all;
    for (const Constraint& constraint : of_.constraints) {
      auto& row = all[constraint.vertex];
      EXPECT_TRUE(row.empty()) << "constrained twice";
      for (std::size_t k = 0; k < 3; ++k)
        if (constraint.weights[k] != 0) row.emplace_back(name(constraint.masters[k]), constraint.weights[k]);
    }
    return all;
  }
  std::vector<std::tuple<std::int32_t, std::vector<TriangleIndex>, std::array<Name, 3>>> elements() const {
    std::vector<std::tuple<std::int32_t, std::vector<TriangleIndex>, std::array<Name, 3>>> all;
    for (const CopiedElement& element : of_.copied)
      all.emplace_back(element.parent.value, element.triangles,
                       std::array{name(element.unknown[0]), name(element.unknown[1]), name(element.unknown[2])});
    return all;
  }
  std::map<Name, double> masses() const {
    std::map<Name, double> all;
    for (const auto& [unknown, area] : of_.lumped) EXPECT_TRUE(all.emplace(name(unknown), area).second);
    return all;
  }

 private:
  const Constraints& of_;
  std::size_t vertices_;
  std::map<std::int32_t, Name> names_;
};

void expect_same(const Constraints& next, const Constraints& all, std::size_t vertices) {
  EXPECT_EQ(next.phantoms.size(), all.phantoms.size());
  const auto by_unknown = [](const LumpedArea& a, const LumpedArea& b) { return a.unknown < b.unknown; };
  EXPECT_TRUE(std::is_sorted(next.lumped.begin(), next.lumped.end(), by_unknown));
  const Canonical a(next, vertices), b(all, vertices);
  EXPECT_EQ(a.elements(), b.elements());
  EXPECT_EQ(a.constraints(), b.constraints());
  const auto here = a.masses(), there = b.masses();
  ASSERT_EQ(here.size(), there.size());
  for (const auto& [name, area] : there) {
    ASSERT_TRUE(here.contains(name));
    EXPECT_NEAR(here.at(name), area, 1e-14);
  }
}

TEST(NextConstraints, AreThoseOfASearchFromNothing) {
  const std::vector<ConstrainingMethod> methods{
      {"phantom_node", 0}, {"phantom_node:consistent_mass", 0}, {"virtual_node", 0}};
  std::size_t turn = 0, compared = 0;
  for (const ConstrainingMethod& method : methods)
    for (const std::string& family : families_in_turn(turn))
      for (std::uint64_t seed = 1; seed <= scaled(6); ++seed) {
        Sheet sheet(make_sheet(family, 12));
        const Sheet before = sheet;
        Locator locator(sheet);
        Cutter cutter;
        const auto tool = method.make();
        Constraints last;
        for (const std::string cuts : {"straight", "partial", "curved", "recut", "cut_out", "several", "self_crossing",
                                       "u_turn", "through_vertices", "along_edges", "partial", "straight"})
          for (const Curve& curve : make_case(cuts, seed, 0, before)) {
            SCOPED_TRACE(method.name + ", " + family + ", seed " + std::to_string(seed) + ", " + cuts);
            const CutOutcome outcome = cutter.cut(sheet, locator, curve, *tool, {});
            if (outcome.status != Status::ok) continue;
            Constraints next = tool->constraint_source()->next_constraints(before, sheet, last, {});
            expect_same(next, constraints_of(*tool, before, sheet), sheet.deformed_slots());
            ++compared;
            if (testing::Test::HasFailure()) return;
            last = std::move(next);
          }
      }
  EXPECT_GT(compared, scaled(300));
}

}  // namespace
}  // namespace cutbench
