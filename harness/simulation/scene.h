// A scene: a sheet, what it is made of, what holds it and pulls at it, how it is stepped and solved, and the cuts it
// gets. SI units; a file names the one effect it shows and its truth.
//
//   effect = "..."     truth = "..."     duration = 1.0
//   [sheet]       family, size, resolution | file
//   [material]    density, stiffness, poisson, bending, mass_damping, stiffness_damping
//   [physics]     dimension = 2|3, plane = "stress"|"strain", strain = "corotational"|"linear"|"green"|"springs",
//                 stress_stiffness = "none"|"positive"|"full" (default: positive), bending = of bending_names,
//                 mass = "lumped"|"consistent"|"stabilised"|"scaled", mass_limit = 1 (of the last two: harness/fem/
//                 physics.h), gravity = [x, y, z],
//                 active_radius (m: from the first cut on, what is farther from all cuts in rest space stays where it is,
//                 and all but two rings of vertices of it are left out; pins there go on; what a method makes between
//                 vertices that stay is free)
//   [[pins]]      near = [x, y] | box = [[x0, y0], [x1, y1]]; axes = "xyz", displacement, velocity = [x, y, z]
//   [[tractions]] box, force = [x, y, z]
//   [integrator]  name = "backward_euler"|"midpoint"|"symplectic_euler"|"xpbd"|"equilibrium", step, newton,
//                 sweeps = 1 (of xpbd, per step; it uses no [solver] and no stress_stiffness)
//   [solver]      name, tolerance, max_iterations
//   [[cuts]]      time; bezier | polyline = [[x, y], ...], closed = true, speed | family, seed, case
//                 space = "world": the points are picked on the sheet as it is at that time (harness/path/pick.h), each
//                 [x, y, z], or a ray {origin = [x, y, z], direction = [x, y, z]}
//
// Omitted keys have the defaults below. In a 2D scene vectors may omit z. Boxes may be infinite.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "harness/fem/elements/physics.h"
#include "harness/fem/linear/linear_solver.h"
#include "harness/mesh/mesh_data.h"
#include "harness/mesh/sheet.h"
#include "harness/path/curve.h"
#include "harness/path/pick.h"

namespace cutbench {

/// A pin as written in the file.
struct ScenePin {
  std::optional<Point2> near;  ///< holds the vertex nearest to it; `pin.where` is then not yet known
  Pin pin;
};

struct Scene {
  struct Cut {
    double time = 0;     ///< s: made before the first step that ends after it
    double speed = 0;    ///< m/s at rest: of a blade that enters at `time` and cuts as it advances; 0: all at once
    Curve curve;         ///< in rest space, m; or a seeded case, see curves_of():
    PickedCurve picked;  ///< in world space, m, instead of the curve; no picks: in rest space
    std::string family;  ///< of cut_families(); empty: the curve
    std::uint64_t seed = 1;
    std::size_t index = 0;  ///< key `case`
  };
  std::string stem;    ///< of the file
  std::string effect;  ///< the one effect it shows
  std::string truth;   ///< what it is measured against

  std::string family = "grid";      ///< of sheet_families(), scaled to `size`; empty, and instead:
  std::filesystem::path mesh_file;  ///< a sheet read from a file, resolved against the scene's folder
  std::optional<MeshData> mesh;     ///< instead of both, given by the program
  double size = 1;                  ///< m: side of the square
  int resolution = 800;             ///< triangles; an experiment may ask for others

  Material material;
  Physics physics;
  /// m, rest space: from the first cut on, what is farther from all cuts stays where it is (harness/simulation/active_region.h).
  double active_radius = std::numeric_limits<double>::infinity();
  std::vector<ScenePin> pins;
  std::vector<Traction> tractions;

  Integrator integrator = Integrator::backward_euler;
  double step = 1.0 / 240;  ///< s
  int newton = 1;           ///< linear solves per step; equilibrium: at most
  int sweeps = 1;           ///< of xpbd, per step
  SolverOptions solver;
  double duration = 1;  ///< s
  std::vector<Cut> cuts;
};

/// Throws InputError: unreadable, not TOML, unknown keys (with the nearest known one), values out of range,
/// contradictions.
Scene read_scene(const std::filesystem::path& file);

/// The sheet before any cut. Throws InputError where its file is not one.
MeshData mesh_of(const Scene& scene);

/// The pins, those near a point as boxes without extent round the vertex nearest to it in rest space, and so round all
/// its copies on an incision. \pre `sheet` is not cut yet: a cut's own vertices may be nearer.
std::vector<Pin> pins_of(const Scene& scene, const Sheet& sheet);

/// Holds the rest vertices that are pinned, and those on the border that tractions pull at (Sheet::hold).
void hold_constrained_vertices(const std::vector<Pin>& pins, const std::vector<Traction>& tractions, Sheet& sheet);

/// One or more curves, made one after the other; a seeded case depends on the sheet before any cut (make_case). None
/// for a picked cut: it is not known before its time.
std::vector<Curve> curves_of(const Scene::Cut& cut, const Sheet& sheet);

}  // namespace cutbench
