// x = C q: the places of the sheet's vertices as affine combinations of unknowns (harness/mesh/ties.h), and the linear
// system of these unknowns.
#pragma once

#include <span>

#include "harness/fem/system_matrix.h"
#include "harness/mesh/ties.h"

namespace cutbench {

/// C. Unknown i < vertices() is the place of vertex i, where that is not tied; phantoms come after.
class Combination {
 public:
  struct Row {
    std::array<std::int32_t, 3> unknown;
    std::array<double, 3> weight;
    std::size_t size;  ///< 1 to 3
  };

  Combination(const Ties& ties, std::size_t vertices);
  std::size_t vertices() const { return rows_.size(); }
  std::size_t unknowns() const { return rows_.size() + phantoms_; }
  const Row& row(std::size_t vertex) const { return rows_[vertex]; }
  bool is_phantom(std::int32_t unknown) const { return static_cast<std::size_t>(unknown) >= vertices(); }
  const std::vector<std::int32_t>& tied() const { return tied_; }  ///< in rising order

  /// x = C q and r = C^T f, for `dimension` values per vertex and unknown. Unknowns of tied vertices count for nothing.
  void expand(int dimension, const Field& q, Field& x) const;
  void reduce(int dimension, const Field& f, Field& r) const;

 private:
  std::vector<Row> rows_;
  std::vector<std::int32_t> tied_;
  std::size_t phantoms_;
};

/// C^T A C, with ghost penalties, and its unknowns for a system A of all vertices. Held unknowns of A are data: their
/// rows of C are zero, and an unknown is held where the vertex is that it places, or where nothing is left that depends
/// on it. It is assembled anew whenever A is: the pattern once, the values by the blocks of A. A cut wants a new one.
template <int D>
class TiedSystem {
 public:
  TiedSystem(const Ties& ties, std::size_t vertices) : combination_(ties, vertices), ghosts_(ties.ghosts) {}

  const Combination& combination() const { return combination_; }
  /// \pre the pattern of `a` is that of the first call. \param stiffness  N/m, of the sheet: for ghost penalties
  void assemble(const SystemMatrix<D>& a, double stiffness = 0);
  /// Of the last assemble(); refers to this. No element table: preconditioners see no slivers, which were tied.
  SystemMatrix<D> system() const;
  /// r = C^T f, zero where a vertex is held, and without what pulls at held ones.
  void reduce(const std::vector<std::uint8_t>& held, const Field& f, Field& r) const;
  /// Takes what the ghost penalties of the last assemble() do to given values of held vertices off the right side.
  void subtract_ghosts(const Field& given, Field& r) const;
  /// x = C q, zero where A is held. \pre q is zero where system() is held.
  void expand(const Field& q, Field& x) const;
  /// Tied vertices of x go where their masters are, but for phantoms, which add nothing, and on axes that are held.
  void follow(const std::vector<std::uint8_t>& held, Field& x) const;
  /// Forces at tied vertices go to their masters, as in C^T f, but for phantoms' shares; on axes that are held they
  /// stay.
  void hand_on(const std::vector<std::uint8_t>& held, Field& f) const;
  /// Those all of whose masters are vertices: what brings a state to where it satisfies the ties.
  void settle(const std::vector<std::uint8_t>& held, Field& x) const;

 private:
  void follow(std::int32_t tied, const std::vector<std::uint8_t>& held, Field& x) const;
  void set_pattern(const SystemMatrix<D>& a);
  bool acts(const GhostEdge& ghost, std::size_t axis) const;
  void add(std::size_t i, std::size_t j, typename BlockMatrix<D>::Block block);

  Combination combination_;
  std::vector<GhostEdge> ghosts_;
  double ghost_stiffness_ = 0;
  BlockMatrix<D> blocks_;
  std::vector<std::uint8_t> held_, held_vertices_;  // per unknown of q, and of A
  std::uint64_t pattern_ = 0;
};

}  // namespace cutbench
