#include "experiments/program/simulate.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "experiments/program/cures.h"
#include "experiments/program/drawing.h"
#include "experiments/program/step_summary.h"
#include "harness/base/conversions.h"
#include "harness/cut/cut_all.h"
#include "harness/fem/elements/bending_kinds.h"
#include "harness/fem/linear/factor.h"
#include "harness/files/frame_writer.h"
#include "harness/files/mesh_file.h"
#include "harness/files/whole_file.h"
#include "harness/records/context.h"
#include "harness/simulation/simulation.h"

namespace cutbench {

namespace {

/// Of a sheet at rest, SI units.
struct Size {
  double width = 0, height = 0, area = 0;
};

Size size_of(const Sheet& sheet) {
  Point2 low{1e300, 1e300}, high{-1e300, -1e300};
  Size size;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
    if (!sheet.triangle(TriangleIndex(t)).alive()) continue;
    const auto corners = sheet.corners(TriangleIndex(t));
    size.area += cross(corners[1] - corners[0], corners[2] - corners[0]) / 2;
    for (const Point2 p : corners) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  }
  size.width = high.x - low.x;
  size.height = high.y - low.y;
  return size;
}

/// What hardly anybody means: most often a unit is wrong.
void warn_of_units(const Scene& scene, const Size& size) {
  constexpr double smallest = 0.003, largest = 30, lightest = 1e-3, heaviest = 300;  // m, kg/m2
  const double longer = std::max(size.width, size.height), density = scene.material.density;
  const char* const cure =
      scene.mesh_file.empty() ? "\"size\" is in m" : "\"scale\" of [sheet] makes m of its unit, 0.001 of mm";
  if (longer > largest || longer < smallest)
    std::fprintf(stderr, "note: the sheet is %.4g m long; is that meant? %s\n", longer, cure);
  if (density > heaviest || density < lightest)
    std::fprintf(stderr,
                 "note: the sheet weighs %.4g kg/m2, %.4g kg in all; is that meant? \"density\" is that of a "
                 "volume times the thickness\n",
                 density, density * size.area);
}

void print_sheet(const Scene& scene, Simulation& motion) {
  const Size size = size_of(motion.sheet());
  std::printf("sheet: %zu triangles, %.4g x %.4g m, h = %.4g m, %.4g kg", motion.sheet().triangle_count(), size.width,
              size.height, motion.sheet().mean_edge(), scene.material.density * size.area);
  if (scene.integrator != Integrator::equilibrium) {
    const StepLimits limits = motion.step_limits();
    std::printf("; step %.4g s", scene.step);
    if (std::isfinite(limits.membrane))
      std::printf(", %.3g times the largest explicit one", scene.step / std::min(limits.membrane, limits.with_bending));
  }
  std::printf("\n");
  std::fflush(stdout);
  warn_of_units(scene, size);
  for (const std::size_t pin : idle_pins(scene, motion.sheet()))
    std::fprintf(stderr, "note: [[pins]] %zu, from 0, hold no vertex of the sheet; is that meant?\n", pin);
}

void print_head(const Scene& scene) {
  std::printf("%s\n  effect: %s\n  truth:  %s\n", scene.stem.c_str(), scene.effect.c_str(), scene.truth.c_str());
  std::printf("%9s %12s %12s %12s %12s %12s %12s\n", "time s", "membrane J", "bending J", "kinetic J", "potential J",
              "total J", "residual N");
}

void print_balance(Simulation& motion) {
  const Balance b = motion.balance();
  std::printf("%9.4f %12.5g %12.5g %12.5g %12.5g %12.5g %12.5g\n", motion.time(), b.energy.membrane, b.energy.bending,
              b.energy.kinetic, b.energy.potential, b.energy.total(), b.residual);
}

void print_cuts(const Simulation& motion) {
  const std::size_t count = motion.outcome().cuts, later = motion.made_cuts().size() - count;
  for (const MotionCut& cut : std::span(motion.made_cuts()).first(count)) {
    const Energy &a = cut.before.energy, &b = cut.after.energy;
    const std::string parts = cut.parts <= 1 ? "" : ", in " + std::to_string(cut.parts) + " parts";
    std::printf(
        "cut: %s%s, %zu triangles crossed; jumps: membrane %.3g J, bending %.3g J, kinetic %.3g J, residual %.3g N\n",
        name_of(cut.cut.status), parts.c_str(), cut.cut.crossed_triangles, b.membrane - a.membrane,
        b.bending - a.bending, b.kinetic - a.kinetic, cut.after.residual - cut.before.residual);
    if (cut.cut.status == Status::refused) std::printf("     %s\n", cut.reason.c_str());
  }
  if (later > 0) std::printf("%zu more cuts came after the verdict, and do not count\n", later);
}

void print_budget(const EnergyBudget& budget) {
  const BudgetRow& end = budget.end();
  const EnergyBudget::Gains gains = budget.gains();
  std::printf(
      "budget until %.4g s: damping %.4g J, numerical loss %.4g J, work of pins %.4g J, jumps %.3g J, remainder %.3g "
      "J\n",
      end.time, -end.damping, -end.numerical_loss, end.pin_work, end.jumps, end.remainder);
  std::printf("gains of kinetic and elastic energy: remainder %.2g %%, jumps %.2g %%\n", 100 * gains.remainder,
              100 * gains.jumps);
}

/// What to compare an explicit step with; null where the method constrains vertices.
nlohmann::ordered_json limits_of(Simulation& motion) {
  const StepLimits limits = motion.step_limits();
  if (!std::isfinite(limits.membrane)) return nullptr;
  return {{"membrane", limits.membrane}, {"with_bending", limits.with_bending}};
}

void print_limits(const nlohmann::ordered_json& limits, double step) {
  if (limits.is_null()) return;
  std::printf("largest explicit step: %.3g s by the membrane, %.3g s with bending (the step is %.3g s)\n",
              limits["membrane"].get<double>(), limits["with_bending"].get<double>(), step);
}

/// What a caption needs to say of the frames beside it.
std::string description(const Scene& scene, const Simulation& motion, const SimulateOptions& options,
                        std::size_t triangles_before) {
  const Context context = gather_context(cholmod_version());
  nlohmann::ordered_json document{{"scene", scene.stem},
                                  {"effect", scene.effect},
                                  {"method", options.method},
                                  {"sheet", scene.family.empty() ? scene.mesh_file : scene.family},
                                  {"triangles_before", triangles_before},
                                  {"triangles_after", motion.sheet().triangle_count()},
                                  {"unknowns", scene.physics.dimension * to_int(motion.sheet().deformed_count())},
                                  {"size_m", scene.size},
                                  {"step_s", scene.step},
                                  {"bending", name_of(scene.physics.bending)},
                                  {"solver", scene.solver.name},
                                  {"solver_tolerance", scene.solver.tolerance},
                                  {"newton", scene.newton},
                                  {"verdict", name_of(motion.outcome().verdict)},
                                  {"reason", motion.outcome().reason}};
  if (!solves(scene.integrator)) document["solver"] = document["solver_tolerance"] = nullptr;
  if (std::isfinite(options.cut.chord_tolerance)) document["chord_tolerance"] = options.cut.chord_tolerance;
  document["cuts_refused"] = motion.outcome().refused;
  document["cuts"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < motion.made_cuts().size(); ++i) {
    const CutRun& made = motion.made_cuts()[i].cut;
    nlohmann::ordered_json cut{{"time_s", scene.cuts[i].time},
                               {"status", name_of(made.status)},
                               {"crossed_triangles", made.crossed_triangles}};
    if (scene.cuts[i].speed > 0) {
      cut["speed_m_s"] = scene.cuts[i].speed;
      cut["parts"] = motion.made_cuts()[i].parts;
    }
    if (!scene.cuts[i].family.empty()) cut["seed"] = scene.cuts[i].seed;
    document["cuts"].push_back(cut);
  }
  document["commit"] = context.commit ? nlohmann::ordered_json(*context.commit) : nullptr;
  document["dirty"] = context.dirty ? nlohmann::ordered_json(*context.dirty) : nullptr;
  document["command"] = options.command;
  return document.dump(2) + "\n";
}

void write_report(const Scene& scene, const SimulateOptions& options, const Simulation& motion,
                  const nlohmann::ordered_json& limits, const nlohmann::ordered_json& summary) {
  const SimulationOutcome outcome = motion.outcome();
  nlohmann::ordered_json document{{"scene", scene.stem},
                                  {"method", options.method},
                                  {"integrator", name_of(integrator_names, scene.integrator)},
                                  {"solver", scene.solver.name},
                                  {"solver_tolerance", scene.solver.tolerance},
                                  {"step_s", scene.step},
                                  {"verdict", name_of(outcome.verdict)},
                                  {"reason", outcome.reason},
                                  {"cuts", outcome.cuts},
                                  {"cuts_refused", outcome.refused},
                                  {"energy_judged", motion.budget() != nullptr}};
  if (!solves(scene.integrator)) document["solver"] = document["solver_tolerance"] = nullptr;
  document["verdict_time_s"] =
      outcome.verdict == Verdict::ok ? nlohmann::ordered_json() : nlohmann::ordered_json(outcome.time);
  document["explicit_step_limit_s"] = limits;
  document["gains"] = nullptr;
  if (motion.budget()) {
    const EnergyBudget::Gains gains = motion.budget()->gains();
    document["gains"] = {{"remainder", gains.remainder}, {"jumps", gains.jumps}, {"unexplained", gains.unexplained}};
  }
  document["cost"] = summary;  // null where no step was made, and at rest
  WholeFile(options.report, document.dump(2) + "\n").place();
}

/// Steps until the end or a verdict that ends them, with a line of energies ten times.
void make_steps(const Scene& scene, Simulation& motion, CuttingMethod& method, const SimulateOptions& options,
                FrameWriter* frames) {
  const int steps =
      scene.integrator == Integrator::equilibrium ? 1 : to_int(std::ceil(scene.duration / scene.step - 1e-9));
  print_head(scene);
  print_balance(motion);
  if (frames) frames->add(motion.posed_sheet(), motion.time());
  bool goes_on = true;
  for (int step = 1, part = 1; step <= steps && goes_on; ++step) {
    goes_on = motion.advance(step * scene.step, method, options.cut).verdict == Verdict::ok;
    const bool last = step == steps || !goes_on;
    if (frames && goes_on && (last || step % options.every == 0)) frames->add(motion.posed_sheet(), motion.time());
    if (last || std::int64_t{step} * 10 >= std::int64_t{part} * steps) {
      print_balance(motion);
      part = to_int(std::int64_t{step} * 10 / steps) + 1;
    }
  }
}

void print_outcome(const SimulationOutcome& outcome, const Sheet& sheet) {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::printf("%s", outcome.text().c_str());
  std::printf("; %zu triangles, %zu pieces; peak memory %.0f MB\n", sheet.triangle_count(), count_pieces(sheet),
              to_double(usage.ru_maxrss) / 1024);
}

}  // namespace

