// What a cut takes out of a sheet: a corner, an ellipse.
#include <cmath>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/problems/common/members.h"
#include "harness/problems/in_plane/case_parts.h"

namespace cutbench {

namespace {

/// A cut from the border to the corner's point and out again. What it takes off falls away.
WindowCase corner(int degrees, bool sliding) {
  const Corner shape{degrees / 2.0 * degree, sliding};
  const std::string angle = std::to_string(degrees);
  WindowCase window{"corner_" + angle + (sliding ? "_sliding" : ""),
                    "a corner of " + angle + " degrees that a cut leaves, pulled " + (sliding ? "along" : "apart"),
                    "the first term at the corner, stresses like r^(q - 1); Williams 1952"};
  window.measures = {"energy_norm", "displacement_l2", "strain_energy"};
  window.field = [=](const Axes& frame) { return corner_field(sheet_material, frame, shape, pull); };
  const Point2 side{2 * std::cos(shape.half_angle), 2 * std::sin(shape.half_angle)};
  window.cuts = {{Curve::Kind::polyline, false, {side, {0, 0}, {side.x, -side.y}}}};
  window.tips = {{{{0, 0}, 0}, {}}};
  window.cut_off = [=](Complex z) { return std::abs(std::arg(z)) > shape.half_angle; };
  return window;
}

/// The circle's Beziers, stretched.
Curve ellipse_curve(const Ellipse& ellipse) {
  Curve curve = arc(1, 0, 2 * std::numbers::pi);
  for (Point2& p : curve.points) p = {ellipse.a * p.x, ellipse.b * p.y};
  return curve;
}

WindowCase elliptic_hole(std::string name, std::string effect, double ratio, const PlaneStress& stress) {
  const Ellipse ellipse{0.25, 0.25 / ratio};
  WindowCase window{"elliptic_hole_" + std::move(name), std::move(effect),
                    "infinite plate: s (1 + 2 a / b) at the ends of the long axis; Inglis 1913"};
  window.measures = {"energy_norm", "rim_stress", "released_energy"};
  window.field = [=](const Axes& frame) { return elliptic_hole_field(sheet_material, frame, ellipse, stress); };
  window.cuts = {ellipse_curve(ellipse)};
  window.before = stress;
  window.rim = [=](Complex z) {
    const Complex t = ellipse.to_circle(z), on_circle = t / std::abs(t), i(0, 1);
    const Complex along = i * (on_circle - ellipse.ratio() / on_circle);
    return RimPoint{ellipse.from_circle(on_circle), along / std::abs(along)};
  };
  return window;
}

}  // namespace

std::vector<WindowCase> cut_out_cases() {
  return {corner(270, false),
          corner(270, true),
          corner(315, false),
          elliptic_hole("2", "an ellipse cut out, pulled across its long axis: five times the tension at its ends", 2,
                        {0, pull, 0}),
          elliptic_hole("2_oblique", "an ellipse cut out, pulled at 45 degrees to its axes", 2,
                        {pull / 2, pull / 2, pull / 2}),
          elliptic_hole("3", "a slender ellipse cut out, pulled in all directions", 3, {pull, pull, 0})};
}

}  // namespace cutbench
