#include "harness/problems/in_plane/static_solve.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/stop_watch.h"
#include "harness/fem/solvers/solver_table.h"
#include "harness/problems/common/border_edges.h"

namespace cutbench {

namespace {

const Physics in_the_plane{.dimension = 2, .strain = Strain::linear, .bending = BendingKind::none};

}  // namespace

StaticSolve::StaticSolve(const Sheet& sheet, const Elastic& elastic, const Constraints& constraints)
    : sheet_(sheet), model_(sheet, {.stiffness = elastic.young, .poisson = elastic.poisson}, in_the_plane, {}, {}) {
  if (constraints.merge_triangles()) model_.constrain(sheet, constraints.of_merged_triangles());
  if (!constraints.constraints.empty()) constrained_.emplace(constraints, model_.vertices());
  held_ = model_.held();
  given_ = force_ = Field::Zero(to_index(held_.size()));
}

void StaticSolve::hold_border(const std::function<Eigen::Vector2d(Point2, Point2)>& value) {
  Field values = Field::Zero(given_.size());
  for_each_border_edge(sheet_, [&](HalfEdge h) {
    const auto corners = sheet_.corners(triangle_of(h));
    const Point2 inside = 1.0 / 3 * (corners[0] + corners[1] + corners[2]);
    for (const DeformedIndex d : deformed_ends(sheet_, h))
      values.segment<2>(2 * d.value) = value(sheet_.rest(sheet_.rest_vertex(d)), inside);
  });
  hold_border(values);
}

void StaticSolve::hold_border(const Field& value) {
  for_each_border_edge(sheet_, [&](HalfEdge h) {
    for (const DeformedIndex d : deformed_ends(sheet_, h)) {
      held_[2 * d()] = held_[2 * d() + 1] = 1;
      given_.segment<2>(2 * d.value) = value.segment<2>(2 * d.value);
    }
  });
}

void StaticSolve::hold(Point2 p, int axis, double value) {
  for (std::size_t d = 0; d < sheet_.deformed_slots(); ++d) {
    const VertexIndex v = sheet_.rest_vertex(DeformedIndex(d));
    if (!v.valid() || !(sheet_.rest(v) == p)) continue;
    const std::size_t unknown = 2 * d + to_size(axis);
    held_[unknown] = 1;
    given_[to_index(unknown)] = value;
  }
}

void StaticSolve::pull_border(const std::function<bool(Point2, Point2)>& where, const Eigen::Vector2d& force) {
  for_each_border_edge(sheet_, [&](HalfEdge h) {
    const Point2 a = sheet_.rest(sheet_.origin(h)), b = sheet_.rest(sheet_.target(h));
    if (!where(a, b)) return;
    for (const DeformedIndex d : deformed_ends(sheet_, h))
      force_.segment<2>(2 * d.value) += std::sqrt(squared_length(b - a)) / 2 * force;
  });
}

void StaticSolve::load_lips(const Axes& frame, const std::function<Eigen::Vector2d(double)>& load) {
  why_no_tips_ = "the lips are loaded, which tip functions don't take";
  for (std::size_t t = 0; t < sheet_.triangle_slots(); ++t)
    for (int k = 0; k < 3; ++k)
      if (const TriangleIndex slot(t);
          sheet_.triangle(slot).alive() && sheet_.mark(half_edge(slot, k)) == EdgeMark::incision)
        load_edge(half_edge(slot, k), frame, load);
}

/// The triangle is on the left: above an edge that runs along the x axis, and below one that runs against it.
void StaticSolve::load_edge(HalfEdge h, const Axes& frame, const std::function<Eigen::Vector2d(double)>& load) {
  constexpr std::array<std::array<double, 2>, 3> gauss{
      {{0.112701665379258, 5.0 / 18}, {0.5, 4.0 / 9}, {0.887298334620742, 5.0 / 18}}};
  const auto along_x = [&](VertexIndex v) { return frame.to_local(sheet_.rest(v)).real(); };
  const double from = along_x(sheet_.origin(h)), length = along_x(sheet_.target(h)) - from;
  const auto ends = deformed_ends(sheet_, h);
  const Eigen::Rotation2Dd turn(frame.angle);
  for (const auto& [place, weight] : gauss) {
    const Eigen::Vector2d force = weight * length * (turn * load(from + place * length));
    force_.segment<2>(2 * ends[0].value) += (1 - place) * force;
    force_.segment<2>(2 * ends[1].value) += place * force;
  }
}

void StaticSolve::hold_loose_pieces(const std::function<bool(Point2)>& cut_off) {
  const BlockMatrix<2>& blocks = model_.blocks();
  // Per vertex: the area round it, and what of that is cut off.
  std::vector<double> area(model_.vertices()), off(model_.vertices());
  for (std::size_t e = 0; cut_off && e < elements().size(); ++e) {
    if (!elements()[e].alive()) continue;
    const auto c = sheet_.corners(TriangleIndex(e));
    const double size = cross(c[1] - c[0], c[2] - c[0]) * elements()[e].fraction;
    const std::size_t vertex = elements()[e].vertex[0]();
    area[vertex] += size;
    if (cut_off(1.0 / 3 * (c[0] + c[1] + c[2]))) off[vertex] += size;
  }
  std::vector<std::uint8_t> seen(model_.vertices());
  std::vector<std::size_t> piece;
  loose_.assign(model_.vertices(), 0);
  for (std::size_t start = 0; start < seen.size(); ++start) {
    if (seen[start] || blocks.columns(start).empty()) continue;
    bool held = false;
    double whole = 0, gone = 0;
    piece.assign(1, start);
    seen[start] = 1;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      held = held || held_[2 * piece[i]] || held_[2 * piece[i] + 1];
      whole += area[piece[i]];
      gone += off[piece[i]];
      for (const auto j : blocks.columns(piece[i]))
        if (!std::exchange(seen[to_size(j)], 1)) piece.push_back(to_size(j));
    }
    if (held && gone <= whole / 2) continue;
    for (const std::size_t v : piece) {
      loose_[v] = held_[2 * v] = held_[2 * v + 1] = 1;
      given_.segment<2>(to_index(2 * v)).setZero();
    }
  }
  model_.elements().for_each_inside([this](DeformedIndex d, DeformedIndex corner) { loose_[d()] = loose_[corner()]; });
}

