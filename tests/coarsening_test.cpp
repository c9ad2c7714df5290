// The coarse unknowns of multigrid: parts of hats as a flood fill finds them, dense products, and after cuts what new
// ones are.

#include "harness/fem/multigrid/coarsening.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/base/random.h"
#include "tests/multigrid_helpers.h"

namespace cutbench {
namespace {

RowChanges all_of(const LevelRows& rows) {
  std::vector<std::int32_t> all(rows.size());
  std::iota(all.begin(), all.end(), 0);
  return {all, all};
}

/// The hats' place and value by another way: the distance to the three pairs of lines of a node's hexagon.
double hat(Point2 p, Point2 node, double spacing) {
  double least = 1;
  for (int k = 0; k < 6; ++k) {
    const double angle = k * std::numbers::pi / 3 + std::numbers::pi / 6;
    const double along = (p.x - node.x) * std::cos(angle) + (p.y - node.y) * std::sin(angle);
    least = std::min(least, 1 - along / (spacing * std::sqrt(3) / 2));
  }
  return std::max(0.0, least);
}

TEST(Coarsening, PartsOfHatsAsAFloodFillFindsThem) {
  for (const std::string family : {"grid", "delaunay", "graded"}) {
    SCOPED_TRACE(family);
    const Body<2> body = cut_body<2>(family, 24, BendingKind::none, "conventional_split");
    const SystemMatrix<2> a = body.model.system();
    const LevelRows rows = rows_of(*a.blocks);
    const SweepRows& links = rows.blocks;
    const double spacing = 2.0 / 24;
    Coarsening coarsening(spacing);
    coarsening.update(rows, *a.places, all_of(rows));
    std::size_t divided = 0;
    std::map<std::pair<long, long>, int> parts_at;
    for (std::size_t k = 0; k < coarsening.coarse_size(); ++k) {
      const Point2 node = coarsening.coarse_places()[k];
      divided += ++parts_at[{std::lround(1e6 * node.x), std::lround(1e6 * node.y)}] == 2;
      std::set<std::int32_t> members;
      for (const auto& [v, weight] : coarsening.members(k)) {
        EXPECT_NEAR(weight, hat((*a.places)[to_size(v)], node, spacing), 1e-6);
        members.insert(v);
      }
      std::vector<std::int32_t> front{*members.begin()};
      std::set<std::int32_t> reached(front.begin(), front.end());
      while (!front.empty()) {
        const auto v = to_size(front.back());
        front.pop_back();
        for (const std::int32_t other : links[v])
          if (hat((*a.places)[to_size(other)], node, spacing) > 2e-5 && reached.insert(other).second)
            front.push_back(other);
      }
      EXPECT_EQ(reached, members);
    }
    EXPECT_GT(divided, 10u) << "nodes over an incision";
    for (std::size_t v = 0; v < a.vertices(); ++v) {
      if (links[v].empty()) continue;
      double sum = 0;
      Point2 mean;
      for (const auto& [k, weight] : coarsening.parents(v)) {
        sum += weight;
        mean = mean + double(weight) * coarsening.coarse_places()[to_size(k)];
      }
      EXPECT_NEAR(sum, 1, 1e-4);
      EXPECT_LT(length(mean - (*a.places)[v]), 1e-4 * spacing) << "linear functions are interpolated exactly";
    }
  }
}

TEST(Coarsening, PatternIsThatOfTheProduct) {
  const Body<2> body = cut_body<2>("delaunay", 12, BendingKind::none, "conventional_split");
  const SystemMatrix<2> a = body.model.system();
  LevelRows fine = rows_of(*a.blocks);
  const SweepRows& links = fine.blocks;
  const auto n = to_index(links.size());
  Random random(2);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    std::vector<double> values;
    for (const std::int32_t j : a.blocks->columns(to_size(i))) values.push_back(matrix(i, j) = random.between(-1, 1));
    fine.set_scalars(to_size(i), a.blocks->columns(to_size(i)), values);
  }
  Coarsening coarsening(2.0 / 12);
  coarsening.update(fine, *a.places, all_of(fine), {{}, {{0, 1, 2}}});
  const Eigen::Index group = coarsening.group_of(1);
  ASSERT_GE(group, 0);
  EXPECT_EQ(coarsening.group_of(3), -1);
  const auto m = to_index(coarsening.coarse_size());
  Eigen::MatrixXd p = Eigen::MatrixXd::Zero(n, m), graph = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (const auto& [k, weight] : coarsening.parents(to_size(i))) p(i, k) = 1;
    for (const std::int32_t j : links[to_size(i)]) graph(i, j) = 1;
  }
  for (const Eigen::Index v : {0, 1, 2}) EXPECT_EQ(p(v, group), 1);
  EXPECT_EQ(p.col(group).sum(), 3);
  const Eigen::MatrixXd product = p.transpose() * graph * p;
  Eigen::MatrixXd weights = Eigen::MatrixXd::Zero(n, m);
  for (Eigen::Index i = 0; i < n; ++i)
    for (const auto& [k, weight] : coarsening.parents(to_size(i))) weights(i, k) = double(weight);
  LevelRows coarse;
  coarsening.multiply(fine, coarse);
  const Eigen::MatrixXd exact = weights.transpose() * matrix * weights;
  for (std::size_t i = 0; i < coarse.size(); ++i)
    for (std::size_t k = 0; k < coarse.scalars[i].size(); ++k)
      EXPECT_NEAR(coarse.scalar[coarse.scalars.first_slot(i) + k], exact(to_index(i), coarse.scalars[i][k]), 1e-12);
  for (Eigen::Index i = 0; i < m; ++i) {
    const auto row = coarse.blocks[to_size(i)];
    const auto scalars = coarse.scalars[to_size(i)];
    EXPECT_TRUE(std::is_permutation(row.begin(), row.end(), scalars.begin(), scalars.end()));
    const auto side = [i](std::int32_t j) { return (j > i) - (j < i); };
    EXPECT_TRUE(std::is_sorted(row.begin(), row.end(), [&](auto one, auto other) { return side(one) < side(other); }));
    for (Eigen::Index j = 0; j < m; ++j)
      EXPECT_EQ(std::count(row.begin(), row.end(), to_int32(j)), product(i, j) > 0 ? 1 : 0);
  }
}

