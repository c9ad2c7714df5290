#include "harness/fem/multigrid/coarsening.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

constexpr double sqrt3 = std::numbers::sqrt3;
constexpr float least_weight = 1e-5F;                                          // below it, a hat is taken for zero
constexpr double farthest_node = 1 << 29;                                      // a node's number fits 32 bits
constexpr std::int64_t group_node = std::numeric_limits<std::int64_t>::max();  // no lattice node has this key

std::int64_t node_key(std::int64_t i, std::int64_t j) { return j * (std::int64_t{1} << 32) + i; }

Point2 node_place(std::int64_t node, double spacing) {
  if (node == group_node) return {std::numeric_limits<double>::quiet_NaN(), 0};  // coarser levels have nothing like it
  const auto i = to_int32(node);                                                 // the lower half, with its sign
  const std::int64_t j = (node - i) >> 32;
  return {spacing * (to_double(i) + 0.5 * to_double(j)), spacing * sqrt3 / 2 * to_double(j)};
}

}  // namespace

// --- numbers of coarse unknowns --------------------------------------------------------------------------------------

std::int32_t Coarsening::new_coarse(Node node) {
  auto coarse = to_int32(places_.size());
  if (free_.empty()) {
    places_.emplace_back();
    node_.emplace_back();
    next_part_.emplace_back();
    members_.resize(places_.size());
    for (Marks* marks : {&is_named_, &is_renumbered_, &is_touched_, &has_touched_blocks_}) marks->grow(places_.size());
  } else {
    coarse = free_.back();
    free_.pop_back();
  }
  is_renumbered_.insert(coarse);
  touch_blocks(coarse);
  const auto c = to_size(coarse);
  places_[c] = node_place(node, spacing_);
  node_[c] = node;
  next_part_[c] = -1;
  if (node == group_node) return coarse;
  const auto [first, is_only] = first_part_.try_emplace(node, coarse);
  if (!is_only) next_part_[c] = std::exchange(first->second, coarse);
  return coarse;
}

/// \pre it is in no node's list of parts any more.
void Coarsening::free_coarse(std::int32_t coarse) {
  members_.set(to_size(coarse), {});
  places_[to_size(coarse)] = node_place(group_node, spacing_);
  free_.push_back(coarse);
  is_renumbered_.insert(coarse);
  touch_blocks(coarse);
}

std::int32_t Coarsening::part_of(std::int32_t fine, Node node) const {
  for (const Weight& parent : parents(to_size(fine)))
    if (node_[to_size(parent.other)] == node) return parent.other;
  return -1;
}

std::int32_t Coarsening::group_of(std::size_t fine) const {
  return fine < fine_size() ? part_of(to_int32(fine), group_node) : -1;
}

// --- update ----------------------------------------------------------------------------------------------------------

void Coarsening::update(const FineRows& fine, const std::vector<Point2>& places, const RowChanges& changes,
                        const Regrouping& regrouping) {
  begin(fine.size());
  regroup(regrouping);
  for (const std::int32_t v : changes.links) {
    const bool is_there = !fine.blocks[to_size(v)].empty();
    place(v, is_there ? hats(v, places[to_size(v)]) : std::span<const Entry>());
  }
  find_members();
  for (auto first = entries_.begin(), last = first; first != entries_.end(); first = last) {
    last = std::find_if(first, entries_.end(), [&](const Entry& entry) { return entry.node != first->node; });
    divide(fine, {&*first, to_size(last - first)});
  }
  for (const Node node : nodes_)  // that have no members any more
    if (!std::binary_search(entries_.begin(), entries_.end(), Entry{node, 0, 0},
                            [](const Entry& a, const Entry& b) { return a.node < b.node; }))
      free_parts(node);
  find_touched(fine, changes);
}

void Coarsening::begin(std::size_t fine_size) {
  parents_.resize(fine_size);
  place_in_node_.resize(fine_size, -1);
  for (Marks* marks : {&is_placed_, &has_new_parents_, &is_listed_, &is_listed_for_blocks_}) marks->clear(fine_size);
  for (Marks* marks : {&is_named_, &is_renumbered_, &is_touched_, &has_touched_blocks_}) marks->clear(coarse_size());
  nodes_.clear();
  with_new_parents_.clear();
  entries_.clear();
  touched_.clear();
}

void Coarsening::regroup(const Regrouping& regrouping) {
  const auto changes = [&](std::int32_t v) {
    if (has_new_parents_.insert(v)) with_new_parents_.push_back(v);
  };
  for (const std::int32_t v : regrouping.members) {
    const std::int32_t group = part_of(v, group_node);
    if (group < 0) continue;
    for (const Weight& member : members(to_size(group))) {
      parents_.erase(to_size(member.other), {group, 1});
      changes(member.other);
    }
    free_coarse(group);
  }
  for (const auto& group : regrouping.groups) {
    const std::int32_t coarse = new_coarse(group_node);
    part_members_.clear();
    for (const std::int32_t v : group) {
      part_members_.push_back({v, 1});
      parents_.append(to_size(v), {coarse, 1});
      changes(v);
    }
    members_.set(to_size(coarse), part_members_);
  }
}

