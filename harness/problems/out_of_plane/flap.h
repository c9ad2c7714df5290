// A three-sided cut makes a flap in a sheet that is held: it hangs from its fourth side, at any angle to the mesh.
#pragma once

#include <cmath>
#include <numbers>

#include "harness/mesh/families.h"
#include "harness/problems/common/members.h"
#include "harness/problems/out_of_plane/bent_sheet.h"
#include "harness/problems/out_of_plane/heavy_elastica.h"

namespace cutbench {

class Flap : public Problem {
 public:
  explicit Flap(BendingKind bending = BendingKind::patches) : bending_(bending), elastica_(length, load) {}

  std::string name() const override { return "flap"; }
  std::string effect() const override { return "a flap cut on three sides hangs from the fourth"; }
  std::string truth() const override { return "heavy elastica D th'' = q (L - s) cos th (nu = 0; Love 262)"; }
  std::vector<std::string> measures() const override { return {"profile_rms", "tip"}; }
  bool takes_budgets() const override { return false; }

  Specimen specimen(const std::string& family, int n, std::uint64_t seed, std::size_t index) const override {
    MemberNumbers numbers(seed, index);
    Specimen result{.mesh = make_sheet(family, n), .cuts = {}};
    result.angle = numbers.between(0, 2 * std::numbers::pi);
    result.origin = {0.5, 0.5};
    result.origin =
        from_frame(result, {-length / 2, 0}) + Point2{numbers.between(-0.03, 0.03), numbers.between(-0.03, 0.03)};
    result.cuts = {{Curve::Kind::polyline,
                    false,
                    {from_frame(result, {0, -half_width}), from_frame(result, {length, -half_width}),
                     from_frame(result, {length, half_width}), from_frame(result, {0, half_width})}}};
    return result;
  }

  std::vector<Answer> answer(const Specimen& specimen, const Sheet& sheet, std::span<const Budget> budgets,
                             const Constraints& constraints) const override {
    const std::vector<Point2> side = sides(sheet);
    const auto in_flap = [&](DeformedIndex d) {
      const Point2 p = to_frame(specimen, side[d()]);
      return p.x > 0 && p.x < length && std::abs(p.y) < half_width;
    };
    const auto rest = [&](DeformedIndex d) { return to_frame(specimen, sheet.rest(sheet.rest_vertex(d))); };
    const auto start = [&](DeformedIndex d) {
      const Point2 p = rest(d);
      const bool held = p.x <= clamp || p.x >= length + margin || std::abs(p.y) >= half_width + margin;
      if (!in_flap(d)) return Start{{p.x, p.y, 0}, {held, held, held}};
      const HeavyElastica::Section s = elastica_.at(p.x);
      return Start{{s.x, p.y, s.z}, {held, held, held}};
    };
    std::vector<Answer> answers;
    for (const Budget& budget : budgets) {
      Answer& answer = answers.emplace_back();
      BentSheet bent(sheet, {.density = 1, .stiffness = stiffness, .poisson = 0, .bending = 1}, bending_, weight, start,
                     constraints);
      if (!bent.solve_to_equilibrium(budget.solver, answer)) continue;
      double squares = 0, mass = 0, tip = 0, tip_mass = 0;
      for (const DeformedIndex d : vertices_in_use(sheet)) {
        if (!in_flap(d) || bent.held(d)) continue;
        const Point2 at = rest(d);
        const Point3 p = bent.position(d), exact = start(d).position, e = p + -1 * exact;
        squares += bent.mass(d) * (e.x * e.x + e.y * e.y + e.z * e.z);
        mass += bent.mass(d);
        if (at.x > 0.9 * length) {
          tip += bent.mass(d) * e.z;
          tip_mass += bent.mass(d);
        }
      }
      const double depth = -elastica_.at(length).z, rms = std::sqrt(squares / mass) / depth;
      answer.measures = {{"profile_rms", rms, 0, rms}};
      // The end of the flap, over its last tenth: the exact end, and how much deeper or higher that tenth is.
      answer.measures.push_back(compared("tip", depth - tip / tip_mass, depth));
    }
    return answers;
  }

 private:
  // D = 1 N m. The frame's origin is the middle of the fourth side, its x axis runs along the flap.
  static constexpr double length = 0.6, half_width = 0.2;              // m
  static constexpr double load = 4;                                    // q L^3 / D
  static constexpr double stiffness = 2e4 / (length * length);         // N/m: E L^2 / D = 2e4
  static constexpr double weight = load / (length * length * length);  // N/m2
  /// The flap is held on the exact shape up to here, over rows enough to know the slope, and the sheet around it flat.
  static constexpr double clamp = 0.15;  // m
  /// Around the cut the sheet is free, so that a method may open it that far from where it was asked to.
  static constexpr double margin = 0.07;  // m

  BendingKind bending_;
  HeavyElastica elastica_;
};

}  // namespace cutbench
