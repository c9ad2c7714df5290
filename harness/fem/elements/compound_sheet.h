// The compounds of a sheet, elements of several triangles, as membrane elements, in the plane or in space. They are
// polygons (polygon_element.h).
//
// Energy of one with k corners: A W(F) + tau E / 2 sum |d_i|^2, with the mean gradient F, the energy W of a membrane
// triangle (membrane.h), the departure d = (I - Pi) x of its corners, Young's modulus E (N/m) and tau, 1/2 where a
// method does not say otherwise. The second term, the stabilisation of Beirao da Veiga et al. (2013), is quadratic and
// the same however the polygon is turned, so there is one rotation for a polygon, that of F.
//
// Every tau > 0 passes the patch test and converges at the same rate; the theory gives no number. The second term is
// the energy of the polygon's hourglass modes (Cangiani, Manzini, Russo and Sukumar, Hourglass stabilization and the
// virtual element method, IJNME 102, 2015; abstract read). So a square says what a tau means. Its hourglass mode, x y
// along one axis, has the same energy as
//   pure bending, exactly                                     tau = 1/3
//   the bilinear quadrilateral, integrated in full            tau = (1 / (1 - nu^2) + 1 / (2 (1 + nu))) / 3
//   the two linear triangles that a diagonal makes of it      three times that
// For plane stress the second is 0.5 at nu = 0 and 0.4945 at 0.3: tau = 1/2 makes a square the standard four-node
// element. The third is 1.48 at 0.3: there a square is as stiff as triangles. Scaled by E alone, the stabilisation does
// not lock as lambda grows. experiments/polygon_stabilisation.toml sweeps tau.
//
// In space with bending only the departure in the polygon's plane counts, d - (n d) n with the normal n of F, for what
// departs from the plane bends (bending.h). n turns with F: with g = sum (n d_i) d_i and the dual basis F^a of F's
// columns that adds tau E (g F^a) n to column a of the stress. The stiffness is that of Gauss and Newton, tau E J^T J
// with the derivative J of the departure in the plane, positive semi-definite; without the share of n in it a bent
// sheet gained energy. Without bending nothing else keeps the corners of a polygon in its plane, and all of d counts.
//
// Bending sees what a fit to many vertices sees: a corner may leave the plane, and others go the other way, at no cost,
// and in a falling sheet corners flew off. So what they depart along n from a quadratic (PolygonElement::unbent), c,
// has the energy 8 (1 - nu) D / A |c|^2 / 2: a square's for its twist, x y, of which each corner is a quarter of A away
// from the plane (Kirchhoff's plate, own calculation). A quadratic costs nothing more, so the patch test holds.
//
// A plate whose corners go far from its plane stretches. F, the mean over flat sides, does not see it: in small pieces
// corners went ten times as far as the polygon is wide for nothing, and a cut that took such a polygon apart found its
// triangles stretched. So what they depart along n, a, has the energy tau E / (8 A) |a|^4, too. For tau = 1/2 that is
// 0.8 of a twisted square's, whose corners keep their places in the plane (von Karman's plate with nu = 0, own
// calculation). Of a bend it is of fourth order, as is what F errs by.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "harness/fem/elements/element_table.h"
#include "harness/fem/elements/membrane.h"

namespace cutbench {

/// Their linear stiffness at rest in the plane.
class CompoundStiffness {
 public:
  CompoundStiffness(const ElementTable& elements, const Lame& lame);
  /// force += K moved, for two values per vertex. \param elements  as they were
  void add_force(const ElementTable& elements, const Field& moved, Field& force) const;

 private:
  std::vector<Eigen::MatrixXd> stiffness_;  // per slot: of the corners, N/m
};

/// One of them at x.
template <int D>
struct BentCompound {
  Deformation<D> deformation;
  Eigen::Matrix<double, D, Eigen::Dynamic> departure;  ///< of x
  Eigen::VectorXd across;                              ///< n d_i
  Eigen::Matrix<double, D, Eigen::Dynamic> tilt;       ///< F^a G_i,a: n turns by -tilt_i for a unit of x_i along n
  Eigen::VectorXd unbent;                              ///< c
  Eigen::Matrix<double, D, Eigen::Dynamic> force;      ///< on the corners, N
};

/// How one of them answers to being deformed.
template <int D>
class CompoundLaw {
 public:
  using Block = Eigen::Matrix<double, D, D>;
  /// \param twist  (1 - nu) D of the bending that keeps them flat, N m; 0: none does
  CompoundLaw(const MembraneLaw& law, double twist) : law_(law), young_(young_of(law.lame)), twist_(8 * twist) {}

  void bend(const PolygonElement& polygon, const Field& x, BentCompound<D>& bent) const;
  double energy(const PolygonElement& polygon, const BentCompound<D>& bent) const;
  /// Block i k + j of the stiffness is that of corners i and j.
  void stiffness(const PolygonElement& polygon, const BentCompound<D>& bent, std::vector<Block>& blocks) const;

 private:
  /// What the departure is resisted with, N/m: tau E in the element's plane, what is less of it across, and what c is;
  /// and what stretch is, N/m^3.
  struct Stabilisation {
    double in_plane, less_across, twist, stretch;
  };
  Stabilisation stabilisation_of(const PolygonElement& polygon) const {
    const double in_plane = polygon.polygon.stabilisation * young_;
    if (D == 2 || twist_ == 0) return {in_plane, 0, 0, 0};
    const double twist = std::min(in_plane, twist_ / polygon.area);  // explicit steps have room for no more
    return {in_plane, in_plane, twist, in_plane / (2 * polygon.area)};
  }

  MembraneLaw law_;
  double young_;  // N/m
  double twist_;  // 8 (1 - nu) D, N m
};

template <int D>
class CompoundSheet {
 public:
  explicit CompoundSheet(const CompoundLaw<D>& law) : law_(law) {}

  /// For the compound of t, new or of another shape.
  void reset(const ElementTable& elements, TriangleIndex t);
  /// Where the blocks of the compounds that have this corner are in its row of the matrix.
  void find_slots(const ElementTable& elements, std::size_t vertex, const BlockMatrix<D>& blocks);

  /// Deformations of all at x; adds the forces they exert. The functions below refer to this x.
  void rotate(const ElementTable& elements, const Field& x, Field& force);
  double energy(const ElementTable& elements) const;
  /// Of a member.
  const Deformation<D>& deformation(const Element& member) const {
    return states_[to_size(member.polygon)].bent.deformation;
  }
  void add_stiffness(const ElementTable& elements, double factor, BlockMatrix<D>& blocks) const;

 private:
  struct State {
    BentCompound<D> bent;
    std::vector<std::int32_t> slots;  ///< k x k, row by row
  };

  CompoundLaw<D> law_;
  std::vector<State> states_;  // per polygon slot
};

}  // namespace cutbench
