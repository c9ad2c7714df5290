// Multigrid for a sheet that is cut: one V-cycle as a preconditioner of conjugate gradients (Trottenberg, Oosterlee and
// Schueller, Multigrid, 2001, 7.8). The levels are those of
// Coarsening, with lattices of twice the mean edge, four times, and so on; their matrices are the Galerkin products
// P^T A P, so each is symmetric and positive definite where A is. Vertices that slivers tie together are one more unknown
// of the first coarse level. On the coarsest level a Cholesky factorisation solves.
//
// Levels are in floats: a preconditioner need not be accurate, and the time is that of reading the matrix. Where the
// diagonal blocks of A differ too much for floats (slivers), the finest level is in doubles. Without places of the
// vertices there is the finest level alone, which is symmetric Gauss-Seidel.
#pragma once

#include <Eigen/Cholesky>
#include <vector>

#include "harness/fem/level_matrix.h"
#include "harness/fem/preconditioner.h"

namespace cutbench {

template <int D>
class Multigrid final : public Preconditioner<D> {
 public:
  /// The levels are found anew where the pattern of `a` has changed; their matrices every time.
  void setup(const SystemMatrix<D>& a) override;
  void apply(const Field& r, Field& z) override;
  std::size_t levels() const { return coarse_.size() + 1; }

 private:
  using Block = typename BlockMatrix<D>::Block;
  /// The rows of a level: D x D blocks, which couple neighbours, and scalars, which reach farther and are constant.
  struct Rows {
    SparseRows blocks, scalars;
    std::vector<double> scalar;  // per entry of `scalars`
  };
  /// A matrix with a right side, a solution and a residual.
  template <class S>
  struct Level {
    LevelMatrix<D, S> matrix;
    typename LevelMatrix<D, S>::Vector r, z, t;
    void set(const Rows& rows);
  };
  struct CoarseLevel : Level<float> {
    Coarsening from;  // the next finer level
    Rows rows;
  };

  void find_levels(const SystemMatrix<D>& a);
  void read_rows(const SystemMatrix<D>& a);
  SparseRows groups(const SystemMatrix<D>& a) const;
  void find_held(const SystemMatrix<D>& a);
  static bool needs_doubles(const SystemMatrix<D>& a);
  template <class S>
  void fill(const SystemMatrix<D>& a, Level<S>& level, bool& is_new);
  template <class S>
  void fill_coarse(const LevelMatrix<D, S>& fine, CoarseLevel& level);
  void factor_coarsest();
  template <class S>
  void cycle(Level<S>& level, std::size_t next);
  template <class S>
  void correct(Level<S>& level, std::size_t next);

  std::uint64_t pattern_ = 0;
  std::vector<double> factors_;                                           // of the scalar parts of A
  std::vector<std::uint8_t> has_held_;                                    // per vertex: one of its unknowns is held
  std::vector<std::size_t> held_;                                         // held unknowns of vertices with a row
  Rows rows_;                                                             // of A
  std::vector<std::int32_t> slots_;                                       // per entry of rows_.blocks: where A keeps it
  bool in_doubles_ = false, float_is_new_ = true, double_is_new_ = true;  // new: the rows are to be set
  Level<float> finest_;
  Level<double> finest_in_doubles_;
  std::vector<CoarseLevel> coarse_;
  Eigen::LLT<Eigen::MatrixXd> coarsest_;
  bool solves_coarsest_ = false;
  std::vector<std::int32_t> place_;  // working storage, per coarse unknown: its place in the row at hand
};

}  // namespace cutbench
