// Scene files: what is written arrives, what makes no sense is refused in one line that says where and why.
#include "harness/scene/scene.h"

#include <unistd.h>

#include <fstream>
#include <set>

#include "harness/cases/cut_families.h"
#include "harness/run/experiment.h"
#include "methods/registry.h"
#include "tests/helpers.h"
#include "tests/mesh_checks.h"

namespace cutbench {
namespace {

namespace fs = std::filesystem;

const fs::path experiments = fs::path(CUTBENCH_TEST_CASES) / "../../experiments";

std::vector<fs::path> toml_files(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  return files;
}

class SceneFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& text) { std::ofstream(file_) << text; }
  /// A scene of these lines, with an effect and a truth.
  Scene read(const std::string& lines) {
    write("effect = \"e\"\ntruth = \"t\"\n" + lines);
    return read_scene(file_);
  }
  void expect_refused_text(const std::string& text, const std::string& part) {
    write(text);
    expect_refused([&] { read_scene(file_); }, part);
    EXPECT_EQ(error_of([&] { read_scene(file_); }).find(file_.string()), 0u) << "doesn't begin with the file";
  }

  fs::path folder_ = fs::temp_directory_path() / ("cutbench_scene_test" + std::to_string(getpid()));
  fs::path file_ = folder_ / "a.scene.toml";
};

