// A thin plate that is bent a little: what a hole, and the end of a cut, do to it. Its border is held where the
// infinite plate's shape takes it, over three rows of vertices, the fewest that know the curvature there.
//
// Kirchhoff's plate, D the rigidity, w the deflection; on free edges, n normal and s along: M_n = 0 and
// V_n = Q_n + dM_ns/ds = 0.
// Hole of radius a, bent to the cylinder w = k x^2 / 2 far away:
//   w = k / 4 (r^2 + 2 (1 + nu) / (1 - nu) a^2 ln(r / a) + (r^2 + t a^2 + u a^4 / r^2) cos 2 p),
//   t = 2 (1 - nu) / (3 + nu),  3 u = 2 nu t / (1 - nu) - 1.
// Of Goodier, Phil. Mag. 22 (1936), whose result for the moment at the rim is well known; not read, derived here.
// End of a cut along the negative x axis: w = c r^(3/2) (cos 3 p / 2 - 3 (1 - nu) / (7 + nu) cos p / 2), of Williams,
// J. Appl. Mech. 28 (1961); not read, derived here. tests/bent_plate_test.cpp checks plate and edges by differences.
//
// energy_norm: root of the energy of bending to the difference from the exact shape at the vertices, over that to the
// exact shape. deflection_l2: of the difference, by the vertices' masses, over the exact one.
#pragma once

#include <cmath>
#include <complex>
#include <numbers>

#include "harness/mesh/families.h"
#include "harness/problems/common/cut_curves.h"
#include "harness/problems/common/members.h"
#include "harness/problems/out_of_plane/bent_sheet.h"

namespace cutbench {

/// w of the plate with a hole, at a place in its frame. \pre |z| > 0
inline double bent_hole(std::complex<double> z, double curvature, double radius, double poisson) {
  const double q = radius * radius / std::norm(z), t = 2 * (1 - poisson) / (3 + poisson);
  const double u = (2 * poisson * t / (1 - poisson) - 1) / 3;
  const double even = 1 - (1 + poisson) / (1 - poisson) * q * std::log(q);
  return curvature / 4 * std::norm(z) * (even + (1 + t * q + u * q * q) * std::cos(2 * std::arg(z)));
}

/// w round the end of a cut; the angle may go beyond pi, over the cut.
inline double bent_crack(double r, double angle, double poisson) {
  return std::pow(r, 1.5) * (std::cos(1.5 * angle) - 3 * (1 - poisson) / (7 + poisson) * std::cos(0.5 * angle));
}

class BentPlate : public Problem {
 public:
  enum class Cut { hole, crack };
  explicit BentPlate(Cut cut, double poisson = 0.3) : cut_(cut), poisson_(poisson) {}

  std::string name() const override { return cut_ == Cut::hole ? "bent_plate_hole" : "bent_plate_crack"; }
  std::string effect() const override {
    return cut_ == Cut::hole ? "a plate with a hole in it is bent" : "a plate is bent so that a cut in it kinks";
  }
  std::string truth() const override {
    return cut_ == Cut::hole ? "infinite plate; Goodier 1936" : "the first term at the end of the cut; Williams 1961";
  }
  std::vector<std::string> measures() const override { return {"energy_norm", "deflection_l2"}; }
  bool takes_budgets() const override { return false; }

  Specimen specimen(const std::string& family, int n, std::uint64_t seed, std::size_t index) const override {
    MemberNumbers numbers(seed, index);
    Specimen result{.mesh = make_sheet(family, n), .cuts = {}};
    result.origin = {0.5 + numbers.between(-0.5, 0.5) / n, 0.5 + numbers.between(-0.5, 0.5) / n};
    // In turns near a mesh line, 0.5e-3 to 0.5 widths of a triangle from it, as slit_strip has it, and anywhere.
    const int middle = n / 2;
    if (index % 2 == 0)
      result.origin.y = (middle + 0.5 * std::pow(10, numbers.between(-3, 0)) * (numbers.coin() ? 1 : -1)) / n;
    else
      result.angle = numbers.between(0, 2 * std::numbers::pi);
    result.cuts = {cut_ == Cut::hole ? arc(radius, 0, 2 * std::numbers::pi) : line({-2, 0}, {0, 0})};
    for (Curve& curve : result.cuts)
      for (Point2& p : curve.points) p = from_frame(result, p);
    return result;
  }

