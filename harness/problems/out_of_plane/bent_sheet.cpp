#include "harness/problems/out_of_plane/bent_sheet.h"

#include <cmath>
#include <map>

namespace cutbench {

namespace {

std::vector<Pin> pins_for(const Sheet& sheet, const std::function<Start(DeformedIndex)>& start) {
  std::vector<Pin> pins;
  std::vector<std::uint8_t> seen(sheet.vertex_slots());
  for (const DeformedIndex d : vertices_in_use(sheet)) {
    const auto held = start(d).held;
    const VertexIndex v = sheet.rest_vertex(d);
    if ((held[0] || held[1] || held[2]) && !std::exchange(seen[v()], 1))
      pins.push_back({.where = {sheet.rest(v), sheet.rest(v)}, .axes = held});
  }
  return pins;
}

}  // namespace

BentSheet::BentSheet(const Sheet& sheet, const Material& material, BendingKind bending, double gravity,
                     const std::function<Start(DeformedIndex)>& start, const Constraints& constraints)
    : sheet_(sheet),
      model_(sheet, material, {.bending = bending, .gravity = {0, 0, -gravity}}, pins_for(sheet, start), {}),
      state_(initial_state(model_, sheet)) {
  if (constraints.merge_triangles()) model_.constrain(sheet, constraints);
  for (const DeformedIndex d : vertices_in_use(sheet)) {
    const Point3 p = start(d).position;
    state_.x.segment<3>(3 * d.value) << p.x, p.y, p.z;
  }
  state_.anchor = state_.x;
}

bool BentSheet::solve_to_equilibrium(const SolverOptions& solver, Answer& answer) {
  Stepper<3> stepper({.integrator = Integrator::equilibrium, .newton = 100, .solver = solver});
  const StepReport report = stepper.step(model_, state_);
  answer.verdict = report.verdict;
  answer.reason = report.reason;
  answer.unknowns = 0;
  for (const std::uint8_t h : model_.held()) answer.unknowns += h == 0;
  answer.assemble_us += report.time_us.rotate + report.time_us.assemble;
  answer.setup_us += report.time_us.setup;
  answer.solve_us += report.time_us.solve;
  answer.iterations += report.newton;
  answer.residual = std::max(answer.residual, report.newton_residual);
  if (answer.verdict != Verdict::ok) return false;
  model_.rotate(state_.x);
  force_.setZero(state_.x.size());
  model_.add_internal_force(state_.x, force_);
  model_.add_external_force(force_);
  return true;
}

Point3 BentSheet::position(DeformedIndex d) const {
  return {state_.x[3 * d.value], state_.x[3 * d.value + 1], state_.x[3 * d.value + 2]};
}

Energy BentSheet::energy() { return model_.energy(state_.x, state_.v); }

double BentSheet::bending_energy(const std::function<Point3(DeformedIndex)>& position) {
  Field x = state_.x;
  for (Eigen::Index d = 0; d < x.size() / 3; ++d)
    if (const DeformedIndex slot(to_size(d)); sheet_.rest_vertex(slot).valid()) {
      const Point3 p = position(slot);
      x.segment<3>(3 * d) << p.x, p.y, p.z;
    }
  model_.follow(x);
  model_.rotate(x);
  const double energy = model_.energy(x, state_.v).bending;
  model_.rotate(state_.x);
  return energy;
}

Point3 BentSheet::support(DeformedIndex d) const {
  return {-force_[3 * d.value], -force_[3 * d.value + 1], -force_[3 * d.value + 2]};
}

std::vector<DeformedIndex> vertices_in_use(const Sheet& sheet) {
  std::vector<DeformedIndex> result;
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d)
    if (sheet.rest_vertex(DeformedIndex(d)).valid()) result.emplace_back(d);
  return result;
}

std::vector<int> rings_from_border(const Sheet& sheet, int most) {
  std::vector<int> ring(sheet.deformed_slots(), most);
  const auto outside = [](Point2 a, Point2 b) {
    return (a.x == b.x && (a.x == 0 || a.x == 1)) || (a.y == b.y && (a.y == 0 || a.y == 1));
  };
  for (int r = 0; r < most; ++r) {
    const std::vector<int> before = ring;
    for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
      const Triangle& triangle = sheet.triangle(TriangleIndex(t));
      if (!triangle.alive()) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        int &a = ring[triangle.deformed[k]()], &b = ring[triangle.deformed[(k + 1) % 3]()];
        if (r == 0 && outside(sheet.rest(triangle.vertex[k]), sheet.rest(triangle.vertex[(k + 1) % 3]))) a = b = 0;
        if (r > 0 && before[triangle.deformed[k]()] == r - 1) b = std::min(b, r);
        if (r > 0 && before[triangle.deformed[(k + 1) % 3]()] == r - 1) a = std::min(a, r);
      }
    }
  }
  return ring;
}

std::vector<int> copies_of_vertices(const Sheet& sheet) {
  std::vector<int> copies(sheet.vertex_slots());
  for (const DeformedIndex d : vertices_in_use(sheet)) ++copies[sheet.rest_vertex(d)()];
  return copies;
}

std::vector<Point2> sides(const Sheet& sheet) {
  std::vector<Point2> centre(sheet.deformed_slots());
  std::vector<double> largest(sheet.deformed_slots());
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
    if (!sheet.triangle(TriangleIndex(t)).alive()) continue;
    const auto c = sheet.corners(TriangleIndex(t));
    const double twice_area = cross(c[1] - c[0], c[2] - c[0]);
    for (const DeformedIndex d : sheet.triangle(TriangleIndex(t)).deformed)
      if (twice_area > largest[d()]) {
        largest[d()] = twice_area;
        centre[d()] = 1.0 / 3 * (c[0] + c[1] + c[2]);
      }
  }
  return centre;
}

Point2 to_frame(const Specimen& specimen, Point2 rest) {
  const Point2 axis{std::cos(specimen.angle), std::sin(specimen.angle)}, p = rest - specimen.origin;
  return {dot(axis, p), cross(axis, p)};
}

Point2 from_frame(const Specimen& specimen, Point2 p) {
  const double c = std::cos(specimen.angle), s = std::sin(specimen.angle);
  return specimen.origin + Point2{c * p.x - s * p.y, s * p.x + c * p.y};
}

Measure compared(std::string name, double value, double exact) {
  return {std::move(name), value, exact, std::abs(value - exact) / std::abs(exact)};
}

}  // namespace cutbench
