// What a cut costs per crossed triangle: times (Google Benchmark), and instruction counts under valgrind, which are the
// same whatever else the machine is doing. `experiments/micro` runs both and prints them side by side.
#include <benchmark/benchmark.h>
#include <valgrind/callgrind.h>

#include <array>
#include <cstring>
#include <iostream>
#include <limits>
#include <set>
#include <sstream>

#include "harness/base/stop_watch.h"
#include "harness/cases/cut_families.h"
#include "harness/cut/cut.h"
#include "harness/mesh/families.h"
#include "harness/run/chill_caches.h"
#include "harness/run/every_edge.h"
#include "methods/registry.h"
#include "methods/tools/region_mesher.h"

namespace {

using namespace cutbench;

constexpr std::size_t cases = 20;
constexpr CutOptions crossings_only{.chord_tolerance = std::numeric_limits<double>::infinity()};

/// The paper's grid and the same seeded curves at every resolution.
struct Bench {
  explicit Bench(int n) : base(make_sheet("grid", n)), base_locator(base) {
    sheet = base, locator = base_locator;
    sheet.reserve(4 * base.triangle_slots(), 4 * base.vertex_slots(), 4 * base.deformed_slots());
    for (std::size_t i = 0; i < cases; ++i) curves.push_back(make_case("curved", 1, i, base).front());
  }
  /// The sheet as it was before the cut.
  void undo() { sheet.rollback(), locator = base_locator; }
  std::size_t cut(std::size_t i, CuttingMethod& method) {
    return cutter.cut(sheet, locator, curves[i], method, crossings_only).crossed_triangles;
  }

  Sheet base, sheet;
  Locator base_locator, locator;
  Cutter cutter;
  std::vector<Curve> curves;
};

/// Warm: the same cut, made and undone just before. Cold: after other work has driven everything out of the caches.
void time_method(benchmark::State& state, const MethodRow& row, double knob, int n, bool cold) {
  Bench bench(n);
  const auto method = row.make(knob);
  std::size_t crossed = 0, i = 0;
  for (auto _ : state) {
    const std::size_t curve = i++ % cases;
    bench.cut(curve, *method), bench.undo();
    if (cold) chill_caches();
    const auto start = std::chrono::steady_clock::now();
    crossed += bench.cut(curve, *method);
    state.SetIterationTime(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    bench.undo();
  }
  // Inverted rate: seconds per crossed triangle.
  state.counters["per_crossed_triangle"] =
      benchmark::Counter(static_cast<double>(crossed), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// cgal_refine at its defaults, as far as its first try, and what each part of it takes.
class PartsOfRefinement final : public CuttingMethod {
 public:
  static constexpr const char* names[] = {"convert", "insert", "refine", "put_back"};

  void improve(Sheet& sheet, MethodNotes&) override {
    wedges_.find(sheet);
    region_.clear(sheet), region_.add_changed(sheet), region_.grow(sheet, 2);
    StopWatch watch;
    mesher_.convert(sheet, region_, true);
    us[0] += watch.lap();
    mesher_.insert(sheet);
    us[1] += watch.lap();
    mesher_.refine(sheet, {.max_aspect = 3,
                           .min_edge = 1e-3 * sheet.mean_edge(),
                           .most_vertices = 20 * sheet.log().path_vertices.size(),
                           .wedges = &wedges_});
    us[2] += watch.lap();
    if (mesher_.divided().empty()) mesher_.put_back(sheet);
    us[3] += watch.lap();
  }

  std::array<double, 4> us{};

 private:
  ForcedWedges wedges_;
  RegionMesher mesher_;
  Region region_;
};

void time_part_of_refinement(benchmark::State& state, std::size_t part, int n) {
  Bench bench(n);
  PartsOfRefinement method;
  std::size_t crossed = 0, i = 0;
  for (auto _ : state) {
    const std::size_t curve = i++ % cases;
    bench.cut(curve, method), bench.undo();
    method.us = {};
    crossed += bench.cut(curve, method);
    state.SetIterationTime(1e-6 * method.us[part]);
    bench.undo();
  }
  state.counters["per_crossed_triangle"] =
      benchmark::Counter(static_cast<double>(crossed), benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void time_every_edge(benchmark::State& state, int n) {
  Bench bench(n);
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(count_crossings_by_every_edge(bench.base, bench.curves[i++ % cases]));
}

/// Under valgrind --tool=callgrind --instr-atstart=no: counts the instructions of warm cuts only.
int count_instructions(const std::string& name, double knob, int n) {
  Bench bench(n);
  std::size_t crossed = 0;
  if (name == "every_edge") {
    CALLGRIND_START_INSTRUMENTATION;
    for (const Curve& curve : bench.curves) benchmark::DoNotOptimize(count_crossings_by_every_edge(bench.base, curve));
    CALLGRIND_STOP_INSTRUMENTATION;
    const auto method = find_method("conventional_split").make(0);
    for (std::size_t i = 0; i < cases; ++i) crossed += bench.cut(i, *method), bench.undo();
  } else {
    const auto method = find_method(name).make(knob);
    for (std::size_t i = 0; i < cases; ++i) {
      bench.cut(i, *method), bench.undo();
      CALLGRIND_START_INSTRUMENTATION;
      crossed += bench.cut(i, *method);
      CALLGRIND_STOP_INSTRUMENTATION;
      bench.undo();
    }
  }
  std::cout << crossed << '\n';
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 5 && std::strcmp(argv[1], "count") == 0)
    return count_instructions(argv[2], std::stod(argv[3]), std::stoi(argv[4]));
  for (int n : {20, 80}) {
    const std::string triangles = std::to_string(2 * n * n);
    for (const MethodRow& row : all_methods())
      for (const double knob : std::set{row.knob.name.empty() ? row.knob.value : 0.0, row.knob.value}) {
        std::ostringstream name_with_knob;
        name_with_knob << row.name;
        if (!row.knob.name.empty()) name_with_knob << '(' << row.knob.name << '=' << knob << ')';
        const std::string name = name_with_knob.str();
        for (bool cold : {false, true})
          benchmark::RegisterBenchmark(
              (name + "/" + triangles + (cold ? "/cold" : "/warm")).c_str(),
              [&row, knob, n, cold](benchmark::State& s) { time_method(s, row, knob, n, cold); })
              ->UseManualTime();
      }
    for (std::size_t part = 0; part < 4; ++part)
      benchmark::RegisterBenchmark(
          (std::string("cgal_refine:") + PartsOfRefinement::names[part] + "/" + triangles).c_str(),
          [part, n](benchmark::State& s) { time_part_of_refinement(s, part, n); })
          ->UseManualTime();
    benchmark::RegisterBenchmark(("every_edge/" + triangles).c_str(),
                                 [n](benchmark::State& s) { time_every_edge(s, n); });
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
