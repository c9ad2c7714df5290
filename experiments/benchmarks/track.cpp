// The rows of performance tracking: one phase of a cut or of a step each, on a fixed sheet with fixed cuts. `count`
// runs one row under callgrind, which counts the row's region alone; `experiments/track` calls it for every row.
#include <benchmark/benchmark.h>
#include <valgrind/callgrind.h>

#include <cstdlib>
#include <cstring>
#include <functional>
#include <iostream>
#include <map>
#include <new>
#include <nlohmann/json.hpp>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/cut/cut.h"
#include "harness/cut/cut_phases.h"
#include "harness/cut/open.h"
#include "harness/fem/linear/factor.h"
#include "harness/fem/solvers/solver_table.h"
#include "harness/fem/time/stepper.h"
#include "harness/judge/oracle_request.h"
#include "harness/mesh/families.h"
#include "harness/records/context.h"
#include "methods/registry.h"

namespace {

std::size_t allocations = 0;  // of this thread, the only one

void* allocate(std::size_t bytes) {
  ++allocations;
  if (void* p = std::malloc(bytes == 0 ? 1 : bytes)) return p;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t bytes) { return allocate(bytes); }
void* operator new[](std::size_t bytes) { return allocate(bytes); }
void operator delete(void* p) noexcept { std::free(p); }
void operator delete[](void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }
void operator delete[](void* p, std::size_t) noexcept { std::free(p); }

namespace {

using namespace cutbench;

constexpr std::size_t cuts = 4;  // of one row: curves of the family "curved", seed 1
constexpr double step = 1.0 / 240;
const Material skin{.density = 2.2, .stiffness = 1000, .poisson = 0.45, .bending = 4.2e-4};  // of scenes/solvers.toml

/// What a row's region did.
struct Counted {
  double units = 0;                                  ///< of work
  std::map<std::string, double> counters;            ///< work that needs no valgrind
  std::uint64_t fingerprint = 1469598103934665603u;  ///< of the result

  /// FNV-1a (Fowler, Noll and Vo).
  void add(const void* data, std::size_t bytes) {
    const auto* at = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < bytes; ++i) fingerprint = (fingerprint ^ at[i]) * 1099511628211u;
  }
  void add(const Field& x) { add(x.data(), sizeof(double) * to_size(x.size())); }
  void add(const MeshData& mesh) {
    add(mesh.rest.data(), sizeof(mesh.rest[0]) * mesh.rest.size());
    add(mesh.triangles.data(), sizeof(mesh.triangles[0]) * mesh.triangles.size());
  }
};

/// Calls what is counted. The first call warms caches and buffers; the row undoes it.
using Region = std::function<void(const std::function<void()>&)>;

struct Row {
  std::string id, phase, unit;
  int triangles;
  std::function<Counted(const Region&)> run;
};

/// A sheet to cut, undone after each cut.
struct Bench {
  explicit Bench(int triangles)
      : base(make_sheet("delaunay", squares_per_side(triangles))),
        base_locator(base),
        sheet(base),
        locator(base_locator) {
    sheet.reserve(4 * base.triangle_slots(), 4 * base.vertex_slots(), 4 * base.deformed_slots());
    for (std::size_t i = 0; i < cuts; ++i) curves.push_back(make_case("curved", 1, i, base).front());
  }
  void undo() {
    sheet.rollback();
    locator = base_locator;
  }

