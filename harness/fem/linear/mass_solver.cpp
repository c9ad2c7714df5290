#include "harness/fem/linear/mass_solver.h"

#include <algorithm>

#include "harness/base/conversions.h"

namespace cutbench {

template <int D>
void MassSolver<D>::setup(const FieldView& lumped, const BlockMatrix<1>& added, const std::vector<std::uint8_t>& held) {
  used_ = 0;
  for (int axis = 0; axis < D; ++axis) {
    Group& group = groups_[used_];
    group.vertices.clear();
    for (std::size_t v = 0; v < added.rows(); ++v)
      if (!added.columns(v).empty() && !held[D * v + to_size(axis)]) group.vertices.push_back(to_int32(v));
    group.axes = {axis};
    const auto same = std::find_if(groups_.begin(), groups_.begin() + to_index(used_),
                                   [&](const Group& other) { return other.vertices == group.vertices; });
    if (same != groups_.begin() + to_index(used_))
      same->axes.push_back(axis);
    else if (!group.vertices.empty())
      ++used_;
  }
  std::vector<int> place(added.rows());
  for (std::size_t g = 0; g < used_; ++g) {
    Group& group = groups_[g];
    const auto n = to_index(group.vertices.size());
    std::fill(place.begin(), place.end(), -1);
    for (Eigen::Index i = 0; i < n; ++i) place[to_size(group.vertices[to_size(i)])] = to_int(i);
    std::vector<Eigen::Triplet<double>> entries;
    for (const std::int32_t v : group.vertices) {
      const auto row = to_size(v);
      entries.emplace_back(place[row], place[row], lumped[v]);
      std::int32_t slot = added.first_slot(row);
      for (const std::int32_t j : added.columns(row)) {
        const int column = place[to_size(j)];
        const double value = added.block(slot++)(0);
        if (column >= 0 && column <= place[row]) entries.emplace_back(place[row], column, value);
      }
    }
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    group.factor.compute(matrix);
    group.values.resize(n, to_index(group.axes.size()));
  }
}

template <int D>
void MassSolver<D>::solve(const Field& p, Field& dv) {
  for (std::size_t g = 0; g < used_; ++g) {
    Group& group = groups_[g];
    const auto each = [&group](const auto& act) {
      for (std::size_t k = 0; k < group.axes.size(); ++k)
        for (std::size_t i = 0; i < group.vertices.size(); ++i)
          act(D * group.vertices[i] + group.axes[k], group.values(to_index(i), to_index(k)));
    };
    each([&](Eigen::Index unknown, double& value) { value = p[unknown]; });
    group.values = group.factor.solve(group.values).eval();
    each([&](Eigen::Index unknown, double& value) { dv[unknown] = value; });
  }
}

template class MassSolver<2>;
template class MassSolver<3>;

}  // namespace cutbench
