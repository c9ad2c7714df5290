// Free pieces of a few vertices. Nothing links them to the rest of the sheet, so the levels leave them out, and each is
// solved exactly, in doubles, before the iteration begins: a cut leaves slivers in them, which take the sweeps long,
// and some weigh so little beside their stiffness that floats lose it. One that rounding leaves not positive definite
// stays in the iteration, by its diagonal.
#pragma once

#include <Eigen/Cholesky>
#include <span>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/fem/algebra/workers.h"
#include "harness/fem/linear/system_matrix.h"
#include "harness/fem/multigrid/level_rows.h"

namespace cutbench {

template <int D>
class SmallPieces {
 public:
  static constexpr std::size_t most_vertices = 64;

  /// Finds the pieces that have changed; returns the vertices that were in one before or are now. Valid until the next
  /// call.
  /// \param rows     of A; the scalar matrices in one
  /// \param held     per unknown; a piece with a vertex that is held altogether is not free
  /// \param changed  vertices whose rows are others than at the last call; at the first call, all
  std::span<const std::int32_t> follow(const LevelRows& rows, const std::vector<std::uint8_t>& held,
                                       std::span<const std::int32_t> changed);
  /// \pre follow() was called with these rows
  void factor(const SystemMatrix<D>& a, const LevelRows& rows, Workers& workers);
  /// Whether the vertex is in one.
  bool holds(std::size_t vertex) const { return piece_[vertex] >= 0; }
  /// Whether the vertex is in one whose matrix could be factored.
  bool solves(std::size_t vertex) const { return holds(vertex) && pieces_[to_size(piece_[vertex])].is_positive; }
  /// Solves A x = b in these, and sets the residual r to zero there.
  void solve(const Field& b, Field& x, Field& r, Workers& workers);
  /// z in all pieces: zero in these, and r over the diagonal in the others.
  void apply(const Field& r, Field& z) const;
  /// In the pieces that are solved.
  void set_zero(Field& field) const;

 private:
  struct Piece {
    std::vector<std::int32_t> vertices;
    Eigen::LLT<Eigen::MatrixXd> factor;
    bool is_positive = false;
    Eigen::VectorXd inverse_diagonal;  ///< where it is not, 0 where unknowns are held
    Eigen::VectorXd values;            ///< working storage
  };
  void drop(std::int32_t piece);
  bool fill_front(const LevelRows& rows, const std::vector<std::uint8_t>& held, std::int32_t from);
  void factor(Piece& piece, const SystemMatrix<D>& a, const LevelRows& rows);

  std::vector<Piece> pieces_;
  std::vector<std::int32_t> piece_, place_;  // per vertex: its piece or -1, and its place there
  // Working storage of follow().
  std::vector<std::int32_t> moved_;            // what it returns
  std::vector<std::int32_t> front_, reached_;  // by one search, and by all
  std::vector<std::int32_t> search_;           // per vertex: where the search that reached it begins, or -1
};

}  // namespace cutbench