/// The unknown's nodes are to be divided again. Where its hats are others, it leaves its nodes and enters theirs: of
/// its parents, only its group is left.
void Coarsening::place(std::int32_t fine, std::span<const Entry> hats) {
  const auto v = to_size(fine);
  const std::int32_t group = part_of(fine, group_node);
  for (const Weight& parent : parents(v))
    if (parent.other != group) nodes_.push_back(node_[to_size(parent.other)]);
  const auto is_old = [&](const Entry& hat) {
    const auto is_hat = [&](const Weight& parent) {
      return node_[to_size(parent.other)] == hat.node && parent.weight == hat.weight;
    };
    return std::any_of(parents(v).begin(), parents(v).end(), is_hat);
  };
  if (hats.size() + (group < 0 ? 0 : 1) == parents(v).size() && std::all_of(hats.begin(), hats.end(), is_old)) return;
  const Weight kept{group, 1};
  parents_.set(v, {&kept, group < 0 ? 0u : 1u});
  is_placed_.insert(fine);
  if (has_new_parents_.insert(fine)) with_new_parents_.push_back(fine);
  for (const Entry& hat : hats) {
    entries_.push_back(hat);
    nodes_.push_back(hat.node);
  }
}

auto Coarsening::hats(std::int32_t fine, Point2 place) -> std::span<const Entry> {
  hats_.clear();
  const double b = place.y / (spacing_ * sqrt3 / 2), a = place.x / spacing_ - b / 2;
  if (!(std::abs(a) < farthest_node && std::abs(b) < farthest_node)) return hats_;
  const auto i = to_int64(std::floor(a)), j = to_int64(std::floor(b));
  const double f = a - to_double(i), g = b - to_double(j);
  const auto add = [&](std::int64_t di, std::int64_t dj, double weight) {
    if (const auto w = static_cast<float>(weight); w > least_weight)
      hats_.push_back({node_key(i + di, j + dj), fine, w});
  };
  const bool lower = f + g < 1;
  add(lower ? 0 : 1, lower ? 0 : 1, std::abs(1 - f - g));
  add(1, 0, lower ? f : 1 - g);
  add(0, 1, lower ? g : 1 - f);
  return hats_;
}

/// Adds what else is in the supports of the nodes' hats.
void Coarsening::find_members() {
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  for (const Node node : nodes_)
    if (const auto first = first_part_.find(node); first != first_part_.end())
      for (std::int32_t part = first->second; part >= 0; part = next_part_[to_size(part)])
        for (const Weight& member : members(to_size(part)))
          if (!is_placed_.holds(member.other)) entries_.push_back({node, member.other, member.weight});
  std::sort(entries_.begin(), entries_.end(),
            [](const Entry& a, const Entry& b) { return std::tie(a.node, a.fine) < std::tie(b.node, b.fine); });
}

/// Makes a coarse unknown of each linked part of a node's members.
void Coarsening::divide(const FineRows& fine, std::span<const Entry> members) {
  joined_.reset(members.size());
  for (std::size_t k = 0; k < members.size(); ++k) place_in_node_[to_size(members[k].fine)] = to_int32(k);
  for (std::size_t k = 0; k < members.size(); ++k)
    for (const std::int32_t other : fine.blocks[to_size(members[k].fine)])
      if (const std::int32_t l = place_in_node_[to_size(other)]; l > to_int32(k)) joined_.join(k, to_size(l));
  for (const Entry& member : members) place_in_node_[to_size(member.fine)] = -1;
  name_parts(members);
  for (std::size_t k = 0; k < members.size(); ++k) {
    if (joined_.find(k) != k) continue;
    const auto is_same = [](const Weight& one, const Weight& other) {
      return one.other == other.other && one.weight == other.weight;
    };
    part_members_.clear();
    for (std::size_t l = k; l < members.size(); ++l)
      if (part_[l] == part_[k]) part_members_.push_back({members[l].fine, members[l].weight});
    const auto before = this->members(to_size(part_[k]));
    if (std::equal(before.begin(), before.end(), part_members_.begin(), part_members_.end(), is_same)) continue;
    members_.set(to_size(part_[k]), part_members_);
    touch_blocks(part_[k]);
  }
}

