#include "harness/problems/in_motion/hanging_sheet.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <mutex>
#include <tuple>

#include "harness/base/conversions.h"
#include "harness/fem/time/stepper.h"
#include "harness/mesh/families.h"
#include "harness/mesh/predicates.h"
#include "harness/problems/common/lips.h"
#include "harness/problems/common/members.h"
#include "harness/problems/in_motion/add_step.h"
#include "harness/problems/out_of_plane/bent_sheet.h"

namespace cutbench {

namespace {

constexpr double gravity = 0.1;
constexpr std::size_t samples = 8;  // along the cut

/// What is read off a sheet in motion, at the end of each step, from t = 0 on.
struct Course {
  std::vector<double> corner;  ///< displacement of the lower right one, m: two values each time
  std::vector<double> gapes;   ///< m, at places along the cut
  std::vector<double> strain_energy, kinetic_energy, total_energy;  ///< J
  bool is_whole = false;
};

/// Root of the mean square of the difference over that of the exact values, all times and places alike.
double relative_error(const std::vector<double>& values, const std::vector<double>& exact) {
  const auto size = to_index(exact.size());
  const FieldView a(values.data(), size), b(exact.data(), size);
  return (a - b).norm() / b.norm();
}

/// The displacement before the cut, as the finite elements of the uncut sheet have it: a cut carries over no more. The
/// exact one at the vertices of a sliver would be a stress that nothing made.
class UncutDisplacement {
 public:
  explicit UncutDisplacement(const Specimen& specimen) : sheet_(specimen.mesh) {}
  /// Of a point of the sheet. Looks at all triangles.
  double at(Point2 p) const {
    for (std::size_t t = 0; t < sheet_.triangle_slots(); ++t) {
      const auto c = sheet_.corners(TriangleIndex(t));
      const auto part = [&](std::size_t k) { return cross(c[(k + 1) % 3] - p, c[(k + 2) % 3] - p); };
      if (orientation(c[0], c[1], p) < 0 || orientation(c[1], c[2], p) < 0 || orientation(c[2], c[0], p) < 0) continue;
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += part(k) * hanging_displacement(c[k].y);
      return sum / cross(c[1] - c[0], c[2] - c[0]);
    }
    return hanging_displacement(p.y);  // beside the border, by rounding
  }

 private:
  Sheet sheet_;
};

/// From meshes of which the second has half the size: all that is read has, for the tip, an error in proportion to the
/// size.
Course extrapolated(const Course& coarse, const Course& fine) {
  Course result = fine;
  result.is_whole = coarse.is_whole && fine.is_whole;
  if (!result.is_whole) return result;
  for (const auto series :
       {&Course::corner, &Course::gapes, &Course::strain_energy, &Course::kinetic_energy, &Course::total_energy})
    for (std::size_t i = 0; i < (result.*series).size(); ++i)
      (result.*series)[i] += (fine.*series)[i] - (coarse.*series)[i];
  return result;
}

class HangingSheet : public Problem {
 public:
  HangingSheet(Integrator integrator, double duration, int fine)
      : integrator_(integrator), duration_(duration), fine_(fine) {}

  std::string name() const override {
    return std::string("hanging_sheet_").append(name_of(integrator_names, integrator_));
  }
  std::string effect() const override { return "the part of a hanging sheet below a cut drops and swings"; }
  std::string truth() const override {
    return "the same integrator and step on fine meshes fitted to the cut, extrapolated";
  }
  std::vector<std::string> measures() const override {
    return {"flap_motion", "gape_motion", "strain_energy_motion", "energy_lost"};
  }
  bool takes_budgets() const override { return false; }
  bool takes_constraints() const override { return true; }
  bool in_motion() const override { return true; }

  Specimen specimen(const std::string& family, int n, std::uint64_t seed, std::size_t index) const override {
    MemberNumbers numbers(seed, index);
    Specimen result{.mesh = make_sheet(family, n), .cuts = {}};
    // In turns along a row of vertices of a grid, and at any height and angle.
    const bool along = index % 2 == 0;
    const double off = along ? distance_from_mesh_line(numbers) : numbers.between(0.1, 0.9);
    const double y = (std::round(n * numbers.between(0.45, 0.6)) + off) / n,
                 rise = along ? 0 : numbers.between(-0.2, 0.2);
    const double tip = numbers.between(0.3, 0.5);
    result.cuts = {{Curve::Kind::polyline, false, {{1.1, y + rise * 0.1}, {tip, y + rise * (tip - 1)}}}};
    return result;
  }

  std::vector<Answer> answer(const Specimen& specimen, const Sheet& sheet, std::span<const Budget> budgets,
                             const Constraints& constraints) const override {
    const auto squares = to_int(std::lround(std::sqrt(to_double(specimen.mesh.triangles.size()) / 2)));
    const Course& exact = fine_motion(specimen, squares);
    const UncutDisplacement uncut(specimen);
    std::vector<Answer> answers;
    for (const Budget& budget : budgets) {
      Answer& answer = answers.emplace_back();
      const Course motion = swing(
          specimen, sheet, constraints, [&](Point2 p) { return uncut.at(p); }, budget.solver, squares, answer);
      if (motion.is_whole && exact.is_whole)
        answer.measures = compared_with(exact, motion);
      else if (motion.is_whole) {
        answer.refused = true;
        answer.reason = "the motion of a fine mesh, which it is compared with, failed";
      }
    }
    return answers;
  }

