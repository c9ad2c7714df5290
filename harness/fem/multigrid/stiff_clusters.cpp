#include "harness/fem/multigrid/stiff_clusters.h"

#include <algorithm>
#include <type_traits>
#include <utility>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

constexpr double stiff = 3;                  // diagonal over the median one
constexpr std::size_t largest_cluster = 48;  // vertices; where more hang together, they are parted

/// The values of a vertex.
template <int D, class Quads>
auto values_at(Quads& field, std::int32_t vertex) {
  auto& quad = field[to_size(vertex)];
  using S = std::remove_cvref_t<decltype(quad[0])>;
  using Values = Eigen::Matrix<S, D, 1>;
  if constexpr (std::is_const_v<Quads>)
    return Eigen::Map<const Values>(reinterpret_cast<const S*>(&quad));
  else
    return Eigen::Map<Values>(reinterpret_cast<S*>(&quad));
}

template <class S, int D>
auto transpose_of(const Eigen::Matrix<S, D, D>& block) {
  return block.transpose();
}
float transpose_of(float scalar) { return scalar; }
double transpose_of(double scalar) { return scalar; }

}  // namespace

template <int D>
void StiffClusters<D>::find(const std::vector<double>& sizes, double median, const LevelRows& rows) {
  clusters_.clear();
  const std::size_t n = rows.size();
  is_stiff_.assign(n, 0);
  place_.resize(n, -1);
  for (std::size_t i = 0; i < n; ++i) is_stiff_[i] = sizes[i] > stiff * median;
  for (std::size_t seed = 0; seed < n; ++seed) {
    if (!is_stiff_[seed]) continue;
    std::vector<std::int32_t> members;
    const auto take = [&](std::size_t i) {
      if (!is_stiff_[i] || members.size() == largest_cluster) return;
      is_stiff_[i] = 0;
      members.push_back(to_int32(i));
    };
    take(seed);
    for (std::size_t k = 0; k < members.size(); ++k) {
      const auto v = to_size(members[k]);
      for (const SweepRows* part : {&rows.blocks, &rows.scalars})
        for (const std::int32_t j : (*part)[v]) take(to_size(j));
    }
    if (members.size() > 1) clusters_.emplace_back().vertices = std::move(members);
  }
  cluster_of_.assign(n, -1);
  for (std::size_t k = 0; k < clusters_.size(); ++k)
    for (const std::int32_t v : clusters_[k].vertices) cluster_of_[to_size(v)] = to_int32(k);
}

template <int D>
template <class S>
void StiffClusters<D>::factor(const PackedRows<D, S>& a, const std::vector<std::uint8_t>& held) {
  smallest_pivot_ = 1;
  for (Cluster& cluster : clusters_) {
    const auto n = to_index(D * cluster.vertices.size());
    cluster.held.clear();
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
    for (std::size_t k = 0; k < cluster.vertices.size(); ++k) place_[to_size(cluster.vertices[k])] = to_int32(k);
    for (std::size_t k = 0; k < cluster.vertices.size(); ++k) {
      const auto v = to_size(cluster.vertices[k]);
      const auto at = to_index(D * k);
      a.for_each_block(v, [&](std::int32_t j, const auto& block) {
        if (const std::int32_t l = place_[to_size(j)]; l >= 0)
          dense.block<D, D>(at, D * l) += block.template cast<double>();
      });
      a.for_each_scalar(v, [&](std::int32_t j, S value) {
        if (const std::int32_t l = place_[to_size(j)]; l >= 0)
          dense.block<D, D>(at, D * l).diagonal().array() += to_double(value);
      });
    }
    for (std::size_t k = 0; k < cluster.vertices.size(); ++k) {
      const auto v = to_size(cluster.vertices[k]);
      for (std::size_t c = 0; c < D; ++c) {
        if (!held[D * v + c]) continue;
        const auto u = to_index(D * k + c);
        dense.row(u).setZero();
        dense.col(u).setZero();
        dense(u, u) = 1;
        cluster.held.push_back(u);
      }
      place_[v] = -1;
    }
    cluster.factor.compute(dense);
    cluster.is_positive = cluster.factor.info() == Eigen::Success;
    const auto pivots = cluster.factor.matrixLLT().diagonal().array().square() / dense.diagonal().array();
    smallest_pivot_ = cluster.is_positive ? std::min(smallest_pivot_, pivots.minCoeff()) : 0;
  }
}