bool simulate(const Scene& scene, CuttingMethod& method, const SimulateOptions& options) {
  const double load = load_average();
  const auto motion = Simulation::start(scene);
  std::optional<Drawing> drawing;
  if (!options.animation.empty())
    drawing.emplace("--animation", options.animation, std::initializer_list<const char*>{".webp"});
  std::filesystem::path folder = options.frames;
  if (folder.empty() && drawing) folder = drawing->folder() / "frames";
  std::optional<FrameWriter> frames;
  if (!folder.empty()) frames.emplace(folder);
  motion->watch();
  if (options.time_limit > 0) motion->limit_time(options.time_limit);
  const std::size_t triangles_before = motion->sheet().triangle_count();
  print_sheet(scene, *motion);
  make_steps(scene, *motion, method, options, frames ? &*frames : nullptr);
  const SimulationOutcome outcome = motion->outcome();
  print_cuts(*motion);
  if (motion->budget()) print_budget(*motion->budget());
  const bool static_solve = scene.integrator == Integrator::equilibrium;
  nlohmann::ordered_json summary, limits;
  const std::span counted = std::span(motion->steps()).first(outcome.steps);
  if (!counted.empty() && !static_solve) summary = summary_of(counted, scene.step * to_double(counted.size()));
  if (!summary.is_null()) {
    print_summary(summary);
    std::fputs(busy_note(load).c_str(), stdout);
  }
  if (scene.integrator == Integrator::symplectic_euler || !options.report.empty()) limits = limits_of(*motion);
  print_limits(limits, scene.step);
  const Sheet sheet = motion->posed_sheet();
  print_outcome(outcome, sheet);
  if (outcome.verdict != Verdict::ok) std::printf("try %s\n", cure_of(scene, outcome, motion->step_limits()).c_str());
  if (frames) {
    frames->finish(sheet);
    if (motion->budget()) WholeFile(folder / "energy.csv", motion->budget()->csv()).place();
    WholeFile(folder / "simulation.json", description(scene, *motion, options, triangles_before)).place();
  }
  if (drawing) drawing->make("animate_frames.py", {"--frames", std::filesystem::absolute(folder).string()});
  if (!options.out.empty()) write_mesh(sheet.to_mesh_data(), options.out);
  if (!options.steps.empty()) WholeFile(options.steps, table_of(motion->steps(), scene.step)).place();
  if (!options.report.empty()) write_report(scene, options, *motion, limits, summary);
  return outcome.verdict == Verdict::ok && outcome.refused == 0;
}

}  // namespace cutbench
