#include "harness/fem/constraints/with_seams.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "harness/mesh/seams.h"

namespace cutbench {

namespace {

using Row = std::map<DeformedIndex, double>;

/// Rows in which a master may be constrained itself.
class Rows {
 public:
  void set(DeformedIndex vertex, const std::array<DeformedIndex, 3>& masters, const std::array<double, 3>& weights) {
    Row& row = rows_[vertex];
    row.clear();
    for (std::size_t k = 0; k < 3; ++k)
      if (weights[k] != 0) row[masters[k]] += weights[k];
  }

  /// Masters that are in no row. Rows that lead back to themselves are cut off: `steps` is as many as there can be.
  void add(DeformedIndex vertex, double weight, int steps, Row& to) const {
    const auto found = rows_.find(vertex);
    if (found == rows_.end()) {
      to[vertex] += weight;
    } else if (steps > 0) {
      for (const auto& [master, share] : found->second) add(master, weight * share, steps - 1, to);
    }
  }

  Constraint resolved(DeformedIndex vertex) const {
    constexpr int most_steps = 8;
    Row row;
    add(vertex, 1, most_steps, row);
    std::vector<std::pair<DeformedIndex, double>> heaviest(row.begin(), row.end());
    std::stable_sort(heaviest.begin(), heaviest.end(),
                     [](const auto& a, const auto& b) { return std::abs(a.second) > std::abs(b.second); });
    heaviest.resize(std::min<std::size_t>(3, heaviest.size()));
    double sum = 0;
    for (const auto& [master, weight] : heaviest) sum += weight;
    Constraint result{vertex, {}, {}};
    for (std::size_t k = 0; k < heaviest.size(); ++k) {
      result.masters[k] = heaviest[k].first;
      result.weights[k] = row.size() > 3 ? heaviest[k].second / sum : heaviest[k].second;
    }
    return result;
  }

 private:
  std::map<DeformedIndex, Row> rows_;
};

}  // namespace

Constraints with_seams(const Constraints& own, const Sheet& sheet, std::span<const std::uint8_t> pinned) {
  std::vector<std::uint8_t> rank(sheet.deformed_slots(), 1);
  for (const Constraint& constraint : own.constraints) rank[constraint.vertex()] = 0;
  for (std::size_t d = 0; d < rank.size(); ++d)
    if (d < pinned.size() && pinned[d] != 0) rank[d] = pinned_rank;
  Rows rows;
  std::map<DeformedIndex, bool> is_seam;
  for (const Constraint& c : own.constraints) {
    rows.set(c.vertex, c.masters, c.weights);
    is_seam[c.vertex] = false;
  }
  for (const SeamTie& tie : seam_ties(sheet, rank)) {
    rows.set(tie.vertex, {tie.masters[0], tie.masters[1], DeformedIndex()}, {tie.weights[0], tie.weights[1], 0});
    is_seam[tie.vertex] = true;
  }
  Constraints all = own;
  all.constraints.clear();
  for (const bool seams : {false, true})
    for (const auto& [vertex, of_seam] : is_seam)
      if (of_seam == seams) all.constraints.push_back(rows.resolved(vertex));
  return all;
}

}  // namespace cutbench
