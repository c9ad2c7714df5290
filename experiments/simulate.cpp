#include "experiments/simulate.h"

#include <sys/resource.h>

#include <cstdio>

#include "harness/mesh/mesh_io.h"
#include "harness/run/in_motion.h"

namespace cutbench {

bool simulate(const Scene& scene, CuttingMethod& method, const CutOptions& options, const std::string& out) {
  std::printf("%s\n  effect: %s\n  truth:  %s\n", scene.stem.c_str(), scene.effect.c_str(), scene.truth.c_str());
  const auto motion = InMotion::start(scene);
  std::printf("%9s %12s %12s %12s %12s %12s %12s\n", "time s", "membrane J", "bending J", "kinetic J", "potential J",
              "total J", "residual N");
  const auto print = [&] {
    const Balance b = motion->balance();
    std::printf("%9.4f %12.5g %12.5g %12.5g %12.5g %12.5g %12.5g\n", motion->time(), b.energy.membrane,
                b.energy.bending, b.energy.kinetic, b.energy.potential, b.energy.total(), b.residual);
  };
  print();
  StepReport report;
  const bool static_solve = scene.integrator == Integrator::equilibrium;
  for (int part = 1; part <= (static_solve ? 1 : 10) && report.verdict == "ok"; ++part) {
    report = motion->advance(static_solve ? scene.step : scene.duration * part / 10, method, options);
    print();
  }
  for (const MotionCut& cut : motion->made_cuts()) {
    const Energy &a = cut.before.energy, &b = cut.after.energy;
    std::printf(
        "cut: %s, %zu triangles crossed; jumps: membrane %.3g J, bending %.3g J, kinetic %.3g J, residual %.3g N\n",
        name_of(cut.cut.status), cut.cut.crossed_triangles, b.membrane - a.membrane, b.bending - a.bending,
        b.kinetic - a.kinetic, cut.after.residual - cut.before.residual);
  }
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const Sheet sheet = motion->posed_sheet();
  std::printf("%s%s%s; %zu triangles, %zu pieces; peak memory %.0f MB\n", report.verdict.c_str(),
              report.reason.empty() ? "" : ": ", report.reason.c_str(), sheet.triangle_count(), count_pieces(sheet),
              static_cast<double>(usage.ru_maxrss) / 1024);
  if (!out.empty()) write_mesh(sheet.to_mesh_data(), out);
  return report.verdict == "ok";
}

}  // namespace cutbench
