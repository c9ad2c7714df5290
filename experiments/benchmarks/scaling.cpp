// One cut of about 200 triangles on sheets of more and more triangles: what geometry and updates cost per crossed
// triangle, and how many bytes a triangle of a sheet in motion takes.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "experiments/program/options.h"
#include "harness/base/conversions.h"
#include "harness/base/stop_watch.h"
#include "harness/cut/cut.h"
#include "harness/fem/model/state.h"
#include "harness/fem/multigrid/multigrid.h"
#include "harness/mesh/families.h"
#include "harness/records/context.h"
#include "methods/registry.h"

namespace {

using namespace cutbench;

const Material skin{.density = 2.2, .stiffness = 1000, .poisson = 0.45, .bending = 4.2e-4};  // of scenes/solvers.toml
constexpr double step = 1.0 / 240;
constexpr int places = 9;                // of the cut: three by three
constexpr double width = 50;             // of the cut's box in mean edges: some 200 triangles
constexpr int smallest_shared = 204800;  // triangles: from here on all places are on one sheet, and apart

/// Microseconds of one cut.
struct Cost {
  double crossed = 0, geometry = 0, transfer = 0, pattern = 0, bending = 0, levels = 0;
};

/// A sheet in motion with its model and its multigrid levels.
class Body {
 public:
  explicit Body(const MeshData& mesh)
      : sheet_(mesh),
        locator_(sheet_),
        model_(sheet_, skin, {.bending = BendingKind::patches}, {{.where = {{-1, -1}, {1e-9, 2}}}}, {}),
        state_(initial_state(model_, sheet_)) {
    sheet_.reserve(2 * sheet_.triangle_slots(), 2 * sheet_.vertex_slots(), 2 * sheet_.deformed_slots());
    model_.reserve_spare();
    set_up();
  }

  Cost cut(const Curve& curve, CuttingMethod& method) {
    Cost cost;
    const CutOutcome outcome = cutter_.cut(sheet_, locator_, curve, method, {});
    if (outcome.status != Status::ok) throw std::runtime_error("a cut failed: " + outcome.reason);
    cost.crossed = to_double(outcome.crossed_triangles);
    cost.geometry = outcome.time_us.total();
    StopWatch watch;
    transfer(sheet_.log(), sheet_.deformed_slots(), 3, state_);
    cost.transfer = watch.lap();
    model_.update(sheet_);
    cost.pattern = watch.lap();
    model_.update_bending(sheet_);
    cost.bending = watch.lap();
    set_up();
    cost.levels = multigrid_.rows_us();
    return cost;
  }

 private:
  /// As in a step: whatever was in the cache for the cut is not there for the next.
  void set_up() {
    model_.rotate(state_.x);
    model_.assemble(1, step * step);
    matrix_ = model_.system();
    multigrid_.setup(matrix_);
  }

  Sheet sheet_;
  Locator locator_;
  Cutter cutter_;
  Model<3> model_;
  State state_;
  SystemMatrix<3> matrix_;
  Multigrid<3> multigrid_;
};

/// An S in a box of that width round a point of the square.
Curve s_curve(Point2 middle, double side) {
  const auto at = [&](double x, double y) { return Point2{middle.x + side * (x - 0.5), middle.y + side * (y - 0.5)}; };
  return {Curve::Kind::bezier, false, {at(0, 0.1), at(1.6, 0.3), at(-0.6, 0.7), at(1, 0.9)}};
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double peak_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * to_double(usage.ru_maxrss);
}

void measure(const MethodRow& row, int n) {
  const MeshData mesh = make_sheet("grid", n);
  const double triangles = 2.0 * n * n, h = 1 / std::sqrt(triangles / 2), before = peak_bytes();
  const double side = std::min(width * h, 0.7);
  const bool shared = triangles >= smallest_shared;
  const auto method = row.make(row.parameter.value);
  std::unique_ptr<Body> body;
  double bytes = 0;
  std::vector<std::vector<double>> costs(6);
  for (int k = 0; k < places; ++k) {
    if (!body || !shared) {
      body.reset();
      body = std::make_unique<Body>(mesh);
    }
    if (bytes == 0) bytes = (peak_bytes() - before) / triangles;
    const int column = k % 3, line = k / 3;
    const double off = shared ? 0.31 : 0.02;
    // Not a whole number of edges apart: other places on the grid.
    const Cost cost = body->cut(s_curve({0.5 + off * (column - 1.03), 0.5 + off * (line - 1.01)}, side), *method);
    const double all[] = {cost.crossed, cost.geometry, cost.transfer, cost.pattern, cost.bending, cost.levels};
    for (std::size_t i = 0; i < costs.size(); ++i) costs[i].push_back(i == 0 ? all[0] : all[i] / cost.crossed);
  }
  std::printf("%-20s %9.0f %8.0f", row.name.c_str(), triangles, median(costs[0]));
  for (std::size_t i = 1; i < costs.size(); ++i) std::printf(" %9.3f", median(costs[i]));
  std::printf(" %9.0f\n", bytes);
  std::fflush(stdout);
}

/// In a process of its own: its memory is that of one sheet.
void measure_apart(const MethodRow& row, int n) {
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error("no process can be started");
  if (child == 0) {
    try {
      measure(row, n);
      _exit(0);
    } catch (const std::exception& error) {
      std::cerr << error.what() << '\n';
      _exit(1);
    }
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (status != 0) throw std::runtime_error(row.name + " failed on 2 x " + std::to_string(n) + "^2 triangles");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const double load = load_average();
    std::int64_t largest = 3276800;
    std::vector<std::string> methods{"conventional_split", "cgal_cdt", "warp_and_refine"};
    Options app("One cut of about 200 triangles on larger and larger sheets");
    app.add_option("largest", largest, "triangles of the largest sheet, from 12800 on four times each").shows_default();
    app.add_option("--methods", methods, "comma-separated").comma_separated().shows_default();
    if (const auto exit = app.parse(argc, argv)) return *exit;
    std::vector<MethodRow> rows;
    for (const std::string& name : methods) rows.push_back(find_method(name));
    std::printf(
        "wall us per crossed triangle, medians of %d cuts of a grid; bytes per triangle of the sheet in motion\n",
        places);
    std::printf("%-20s %9s %8s %9s %9s %9s %9s %9s %9s\n", "method", "triangles", "crossed", "geometry", "state",
                "pattern", "bending", "levels", "bytes");
    std::fflush(stdout);  // or each process would print it again
    for (const MethodRow& row : rows)
      for (int n = 80; 2ll * n * n <= largest; n *= 2) measure_apart(row, n);
    std::fputs(busy_note(load).c_str(), stderr);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
