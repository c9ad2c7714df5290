// The program as a user meets it: exit codes, one line on stderr, nothing half-written.
#include <nlohmann/json.hpp>
#include <numeric>
#include <regex>
#include <set>
#include <sstream>

#include "harness/base/conversions.h"
#include "harness/records/record.h"
#include "tests/helpers.h"
#include "tests/program.h"

namespace cutbench {
namespace {

class Cli : public Program {
 protected:
  /// Exit code 2, one line that says `what`, and no output.
  void expect_refused(const Result& result, const std::string& what) {
    EXPECT_EQ(result.code, 2) << result.error;
    EXPECT_EQ(lines_of(result.error).size(), 1u) << result.error;
    EXPECT_NE(result.error.find(what), std::string::npos) << result.error;
    EXPECT_FALSE(fs::exists(folder_ / "out.obj"));
  }
};

TEST_F(Cli, MethodsListsEveryRow) {
  const auto json = nlohmann::json::parse(run("methods --json").out);
  ASSERT_EQ(json.size(), all_methods().size());
  const auto text = run("methods");
  EXPECT_EQ(text.code, 0);
  for (std::size_t i = 0; i < json.size(); ++i) {
    const MethodRow& row = all_methods()[i];
    EXPECT_EQ(json[i]["name"], row.name);
    EXPECT_NE(text.out.find(row.summary), std::string::npos);
    EXPECT_EQ(json[i]["parameter"].is_null(), row.parameter.name.empty());
    if (row.parameter.name.empty()) continue;
    EXPECT_EQ(json[i]["parameter"]["range"]["most"], row.parameter.range.most) << row.name;
    EXPECT_NE(text.out.find(row.parameter.range.text() + ": " + row.parameter.meaning), std::string::npos) << row.name;
  }
}

/// --help of each subcommand says what it prints, with an example that runs, and --version what was built.
TEST_F(Cli, HelpAndVersion) {
  for (const char* subcommand : {"", "methods ", "cut ", "score ", "simulate ", "ablate ", "recommend ", "run ",
                                 "reduce ", "merge ", "missing ", "columns ", "compare "}) {
    const auto help = run(std::string(subcommand) + "--help");
    EXPECT_EQ(help.code, 0) << subcommand;
    EXPECT_TRUE(help.error.empty()) << help.error;
    for (const char* part : {"example", "  cutbench ", "exit codes:", "\n  2  bad input"})
      EXPECT_NE(help.out.find(part), std::string::npos) << subcommand << "lacks " << part << "\n" << help.out;
  }
  EXPECT_NE(run("cut --help").out.find("=0.05"), std::string::npos) << "the default of --chord-tolerance";
  const auto version = run("--version");
  EXPECT_EQ(version.code, 0) << version.error;
  for (const std::string& part :
       {std::string(", suite version ") + suite_version + "\ncommit ", std::string("\ncompiled by ")})
    EXPECT_NE(version.out.find(part), std::string::npos) << version.out;
}

TEST_F(Cli, CutWritesMeshAndReport) {
  for (const auto& row : whole_sheet_methods()) {
    const auto result = cut("--report r.json", row.name);
    ASSERT_EQ(result.code, 0) << result.error;
    const auto report = nlohmann::json::parse(read(folder_ / "r.json"));
    EXPECT_EQ(report["status"], "ok");
    EXPECT_EQ(report["method"], row.name);
    EXPECT_EQ(report["pieces"], 2);
    EXPECT_EQ(report["crossed_triangles"], 2);
    EXPECT_EQ(report["ar_max_cut"] > 0, row.name != "edge_release") << "which changes no triangle here";
    EXPECT_LT(std::abs(report["area_change"].get<double>()), 1e-12);
    for (const char* key :
         {"reason", "vertices_added", "deformed_vertices_added", "triangles_added", "angle_max_deg_cut",
          "altitude_min_h_all", "forced_corners", "incision_error_h", "geometry_us", "pick_us"})
      EXPECT_TRUE(report.contains(key)) << key;
    // What was written is a sheet again, with its incision, which a second cut crosses.
    write(folder_ / "across.json", R"({"cuts":[{"polyline":[[0.45,-0.1],[0.55,1.1]]}]})");
    const auto again =
        run("cut --mesh out.obj --path across.json --method " + row.name + " --out again.obj --report r.json");
    EXPECT_EQ(again.code, 0) << again.error;
    EXPECT_EQ(nlohmann::json::parse(read(folder_ / "r.json"))["pieces"], 4);
  }
}

/// The documents that are made of the table of metrics are those of this program.
TEST_F(Cli, ColumnsAreThoseOfTheDocuments) {
  const fs::path results = fs::path(CUTBENCH_TEST_CASES) / "../../results";
  EXPECT_EQ(run("columns --json").out, read(results / "columns.json")) << "write it anew: cutbench columns --json";
  const std::string page = read(results / "README.md"), begin = "<!-- begin of columns -->\n";
  const std::size_t from = page.find(begin), to = page.find("<!-- end of columns -->");
  ASSERT_LT(from, to);
  EXPECT_EQ(run("columns").out, page.substr(from + begin.size(), to - from - begin.size()))
      << "write it anew: cutbench columns";
}

/// The commands of the README's demo.
TEST_F(Cli, TheExampleIsCutAndScored) {
  const fs::path examples = fs::path(CUTBENCH_TEST_CASES) / "../../experiments/examples";
  const std::string files =
      " --mesh " + (examples / "sheet.obj").string() + " --path " + (examples / "path.json").string();
  for (const auto& row : all_methods()) {
    const std::string out = (folder_ / (row.name + ".obj")).string();
    const auto made = run("cut" + files + " --method " + row.name + " --out " + out);
    EXPECT_EQ(made.code, 0) << row.name << made.error;
    if (!row.promises.exact_incision) continue;
    EXPECT_EQ(lines_of(run("score" + files + " --result " + out).out).front(), "ok") << row.name;
  }
}

TEST_F(Cli, RepeatedPolylineIsANoop) {
  write(folder_ / "path.json", R"({"cuts":[{"polyline":[[-0.1,0.3],[0.4,0.45],[1.1,0.7]]}]})");
  ASSERT_EQ(cut().code, 0);
  const auto again = run("cut --mesh out.obj --path path.json --method bowyer_watson --out again.obj --report r.json");
  EXPECT_EQ(again.code, 0);
  EXPECT_EQ(nlohmann::json::parse(read(folder_ / "r.json"))["status"], "noop");
  EXPECT_EQ(read(folder_ / "out.obj"), read(folder_ / "again.obj"));
}

TEST_F(Cli, BadOptionsAreRefused) {
  expect_refused(cut("", "conventionl_split"),
                 "unknown method \"conventionl_split\"; did you mean \"conventional_split\"?");
  expect_refused(cut("--set rounds=1"), "has no parameter");
  expect_refused(cut("--set rounds=x", "bowyer_watson"), "not a number");
  expect_refused(cut("--set depth=1", "bowyer_watson"), "rounds=VALUE");
  expect_refused(cut("--set rounds=-1", "bowyer_watson"), "rounds");
  expect_refused(cut("--set rounds=1.5", "bowyer_watson"), "rounds");
  expect_refused(cut("--chord-tolerance nan"), "not a number");
  expect_refused(cut("--chord-tolerance -1"), "positive");
  expect_refused(cut("--nonsense 1"), "--nonsense");
  expect_refused(run("cut --mesh none.off --path path.json --out out.obj --method cgal_cdt"), "none.off");
  expect_refused(run("cut --mesh sheet.off --path none.json --out out.obj --method cgal_cdt"), "none.json");
  expect_refused(run("cut --mesh sheet.off --path path.json --out nowhere/out.obj --method cgal_cdt"), "nowhere");
  expect_refused(cut("--report nowhere/r.json"), "nowhere");
}

TEST_F(Cli, BadPathsAreRefused) {
  for (const auto& [text, what] :
       {std::pair<const char*, const char*>{"", "not a path file"},
        {"{\"cuts\":[", "not a path file"},
        {"{\"cuts\":[]}", "empty"},
        {"{\"cut\":[]}", "unknown key \"cut\""},
        {"{\"cuts\":[{\"bezier\":[[0,0],[1,1]]}]}", "4, 7, 10"},
        {"{\"cuts\":[{\"polyline\":[[0,0]]}]}", "2 points"},
        {"{\"cuts\":[{\"polyline\":[[0,0],[1,1e999]]}]}", "not a path file"},
        {"{\"cuts\":[{\"polyline\":[[0,0],[1,1e70]]}]}", "finite"},
        {"{\"cuts\":[{\"polyline\":[[0,0,0],[1,1,1]]}]}", "[x, y]"},
        {"{\"cuts\":[{\"polyline\":[[0,0],[1,1]],\"colour\":1}]}", "unknown key \"colour\""},
        {"{\"cuts\":[{\"polyline\":[[0,0],[1,1]],\"closed\":true}]}", "3 points"},
        {"{\"cuts\":[{\"bezier\":[[0,0],[0,1],[1,1],[1,0]],\"closed\":true}]}", "end where it began"},
        {"{\"cuts\":[{\"polyline\":[[0,0],\"x\"]}]}", "[x, y]"}}) {
    write(folder_ / "path.json", text);
    expect_refused(cut(), what);
  }
}

TEST_F(Cli, RunWritesOneRowPerRepetition) {
  write(folder_ / "e.toml", small_experiment("every_edge = true\ncold = true\n"));
  const auto result = run("run e.toml --out r");
  ASSERT_EQ(result.code, 0) << result.error;
  const auto lines = lines_of(read(folder_ / "r/e/records.csv"));
  EXPECT_EQ(lines.size(), 1u + 2 * 2 * 3 * (3 + 1) * (2 + 1));  // sheets x families x cases x methods x (warm + cold)
  EXPECT_EQ(to_size(std::count(lines[0].begin(), lines[0].end(), ',') + 1), column_names().size());
  for (const auto& line : lines)
    EXPECT_EQ(std::count(line.begin(), line.end(), ','), std::count(lines[0].begin(), lines[0].end(), ','));
  EXPECT_FALSE(fs::exists(folder_ / "r/e/records.csv.part"));
  const auto context = nlohmann::json::parse(read(folder_ / "r/e/context.json"));
  for (const char* key : {"commit", "dirty", "compiler", "flags", "build_type", "cpu", "versions", "date", "load",
                          "seed", "command", "claim"})
    EXPECT_TRUE(context.contains(key)) << key;
  EXPECT_NE(result.out.find("bowyer_watson"), std::string::npos);  // the table
}

/// They depend on the sheet and the size alone: a part of the run has the same.
TEST_F(Cli, EachSheetAndSizeDrawsItsOwnCuts) {
  const std::string text = small_experiment("quality = false\n");
  write(folder_ / "shared.toml", text);
  write(folder_ / "own.toml", text + "own_cuts = true\n");
  std::string both = text + "own_cuts = true\n";
  both.replace(both.find("[200]"), 5, "[200, 800]");
  write(folder_ / "both.toml", both);
  for (const std::string stem : {"shared", "own", "both"}) ASSERT_EQ(run("run " + stem + ".toml --out r").code, 0);
  const auto curves = [&](const std::string& stem, const std::string& resolution) {
    std::set<std::string> found;  // by what only the same curve gives on the same sheet
    for (const std::string& line : lines_of(read(folder_ / "r" / stem / "records.csv"))) {
      const Record row(column_names(), line);
      if (row.get("resolution") != resolution || row.get("repetition") != "0") continue;
      std::string key;
      for (const char* column : {"sheet", "cut_family", "case", "incision_error_h"}) {
        key += row.get(column);
        key += ' ';
      }
      found.insert(key);
    }
    return found;
  };
  const auto own = curves("own", "200"), shared = curves("shared", "200");
  EXPECT_EQ(curves("both", "200"), own);
  for (const std::string& curve : own) EXPECT_FALSE(shared.contains(curve)) << curve;
}

TEST_F(Cli, RunIsDeterministic) {
  write(folder_ / "e.toml", small_experiment());
  ASSERT_EQ(run("run e.toml --out a").code, 0);
  ASSERT_EQ(run("run e.toml --out b").code, 0);
  const auto whole = without_times(read(folder_ / "a/e/records.csv"));
  EXPECT_EQ(without_times(read(folder_ / "b/e/records.csv")), whole);
  ASSERT_EQ(run("run e.toml --out c --seed 2").code, 0);
  EXPECT_NE(without_times(read(folder_ / "c/e/records.csv")), whole);
}

/// Cuts inside a running scene, stepped by CHOLMOD, which would take threads if it were let.
TEST_F(Cli, ScenesGiveTheSameOnAnyThreadCount) {
  std::string scene = read(CUTBENCH_TEST_CASES "/../../experiments/scenes/paper_table1.toml");
  scene.replace(scene.find("\"cg\""), 4, "\"cholmod\"");
  write(folder_ / "scene.toml", scene);
  write(folder_ / "e.toml", small_experiment("scene = \"scene.toml\"\ncut_time = 0.05\nscene_cases = 2\n"));
  std::vector<std::multiset<std::string>> rows;
  for (const char* threads : {"1", "4"}) {
    setenv("OMP_NUM_THREADS", threads, 1);
    const std::string out = std::string("r") + threads;
    const auto result = run("run e.toml --out " + out);
    EXPECT_EQ(result.code, 0) << result.error;
    rows.push_back(without_times(read(folder_ / out / "e/records.csv")));
  }
  unsetenv("OMP_NUM_THREADS");
  EXPECT_EQ(rows[0], rows[1]);
  const auto in_scene = std::count_if(rows[0].begin(), rows[0].end(), [](const std::string& row) {
    return row.find(",simulation,ok,ok,") != std::string::npos;
  });
  EXPECT_EQ(in_scene, 2 * 2 * 2 * 3);  // sheets x families x cases x methods
}

TEST_F(Cli, SimulateRunsAScene) {
  const std::string scene = CUTBENCH_TEST_CASES "/../../experiments/scenes/falling_piece.toml";
  const auto result = run("simulate '" + scene + "' --method bowyer_watson --set rounds=1 --out out.obj");
  EXPECT_EQ(result.code, 0) << result.error;
  EXPECT_NE(result.out.find("2 pieces"), std::string::npos) << result.out;
  EXPECT_TRUE(fs::exists(folder_ / "out.obj"));
  fs::remove(folder_ / "out.obj");
  expect_refused(run("simulate '" + scene + "' --resolution 801 --out out.obj"), "resolution 801");
  expect_refused(run("simulate missing.toml"), "missing.toml");
}

TEST_F(Cli, SimulateSaysWhatStepsCost) {
  const std::string scene = CUTBENCH_TEST_CASES "/../../experiments/scenes/falling_piece.toml";
  std::map<std::string, double> iterations;
  for (const std::string solver : {"cg", "multigrid"}) {
    const auto result = run("simulate '" + scene + "' --solver " + solver + " --report r.json --steps s.csv");
    ASSERT_EQ(result.code, 0) << result.error;
    EXPECT_NE(result.out.find("real-time factor"), std::string::npos) << result.out;
    const auto report = nlohmann::json::parse(read(folder_ / "r.json"));
    EXPECT_EQ(report["solver"], solver);
    const auto& cost = report["cost"];
    EXPECT_NEAR(cost["steps"].get<double>() * report["step_s"].get<double>(), cost["simulated_s"].get<double>(), 1e-9);
    EXPECT_NEAR(cost["real_time_factor"].get<double>() * cost["computed_s"].get<double>(),
                cost["simulated_s"].get<double>(), 1e-9);
    EXPECT_EQ(cost["with_cut"]["steps"], 1);
    const std::vector<std::string> rows = lines_of(read(folder_ / "s.csv"));
    ASSERT_EQ(rows.size(), cost["steps"].get<std::size_t>() + 1);
    double computed_ms = 0;
    for (std::size_t i = 1; i < rows.size(); ++i) {
      std::istringstream row(rows[i]);
      std::vector<double> values;
      for (std::string value; std::getline(row, value, ',');) values.push_back(std::stod(value));
      ASSERT_EQ(values.size(), 12u) << rows[i];
      EXPECT_NEAR(values[0], to_double(i) * report["step_s"].get<double>(), 1e-5);
      EXPECT_NEAR(values[9], std::accumulate(values.begin() + 2, values.begin() + 9, 0.0), 1e-2);
      computed_ms += values[9];
    }
    EXPECT_NEAR(computed_ms, 1000 * cost["computed_s"].get<double>(), 0.01 * computed_ms);
    for (const char* phase : {"rotate", "assemble", "setup", "solve", "total"}) {
      const auto &all = cost["step_ms"][phase], &with_cut = cost["with_cut"]["step_ms"][phase];
      EXPECT_GT(all["median"], 0) << phase;
      EXPECT_GE(all["worst"], all["median"]) << phase;
      EXPECT_EQ(with_cut["worst"], with_cut["median"]) << "of one step";
      EXPECT_GE(all["worst"], with_cut["worst"]) << phase;
    }
    iterations[solver] = cost["iterations"]["mean"];
    EXPECT_GE(cost["iterations"]["worst"].get<double>(), iterations[solver]);
  }
  EXPECT_LT(2 * iterations["multigrid"], iterations["cg"]);
  expect_refused(run("simulate '" + scene + "' --solver gmres"), "gmres");
  expect_refused(run("simulate '" + scene + "' --report none/r.json"), "none");
  expect_refused(run("simulate '" + scene + "' --steps none/s.csv"), "none");
}

/// A sheet that hangs from its left side, and is cut from the right; more lines for [physics] and [integrator].
std::string hanging(const std::string& physics, const std::string& integrator) {
  return "effect = \"e\"\ntruth = \"t\"\nduration = 0.1\n[sheet]\nfamily = \"grid\"\nsize = 1.0\nresolution = 200\n"
         "[material]\ndensity = 2.2\nstiffness = 1000.0\npoisson = 0.3\nbending = 4e-4\n"
         "[physics]\ngravity = [0.0, 0.0, -9.81]\n" +
         physics + "\n[[pins]]\nbox = [[-inf, -inf], [0.0, inf]]\n[integrator]\n" + integrator +
         "\n[[cuts]]\ntime = 0.05\npolyline = [[0.52, 0.47], [1.1, 0.53]]\n";
}

TEST_F(Cli, SimulateSaysThatACutWasRefused) {
  write(folder_ / "s.toml", hanging("bending = \"hinges\"", "name = \"backward_euler\"\nstep = 0.01"));
  const auto result = run("simulate s.toml --method cut_polygons --report r.json --frames frames");
  EXPECT_EQ(result.code, 1) << result.error;
  EXPECT_EQ(lines_of(result.out).back().find("ok, but 1 of 1 cuts was refused: the method's polygons have no hinges"),
            0u)
      << lines_of(result.out).back();
  for (const char* file : {"r.json", "frames/simulation.json"}) {
    const auto report = nlohmann::json::parse(read(folder_ / file));
    EXPECT_EQ(report["verdict"], "ok");
    EXPECT_EQ(report["cuts_refused"], 1);
    EXPECT_EQ(report["reason"].get<std::string>().find("1 of 1 cuts was refused: the method's"), 0u);
  }
}

/// No energy, no residual, and no solver where steps are sweeps or explicit.
TEST_F(Cli, SimulateSaysWhatItDidNotJudge) {
  for (const std::string integrator : {"xpbd", "vbd", "symplectic_euler"}) {
    const bool sweeps = integrator != "symplectic_euler";
    write(folder_ / "s.toml", hanging("bending = \"hinges\"", "name = \"" + integrator + "\"\nstep = " +
                                                                  (sweeps ? "0.005\nsweeps = 4" : "1e-4")));
    const auto result = run("simulate s.toml --method edge_release --report r.json --steps s.csv");
    ASSERT_EQ(result.code, 0) << result.error << result.out;
    EXPECT_EQ(lines_of(result.out).back().find("no energy is judged") != std::string::npos, sweeps);
    EXPECT_EQ(result.out.find("largest residual"), std::string::npos);
    const auto report = nlohmann::json::parse(read(folder_ / "r.json"));
    EXPECT_EQ(report["energy_judged"], !sweeps);
    EXPECT_TRUE(report["cost"]["iterations"]["largest_residual"].is_null());
    EXPECT_TRUE(report["solver"].is_null());
    EXPECT_EQ(lines_of(read(folder_ / "s.csv"))[1].back(), ',');
    expect_refused(run("simulate s.toml --solver multigrid"), "--solver: " + integrator);
  }
}

TEST_F(Cli, SimulateCountsNothingAfterTheVerdict) {
  std::string scene = hanging("", "name = \"backward_euler\"\nnewton = 1\nstep = 0.05");
  const auto replace = [&](const std::string& what, const std::string& by) {
    scene.replace(scene.find(what), what.size(), by);
  };
  replace("duration = 0.1", "duration = 2.0");
  replace("stiffness = 1000.0", "stiffness = 1e6");
  replace("density = 2.2", "density = 0.2");
  replace("time = 0.05", "time = 1.9");
  write(folder_ / "s.toml", scene);
  const auto result = run("simulate s.toml --report r.json --frames frames");
  const auto report = nlohmann::json::parse(read(folder_ / "r.json"));
  ASSERT_EQ(report["verdict"], "energy_growth") << result.out;
  const double time = report["verdict_time_s"];
  ASSERT_LT(time, 1.5);
  EXPECT_NEAR(report["cost"]["simulated_s"].get<double>(), time, 1e-9);
  EXPECT_EQ(report["cuts"], 0);
  char until[48];
  std::snprintf(until, sizeof until, "budget until %.4g s:", time);
  EXPECT_NE(result.out.find(until), std::string::npos) << result.out;
  EXPECT_NE(result.out.find("1 more cuts came after the verdict"), std::string::npos) << result.out;
  // The gain that is printed is the one that the verdict names.
  std::smatch named, printed;
  const std::string reason = report["reason"];
  ASSERT_TRUE(std::regex_search(reason, named, std::regex("rose by ([^ ]+) %")));
  const auto& gains = report["gains"];
  char text[32];
  bool is_one = false;
  for (const auto& gain : gains) {
    std::snprintf(text, sizeof text, "%.2g", 100 * gain.get<double>());
    is_one |= named[1] == text;
  }
  EXPECT_TRUE(is_one) << reason << gains;
}

/// A run that goes on where it was stopped prints the table of all its rows.
TEST_F(Cli, AResumedRunPrintsTheTableOfAllRows) {
  write(folder_ / "e.toml", small_experiment("every_edge = true\ncold = true\n"));
  const auto whole = run("run e.toml --out whole");
  ASSERT_EQ(whole.code, 0);
  const auto table_of = [](const Result& result) {  // without the times, in the last columns but two
    std::multiset<std::string> rows;
    for (const std::string& line : lines_of(result.out)) rows.insert(line.substr(0, 85));
    return rows;
  };
  fs::create_directories(folder_ / "r/e/records.csv/in_the_way");  // so that the run ends without its records
  EXPECT_EQ(run("run e.toml --out r").code, 1);
  fs::remove_all(folder_ / "r/e/records.csv");
  const fs::path part = folder_ / "r/e/records.csv.part";
  const auto lines = lines_of(read(part));
  std::string text;
  for (std::size_t i = 0; i < 10; ++i) text += lines.at(i) + "\n";
  write(part, text);
  const auto resumed = run("run e.toml --out r");
  ASSERT_EQ(resumed.code, 0);
  EXPECT_NE(resumed.error.find("resumed, 9 rows"), std::string::npos) << resumed.error;
  EXPECT_EQ(table_of(resumed), table_of(whole)) << resumed.out << whole.out;
}

TEST_F(Cli, ShardsPartTheCases) {
  write(folder_ / "e.toml", small_experiment());
  ASSERT_EQ(run("run e.toml --out whole").code, 0);
  ASSERT_EQ(run("run e.toml --out s1 --shard 1/2").code, 0);
  ASSERT_EQ(run("run e.toml --out s2 --shard 2/2").code, 0);
  auto both = without_times(read(folder_ / "s1/e/records.csv")),
       second = without_times(read(folder_ / "s2/e/records.csv"));
  second.erase(second.find(*without_times(lines_of(read(folder_ / "s2/e/records.csv"))[0]).begin()));  // its head
  both.merge(second);
  EXPECT_EQ(both, without_times(read(folder_ / "whole/e/records.csv")));
}

TEST_F(Cli, BadExperimentsAreRefused) {
  for (const auto& [text, what] : {std::pair<std::string, const char*>{"claim = ", "line 1"},
                                   {small_experiment("case = 3\n"), "did you mean \"cases\""},
                                   {small_experiment("chord_tolerance = 0\n"), "positive"},
                                   {small_experiment("seed = \"x\"\n"), "seed"},
                                   {"claim = \"c\"\n", "sheets"}}) {
    write(folder_ / "e.toml", text);
    expect_refused(run("run e.toml --out r"), what);
    EXPECT_FALSE(fs::exists(folder_ / "r"));
  }
  write(folder_ / "e.toml", small_experiment());
  expect_refused(run("run e.toml none.toml --out r"), "none.toml");
  expect_refused(run("run e.toml --out r --methods nonsense"), "--methods");
  expect_refused(run("run e.toml --out r --resolutions 801"), "--resolutions");
  expect_refused(run("run e.toml --out r --shard 3/2"), "--shard");
  expect_refused(run("run e.toml --out r --seed x"), "--seed");
  write(folder_ / "e.toml", std::regex_replace(small_experiment(), std::regex("conventional_split"), "nonsense"));
  expect_refused(run("run e.toml --out r"), "`cutbench methods` lists them");
  write(folder_ / "e.toml", std::regex_replace(small_experiment(), std::regex("delaunay"), "nonsense"));
  expect_refused(run("run e.toml --out r"), "grid");
  write(folder_ / "e.toml", std::regex_replace(small_experiment(), std::regex("recut"), "nonsense"));
  expect_refused(run("run e.toml --out r"), "curved");
}

}  // namespace
}  // namespace cutbench
