// Scene files: TOML.
//
//   effect = "..."     truth = "..."     duration = 1.0
//   [sheet]       family, size, resolution | file, scale (lengths of the file times this are m: 0.001 for mm),
//                 rest = "auto"|"vt"|"plane"|"space" (harness/mesh/rest_choice.h),
//                 sew = 0.001 (in the file's unit: vertices no farther apart in space are one: harness/mesh/sew.h),
//                 triangulate = false (true: faces of more than three corners are read, too)
//   [material]    density, stiffness, poisson, bending, mass_damping, stiffness_damping
//   [physics]     dimension = 2|3, plane = "stress"|"strain", strain = "corotational"|"linear"|"green"|"springs",
//                 stress_stiffness = "none"|"positive"|"full" (default: positive), bending = of bending_names,
//                 mass = "lumped"|"consistent"|"stabilised"|"scaled", mass_limit = 1 (of the last two: harness/fem/
//                 physics.h), gravity = [x, y, z],
//                 active_radius (m: from the first cut on, what is farther from all cuts in rest space stays where it
//                 is, and all but two rings of vertices of it are left out; pins there go on; what a method makes
//                 between vertices that stay is free)
//   [[pins]]      near = [x, y] | box = [[x0, y0], [x1, y1]]; with space = "world" instead the vertices that begin in
//                 box = [[x0, y0, z0], [x1, y1, z1]]; axes = "xyz", displacement, velocity = [x, y, z]
//   [[tractions]] box, force = [x, y, z]
//   [integrator]  name = "backward_euler"|"midpoint"|"symplectic_euler"|"xpbd"|"vbd"|"equilibrium", step, newton,
//                 robust (true: further solves where a step leaves more energy than it should; the default of
//                 backward_euler without "newton"),
//                 sweeps = 1 (of xpbd and vbd, per step; they use no [solver] and no stress_stiffness)
//   [solver]      name, tolerance, max_iterations
//   [[cuts]]      time; bezier | polyline = [[x, y], ...], closed = true, speed | family, seed, case
//                 path = "path.json", speed: all cuts of a path file, in the unit of the sheet's file (times scale)
//                 space = "world": the points are picked on the sheet as it is at that time (harness/path/pick.h), each
//                 [x, y, z], or a ray {origin = [x, y, z], direction = [x, y, z]}
//
// Omitted keys have the defaults below. In a 2D scene vectors may omit z. Boxes may be infinite.
#pragma once

#include <filesystem>
#include <string>

#include "harness/simulation/scene.h"

namespace cutbench {

/// Throws InputError: unreadable, not TOML, unknown keys (with the nearest known one), values out of range,
/// contradictions; and what read_mesh() refuses in a sheet from a file.
Scene read_scene(const std::filesystem::path& file);
/// The same from the text of such a file. \param name  begins every error; its stem is the scene's, and its folder that
/// which the sheet's file is relative to
Scene read_scene_text(const std::string& text, const std::filesystem::path& name);

}  // namespace cutbench
