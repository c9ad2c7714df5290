// x = C q: the positions of the sheet's vertices as affine combinations of the unknowns q, where some vertices are
// constrained (harness/mesh/constraints.h), and the linear system of q. A constrained vertex is no unknown: it is
// extrapolated from its masters, three unconstrained vertices or phantom nodes.
#pragma once

#include <algorithm>
#include <span>

#include "harness/base/conversions.h"
#include "harness/fem/linear/system_matrix.h"
#include "harness/mesh/constraints.h"

namespace cutbench {

/// The matrix C. Unknown i < vertices() is the position of vertex i where that is not constrained; phantom nodes
/// follow.
class ConstraintMatrix {
 public:
  struct Row {
    std::array<std::int32_t, 3> unknown;
    std::array<double, 3> weight;
    std::size_t size;  ///< 1 to 3
    std::span<const std::int32_t> unknowns() const { return {unknown.data(), size}; }
    bool operator==(const Row&) const = default;
  };
  struct Changed {
    std::size_t vertex;
    Row before;
  };

  ConstraintMatrix() = default;
  ConstraintMatrix(const Constraints& constraints, std::size_t vertices) {
    set(constraints.constraints, vertices, constraints.phantoms.size());
  }
  /// Instead of those of before; returns the rows that this changes. \pre `vertices` is no less than then.
  /// \param vertices  the sheet's; or with the phantom nodes, which are like vertices then
  /// \param phantoms  those that are not among the vertices
  std::vector<Changed> set(const std::vector<Constraint>& constraints, std::size_t vertices, std::size_t phantoms);
  std::size_t vertices() const { return rows_.size(); }
  std::size_t unknowns() const { return rows_.size() + phantoms_; }
  const Row& row(std::size_t vertex) const { return rows_[vertex]; }
  bool is_phantom(std::int32_t unknown) const { return to_size(unknown) >= vertices(); }
  const std::vector<std::int32_t>& constrained() const {
    return constrained_;
  }  ///< constrained vertices, in rising order
  bool is_constrained(std::size_t vertex) const {
    return std::binary_search(constrained_.begin(), constrained_.end(), to_int32(vertex));
  }

  /// x = C q and r = C^T f, for `dimension` values per vertex and unknown. Unknowns of constrained vertices are
  /// ignored.
  void expand(int dimension, const Field& q, Field& x) const;
  void reduce(int dimension, const Field& f, Field& r) const;

 private:
  std::vector<Row> rows_;
  std::vector<std::int32_t> constrained_;
  std::size_t phantoms_ = 0;
};

/// The system C^T A C with ghost penalties, for a system A of all vertices. Held unknowns of A are data: their rows of
/// C are zero, or left to the solver's projection. An unknown of q is held where its vertex is held, and where nothing
/// depends on it. Assemble it whenever A changes. Only rows near constrained vertices are computed; all others are
/// those of A, copied, and scalar matrices, which are constant between cuts, are computed once. After a cut, change it.
template <int D>
class ConstrainedSystem {
 public:
  ConstrainedSystem(const Constraints& constraints, std::size_t vertices) {
    change(constraints, vertices, constraints.phantoms.size());
  }
  /// Phantom nodes are vertices of A: see ConstraintMatrix::set().
  ConstrainedSystem(const Constraints& constraints, std::size_t vertices, std::size_t phantoms) {
    change(constraints, vertices, phantoms);
  }
  /// The constraints after one more cut. Where A has a history, and phantom nodes are vertices of A, only the rows
  /// follow that a row of A or a constraint which has changed is a part of.
  void change(const Constraints& constraints, std::size_t vertices, std::size_t phantoms);

  const ConstraintMatrix& constraint_matrix() const { return constraint_matrix_; }
  /// \pre the pattern of `a` and the values of its scalar matrices are those of the first call after a change.
  /// \param stiffness  N/m, of the sheet: for ghost penalties
  void assemble(const SystemMatrix<D>& a, double stiffness = 0);
  /// Of the last assemble(); refers to this. No element table: preconditioners find no slivers, whose vertices are
  /// constrained.
  SystemMatrix<D> system() const;
  /// r = C^T f, without the forces at held vertices, and zero where an unknown is held.
  void reduce(const std::vector<std::uint8_t>& held, const Field& f, Field& r) const;
  /// Subtracts the ghost penalties of the given values of held vertices, of the last assemble(), from the right side.
  void subtract_ghosts(const Field& given, Field& r) const;
  /// x = C q, zero where A is held. \pre q is zero where system() is held.
  void expand(const Field& q, Field& x) const;
  /// Extrapolates each constrained vertex of x from its masters; phantom nodes contribute nothing, and held axes stay.
  void extrapolate(const std::vector<std::uint8_t>& held, Field& x) const;
  /// Moves the forces at constrained vertices to their masters, as C^T f does, without the shares of phantom nodes; on
  /// held axes they stay.
  void transfer_forces(const std::vector<std::uint8_t>& held, Field& f) const;
  /// Extrapolates the constrained vertices whose masters are all vertices, so that a state satisfies the constraints.
  void satisfy(const std::vector<std::uint8_t>& held, Field& x) const;

 private:
  /// Block `from` of A, times the weight, is a part of block `to`.
  struct Share {
    std::int32_t from, to;
    double weight;
  };
  /// The same without the axes on which vertex i or j is held; part 0: the blocks, k: scalar matrix k - 1.
  struct SplitShare {
    Share share;
    std::size_t part, i, j;
  };

  void extrapolate(std::int32_t constrained, const std::vector<std::uint8_t>& held, Field& x) const;
  void find_near(const SystemMatrix<D>& a);
  void find_sources(const SystemMatrix<D>& a);
  template <class Act>
  void for_each_share(const SystemMatrix<D>& a, std::size_t i, const Act& act) const;
  bool is_split(std::size_t vertex) const;
  void follow(const SystemMatrix<D>& a);
  void find_changed(const SystemMatrix<D>& a);
  void copy_rows(const SystemMatrix<D>& a);
  void set_near_rows(const SystemMatrix<D>& a);
  void set_shares(const SystemMatrix<D>& a);
  void find_places(const SystemMatrix<D>& a);
  bool acts(const GhostEdge& ghost, std::size_t axis) const;

  ConstraintMatrix constraint_matrix_;
  std::vector<GhostEdge> ghosts_;
  double ghost_stiffness_ = 0;
  bool is_changed_ = false;         // the constraints, since the last assemble()
  std::vector<std::uint8_t> near_;  // per unknown: its row is not that of A
  std::vector<std::size_t> near_rows_;
  std::vector<ConstraintMatrix::Changed> changed_;  // constraints, since the last assemble()
  std::vector<std::int32_t> left_by_ghosts_;        // unknowns, since then
  std::vector<std::size_t> changed_rows_;           // by the last follow()
  std::vector<std::uint8_t> is_changed_row_;        // per unknown
  std::vector<std::size_t> sources_;                // rows of A whose shares the last follow() found
  GrowingRows<Share> shares_;                       // per row of A near constraints
  std::vector<SplitShare> split_shares_;            // by rising i
  BlockMatrix<D> blocks_;
  std::vector<BlockMatrix<1>> scalars_;  // C^T (scalar matrix of A) C
  std::vector<double> factors_;
  std::vector<std::uint8_t> held_, held_vertices_;  // per unknown of q, and of A
  std::uint64_t pattern_ = 0;                       // of A
  PatternHistory history_;                          // of this system
  std::vector<Point2> places_;  // of the unknowns: phantom nodes lie amid the vertices that depend on them
};

}  // namespace cutbench
