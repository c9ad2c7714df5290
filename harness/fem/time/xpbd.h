// Extended position-based dynamics, what most games and many surgery simulators use: an implicit step without a matrix
// (Macklin, Mueller and Chentanez, XPBD: position-based simulation of compliant constrained dynamics, MIG 2016).
//
// An element's energy is written as C.S C / 2, with few values C that are zero at rest:
//   membrane   C = (e11, e22, 2 e12), the strain that membrane.h defines; S = A times the elasticity matrix
//   springs    C = the three stretches less 1 (springs.h); S = A E
//   bending    C = a row of a stencil (bending.h) for each coordinate; S = 1
// A sweep takes the elements one by one and moves their vertices by W G^T dl, with the inverse masses W, the gradient G
// of C, and
//   ((1 + beta / h) h^2 S G W G^T + I) dl = -(h^2 S (C + beta / h G (x - x0)) + l),   l += dl,
// from l = 0 and x0 at the begin of a step, with Rayleigh's stiffness damping beta; his mass damping alpha makes W
// smaller by 1 + h alpha. Where sweeps change nothing any more, l has the forces of backward Euler, though each part of
// it moved the vertices along the gradient of its time. Few sweeps leave the sheet too soft, the more so the finer or
// stiffer it is: small steps of one sweep are better than long ones of many (Macklin et al., Small steps in physics
// simulation, SCA 2019). The gradient of the co-rotational strain is taken as sym(R^T dF), which gives the forces of
// membrane.h.
#pragma once

#include <array>
#include <vector>

#include "harness/fem/model/model.h"

namespace cutbench {

template <int D>
class Xpbd {
 public:
  /// \param x0  m: at the begin of a step of h seconds
  /// \param x   m: where the step leads without inner forces; then where it leads
  /// \pre no constrained vertices, each triangle an element, lumped mass
  void solve(const Model<D>& model, double h, int sweeps, const Field& x0, Field& x);

 private:
  void sweep_membrane(const Model<D>& model, double h, const Field& x0, Field& x);
  void sweep_bending(const Bending& bending, double h, double damping, const Field& x0, Field& x);

  std::vector<double> inverse_mass_;                           // W, per unknown; 0 where it is held
  std::vector<Eigen::Vector3d> membrane_;                      // l, per triangle
  std::vector<std::array<std::array<double, D>, 3>> bending_;  // l, per triangle: of each row and coordinate
};

}  // namespace cutbench
