// A strip slit lengthwise into two legs, which are pulled apart at right angles to it.
//
//                 grip, z = +height, free along x
//                 |
//                 | leg          The legs hang together by the uncut strip, which is clamped at its far end. The grips
//                 |              hold the ends of the legs straight, so that the pull runs along the slit's lips and
//                 '------------  turns nothing: a strip that were twisted would pay by its length.
//                 ,------------
//                 | leg
//
// Where legs and strip are long beside the fold, a tear longer by da whose grips are da higher is the same shape, moved
// on by da: the same pull F on each leg and the same energy U. The tear then releases what the grips put in, 2 F da;
// at held grips that is -dU/da = 2 F (Rivlin and Thomas, Rupture of rubber I, J. Polym. Sci. 10, 1953, with legs that
// don't stretch). There is no step size in it, so that da may be far larger than a triangle.
//
// What it neglects: that the fold feels the grips, and that the legs stretch, which releases 2 F / E b more, as the
// pull runs along their edges. Together below 1 %: 0.2 to 0.5 % with legs of 1.5 m and more, 1.3 to 3 % with 1 m. The
// fold is 0.6 m wide (sqrt(D b / F)) and sharpest at its end, the tip: there the mesh shows, as if the tip were a part
// of a triangle off. What the grips are higher than without a fold, `slack`, is in proportion to sqrt(D b / F) alone,
// so F goes like slack^-2, and a tip that seems to be d off changes the force by 2 d / slack: a quarter of a triangle
// of 0.1 m is a quarter of the force. Of the rate it changes d / torn. Hence single members scatter (standard deviation
// on 800 to 3200 triangles) by 3 to 17 % in the force and by 1 to 3 % in the rate, whose means are within 3 % of 2 F:
// only the mean over members says something, and nothing is extrapolated from forces.
#pragma once

#include <cmath>
#include <map>
#include <numbers>

#include "harness/base/conversions.h"
#include "harness/mesh/families.h"
#include "harness/problems/common/members.h"
#include "harness/problems/out_of_plane/bent_sheet.h"

namespace cutbench {

class TrouserTear : public Problem {
 public:
  explicit TrouserTear(BendingKind bending = BendingKind::patches) : bending_(bending) {}

  std::string name() const override { return "trouser_tear"; }
  std::string effect() const override { return "a tear between two legs releases what pulls them apart"; }
  std::string truth() const override {
    return "-dU/da = 2 F, with F of the same solution, for legs that don't stretch (Rivlin and Thomas 1953)";
  }
  std::vector<std::string> measures() const override { return {"release_rate", "force_after"}; }
  bool takes_budgets() const override { return false; }
  bool takes_compounds() const override { return false; }

  /// A strip of 4 x 1 m: four sheets of `family`, of 2 (n / 2)^2 triangles each, mirrored in turns so that they fit.
  Specimen specimen(const std::string& family, int n, std::uint64_t seed, std::size_t index) const override {
    MemberNumbers numbers(seed, index);
    Specimen result{.mesh = tiled(make_sheet(family, std::max(1, n / 2))), .cuts = {}};
    const double y = numbers.between(0.47, 0.53), a = numbers.between(1.6, 1.8);
    result.origin = {a, y};
    result.cuts = {{Curve::Kind::polyline, false, {{-0.1, y}, {a, y}}},
                   {Curve::Kind::polyline, false, {{a, y}, {a + torn, y}}}};
    return result;
  }

  std::vector<Answer> answer(const Specimen& specimen, const Sheet& sheet, std::span<const Budget> budgets,
                             const Constraints&) const override {
    const Sheet shorter = sewn_up(specimen, sheet);
    std::vector<Answer> answers;
    for (const Budget& budget : budgets) {
      Answer& answer = answers.emplace_back();
      const Pulled before = pull(shorter, specimen.origin, budget.solver, answer);
      if (answer.verdict != Verdict::ok) continue;
      const Pulled after = pull(sheet, {specimen.origin.x + torn, specimen.origin.y}, budget.solver, answer);
      if (answer.verdict != Verdict::ok) continue;
      const double work = before.force + after.force;  // of both grips, per length: 2 F
      answer.measures = {compared("release_rate", work - (after.energy - before.energy) / torn, work),
                         compared("force_after", after.force, before.force)};
    }
    return answers;
  }

