#include "harness/problems/in_plane/edge_crack.h"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/mesh/families.h"
#include "harness/problems/common/lips.h"
#include "harness/problems/common/members.h"
#include "harness/problems/common/stress_intensity.h"
#include "harness/problems/in_plane/case_parts.h"
#include "harness/problems/in_plane/edge_crack_field.h"
#include "harness/problems/in_plane/static_solve.h"

namespace cutbench {

namespace {

using std::numbers::pi;
constexpr int height = edge_crack_height;
constexpr Ring ring{0.04, 0.14};

/// Sheets one upon the other, every second one upside down, so that their common borders fit.
MeshData strip(const std::string& family, int n) {
  const MeshData sheet = make_sheet(family, n);
  MeshData all;
  std::map<std::pair<double, double>, std::int32_t> number;
  for (int level = 0; level < height; ++level) {
    const bool upside_down = level % 2 == 1;
    std::vector<std::int32_t> of_sheet;
    for (Point2 p : sheet.rest) {
      p.y = upside_down ? level + 1 - p.y : level + p.y;
      const auto [entry, fresh] = number.emplace(std::pair(p.x, p.y), to_int32(all.rest.size()));
      if (fresh) {
        all.rest.push_back(p);
        all.deformed.push_back({p.x, p.y, 0});
      }
      of_sheet.push_back(entry->second);
    }
    for (auto [a, b, c] : sheet.triangles) {
      if (upside_down) std::swap(b, c);
      const auto here = [&](std::int32_t v) { return of_sheet[to_size(v)]; };
      all.triangles.push_back({here(a), here(b), here(c)});
    }
  }
  return all;
}

/// Per N/m of pull squared and of stiffness: the integral of K^2 over the depth, by Simpson's rule.
double released_energy(double depth) {
  constexpr int steps = 200;
  double sum = 0;
  for (int i = 1; i <= steps; ++i) {  // nothing at depth 0
    const double a = depth * i / steps;
    sum += (i == steps ? 1 : i % 2 == 1 ? 4 : 2) * pi * a * std::pow(edge_crack_factor(a), 2);
  }
  return sum * depth / steps / 3;
}

/// On a strip of width 1, made of sheets with n / 2 squares a side (n - 1 or so for an odd n), which are 2 n^2
/// triangles in all. Members: even ones at the distances from a mesh line that those of other problems have, odd ones
/// anywhere in a cell; the depth up to a quarter cell off, which the exact answer takes into account.
class EdgeCrack final : public Problem {
 public:
  explicit EdgeCrack(int percent) : percent_(percent) {}
  std::string name() const override { return "edge_crack_" + std::to_string(percent_); }
  std::string effect() const override { return "a cut that begins at the edge of a finite sheet"; }
  std::string truth() const override {
    return "gape by collocation; released energy and K1 of the handbook's fit (Tada), within 1 and 0.5 percent";
  }
  std::vector<std::string> measures() const override { return {"energy_norm", "opening", "released_energy", "k1"}; }

  Specimen specimen(const std::string& family, int n, std::uint64_t seed, std::size_t index) const override {
    MemberNumbers numbers(seed, index);
    const int squares = std::max(1, n / 2);
    const double depth = percent_ / 100.0 + numbers.between(-0.25, 0.25) / squares;
    const double off = index % 2 == 0 ? distance_from_mesh_line(numbers) : numbers.between(-0.5, 0.5);
    const Point2 tip{depth, height / 2.0 + off / squares};
    return {strip(family, squares), {{Curve::Kind::polyline, false, {{-0.5, tip.y}, tip}}}, tip, 0};
  }

  std::vector<Answer> answer(const Specimen& specimen, const Sheet& sheet, std::span<const Budget> budgets,
                             const Constraints& constraints) const override {
    StaticSolve solve(sheet, sheet_material, constraints);
    const auto at = [](double y) { return [y](Point2 a, Point2 b) { return a.y == y && b.y == y; }; };
    solve.pull_border(at(0), {0, -pull});
    solve.pull_border(at(height), {0, pull});
    // Tractions in equilibrium: what is held takes no force.
    solve.hold({1, 0}, 0, 0);
    solve.hold({1, 0}, 1, 0);
    solve.hold({1, height}, 0, 0);
    const double depth = specimen.origin.x;
    const double k1 = pull * std::sqrt(pi * depth) * edge_crack_factor(depth);
    const double energy = pull * pull / sheet_material.young * released_energy(depth);
    const double before = pull * pull / (2 * sheet_material.young) * height;
    const Tip tip{specimen.origin};
    const std::vector<LipSample> lips = straight_lips({depth / 2, tip.at.y}, depth / 2);
    const std::vector<double> gape = opening(edge_crack_field(sheet_material, {tip.at}, depth, pull), lips);
    solve.make_tip_functions(budgets);
    const InteractionIntegral intensity(sheet, solve.elements(), sheet_material, tip,
                                        williams_modes(sheet_material, tip), ring, solve.tip_functions());
    std::vector<Answer> answers;
    for (const Budget& budget : budgets) {
      auto [displacement, of_tips, answer] = solve.solve(budget);
      if (!answer.refused && answer.verdict != Verdict::not_finite) {
        // Dead loads: as much energy as they lose in work done, twice what the sheet takes up.
        const double value = solve.force().dot(displacement) / 2 - before;
        // On the requested cut half of the error's square in the energy norm is the energy that is missing.
        const double norm = std::sqrt(std::abs(value - energy) / (before + energy));
        answer.measures.push_back({"energy_norm", norm, 0, norm});
        const double off = opening_error(
            lips, opening(sheet, displacement, lips, sheet.mean_edge(), solve.tip_functions(), of_tips), gape);
        answer.measures.push_back({"opening", off, 0, off});
        answer.measures.push_back({"released_energy", value, energy, std::abs(value - energy) / energy});
        const auto add = [&measures = answer.measures, k1](const char* name, double k) {
          measures.push_back({name, k, k1, std::abs(k - k1) / k1});
        };
        add("k1", intensity.of(solve.elements(), displacement, of_tips).k1);
        if (of_tips.size() > 0)
          if (const auto k =
                  intensity_of_coefficients(*solve.tip_functions(), of_tips, tip, sheet_material, sheet.mean_edge()))
            add(tip_measures[0], k->k1);
      }
      answers.push_back(std::move(answer));
    }
    return answers;
  }

 private:
  int percent_;
};

}  // namespace

double edge_crack_factor(double x) {
  const double half = pi * x / 2;
  return std::sqrt(std::tan(half) / half) * (0.752 + 2.02 * x + 0.37 * std::pow(1 - std::sin(half), 3)) /
         std::cos(half);
}

void append_edge_cracks(std::vector<std::unique_ptr<const Problem>>& problems) {
  for (const int percent : {30, 40, 50}) problems.push_back(std::make_unique<EdgeCrack>(percent));
}

}  // namespace cutbench
