// Scene files: what is written arrives.
#include "harness/simulation/scene.h"

#include <cstdlib>
#include <fstream>
#include <set>

#include "harness/cases/cut_families.h"
#include "harness/scenes/scene_file.h"
#include "harness/study/experiment.h"
#include "methods/registry.h"
#include "tests/helpers.h"
#include "tests/scene_file.h"

namespace cutbench {
namespace {

const fs::path experiments = fs::path(CUTBENCH_TEST_CASES) / "../../experiments";

std::vector<fs::path> toml_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  return files;
}

TEST(Scenes, OfTheRepositoryAreRead) {
  ASSERT_EQ(std::system(("python3 " + (experiments / "scenes/meshes/make.py").string()).c_str()),
            0);  // for three of them
  const auto files = toml_files(experiments / "scenes");
  EXPECT_GE(files.size(), 3u);
  for (const auto& file : files) {
    const Scene scene = read_scene(file);
    EXPECT_EQ(scene.stem, file.stem());
    const Sheet sheet(mesh_of(scene));
    const bool in_space = !scene.pins.empty() && scene.pins.front().in_space;  // a pin for each vertex there
    if (in_space)
      EXPECT_GT(pins_of(scene, sheet).size(), scene.pins.size());
    else
      EXPECT_EQ(pins_of(scene, sheet).size(), scene.pins.size());
    EXPECT_TRUE(idle_pins(scene, sheet).empty());
    for (const auto& cut : scene.cuts) EXPECT_NE(curves_of(cut, sheet).empty(), cut.picked.picks.empty());
  }
}

TEST(Scenes, ThePapersIsThatOfTheDesign) {
  const Scene s = read_scene(experiments / "scenes/paper_table1.toml");
  EXPECT_EQ(s.family, "grid");
  EXPECT_EQ(s.size, 1);
  EXPECT_EQ(s.resolution, 800);
  EXPECT_EQ(s.material.density, 2.2);
  EXPECT_EQ(s.material.stiffness, 1000);
  EXPECT_EQ(s.material.poisson, 0.45);
  EXPECT_EQ(s.material.bending, 4.2e-4);
  EXPECT_EQ(s.material.mass_damping, 0.5);
  EXPECT_EQ(s.material.stiffness_damping, 1e-3);
  EXPECT_EQ(s.physics.dimension, 3);
  EXPECT_EQ(s.physics.bending, BendingKind::patches);
  EXPECT_EQ(s.physics.gravity, (Point3{0, 0, -9.81}));
  EXPECT_EQ(s.integrator, Integrator::backward_euler);
  EXPECT_EQ(s.step, 1.0 / 240);
  EXPECT_EQ(s.newton, 1);
  EXPECT_EQ(s.solver.name, "cg");
  EXPECT_EQ(s.solver.tolerance, 1e-2);
  EXPECT_GT(s.duration, 0.5);  // where its cuts come
  EXPECT_TRUE(s.cuts.empty());
  const auto pins = pins_of(s, Sheet(mesh_of(s)));
  ASSERT_EQ(pins.size(), 2u);
  EXPECT_EQ(pins[0].where.low, (Point2{0, 0}));
  EXPECT_EQ(pins[1].where.low, (Point2{1, 0}));
}

TEST(Scenes, TheSlitStripsClampHoldsTwoColumns) {
  const Scene s = read_scene(experiments / "scenes/slit_strip.toml");
  const Sheet sheet(mesh_of(s));
  const auto pins = pins_of(s, sheet);
  int held = 0;
  for (std::size_t v = 0; v < sheet.vertex_slots(); ++v) held += pins.at(0).where.contains(sheet.rest(VertexIndex(v)));
  EXPECT_EQ(held, 2 * 21);
}

TEST(Experiments, OfTheRepositoryAreRead) {
  const auto files = toml_files(experiments);
  EXPECT_GE(files.size(), 3u);
  for (const auto& file : files) {
    if (fs::exists(fs::path(file).replace_extension())) continue;  // it belongs to the script of that name
    if (file.stem() == "recommend_calibration") continue;          // of `cutbench recommend`
    if (file.stem() == "tracked") continue;                        // of experiments/track
    EXPECT_FALSE(read_experiment(file).sheets.empty());
  }
}

TEST_F(SceneFile, DefaultsAreThoseOfTheStruct) {
  const Scene s = read(""), d;
  EXPECT_EQ(s.stem + s.effect + s.truth, "a.sceneet");
  EXPECT_EQ(s.family, d.family);
  EXPECT_EQ(s.resolution, d.resolution);
  EXPECT_EQ(s.material.density, d.material.density);
  EXPECT_EQ(s.physics.strain, d.physics.strain);
  EXPECT_EQ(s.physics.gravity, Point3{});
  EXPECT_EQ(s.active_radius, infinite);
  EXPECT_EQ(s.step, d.step);
  EXPECT_EQ(s.duration, d.duration);
  EXPECT_EQ(s.solver.tolerance, d.solver.tolerance);
  EXPECT_TRUE(s.pins.empty() && s.tractions.empty() && s.cuts.empty());
}

TEST_F(SceneFile, EveryFieldArrives) {
  const Scene s = read(R"(
duration = 2.5
[sheet]
family = "graded"
size = 0.3
resolution = 200
[material]
density = 2
stiffness = 3
poisson = 0.25
bending = 4
mass_damping = 5
stiffness_damping = 6
[physics]
dimension = 3
plane = "strain"
strain = "linear"
bending = "hinges"
mass = "consistent"
gravity = [1, 2.5, -3]
active_radius = 0.4
[[pins]]
near = [0.1, 0.2]
axes = "zx"
displacement = [1, 2, 3]
velocity = [4, 5, 6]
[[pins]]
box = [[-inf, 0.1], [0.2, inf]]
[[tractions]]
force = [7, 8, 9]
[[tractions]]
box = [[0, 0], [0, 1]]
force = [0, 0, 0]
[integrator]
name = "midpoint"
step = 0.01
newton = 3
[solver]
name = "cholmod"
tolerance = 1e-5
max_iterations = 77
[[cuts]]
polyline = [[0, 0], [1, 1], [1, 0]]
closed = true
[[cuts]]
time = 0.5
speed = 1.25
bezier = [[0, 0], [1, 1], [1, 0], [2, 0.5]]
[[cuts]]
time = 1.5
family = "curved"
seed = 7
case = 12
)");
  EXPECT_EQ(s.duration, 2.5);
  EXPECT_EQ(s.family, "graded");
  EXPECT_EQ(s.size, 0.3);
  EXPECT_EQ(s.resolution, 200);
  EXPECT_TRUE(s.mesh_file.empty());
  EXPECT_EQ(s.material.density, 2);
  EXPECT_EQ(s.material.stiffness, 3);
  EXPECT_EQ(s.material.poisson, 0.25);
  EXPECT_EQ(s.material.bending, 4);
  EXPECT_EQ(s.material.mass_damping, 5);
  EXPECT_EQ(s.material.stiffness_damping, 6);
  EXPECT_EQ(s.physics.dimension, 3);
  EXPECT_EQ(s.physics.plane, Plane::strain);
  EXPECT_EQ(s.physics.strain, Strain::linear);
  EXPECT_EQ(s.physics.bending, BendingKind::hinges);
  EXPECT_EQ(s.physics.mass, Mass::consistent);
  EXPECT_EQ(s.physics.gravity, (Point3{1, 2.5, -3}));
  EXPECT_EQ(s.active_radius, 0.4);
  ASSERT_EQ(s.pins.size(), 2u);
  EXPECT_EQ(s.pins[0].near, (Point2{0.1, 0.2}));
  EXPECT_EQ(s.pins[0].pin.axes, (std::array{true, false, true}));
  EXPECT_EQ(s.pins[0].pin.displacement, (Point3{1, 2, 3}));
  EXPECT_EQ(s.pins[0].pin.velocity, (Point3{4, 5, 6}));
  EXPECT_FALSE(s.pins[1].near);
  EXPECT_EQ(s.pins[1].pin.where.low, (Point2{-infinite, 0.1}));
  EXPECT_EQ(s.pins[1].pin.where.high, (Point2{0.2, infinite}));
  EXPECT_EQ(s.pins[1].pin.axes, (std::array{true, true, true}));
  ASSERT_EQ(s.tractions.size(), 2u);
  EXPECT_EQ(s.tractions[0].where.low, (Point2{-infinite, -infinite}));
  EXPECT_EQ(s.tractions[0].force, (Point3{7, 8, 9}));
  EXPECT_EQ(s.tractions[1].where.high, (Point2{0, 1}));
  EXPECT_EQ(s.integrator, Integrator::midpoint);
  EXPECT_EQ(s.step, 0.01);
  EXPECT_EQ(s.newton, 3);
  EXPECT_EQ(s.solver.name, "cholmod");
  EXPECT_EQ(s.solver.tolerance, 1e-5);
  EXPECT_EQ(s.solver.max_iterations, 77);
  ASSERT_EQ(s.cuts.size(), 3u);
  EXPECT_EQ(s.cuts[0].time, 0);
  EXPECT_EQ(s.cuts[0].curve.kind, Curve::Kind::polyline);
  EXPECT_TRUE(s.cuts[0].curve.closed);
  EXPECT_EQ(s.cuts[0].curve.points, (std::vector<Point2>{{0, 0}, {1, 1}, {1, 0}}));
  EXPECT_EQ(s.cuts[0].speed, 0);
  EXPECT_EQ(s.cuts[1].time, 0.5);
  EXPECT_EQ(s.cuts[1].speed, 1.25);
  EXPECT_EQ(s.cuts[1].curve.kind, Curve::Kind::bezier);
  EXPECT_FALSE(s.cuts[1].curve.closed);
  EXPECT_EQ(s.cuts[1].curve.points.size(), 4u);
  EXPECT_EQ(s.cuts[2].family, "curved");
  EXPECT_EQ(s.cuts[2].seed, 7u);
  EXPECT_EQ(s.cuts[2].index, 12u);
}

TEST_F(SceneFile, InThePlaneVectorsHaveTwoComponents) {
  const Scene s = read(
      "[physics]\ndimension = 2\ngravity = [0, -9.81]\n[[pins]]\nnear = [0, 0]\n"
      "[[tractions]]\nforce = [1, 2, 0]\n");
  EXPECT_EQ(s.physics.gravity, (Point3{0, -9.81, 0}));
  EXPECT_EQ(s.pins.at(0).pin.axes, (std::array{true, true, false}));
  EXPECT_EQ(s.tractions.at(0).force, (Point3{1, 2, 0}));
}

TEST_F(SceneFile, ReadsASheetBesideIt) {
  std::ofstream(folder_ / "sheet.off") << "OFF\n4 2 0\n0 0 0\n2 0 0\n2 3 0\n0 3 0\n3 0 1 2\n3 0 2 3\n";
  const Scene s = read("[sheet]\nfile = \"sheet.off\"\n");
  EXPECT_TRUE(s.family.empty());
  EXPECT_EQ(mesh_of(s).rest.at(2), (Point2{2, 3}));
}

TEST_F(SceneFile, SizeScalesTheSheet) {
  const MeshData mesh = mesh_of(read("[sheet]\nfamily = \"delaunay\"\nsize = 0.3\nresolution = 200\n"));
  EXPECT_EQ(mesh.triangles.size(), 200u);
  Point2 high;
  for (std::size_t v = 0; v < mesh.rest.size(); ++v) {
    high = {std::max(high.x, mesh.rest[v].x), std::max(high.y, mesh.rest[v].y)};
    EXPECT_EQ(mesh.deformed[v], (Point3{mesh.rest[v].x, mesh.rest[v].y, 0}));
  }
  EXPECT_EQ(high, (Point2{0.3, 0.3}));
}

TEST_F(SceneFile, SeededCutsAreThoseOfTheFamilies) {
  const Scene s = read("[[cuts]]\nfamily = \"recut\"\nseed = 3\ncase = 2\n");
  const Sheet sheet(mesh_of(s));
  const auto curves = curves_of(s.cuts.at(0), sheet), expected = make_case("recut", 3, 2, sheet);
  ASSERT_EQ(curves.size(), expected.size());
  for (std::size_t i = 0; i < curves.size(); ++i) EXPECT_EQ(curves[i].points, expected[i].points);
}

/// Rest places of the deformed vertices that a pin holds.
std::vector<Point2> held(const Sheet& sheet, const Pin& pin) {
  std::vector<Point2> places;
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d) {
    const VertexIndex v = sheet.rest_vertex(DeformedIndex(d));
    if (v.valid() && pin.where.contains(sheet.rest(v))) places.push_back(sheet.rest(v));
  }
  return places;
}

