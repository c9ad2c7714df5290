#include "harness/fem/multigrid/small_pieces.h"

#include <algorithm>
#include <utility>

#include "harness/base/conversions.h"

namespace cutbench {

template <int D>
std::span<const std::int32_t> SmallPieces<D>::follow(const LevelRows& rows, const std::vector<std::uint8_t>& held,
                                                     std::span<const std::int32_t> changed) {
  moved_.clear();
  for (auto* per_vertex : {&piece_, &place_, &search_}) per_vertex->resize(rows.size(), -1);
  for (const std::int32_t v : changed)
    if (const std::int32_t piece = piece_[to_size(v)]; piece >= 0) drop(piece);
  reached_.clear();
  for (const std::int32_t v : changed) {
    if (rows.blocks[to_size(v)].empty() || search_[to_size(v)] >= 0) continue;
    const bool is_small = fill_front(rows, held, v);
    reached_.insert(reached_.end(), front_.begin(), front_.end());
    if (!is_small) continue;
    for (std::size_t k = 0; k < front_.size(); ++k) {
      piece_[to_size(front_[k])] = to_int32(pieces_.size());
      place_[to_size(front_[k])] = to_int32(k);
    }
    pieces_.emplace_back().vertices = front_;
    moved_.insert(moved_.end(), front_.begin(), front_.end());
  }
  for (const std::int32_t v : reached_) search_[to_size(v)] = -1;
  return moved_;
}

template <int D>
void SmallPieces<D>::drop(std::int32_t piece) {
  for (const std::int32_t v : pieces_[to_size(piece)].vertices) {
    piece_[to_size(v)] = -1;
    moved_.push_back(v);
  }
  std::swap(pieces_[to_size(piece)], pieces_.back());
  pieces_.pop_back();
  if (to_size(piece) == pieces_.size()) return;
  for (const std::int32_t v : pieces_[to_size(piece)].vertices) piece_[to_size(v)] = piece;
}

/// Fills front_ with the vertices that links join to `from`. False: they are too many, or one is held altogether.
template <int D>
bool SmallPieces<D>::fill_front(const LevelRows& rows, const std::vector<std::uint8_t>& held, std::int32_t from) {
  front_.assign(1, from);
  search_[to_size(from)] = from;
  for (std::size_t k = 0; k < front_.size(); ++k) {
    const auto v = to_size(front_[k]);
    const auto own = held.begin() + to_index(D * v);
    if (std::find(own, own + D, 0) == own + D) return false;
    for (const SweepRows* part : {&rows.blocks, &rows.scalars})
      for (const std::int32_t j : (*part)[v]) {
        std::int32_t& search = search_[to_size(j)];
        if (search == from) continue;
        if (search >= 0 || front_.size() == most_vertices)
          return false;  // an earlier search ended early, so it is large
        search = from;
        front_.push_back(j);
      }
  }
  return true;
}

template <int D>
void SmallPieces<D>::factor(const SystemMatrix<D>& a, const LevelRows& rows, Workers& workers) {
  workers.run(pieces_.size(), [&](std::size_t k) { factor(pieces_[k], a, rows); });
}

/// Where A is not positive definite, of its diagonal alone.
template <int D>
void SmallPieces<D>::factor(Piece& piece, const SystemMatrix<D>& a, const LevelRows& rows) {
  const auto n = to_index(D * piece.vertices.size());
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
  const auto block_at = [&](std::size_t i, std::int32_t j) {
    return dense.template block<D, D>(D * place_[i], D * place_[to_size(j)]);
  };
  piece.held.clear();
  for (const std::int32_t vertex : piece.vertices) {
    const auto i = to_size(vertex);
    std::int32_t slot = a.blocks->first_slot(i);
    for (const std::int32_t j : a.blocks->columns(i)) block_at(i, j) += a.blocks->block(slot++);
    std::size_t scalar = rows.scalars.first_slot(i);
    for (const std::int32_t j : rows.scalars[i]) block_at(i, j).diagonal().array() += rows.scalar[scalar++];
    for (int c = 0; c < D; ++c)
      if ((*a.held)[D * i + to_size(c)]) piece.held.push_back(D * place_[i] + c);
  }
  for (const Eigen::Index u : piece.held) {
    dense.row(u).setZero();
    dense.col(u).setZero();
    dense(u, u) = 1;
  }
  piece.factor.compute(dense);
  if (piece.factor.info() == Eigen::Success) return;
  const Eigen::VectorXd diagonal = dense.diagonal().cwiseAbs();
  piece.factor.compute(Eigen::MatrixXd(diagonal.asDiagonal()));
}

template <int D>
void SmallPieces<D>::solve(const Field& r, Field& z, Workers& workers) {
  workers.run(pieces_.size(), [&](std::size_t p) {
    auto& [vertices, held, factor, values] = pieces_[p];
    const auto at = [](auto& field, std::int32_t i) { return field.template segment<D>(to_index(D) * i); };
    values.resize(to_index(D * vertices.size()));
    for (std::size_t k = 0; k < vertices.size(); ++k) at(values, to_int32(k)) = at(r, vertices[k]);
    for (const Eigen::Index u : held) values[u] = 0;
    factor.solveInPlace(values);
    for (std::size_t k = 0; k < vertices.size(); ++k) at(z, vertices[k]) = at(values, to_int32(k));
  });
}

template class SmallPieces<2>;
template class SmallPieces<3>;

}  // namespace cutbench