 private:
  /// Computed once for each cut and number of steps; whoever asks first computes it.
  const Course& fine_motion(const Specimen& specimen, int squares) const {
    const Point2 from = specimen.cuts[0].points[0], to = specimen.cuts[0].points[1];
    Truth* truth = nullptr;
    {
      const std::lock_guard lock(mutex_);
      truth = &truths_[{squares, from.y, to.x, to.y}];
    }
    std::call_once(truth->computed, [&] {
      truth->motion =
          extrapolated(fitted_motion(specimen, fine_ / 2, squares), fitted_motion(specimen, fine_, squares));
    });
    return truth->motion;
  }

  Course fitted_motion(const Specimen& specimen, int fine, int squares) const {
    Answer answer;
    const Specimen uncut{.mesh = make_sheet("delaunay", fine), .cuts = specimen.cuts};
    const auto start = [](Point2 p) { return hanging_displacement(p.y); };
    return swing(specimen, body_fitted(uncut), {}, start, {.name = "cholmod_same_order"}, squares, answer);
  }

  Course swing(const Specimen& specimen, const Sheet& sheet, const Constraints& constraints,
               const std::function<double(Point2)>& start, const SolverOptions& solver, int squares,
               Answer& answer) const {
    constexpr double infinity = Box::infinity;
    Model<2> model(sheet, {.density = 1, .stiffness = 1, .poisson = 0},
                   {.dimension = 2, .strain = Strain::linear, .gravity = {0, -gravity, 0}},
                   {{.where = {{-infinity, 1}, {infinity, infinity}}}}, {});
    if (!constraints.empty()) model.constrain(sheet, constraints);
    State state = initial_state(model, sheet);
    DeformedIndex corner;
    for (const DeformedIndex d : vertices_in_use(sheet)) {
      const Point2 p = sheet.rest(sheet.rest_vertex(d));
      state.x.segment<2>(2 * d.value) << p.x, p.y + start(p);
      if (p.x == 1 && p.y == 0) corner = d;
    }
    place_phantoms(model, state);
    if (!corner.valid()) {
      answer.verdict = Verdict::no_corner;
      answer.reason = "the cut sheet has no vertex at its lower right corner";
      return {};
    }
    for (const std::uint8_t held : model.held()) answer.unknowns += held == 0;

    const std::vector<LipSample> places = places_on(specimen.cuts[0]);
    Course motion;
    const auto read = [&] {
      Field displacement = state.x;
      for (const DeformedIndex d : vertices_in_use(sheet)) {
        const Point2 p = sheet.rest(sheet.rest_vertex(d));
        displacement.segment<2>(2 * d.value) -= Eigen::Vector2d(p.x, p.y);
      }
      for (const Eigen::Index k : {0, 1}) motion.corner.push_back(displacement[2 * corner.value + k]);
      for (const double gape : opening(sheet, displacement, places, sheet.mean_edge())) motion.gapes.push_back(gape);
      model.rotate(state.x);
      const Energy energy = model.energy(state.x, state.v);
      motion.strain_energy.push_back(energy.membrane);
      motion.kinetic_energy.push_back(energy.kinetic);
      motion.total_energy.push_back(energy.total());
    };
    Stepper<2> stepper({.integrator = integrator_, .step = 1.0 / squares, .solver = solver});
    read();
    for (int step = 0; step < std::lround(duration_ * squares); ++step) {
      const StepReport report = stepper.step(model, state);
      add_step(report, answer);
      if (answer.verdict != Verdict::ok) return motion;
      read();
    }
    motion.is_whole = true;
    return motion;
  }

  /// In the middle of equal parts of the cut within the sheet; the gape is that of the lower lip from the upper one.
  static std::vector<LipSample> places_on(const Curve& cut) {
    const Point2 tip = cut.points[1], along = cut.points[0] - tip;
    const Point2 to_border = (1 - tip.x) / along.x * along;
    const double length = std::sqrt(squared_length(to_border));
    std::vector<LipSample> places;
    for (std::size_t i = 0; i < samples; ++i) {
      const double part = (to_double(i) + 0.5) / to_double(samples);
      places.push_back(
          {tip + part * to_border, 1 / length * Point2{-to_border.y, to_border.x}, length / to_double(samples)});
    }
    return places;
  }

  static std::vector<Measure> compared_with(const Course& exact, const Course& motion) {
    const double flap = relative_error(motion.corner, exact.corner), gape = relative_error(motion.gapes, exact.gapes),
                 energy = relative_error(motion.strain_energy, exact.strain_energy);
    const double scale = std::ranges::max(exact.kinetic_energy);
    const auto lost = [&](const Course& of) { return (of.total_energy.front() - of.total_energy.back()) / scale; };
    return {{"flap_motion", flap, 0, flap},
            {"gape_motion", gape, 0, gape},
            {"strain_energy_motion", energy, 0, energy},
            {"energy_lost", lost(motion), lost(exact), std::abs(lost(motion) - lost(exact))}};
  }

  Integrator integrator_;
  double duration_;
  int fine_;
  struct Truth {
    std::once_flag computed;
    Course motion;
  };
  mutable std::mutex mutex_;                                                 // of the map, not of what is in it
  mutable std::map<std::tuple<int, double, double, double>, Truth> truths_;  // by steps and cut
};

}  // namespace

double hanging_displacement(double y) { return -gravity * (1 - y * y) / 2; }

std::unique_ptr<const Problem> hanging_sheet(Integrator integrator, double duration, int fine) {
  return std::make_unique<HangingSheet>(integrator, duration, fine);
}

}  // namespace cutbench