  std::vector<Answer> answer(const Specimen& specimen, const Sheet& sheet, std::span<const Budget> budgets,
                             const Constraints& constraints) const override {
    const std::vector<int> ring = rings_from_border(sheet, held_rings);
    const std::vector<Point2> side = sides(sheet);
    const std::vector<int> copies = copies_of_vertices(sheet);
    const auto place = [&](DeformedIndex d) { return to_frame(specimen, sheet.rest(sheet.rest_vertex(d))); };
    const auto fallen = [&](Point2 p) { return cut_ == Cut::hole && std::hypot(p.x, p.y) < radius; };
    const auto exact = [&](DeformedIndex d) { return deflection(place(d), to_frame(specimen, side[d()])); };
    // What fell out of the hole is held by all of its vertices but those of its rim, which the plate has, too.
    const auto start = [&](DeformedIndex d) {
      const Point2 rest = sheet.rest(sheet.rest_vertex(d));
      const bool held = ring[d()] < held_rings || (fallen(place(d)) && copies[sheet.rest_vertex(d)()] == 1);
      const bool in_hole = fallen(to_frame(specimen, side[d()]));
      return Start{{rest.x, rest.y, in_hole ? 0 : exact(d)}, {held, held, held}};
    };
    std::vector<Answer> answers;
    for (const Budget& budget : budgets) {
      BentSheet bent(sheet, {.density = 1, .stiffness = 10, .poisson = poisson_, .bending = 1}, BendingKind::patches, 0,
                     start, constraints);
      Answer& answer = answers.emplace_back();
      if (!bent.solve_to_equilibrium(budget.solver, answer)) continue;
      double off = 0, scale = 0;
      for (const DeformedIndex d : vertices_in_use(sheet)) {
        if (fallen(to_frame(specimen, side[d()]))) continue;
        off += bent.mass(d) * std::pow(bent.position(d).z - exact(d), 2);
        scale += bent.mass(d) * std::pow(exact(d), 2);
      }
      const auto deflected = [&](auto value) {
        return bent.bending_energy([&](DeformedIndex d) {
          const Point2 rest = sheet.rest(sheet.rest_vertex(d));
          return Point3{rest.x, rest.y, fallen(to_frame(specimen, side[d()])) ? 0 : value(d)};
        });
      };
      const double error = deflected([&](DeformedIndex d) { return bent.position(d).z - exact(d); });
      const double norm = std::sqrt(error / deflected(exact)), l2 = std::sqrt(off / scale);
      answer.measures = {{"energy_norm", norm, 0, norm}, {"deflection_l2", l2, 0, l2}};
    }
    return answers;
  }

 private:
  /// On the side of the cut that `side` is on; beyond the cut the shape is continued.
  double deflection(Point2 p, Point2 side) const {
    if (cut_ == Cut::hole) {
      const double r = std::max(std::hypot(p.x, p.y), radius / 4);  // nothing of the plate is deeper in the hole
      return bent_hole(std::polar(r, std::atan2(p.y, p.x)), size, radius, poisson_);
    }
    double angle = std::atan2(p.y, p.x);
    const double of_side = std::atan2(side.y, side.x);
    if (angle - of_side > std::numbers::pi) angle -= 2 * std::numbers::pi;
    if (of_side - angle > std::numbers::pi) angle += 2 * std::numbers::pi;
    return size * bent_crack(std::hypot(p.x, p.y), angle, poisson_);
  }

  static constexpr double radius = 0.2;  // m, of the hole
  static constexpr double size = 4e-3;   // 1/m: so flat that the membrane has no part in it
  static constexpr int held_rings = 3;

  Cut cut_;
  double poisson_;
};

}  // namespace cutbench