/// A part keeps the number of the old part that its first member was in, if it is the first to ask for it.
void Coarsening::name_parts(std::span<const Entry> members) {
  const Node node = members.front().node;
  old_parts_.clear();
  if (const auto first = first_part_.find(node); first != first_part_.end()) {
    for (std::int32_t part = first->second; part >= 0; part = next_part_[to_size(part)]) old_parts_.push_back(part);
    first_part_.erase(first);
  }
  part_.assign(members.size(), -1);
  for (std::size_t k = 0; k < members.size(); ++k) {
    std::int32_t& part = part_[joined_.find(k)];
    const std::int32_t before = part_of(members[k].fine, node);
    if (part >= 0 || before < 0 || !is_named_.insert(before)) continue;
    part = before;
    const auto [first, is_only] = first_part_.try_emplace(node, part);
    next_part_[to_size(part)] = is_only ? -1 : std::exchange(first->second, part);
  }
  for (std::size_t k = 0; k < members.size(); ++k) {
    std::int32_t& part = part_[joined_.find(k)];
    if (part < 0) is_named_.insert(part = new_coarse(node));
    part_[k] = part;
    const std::int32_t v = members[k].fine, before = part_of(v, node);
    if (before == part) continue;
    if (before >= 0) parents_.erase(to_size(v), {before, 0});
    parents_.append(to_size(v), {part, members[k].weight});
    if (has_new_parents_.insert(v)) with_new_parents_.push_back(v);
  }
  for (const std::int32_t part : old_parts_)
    if (!is_named_.holds(part)) free_coarse(part);
}

/// \pre the node has no members.
void Coarsening::free_parts(Node node) {
  const auto first = first_part_.find(node);
  if (first == first_part_.end()) return;
  for (std::int32_t part = first->second; part >= 0;) {
    const std::int32_t next = next_part_[to_size(part)];
    free_coarse(part);
    part = next;
  }
  first_part_.erase(first);
}

/// A row of P^T A P depends on its members, on their rows of A, and on the parents of the columns of these. Scalars
/// reach farther than blocks, so most rows that a cut touches have the blocks that they had.
void Coarsening::find_touched(const FineRows& fine, const RowChanges& changes) {
  for (const std::int32_t v : changes.links) touch_blocks_of_parents(v);
  for (const std::int32_t v : changes.rows) touch_parents(v);
  for (const std::int32_t v : with_new_parents_) {
    const auto i = to_size(v);
    touch_blocks_of_parents(v);  // its row may be empty
    for (const std::int32_t other : fine.blocks[i]) touch_blocks_of_parents(other);
    for (const std::int32_t other : fine.scalars[i]) touch_parents(other);
  }
  std::sort(touched_.begin(), touched_.end());
}

void Coarsening::touch(std::int32_t coarse) {
  if (is_touched_.insert(coarse)) touched_.push_back(coarse);
}

void Coarsening::touch_blocks(std::int32_t coarse) {
  has_touched_blocks_.insert(coarse);
  touch(coarse);
}

void Coarsening::touch_parents(std::int32_t fine) {
  if (!is_listed_.insert(fine)) return;
  for (const Weight& parent : parents(to_size(fine))) touch(parent.other);
}

void Coarsening::touch_blocks_of_parents(std::int32_t fine) {
  if (!is_listed_for_blocks_.insert(fine)) return;
  for (const Weight& parent : parents(to_size(fine))) touch_blocks(parent.other);
}

void Coarsening::reserve_spare() {
  parents_.reserve_spare();
  members_.reserve_spare();
  cutbench::reserve_spare(places_, node_, next_part_, place_in_node_);
}

// --- product ---------------------------------------------------------------------------------------------------------

void Coarsening::multiply(const FineRows& fine, LevelRows& coarse) {
  coarse.resize(coarse_size());
  part_row_.resize(fine_size());
  row_.resize(coarse_size());
  changes_.rows.clear();
  changes_.links.clear();
  for (const std::int32_t i : touched_) {
    const bool links = has_touched_blocks_.holds(i) && multiply_blocks(fine.blocks, to_size(i), coarse.blocks),
               scalars = multiply_scalars(fine, to_size(i), coarse);
    if (links || scalars) changes_.rows.push_back(i);
    if (links || is_renumbered_.holds(i)) changes_.links.push_back(i);
  }
}

bool Coarsening::multiply_blocks(const SweepRows& fine, std::size_t coarse, SweepRows& rows) {
  part_row_.clear();
  for (const Weight& member : members(coarse))
    for (const std::int32_t j : fine[to_size(member.other)]) part_row_[j] = 0;
  multiply_part_row();
  return rows.set(coarse, row_.columns()).is_new;
}

bool Coarsening::multiply_scalars(const FineRows& fine, std::size_t coarse, LevelRows& rows) {
  part_row_.clear();
  for (const Weight& member : members(coarse)) {
    const auto v = to_size(member.other);
    const double* value = fine.scalar.data() + fine.scalars.first_slot(v);
    for (const std::int32_t j : fine.scalars[v]) part_row_[j] += double(member.weight) * *value++;
  }
  multiply_part_row();
  return rows.set_scalars(coarse, row_.columns(), row_.sums());
}

/// From a row of P^T A to that of P^T A P. Members are neighbours, so their rows have most columns in common.
void Coarsening::multiply_part_row() {
  row_.clear();
  const auto columns = part_row_.columns();
  const auto sums = part_row_.sums();
  for (std::size_t k = 0; k < columns.size(); ++k)
    for (const Weight& parent : parents(to_size(columns[k]))) row_[parent.other] += double(parent.weight) * sums[k];
}

}  // namespace cutbench
