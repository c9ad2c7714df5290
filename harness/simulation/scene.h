// A scene: a sheet, what it is made of, what holds it and pulls at it, how it is stepped and solved, and the cuts it
// gets. SI units; a file names the one effect it shows and its truth.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "harness/fem/elements/physics.h"
#include "harness/fem/linear/solver_options.h"
#include "harness/mesh/mesh_data.h"
#include "harness/mesh/sheet.h"
#include "harness/path/curve.h"
#include "harness/path/pick.h"

namespace cutbench {

/// A pin as written in the file.
struct ScenePin {
  std::optional<Point2> near;  ///< holds the vertex nearest to it; `pin.where` is then not yet known
  Pin pin;
  std::optional<std::array<Point3, 2>> in_space = {};  ///< the vertices that begin between these two corners, likewise
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

  std::string family = "grid";   ///< of sheet_families(), scaled to `size`
  std::string mesh_file;         ///< where `mesh` was read from a file: its name, resolved against the scene's folder
  std::optional<MeshData> mesh;  ///< instead of the family
  double size = 1;               ///< m: side of the square
  int resolution = 800;          ///< triangles; an experiment may ask for others

  Material material;
  Physics physics;
  /// m, rest space: from the first cut on, what is farther from all cuts stays where it is
  /// (harness/simulation/active_region.h).
  double active_radius = std::numeric_limits<double>::infinity();
  std::vector<ScenePin> pins;
  std::vector<Traction> tractions;

  Integrator integrator = Integrator::backward_euler;
  double step = 1.0 / 240;  ///< s
  int newton = 1;           ///< linear solves per step; equilibrium: at most
  int sweeps = 1;           ///< of xpbd and vbd, per step
  bool robust = false;      ///< StepOptions::robust
  SolverOptions solver;
  double duration = 1;  ///< s
  std::vector<Cut> cuts;
};

/// The sheet before any cut.
MeshData mesh_of(const Scene& scene);

/// The pins, those near a point as boxes without extent round the vertex nearest to it in rest space, and so round all
/// its copies on an incision; those in space as one such box for each vertex.
/// \pre `sheet` is not cut yet: a cut's own vertices may be nearer.
std::vector<Pin> pins_of(const Scene& scene, const Sheet& sheet);

bool holds_a_vertex(const std::vector<Pin>& pins, const Sheet& sheet);

/// The scene's pins, from 0, none of which holds a vertex: hardly meant.
std::vector<std::size_t> idle_pins(const Scene& scene, const Sheet& sheet);

/// \throw InputError  the sheet has seams, and what the scene asks for knows none: an integrator without constraints,
/// an active radius, or bending where the rest shape is curved
void check_scene_suits_seams(const Scene& scene, const Sheet& sheet);

/// Holds the rest vertices that are pinned, and those on the border that tractions pull at (Sheet::hold).
void hold_constrained_vertices(const std::vector<Pin>& pins, const std::vector<Traction>& tractions, Sheet& sheet);

/// One or more curves, made one after the other; a seeded case depends on the sheet before any cut (make_case). None
/// for a picked cut: it is not known before its time.
std::vector<Curve> curves_of(const Scene::Cut& cut, const Sheet& sheet);

}  // namespace cutbench
