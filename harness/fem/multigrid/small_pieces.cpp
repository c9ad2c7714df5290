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

template <int D>
void SmallPieces<D>::factor(Piece& piece, const SystemMatrix<D>& a, const LevelRows& rows) {
  const auto n = to_index(D * piece.vertices.size());
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n, n);
  const auto block_at = [&](std::size_t i, std::int32_t j) {
    return dense.template block<D, D>(D * place_[i], D * place_[to_size(j)]);
  };
  for (const std::int32_t vertex : piece.vertices) {
    const auto i = to_size(vertex);
    std::int32_t slot = a.blocks->first_slot(i);
    for (const std::int32_t j : a.blocks->columns(i)) block_at(i, j) += a.blocks->block(slot++);
    std::size_t scalar = rows.scalars.first_slot(i);
    for (const std::int32_t j : rows.scalars[i]) block_at(i, j).diagonal().array() += rows.scalar[scalar++];
  }
  Eigen::VectorXd& inverse = piece.inverse_diagonal;
  inverse = dense.diagonal().cwiseAbs().cwiseInverse();
  for (const std::int32_t vertex : piece.vertices)
    for (int c = 0; c < D; ++c) {
      if (!(*a.held)[D * to_size(vertex) + to_size(c)]) continue;
      const Eigen::Index u = D * place_[to_size(vertex)] + c;
      dense.row(u).setZero();
      dense.col(u).setZero();
      dense(u, u) = 1;
      inverse[u] = 0;
    }
  piece.factor.compute(dense);
  piece.is_positive = piece.factor.info() == Eigen::Success;
}

template <int D>
void SmallPieces<D>::solve(const Field& b, Field& x, Field& r, Workers& workers) {
  workers.run(pieces_.size(), [&](std::size_t p) {
    Piece& piece = pieces_[p];
    if (!piece.is_positive) return;
    piece.values.resize(to_index(D * piece.vertices.size()));
    for (std::size_t k = 0; k < piece.vertices.size(); ++k)
      piece.values.template segment<D>(to_index(D * k)) = b.template segment<D>(to_index(D) * piece.vertices[k]);
    piece.factor.solveInPlace(piece.values);
    for (std::size_t k = 0; k < piece.vertices.size(); ++k) {
      const auto at = to_index(D) * piece.vertices[k];
      x.template segment<D>(at) = piece.values.template segment<D>(to_index(D * k));
      r.template segment<D>(at).setZero();
    }
  });
}

template <int D>
void SmallPieces<D>::apply(const Field& r, Field& z) const {
  for (const Piece& piece : pieces_)
    for (std::size_t k = 0; k < piece.vertices.size(); ++k) {
      const auto at = to_index(D) * piece.vertices[k];
      auto to = z.template segment<D>(at);
      if (piece.is_positive)
        to.setZero();
      else
        to = piece.inverse_diagonal.template segment<D>(to_index(D * k)).cwiseProduct(r.template segment<D>(at));
    }
}

template <int D>
void SmallPieces<D>::set_zero(Field& field) const {
  for (const Piece& piece : pieces_)
    if (piece.is_positive)
      for (const std::int32_t v : piece.vertices) field.template segment<D>(to_index(D) * v).setZero();
}

template class SmallPieces<2>;
template class SmallPieces<3>;

}  // namespace cutbench