  Sheet base;
  Locator base_locator;
  Sheet sheet;
  Locator locator;
  Cutter cutter;
  std::vector<Curve> curves;
};

/// Adds to the counters what the edits of a cut have grown by while `work` ran.
void count_edits(const Sheet& sheet, Counted& all, const std::function<void()>& work) {
  const auto edits = [&]() -> std::map<std::string, double> {
    const EditLog& log = sheet.log();
    const std::size_t rewritten = log.touched.size() + sheet.triangle_slots() - log.triangles_before;
    return {{"flips", to_double(log.flips)},
            {"splits", to_double(log.splits)},
            {"vertices_made", to_double(log.new_vertices.size())},
            {"triangles_rewritten", to_double(rewritten)}};
  };
  const auto before = edits();
  work();
  for (const auto& [name, value] : edits()) all.counters[name] += value - before.at(name);
}

/// The phases of a cut that have rows of their own.
const char* const tracked_phases[] = {"locate", "trace", "embed", "improve", "open"};

/// One phase is counted, in the course of a cut as Cutter::cut() makes it.
Counted run_phase(const std::string& counted, const MethodRow& row, int triangles, const Region& region) {
  Bench bench(triangles);
  const auto method = row.make(row.parameter.value);
  const CutOptions options;
  Counted all;
  Tracer tracer;
  Polyline polyline;
  for (const Curve& curve : bench.curves)
    for (const bool counts : {false, true}) {
      CutUnderWay cut(tracer, polyline, bench.sheet, bench.locator, curve, *method, options);
      for (const CutPhase& phase : cut_phases) {
        const int times = phase.run == &CutUnderWay::locate ? 100 : 1;  // once is too little to compare
        bool goes_on = true;
        const auto work = [&] {
          for (int k = 0; k < times; ++k) goes_on = (cut.*phase.run)();
        };
        if (counts && phase.name == counted)
          count_edits(bench.sheet, all, [&] { region(work); });
        else
          work();
        if (!goes_on) throw std::runtime_error(row.name + ": " + cut.outcome.reason);
      }
      if (counts) {
        const auto crossed = to_double(cut.outcome.crossed_triangles);
        all.units += crossed;
        all.counters["triangles_met"] += crossed;
        all.add(bench.sheet.to_mesh_data());
      }
      bench.undo();
    }
  return all;
}

Counted run_cut(const MethodRow& row, int triangles, const Region& region) {
  Bench bench(triangles);
  const auto method = row.make(row.parameter.value);
  Counted all;
  for (const Curve& curve : bench.curves) {
    const auto cut = [&] { return bench.cutter.cut(bench.sheet, bench.locator, curve, *method, {}); };
    cut();
    bench.undo();
    CutOutcome outcome;
    region([&] { outcome = cut(); });
    if (outcome.status != Status::ok) throw std::runtime_error(row.name + " failed: " + outcome.reason);
    all.units += to_double(outcome.crossed_triangles);
    const auto request = request_for(bench.base, {&curve, 1}, row.promises, {}, true);
    if (!oracle::judge(request, for_oracle(bench.sheet)).ok) throw std::runtime_error(row.name + ": a wrong cut");
    all.add(bench.sheet.to_mesh_data());
    bench.undo();
  }
  return all;
}

Counted run_score(int triangles, const Region& region) {
  Bench bench(triangles);
  const MethodRow& row = find_method("warp_and_refine");
  const auto method = row.make(row.parameter.value);
  bench.cutter.cut(bench.sheet, bench.locator, bench.curves[0], *method, {});
  const auto request = request_for(bench.base, {&bench.curves[0], 1}, row.promises, {}, true);
  const auto mesh = for_oracle(bench.sheet);
  Counted all;
  all.units = to_double(bench.sheet.triangle_count());
  bool ok = false;
  region([&] { ok = oracle::judge(request, mesh).ok; });
  if (!ok) throw std::runtime_error("a right cut is refused");
  return all;
}

/// A sheet that has been cut, bent and is in motion.
class Body {
 public:
  explicit Body(int triangles)
      : bench_(triangles),
        model_(bench_.sheet, skin, {.bending = BendingKind::patches, .gravity = {0, 0, -9.81}},
               {{.where = {{-1, -1}, {1e-9, 2}}}}, {}),
        state_(initial_state(model_, bench_.sheet)) {
    model_.reserve_spare();
  }

  void cut(std::size_t i) {
    const auto method = find_method("conventional_split").make(0);
    if (bench_.cutter.cut(bench_.sheet, bench_.locator, bench_.curves[i], *method, {}).status != Status::ok)
      throw std::runtime_error("a cut failed");
    touched = to_double(bench_.sheet.log().touched.size());
  }
  void follow() {
    follow_state();
    follow_pattern();
    model_.update_bending(bench_.sheet);
  }
  void follow_state() { transfer(bench_.sheet.log(), bench_.sheet.deformed_slots(), 3, state_); }
  void follow_pattern() { model_.update(bench_.sheet); }
  void bend() {
    for (Eigen::Index v = 0; v < state_.x.size() / 3; ++v)
      state_.x[3 * v + 2] = 0.3 * std::sin(3 * state_.x[3 * v]) * std::cos(2 * state_.x[3 * v + 1]);
  }
  void assemble() {
    model_.rotate(state_.x);
    model_.assemble(1, step * step + 1e-3 * step);
  }
  Model<3>& model() { return model_; }
  State& state() { return state_; }
  const Sheet& sheet() const { return bench_.sheet; }

