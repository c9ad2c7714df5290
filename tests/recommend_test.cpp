// `cutbench recommend` against what is known without it: the fall of a free sheet, exactly and by the integrator's
// recursion.

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/program.h"

namespace cutbench {
namespace {

constexpr double gravity = 9.81, damping = 0.5, seconds = 0.25;

/// v+ = (v - g h) / (1 + alpha h): backward Euler.
double stepped_fall(int steps) {
  const double h = seconds / steps;
  double v = 0, fallen = 0;
  for (int i = 0; i < steps; ++i) {
    v = (v + gravity * h) / (1 + damping * h);
    fallen += h * v;
  }
  return fallen;
}

/// v' = -g - alpha v, v(0) = 0.
double exact_fall() { return gravity / damping * (seconds - (1 - std::exp(-damping * seconds)) / damping); }

class Recommend : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write(folder_ / "scene.toml", scene("family = \"grid\"\nresolution = 72"));
    write(folder_ / "calibration.toml", calibration());
  }
  /// Nothing holds the sheet. It is cut in two at once, and both pieces fall without a strain.
  static std::string scene(const std::string& sheet, const std::string& integrator = "backward_euler",
                           const std::string& cut = "[[cuts]]\ntime = 0\npolyline = [[-0.1, 0.52], [1.1, 0.47]]\n") {
    return "effect = \"two pieces fall\"\ntruth = \"exact\"\nduration = 0.25\n[sheet]\n" + sheet +
           "\n[material]\ndensity = 2.2\nstiffness = 1000.0\npoisson = 0.45\nmass_damping = 0.5\n[physics]\n"
           "gravity = [0.0, 0.0, -9.81]\n[integrator]\nname = \"" +
           integrator + "\"\nstep = 0.0125\n[solver]\nname = \"cholmod\"\n" + cut;
  }
  static std::string calibration(const std::string& level = "0.5", const std::string& rest = "") {
    return "level = " + level + "\nscores = [2.0, 0.5, 1.25]\nintegrators = [\"backward_euler\"]\n" +
           (rest.empty() ? "resolutions = [8, 200]\nsteps = [10, 30]\nmost_spread = 0.1\n" : rest);
  }
  static std::string command(const std::string& more) {
    return "recommend scene.toml --calibration calibration.toml --quantity deflection --methods "
           "conventional_split,snap_or_split --solvers cholmod,cg --report r.json " +
           more;
  }
  nlohmann::json report() const { return nlohmann::json::parse(read(folder_ / "r.json")); }
  void expect_unknown(const std::string& arguments, const std::string& why) {
    SCOPED_TRACE(arguments);
    const auto result = run(arguments);
    EXPECT_EQ(result.code, 1) << result.error;
    EXPECT_NE(result.out.find("\nunknown: "), std::string::npos) << result.out;
    EXPECT_NE(report()["unknown"].get<std::string>().find(why), std::string::npos) << report()["unknown"];
    EXPECT_TRUE(report()["chosen"].is_null());
  }
  /// An answer that is sure of nothing, and why.
  nlohmann::json expect_guess(const std::string& arguments, const std::string& why) {
    SCOPED_TRACE(arguments);
    const auto result = run(arguments);
    EXPECT_EQ(result.code, 1) << result.error;
    EXPECT_NE(result.out.find("a guess: " + why), std::string::npos) << result.out;
    const auto r = report();
    EXPECT_FALSE(r["beyond_calibration"].empty());
    EXPECT_DOUBLE_EQ(r["margin_m"], 3 * 1.25 * r["converged"]["spread_m"].get<double>());
    EXPECT_NE(result.out.find("\na guess: take "), std::string::npos) << result.out;
    return r;
  }
  /// n x n squares as an OBJ.
  static std::string own_sheet(int n) {
    std::string text;
    for (int i = 0; i < (n + 1) * (n + 1); ++i)
      text += "v " + std::to_string(1.0 * (i % (n + 1)) / n) + " " + std::to_string(1.0 * (i / (n + 1)) / n) + " 0\n";
    for (int i = 0; i < n * n; ++i) {
      const int a = i / n * (n + 1) + i % n + 1, b = a + n + 1;
      const auto face = [&](int p, int q, int r) {
        text += "f " + std::to_string(p) + " " + std::to_string(q) + " " + std::to_string(r) + "\n";
      };
      face(a, a + 1, b + 1);
      face(a, b + 1, b);
    }
    return text;
  }
  void expect_refused(const std::string& arguments, const std::string& what) {
    SCOPED_TRACE(arguments);
    const auto result = run(arguments);
    EXPECT_EQ(result.code, 2) << result.out;
    EXPECT_NE(result.error.find(what), std::string::npos) << result.error;
  }
};

