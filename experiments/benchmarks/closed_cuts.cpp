// Cuts that stay closed: the path is embedded and improved, and its lips stay constrained. Nothing should move then;
// what does is an artefact of the method's new triangles. By every method at its default parameter, on a loaded sheet
// at rest: how far the equilibrium jumps (pop), what is out of balance before it relaxes, and how much data carried per
// triangle drift over many closed cuts. usage: cutbench_closed_cuts [TRIANGLES [CUTS]]
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <numbers>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/cut/constraint_source.h"
#include "harness/judge/assessment.h"
#include "harness/mesh/families.h"
#include "harness/mesh/predicates.h"
#include "harness/problems/in_plane/static_solve.h"
#include "harness/study/experiment.h"
#include "methods/registry.h"

namespace {

using namespace cutbench;

constexpr std::uint64_t seed = 1;
constexpr std::size_t single_cuts = 20;
constexpr Elastic elastic{.young = 1000, .poisson = 0.3};  // Young's modulus times thickness, N/m

/// Takes the marks of the path away again, so that there is nothing to open.
class Closed final : public CuttingMethod {
 public:
  explicit Closed(std::unique_ptr<CuttingMethod> method) : method_(std::move(method)) {}
  void adapt(Sheet& sheet, Subdivision& trace, const Polyline& path) override { method_->adapt(sheet, trace, path); }
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override { method_->embed(sheet, trace, notes); }
  void improve(Sheet& sheet, MethodNotes& notes) override {
    method_->improve(sheet, notes);
    for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
      for (int k = 0; k < 3; ++k)
        if (const HalfEdge h = half_edge(TriangleIndex(t), k);
            sheet.triangle(TriangleIndex(t)).alive() && sheet.mark(h) == EdgeMark::path)
          sheet.set_mark(h, EdgeMark::none);
  }
  const ConstraintSource* constraint_source() const override { return method_->constraint_source(); }

 private:
  std::unique_ptr<CuttingMethod> method_;
};

bool is_held(Point2 p) { return p.y == 0; }

/// The sheet stands on its lower edge and is pulled up and aside at its upper one.
StaticSolve load(const Sheet& sheet, const Constraints& constraints) {
  StaticSolve problem(sheet, elastic, constraints);
  for (std::size_t v = 0; v < sheet.vertex_slots(); ++v)
    if (const VertexIndex i(v); sheet.triangle_of_vertex(i).valid() && is_held(sheet.rest(i)))
      for (const int axis : {0, 1}) problem.hold(sheet.rest(i), axis, 0);
  problem.pull_border([](Point2 a, Point2 b) { return a.y == 1 && b.y == 1; }, {30, 50});
  return problem;
}

Field equilibrium(const Sheet& sheet, const Constraints& constraints = {}) {
  return load(sheet, constraints).solve({.solver = {.name = "cholmod"}, .iterations = 0}).displacement;
}

Eigen::Vector2d rest_of(const Sheet& sheet, std::size_t d) {
  const Point2 p = sheet.rest(sheet.rest_vertex(DeformedIndex(d)));
  return {p.x, p.y};
}

/// Norm of the forces out of balance at displacement u, over that of the load; where vertices are constrained, once
/// they are where their masters are, and of what these bear.
double out_of_balance(const Sheet& sheet, const Field& u, const Constraints& constraints) {
  Model<2> model(sheet, {.stiffness = elastic.young, .poisson = elastic.poisson},
                 {.dimension = 2, .strain = Strain::linear, .bending = BendingKind::none}, {}, {});
  Field x = u;
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d)
    if (sheet.rest_vertex(DeformedIndex(d)).valid()) x.segment<2>(2 * to_index(d)) += rest_of(sheet, d);
  const Field load_on_it = load(sheet, constraints).force();
  Field force = load_on_it;
  model.constrain(sheet, constraints);
  if (model.constrained()) model.constrained()->satisfy(model.held(), x);
  model.rotate(x);
  model.add_internal_force(x, force);
  if (model.constrained()) model.constrained()->transfer_forces(model.held(), force);
  double sum = 0;
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d)
    if (const VertexIndex v = sheet.rest_vertex(DeformedIndex(d)); v.valid() && !is_held(sheet.rest(v)))
      sum += force.segment<2>(2 * to_index(d)).squaredNorm();
  return std::sqrt(sum) / load_on_it.norm();
}

struct Pop {
  double largest = 0, rms = 0, residual = 0;  // of the largest displacement; of the load
};

/// One closed cut of a sheet at rest; nothing where the method failed.
std::optional<Pop> pop_of(const MethodRow& row, int n, std::size_t i) {
  const Sheet uncut(make_sheet("grid", n));
  Sheet sheet = uncut;
  const Field before = equilibrium(sheet);
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d) {
    const Eigen::Vector2d x = rest_of(sheet, d) + before.segment<2>(2 * to_index(d));
    sheet.set_position(DeformedIndex(d), {x[0], x[1], 0});
  }
  Locator locator(sheet);
  Closed method(row.make(row.parameter.value));
  const Curve curve = make_case("curved", seed, i, sheet).front();
  if (Cutter().cut(sheet, locator, curve, method, {}).status != Status::ok) return {};
  Field carried = Field::Zero(2 * to_index(sheet.deformed_slots()));
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d) {
    if (!sheet.rest_vertex(DeformedIndex(d)).valid()) continue;
    const auto [x, y, z] = sheet.position(DeformedIndex(d));
    carried.segment<2>(2 * to_index(d)) = Eigen::Vector2d(x, y) - rest_of(sheet, d);
  }
  const Constraints constraints = constraints_of(method, uncut, sheet);
  const Field moved = equilibrium(sheet, constraints) - carried;
  Pop pop;
  double squares = 0;
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d) {
    if (!sheet.rest_vertex(DeformedIndex(d)).valid()) continue;
    const double distance2 = moved.segment<2>(2 * to_index(d)).squaredNorm();
    pop.largest = std::max(pop.largest, std::sqrt(distance2));
    squares += distance2;
  }
  const double scale = before.cwiseAbs().maxCoeff();
  pop.largest /= scale;
  pop.rms = std::sqrt(squares / to_double(sheet.deformed_count())) / scale;
  pop.residual = out_of_balance(sheet, carried, constraints);
  return pop;
}