template <int D>
void StiffClusters<D>::solve(const Cluster& cluster) {
  for (const Eigen::Index u : cluster.held) correction_[u] = 0;
  cluster.factor.solveInPlace(correction_);
}

/// Calls visit(j, entry) for what couples the vertex with those outside its cluster: blocks, then scalars.
template <int D>
template <class S, class Visit>
void StiffClusters<D>::for_each_outside(const PackedRows<D, S>& a, std::size_t vertex, const Visit& visit) const {
  const std::int32_t own = cluster_of_[vertex];
  const auto visit_outside = [&](std::int32_t j, const auto& entry) {
    if (cluster_of_[to_size(j)] != own) visit(j, entry);
  };
  a.for_each_block(vertex, visit_outside);
  a.for_each_scalar(vertex, visit_outside);
}

/// Inside the cluster nothing is left of t, exactly: the products that would say so are of its large entries.
template <int D>
template <class S>
void StiffClusters<D>::correct_forwards(const PackedRows<D, S>& a, Vector<S>& z, Vector<S>& t) {
  using Values = Eigen::Matrix<S, D, 1>;
  for (const Cluster& cluster : clusters_) {
    if (!cluster.is_positive) continue;
    correction_.resize(to_index(D * cluster.vertices.size()));
    for (std::size_t k = 0; k < cluster.vertices.size(); ++k)
      correction_.segment<D>(to_index(D * k)) = values_at<D>(t, cluster.vertices[k]).template cast<double>();
    solve(cluster);
    for (std::size_t k = 0; k < cluster.vertices.size(); ++k) {
      const Values by = correction_.segment<D>(to_index(D * k)).template cast<S>();
      values_at<D>(z, cluster.vertices[k]) += by;
      values_at<D>(t, cluster.vertices[k]).setZero();
      for_each_outside(a, to_size(cluster.vertices[k]), [&](std::int32_t j, const auto& entry) {
        values_at<D>(t, j) -= transpose_of(entry) * by;  // the row is the column, transposed
      });
    }
  }
}

/// z inside the cluster anew from what is outside: the same as a correction, without products of its large entries.
template <int D>
template <class S>
void StiffClusters<D>::correct_backwards(const PackedRows<D, S>& a, const Vector<S>& r, Vector<S>& z) {
  using Values = Eigen::Matrix<S, D, 1>;
  for (auto cluster = clusters_.rbegin(); cluster != clusters_.rend(); ++cluster) {
    if (!cluster->is_positive) continue;
    correction_.resize(to_index(D * cluster->vertices.size()));
    for (std::size_t k = 0; k < cluster->vertices.size(); ++k) {
      Values left = values_at<D>(r, cluster->vertices[k]);
      for_each_outside(a, to_size(cluster->vertices[k]),
                       [&](std::int32_t j, const auto& entry) { left -= entry * values_at<D>(z, j); });
      correction_.segment<D>(to_index(D * k)) = left.template cast<double>();
    }
    solve(*cluster);
    for (std::size_t k = 0; k < cluster->vertices.size(); ++k)
      values_at<D>(z, cluster->vertices[k]) = correction_.segment<D>(to_index(D * k)).template cast<S>();
  }
}

template class StiffClusters<2>;
template class StiffClusters<3>;
#define CUTBENCH_CLUSTERS(D, S)                                                                                  \
  template void StiffClusters<D>::factor(const PackedRows<D, S>&, const std::vector<std::uint8_t>&);             \
  template void StiffClusters<D>::correct_forwards(const PackedRows<D, S>&, PackedVector<S>&, PackedVector<S>&); \
  template void StiffClusters<D>::correct_backwards(const PackedRows<D, S>&, const PackedVector<S>&, PackedVector<S>&);
CUTBENCH_CLUSTERS(2, float)
CUTBENCH_CLUSTERS(2, double)
CUTBENCH_CLUSTERS(3, float)
CUTBENCH_CLUSTERS(3, double)
#undef CUTBENCH_CLUSTERS

}  // namespace cutbench
