#include <cmath>
#include <numbers>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/problems/common/members.h"
#include "harness/problems/in_plane/case_parts.h"

namespace cutbench {

namespace {

using std::numbers::pi;
constexpr double half_length = 0.25;  // of straight cuts

WindowCase straight(std::string name, std::string effect, std::string truth, const PlaneStress& stress) {
  const double root = std::sqrt(pi * half_length);
  const StressIntensity k{stress.yy * root, stress.xy * root};
  WindowCase window{std::move(name), std::move(effect), std::move(truth)};
  window.measures = {"energy_norm", "opening", "displacement_l2", "released_energy", "strain_energy", "k1", "k2"};
  window.field = [=](const Axes& frame) { return straight_crack_field(sheet_material, frame, half_length, stress); };
  window.cuts = {line({-half_length, 0}, {half_length, 0})};
  window.before = stress;
  window.tips = {straight_tip({half_length, 0}, 0, k), straight_tip({-half_length, 0}, pi, k)};
  window.lips = straight_lips({0, 0}, half_length);
  return window;
}

WindowCase centre_crack() {
  return straight("centre_crack", "a cut across the tension gapes, and gives off energy",
                  "infinite plate: pi s^2 a^2 / E, gape (4 s / E) sqrt(a^2 - x^2), K1 = s sqrt(pi a); Muskhelishvili",
                  {0, pull, 0});
}

WindowCase two_cuts_one_geometry() {
  WindowCase window = centre_crack();
  window.name = "two_cuts_one_geometry";
  window.effect = "the centre crack in two cuts, the second from the first one's tip on: no worse than by one";
  constexpr double joint = 0.3 * half_length;
  window.cuts = {line({-half_length, 0}, {joint, 0}), line({joint, 0}, {half_length, 0})};
  return window;
}

WindowCase inclined_crack() {
  const double c = std::cos(30 * degree), s = std::sin(30 * degree);
  return straight("inclined_crack", "a cut at 30 degrees to the normal of the tension gapes and slides",
                  "infinite plate: K1 = s sqrt(pi a) cos^2 b, K2 = s sqrt(pi a) sin b cos b; Muskhelishvili",
                  {pull * s * s, pull * c * c, pull * s * c});
}

WindowCase williams(int mode) {
  const StressIntensity k{mode == 1 ? 1.0 : 0.0, mode == 2 ? 1.0 : 0.0};
  const std::string number = std::to_string(mode);
  WindowCase window{"williams_mode_" + number,
                    "the end of a cut inside a triangle, " +
                        std::string(mode == 1 ? "opening: stresses like 1 / sqrt(r)" : "sliding"),
                    "Williams 1957, K" + number + " = 1 alone"};
  window.measures = {"energy_norm", "displacement_l2", "strain_energy", "k1", "k2"};
  window.field = [=](const Axes& frame) { return williams_field(sheet_material, frame, k); };
  window.cuts = {line({-2, 0}, {0, 0})};
  window.mouth = true;
  window.tips = {straight_tip({0, 0}, 0, k)};
  return window;
}

/// Pulled in all directions, or along the axis of symmetry alone.
WindowCase arc_crack(int degrees, bool all_round) {
  constexpr double half_chord = 0.2;
  const double half = degrees * degree, radius = half_chord / std::sin(half);
  const PlaneStress everywhere{pull, pull, 0}, along_axis{pull, 0, 0}, stress = all_round ? everywhere : along_axis;
  const auto field = [=](const Axes& frame, const PlaneStress& far_away) {
    return arc_crack_field(sheet_material, frame, radius, half, far_away);
  };
  const std::string twice = std::to_string(degrees);
  WindowCase window{"arc_crack_" + twice + (all_round ? "" : "_uniaxial"),
                    "a curved cut, an arc of twice " + twice + " degrees, pulled " +
                        (all_round ? "in all directions" : "along its axis of symmetry"),
                    "infinite plate: Muskhelishvili's potentials, the handbook's K"};
  window.measures = {"energy_norm", "opening", "released_energy", "strain_energy", "k1", "k2"};
  window.field = [=](const Axes& frame) { return field(frame, stress); };
  window.cuts = {arc(radius, -half, half)};
  window.middle = {radius * (1 + std::cos(half)) / 2, 0};
  window.before = stress;
  for (const double side : {1.0, -1.0}) {
    const auto at_this_end = [=](StressIntensity k) { return StressIntensity{k.k1, side * k.k2}; };
    const StressIntensity k_all = at_this_end(arc_intensity_all_round(radius, half, pull)),
                          k_axis = at_this_end(arc_intensity_along_axis(radius, half, pull));
    const Tip tip{{half_chord / std::tan(half), side * half_chord}, side * (half + pi / 2), side / radius};
    window.tips.push_back(
        {tip, all_round ? k_all : k_axis, [=](const Axes& frame) {
           return std::array{Mode{field(frame, everywhere), k_all}, Mode{field(frame, along_axis), k_axis}};
         }});
  }
  const double step = 2 * half / lip_samples;
  for (int i = 0; i < lip_samples; ++i) {
    const Point2 out{std::cos(-half + (i + 0.5) * step), std::sin(-half + (i + 0.5) * step)};
    window.lips.push_back({radius * out, out, radius * step});
  }
  return window;
}

WindowCase kirsch_hole() {
  constexpr double radius = 0.2;
  WindowCase window{"kirsch_hole", "a round piece cut out: three times the tension at the rim",
                    "infinite plate: hoop stress s (1 - 2 cos 2t); Kirsch 1898"};
  window.measures = {"energy_norm", "rim_stress", "released_energy"};
  window.field = [=](const Axes& frame) { return hole_field(sheet_material, frame, radius, pull); };
  window.cuts = {arc(radius, 0, 2 * pi)};
  window.before = {pull, 0, 0};
  window.rim = [=](Complex z) {
    const Complex out = z / std::abs(z);
    return RimPoint{radius * out, Complex(-out.imag(), out.real())};
  };
  return window;
}

WindowCase parallel_stress() {
  WindowCase window =
      straight("parallel_stress", "a cut along the tension changes nothing, whatever the triangles look like",
               "the uniform stress, to round-off", {pull, 0, 0});
  window.measures = {"stress", "energy_norm", "displacement_l2"};
  window.tips.clear();
  return window;
}

}  // namespace

std::vector<WindowCase> first_cases() {
  return {centre_crack(),         inclined_crack(),    williams(1),          williams(2),   arc_crack(30, true),
          arc_crack(45, true),    arc_crack(60, true), arc_crack(45, false), kirsch_hole(), parallel_stress(),
          two_cuts_one_geometry()};
}

}  // namespace cutbench
