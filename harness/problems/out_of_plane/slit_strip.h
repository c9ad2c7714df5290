// A heavy sheet clamped on one side bends to a cylinder; without Poisson's effect each lengthwise part of it hangs like
// the whole.
//
// Slivers beside the slit stiffen the lip that they lie on: a slit 1e-2, 1e-3, 3e-4 of a square's width from a mesh
// line (alternating, n = 20, plain split) lifts the end of its half by 0.01, 0.4, 0.75 %. At 1e-5 no solve converges.
#pragma once

#include <cmath>

#include "harness/mesh/families.h"
#include "harness/problems/common/members.h"
#include "harness/problems/out_of_plane/bent_sheet.h"
#include "harness/problems/out_of_plane/heavy_elastica.h"

namespace cutbench {

class SlitStrip : public Problem {
 public:
  explicit SlitStrip(BendingKind bending = BendingKind::patches) : bending_(bending), elastica_(1, load) {}

  std::string name() const override { return "slit_strip"; }
  std::string effect() const override { return "both halves of a strip slit lengthwise hang like the whole"; }
  std::string truth() const override { return "heavy elastica D th'' = q (L - s) cos th (nu = 0; Love 262)"; }
  std::vector<std::string> measures() const override { return {"profile_rms", "tip", "tip_moved_by_slit"}; }
  bool takes_budgets() const override { return false; }

  Specimen specimen(const std::string& family, int n, std::uint64_t seed, std::size_t index) const override {
    MemberNumbers numbers(seed, index);
    Specimen result{.mesh = make_sheet(family, n), .cuts = {}};
    // In turns near a mesh line, 0.5e-3 to 0.5 widths of a triangle from it, and anywhere.
    const double off = 0.5 * std::pow(10, numbers.between(-3, 0)) * (numbers.coin() ? 1 : -1);
    const double y = index % 2 == 0 ? 0.5 + off / n : numbers.between(0.3, 0.7), from = numbers.between(0.3, 0.5);
    result.origin = {0, y};
    result.cuts = {{Curve::Kind::polyline, false, {{1.1, y}, {from, y}}}};
    return result;
  }

  std::vector<Answer> answer(const Specimen& specimen, const Sheet& sheet, std::span<const Budget> budgets,
                             const Constraints& constraints) const override {
    const Sheet whole(specimen.mesh);
    const double depth = -elastica_.at(1).z;
    std::vector<Answer> answers;
    for (const Budget& budget : budgets) {
      Answer& answer = answers.emplace_back();
      Answer of_whole;
      BentSheet slit = hung(sheet, constraints), uncut = hung(whole);
      if (!slit.solve_to_equilibrium(budget.solver, answer)) continue;
      if (!uncut.solve_to_equilibrium(budget.solver, of_whole)) {
        answer.verdict = of_whole.verdict;
        answer.reason = "the sheet before the cut: " + of_whole.reason;
        continue;
      }
      double squares = 0, mass = 0;
      for (const DeformedIndex d : vertices_in_use(sheet)) {
        if (slit.held(d)) continue;
        const Point2 rest = sheet.rest(sheet.rest_vertex(d));
        const HeavyElastica::Section exact = elastica_.at(rest.x);
        const Point3 p = slit.position(d);
        squares += slit.mass(d) * (std::pow(p.x - exact.x, 2) + std::pow(p.y - rest.y, 2) + std::pow(p.z - exact.z, 2));
        mass += slit.mass(d);
      }
      const double rms = std::sqrt(squares / mass) / depth;
      const double y = specimen.origin.y;
      const double lower = end_depth(sheet, slit, 0, y), upper = end_depth(sheet, slit, y, 1);
      const double moved =
          std::max(std::abs(lower - end_depth(whole, uncut, 0, y)), std::abs(upper - end_depth(whole, uncut, y, 1))) /
          depth;
      answer.measures = {{"profile_rms", rms, 0, rms},
                         compared("tip", y * lower + (1 - y) * upper, depth),
                         {"tip_moved_by_slit", moved, 0, moved}};
    }
    return answers;
  }

 private:
  // Length 1 m, D = 1 N m. Pulling its own weight stretches the strip by load / 2 stiffness = 1e-4.
  static constexpr double load = 4;         // q L^3 / D: the end hangs 0.39 L deep
  static constexpr double stiffness = 2e4;  // E L^2 / D
  static constexpr double clamp =
      0.2;  // m, held on the exact shape: three columns of vertices at n = 10, as no fewer will do

  BentSheet hung(const Sheet& sheet, const Constraints& constraints = {}) const {
    return {sheet,
            {.density = 1, .stiffness = stiffness, .poisson = 0, .bending = 1},
            bending_,
            load,
            [&](DeformedIndex d) {
              const Point2 rest = sheet.rest(sheet.rest_vertex(d));
              const HeavyElastica::Section s = elastica_.at(rest.x);
              const bool held = rest.x <= clamp;
              return Start{{s.x, rest.y, s.z}, {held, held, held}};
            },
            constraints};
  }

  /// Mean depth of the free end, x = 1, between two rest y.
  static double end_depth(const Sheet& sheet, const BentSheet& bent, double from, double to) {
    double integral = 0;
    for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
      const Triangle& triangle = sheet.triangle(TriangleIndex(t));
      if (!triangle.alive()) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const Point2 a = sheet.rest(triangle.vertex[k]), b = sheet.rest(triangle.vertex[(k + 1) % 3]);
        if (a.x != 1 || b.x != 1) continue;
        const double low = std::max(from, std::min(a.y, b.y)), high = std::min(to, std::max(a.y, b.y));
        if (high <= low) continue;
        const double at = ((low + high) / 2 - a.y) / (b.y - a.y);
        integral -= (high - low) * ((1 - at) * bent.position(triangle.deformed[k]).z +
                                    at * bent.position(triangle.deformed[(k + 1) % 3]).z);
      }
    }
    return integral / (to - from);
  }

  BendingKind bending_;
  HeavyElastica elastica_;
};

}  // namespace cutbench
