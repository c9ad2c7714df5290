// Energies, momenta and forces of a moving sheet, in numbers.
#pragma once

#include "harness/mesh/types.h"

namespace cutbench {

/// Joules.
struct Energy {
  double membrane = 0, bending = 0, kinetic = 0;
  double potential = 0;  ///< of gravity and tractions, zero at the origin
  double total() const { return membrane + bending + kinetic + potential; }
};

/// Energies, momenta and residual force, recorded before and after a cut.
struct Balance {
  Energy energy;
  Point3 momentum;          ///< kg m/s
  Point3 angular_momentum;  ///< kg m2/s, about the origin
  double residual = 0;      ///< N: norm of internal and external force on the unknowns that are not held
};

}  // namespace cutbench
