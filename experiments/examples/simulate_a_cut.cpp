// A hanging sheet given as arrays is stepped in a loop of one's own, and cut between two steps. Links cutbench::fem.
#include <cutbench/methods/registry.h>
#include <cutbench/simulation/simulation.h>

#include <algorithm>
#include <cstdio>

using namespace cutbench;

namespace {

constexpr int side = 12;  // squares

/// A square of 1 m, with two triangles in each square.
MeshData square() {
  MeshData mesh;
  for (int j = 0; j <= side; ++j)
    for (int i = 0; i <= side; ++i) mesh.rest.push_back({1.0 * i / side, 1.0 * j / side});
  for (const Point2 p : mesh.rest) mesh.deformed.push_back({p.x, p.y, 0});
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const int corner = j * (side + 1) + i, above = corner + side + 1;
      mesh.triangles.push_back({corner, corner + 1, above + 1});
      mesh.triangles.push_back({corner, above + 1, above});
    }
  return mesh;
}

Scene hanging() {
  Scene scene;
  scene.mesh = square();
  scene.material = {.density = 0.3, .stiffness = 60, .poisson = 0.3, .bending = 1e-4, .mass_damping = 1};
  scene.physics.gravity = {0, -9.81, 0.5};
  scene.pins.push_back({.near = {}, .pin = {.where = {{-1, 1}, {2, 1}}}});  // the upper side: all that lies in this box
  scene.step = 1.0 / 240;
  return scene;
}

/// m, the lowest vertex where it is now.
double lowest(const Simulation& simulation) {
  double y = 1;
  for (const Point3& p : simulation.posed_sheet().to_mesh_data().deformed) y = std::min(y, p.y);
  return y;
}

}  // namespace

int main() {
  const auto simulation = Simulation::start(hanging());  // throws InputError
  const MethodRow& row = find_method("warp_and_refine");
  const auto method = row.make(row.parameter.value);  // the same one in all cuts of a simulation
  const Curve slit{Curve::Kind::polyline, false, {{0.2, 0.55}, {0.83, 0.5}}};  // m, on the sheet at rest
  for (int i = 0; i < 240; ++i) {
    if (i == 120) {
      const MotionCut cut = simulation->cut_now({&slit, 1}, *method);
      std::printf("cut: %s, %zu triangles\n", name_of(cut.verdict), simulation->sheet().triangle_count());
    }
    const StepReport report = simulation->step();
    if (report.verdict != Verdict::ok) {
      std::fprintf(stderr, "%s\n", report.reason.c_str());
      return 1;
    }
    if (i % 24 == 23)
      std::printf("%.1f s: lowest vertex at %.3f m, stretched by %.3f J\n", simulation->time(), lowest(*simulation),
                  simulation->balance().energy.membrane);
  }
  return 0;
}