/// A coarse unknown by what it is for, not by its number: its members, with their weights.
using Part = std::vector<std::pair<std::int32_t, float>>;

Part part_of(const Coarsening& coarsening, std::size_t coarse) {
  Part part;
  for (const auto& [fine, weight] : coarsening.members(coarse)) part.emplace_back(fine, weight);
  std::sort(part.begin(), part.end());
  return part;
}

/// Rows of the coarse matrix, with its unknowns by their members.
std::map<Part, std::map<Part, double>> product_of(const Coarsening& coarsening, const LevelRows& coarse) {
  std::map<Part, std::map<Part, double>> all;
  for (std::size_t i = 0; i < coarsening.coarse_size(); ++i) {
    if (coarsening.members(i).empty()) {
      EXPECT_TRUE(coarse.blocks[i].empty() && coarse.scalars[i].empty());
      continue;
    }
    auto& row = all[part_of(coarsening, i)];
    for (std::size_t k = 0; k < coarse.scalars[i].size(); ++k)
      row[part_of(coarsening, to_size(coarse.scalars[i][k]))] = coarse.scalar[coarse.scalars.first_slot(i) + k];
    EXPECT_EQ(coarse.blocks[i].size(), coarse.scalars[i].size());
  }
  return all;
}

/// Two coarsenings in a row follow a sheet through cuts, and are what new ones are. All links have the value of one
/// more than the number of the cut after which they came, so that old ones would be noticed.
TEST(Coarsening, FollowsTheCuts) {
  for (const std::string method : {"conventional_split", "warp_and_refine", "bowyer_watson", "element_deletion"}) {
    SCOPED_TRACE(method);
    constexpr double spacing = 2.0 / 30;
    Body<2> body(make_sheet("delaunay", 30), skin, {}, {});
    Coarsening first(spacing), second(2 * spacing);
    LevelRows fine, coarse, coarsest;
    std::uint64_t seen = 0;
    std::size_t n = 0;
    double value = 1;
    std::vector<Point2> places;
    for (const Curve& curve : {line({0.2, 0.31}, {0.9, 0.52}), line({0.5, 0.1}, {0.61, 0.93}),
                               line({0.52, 0.1}, {0.63, 0.93}), line({-0.1, 0.8}, {0.3, 1.1})}) {
      ASSERT_EQ(body.cut(curve, method), Status::ok);
      const SystemMatrix<2> a = body.model.system();
      std::vector<std::int32_t> changed;
      RowChanges changes;
      fine.resize(a.vertices());
      std::set<std::int32_t> marked;
      if (n > 0) {
        const auto since = a.history->changed_since(seen);
        marked.insert(since.begin(), since.end());
      }
      for (std::size_t i = 0; i < a.vertices(); ++i) {
        if (i < n && !marked.contains(to_int32(i))) continue;
        changed.push_back(to_int32(i));
        const bool moves = i < n && length((*a.places)[i] - places[i]) > 0;
        if (fine.blocks.set(i, a.blocks->columns(i)).is_new || moves) changes.links.push_back(to_int32(i));
        if (fine.set_scalars(i, a.blocks->columns(i), std::vector<double>(a.blocks->columns(i).size(), value)))
          changes.rows.push_back(to_int32(i));
      }
      EXPECT_TRUE(n == 0 || 2 * changed.size() < n);
      ++value;
      n = a.vertices();
      seen = a.pattern;
      places = *a.places;
      // Groups that come and go.
      Coarsening::Regrouping regrouping{changed, {}};
      for (std::size_t k = 2; k < changed.size(); k += 17) regrouping.groups.push_back({changed[k - 2], changed[k]});
      first.update(fine, *a.places, changes, regrouping);
      first.multiply(fine, coarse);
      second.update(coarse, first.coarse_places(), first.changes());
      second.multiply(coarse, coarsest);
      EXPECT_TRUE(changed.size() == n || 2 * first.changes().rows.size() < first.coarse_size());

      Coarsening::Regrouping groups;
      for (std::size_t k = 0; k < first.coarse_size(); ++k)
        if (const auto members = first.members(k);
            !members.empty() && first.group_of(to_size(members[0].other)) == to_int32(k))
          groups.groups.push_back({members[0].other, members[1].other});
      Coarsening first_anew(spacing), second_anew(2 * spacing);
      LevelRows coarse_anew, coarsest_anew;
      first_anew.update(fine, *a.places, all_of(fine), groups);
      first_anew.multiply(fine, coarse_anew);
      second_anew.update(coarse_anew, first_anew.coarse_places(), all_of(coarse_anew));
      second_anew.multiply(coarse_anew, coarsest_anew);
      const auto all = product_of(first, coarse), anew = product_of(first_anew, coarse_anew);
      ASSERT_EQ(all.size(), anew.size());
      for (const auto& [part, row] : anew) {
        const auto there = all.find(part);
        ASSERT_TRUE(there != all.end());
        ASSERT_EQ(there->second.size(), row.size());
        for (const auto& [other, sum] : row) ASSERT_NEAR(there->second.at(other), sum, 1e-9);
      }
      // Numbers of coarse unknowns differ: the next level is compared by what it does to a constant and a sum.
      std::multiset<std::size_t> sizes, sizes_anew;
      double total = 0, total_anew = 0;
      for (std::size_t i = 0; i < coarsest.size(); ++i)
        if (!second.members(i).empty()) sizes.insert(coarsest.scalars[i].size());
      for (std::size_t i = 0; i < coarsest_anew.size(); ++i)
        if (!second_anew.members(i).empty()) sizes_anew.insert(coarsest_anew.scalars[i].size());
      for (std::size_t i = 0; i < coarsest.size(); ++i)
        for (std::size_t k = 0; k < coarsest.scalars[i].size(); ++k)
          total += coarsest.scalar[coarsest.scalars.first_slot(i) + k];
      for (std::size_t i = 0; i < coarsest_anew.size(); ++i)
        for (std::size_t k = 0; k < coarsest_anew.scalars[i].size(); ++k)
          total_anew += coarsest_anew.scalar[coarsest_anew.scalars.first_slot(i) + k];
      EXPECT_EQ(sizes, sizes_anew);
      EXPECT_NEAR(total, total_anew, 1e-6 * total_anew);
    }
  }
}

}  // namespace
}  // namespace cutbench
