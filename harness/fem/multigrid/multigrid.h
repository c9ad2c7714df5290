// Multigrid for a sheet that is cut: one V-cycle as a preconditioner of conjugate gradients (Trottenberg, Oosterlee and
// Schueller, Multigrid, 2001, 7.8). The levels are those of Coarsening, with lattices of twice the median edge, four
// times, and so on; their matrices are the Galerkin products P^T A P, so each is symmetric and positive definite where
// A is. Vertices that slivers constraint together are one more unknown of the first coarse level. Clusters of stiff
// vertices are solved exactly (StiffClusters), and so are small free pieces, before the iteration begins (SmallPieces).
// On the coarsest level a Cholesky factorisation solves.
//
// Levels are in floats: a preconditioner need not be accurate, and the time is that of reading the matrix. The finest
// level is in doubles where floats would not do:
// - where diagonal blocks of A differ too much (slivers);
// - where another free piece is light beside its stiffness: its diagonal is over 2^20 times the sum of its entries, so
//   the last of 24 bits is a sixteenth of what it weighs;
// - likewise where a pivot of a stiff cluster is below 2^-20 of its diagonal.
// Else the cycle would not be symmetric, nor positive definite. Conjugate gradients take their product from the finest
// level, too. Where that is in floats, rows with large entries are multiplied in doubles.
//
// Without places of the vertices there is the finest level alone, which is symmetric Gauss-Seidel.
#pragma once

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <deque>
#include <vector>

#include "harness/fem/linear/preconditioner.h"
#include "harness/fem/multigrid/coarsening.h"
#include "harness/fem/multigrid/packed_rows.h"
#include "harness/fem/multigrid/small_pieces.h"
#include "harness/fem/multigrid/stiff_clusters.h"

namespace cutbench {

template <int D>
class Multigrid final : public Preconditioner<D> {
 public:
  /// \param workers  must outlive this
  explicit Multigrid(Workers& workers = Workers::none()) : workers_(&workers) {}
  /// After cuts the levels follow the rows that have changed, where `a` knows its history; else, and where most rows
  /// have changed, they are made anew. Their matrices are computed every other time, and wherever the rows or the
  /// trace of `a` have changed.
  void setup(const SystemMatrix<D>& a) override;
  using typename Preconditioner<D>::Blocks;
  void setup(const SystemMatrix<D>& a, const Blocks& diagonals) override;
  /// Small free pieces.
  void solve_apart(const Field& b, Field& x, Field& r) override { small_.solve(b, x, r, *workers_); }
  void apply(const Field& r, Field& z) override;
  /// By the finest level.
  bool multiply_roughly(const Field& x, Field& y) override;
  std::size_t levels() const { return coarse_.size() + 1; }
  /// Microseconds that the last setup() took for the rows of all levels, without their values.
  double rows_us() const { return rows_us_; }
  /// Entries beside the diagonal that a cycle reads, each twice, of all levels; with those that fill up pairs.
  /// \pre setup() was called
  struct Entries {
    double blocks = 0, scalars = 0;
  };
  Entries entries() const;

 private:
  using Block = typename BlockMatrix<D>::Block;
  template <class S>
  using Columns = BlockColumns<D, S>;
  /// A matrix with a right side, a solution and a residual.
  template <class S>
  struct Level {
    PackedRows<D, S> matrix;
    PackedVector<S> r, z, t;
    struct Unknown {
      std::size_t vertex;
      int coordinate;
    };
    std::vector<Unknown> idle;                 // unknowns that are held, or whose block is not positive definite
    std::vector<std::array<bool, D>> is_idle;  // per vertex and coordinate
    void set_idle_zero(PackedVector<S>& field) const {
      for (const Unknown& u : idle) field[u.vertex][u.coordinate] = 0;
    }
    void resize() {
      for (auto* field : {&r, &z, &t}) field->resize(matrix.size());
    }
  };
  /// Working storage for rows of a coarse matrix.
  template <class S>
  struct CoarseRow {
    std::vector<std::int32_t> place;            // per coarse unknown: its place in the row at hand
    std::vector<Columns<S>> sums;               // of the row at hand
    RowSum<Columns<S>> part_row{Columns<S>{}};  // of P^T A, with A the fine matrix
  };
  struct CoarseLevel : Level<float> {
    explicit CoarseLevel(double spacing) : from(spacing) {}
    Coarsening from;  // the next finer level
    LevelRows rows;
    SweptScalars swept;                  // of rows
    SweepOrder order;                    // likewise
    std::vector<Columns<float>> blocks;  // per slot of rows.blocks
    Eigen::MatrixXd dense() const;
  };