std::size_t distinct(const std::vector<Point2>& places) {
  std::set<std::pair<double, double>> known;
  for (Point2 p : places) known.emplace(p.x, p.y);
  return known.size();
}

TEST_F(SceneFile, PinsThatHoldNothingAreFound) {
  const Scene s = read(
      "[sheet]\nresolution = 200\n[[pins]]\nbox = [[0, 1], [1, 1]]\n[[pins]]\nbox = [[0.01, 0.01], [0.09, 0.09]]\n"
      "[[pins]]\nnear = [7, 7]\n[[pins]]\nbox = [[0, 0, 0.1], [1, 1, 0.2]]\nspace = \"world\"\n");
  EXPECT_EQ(idle_pins(s, Sheet(mesh_of(s))), (std::vector<std::size_t>{1, 3}));
}

TEST_F(SceneFile, PinsHoldTheNearestVertexAndAllItsCopies) {
  const Scene s = read(
      "[sheet]\nresolution = 200\nsize = 2\n[[pins]]\nnear = [-5, 9]\n[[pins]]\nnear = [1.05, 0.02]\n"
      "[[pins]]\nbox = [[-inf, 0], [inf, 0]]\n");
  const Sheet sheet(mesh_of(s));
  const auto pins = pins_of(s, sheet);
  ASSERT_EQ(pins.size(), 3u);
  EXPECT_EQ(held(sheet, pins[0]), (std::vector<Point2>{{0, 2}}));
  EXPECT_EQ(held(sheet, pins[1]), (std::vector<Point2>{{1, 0}}));
  EXPECT_EQ(held(sheet, pins[2]).size(), 11u);
  for (const MethodRow& row : whole_sheet_methods()) {  // from the second pin to the upper border
    Table table(mesh_of(s), row, row.parameter.value);
    ASSERT_EQ(table.cut({Curve::Kind::polyline, false, {{1, 0}, {1.23, 2.1}}}, 0.05), "");
    EXPECT_EQ(held(table.sheet, pins[0]).size(), 1u);
    EXPECT_EQ(held(table.sheet, pins[1]), (std::vector<Point2>{{1, 0}, {1, 0}})) << row.name;
    const auto in_the_box = held(table.sheet, pins[2]);  // also vertices that a method put in between
    EXPECT_EQ(in_the_box.size(), distinct(in_the_box) + 1) << row.name;
  }
}

}  // namespace
}  // namespace cutbench
