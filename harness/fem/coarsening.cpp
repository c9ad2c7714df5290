#include "harness/fem/coarsening.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

namespace cutbench {

namespace {

constexpr double sqrt3 = std::numbers::sqrt3;
constexpr float least_weight = 1e-5F;      // below it, a hat is taken for zero
constexpr double farthest_node = 1 << 29;  // a node's number fits 32 bits

std::int64_t node_key(std::int64_t i, std::int64_t j) { return j * (std::int64_t{1} << 32) + i; }

Point2 node_place(std::int64_t node, double spacing) {
  const auto i = static_cast<std::int32_t>(node);  // the lower half, with its sign
  const std::int64_t j = (node - i) >> 32;
  return {spacing * (static_cast<double>(i) + 0.5 * static_cast<double>(j)),
          spacing * sqrt3 / 2 * static_cast<double>(j)};
}

}  // namespace

void SparseRows::add_row(std::span<const std::int32_t> columns, std::vector<std::int32_t>& order) {
  // Which side a column is on is a coin toss: branches would cost more than writing everything twice.
  const auto own = static_cast<std::int32_t>(size());
  const auto n = static_cast<std::int32_t>(columns.size());
  order.resize(2 * columns.size() + 2);
  std::int32_t below = 0, above = n + 1, at = -1;
  for (std::int32_t k = 0; k < n; ++k) {
    const std::int32_t j = columns[static_cast<std::size_t>(k)];
    order[static_cast<std::size_t>(below)] = order[static_cast<std::size_t>(above)] = k;
    below += j<own, above += j> own;
    at = j == own ? k : at;
  }
  if (at >= 0) order[static_cast<std::size_t>(below++)] = at;
  std::copy(order.begin() + n + 1, order.begin() + above, order.begin() + below);
  order.resize(columns.size());
  for (const std::int32_t k : order) column.push_back(columns[static_cast<std::size_t>(k)]);
  end_row();
}

/// The hats that are not zero at each unknown: those of the corners of its lattice triangle.
void Coarsening::enter(const SparseRows& links, const std::vector<Point2>& places, double spacing) {
  entries_.clear();
  for (std::size_t v = 0; v < places.size(); ++v) {
    const double b = places[v].y / (spacing * sqrt3 / 2), a = places[v].x / spacing - b / 2;
    if (links[v].empty() || !(std::abs(a) < farthest_node && std::abs(b) < farthest_node)) continue;
    const auto i = static_cast<std::int64_t>(std::floor(a)), j = static_cast<std::int64_t>(std::floor(b));
    const double f = a - static_cast<double>(i), g = b - static_cast<double>(j);
    const auto add = [&](std::int64_t di, std::int64_t dj, double weight) {
      if (const auto w = static_cast<float>(weight); w > least_weight)
        entries_.push_back({node_key(i + di, j + dj), static_cast<std::int32_t>(v), w});
    };
    const bool lower = f + g < 1;
    add(lower ? 0 : 1, lower ? 0 : 1, std::abs(1 - f - g));
    add(1, 0, lower ? f : 1 - g);
    add(0, 1, lower ? g : 1 - f);
  }
  std::sort(entries_.begin(), entries_.end(),
            [](const Entry& a, const Entry& b) { return std::tie(a.node, a.fine) < std::tie(b.node, b.fine); });
}

/// Makes a coarse unknown of each linked part of a node's members.
void Coarsening::divide(const SparseRows& links, std::span<const Entry> members, Point2 place) {
  joined_.reset(members.size());
  for (std::size_t k = 0; k < members.size(); ++k)
    in_group_[static_cast<std::size_t>(members[k].fine)] = static_cast<std::int32_t>(k);
  for (std::size_t k = 0; k < members.size(); ++k)
    for (const std::int32_t other : links[static_cast<std::size_t>(members[k].fine)])
      if (const std::int32_t l = in_group_[static_cast<std::size_t>(other)]; l > static_cast<std::int32_t>(k))
        joined_.join(k, static_cast<std::size_t>(l));
  part_.resize(members.size());
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (joined_.find(k) == k) part_[k] = static_cast<std::int32_t>(places_.size()), places_.push_back(place);
    part_[k] = part_[joined_.find(k)];
  }
  for (const Entry& member : members) in_group_[static_cast<std::size_t>(member.fine)] = -1;
}