  bool find_changed(const SystemMatrix<D>& a);
  void find_restiffened();
  void read_row(const SystemMatrix<D>& a, std::size_t i);
  void read_place(const SystemMatrix<D>& a, std::size_t i);
  Coarsening::Regrouping regroup(const SystemMatrix<D>& a);
  void find_held(const SystemMatrix<D>& a);
  static bool is_held_altogether(const SystemMatrix<D>& a, std::size_t i) {
    const auto held = a.held->begin() + to_index(D * i);
    return std::find(held, held + D, 0) == held + D;
  }
  template <class S>
  void set_inverse(Level<S>& level, std::size_t i, Block diagonal, const std::array<bool, D>& is_held);
  template <class S>
  void list_idle(Level<S>& level);
  void make_levels(const SystemMatrix<D>& a);
  void update_levels(const SystemMatrix<D>& a);
  /// What a level is made of.
  struct Finer {
    const LevelRows* rows;
    const SweptScalars* swept;
    const std::vector<Point2>* places;
    const RowChanges* changes;
  };
  static Finer finer_than_next(const CoarseLevel& level);
  static void update_rows(CoarseLevel& level, const Finer& fine, const Coarsening::Regrouping& regrouping);
  void look_at_sizes(const SystemMatrix<D>& a, const Blocks& diagonals);
  void leave_out_small_pieces(const SystemMatrix<D>& a);
  void choose_precision(const SystemMatrix<D>& a);
  bool has_light_piece(const SystemMatrix<D>& a);
  void fill_finest(const SystemMatrix<D>& a, const Blocks& diagonals);
  void list_stiff_rows(const SystemMatrix<D>& a);
  void multiply_stiff_rows(const Field& x, Field& y) const;
  void fill_coarse_levels(const SystemMatrix<D>& a);
  template <class S>
  void fill(const SystemMatrix<D>& a, const Blocks& diagonals, Level<S>& level, bool& is_new);
  template <class S, class AskFor, class AddRow>
  void fill_coarse(std::vector<CoarseRow<S>>& rows, CoarseLevel& level, const AskFor& ask_for, const AddRow& add_row);
  template <class S>
  void fill_first_coarse(const SystemMatrix<D>& a, std::vector<CoarseRow<S>>& rows);
  void factor_coarsest();
  template <class S>
  void cycle(Level<S>& level, std::size_t next);
  void solve_coarsest(Level<float>& level);
  template <class S>
  void correct(Level<S>& level, std::size_t next);

  Workers* workers_;
  std::uint64_t pattern_ = 0;
  std::vector<double> factors_;             // of the scalar parts of A
  std::vector<std::uint8_t> is_near_held_;  // per vertex: it has a held unknown, or a block with one that has
  std::vector<Eigen::Index> held_;          // unknowns
  LevelRows rows_;                          // of A
  SweptScalars swept_;                      // of rows_
  SweepOrder order_;                        // likewise
  std::vector<std::int32_t> slots_;         // per slot of rows_.blocks: where A keeps the block
  std::vector<Point2> places_;              // per vertex; NaN where no hat is wanted
  std::vector<std::int32_t> changed_;       // vertices whose rows the levels have not followed yet
  RowChanges changes_;                      // what is different there
  std::size_t slots_made_ = 0;              // slots of rows_ when the levels were made
  double rows_us_ = 0;
  bool in_doubles_ = false, float_is_new_ = true, double_is_new_ = true;  // new: the rows are to be set
  Level<float> finest_;
  Level<double> finest_in_doubles_;
  struct StiffRow {
    std::int32_t row;
    std::size_t first_block;
  };
  std::vector<StiffRow> stiff_rows_;  // whose product takes doubles where the finest level is in floats
  Blocks stiff_blocks_;               // of these, by the columns of rows_.blocks
  StiffClusters<D> clusters_;
  SmallPieces<D> small_;
  std::deque<CoarseLevel> coarse_;  // each refers to rows of its own
  Eigen::LLT<Eigen::MatrixXd> coarsest_;
  bool solves_coarsest_ = false;
  Blocks diagonals_;           // of A, where nobody else has them
  std::vector<double> sizes_;  // per vertex: the trace of its diagonal block, 0 in small pieces
  double median_size_ = 0, largest_size_ = 0;
  std::vector<double> looked_at_;  // per vertex: its size over the median when groups and clusters were found there
  double trace_of_pieces_ = 0;
  bool has_light_piece_ = false, clusters_need_doubles_ = false;
  double trace_ = 0, coarse_trace_ = 0;  // of A, at the last setup() and when the coarse matrices were computed
  bool coarse_are_old_ = true;
  // Working storage.
  std::vector<CoarseRow<float>> coarse_rows_;
  std::vector<CoarseRow<double>> coarse_rows_in_doubles_;
  RowSum<double> scalars_{0};  // of the row at hand
  std::vector<double> sorted_, weights_;
  std::vector<std::int32_t> front_, place_in_front_;  // the second: per vertex, or -1
};

}  // namespace cutbench
