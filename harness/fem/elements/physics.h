// What a scene says of the physics: material, which terms there are, what is held and what pulls. SI units; the sheet's
// thickness is in the numbers per area and per length.
#pragma once

#include <array>
#include <limits>
#include <optional>
#include <vector>

#include "harness/base/enum_names.h"
#include "harness/mesh/types.h"

namespace cutbench {

struct Material {
  double density = 1;            ///< kg/m2
  double stiffness = 1000;       ///< Young's modulus x thickness, N/m
  double poisson = 0.3;          ///< plane stress: (-1, 1); plane strain: (-1, 0.5)
  double bending = 0;            ///< flexural rigidity D, N m
  double mass_damping = 0;       ///< Rayleigh alpha, 1/s
  double stiffness_damping = 0;  ///< Rayleigh beta, s
};

// A new value is entered in the table of names below its enum; the compiler then names every switch that lacks it.

enum class Plane : std::uint8_t { stress, strain };
constexpr EnumNames<Plane, 2> plane_names{{{Plane::stress, "stress"}, {Plane::strain, "strain"}}};

/// membrane.h and springs.h say what each is.
enum class Strain : std::uint8_t { linear, corotational, green, springs };
constexpr EnumNames<Strain, 4> strain_names{{{Strain::linear, "linear"},
                                             {Strain::corotational, "corotational"},
                                             {Strain::green, "green"},
                                             {Strain::springs, "springs"}}};

/// The stiffness that stress gives to a membrane (membrane.h): `positive` leaves out what is negative, so
/// that the matrix is positive semi-definite; `full` is the exact second derivative, which has no bound where a
/// triangle collapses; `none` leaves all of it out.
enum class StressStiffness : std::uint8_t { none, positive, full };
constexpr EnumNames<StressStiffness, 3> stress_stiffness_names{
    {{StressStiffness::none, "none"}, {StressStiffness::positive, "positive"}, {StressStiffness::full, "full"}}};

/// A place in the table of kinds (bending_kinds.h), which has the names and may have more kinds than these.
enum class BendingKind : std::uint8_t { none, patches, hinges };

/// `stabilised` and `scaled`: lumped, and more for thin elements (added_mass.h).
enum class Mass : std::uint8_t { lumped, consistent, stabilised, scaled };
constexpr EnumNames<Mass, 4> mass_names{{{Mass::lumped, "lumped"},
                                         {Mass::consistent, "consistent"},
                                         {Mass::stabilised, "stabilised"},
                                         {Mass::scaled, "scaled"}}};
constexpr bool adds_mass(Mass mass) { return mass == Mass::stabilised || mass == Mass::scaled; }

enum class Integrator : std::uint8_t { backward_euler, midpoint, symplectic_euler, xpbd, vbd, equilibrium };
constexpr EnumNames<Integrator, 6> integrator_names{{{Integrator::backward_euler, "backward_euler"},
                                                     {Integrator::midpoint, "midpoint"},
                                                     {Integrator::symplectic_euler, "symplectic_euler"},
                                                     {Integrator::xpbd, "xpbd"},
                                                     {Integrator::vbd, "vbd"},
                                                     {Integrator::equilibrium, "equilibrium"}}};

/// A step sweeps over elements or vertices instead of solving linear systems.
constexpr bool sweeps(Integrator integrator) { return integrator == Integrator::xpbd || integrator == Integrator::vbd; }
/// A step solves linear systems.
constexpr bool solves(Integrator integrator) {
  return integrator != Integrator::symplectic_euler && !sweeps(integrator);
}

/// A scene builds only what it names.
struct Physics {
  int dimension = 3;  ///< unknowns per vertex: 2 (in the plane) or 3
  Plane plane = Plane::stress;
  Strain strain = Strain::corotational;
  StressStiffness stress_stiffness = StressStiffness::positive;  ///< linear strain has none
  BendingKind bending = BendingKind::none;                       ///< none in 2D
  Mass mass = Mass::lumped;
  /// Of a mass that is stabilised or scaled: the largest eigenvalue of an element, over that of the sheet before any
  /// cut.
  double mass_limit = 1;
  Point3 gravity{};  ///< m/s2

  StressStiffness stress_stiffness_made() const {
    return strain == Strain::linear ? StressStiffness::none : stress_stiffness;
  }
};

/// Part of rest space, borders included. A point is a box without extent, so that every copy of a vertex lies in it.
struct Box {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  Point2 low{-infinity, -infinity}, high{infinity, infinity};
  bool contains(Point2 p) const { return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y; }
};

/// Vertices whose rest position lies in the box are held on some axes: at their initial position plus the displacement
/// plus velocity x time.
struct Pin {
  Box where;
  std::array<bool, 3> axes{true, true, true};
  Point3 displacement{};  ///< m
  Point3 velocity{};      ///< m/s
};

/// Force per length on the border edges both of whose ends lie in the box.
struct Traction {
  Box where;
  Point3 force;  ///< N/m
};

}  // namespace cutbench
