#include "experiments/simulate.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <optional>

#include "experiments/step_summary.h"
#include "harness/cut/cut_all.h"
#include "harness/mesh/mesh_io.h"
#include "harness/records/context.h"
#include "harness/scene/frame_writer.h"
#include "harness/scene/simulation.h"

namespace cutbench {

namespace {

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
  for (const MotionCut& cut : motion.made_cuts()) {
    const Energy &a = cut.before.energy, &b = cut.after.energy;
    const std::string parts = cut.parts <= 1 ? "" : ", in " + std::to_string(cut.parts) + " parts";
    std::printf(
        "cut: %s%s, %zu triangles crossed; jumps: membrane %.3g J, bending %.3g J, kinetic %.3g J, residual %.3g N\n",
        name_of(cut.cut.status), parts.c_str(), cut.cut.crossed_triangles, b.membrane - a.membrane,
        b.bending - a.bending, b.kinetic - a.kinetic, cut.after.residual - cut.before.residual);
    if (cut.cut.status == Status::refused) std::printf("     %s\n", cut.reason.c_str());
  }
}

/// A sheet that gains energy has a wrong step, however smooth it looks.
void judge_budget(const EnergyBudget& budget, StepReport& report) {
  const BudgetRow& end = budget.rows().back();
  const double growth = budget.growth();
  std::printf("budget: damping %.4g J, numerical loss %.4g J, work of pins %.4g J, jumps %.3g J, remainder %.3g J\n",
              -end.damping, -end.numerical_loss, end.pin_work, end.jumps, end.remainder);
  if (report.verdict != "ok" || growth <= 0.01) return;
  char text[96];
  std::snprintf(text, sizeof text, "the total, less work and jumps, rose by %.2g %% of kinetic and elastic energy",
                100 * growth);
  report.verdict = "energy_growth", report.reason = text;
}

/// What a caption needs to say of the frames beside it.
std::string description(const Scene& scene, const Simulation& motion, const SimulateOptions& options,
                        const StepReport& report, std::size_t triangles_before) {
  const Context context = gather_context();
  nlohmann::ordered_json document{
      {"scene", scene.stem},
      {"effect", scene.effect},
      {"method", options.method},
      {"sheet", scene.family.empty() ? scene.mesh_file.string() : scene.family},
      {"triangles_before", triangles_before},
      {"triangles_after", motion.sheet().triangle_count()},
      {"unknowns", scene.physics.dimension * static_cast<int>(motion.sheet().deformed_count())},
      {"size_m", scene.size},
      {"step_s", scene.step},
      {"bending", name_of(bending_names, scene.physics.bending)},
      {"solver", scene.solver.name},
      {"solver_tolerance", scene.solver.tolerance},
      {"newton", scene.newton},
      {"verdict", report.verdict},
      {"reason", report.reason}};
  if (std::isfinite(options.cut.chord_tolerance)) document["chord_tolerance"] = options.cut.chord_tolerance;
  document["cuts"] = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < motion.made_cuts().size(); ++i) {
    const CutRun& made = motion.made_cuts()[i].cut;
    nlohmann::ordered_json cut{{"time_s", scene.cuts[i].time},
                               {"status", name_of(made.status)},
                               {"crossed_triangles", made.crossed_triangles}};
    if (scene.cuts[i].speed > 0) cut["speed_m_s"] = scene.cuts[i].speed, cut["parts"] = motion.made_cuts()[i].parts;
    if (!scene.cuts[i].family.empty()) cut["seed"] = scene.cuts[i].seed;
    document["cuts"].push_back(cut);
  }
  document["commit"] = context.commit ? nlohmann::ordered_json(*context.commit) : nullptr;
  document["dirty"] = context.dirty ? nlohmann::ordered_json(*context.dirty) : nullptr;
  document["command"] = options.command;
  return document.dump(2) + "\n";
}

void write_report(const Scene& scene, const SimulateOptions& options, const StepReport& report,
                  const nlohmann::ordered_json& summary) {
  nlohmann::ordered_json document{{"scene", scene.stem},         {"method", options.method},
                                  {"solver", scene.solver.name}, {"solver_tolerance", scene.solver.tolerance},
                                  {"step_s", scene.step},        {"verdict", report.verdict},
                                  {"reason", report.reason}};
  document["cost"] = summary;  // null where no step was made, and at rest
  WholeFile(options.report, document.dump(2) + "\n").place();
}

}  // namespace

bool simulate(const Scene& scene, CuttingMethod& method, const SimulateOptions& options) {
  const auto motion = Simulation::start(scene);
  std::optional<FrameWriter> frames;
  if (!options.frames.empty()) frames.emplace(options.frames), motion->keep_budget();
  const std::size_t triangles_before = motion->sheet().triangle_count();
  const bool static_solve = scene.integrator == Integrator::equilibrium;
  const int steps = static_solve ? 1 : static_cast<int>(std::ceil(scene.duration / scene.step - 1e-9));

  print_head(scene);
  print_balance(*motion);
  if (frames) frames->add(motion->posed_sheet(), motion->time());
  StepReport report;
  for (int step = 1, part = 1; step <= steps && report.verdict == "ok"; ++step) {
    report = motion->advance(step * scene.step, method, options.cut);
    const bool last = step == steps || report.verdict != "ok";
    if (frames && report.verdict == "ok" && (last || step % options.every == 0))
      frames->add(motion->posed_sheet(), motion->time());
    if (last || step * 10 >= part * steps) print_balance(*motion), part = step * 10 / steps + 1;
  }
  print_cuts(*motion);
  if (motion->budget()) judge_budget(*motion->budget(), report);
  nlohmann::ordered_json summary;
  if (!motion->steps().empty() && !static_solve) summary = summary_of(motion->steps(), motion->time());
  if (!summary.is_null()) print_summary(summary);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const Sheet sheet = motion->posed_sheet();
  std::printf("%s%s%s; %zu triangles, %zu pieces; peak memory %.0f MB\n", report.verdict.c_str(),
              report.reason.empty() ? "" : ": ", report.reason.c_str(), sheet.triangle_count(), count_pieces(sheet),
              static_cast<double>(usage.ru_maxrss) / 1024);
  if (frames) {
    frames->finish(sheet);
    if (motion->budget()) motion->budget()->write(std::filesystem::path(options.frames) / "energy.csv");
    WholeFile(std::filesystem::path(options.frames) / "simulation.json",
              description(scene, *motion, options, report, triangles_before))
        .place();
  }
  if (!options.out.empty()) write_mesh(sheet.to_mesh_data(), options.out);
  if (!options.steps.empty()) WholeFile(options.steps, table_of(motion->steps(), scene.step)).place();
  if (!options.report.empty()) write_report(scene, options, report, summary);
  const auto refused = [](const MotionCut& cut) { return cut.cut.status == Status::refused; };
  const auto& cuts = motion->made_cuts();
  return report.verdict == "ok" && std::none_of(cuts.begin(), cuts.end(), refused);
}

}  // namespace cutbench