TEST_F(Recommend, TheConvergedValueIsThatOfTheExactMotion) {
  const auto result = run("recommend scene.toml --reference --max-error 0.05 --quantity deflection --report r.json");
  ASSERT_EQ(result.code, 0) << result.error;
  const auto converged = report();
  for (const auto& made : converged["runs"])
    EXPECT_NEAR(made["value_m"], stepped_fall(made["steps"]), 1e-6) << made["steps"];
  const int steps = converged["steps"];
  EXPECT_NEAR(converged["spread_m"], stepped_fall(steps / 2) - stepped_fall(steps), 2e-6);
  EXPECT_LE(converged["spread_m"], 0.2 * 0.05 * converged["value_m"].get<double>());
  EXPECT_NEAR(converged["value_m"], exact_fall(), 0.05 * converged["spread_m"].get<double>());
}

TEST_F(Recommend, TheChoiceIsTheCheapestWhoseErrorIsSmallEnough) {
  const auto result = run(command("--max-error 0.05"));
  ASSERT_EQ(result.code, 0) << result.out << result.error;
  EXPECT_NE(result.error.find("running "), std::string::npos) << "it takes minutes, and says what it is at";
  const auto r = report();
  const auto& chosen = r["trials"][r["chosen"].get<std::size_t>()];
  bool one_is_too_coarse = false;
  for (const auto& trial : r["trials"]) {
    SCOPED_TRACE(trial.dump());
    if (trial["verdict"] == "timed_out") continue;
    ASSERT_EQ(trial["verdict"], "ok");
    const double value = stepped_fall(trial["steps"]);
    EXPECT_NEAR(trial["value_m"], value, trial["solver"] == "cholmod" ? 1e-6 : 0.01 * value) << "cg: up to a tolerance";
    const double error = std::abs(trial["value_m"].get<double>() - exact_fall()) / exact_fall();
    EXPECT_LE(trial["error_low"], error);
    EXPECT_GE(trial["error_high"], error);
    const bool good = trial["error_high"] <= 0.05;
    EXPECT_FALSE(trial["error_low"] <= 0.05 && trial["ms_per_s"].is_null()) << "what may be good enough is timed";
    if (good) {
      EXPECT_GE(trial["ms_per_s"], chosen["ms_per_s"]);
    }
    one_is_too_coarse |= error > 0.05;
  }
  EXPECT_TRUE(one_is_too_coarse);
  EXPECT_LE(chosen["error_high"], 0.05);
  EXPECT_NE(result.out.find("\ntake "), std::string::npos) << result.out;
}

