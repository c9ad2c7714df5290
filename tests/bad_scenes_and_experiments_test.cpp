// Bad input in files of scenes and experiments, and what only the cut or the run finds out.
#include "harness/files/mesh_file.h"
#include "harness/mesh/families.h"
#include "harness/records/context.h"
#include "harness/study/experiment.h"
#include "tests/bad_input.h"
#include "tests/mesh_checks.h"

namespace cutbench {
namespace {

std::string scene_of(const std::string& more) {
  return "effect = \"e\"\ntruth = \"t\"\nduration = 0.1\n[integrator]\nstep = 0.01\n" + more;
}

/// What only the cut or the run finds out.
TEST_F(BadInput, MethodsThatDoNotFit) {
  write_mesh(make_sheet("delaunay", 4), folder_ / "irregular.off");
  expect({"cut --method cisamr --mesh irregular.off --path path.json --out out.obj", 2, "cisamr refuses this cut: "});
  write(folder_ / "of_a_file.toml", scene_of("[sheet]\nfile = \"sheet.off\"\n"));
  expect({"simulate of_a_file.toml --resolution 200", 2, "this scene's sheet is given; leave the option out"});

  // In a scene the sheet goes on moving without that cut; the program says so, and that it fell short.
  const std::string cut = "[[cuts]]\ntime = 0\npolyline = [[0.2, 0.3], [0.8, 0.6]]\n[sheet]\nresolution = 200\n";
  write(folder_ / "explicit.toml", scene_of("name = \"symplectic_euler\"\n" + cut));
  write(folder_ / "sweeps.toml", scene_of("name = \"xpbd\"\n" + cut));
  write(folder_ / "bent.toml",
        scene_of(cut + "[material]\nbending = 1e-4\n[physics]\nbending = \"patches\"\nmass = \"stabilised\"\n"));
  for (const auto& [arguments, message] :
       {std::pair{"explicit.toml --method split_and_tie", "symplectic_euler does not take"},
        std::pair{"sweeps.toml --method cut_polygons", "xpbd does not take"},
        std::pair{"bent.toml --method phantom_node", "take no added mass for bending; set mass to lumped"}}) {
    const Result result = run(std::string("simulate ") + arguments);
    EXPECT_EQ(result.code, 1) << result.error;
    EXPECT_NE(result.out.find("cut: refused"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find(message), std::string::npos) << result.out;
  }
}

TEST_F(BadInput, ASceneThatFailsBeforeItsCut) {
  write(folder_ / "stalls.toml", scene_of("[sheet]\nresolution = 200\n[physics]\ngravity = [0.0, 1.0, 0.0]\n"
                                          "[solver]\ntolerance = 1e-15\nmax_iterations = 1\n"));
  write(folder_ / "e.toml", small_experiment("scene = \"stalls.toml\"\ncut_time = 0.05\n"));
  const Result result = run("run e.toml --out r");
  EXPECT_EQ(result.code, 2) << result.error;
  EXPECT_NE(result.error.find("stalls: the scene fails before its cut (solver_stalled"), std::string::npos)
      << result.error;
}

/// One linear solve per step, far too long for a sheet as stiff as that.
TEST_F(BadInput, ASceneThatGainsEnergy) {
  write(folder_ / "gains.toml",
        "effect = \"e\"\ntruth = \"t\"\nduration = 1.0\n[integrator]\nstep = 0.04\n"
        "[sheet]\nresolution = 200\n[material]\nstiffness = 1e5\ndensity = 0.2\n"
        "[solver]\nname = \"cholmod\"\n[physics]\ngravity = [0.0, 0.0, -10.0]\n"
        "[[pins]]\nbox = [[-inf, -inf], [0.0, inf]]\n");
  for (const std::string more : {"", " --frames f"}) {
    const Result result = run("simulate gains.toml" + more);
    EXPECT_EQ(result.code, 1) << result.error;
    EXPECT_NE(result.out.find("energy_growth at "), std::string::npos) << result.out;
  }
}

TEST(Context, ASeedOfTheCommitWantsACommit) {
  expect_refused([] { seed_of_commit({}); }, "neither .git nor an archived commit number; give a number instead");
}

TEST_F(BadInput, Experiments) {
  const auto experiment = [this](const std::string& text) {
    write(folder_ / "e.toml", text);
    const std::string what = error_of([&] { read_experiment(folder_ / "e.toml"); });
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    return what;
  };
  const std::string text = small_experiment();
  const auto with = [&](const std::string& part, const std::string& instead) {
    std::string changed = text;
    return changed.replace(changed.find(part), part.size(), instead);
  };
  ASSERT_EQ(experiment(text), "no InputError");
  ASSERT_EQ(experiment(text + "eigenvalue_cases = 0\n"), "no InputError");  // the default
  const std::string head = "claim = \"c\"\nsheets = [\"grid\"]\nresolutions = [200]\nmethods = [\"example\"]\n";
  const std::string robustness = head + "[robustness]\n", accuracy = head + "[accuracy]\n";
  ASSERT_EQ(experiment(robustness), "no InputError");
  ASSERT_EQ(experiment(accuracy + "direct = [\"cholmod\"]\nmembers = [1]\n"), "no InputError");
  write(folder_ / "of_a_file.toml", scene_of("[sheet]\nfile = \"sheet.off\"\n"));
  write(folder_ / "of_a_family.toml", scene_of("[sheet]\nresolution = 200\n"));
  write(folder_ / "of_a_part.toml",
        scene_of("[sheet]\nresolution = 200\n[physics]\nactive_radius = 0.1\n[[cuts]]\npolyline = [[0, 0], [1, 1]]\n"));
  std::string deep = "claim = ";
  for (int i = 0; i < 1000000; ++i) deep += '[';
  for (const auto& [bad, message] : std::vector<std::pair<std::string, const char*>>{
           {"claim = 3\n" + text.substr(text.find('\n') + 1), "\"claim\" has a value of the wrong kind"},
           {text + "claim = \"again\"\n", "line"},
           {with("[200]", "200"), "\"resolutions\" must be a list"},
           {with("[200]", "[]"), "\"resolutions\" must be a list with at least one entry"},
           {with("[200]", "[\"200\"]"), "\"resolutions\" has an entry of the wrong kind"},
           {with("[200]", "[200, 200]"), "\"resolutions\" names something twice"},
           {with("[200]", "[-200]"), "resolution -200: a sheet has 2 n^2 triangles"},
           {with("[200]", "[0]"), "resolution 0"},
           {with("[200]", "[4294967496]"), "resolution 4294967496"},
           {with("[200]", "[2000000]"), "at most 1000000"},
           {with("\"grid\", \"delaunay\"", "\"grid\", \"grid\""), "\"sheets\" names something twice"},
           {with("\"grid\"", "\"gird\""), "sheet \"gird\" is not known; known are"},
           {with("\"curved\"", "\"curvy\""), "cut family \"curvy\" is not known; known are"},
           {with("\"curved\"", "\"recut\""), "\"cut_families\" names something twice"},
           {text + "eigenvalue_cases = -1\n", "\"eigenvalue_cases\" must be between 0 and 1000000"},
           {with("cases = 3", "cases = 0"), "\"cases\" must be between 1 and 1000000"},
           {with("cases = 3", "cases = 3.5"), "\"cases\" has a value of the wrong kind"},
           {with("cases = 3", "cases = 99999999999999999999"), "line 5"},
           {with("parameter = [0, 1]", "parameters = [0, 1]"), "did you mean \"parameter\""},
           {with("parameter = [0, 1]", "parameter = 1"), "\"parameter\" must be a list"},
           {with("name = ", "name = 1, nam = "), "unknown key \"nam\""},
           {with("\"conventional_split\"", "3"),
            "an entry of \"methods\" is a name, {name = ..., parameter = [...]} or {name = ..., command = ...}"},
           {text + "scene = \"none.toml\"\ncut_time = 0\n", "none.toml: can't be read"},
           {text + "scene = \"of_a_file.toml\"\ncut_time = 0\n", "\"scene\" has a sheet from a file"},
           {text + "scene = \"of_a_part.toml\"\ncut_time = 0\n",
            "\"active_radius\" is that round the scene's own cuts"},
           {text + "scene = \"of_a_family.toml\"\ncut_time = 0.1\n", "\"cut_time\" must lie within the scene's"},
           {robustness + "mesh_files = [\"none.off\"]\n", "there is no file"},
           {accuracy + "direct = [\"gauss\"]\nmembers = [1]\n", "solver \"gauss\" is not known"},
           {accuracy + "problems = [\"none\"]\ndirect = [\"cholmod\"]\nmembers = [1]\n", "none"},
           {accuracy + "direct = [\"cholmod\"]\nmembers = [1, 2]\n", "\"members\" must be as many numbers as"},
           {accuracy + "direct = [\"cholmod\"]\nmembers = [0]\n", "\"members\" are whole numbers from 1 to"},
           {accuracy + "direct = [\"cholmod\"]\npreconditioners = [\"cg\"]\niterations = [0]\nmembers = [1]\n",
            "\"iterations\" are whole numbers from 1 to 1000000"},
           {text + "members = [1]\n",
            "\"members\" is for accuracy runs, but this experiment is for cut families; leave"},
           {text + "time_limit_s = 1.0\n",
            "is for robustness runs and stability sweeps, but this experiment is for cut"},
           {"own_cuts = true\n" + robustness,
            "\"own_cuts\" is for cut families, but this experiment is for robustness"},
           {"cases = 3\n" + accuracy,
            "\"cases\" is for robustness runs and stability sweeps and cut families, but this"},
           {robustness + "[accuracy]\n",
            "\"accuracy\" is for accuracy runs, but this experiment is for robustness runs"},
           {robustness + "direct = [\"cholmod\"]\n", "[robustness]: \"direct\" is for accuracy runs, but this"},
           {robustness + "cases = 3\n", "\"cases\" belongs above [robustness]; move it there"},
           {"members = [1]\n" + accuracy, "\"members\" belongs below [accuracy]; move it there"},
           {robustness + "time_limits_s = 3.0\n", "unknown key \"time_limits_s\"; did you mean \"time_limit_s\""},
           {text + "chord_tolerance = nan\n", "\"chord_tolerance\" must be positive"},
           {std::string("claim = \"\0\1\"", 12), "line 1"},
           {"\x7f"
            "ELF\x02\x01\xff\xfe",
            "line 1"},
           {deep, "line 1"}})
    EXPECT_NE(experiment(bad).find(message), std::string::npos) << bad.substr(0, 300) << "\nsays " << experiment(bad);
  for (std::size_t n = 0; n < text.find("methods"); ++n) EXPECT_NE(experiment(text.substr(0, n)), "no InputError") << n;

  // What only the program knows: methods, their parameters, and the command line.
  write(folder_ / "e.toml", text);
  write(folder_ / "robust.toml", robustness);
  write(folder_ / "twice.toml", with("[0, 1]", "[0, 0]"));
  write(folder_ / "parameter.toml", with("[0, 1]", "[0, 0.5]"));
  write(folder_ / "parameterless.toml",
        with("\"conventional_split\"", "{name = \"conventional_split\", parameter = [1]}"));
  expect_all({{"run twice.toml --out r", 2, "method \"bowyer_watson\" is there twice with rounds=0"},
              {"run parameter.toml --out r", 2, "rounds must be a whole number"},
              {"run parameterless.toml --out r", 2, "method \"conventional_split\" has no parameter"},
              {"run e.toml --out r --shard 1/2x", 2, "--shard 1/2x"},
              {"run e.toml --out r --seed -1", 2, "--seed -1: give a whole number"},
              {"run e.toml --out r --seed 1e30", 2, "--seed 1e30: give a whole number"},
              {"run e.toml --out r --methods cross_check", 2, "--methods cross_check is not in the experiment"},
              {"run e.toml --out r --sweeps vertex", 2, "--sweeps is for an experiment that has [[sweeps]]"},
              {"run e.toml --out r --cases 0", 2, "--cases"},
              {"run robust.toml --out r --repetitions 3", 2, "--repetitions is for an experiment of cut families"},
              {"run e.toml --out r --repetitions 0", 2, "--repetitions"}});
}

}  // namespace
}  // namespace cutbench
