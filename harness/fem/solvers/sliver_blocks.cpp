#include "harness/fem/solvers/sliver_blocks.h"

#include <algorithm>
#include <tuple>

#include "harness/base/conversions.h"

namespace cutbench {

template <int D>
void SliverBlocks<D>::find_groups(const CoupledElements& elements) {
  joins_.clear();
  elements.add_strong_couplings(good_aspect_ratio, joins_);
  std::sort(joins_.begin(), joins_.end(), [](const StrongCoupling& one, const StrongCoupling& other) {
    return std::tuple(-one.weight, one.a, one.b) < std::tuple(-other.weight, other.a, other.b);
  });
  for (const StrongCoupling& join : joins_) {
    if (joined_.find(join.a) != joined_.find(join.b) &&
        joined_.size(join.a) + joined_.size(join.b) <= to_size(largest_group))
      joined_.join(join.a, join.b);
  }
}

template <int D>
void SliverBlocks<D>::setup(const SystemMatrix<D>& a) {
  groups_.clear();
  gathered_.resize(D * largest_group);
  if (!a.elements) return;
  joined_.reset(a.vertices());
  group_.assign(a.vertices(), -1);
  place_.resize(a.vertices());
  find_groups(*a.elements);
  for (const StrongCoupling& join : joins_)
    for (const std::int32_t v : {join.a, join.b}) {
      const std::size_t top = joined_.find(v);
      if (joined_.size(v) == 1) continue;  // every join was left out
      auto& group = group_[top];
      if (group < 0) {
        group = to_int32(groups_.size());
        groups_.emplace_back();
      }
      // The entry of the smallest vertex of the class numbers the group before that vertex itself is met.
      auto& vertices = groups_[to_size(group)].vertices;
      group_[to_size(v)] = group;
      vertices.push_back(v);
    }
  for (auto& group : groups_) {
    auto& v = group.vertices;
    std::sort(v.begin(), v.end());
    v.erase(std::unique(v.begin(), v.end()), v.end());
    factor(a, group);
  }
  std::erase_if(groups_, [](const Group& group) { return group.factor.info() != Eigen::Success; });
}

template <int D>
void SliverBlocks<D>::factor(const SystemMatrix<D>& a, Group& group) {
  const Eigen::Index n = to_index(group.vertices.size());
  for (Eigen::Index k = 0; k < n; ++k) place_[to_size(group.vertices[to_size(k)])] = to_int32(k);
  const std::int32_t own = group_[to_size(group.vertices.front())];
  block_.setZero(D * n, D * n);
  // Calls entry(row, column, slot) for the blocks of a part whose row and column are in the group.
  const auto visit = [&](const auto& part, const auto& entry) {
    for (Eigen::Index k = 0; k < n; ++k) {
      const auto i = to_size(group.vertices[to_size(k)]);
      std::int32_t slot = part.first_slot(i);
      for (const std::int32_t j : part.columns(i)) {
        if (group_[to_size(j)] == own) entry(D * k, D * place_[to_size(j)], slot);
        ++slot;
      }
    }
  };
  visit(*a.blocks, [&](Eigen::Index row, Eigen::Index column, std::int32_t slot) {
    block_.template block<D, D>(row, column) += a.blocks->block(slot);
  });
  for (const auto& term : a.scalar)
    visit(*term.matrix, [&](Eigen::Index row, Eigen::Index column, std::int32_t slot) {
      block_.template block<D, D>(row, column).diagonal().array() += term.factor * term.matrix->block(slot)(0);
    });
  for (Eigen::Index u = 0; u < D * n; ++u) {
    const std::int32_t v = group.vertices[to_size(u / D)];
    if (!(*a.held)[to_size(D * v + u % D)]) continue;
    block_.row(u).setZero();
    block_.col(u).setZero();
    block_(u, u) = 1;
  }
  group.factor.compute(block_);
}

template <int D>
void SliverBlocks<D>::apply(const Field& r, Field& z) {
  for (const Group& group : groups_) {
    const auto n = to_index(group.vertices.size());
    auto gathered = gathered_.head(D * n);
    for (Eigen::Index k = 0; k < n; ++k)
      gathered.template segment<D>(D * k) = r.segment<D>(D * group.vertices[to_size(k)]);
    group.factor.matrixL().solveInPlace(gathered);
    group.factor.matrixU().solveInPlace(gathered);
    for (Eigen::Index k = 0; k < n; ++k)
      z.segment<D>(D * group.vertices[to_size(k)]) = gathered.template segment<D>(D * k);
  }
}

template class SliverBlocks<2>;
template class SliverBlocks<3>;

}  // namespace cutbench