/// With such scores no candidate is good enough for certain until the margin has shrunk to a fraction.
TEST_F(Recommend, TheConvergedValueIsRefinedWhileCheaperCandidatesAreUndecided) {
  write(folder_ / "calibration.toml",
        "level = 0.5\nscores = [9.0, 9.0, 9.0]\nintegrators = [\"backward_euler\"]\nresolutions = [8, 200]\n"
        "steps = [10, 30]\nmost_spread = 0.1\n");
  ASSERT_EQ(run("recommend scene.toml --reference --max-error 0.1 --quantity deflection --report r.json").code, 0);
  const double unrefined = report()["spread_m"];
  const auto exhaustive = run(command("--max-error 0.1 --exhaustive"));
  ASSERT_EQ(exhaustive.code, 1) << "to run all candidates refines nothing";
  EXPECT_EQ(exhaustive.out.find("refined"), std::string::npos) << exhaustive.out;
  EXPECT_NEAR(report()["converged"]["spread_m"], unrefined, 1e-6 * unrefined) << "by another method";
  EXPECT_FALSE(report()["refined_to_decide"]);
  const auto result = run(command("--max-error 0.1"));
  ASSERT_EQ(result.code, 0) << result.out << result.error;
  const auto r = report();
  EXPECT_LT(r["converged"]["spread_m"], 0.6 * unrefined);
  EXPECT_TRUE(r["refined_to_decide"]);
  EXPECT_NE(result.out.find("; refined further than those\n"), std::string::npos) << result.out;
  const double margin = r["margin_m"];
  EXPECT_DOUBLE_EQ(margin, 9 * r["converged"]["spread_m"].get<double>());
  EXPECT_NEAR(r["converged"]["value_m"], exact_fall(), margin);
  const auto& chosen = r["trials"][r["chosen"].get<std::size_t>()];
  EXPECT_LE(std::abs(chosen["value_m"].get<double>() / exact_fall() - 1), 0.1);
  EXPECT_LE(chosen["steps"], 20) << "of 10 steps the error is 0.09";
}

/// Of three scores and half of the scenes, the second; and an error's interval holds it for every value within the
/// margin.
TEST_F(Recommend, IntervalsFollowFromTheMargin) {
  ASSERT_EQ(run(command("--max-error 0.2 --exhaustive")).code, 0);
  const auto r = report();
  const double value = r["converged"]["value_m"], margin = r["margin_m"];
  EXPECT_DOUBLE_EQ(margin, 1.25 * r["converged"]["spread_m"].get<double>());
  for (const auto& trial : r["trials"]) {
    SCOPED_TRACE(trial.dump());
    if (trial["value_m"].is_null()) continue;
    double least = 1e300, most = 0;
    for (int i = -500; i <= 500; ++i) {
      const double truth = value + margin * i / 500, error = std::abs(trial["value_m"].get<double>() / truth - 1);
      least = std::min(least, error);
      most = std::max(most, error);
    }
    const double resolved = 1.01 * margin / 500 / (value - margin);
    EXPECT_NEAR(trial["error_low"], least, resolved);
    EXPECT_NEAR(trial["error_high"], most, 1e-9);
    EXPECT_EQ(trial["ms_per_s"].is_null(), trial["verdict"] != "ok");
  }
}

TEST_F(Recommend, UnknownSaysWhy) {
  expect_unknown(command("--max-error 1e-3"), "give a finer scene");
  expect_unknown(command("--max-error 0.1 --max-ms 1e-9"), "ms for a second");
  expect_unknown(command("--max-error 0.1 --time-limit 1e-9"), "timed_out");
  // All that no run can help, at once.
  write(folder_ / "scene.toml", scene("family = \"grid\"\nresolution = 16200", "xpbd"));
  expect_unknown(command("--max-error 0.1"), "16200 triangles, and at most 12800 are run");
  expect_unknown(command("--max-error 0.1"), "xpbd's stiffness");
}

