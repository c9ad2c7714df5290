// Small free pieces: which vertices are in one, as links come and go, and that multigrid solves these exactly.

#include "harness/fem/multigrid/small_pieces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/base/random.h"
#include "harness/fem/multigrid/multigrid.h"
#include "tests/helpers.h"
#include "tests/multigrid_helpers.h"
#include "tests/random_field.h"

namespace cutbench {
namespace {

/// Vertices with links that come and go; half of them are scalars alone.
struct Links {
  std::vector<std::set<std::int32_t>> blocks, scalars;
  std::vector<std::uint8_t> is_there;
  explicit Links(std::size_t n) : blocks(n), scalars(n), is_there(n, 1) {}
  void turn(std::int32_t i, std::int32_t j) {
    auto& kind = (i + j) % 2 ? blocks : scalars;
    for (const auto& [from, to] : {std::pair{i, j}, std::pair{j, i}})
      if (!kind[to_size(from)].erase(to)) kind[to_size(from)].insert(to);
  }
  void set_row(LevelRows& rows, std::int32_t v) const {
    const auto set = [&](SweepRows& part, const std::set<std::int32_t>& links) {
      std::vector<std::int32_t> columns(links.begin(), links.end());
      columns.push_back(v);
      if (!is_there[to_size(v)]) columns.clear();
      part.set(to_size(v), columns);
    };
    set(rows.blocks, blocks[to_size(v)]);
    set(rows.scalars, scalars[to_size(v)]);
  }
  /// Per vertex: the least one of its piece, by passes over all links until none changes.
  std::vector<std::int32_t> least() const {
    std::vector<std::int32_t> all(blocks.size());
    std::iota(all.begin(), all.end(), 0);
    for (auto before = std::vector<std::int32_t>(); before != all;) {
      before = all;
      for (std::size_t i = 0; i < all.size(); ++i)
        for (const auto* kind : {&blocks, &scalars})
          for (const std::int32_t j : (*kind)[i]) all[i] = std::min(all[i], all[to_size(j)]);
    }
    return all;
  }
};

TEST(SmallPieces, FollowWhatIsLinked) {
  constexpr std::int32_t n = 400;
  Random random(11);
  const auto draw = [&] { return to_int32(random.below(n)); };
  Links links(n);
  std::vector<std::uint8_t> held(2 * n, 0);
  for (int k = 0; k < 3; ++k) held[2 * random.below(n)] = 1;  // one coordinate: the piece is free all the same
  for (const std::size_t v : {5u, 77u}) held[2 * v] = held[2 * v + 1] = 1;
  LevelRows rows;
  rows.resize(n);
  SmallPieces<2> pieces;
  std::vector<bool> before(n, false);
  int small = 0, large = 0, left = 0;
  for (std::size_t round = 0; round < scaled(300); ++round) {
    std::set<std::int32_t> changed;  // the first time, many
    for (std::size_t k = 0; k < (round == 0 ? 250 : 1 + 4 * (round % 3)); ++k) {
      const std::int32_t i = draw(), j = (i + 1 + to_int32(random.below(12))) % n;
      if (!links.is_there[to_size(i)] || !links.is_there[to_size(j)]) continue;
      links.turn(i, j);
      changed.insert({i, j});
    }
    if (round % 5 == 0) {  // a vertex goes, or comes back
      const std::int32_t v = draw();
      for (auto* kind : {&links.blocks, &links.scalars})
        for (const std::int32_t j : std::set<std::int32_t>((*kind)[to_size(v)])) {
          links.turn(v, j);
          changed.insert(j);
        }
      links.is_there[to_size(v)] ^= 1;
      changed.insert(v);
    }
    if (round == 0)
      for (std::int32_t v = 0; v < n; ++v) changed.insert(v);
    for (const std::int32_t v : changed) links.set_row(rows, v);
    const auto moved = pieces.follow(rows, held, std::vector<std::int32_t>(changed.begin(), changed.end()));
    const std::set<std::int32_t> all_moved(moved.begin(), moved.end());
    const auto least = links.least();
    for (std::int32_t v = 0; v < n; ++v) {
      const std::int32_t piece = least[to_size(v)];
      const bool is_held = piece == least[5] || piece == least[77],
                 is_large = std::count(least.begin(), least.end(), piece) > to_index(SmallPieces<2>::most_vertices),
                 is_small = links.is_there[to_size(v)] && !is_held && !is_large;
      ASSERT_EQ(pieces.holds(to_size(v)), is_small) << "round " << round << ", vertex " << v;
      ASSERT_TRUE(before[to_size(v)] == is_small || all_moved.contains(v));
      left += before[to_size(v)] && !is_small;
      before[to_size(v)] = is_small;
      small += is_small;
      large += !is_held && is_large;
    }
  }
  EXPECT_GT(small, 0);
  EXPECT_GT(large, 0);
  EXPECT_GT(left, 0);
}

/// A free triangle with slivers along its edges: what the matrix did to it is taken back, and a piece that is too large
/// is left to the cycle, which leaves the triangle alone.
TEST(SmallPieces, AreSolvedExactly) {
  Body<3> body(make_sheet("grid", 30), skin, {.bending = BendingKind::patches}, held_left());
  ASSERT_EQ(body.cut(polygon({{0.22, 0.223}, {0.3, 0.23}, {0.26, 0.3001}}), "conventional_split"), Status::ok);
  ASSERT_EQ(body.cut(polygon({{0.5, 0.5}, {0.9, 0.52}, {0.7, 0.9}}), "conventional_split"), Status::ok);
  body.model.rotate(bent(body.model, body.sheet));
  body.model.assemble(1, 1e-3);
  const SystemMatrix<3> a = body.model.system();
  Multigrid<3> multigrid;
  multigrid.setup(a);
  const auto n = to_index(3 * a.vertices());
  Field x, b(n), y = Field::Zero(n), z = Field::Zero(n);
  project(*a.held, random_field(3, n), x);
  a.multiply(x, b);
  Field r = b;
  multigrid.solve_apart(b, y, r);
  multigrid.apply(b, z);
  std::size_t exact = 0;
  for (std::size_t i = 0; i < a.vertices(); ++i) {
    const auto at = [i](Field& field) { return field.segment<3>(to_index(3 * i)); };
    const bool is_apart = !at(y).isZero(0);
    exact += is_apart;
    EXPECT_LE((at(y) - at(x)).norm(), is_apart ? 1e-8 * at(x).norm() : at(x).norm());
    EXPECT_EQ(at(r).isZero(0), is_apart || at(b).isZero(0));
    EXPECT_EQ(at(z).isZero(0), is_apart || at(x).isZero(0));
  }
  EXPECT_GT(exact, 10u);
  EXPECT_LE(exact, SmallPieces<3>::most_vertices);
}

}  // namespace
}  // namespace cutbench
