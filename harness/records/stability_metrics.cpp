#include "harness/records/metrics.h"

namespace cutbench {

std::vector<Metric> stability_metrics() {
  std::vector<Metric> t;
  const auto share = [&](std::initializer_list<const char*> names) {
    for (const char* name : names) t.push_back(shared_metric(name));
  };
  const auto add_setting = [&](const char* name, const char* unit, const char* label, const char* definition) {
    t.push_back({name, unit, label, Direction::none, Group::stability_setting, definition});
  };
  add_setting("sweep", "", "sweep", "Its name in experiments/stability.toml.");
  add_setting("cut", "", "cut", "What the cut comes near: harness/study/stability/placed_cuts.h; or a cut family.");
  add_setting("place", "", "place",
              "How near, in h of the uncut sheet; of `recut` an angle in degrees, of `in_a_row` a number of cuts, of "
              "`piece` its size in triangles' sides.");
  add_setting("pose", "", "pose", "How the sheet starts: `flat`, `rolled`, `stretched` (harness/study/sweep.h).");
  add_setting("pose_amount", "", "amount of the pose", "Degrees of `rolled`, the factor of `stretched`.");
  add_setting(
      "step_share", "", "explicit step / limit of the uncut sheet",
      "Of an explicit motion: its step over the largest stable one of the uncut sheet, bending included; else 0.");
  add_setting("integrator", "", "integrator", "As in scenes.");
  add_setting("step_s", "s", "step", "As the file says; of an explicit motion its `step_share` decides instead.");
  add_setting("newton", "", "Newton iterations", "Linear solves in a step.");
  share({"solver"});
  add_setting("tolerance", "", "tolerance", "Of the linear solver.");
  add_setting("max_iterations", "", "iterations allowed", "Of the linear solver, in a solve.");
  add_setting("stiffness_n_m", "N/m", "stiffness", "Young's modulus x thickness.");
  add_setting("poisson", "", "Poisson's ratio", "Poisson's ratio.");
  add_setting("mass_damping_1_s", "1/s", "mass damping", "Rayleigh's alpha.");
  add_setting("stiffness_damping_s", "s", "stiffness damping", "Rayleigh's beta.");
  add_setting("stress_stiffness", "", "stiffness from stress",
              "`positive`, `full` or `none`: of the stiffness that stress gives to the membrane.");
  add_setting("mass", "", "mass", "`lumped` or `consistent`.");
  add_setting("bending", "", "bending", "`none`, `patches` or `hinges`.");
  share({"status", "verdict", "reason"});
  share({"triangles", "vertices_added", "ar_max_cut", "altitude_min_h_cut", "incision_error_h", "geometry_us",
         "eigenvalue_ratio"});
  const auto add = [&](const char* name, const char* unit, const char* label, Direction direction,
                       const char* definition) {
    t.push_back({name, unit, label, direction, Group::stability_point, definition});
  };
  add("explicit_step_ratio", "", "explicit step, cut / uncut", Direction::higher,
      "Largest stable step of symplectic Euler after the cut over that of the uncut sheet, from the largest "
      "eigenvalues "
      "with bending and the scene's material. A method that constrains vertices has the "
      "value that an explicit step with its constraints would have; the program makes none.");
  add("steps", "", "steps made", Direction::higher,
      "Steps of the motion that were made; fewer than asked where it ended.");
  add("cut_update_us", "us", "cuts and update", Direction::lower,
      "In the motion, nothing warmed up: all cuts of the point, the state of new vertices, elements, mass, loads, "
      "bending and the pattern of the system.");
  add("first_step_us", "us", "time of the first step", Direction::lower,
      "The one right after the cuts, in which the solver is set up from nothing.");
  add("step_us", "us", "time of a step", Direction::lower, "Median over the steps of the motion.");
  share({"iterations", "residual"});
  add("energy_gain", "", "energy gained", Direction::lower,
      "What the energy budget can't explain over the largest kinetic and elastic energy: of an explicit motion all but "
      "pins and jumps, else the remainder (harness/simulation/energy_budget.h).");
  add("drift_h", "h", "drift", Direction::lower,
      "Farthest that a vertex ends from where `cholmod` brings it in the same motion.");
  return t;
}

}  // namespace cutbench