void StaticSolve::make_tip_functions(std::span<const Budget> budgets) {
  if (std::none_of(budgets.begin(), budgets.end(), [](const Budget& budget) { return budget.tip_functions; })) return;
  if (!why_no_tips_.empty()) return;
  if (constrained_) {
    why_no_tips_ = "the method constrains vertices, which tip functions don't take";
    return;
  }
  StopWatch watch;
  tips_.emplace(sheet_);
  if (tips_->tips().empty()) why_no_tips_ = "no incision ends inside the sheet, with room for tip functions";
  with_tips_.emplace(sheet_, elements(), *tips_, lame_of(model_.material(), in_the_plane.plane));
  tips_us_ = watch.lap();
}

double StaticSolve::tip_energy(const Solution& solution) const {
  return solution.of_tips.size() == 0 ? 0 : with_tips_->energy(solution.displacement, solution.of_tips);
}

SystemMatrix<2> StaticSolve::held_system() const {
  SystemMatrix<2> system = model_.system();
  system.held = &held_;
  return system;
}

StaticSolve::Solution StaticSolve::solve(const Budget& budget) {
  if (budget.tip_functions && !why_no_tips_.empty()) {
    Solution refused;
    refused.answer.refused = true;
    refused.answer.reason = why_no_tips_;
    return refused;
  }
  StopWatch watch;
  if (!std::exchange(assembled_, true)) {
    model_.rotate(Field::Zero(given_.size()));
    model_.assemble(0, 1);
    right_ = Field::Zero(given_.size());
    if (constrained_) constrained_->extrapolate(held_, given_);
    model_.system().add_product(given_, right_);
    right_ = force_ - right_;
    if (constrained_) {
      constrained_->assemble(held_system(), model_.material().stiffness);
      const Field all = right_;
      constrained_->reduce(held_, all, right_);
      constrained_->subtract_ghosts(given_, right_);
    }
    assemble_us_ = watch.lap();
  }
  const SystemMatrix<2> system = constrained_ ? constrained_->system() : held_system();
  SolverOptions options = budget.solver;
  if (budget.iterations > 0) {
    options.tolerance = 0;
    options.max_iterations = budget.iterations;
  }
  const auto solver = make_solver<2>(options);
  Solution solution;
  Answer& answer = solution.answer;
  watch.lap();
  solver->setup(system);
  answer.setup_us = watch.lap();
  SolveReport report;
  if (budget.tip_functions)
    report = with_tips_->solve(*solver, given_, right_, solution.displacement, solution.of_tips);
  else
    report = solver->solve(right_, solution.displacement);
  answer.solve_us = watch.lap();
  for (const auto h : *system.held) answer.unknowns += !h;
  answer.unknowns += to_size(solution.of_tips.size());
  if (constrained_) {
    const Field unknowns = solution.displacement;
    constrained_->expand(unknowns, solution.displacement);
  }
  solution.displacement += given_;
  model_.follow(solution.displacement);

  answer.assemble_us = assemble_us_ + (budget.tip_functions ? tips_us_ : 0);
  answer.iterations = report.iterations;
  answer.residual = report.residual;
  if (!solution.displacement.allFinite()) {
    answer.verdict = Verdict::not_finite;
    answer.reason = "the displacement is not finite";
  } else if (budget.iterations == 0 && !report.converged) {
    answer.verdict = Verdict::solver_stalled;
    answer.reason = options.name + " reached " + std::to_string(report.residual);
  }
  return solution;
}

}  // namespace cutbench
