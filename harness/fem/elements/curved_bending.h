// Bending of a sheet that is curved at rest (harness/mesh/unroll.h), by hinges: bending.h's rows, less what they are at
// rest.
//
// A hinge's row of bending_hinges.h is a vector r = sum c x, which has the direction of the hinge's normal n, the
// bisector of its triangles', where lengths are those at rest. With its value at rest s = r0 n0 the energy is
//
//   E = |r - s n|^2 / 2,
//
// the quadratic hinge's where s = 0. It does not change with rigid motions of any size. The tangent is J' J with
// J = d(r - s n)/dx, exact at rest and positive semi-definite (Gauss and Newton's). Garg et al., Cubic shells, 2007,
// not read, have curved rest by a cubic term.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "harness/fem/algebra/block_matrix.h"
#include "harness/fem/elements/bending.h"

namespace cutbench {

class CurvedBending {
 public:
  /// Takes over the rows that were made last, and the rest positions in space (Sheet::position()).
  /// \pre `bending` is of hinges, and up to date, and was so at each of its updates before
  void update(const Sheet& sheet, const Bending& bending);
  /// The functions below refer to these positions, three numbers a vertex. Derivatives are computed where the first of
  /// them asks for them.
  void rotate(const Field& x);
  void add_force(double factor, Field& f) const;  ///< N
  /// blocks += factor T. \pre each row has the columns of the stencils that hold its vertex
  void add_stiffness(double factor, BlockMatrix<3>& blocks);
  double energy() const;  ///< J

 private:
  using Vector = Eigen::Vector3d;
  struct Hinge {
    std::array<std::array<std::int32_t, 3>, 2> corners{};  // of its triangles
    std::array<std::int32_t, 6> vertex{};                  // these, each once
    std::array<double, 6> factor{};                        // c
    std::size_t size = 0;
    double second_side = 1;                 // -1: the second triangle is turned over, as one of a Moebius strip
    double rest = 0;                        // s
    Vector excess = Vector::Zero();         // r - s n, at the positions of rotate()
    std::array<std::int32_t, 36> places{};  // of the blocks in their rows, pair by pair: where they were last
  };
  using Derivatives = std::array<Eigen::Matrix3d, 6>;  // of a hinge's excess, by each vertex
  static Hinge hinge_of(const Sheet& sheet, const Bending& bending, TriangleIndex t, std::size_t k, HalfEdge across);
  static Vector excess_at(const Hinge& hinge, const Field& x);
  static Derivatives derivatives_at(const Hinge& hinge, const Field& x);
  static double at_rest(const Hinge& hinge, const Sheet& sheet);
  const std::vector<Derivatives>& derivatives() const;

  std::vector<Hinge> hinges_;  // three for each triangle slot; of size 0 where there is none
  Field x_;                    // of rotate()
  mutable std::vector<Derivatives> derivatives_;
  mutable bool derived_ = false;
};

}  // namespace cutbench