 private:
  static constexpr int tiles = 4;
  static constexpr double torn = 0.8;   // m
  static constexpr double slack = 0.2;  // m: how much higher the grips would be if the legs did not fold
  static constexpr double radius = slack / (std::numbers::pi / 2 - 1);  // m: of a fold round a cylinder
  static constexpr double far_clamp = 3.6;                              // m

  struct Pulled {
    double force, energy;  // mean of the two legs, N; J
  };

  static MeshData tiled(const MeshData& sheet) {
    MeshData strip;
    std::map<std::array<double, 2>, std::int32_t> at;
    for (int i = 0; i < tiles; ++i) {
      const bool mirrored = i % 2 == 1;
      std::vector<std::int32_t> number;
      for (const Point2 p : sheet.rest) {
        const Point2 q{i + (mirrored ? 1 - p.x : p.x), p.y};
        const auto [place, is_new] = at.try_emplace({q.x, q.y}, to_int32(strip.rest.size()));
        if (is_new) {
          strip.rest.push_back(q);
          strip.deformed.push_back({q.x, q.y, 0});
        }
        number.push_back(place->second);
      }
      for (const auto& t : sheet.triangles) {
        const auto a = number[to_size(t[0])], b = number[to_size(t[1])], c = number[to_size(t[2])];
        strip.triangles.push_back(mirrored ? std::array{a, c, b} : std::array{a, b, c});
      }
    }
    return strip;
  }

  /// The same triangles with the second cut closed.
  static Sheet sewn_up(const Specimen& specimen, const Sheet& sheet) {
    MeshData mesh;
    std::map<std::int32_t, std::int32_t> number;  // of deformed vertices, or, beyond the tip, ~(rest vertices)
    for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
      const Triangle& triangle = sheet.triangle(TriangleIndex(t));
      if (!triangle.alive()) continue;
      std::array<std::int32_t, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k) {
        const Point2 p = sheet.rest(triangle.vertex[k]);
        const bool beyond = p.x > specimen.origin.x - sheet.snap();
        const auto [place, is_new] = number.try_emplace(beyond ? ~triangle.vertex[k].value : triangle.deformed[k].value,
                                                        to_int32(mesh.rest.size()));
        if (is_new) {
          mesh.rest.push_back(p);
          mesh.deformed.push_back({p.x, p.y, 0});
        }
        corners[k] = place->second;
      }
      mesh.triangles.push_back(corners);
    }
    return Sheet(mesh);
  }

  Pulled pull(const Sheet& sheet, Point2 tip, const SolverOptions& solver, Answer& answer) const {
    const std::vector<Point2> side = sides(sheet);
    const auto leg = [&](DeformedIndex d) { return side[d()].y > tip.y ? 1 : -1; };
    const auto place = [&](DeformedIndex d) {
      const Point2 p = sheet.rest(sheet.rest_vertex(d));
      const bool clamped = p.x >= far_clamp, gripped = p.x == 0;
      const double s = std::max(0.0, tip.x - p.x), angle = std::min(s / radius, std::numbers::pi / 2);
      const double z = radius * (1 - std::cos(angle)) + s - radius * angle;
      return Start{{std::max(p.x, tip.x) - radius * std::sin(angle), p.y, leg(d) * z},
                   {clamped, clamped || gripped, clamped || gripped}};
    };
    Pulled result{};
    BentSheet bent(sheet, {.stiffness = 1e3, .poisson = 0.3, .bending = 1}, bending_, 0, place);
    if (!bent.solve_to_equilibrium(solver, answer)) return result;
    for (const DeformedIndex d : vertices_in_use(sheet))
      if (sheet.rest(sheet.rest_vertex(d)).x == 0) result.force += leg(d) * bent.support(d).z / 2;
    result.energy = bent.energy().total();
    return result;
  }

  BendingKind bending_;
};

}  // namespace cutbench
