// Scene files: what makes no sense is refused in one line that says where and why.
#include <string>
#include <utility>

#include "harness/scenes/scene_file.h"
#include "tests/mesh_checks.h"
#include "tests/scene_file.h"

namespace cutbench {
namespace {

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
      {"[[cuts]]\n", ", cut 0: give either \"bezier\", \"polyline\", \"path\" or \"family\""},
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
      {"[physics]\nactive_radius = 0\n" + cut, "\"active_radius\" must be positive"},
      {"[physics]\nactive_radius = 0.1\n", "\"active_radius\" is that round cuts; add [[cuts]]"},
      {"[physics]\nactive_radius = 0.1\n" + equilibrium + cut, "in equilibrium nothing has moved before the cut"},
      {"[physics]\nactive_radius = 0.1\n[[cuts]]\nspace = \"world\"\npolyline = [[0, 0, 0], [1, 1, 0]]\n",
       "give them with space = \"rest\""},
      {"[physics]\nmass_limit = 2\n", "\"mass_limit\" is for mass = \"stabilised\" or \"scaled\""},
      {"[physics]\nmass = \"scaled\"\nmass_limit = 0.5\n", "\"mass_limit\" must be 1 or more"},
      {"[integrator]\nname = \"symplectic_euler\"\nnewton = 1\n", "\"newton\" does not go with symplectic_euler"},
      {"[integrator]\nname = \"xpbd\"\nnewton = 1\n", "\"newton\" does not go with xpbd"},
      {"[integrator]\nsweeps = 2\n", "\"sweeps\" does not go with an integrator other than xpbd and vbd"},
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

}  // namespace
}  // namespace cutbench