TEST(Scenes, OfTheRepositoryAreRead) {
  const auto files = toml_files(experiments / "scenes");
  EXPECT_GE(files.size(), 3u);
  for (const auto& file : files) {
    const Scene scene = read_scene(file);
    EXPECT_EQ(scene.stem, file.stem());
    const Sheet sheet(mesh_of(scene));
    EXPECT_EQ(pins_of(scene, sheet).size(), scene.pins.size());
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
    EXPECT_FALSE(read_experiment(file).sheets.empty() && read_experiment(file).accuracy == std::nullopt);
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

TEST_F(SceneFile, MistypedKeysGetTheNearestOne) {
  for (const auto& [lines, suggestion] : {std::pair<const char*, const char*>{"durations = 1\n", "duration"},
                                          {"[sheets]\n", "sheet"},
                                          {"[sheet]\nresolutoin = 800\n", "resolution"},
                                          {"[material]\nyoung = 1\npoison = 0.3\n", "poisson"},
                                          {"[material]\nmass_dampening = 1\n", "mass_damping"},
                                          {"[physics]\ndimensions = 2\n", "dimension"},
                                          {"[[pins]]\nnear = [0, 0]\naxis = \"x\"\n", "axes"},
                                          {"[[tractions]]\nforces = [0, 0, 1]\n", "force"},
                                          {"[integrator]\nsteps = 1\n", "step"},
                                          {"[solver]\nmax_iteration = 1\n", "max_iterations"},
                                          {"[[cuts]]\nbezeir = []\n", "bezier"}})
    expect_refused_text("effect = \"e\"\ntruth = \"t\"\n" + std::string(lines),
                        "did you mean \"" + std::string(suggestion) + "\"?");
}

TEST_F(SceneFile, SaysWhatIsWrongWithTheFile) {
  expect_refused([] { read_scene("no_such_folder/scene.toml"); }, "no_such_folder/scene.toml: can't be read");
  expect_refused([&] { read_scene(folder_); }, "can't be read");
  expect_refused_text("effect = \"e\"\ntruth = \n", "line 2");
  expect_refused_text("", "\"effect\" is missing");
  expect_refused_text("effect = \"e\"\n", "\"truth\" is missing");
  expect_refused_text("effect = \"\"\ntruth = \"t\"\n", "\"effect\" is empty");
  expect_refused_text("effect = \"e\"\ntruth = \"\"\n", "\"truth\" is empty");
  expect_refused_text("effect = 3\ntruth = \"t\"\n", "\"effect\" has a value of the wrong kind");
}

TEST_F(SceneFile, SaysWhatIsWrongWithAValue) {
  const std::string pin = "[[pins]]\nnear = [0, 0]\n", cut = "[[cuts]]\npolyline = [[0, 0], [1, 1]]\n";
  const std::pair<std::string, const char*> bad[] = {
      {"duration = 0\n", ": \"duration\" must be positive"},
      {"duration = inf\n", "\"duration\" must be finite"},
      {"sheet = 3\n", "\"sheet\" must be a table, headed [sheet]"},
      {"pins = 3\n", "\"pins\" must be a list of tables, each headed [[pins]]"},
      {"pins = [3]\n", "\"pins\" must be a list of tables"},
      {"[pins]\nnear = [0, 0]\n", "headed [[pins]]"},
      {"[sheet]\nfamily = \"hexagons\"\n", ", [sheet]: sheet \"hexagons\" is not known; known are "},
      {"[sheet]\nfile = \"s.off\"\nsize = 1\n", "\"size\" does not go with \"file\""},
      {"[sheet]\nfile = \"none.off\"\n", "none.off; \"file\" is relative to the scene's folder"},
      {"[sheet]\nsize = -1\n", "\"size\" must be positive"},
      {"[sheet]\nresolution = 801\n", ", [sheet]: resolution 801: a sheet has 2 n^2 triangles"},
      {"[material]\ndensity = 0\n", ", [material]: \"density\" must be positive"},
      {"[material]\nstiffness = nan\n", "\"stiffness\" must be finite"},
      {"[material]\nstiffness = \"1\"\n", "\"stiffness\" has a value of the wrong kind"},
      {"[material]\npoisson = 1\n", "between -1 and 1 (plane stress)"},
      {"[material]\npoisson = 0.5\n[physics]\nplane = \"strain\"\n", "between -1 and 0.5 (plane strain)"},
      {"[material]\nbending = -1\n", "\"bending\" must be positive, or 0"},
      {"[material]\nmass_damping = -1\n", "\"mass_damping\" must be positive, or 0"},
      {"[physics]\ndimension = 4\n", "\"dimension\" is 2 (in the plane) or 3"},
      {"[physics]\nplane = \"stretch\"\n", "plane \"stretch\" is not known; known are stress, strain"},
      {"[physics]\nstress_stiffness = \"half\"\n", "stress_stiffness \"half\" is not known; known are full, "},
      {"[physics]\nstrain = \"linear\"\nstress_stiffness = \"full\"\n", "linear strain has no stiffness from stress"},
      {"[physics]\nstrain = \"springs\"\nmass = \"scaled\"\n", "made for triangles, not for springs"},
      {"[physics]\nmass = 1\n", "\"mass\" has a value of the wrong kind"},
      {"[physics]\ngravity = -9.81\n", "\"gravity\" must be a list"},
      {"[physics]\ngravity = [0, -9.81]\n", "\"gravity\" is [x, y, z]"},
      {"[physics]\ngravity = [0, 0, \"g\"]\n", "\"gravity\" has an entry of the wrong kind"},
      {"[physics]\ngravity = [0, 0, inf]\n", "\"gravity\" must be finite"},
      {"[[pins]]\n", ", pin 0: give either \"near\" = [x, y] or \"box\""},
      {pin + "box = [[0, 0], [1, 1]]\n", "give either"},
      {pin + "[[pins]]\nnear = [0, 0, 0]\n", ", pin 1: \"near\" is a point [x, y]"},
      {"[[pins]]\nbox = [[1, 0], [0, 1]]\n", "with x0 <= x1 and y0 <= y1"},
      {"[[pins]]\nbox = [[0, 0], [1, nan]]\n", "with x0 <= x1 and y0 <= y1"},
      {"[[pins]]\nbox = [[0, 0, 0], [1, 1, 1]]\n", "\"box\" is a list of points, each [x, y]"},
      {pin + "axes = \"xw\"\n", "\"axes\" is \"xw\"; give each of \"xyz\" that is held once"},
      {pin + "axes = \"xx\"\n", "held once"},
      {pin + "axes = \"\"\n", "\"axes\" is empty"},
      {"[[tractions]]\n", ", traction 0: \"force\" is missing"},
      {"[integrator]\nname = \"euler\"\n", "name \"euler\" is not known; known are "},
      {"[integrator]\nstep = 0\n", ", [integrator]: \"step\" must be positive"},
      {"[integrator]\nnewton = 0\n", "\"newton\" must be between 1 and"},
      {"[solver]\nname = \"magic\"\n", ", [solver]: solver \"magic\" is not known; known are cg, "},
      {"[solver]\ntolerance = 0\n", "\"tolerance\" must be positive"},
      {"[solver]\ntolerance = 1\n", "\"tolerance\" must be below 1"},
      {"[solver]\nmax_iterations = 2.5\n", "\"max_iterations\" has a value of the wrong kind"},
      {"[[cuts]]\n", ", cut 0: give either \"bezier\", \"polyline\" or \"family\""},
      {cut + "family = \"curved\"\n", "give either"},
      {cut + "seed = 1\n", "\"seed\" does not go with a curve"},
      {cut + "time = -1\n", "\"time\" must be positive, or 0"},
      {"[[cuts]]\nfamily = \"curved\"\nclosed = true\n", "\"closed\" does not go with \"family\""},
      {"[[cuts]]\nfamily = \"wavy\"\n", ", cut 0: cut family \"wavy\" is not known; known are "},
      {"[[cuts]]\nfamily = \"curved\"\ncase = -1\n", "\"case\" must be positive, or 0"},
      {"[[cuts]]\npolyline = [[0, 0]]\n", ", cut 0: a polyline needs at least 2 points"},
      {"[[cuts]]\npolyline = [[0, 0], [1, inf]]\n", "must be finite and below 1e60"},
      {"[[cuts]]\npolyline = [0, 0, 1, 1]\n", "\"polyline\" is a list of points, each [x, y]"},
      {"[[cuts]]\nbezier = [[0, 0], [1, 1]]\n", "4, 7, 10"},
      {"[[cuts]]\nspace = \"screen\"\npolyline = [[0, 0], [1, 1]]\n", "space \"screen\" is not known"},
      {"[[cuts]]\nspace = \"world\"\npolyline = [[0, 0], [1, 1]]\n", "point 0 in world space is [x, y, z]"},
      {"[[cuts]]\nspace = \"world\"\npolyline = [[0, 0, 0], {origin = [1, 1, 1]}]\n",
       "point 1: \"direction\" is [x, y, z]"},
      {"[[cuts]]\nspace = \"world\"\npolyline = [[0, 0, 0], {origin = [1, 1, 1], direction = [0, 0, 0]}]\n",
       ", cut 0, point 1: the direction is zero"},
      {"[[cuts]]\nspace = \"world\"\nbezier = [[0, 0, 0], [1, 1, 1]]\n", "4, 7, 10"},
      {cut + "speed = 0\n", "\"speed\" must be positive"},
      {"[[cuts]]\nfamily = \"curved\"\nspeed = 1\n", "\"speed\" does not go with \"family\""},
      {"[[cuts]]\nspace = \"world\"\nfamily = \"curved\"\n", "\"space\" does not go with \"family\""},
  };
  for (const auto& [lines, what] : bad) expect_refused_text("effect = \"e\"\ntruth = \"t\"\n" + lines, what);
}

TEST_F(SceneFile, SaysWhatContradictsItself) {
  const std::string flat = "[physics]\ndimension = 2\n", pin = "[[pins]]\nnear = [0, 0]\n",
                    equilibrium = "[integrator]\nname = \"equilibrium\"\nnewton = 9\n",
                    cut = "[[cuts]]\npolyline = [[0, 0], [1, 1]]\n";
  const std::pair<std::string, const char*> bad[] = {
      {flat + "bending = \"patches\"\n[material]\nbending = 1\n", ", [physics]: a 2D scene does not bend"},
      {"[physics]\nbending = \"hinges\"\n", ", [material]: [physics] asks for bending"},
      {flat + "gravity = [0, 0, -9.81]\n", "\"gravity\" leaves the plane of a 2D scene"},
      {flat + pin + "axes = \"xyz\"\n", "give each of \"xy\""},
      {flat + pin + "displacement = [0, 0, 1]\n", ", pin 0: \"displacement\" leaves the plane"},
      {flat + "[[tractions]]\nforce = [0, 0, 1]\n", ", traction 0: \"force\" leaves the plane"},
      {"[physics]\nmass = \"consistent\"\n[integrator]\nname = \"symplectic_euler\"\n", "needs mass = \"lumped\""},
      {"[physics]\nmass_limit = 2\n", "\"mass_limit\" is for mass = \"stabilised\" or \"scaled\""},
      {"[physics]\nmass = \"scaled\"\nmass_limit = 0.5\n", "\"mass_limit\" must be 1 or more"},
      {"[integrator]\nname = \"symplectic_euler\"\nnewton = 1\n", "\"newton\" does not go with symplectic_euler"},
      {"[integrator]\nname = \"xpbd\"\nnewton = 1\n", "\"newton\" does not go with xpbd"},
      {"[integrator]\nsweeps = 2\n", "\"sweeps\" does not go with an integrator other than xpbd"},
      {"[physics]\nmass = \"stabilised\"\n[integrator]\nname = \"xpbd\"\n", "needs mass = \"lumped\""},
      {"[integrator]\nname = \"equilibrium\"\n", "equilibrium needs \"newton\""},
      {equilibrium + "step = 1\n", "\"step\" does not go with equilibrium"},
      {"duration = 1\n" + equilibrium, "\"duration\" does not go with equilibrium"},
      {equilibrium + cut + "time = 0.5\n", ", cut 0: equilibrium takes no time"},
      {equilibrium + pin + "velocity = [1, 0, 0]\n", ", pin 0: equilibrium takes no time"},
      {equilibrium + "[physics]\ngravity = [0, 0, -9.81]\n", "add [[pins]]"},
      {"duration = 0.001\n", "the first step ends after the duration"},
      {cut + "time = 1\n", ", cut 0: no step follows it"},
      {equilibrium + cut + "speed = 2\n", ", cut 0: equilibrium takes no time, so no blade has"},
      {cut + "time = 0.5\nspeed = 2\n", ", cut 0: the blade arrives at 1.207 s, after the end"},
      {cut + "time = 0.5\n" + cut + "time = 0.4\n", ", cut 1: its \"time\" is before that of the cut above"},
  };
  for (const auto& [lines, what] : bad) expect_refused_text("effect = \"e\"\ntruth = \"t\"\n" + lines, what);
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
    Table table(mesh_of(s), row, row.knob.value);
    ASSERT_EQ(table.cut({Curve::Kind::polyline, false, {{1, 0}, {1.23, 2.1}}}, 0.05), "");
    EXPECT_EQ(held(table.sheet, pins[0]).size(), 1u);
    EXPECT_EQ(held(table.sheet, pins[1]), (std::vector<Point2>{{1, 0}, {1, 0}})) << row.name;
    const auto in_the_box = held(table.sheet, pins[2]);  // also vertices that a method put in between
    EXPECT_EQ(in_the_box.size(), distinct(in_the_box) + 1) << row.name;
  }
}

}  // namespace
}  // namespace cutbench
