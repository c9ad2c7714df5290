// Cuts in an infinite plate whose field is known in closed form. The sheet is a window of that plate: its border is
// held where the plate's field takes it, so there is no error of a finite size. Lips are free.
#pragma once

#include <functional>
#include <numbers>

#include "harness/problems/common/exact_fields.h"
#include "harness/problems/common/lips.h"
#include "harness/problems/common/problem.h"
#include "harness/problems/common/stress_intensity.h"

namespace cutbench {

/// An end of a cut inside the sheet, in the solution's own frame.
struct WindowTip {
  Tip tip;
  StressIntensity k;                                        ///< exact
  std::function<std::array<Mode, 2>(const Axes&)> modes{};  ///< to measure K by; none: it isn't measured
};

/// A place on the rim of a hole.
struct RimPoint {
  Complex at, tangent;  ///< unit length
};

/// What distinguishes one such problem from another. Places are in the solution's own frame, in sides of the sheet.
///
/// released_energy: before the cut the window is in the uniform state of the stress `before`, with energy U0. While the
/// lips' tractions t0 are let go the border moves, as the plate round it does, from u0 to u, and its tractions from t0
/// to t, which feeds in W = 1/2 integral (t0 + t)(u - u0). What the lips give off is U0 + W - U(after), exactly
/// 1/2 integral (t0 u - t u0) over the border; pi s^2 a^2 / E for a straight cut across the stress s. U(after) alone is
/// computed, and never below the exact one but for the border's interpolation, so no lucky sign hides an error.
/// strain_energy: U(after) alone. opening: gape along the requested curve, relative L2. energy_norm, displacement_l2:
/// of the error, relative; where the lips are loaded the energy norm is over the energy with their work. A method that
/// deletes material errs in the energy norm by all of that material's. k1, k2: mean over the tips, by the interaction
/// integral. rim_stress: hoop stress in the triangles at the rim, at the middle of their edges, relative L2. stress:
/// largest error of any component in any triangle.
struct WindowCase {
  std::string name, effect, truth;
  std::vector<std::string> measures{};
  std::function<ElasticField(const Axes&)> field{};
  std::vector<Curve> cuts{};
  Point2 middle{};       ///< comes to lie in the middle of the sheet, within a mesh cell
  PlaneStress before{};  ///< uniform, before the cut
  std::vector<WindowTip> tips{};
  std::vector<LipSample> lips{};           ///< where the opening is compared
  std::function<RimPoint(Complex)> rim{};  ///< of a hole: the place of the rim that a point is near
  bool mouth = false;                      ///< the cut is a ray along the negative x axis, out through the border
  double largest_turn = std::numbers::pi;  ///< odd members are turned by at most this, radians
  std::function<bool(Complex)> cut_off{};  ///< true where a cut takes a piece off that reaches the border
  /// N/m on the lip above a cut along the x axis, at x; the other lip is loaded in the other direction.
  std::function<Eigen::Vector2d(double)> on_lips{};
};

/// Members with even index lie along the x axis of the mesh, at a distance of 0.5e-6 to 0.5 cells (evenly in its
/// logarithm) from the mesh line in the middle of a grid, where slivers are made; odd ones anywhere in a cell, at any
/// angle that the case allows.
std::unique_ptr<const Problem> make_window_problem(WindowCase window);

/// The in-plane problems of this kind, in the order of the tables.
void append_window_problems(std::vector<std::unique_ptr<const Problem>>& problems);

std::vector<WindowCase> first_cases();    ///< window_cases.cpp
std::vector<WindowCase> crack_cases();    ///< several cuts, and loaded lips
std::vector<WindowCase> cut_out_cases();  ///< corners and ellipses

}  // namespace cutbench