TEST_F(Recommend, BeyondTheCalibrationItGuessesAndSaysWhy) {
  const std::string sheet = "family = \"grid\"\nresolution = ";
  write(folder_ / "scene.toml", scene(sheet + "72", "midpoint"));
  expect_guess(command("--max-error 0.1"), "the integrator is midpoint");
  write(folder_ / "scene.toml", scene(sheet + "242"));
  expect_guess(command("--max-error 0.1"), "the sheet's triangles are 242, and the calibration has seen 8 to 200");
  write(folder_ / "scene.toml", scene(sheet + "72"));
  write(folder_ / "calibration.toml", calibration("0.5", "resolutions = [8, 200]\nsteps = [1, 5]\nmost_spread = 1\n"));
  expect_guess(command("--max-error 0.1"), "the scene's steps are 20");
  write(folder_ / "calibration.toml",
        calibration("0.5", "resolutions = [8, 200]\nsteps = [10, 30]\nmost_spread = 1e-5\n"));
  expect_guess(command("--max-error 0.1"), "the spread");
}

TEST_F(Recommend, TheCalibrationIsFoundFromAnywhere) {
  const auto result =
      run("recommend scene.toml --max-error 0.2 --quantity deflection --methods conventional_split "
          "--solvers cg --report r.json");
  EXPECT_EQ(result.code, 1) << result.error;
  EXPECT_NE(result.out.find("a guess: the sheet's triangles are 72, and the calibration has seen 162 to 800"),
            std::string::npos)
      << result.out;
}

TEST_F(Recommend, ASheetOfOnesOwnIsMadeFinerAndCoarser) {
  write(folder_ / "own.obj", own_sheet(6));
  write(folder_ / "scene.toml", scene("file = \"own.obj\""));
  const auto r = expect_guess(command("--max-error 0.05 --exhaustive"), "the sheet is its own");
  std::set<int> triangles;
  for (const auto& trial : r["trials"]) {
    if (trial["verdict"] != "ok") continue;
    triangles.insert(trial["resolution"].get<int>());
    const double value = stepped_fall(trial["steps"]);
    EXPECT_NEAR(trial["value_m"], value, trial["solver"] == "cholmod" ? 1e-6 : 0.01 * value) << trial;
  }
  EXPECT_TRUE(triangles.contains(72) && triangles.contains(288));
  EXPECT_LT(*triangles.begin(), 72) << "by remeshing";
  EXPECT_NEAR(r["converged"]["value_m"], exact_fall(), 0.05 * exact_fall());
}

TEST_F(Recommend, ExplicitStepsAreAsLongAsTheCutSheetAllows) {
  // Through the middles of edges, so that there are no slivers, and steps are few.
  std::string text = scene("family = \"grid\"\nresolution = 72", "symplectic_euler",
                           "[[cuts]]\ntime = 0\npolyline = [[-0.1, 0.5], [1.1, 0.5]]\n");
  text.replace(text.find("[physics]"), 9, "[physics]\nmass = \"lumped\"");
  write(folder_ / "scene.toml", text);
  const auto r = expect_guess(command("--max-error 0.05"), "the integrator is symplectic_euler");
  ASSERT_FALSE(r["chosen"].is_null());
  std::map<std::pair<std::string, int>, std::set<int>> steps;
  for (const auto& trial : r["trials"]) {
    EXPECT_TRUE(trial["verdict"] == "ok" || trial["verdict"] == "timed_out") << trial;  // it is sure to be dearer
    steps[{trial["method"], trial["resolution"]}].insert(trial["steps"].get<int>());
  }
  EXPECT_GT(steps.size(), 1u);
  const auto& chosen = r["trials"][r["chosen"].get<std::size_t>()];
  EXPECT_NEAR(chosen["value_m"], exact_fall(), 0.05 * exact_fall());
  for (const auto& [candidate, counts] : steps) EXPECT_EQ(counts.size(), 1u) << candidate.first;
}