void Coarsening::build(const SparseRows& links, const std::vector<Point2>& places, double spacing,
                       const SparseRows& groups) {
  enter(links, places, spacing);
  places_.clear(), in_group_.assign(places.size(), -1);
  member_begin_.clear(), parent_begin_.assign(places.size() + 1, 0);
  std::vector<std::int32_t> coarse_of(entries_.size());
  for (std::size_t first = 0, last = 0; first < entries_.size(); first = last) {
    while (last < entries_.size() && entries_[last].node == entries_[first].node) ++last;
    divide(links, {entries_.data() + first, last - first}, node_place(entries_[first].node, spacing));
    std::copy(part_.begin(), part_.end(), coarse_of.begin() + static_cast<std::ptrdiff_t>(first));
  }
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const std::int32_t v : groups[g])
      entries_.push_back({0, v, 1}), coarse_of.push_back(static_cast<std::int32_t>(places_.size()));
    places_.push_back({std::numeric_limits<double>::quiet_NaN(), 0});  // the coarser levels have nothing like it
  }
  // Both directions, by counting: entries are sorted by node and vertex.
  member_begin_.assign(places_.size() + 1, 0);
  for (std::size_t e = 0; e < entries_.size(); ++e) {
    ++member_begin_[static_cast<std::size_t>(coarse_of[e]) + 1];
    ++parent_begin_[static_cast<std::size_t>(entries_[e].fine) + 1];
  }
  for (auto* begin : {&member_begin_, &parent_begin_})
    for (std::size_t i = 1; i < begin->size(); ++i) (*begin)[i] += (*begin)[i - 1];
  members_.resize(entries_.size()), parents_.resize(entries_.size());
  std::vector<std::int32_t> next_member(member_begin_), next_parent(parent_begin_);
  for (std::size_t e = 0; e < entries_.size(); ++e) {
    const auto fine = static_cast<std::size_t>(entries_[e].fine), coarse = static_cast<std::size_t>(coarse_of[e]);
    members_[static_cast<std::size_t>(next_member[coarse]++)] = {entries_[e].fine, entries_[e].weight};
    parents_[static_cast<std::size_t>(next_parent[fine]++)] = {coarse_of[e], entries_[e].weight};
  }
}

/// Finds the rows one by one. Calls add(member, entry, parent, place) for each product that goes to a place in the row at
/// hand, and add.end(order) when the row is complete.
template <class Add>
void Coarsening::coarse_rows(const SparseRows& fine, SparseRows& coarse, const Add& add) {
  coarse.clear();
  place_.assign(coarse_size(), -1);
  for (std::size_t i = 0; i < coarse_size(); ++i) {
    columns_.clear();
    for (const Weight& member : members(i)) {
      auto entry = static_cast<std::size_t>(fine.begin[static_cast<std::size_t>(member.other)]);
      for (const std::int32_t j : fine[static_cast<std::size_t>(member.other)]) {
        for (const Weight& parent : parents(static_cast<std::size_t>(j))) {
          auto& place = place_[static_cast<std::size_t>(parent.other)];
          if (place < 0) place = static_cast<std::int32_t>(columns_.size()), columns_.push_back(parent.other);
          add(static_cast<std::size_t>(place), member, entry, parent);
        }
        ++entry;
      }
    }
    coarse.add_row(columns_, order_);
    for (const std::int32_t j : columns_) place_[static_cast<std::size_t>(j)] = -1;
    add.end(order_);
  }
}

void Coarsening::coarse_pattern(const SparseRows& fine, SparseRows& coarse) {
  struct {
    void operator()(std::size_t, const Weight&, std::size_t, const Weight&) const {}
    void end(const std::vector<std::int32_t>&) const {}
  } nothing;
  coarse_rows(fine, coarse, nothing);
}

void Coarsening::multiply(const SparseRows& fine, const std::vector<double>& values, SparseRows& coarse,
                          std::vector<double>& product) {
  product.clear();
  struct Sum {
    const std::vector<double>& values;
    std::vector<double>&sums, &product;
    void operator()(std::size_t place, const Weight& member, std::size_t entry, const Weight& parent) const {
      if (place == sums.size()) sums.push_back(0);
      sums[place] += double(member.weight) * double(parent.weight) * values[entry];
    }
    void end(const std::vector<std::int32_t>& order) const {
      for (const std::int32_t k : order) product.push_back(sums[static_cast<std::size_t>(k)]);
      sums.clear();
    }
  };
  sums_.clear();
  coarse_rows(fine, coarse, Sum{values, sums_, product});
}

}  // namespace cutbench
