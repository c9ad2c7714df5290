#include "harness/problems/in_motion/free_strip.h"

#include <cmath>
#include <numbers>

#include "harness/base/conversions.h"
#include "harness/base/stop_watch.h"
#include "harness/fem/model/model.h"
#include "harness/fem/solvers/solver_table.h"
#include "harness/mesh/families.h"
#include "harness/problems/common/members.h"
#include "harness/problems/out_of_plane/bent_sheet.h"

namespace cutbench {

namespace {

constexpr double length = 0.6, width = 0.2;  // m
constexpr double beam = 4.730040744862704, shape = 0.982502214576238;
constexpr double frequency = beam * beam / (length * length);  // of D = 1 N m and 1 kg/m2
constexpr double inertia = length * width * (length * length + width * width) / 12;

double mode_at(double x) {
  const double s = beam * (x / length + 0.5);
  return std::cosh(s) + std::cos(s) - shape * (std::sinh(s) + std::sin(s));
}

/// Fields of the strip's vertices across the rest plane, and their product by mass.
class Swinging {
 public:
  Swinging(const Specimen& specimen, const Sheet& sheet, const Constraints& constraints)
      : model_(sheet, {.density = 1, .stiffness = 1000, .poisson = 0, .bending = 1}, {.bending = BendingKind::patches},
               {}, {}) {
    if (constraints.merge_triangles()) model_.constrain(sheet, constraints);
    const Field flat = model_.positions(sheet);
    model_.rotate(flat);
    model_.assemble(shift, 1);
    held_.assign(model_.held().size(), 1);
    mode_ = Field::Zero(flat.size());
    for (Field& field : rigid_) field = Field::Zero(flat.size());
    const std::vector<Point2> side = sides(sheet);
    for (const DeformedIndex d : vertices_in_use(sheet)) {
      const Point2 in = to_frame(specimen, side[d()]);
      if (std::abs(in.x) > length / 2 || std::abs(in.y) > width / 2) continue;
      const Point2 p = to_frame(specimen, sheet.rest(sheet.rest_vertex(d)));
      const Eigen::Index z = 3 * d.value + 2;
      held_[to_size(z)] = model_.held()[to_size(z)];
      if (held_[to_size(z)]) continue;  // inside a compound: no mass
      mode_[z] = mode_at(p.x);
      rigid_[0][z] = 1;
      rigid_[1][z] = p.x;
      rigid_[2][z] = p.y;
    }
    for (std::size_t i = 0; i < rigid_.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k) rigid_[i] -= product(rigid_[k], rigid_[i]) * rigid_[k];
      rigid_[i] /= std::sqrt(product(rigid_[i], rigid_[i]));
    }
    mode_ = swing(mode_);
  }

  const Field& mode() const { return mode_; }

  Field masses_times(const Field& v) const {
    Field result = Field::Zero(v.size());
    model_.add_mass_product(1, v, result);
    return result;
  }
  double product(const Field& a, const Field& b) const { return a.dot(masses_times(b)); }

  /// Without its rigid part, of unit mass.
  Field swing(Field v) const {
    for (const Field& field : rigid_) v -= product(field, v) * field;
    return v / std::sqrt(product(v, v));
  }

  /// Sum of mass x (x^2 + y^2) from the centroid: those two rigid modes are turns about the axes in the plane.
  double moment_of_inertia(const Specimen& specimen, const Sheet& sheet) const {
    double mass = 0, second = 0, x = 0, y = 0;
    for (const DeformedIndex d : vertices_in_use(sheet)) {
      if (held_[to_size(3 * d.value + 2)]) continue;
      const Point2 p = to_frame(specimen, sheet.rest(sheet.rest_vertex(d)));
      const double m = model_.lumped_mass()[to_index(d())];
      mass += m;
      x += m * p.x;
      y += m * p.y;
      second += m * squared_length(p);
    }
    return second - (x * x + y * y) / mass;
  }

  /// The smallest eigenvalue and its shape, in `v`; false where the solver failed.
  bool solve(const SolverOptions& options, Field& v, double& eigenvalue, Answer& answer) {
    StopWatch watch;
    SystemMatrix<3> system = model_.system();
    system.held = &held_;
    for (const auto h : held_) answer.unknowns += !h;
    const auto solver = make_solver<3>(options);
    solver->setup(system);
    answer.setup_us = watch.lap();
    v = mode_;
    constexpr int iterations = 40;
    for (int i = 0; i < iterations; ++i) {
      Field next;
      const SolveReport report = solver->solve(masses_times(v), next, {});
      answer.residual = std::max(answer.residual, report.residual);
      if (!report.converged || !next.allFinite()) {
        answer.verdict = Verdict::solver_stalled;
        answer.reason = options.name + " reached " + std::to_string(report.residual);
        return false;
      }
      eigenvalue = 1 / product(v, next) - shift;
      v = swing(next);
    }
    answer.iterations = iterations;
    answer.solve_us = watch.lap();
    return true;
  }

 private:
  static constexpr double shift = frequency * frequency / 100;  // makes rigid modes soluble
  Model<3> model_;
  std::vector<std::uint8_t> held_;
  Field mode_;
  std::array<Field, 3> rigid_;
};

class FreeStrip final : public Problem {
 public:
  std::string name() const override { return "free_strip"; }
  std::string effect() const override { return "a strip that is cut out swings and spins by its mass"; }
  std::string truth() const override { return "w = 4.7300^2 sqrt(D / (rho L^4)) of a free beam (nu = 0; Rayleigh)"; }
  std::vector<std::string> measures() const override { return {"frequency", "mode", "spin"}; }
  bool takes_budgets() const override { return false; }

  Specimen specimen(const std::string& family, int n, std::uint64_t seed, std::size_t index) const override {
    MemberNumbers numbers(seed, index);
    Specimen result{.mesh = make_sheet(family, n), .cuts = {}};
    result.origin = {0.5 + numbers.between(-0.5, 0.5) / n, 0.5 + numbers.between(-0.5, 0.5) / n};
    result.angle = numbers.between(0, 2 * std::numbers::pi);
    Curve outline{Curve::Kind::polyline, true, {}};
    for (const Point2 p : {Point2{-1, -1}, Point2{1, -1}, Point2{1, 1}, Point2{-1, 1}})
      outline.points.push_back(from_frame(result, {length / 2 * p.x, width / 2 * p.y}));
    result.cuts = {outline};
    return result;
  }

  std::vector<Answer> answer(const Specimen& specimen, const Sheet& sheet, std::span<const Budget> budgets,
                             const Constraints& constraints) const override {
    StopWatch watch;
    Swinging swinging(specimen, sheet, constraints);
    const double assemble_us = watch.lap();
    std::vector<Answer> answers;
    for (const Budget& budget : budgets) {
      Answer& answer = answers.emplace_back();
      answer.assemble_us = assemble_us;
      Field v;
      double eigenvalue = 0;
      if (!swinging.solve(budget.solver, v, eigenvalue, answer)) continue;
      const double along = swinging.product(v, swinging.mode()), off = std::sqrt(std::max(0.0, 1 - along * along));
      answer.measures = {compared("frequency", std::sqrt(eigenvalue), frequency),
                         {"mode", off, 0, off},
                         compared("spin", 1 / swinging.moment_of_inertia(specimen, sheet), 1 / inertia)};
    }
    return answers;
  }
};

}  // namespace

std::unique_ptr<const Problem> free_strip() { return std::make_unique<FreeStrip>(); }

}  // namespace cutbench
