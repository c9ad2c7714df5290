#include "experiments/program/cures.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cutbench {

namespace {

std::string with_number(const char* format, double number) {
  char text[160];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

/// Of a step that gained energy, turned triangles over or ran away.
std::string of_step(const Scene& scene, const StepLimits& limits) {
  if (scene.integrator == Integrator::symplectic_euler) {
    const double largest = std::min(limits.membrane, limits.with_bending);
    if (std::isfinite(largest) && scene.step > largest)
      return with_number("step = %.2g in [integrator]: a tenth below the largest stable one after the cuts",
                         0.9 * largest);
    return with_number("step = %.2g in [integrator]: half of it", scene.step / 2);
  }
  if (solves(scene.integrator) && scene.integrator != Integrator::equilibrium && !scene.robust)
    return "robust = true in [integrator], without newton: it goes on until the energy of a step is right";
  return with_number("step = %.2g in [integrator]: a quarter of it; or some stiffness_damping", scene.step / 4);
}

}  // namespace

std::string cure_of(const Scene& scene, const SimulationOutcome& outcome, const StepLimits& limits) {
  switch (outcome.verdict) {
    case Verdict::energy_growth:
      if (outcome.reason.starts_with("by jumps"))
        return "a cut before the sheet is bent or rolled up there, or a finer sheet: the cut itself gained this energy";
      return of_step(scene, limits);
    case Verdict::not_finite:
    case Verdict::inverted:
      return of_step(scene, limits);
    case Verdict::newton_failed:
      return "robust = true in [integrator], without newton";
    case Verdict::solver_stalled:
      if (outcome.reason.find("held nowhere") != std::string::npos) return "[[pins]] for the pieces that nothing holds";
      return scene.solver.name == "multigrid" ? "--solver cholmod" : "--solver multigrid";
    case Verdict::timed_out:
      return "fewer triangles, or --solver multigrid";
    default:
      return {};
  }
}

}  // namespace cutbench