/// A hole whose piece falls: what counts is the sheet that is held, and on sheets that can hold the hole.
TEST_F(Recommend, PiecesThatFallAreLeftOutAndSheetsHoldTheCuts) {
  write(folder_ / "scene.toml", scene("family = \"grid\"\nresolution = 72", "backward_euler",
                                      "[[pins]]\nbox = [[-1.0, 0.99], [2.0, 2.0]]\n[[cuts]]\ntime = 0\nclosed = true\n"
                                      "polyline = [[0.3, 0.3], [0.72, 0.31], [0.71, 0.73], [0.31, 0.72]]\n"));
  const auto result = run(command("--max-error 0.5"));
  const auto r = report();
  EXPECT_NE(result.out.find("note: 1 piece that nothing holds is left out of the quantity"), std::string::npos)
      << result.out;
  EXPECT_NE(result.out.find("left out: the least cut is to be two edges wide"), std::string::npos) << result.out;
  for (const auto& trial : r["trials"]) EXPECT_GE(trial["resolution"], 2 * 5 * 5) << "two edges in 0.42 m";
  EXPECT_GT(r["converged"]["value_m"], 0);
  EXPECT_GT(std::abs(r["converged"]["value_m"].get<double>() / exact_fall() - 1), 0.01) << "that of the piece";
}

/// Without a scene: options or lines of standard input answer, and only what decides is asked.
TEST_F(Recommend, QuestionsLeadToAMethod) {
  const auto takes = [&](const std::string& arguments, const std::string& input, const std::string& method) {
    const auto result = run("recommend " + arguments, input.empty() ? "" : "printf '" + input + "' |");
    EXPECT_EQ(result.code, 0) << result.error;
    EXPECT_NE(result.out.find("take " + method), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("--method " + method + "\n"), std::string::npos) << result.out;
    EXPECT_EQ(result.out.find("{}"), std::string::npos) << result.out;
    const auto has = [&](const char* text) { return result.out.find(text) != std::string::npos; };
    EXPECT_EQ(has("cut_polygons"), has("no hinges")) << "a scene with hinges refuses polygons: " << result.out;
    return result.out;
  };
  takes("--yes explicit,diagonal", "", "cut_polygons");
  EXPECT_NE(takes("--yes explicit", "n\\n", "conventional_split").find("stabilised"), std::string::npos);
  takes("", "n\\nno\\nyes\\n", "cut_polygons");
  takes("--no explicit,exact_path,fixed_vertices,many_cuts --yes error_first", "", "adaptive_remesh");
  takes("--no explicit,exact_path,fixed_vertices --yes error_first", "what?\\ny\\n", "active_node");
  expect_refused("recommend --no explicit </dev/null", "give --yes exact_path or --no exact_path");
  expect_refused("recommend --yes explicity", "known are explicit");
  expect_refused("recommend --max-error 0.1", "for a scene");
}

TEST_F(Recommend, BadInput) {
  expect_refused("recommend missing.toml --max-error 0.1", "missing.toml");
  expect_refused("recommend scene.toml", "--max-error");
  expect_refused("recommend scene.toml --max-error 0.1 --calibration none.toml", "none.toml");
  expect_refused(command("--max-error 0.1 --methods no_such"), "no_such");
  expect_refused(command("--max-error 0.1 --solvers no_such"), "no_such");
  expect_refused(command("--max-error -1"), "--max-error");
  expect_refused("recommend scene.toml --max-error 0.1 --report none/r.json", "none");
  write(folder_ / "calibration.toml", calibration("0.95"));
  expect_refused(command("--max-error 0.1"), "more than 3 scores");
  write(folder_ / "calibration.toml", calibration("0.5", "resolutions = [8]\nsteps = [10, 30]\nmost_spread = 1\n"));
  expect_refused(command("--max-error 0.1"), "[least, most]");
  write(folder_ / "calibration.toml", calibration() + "quantil = 1\n");
  expect_refused(command("--max-error 0.1"), "quantil");
  write(folder_ / "calibration.toml", calibration());
  write(folder_ / "scene.toml", scene("family = \"grid\"\nresolution = 72", "backward_euler", ""));
  expect_refused("recommend scene.toml --max-error 0.1 --quantity gape", "no cuts");
}

}  // namespace
}  // namespace cutbench
