// The options of `cutbench simulate`, whose work is in experiments/program/simulate.cpp.
#include "experiments/program/simulate.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <optional>

#include "experiments/program/commands/command.h"
#include "experiments/program/commands/method_options.h"
#include "experiments/program/commands/misses.h"
#include "harness/base/conversions.h"
#include "harness/base/errors.h"
#include "harness/base/names.h"
#include "harness/fem/algebra/workers.h"
#include "harness/fem/solvers/solver_table.h"
#include "harness/files/mesh_file.h"
#include "harness/files/whole_file.h"
#include "harness/mesh/families.h"
#include "harness/mesh/rest_choice.h"
#include "harness/scenes/scene_file.h"
#include "harness/scenes/toml_reader.h"

namespace cutbench {

namespace {

struct SimulateArguments {
  std::string scene, out, frames, animation, solver, report, steps;
  MethodOptions method{.method = "conventional_split", .settings = {}, .chord_tolerance = {}};
  Misses misses;
  int resolution = 0;
  std::optional<int> every, threads;
  double time_limit = 0;
};

/// Of stiffness times area at rest: as much as of strains of 4.5 %. A sheet that rests holds none.
constexpr double most_energy_at_first = 1e-3;

/// The energy of the membrane, with a Poisson's ratio of 0; most often rest positions are in other units, or a texture.
void warn_of_strain(const MeshData& mesh, double stiffness) {
  double energy = 0, area = 0;
  for (const auto& triangle : mesh.triangles) {
    const auto [a, b, c] = triangle;
    const auto rest = [&](std::int32_t v) { return mesh.rest[to_size(v)]; };
    const double part = cross(rest(b) - rest(a), rest(c) - rest(a)) / 2;
    const Stretch s = stretch_of(mesh, triangle);
    energy += part * ((s.largest - 1) * (s.largest - 1) + (s.smallest - 1) * (s.smallest - 1)) / 2;
    area += part;
  }
  if (energy <= most_energy_at_first * area) return;
  std::fprintf(stderr,
               "note: the sheet holds about %.3g J before anything moves, %.2g of stiffness times area: lengths in "
               "space are %s those at rest; if the vt are a texture, set rest = \"%s\" in [sheet]\n",
               stiffness * energy, energy / area, stretches_of(mesh).text().c_str(),
               plane_of(mesh).flat() ? "plane" : "space");
}

/// Where nobody says: all cores, but for sheets so small that threads gain nothing.
int threads_for(const MeshData& mesh) {
  constexpr std::size_t fewest_triangles = 5000;
  constexpr int most = 16;  // as many as rows are shared by
  return mesh.triangles.size() < fewest_triangles ? 1 : std::min(most, Workers::all_cores());
}

/// Where nobody says: 8, as ever, in a folder of frames; 30 frames a second where they are for an animation alone.
int steps_between_frames(const Scene& scene, const SimulateArguments& arguments) {
  return arguments.frames.empty() ? std::max(1, to_int(std::lround(1 / (30 * scene.step)))) : 8;
}

Exit run_scene(const SimulateArguments& arguments, const std::string& command_line) {
  if (arguments.every && arguments.frames.empty() && arguments.animation.empty())
    throw InputError("--every requires --frames or --animation");
  if (!arguments.out.empty()) check_mesh_place(arguments.out, "--out");
  if (!arguments.report.empty()) check_writable(arguments.report, "--report");
  if (!arguments.steps.empty()) check_writable(arguments.steps, "--steps");
  if (arguments.threads && *arguments.threads < 1)
    throw InputError("--threads: " + std::to_string(*arguments.threads) + "; give 1 or more");
  Scene scene = read_scene(arguments.scene);
  const MethodRow row = arguments.method.row();
  const double parameter = arguments.method.parameter();
  const auto method = row.make(parameter);
  set_resolution(scene, arguments.resolution);
  if (!arguments.solver.empty()) {
    check_solver_names({arguments.solver}, "--solver");
    if (!solves(scene.integrator))
      throw InputError(std::string("--solver: ") + name_of(integrator_names, scene.integrator) +
                       " solves no system; leave the option out");
    scene.solver.name = arguments.solver;
  }
  if (!solves(scene.integrator) && scene.solver.name != SolverOptions().name)
    std::fprintf(stderr, "note: the scene's solver is not asked: %s solves no system\n",
                 name_of(integrator_names, scene.integrator));
  const MeshData mesh = mesh_of(scene);
  print_notes(mesh);
  if (arguments.threads || !scene.solver.threads) scene.solver.threads = arguments.threads.value_or(threads_for(mesh));
  warn_of_strain(mesh, scene.material.stiffness);
  const Sheet sheet(mesh);
  for (std::size_t i = 0; i < scene.cuts.size(); ++i)
    if (!scene.cuts[i].curve.points.empty())
      arguments.misses.check(sheet, scene.cuts[i].curve, arguments.scene + ", cut " + std::to_string(i));
  char parameter_text[64] = "";
  if (!row.parameter.name.empty())
    std::snprintf(parameter_text, sizeof parameter_text, " %s=%g", row.parameter.name.c_str(), parameter);
  const SimulateOptions options{.method = row.name + parameter_text,
                                .command = command_line,
                                .out = arguments.out,
                                .frames = arguments.frames,
                                .animation = arguments.animation,
                                .every = arguments.every.value_or(steps_between_frames(scene, arguments)),
                                .report = arguments.report,
                                .steps = arguments.steps,
                                .time_limit = arguments.time_limit,
                                .cut = arguments.method.chord_tolerance.cut_options()};
  return simulate(scene, *method, options) ? done : fell_short;
}

}  // namespace

Command add_simulate(Options& app) {
  auto arguments = std::make_shared<SimulateArguments>();
  auto command = app.add_subcommand("simulate", "run a scene with its cuts");
  command.add_option("scene", arguments->scene, "scene file (TOML)").required();
  arguments->method.add_to(command);
  arguments->misses.add_to(command);
  command.add_option("--resolution", arguments->resolution, "triangles of the sheet; otherwise those of the scene")
      .positive();
  command.add_option("--out", arguments->out, "the sheet in the end: OBJ, OFF or VTU; not written otherwise");
  command.add_option("--frames", arguments->frames,
                     "folder for a time series: VTU files, their PVD, and an OBJ in the end");
  command.add_option(
      "--animation", arguments->animation,
      "WebP at the speed of the simulated time, the camera on what is held (needs Python with matplotlib)");
  command
      .add_option("--every", arguments->every, "steps from frame to frame; otherwise 8, for an animation alone 1/30 s")
      .positive();
  command.add_option("--solver", arguments->solver, "instead of the scene's: " + listed(solver_names()));
  command.add_option(
      "--threads", arguments->threads,
      "that share a step; otherwise all cores, 16 at most, or 1 below 5,000 triangles. They change no result");
  command.add_option("--report", arguments->report, "what the steps cost, as JSON; none where it is not given");
  command.add_option("--steps", arguments->steps, "what each step cost, as CSV; none where it is not given");
  command
      .add_option("--time-limit", arguments->time_limit,
                  "seconds of processor time, then the steps end; none otherwise")
      .positive();
  command.footer(
      "solvers:\n" + solver_help() +
      "example:\n"
      "  cutbench simulate experiments/scenes/falling_piece.toml --resolution 800 --frames frames\n"
      "exit codes:\n"
      "  0  all steps and cuts were made\n"
      "  1  a step or a cut failed, the result is not sound, a method refused a cut, or a file can't be written\n"
      "  2  bad input: an option or a file");
  return {command, [arguments](const std::string& line) { return run_scene(*arguments, line); }};
}

}  // namespace cutbench
