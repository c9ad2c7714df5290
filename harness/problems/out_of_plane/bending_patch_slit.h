// A sheet on a cylinder, with a slit along the direction of curvature. Without Poisson's effect the moment is D kappa
// along the slit and none across it, so the lips carry nothing that the slit could take away.
//
// Small curvature, so that facets are as good as the cylinder: the facets' chords are shorter than their arcs by
// (kappa h)^2 / 24, which the membrane answers with forces of E h^4 kappa^2 / 24 D of those of bending: 3e-9 at n = 10.
#pragma once

#include <cmath>
#include <numbers>

#include "harness/mesh/families.h"
#include "harness/problems/common/members.h"
#include "harness/problems/out_of_plane/bent_sheet.h"

namespace cutbench {

class BendingPatchSlit : public Problem {
 public:
  explicit BendingPatchSlit(BendingKind bending = BendingKind::patches) : bending_(bending) {}

  std::string name() const override { return "bending_patch_slit"; }
  std::string effect() const override { return "a slit along the direction of curvature moves nothing"; }
  std::string truth() const override {
    return "the cylinder that the border is held on, and its energy D kappa^2 / 2 per area (nu = 0; patch test)";
  }
  std::vector<std::string> measures() const override {
    return {"displacement_rms", "displacement_max", "bending_energy"};
  }
  bool takes_budgets() const override { return false; }

  Specimen specimen(const std::string& family, int n, std::uint64_t seed, std::size_t index) const override {
    MemberNumbers numbers(seed, index);
    Specimen result{.mesh = make_sheet(family, n), .cuts = {}};
    result.origin = {numbers.between(0.45, 0.55), numbers.between(0.45, 0.55)};
    result.angle = numbers.between(-std::numbers::pi / 2, std::numbers::pi / 2);
    result.cuts = {
        {Curve::Kind::polyline, false, {from_frame(result, {-half_slit, 0}), from_frame(result, {half_slit, 0})}}};
    return result;
  }

  std::vector<Answer> answer(const Specimen& specimen, const Sheet& sheet, std::span<const Budget> budgets,
                             const Constraints& constraints) const override {
    const std::vector<int> ring = rings_from_border(sheet, held_rings);
    const auto exact = [&](DeformedIndex d) { return on_cylinder(specimen, sheet.rest(sheet.rest_vertex(d))); };
    std::vector<Answer> answers;
    for (const Budget& budget : budgets) {
      BentSheet bent(
          sheet, {.stiffness = 10, .poisson = 0, .bending = rigidity}, bending_, 0,
          [&](DeformedIndex d) {
            const bool held = ring[d()] < held_rings;
            return Start{exact(d), {held, held, held}};
          },
          constraints);
      Answer& answer = answers.emplace_back();
      if (!bent.solve_to_equilibrium(budget.solver, answer)) continue;
      double squares = 0, mass = 0, largest = 0;
      for (const DeformedIndex d : vertices_in_use(sheet)) {
        if (bent.held(d) || bent.mass(d) == 0) continue;  // no unknown: inside a compound
        const Point3 e = bent.position(d) + -1 * exact(d);
        const double square = e.x * e.x + e.y * e.y + e.z * e.z;
        squares += bent.mass(d) * square;
        mass += bent.mass(d);
        largest = std::max(largest, square);
      }
      const double rms = std::sqrt(squares / mass) / sag, most = std::sqrt(largest) / sag;
      answer.measures = {
          {"displacement_rms", rms, 0, rms},
          {"displacement_max", most, 0, most},
          compared("bending_energy", bent.energy().bending, rigidity / 2 * curvature * curvature)};  // 1 m2
    }
    return answers;
  }

 private:
  static Point3 on_cylinder(const Specimen& specimen, Point2 rest) {
    const Point2 p = to_frame(specimen, rest);
    const double half = std::sin(curvature * p.x / 2);
    return {std::sin(curvature * p.x) / curvature, p.y, 2 * half * half / curvature};
  }

  static constexpr double curvature = 8e-3;     // 1/m: the sheet of 1 m is 1 mm deep
  static constexpr double sag = curvature / 8;  // m
  static constexpr double rigidity = 1;         // N m
  static constexpr double half_slit = 0.2;      // m
  static constexpr int held_rings = 3;  // beside the border: patches need three rows to know the curvature there

  BendingKind bending_;
};

}  // namespace cutbench