  double touched = 0;  ///< triangles by the last cut

 private:
  Bench bench_;
  Model<3> model_;
  State state_;
};

Counted run_update(const std::string& part, int triangles, const Region& region) {
  Body body(triangles);
  body.cut(0);
  body.follow();  // what has to grow has grown
  body.cut(1);
  Counted all;
  all.units = body.touched;
  const auto run = [&](const char* name, const std::function<void()>& work) { part == name ? region(work) : work(); };
  const auto* history = body.model().system().history;
  const std::uint64_t before = history->now();
  run("state", [&] { body.follow_state(); });
  run("pattern", [&] { body.follow_pattern(); });
  run("bending", [&] { body.model().update_bending(body.sheet()); });
  all.counters["rows_touched"] = to_double(history->changed_since(before).size());
  body.assemble();
  Field f = Field::Zero(body.state().x.size());
  body.bend();
  body.model().rotate(body.state().x);
  body.model().add_internal_force(body.state().x, f);
  all.add(f);
  return all;
}

Counted run_elements(const std::string& part, int triangles, const Region& region) {
  Body body(triangles);
  body.cut(0);
  body.follow();
  body.bend();
  body.assemble();
  Counted all;
  all.units = to_double(body.model().elements().size());
  Model<3>& model = body.model();
  if (part == "rotate") region([&] { model.rotate(body.state().x); });
  if (part == "assemble") region([&] { model.assemble(1, step * step + 1e-3 * step); });
  Field product = Field::Zero(body.state().x.size());
  model.system().add_product(body.state().x, product);
  all.add(product);
  return all;
}

Counted run_solver(const std::string& part, const std::string& name, int triangles, const Region& region) {
  Body body(triangles);
  body.cut(0);
  body.follow();
  body.bend();
  body.assemble();
  const bool once = part == "iteration";
  const auto solver = make_solver<3>({.name = name, .tolerance = 1e-2, .max_iterations = once ? 1 : 10000});
  SystemMatrix<3> a = body.model().system();
  Field b = Field::Zero(body.state().x.size()), x;
  body.model().add_internal_force(body.state().x, b);
  body.model().add_external_force(b);
  solver->setup(a);
  if (part == "setup") region([&] { solver->setup(a); });
  if (part == "setup_after_cut") {
    body.cut(1);
    body.follow();
    body.bend();
    body.assemble();
    a = body.model().system();
    region([&] { solver->setup(a); });
    b = Field::Zero(body.state().x.size());
    body.model().add_internal_force(body.state().x, b);
    body.model().add_external_force(b);
  }
  SolveReport report = solver->solve(b, x);
  if (part == "solve" || once) region([&] { report = solver->solve(b, x); });
  if (!once && !report.converged) throw std::runtime_error(name + " did not converge");
  Counted all;
  all.units = to_double(b.size());
  all.counters["iterations"] = report.iterations;
  all.add(x);
  return all;
}

Counted run_step(const std::string& name, int triangles, const Region& region) {
  Body body(triangles);
  body.cut(0);
  body.follow();
  StepOptions options;
  options.integrator = Integrator::backward_euler;
  options.step = step;
  options.solver.name = name;
  Stepper<3> stepper(options);
  StepReport report;
  for (int n = 0; n < 3; ++n) report = stepper.step(body.model(), body.state());
  region([&] { report = stepper.step(body.model(), body.state()); });
  if (report.verdict != Verdict::ok) throw std::runtime_error("a step failed: " + report.reason);
  Counted all;
  all.units = to_double(body.model().elements().size());
  all.add(body.state().x);
  return all;
}

/// The methods that take the sheet of the rows. experiments/tracked.toml says which of them are counted.
std::vector<std::string> countable_methods() {
  const Sheet sheet(make_sheet("delaunay", squares_per_side(800)));
  std::vector<std::string> names;
  for (const MethodRow& row : all_methods())
    if (!row.make(row.parameter.value)->why_unsupported(sheet)) names.push_back(row.name);
  return names;
}

std::vector<Row> all_rows() {
  std::vector<Row> rows;
  const std::vector<std::string> methods = countable_methods();
  const auto add = [&](const std::string& phase, const std::string& of, const char* unit, int n,
                       std::function<Counted(const Region&)> run) {
    rows.push_back({phase + (of.empty() ? "" : "/" + of) + "/" + std::to_string(n), phase, unit, n, std::move(run)});
  };
  for (const int n : {800, 12800}) {
    for (const std::string phase : tracked_phases) {
      const bool of_method = phase == "embed" || phase == "improve";
      for (const std::string& method : methods) {
        if (!of_method && method != "conventional_split") continue;
        add(phase, of_method ? method : "", "crossed triangles", n,
            [phase, method, n](const Region& r) { return run_phase(phase, find_method(method), n, r); });
      }
    }
    for (const std::string& method : methods)
      add("cut", method, "crossed triangles", n,
          [method, n](const Region& r) { return run_cut(find_method(method), n, r); });
    for (const std::string part : {"state", "pattern", "bending"})
      add(part, "", "touched triangles", n, [part, n](const Region& r) { return run_update(part, n, r); });
    for (const std::string part : {"rotate", "assemble"})
      add(part, "", "elements", n, [part, n](const Region& r) { return run_elements(part, n, r); });
    for (const std::string& solver : solver_names())
      for (const std::string part : {"setup", "setup_after_cut", "iteration", "solve"})
        add(part, solver, "unknowns", n, [part, solver, n](const Region& r) { return run_solver(part, solver, n, r); });
    for (const std::string& solver : solver_names())
      add("step", solver, "elements", n, [solver, n](const Region& r) { return run_step(solver, n, r); });
    add("score", "", "triangles", n, [n](const Region& r) { return run_score(n, r); });
  }
  return rows;
}

int list(const std::vector<Row>& rows) {
  for (const Row& row : rows) std::cout << row.id << '\n';
  return 0;
}

/// What must be the same for counts to compare, and the commit.
int print_tools() {
  const Context context = gather_context(cholmod_version());
  nlohmann::ordered_json tools{{"compiler", context.compiler}, {"flags", context.flags}, {"build", context.build_type}};
  for (const auto& [library, version] : context.versions) tools[library] = version;
  std::cout << nlohmann::ordered_json{{"commit", context.commit.value_or("")}, {"tools", tools}}.dump() << '\n';
  return 0;
}

/// A line of JSON. What callgrind counts is in its own file.
/// \param spend  so many turns of an empty loop beside the row's work, to see that a slow-down is found
int count(const Row& row, std::int64_t spend) {
  std::size_t allocated = 0;
  Counted all = row.run([&](const std::function<void()>& work) {
    const std::size_t before = allocations;
    CALLGRIND_START_INSTRUMENTATION;
    work();
    for (std::int64_t i = 0; i < spend; ++i) benchmark::DoNotOptimize(i);
    CALLGRIND_STOP_INSTRUMENTATION;
    allocated += allocations - before;
  });
  all.counters["allocations"] = to_double(allocated);
  char fingerprint[17];
  std::snprintf(fingerprint, sizeof fingerprint, "%016llx", static_cast<unsigned long long>(all.fingerprint));
  nlohmann::ordered_json json{
      {"id", row.id},       {"phase", row.phase},       {"triangles", row.triangles}, {"unit", row.unit},
      {"units", all.units}, {"counters", all.counters}, {"fingerprint", fingerprint}};
  std::cout << json.dump() << '\n';
  return 0;
}

/// Times by Google Benchmark.
int time_all(const std::vector<Row>& rows, int argc, char** argv) {
  for (const Row& row : rows)
    benchmark::RegisterBenchmark(row.id.c_str(), [&row](benchmark::State& state) {
      for (auto _ : state) {
        double seconds = 0;
        row.run([&](const std::function<void()>& work) {
          const auto start = std::chrono::steady_clock::now();
          work();
          seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        });
        state.SetIterationTime(seconds);
      }
    })->UseManualTime();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto rows = all_rows();
    const std::string command = argc > 1 ? argv[1] : "";
    if (command == "list" && argc == 2) return list(rows);
    if (command == "count" && (argc == 3 || argc == 4)) {
      for (const Row& row : rows)
        if (row.id == argv[2]) return count(row, argc == 4 ? std::stoll(argv[3]) : 0);
      std::cerr << "there is no row " << argv[2] << "; `cutbench_track list` prints all\n";
      return 2;
    }
    if (command == "tools" && argc == 2) return print_tools();
    if (command == "time") return time_all(rows, argc - 1, argv + 1);
    std::cerr << "usage: cutbench_track list | tools | count ROW [TURNS] | time [options of Google Benchmark]\n";
    return 2;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
