#include "experiments/live/scene_json.h"

#include "experiments/live/divided_in_four.h"
#include "harness/base/errors.h"
#include "harness/mesh/check_and_repair.h"
#include "harness/mesh/mesh_text.h"

namespace cutbench::live {

using nlohmann::json;

namespace {

Point2 point2(const json& j) { return {j.at(0), j.at(1)}; }
Point3 point3(const json& j) { return {j.at(0), j.at(1), j.at(2)}; }

}  // namespace

Scene scene_of(const json& j) {
  Scene s;
  s.stem = "live";
  if (j.contains("obj")) {
    MeshData mesh = read_obj(j.at("obj").get<std::string>(), "the OBJ");
    const bool of_vt = !mesh.rest.empty();
    check_and_repair(mesh, "the OBJ", of_vt);
    s.mesh = mesh;
  } else {
    s.family = j.value("family", s.family);
    s.resolution = j.value("triangles", s.resolution);
    s.size = j.value("size", s.size);
  }
  if (j.value("refined", false)) s.mesh = divided_in_four(mesh_of(s));
  const json none = json::object();
  const json& material = j.contains("material") ? j.at("material") : none;
  s.material = {.density = material.value("density", 2.2),
                .stiffness = material.value("stiffness", 1000.0),
                .poisson = material.value("poisson", 0.45),
                .bending = material.value("bending", 4.2e-4),
                .mass_damping = material.value("mass_damping", 0.5),
                .stiffness_damping = material.value("stiffness_damping", 1e-3)};
  s.physics.bending = s.material.bending > 0 ? BendingKind::patches : BendingKind::none;
  s.physics.gravity = j.contains("gravity") ? point3(j.at("gravity")) : Point3{0, 0, -9.81};
  for (const json& pin : j.value("pins", json::array({{{"near", {0, 0}}}, {{"near", {1, 0}}}}))) {
    ScenePin made;
    if (pin.contains("near"))
      made.near = point2(pin.at("near"));
    else
      made.pin.where = {point2(pin.at("box").at(0)), point2(pin.at("box").at(1))};
    s.pins.push_back(made);
  }
  s.step = j.value("step", 1.0 / 240);
  s.solver = {.name = j.value("solver", std::string("multigrid")), .tolerance = j.value("tolerance", 1e-2)};
  return s;
}

Sheet sheet_of(const Scene& scene) {
  Sheet sheet(mesh_of(scene));
  hold_constrained_vertices(pins_of(scene, sheet), scene.tractions, sheet);
  return sheet;
}

}  // namespace cutbench::live