/// What a user may have in a triangle: a number and a direction (rad).
struct Data {
  double scalar = 0, angle = 0;
};
Data data_at(Point2 p) {
  return {std::sin(std::numbers::pi * p.x) * std::cos(std::numbers::pi * p.y), std::numbers::pi / 2 * (p.x + p.y)};
}

Point2 centroid(const std::array<Point2, 3>& c) { return 1.0 / 3 * (c[0] + c[1] + c[2]); }

/// Gives every triangle that the last cut changed the data of the one that held its centroid.
void carry(const Sheet& before, const Sheet& after, std::vector<Data>& data) {
  const std::vector<Data> old = data;
  data.resize(after.triangle_slots());
  const auto& touched = after.log().touched;
  const auto inherit = [&](TriangleIndex t) {
    if (!after.triangle(t).alive()) return;
    const Point2 p = centroid(after.corners(t));
    for (const auto& entry : touched) {
      if (!entry.before.alive()) continue;
      const auto c = before.corners(entry.slot);
      if (orientation(c[0], c[1], p) < 0 || orientation(c[1], c[2], p) < 0 || orientation(c[2], c[0], p) < 0) continue;
      data[t()] = old[entry.slot()];
      return;
    }
  };
  for (const auto& entry : touched) inherit(entry.slot);
  for (std::size_t t = after.log().triangles_before; t < after.triangle_slots(); ++t) inherit(TriangleIndex(t));
}

struct Drift {
  double scalar = 0, angle_deg = 0;  // root mean square over the area, of what was carried less what is there
  std::size_t triangles = 0, failed = 0;
};

Drift drift_of(const MethodRow& row, int n, std::size_t cuts) {
  Sheet sheet(make_sheet("grid", n));
  std::vector<Data> data;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    data.push_back(data_at(centroid(sheet.corners(TriangleIndex(t)))));
  Locator locator(sheet);
  Cutter cutter;
  Closed method(row.make(row.parameter.value));
  Drift drift;
  for (std::size_t i = 0; i < cuts; ++i) {
    const Sheet before = sheet;
    const Status status = cutter.cut(sheet, locator, make_small_cut(seed, i, sheet), method, {}).status;
    if (status == Status::ok)
      carry(before, sheet, data);
    else
      drift.failed += status != Status::noop;
  }
  double area = 0;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
    if (!sheet.triangle(TriangleIndex(t)).alive()) continue;
    const auto c = sheet.corners(TriangleIndex(t));
    const Data there = data_at(centroid(c));
    const double a = cross(c[1] - c[0], c[2] - c[0]);
    area += a;
    drift.scalar += a * std::pow(data[t].scalar - there.scalar, 2);
    drift.angle_deg += a * std::pow((data[t].angle - there.angle) * 180 / std::numbers::pi, 2);
  }
  drift.scalar = std::sqrt(drift.scalar / area);
  drift.angle_deg = std::sqrt(drift.angle_deg / area);
  drift.triangles = sheet.triangle_count();
  return drift;
}

double quantile_of(std::vector<double> values, double fraction) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, to_size(fraction * to_double(values.size())))];
}
double median_of(const std::vector<double>& values) { return quantile_of(values, 0.5); }

void print_row(const MethodRow& row, int n, std::size_t cuts) {
  std::vector<double> largest, rms, residual;
  for (std::size_t i = 0; i < single_cuts; ++i)
    if (const auto pop = pop_of(row, n, i)) {
      largest.push_back(pop->largest);
      rms.push_back(pop->rms);
      residual.push_back(pop->residual);
    }
  const Drift drift = drift_of(row, n, cuts);
  std::printf("%-20s %7zu %10.2e %10.2e %10.2e %10.2e %10.4f %10.2f %10zu %7zu\n", row.name.c_str(),
              single_cuts - largest.size(), median_of(largest), quantile_of(largest, 1), median_of(rms),
              median_of(residual), drift.scalar, drift.angle_deg, drift.triangles, drift.failed);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int n = squares_per_side(argc > 1 ? std::stoi(argv[1]) : 800);
    const std::size_t cuts = argc > 2 ? std::stoul(argv[2]) : 100;
    std::printf("closed cuts of the grid of %d, seed %lu\n", 2 * n * n, seed);
    std::printf("%-20s %7s %10s %10s %10s %10s %10s %10s %10s %7s\n", "method", "failed", "pop max", "worst", "pop rms",
                "residual", "scalar", "angle deg", "triangles", "failed");
    for (const MethodRow& row : all_methods())
      if (row.promises.keeps_area) print_row(row, n, cuts);  // else there are no lips to keep closed
    std::printf(
        "pop: by how much the equilibrium moves, over the largest displacement, and residual: forces out of balance "
        "before, over the load: medians of %zu curved cuts, each of a fresh sheet, and the worst of them\n"
        "scalar, angle: rms of what a triangle carries less what the field is there, after %zu small cuts in a row; "
        "the scalar is between -1 and 1\n",
        single_cuts, cuts);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
