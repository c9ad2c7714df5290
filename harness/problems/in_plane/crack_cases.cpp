// Several cuts in one plate, and cuts whose lips are loaded.
#include <cmath>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/problems/common/members.h"
#include "harness/problems/in_plane/case_parts.h"

namespace cutbench {

namespace {

using std::numbers::pi;
constexpr double half = 0.25;  // of a lone cut's length

/// An end whose K isn't measured: the ring would hold another end, or loaded lips.
WindowTip unmeasured_tip(Point2 at, double angle) { return {{at, angle}, {}}; }

/// `count` cuts of those that have no end lie on the sheet; its border runs through the bridges beside them.
WindowCase collinear_cracks(int count, double half_length, double period) {
  const std::string number = std::to_string(count);
  WindowCase window{"collinear_cracks_" + number,
                    number + " cuts in a row, with bridges between them that carry the whole tension",
                    "infinite plate, a row without end: K1 = s sqrt(W tan(pi a / W)); Westergaard 1939"};
  window.measures = {"energy_norm", "opening", "displacement_l2", "released_energy", "strain_energy"};
  const PlaneStress stress{0, pull, 0};
  window.field = [=](const Axes& frame) {
    return collinear_cracks_field(sheet_material, frame, half_length, period, stress);
  };
  window.before = stress;
  window.middle = {(count - 1) / 2.0 * period, 0};
  window.largest_turn = 8 * degree;
  for (int i = 0; i < count; ++i) {
    const double middle = i * period;
    const Point2 left{middle - half_length, 0}, right{middle + half_length, 0};
    window.cuts.push_back(line(left, right));
    window.tips.push_back(unmeasured_tip(left, pi));
    window.tips.push_back(unmeasured_tip(right, 0));
    for (const LipSample& lip : straight_lips({middle, 0}, half_length)) window.lips.push_back(lip);
  }
  return window;
}

WindowCase loaded_lips(std::string name, std::string effect, const LipLoad& load) {
  WindowCase window{"loaded_lips_" + std::move(name), std::move(effect),
                    "infinite plate, loaded on the lips alone: K1 = (p0 +- p1 / 2) sqrt(pi a); Tada"};
  window.measures = {"energy_norm", "opening", "displacement_l2", "strain_energy"};
  window.field = [=](const Axes& frame) { return loaded_crack_field(sheet_material, frame, half, load); };
  window.cuts = {line({-half, 0}, {half, 0})};
  window.tips = {unmeasured_tip({half, 0}, 0), unmeasured_tip({-half, 0}, pi)};
  window.lips = straight_lips({0, 0}, half);
  window.on_lips = [=](double x) { return load.above(x, half); };
  return window;
}

WindowCase crossed_cracks() {
  WindowCase window{"crossed_cracks", "two cuts cross: four corners meet that bear nothing",
                    "infinite plate pulled in all directions: K1 = 0.8635 s sqrt(pi a); Rooke and Sneddon 1969"};
  window.measures = {"energy_norm", "opening", "displacement_l2", "released_energy", "strain_energy", "k1", "k2"};
  window.field = [](const Axes& frame) { return crossed_cracks_field(sheet_material, frame, half, pull); };
  window.before = {pull, pull, 0};
  window.cuts = {line({-half, 0}, {half, 0}), line({0, -half}, {0, half})};
  const StressIntensity k{crossed_cracks_factor() * pull * std::sqrt(pi * half), 0};
  window.tips = {straight_tip({half, 0}, 0, k), straight_tip({0, half}, pi / 2, k), straight_tip({-half, 0}, pi, k),
                 straight_tip({0, -half}, -pi / 2, k)};
  window.lips = straight_lips({0, 0}, half);
  for (const LipSample& lip : straight_lips({0, 0}, half)) window.lips.push_back({{0, lip.at.x}, {1, 0}, lip.length});
  return window;
}

}  // namespace

std::vector<WindowCase> crack_cases() {
  return {collinear_cracks(2, 0.18, 0.5),
          collinear_cracks(3, 0.115, 0.335),
          loaded_lips("pressure", "a pressure on the lips of a cut", {{pull, 0}, {}}),
          loaded_lips("wedge", "a pressure that grows from one end of the cut to the other", {{pull, pull}, {}}),
          loaded_lips("sheared", "lips that are pushed apart and along each other", {{pull, 0}, {pull, 0}}),
          crossed_cracks()};
}

}  // namespace cutbench
