// The order of sweeps: bands that are swept at the same time are not coupled, also after cuts.
#include "harness/fem/multigrid/sweep_order.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "harness/fem/multigrid/multigrid.h"
#include "tests/multigrid_helpers.h"
#include "tests/random_field.h"

namespace cutbench {
namespace {

/// The rows of a sheet under the knife.
struct Followed {
  explicit Followed(const MeshData& mesh) : body(mesh, skin, {.bending = BendingKind::patches}, held_left()) {
    read();
    swept.follow(rows);
    order.follow(rows, swept);
  }
  /// \return  the rows that are different
  std::vector<std::int32_t> read() {
    const SystemMatrix<3> a = body.model.system();
    rows.resize(a.vertices());
    std::vector<std::int32_t> changed;
    for (std::size_t i = 0; i < a.vertices(); ++i) {
      const bool is_new = rows.blocks.set(i, a.blocks->columns(i)).is_new;
      const BlockMatrix<1>& bending = body.model.bending()->matrix();
      std::vector<double> values;
      for (std::size_t k = 0; k < bending.columns(i).size(); ++k)
        values.push_back(bending.block(bending.first_slot(i) + to_int32(k))(0));
      if (rows.set_scalars(i, bending.columns(i), values) || is_new) changed.push_back(to_int32(i));
    }
    return changed;
  }
  void cut(const Curve& curve, const std::string& method) {
    ASSERT_EQ(body.cut(curve, method), Status::ok);
    const auto changed = read();
    swept.follow(rows, changed);
    std::vector<std::uint8_t> came_first = before_each();
    const auto packed = order.follow(rows, swept, changed);
    const std::set<std::int32_t> listed(packed.begin(), packed.end());
    EXPECT_EQ(listed.size(), packed.size());
    for (const std::int32_t i : changed) EXPECT_TRUE(listed.count(i));
    // A row whose entries come in another order is listed.
    std::size_t slot = 0;
    for (std::size_t i = 0; i < links.size(); ++i)
      for (const std::int32_t j : links[i])
        EXPECT_TRUE(order.is_before(j, to_int32(i)) == (came_first[slot++] != 0) || listed.count(to_int32(i)));
  }
  /// For each coupling of each row, whether it comes first; lists them in `links`.
  std::vector<std::uint8_t> before_each() {
    links.clear();
    std::vector<std::uint8_t> all;
    for (std::size_t i = 0; i < last_size; ++i) {
      const auto columns = rows.blocks[i];
      auto& mine = links.emplace_back();
      for (const std::int32_t j : columns) {
        if (to_size(j) >= last_size) continue;
        mine.push_back(j);
        all.push_back(order.is_before(j, to_int32(i)));
      }
    }
    return all;
  }
  void expect_right() {
    last_size = rows.size();
    std::vector<int> band(rows.size(), -1), times(rows.size());
    int next = 0;
    std::vector<std::int32_t> in_order;
    for (const std::size_t turn : {0, 1})
      for (const auto& rows_of_band : order.bands(turn)) {
        for (const std::int32_t i : rows_of_band) band[to_size(i)] = 2 * next + to_int(turn);
        in_order.insert(in_order.end(), rows_of_band.begin(), rows_of_band.end());
        ++next;
      }
    in_order.insert(in_order.end(), order.rest().begin(), order.rest().end());
    for (const std::int32_t i : in_order) ++times[to_size(i)];
    EXPECT_EQ(times, std::vector<int>(rows.size(), 1));
    std::vector<std::size_t> place(rows.size());
    for (std::size_t k = 0; k < in_order.size(); ++k) place[to_size(in_order[k])] = k;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const auto check = [&](std::int32_t j) {
        const int mine = band[i], other = band[to_size(j)];
        EXPECT_TRUE(mine == other || mine < 0 || other < 0 || (mine - other) % 2 != 0) << i << " " << j;
        EXPECT_EQ(order.is_before(j, to_int32(i)), place[to_size(j)] < place[i]);
      };
      for (const std::int32_t j : rows.blocks[i]) check(j);
      for (const std::int32_t j : swept.rows()[i]) check(j);
    }
  }

  Body<3> body;
  LevelRows rows;
  SweptScalars swept;
  SweepOrder order;
  std::size_t last_size = 0;
  std::vector<std::vector<std::int32_t>> links;
};

const std::vector<Curve> cuts{line({0.2, 0.31}, {0.9, 0.52}), line({0.5, 0.1}, {0.61, 0.93}),
                              polygon({{0.22, 0.63}, {0.41, 0.64}, {0.33, 0.81}}), line({0.51, -0.1}, {0.53, 1.1})};

TEST(SweepOrder, SmallLevelsGoByNumber) {
  Followed sheet(make_sheet("grid", 20));
  sheet.cut(cuts[0], "conventional_split");
  sheet.expect_right();
  EXPECT_TRUE(sheet.order.bands(0).empty());
  for (std::size_t k = 0; k < sheet.order.rest().size(); ++k) EXPECT_EQ(sheet.order.rest()[k], to_int32(k));
}

TEST(SweepOrder, BandsAreNotCoupled) {
  for (const std::string method : {"conventional_split", "warp_and_refine", "element_deletion", "delaunay_refine"}) {
    SCOPED_TRACE(method);
    Followed sheet(make_sheet("grid", 50));
    ASSERT_FALSE(sheet.order.bands(0).empty());
    EXPECT_TRUE(sheet.order.rest().empty());
    sheet.expect_right();
    for (const Curve& curve : cuts) {
      sheet.cut(curve, method);
      sheet.expect_right();
    }
    EXPECT_LT(20 * sheet.order.rest().size(), sheet.rows.size());  // new rows have found a band
  }
}

/// Levels that follow the cuts are as good as new ones, and symmetric.
TEST(SweepOrder, MultigridFollows) {
  Body<3> body(make_sheet("grid", 40), skin, {.bending = BendingKind::patches}, held_left());
  Multigrid<3> kept;
  for (const Curve& curve : cuts) {
    ASSERT_EQ(body.cut(curve, "conventional_split"), Status::ok);
    body.model.rotate(bent(body.model, body.sheet));
    body.model.assemble(1, 1e-4);
    const SystemMatrix<3> a = body.model.system();
    kept.setup(a);
    Multigrid<3> fresh;
    fresh.setup(a);
    const auto n = to_index(3 * a.vertices());
    Field u, v, bu = Field::Zero(n), bv = Field::Zero(n), fresh_bu = Field::Zero(n);
    project(*a.held, random_field(1, n), u);
    project(*a.held, random_field(2, n), v);
    kept.apply(u, bu);
    kept.apply(v, bv);
    fresh.apply(u, fresh_bu);
    const double scale = std::sqrt(u.dot(bu) * v.dot(bv));
    EXPECT_LT(std::abs(u.dot(bv) - v.dot(bu)), 1e-5 * scale);
    Field ax;
    a.multiply(bu, ax);
    const double left = (u - ax).norm();
    a.multiply(fresh_bu, ax);
    EXPECT_LT(left, 1.2 * (u - ax).norm());
  }
}

}  // namespace
}  // namespace cutbench
