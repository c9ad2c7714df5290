// What binds the phases of an implicit step: bytes and operations that each needs at least, the time it takes in a
// step, and the share of what this machine can read in that time.
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <numeric>

#include "experiments/program/options.h"
#include "harness/base/conversions.h"
#include "harness/base/stop_watch.h"
#include "harness/cut/cut.h"
#include "harness/fem/elements/membrane.h"
#include "harness/fem/model/state.h"
#include "harness/fem/multigrid/multigrid.h"
#include "harness/mesh/families.h"
#include "harness/records/context.h"
#include "methods/registry.h"

namespace {

using namespace cutbench;

const Material skin{.density = 2.2, .stiffness = 1000, .poisson = 0.45, .bending = 4.2e-4};  // of scenes/solvers.toml
constexpr double step = 1.0 / 240;
constexpr int rounds = 60;
// Operations of one element, counted in membrane.h and element_stiffness.h: additions, multiplications, roots.
constexpr double rotate_operations = 170, assemble_operations = 700;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Bytes per microsecond that a sum over an array of so many bytes reads; the best of many rounds.
double read_rate(std::size_t bytes) {
  const std::vector<double> data(std::max<std::size_t>(bytes / sizeof(double), 64), 1.0);
  const std::size_t repeats = std::max<std::size_t>(1, (std::size_t{1} << 25) / bytes);
  double best = 0, sink = 0;
  for (int round = 0; round < 12; ++round) {
    StopWatch watch;
    for (std::size_t repeat = 0; repeat < repeats; ++repeat) {
      Eigen::Map<const Field> all(data.data(), to_index(data.size()));
      sink += all.sum();
    }
    best = std::max(best, to_double(repeats * data.size() * sizeof(double)) / watch.lap());
  }
  if (sink < 0) std::puts("");  // so that the sums are needed
  return best;
}

/// a = b + 2 c: two arrays are read, one is written.
double triad_rate(std::size_t bytes) {
  const auto n = to_index(std::max<std::size_t>(bytes / (3 * sizeof(double)), 64));
  Field a = Field::Zero(n);
  const Field b = Field::Constant(n, 1), c = Field::Constant(n, 2);
  const std::size_t repeats = std::max<std::size_t>(1, (std::size_t{1} << 25) / bytes);
  double best = 0;
  for (int round = 0; round < 12; ++round) {
    StopWatch watch;
    for (std::size_t repeat = 0; repeat < repeats; ++repeat) a = b + 2 * c + 1e-9 * to_double(repeat) * b;
    best = std::max(best, to_double(repeats * 3 * sizeof(double)) * to_double(n) / watch.lap());
  }
  if (a[0] < 0) std::puts("");
  return best;
}

struct Phase {
  const char* name;
  double bytes, operations;
  std::vector<double> us = {};
};

/// The phases of a step on a sheet with one cut, each timed in its place in the step, so with the caches that a step
/// leaves it.
std::vector<Phase> phases_of(int n, const MethodRow& row, double& working_set) {
  Sheet sheet(make_sheet("delaunay", n));
  Locator locator(sheet);
  Model<3> model(sheet, skin, {.bending = BendingKind::patches}, {{.where = {{-1, -1}, {1e-9, 2}}}}, {});
  State state = initial_state(model, sheet);
  const auto method = row.make(row.parameter.value);
  Cutter().cut(sheet, locator, {Curve::Kind::polyline, false, {{0.2, 0.31}, {0.8, 0.52}}}, *method, {});
  transfer(sheet.log(), sheet.deformed_slots(), 3, state);
  model.update(sheet);
  model.update_bending(sheet);

  model.rotate(state.x);
  model.assemble(1, step * step);
  SystemMatrix<3> a = model.system();
  Multigrid<3> multigrid;
  const auto blocks = to_double(a.blocks->block_count()), vertices = to_double(a.vertices());
  double scalars = 0;
  for (std::size_t i = 0; i < a.vertices(); ++i) scalars += to_double(a.scalar[0].matrix->columns(i).size());
  const auto elements = to_double(model.elements().size());
  const double per_element = sizeof(Element) + sizeof(StrainInFrame<3, double>), vector = 3 * sizeof(double) * vertices;
  const double matrix = blocks * (9 * sizeof(double) + 4) + scalars * (sizeof(double) + 4);
  multigrid.setup(a);
  const auto levels = multigrid.entries();
  const double level_blocks = levels.blocks * (12 * sizeof(float) + 4),  // three columns of four
      level_bytes = level_blocks + levels.scalars * (sizeof(float) + 4);
  working_set = elements * (per_element + 36) + matrix + level_bytes + 6 * vector;
  std::vector<Phase> phases{
      {"rotate", elements * per_element + 3 * vector, elements * rotate_operations},
      {"assemble", elements * (per_element + 36) + 3 * 72 * blocks, elements * assemble_operations},
      {"right side", matrix + 4 * vector, 18 * blocks + 6 * scalars},
      {"set-up, coarse kept", matrix + blocks * 36, 9 * blocks},
      {"set-up, coarse anew", matrix + blocks * 36 + 2 * level_blocks, 3 * 2 * 9 * 9 * blocks},
      {"product", matrix + 2 * vector, 18 * blocks + 6 * scalars},
      {"cycle", 2 * level_bytes + 4 * vector, 2 * (18 * levels.blocks + 6 * levels.scalars)}};
  Field b(state.x.size()), y(state.x.size());
  for (int round = 0; round < 2 * rounds; ++round) {
    StopWatch watch;
    const auto took = [&](std::size_t phase) { phases[phase].us.push_back(watch.lap()); };
    model.rotate(state.x);
    took(0);
    model.assemble(1, step * step);
    took(1);
    a = model.system();
    b.setZero();
    model.add_impulse(step, state.x, step, state.v, b);
    took(2);
    multigrid.setup(a);
    took(round % 2 ? 4 : 3);
    a.multiply(state.v, y);
    took(5);
    multigrid.apply(b, y);
    took(6);
  }
  // Which of the set-ups keeps the coarse matrices.
  if (median(phases[3].us) > median(phases[4].us)) std::swap(phases[3].us, phases[4].us);
  return phases;
}

void print_rates() {
  std::printf("GB/s of one core, best of 12\n%-14s %8s %8s\n", "working set", "read", "triad");
  for (std::size_t kib = 16; kib <= 512 * 1024; kib *= 4)
    std::printf("%8zu KiB   %8.1f %8.1f\n", kib, read_rate(1024 * kib) / 1e3, triad_rate(1024 * kib) / 1e3);
}

void print_phases(int triangles, const MethodRow& row) {
  double working_set = 0;
  const auto phases = phases_of(squares_per_side(triangles), row, working_set);
  const double rate = read_rate(to_size(working_set));
  std::printf("\n%d triangles, cut by %s; a step's data are %.1f MB, of which this machine reads %.1f GB/s\n",
              triangles, row.name.c_str(), working_set / 1e6, rate / 1e3);
  std::printf("%-20s %9s %9s %9s %9s %9s %11s\n", "phase", "MB", "Mflop", "ms", "GB/s", "Gflop/s", "% of GB/s");
  for (const Phase& phase : phases) {
    const double us = median(phase.us);
    std::printf("%-20s %9.2f %9.2f %9.3f %9.1f %9.1f %11.0f\n", phase.name, phase.bytes / 1e6, phase.operations / 1e6,
                us / 1e3, phase.bytes / us / 1e3, phase.operations / us / 1e3, 100 * phase.bytes / us / rate);
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const double load = load_average();
    std::vector<int> sizes{12800, 204800};
    std::string method = "warp_and_refine";
    Options app("Bytes, operations and times of the phases of a step, and what this machine can read");
    app.add_option("triangles", sizes, "of the sheets, 2 n^2 each").shows_default();
    app.add_option("--method", method, "of the cut").shows_default();
    if (const auto exit = app.parse(argc, argv)) return *exit;
    print_rates();
    for (const int triangles : sizes) print_phases(triangles, find_method(method));
    std::fputs(busy_note(load).c_str(), stderr);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
