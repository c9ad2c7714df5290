// The compounds of a sheet, elements of several triangles, as membrane elements, in the plane or in space. They are
// polygons (polygon_element.h).
//
// Energy of one with k corners: A W(F) + tau E / 2 sum |d_i|^2, with the mean gradient F, the energy W of a membrane
// triangle (membrane.h), the departure d = (I - Pi) x of its corners, Young's modulus E (N/m) and tau = 1/2. The second
// term, the stabilisation of Beirao da Veiga et al. (2013), is quadratic and the same however the polygon is turned, so
// there is one rotation for a polygon, that of F.
//
// In space with bending only the departure in the polygon's plane counts, d - (n d) n with the normal n of F, for what
// departs from the plane bends (bending.h). n turns with F: with g = sum (n d_i) d_i and the dual basis F^a of F's
// columns that adds tau E (g F^a) n to column a of the stress. The stiffness is that of Gauss and Newton, tau E J^T J
// with the derivative J of the departure in the plane, positive semi-definite; without the share of n in it a bent
// sheet gained energy. Without bending nothing else keeps the corners of a polygon in its plane, and all of d counts.
#pragma once

#include <span>
#include <vector>

#include "harness/fem/elements/element_table.h"
#include "harness/fem/elements/membrane.h"

namespace cutbench {

/// What the stabilisation is multiplied with: tau E, N/m, in the element's plane and across it.
struct Stabilisation {
  double in_plane, across;
};
Stabilisation stabilisation_of(const Lame& lame, bool bends);

/// Their linear stiffness at rest in the plane.
class CompoundStiffness {
 public:
  CompoundStiffness(const ElementTable& elements, const Lame& lame);
  /// force += K moved, for two values per vertex. \param elements  as they were
  void add_force(const ElementTable& elements, const Field& moved, Field& force) const;

 private:
  std::vector<Eigen::MatrixXd> stiffness_;  // per slot: of the corners, N/m
};

template <int D>
class CompoundSheet {
 public:
  /// \param bends  bending keeps them flat
  CompoundSheet(const MembraneLaw& law, bool bends) : law_(law), stabilisation_(stabilisation_of(law.lame, bends)) {}

  /// For the compound of t, new or of another shape.
  void reset(const ElementTable& elements, TriangleIndex t);
  /// Where the blocks of the compounds that have this corner are in its row of the matrix.
  void find_slots(const ElementTable& elements, std::size_t vertex, const BlockMatrix<D>& blocks);

  /// Deformations of all at x; adds the forces they exert. The functions below refer to this x.
  void rotate(const ElementTable& elements, const Field& x, Field& force);
  double energy(const ElementTable& elements) const;
  /// Of a member.
  const Deformation<D>& deformation(const Element& member) const {
    return states_[to_size(member.polygon)].deformation;
  }
  void add_stiffness(const ElementTable& elements, double factor, BlockMatrix<D>& blocks) const;

 private:
  struct State {
    Deformation<D> deformation;
    Eigen::Matrix<double, D, Eigen::Dynamic> departure;  ///< of x
    Eigen::MatrixXd stabilisation;                       ///< departure matrix^T departure matrix
    Eigen::VectorXd across;                              ///< n d_i
    Eigen::Matrix<double, D, Eigen::Dynamic> tilt;       ///< F^a G_i,a: n turns by -tilt_i for a unit of x_i along n
    std::vector<std::int32_t> slots;                     ///< k x k, row by row
  };
  using Block = Eigen::Matrix<double, D, D>;
  void rotate(const PolygonElement& polygon, const Field& x, State& state, Field& force) const;

  MembraneLaw law_;
  Stabilisation stabilisation_;
  std::vector<State> states_;  // per polygon slot
};

}  // namespace cutbench
