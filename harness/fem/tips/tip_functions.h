// Functions for the tips of incisions, beside the linear shape functions of a sheet at rest: displacements grow like
// sqrt(r) from a tip, which no linear function follows. Source: Chahine, Laborde and Renard, Crack tip enrichment in
// the XFEM using a cutoff function, Int. J. Numer. Meth. Engng 75 (2008). Per tip
//   u(p) += chi(r) sum_j F_j(r, theta) c_j,  j = 0 to 3, c_j a vector,
//   F = sqrt(r) {sin(theta/2), cos(theta/2), sin(theta/2) sin(theta), cos(theta/2) sin(theta)},
// which span the displacements of K1 and K2 (Williams 1957), and their rotations; chi = (1 - s)^2 up to the radius,
// s = r / radius. The linear functions have to follow the rest, (1 - chi) F, and their error goes with its second
// derivatives. Those of (1 - chi) sqrt(r) exp(i theta / 2) and (1 - chi) sqrt(r) exp(3 i theta / 2) together, squared
// and times r, integrate over r to 53/6 / radius; with the usual quintic, 1 - 10 s^3 + 15 s^4 - 6 s^5, to 257/14.
//
// A tip is a vertex inside the sheet at which one incision ends. theta is pi and -pi on the lips there, and is
// continued from triangle to triangle across edges that are not opened. So its branch cut is the incision itself,
// whatever its shape, across which all F change sign; beside an arc theta passes pi on one side of the tangent, as in
// the root of the exact field. The radius ends just short of the border and of any other end or branching of incisions,
// so that the tip's incision leaves the disc, and theta has one value everywhere. Other incisions that cross the disc
// end the functions.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "harness/mesh/sheet.h"

namespace cutbench {

class TipFunctions {
 public:
  static constexpr std::size_t per_tip = 4;
  struct Tip {
    VertexIndex vertex;
    Point2 at;
    double radius;  ///< of the functions' support, rest units
  };
  /// A tip whose functions are not all zero in a triangle.
  struct Reach {
    std::size_t tip;
    std::array<double, 3> theta;  ///< at the triangle's corners; NaN at the tip
  };
  /// Of chi F_j.
  struct Value {
    double value;              ///< sqrt(length)
    Eigen::Vector2d gradient;  ///< in rest space
  };

  /// Of all tips of the sheet with room for a radius of one mean edge. Looks at everything. `sheet` must outlive it.
  explicit TipFunctions(const Sheet& sheet);

  const std::vector<Tip>& tips() const { return tips_; }
  std::size_t unknowns() const { return 2 * per_tip * tips_.size(); }  ///< of tip i, function j, axis a: 8 i + 2 j + a
  std::span<const Reach> reaching(TriangleIndex t) const { return reaching_[t()]; }

  /// At a point of the triangle. \pre it is not the tip
  std::array<Value, per_tip> at(TriangleIndex t, const Reach& reach, Point2 p) const;

  struct Displacement {
    Eigen::Vector2d value = Eigen::Vector2d::Zero();
    Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();  ///< d u_i / d x_j
  };
  /// Of all functions, at a point of any triangle; nothing of a tip at itself. \param c  unknowns() values
  Displacement displacement(TriangleIndex t, Point2 p, const Eigen::VectorXd& c) const;

 private:
  void reach_from(std::size_t tip, HalfEdge incision);

  const Sheet& sheet_;
  std::vector<Tip> tips_;
  std::vector<std::vector<Reach>> reaching_;  // per triangle slot
};

}  // namespace cutbench
