// The stability sweeps on a small sheet, with the verdicts that it must find; its cuts, which must come as near as they
// say; and methods that crash or hang on purpose, which may cost one row each.

#include "harness/study/stability/stability.h"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <map>
#include <regex>

#include "harness/fem/linear/factor.h"
#include "harness/mesh/families.h"
#include "harness/study/stability/placed_cuts.h"
#include "methods/registry.h"
#include "tests/program.h"

namespace cutbench {
namespace {

const std::string scenes = fs::absolute(CUTBENCH_TEST_CASES "/../../experiments/scenes").string();

/// What an experiment begins with.
std::string head(const std::string& methods) {
  return "claim = \"c\"\nsheets = [\"delaunay\"]\nresolutions = [200]\nmethods = [" + methods + "]\n";
}
/// A sweep over cuts that spring open.
std::string sweep(const std::string& name, const std::string& settings, const std::string& scene = "stability_sheet") {
  return "[[sweeps]]\nname = \"" + name + "\"\nscene = \"" + scenes + "/" + scene + ".toml\"\n" + settings + "\n";
}

class Stability : public Program {
 protected:
  std::vector<Record> records_of(const std::string& folder) const {
    std::vector<Record> records;
    const auto lines = lines_of(read(folder_ / folder / "stability" / "records.csv"));
    for (std::size_t i = 1; i < lines.size(); ++i) records.emplace_back(stability_columns(), lines[i]);
    return records;
  }
};

double distance(Point2 p, Point2 a, Point2 b) {
  const Point2 d = b - a;
  const double t = std::clamp(dot(p - a, d) / squared_length(d), 0.0, 1.0);
  return length(a + t * d - p);
}

TEST(PlacedCuts, ComeAsNearAsTheySay) {
  const Sheet sheet(make_sheet("delaunay", 20));
  const double h = sheet.mean_edge();
  for (std::size_t i = 0; i < 10; ++i)
    for (const double place : {0.1, 1e-3, 1e-6}) {
      std::vector<double> distances;  // of the vertices from the cut that is to pass one of them
      const Curve curve = placed_cut("past_vertex", place, 7, i, sheet).front();
      for (std::size_t v = 0; v < sheet.vertex_slots(); ++v)
        distances.push_back(distance(sheet.rest(VertexIndex(v)), curve.points.front(), curve.points.back()) / h);
      std::sort(distances.begin(), distances.end());
      EXPECT_NEAR(distances[0], place, 1e-9) << i;
      EXPECT_GT(distances[1], 0.1) << i << ": near another vertex, too";

      const auto strip = placed_cut("strip", place, 7, i, sheet);
      ASSERT_EQ(strip.size(), 2u);
      EXPECT_NEAR(distance(strip[0].points[0], strip[1].points[0], strip[1].points[1]) / h, place, 1e-9);

      const auto tip = placed_cut("tip_at_edge", place, 7, i, sheet).front().points.back();
      double nearest = 1e300;
      for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
          nearest = std::min(
              nearest, distance(tip, sheet.corners(TriangleIndex(t))[k], sheet.corners(TriangleIndex(t))[(k + 1) % 3]));
      EXPECT_LE(nearest / h, place + 1e-9) << i;
      EXPECT_GE(nearest / h, 0.9 * place) << i << ": the edge is met nearly at right angles";
    }
  const auto recut = placed_cut("recut", 5, 7, 0, sheet);
  const Point2 a = recut[0].points[1] - recut[0].points[0], b = recut[1].points[1] - recut[1].points[0];
  EXPECT_NEAR(std::asin(cross(a, b) / length(a) / length(b)), 5 * M_PI / 180, 1e-9);
  EXPECT_EQ(placed_cut("in_a_row", 12, 7, 0, sheet).size(), 12u);
}

/// The verdicts by sweep, method and value of the column `by`.
TEST_F(Stability, FindsTheVerdicts) {
  write(folder_ / "stability.toml", head(R"("conventional_split", "snap_or_split", "split_and_tie")") +
                                        sweep("vertex", R"(steps = 3
cut = "past_vertex"
place = [0.2, 1e-6, 1e-12]
pose = "stretched"
pose_amount = 1.05
solver = "cholmod"
eigenvalue = true)") + sweep("explicit", R"(steps = 200
cut = "past_vertex"
place = 1e-3
pose = "stretched"
pose_amount = 1.05
step_share = [0.1, 1e-6])") + sweep("iterations", R"(steps = 3
cut = "curved"
pose = "stretched"
pose_amount = 1.05
max_iterations = [2, 2000])") +
                                        sweep("turned_over", R"(steps = 1
cut = "curved"
pose = "stretched"
pose_amount = [1.05, -1.0])",
                                              "stability_plane") +
                                        sweep("piece_static", R"(steps = 1
cut = "piece"
place = 0.5
integrator = "equilibrium"
newton = 20)",
                                              "stability_plane"));
  const Result none = run("run stability.toml --out none --sweeps nowhere");
  EXPECT_EQ(none.code, 2);
  EXPECT_NE(none.error.find("--sweeps nowhere is not in the experiment; it has vertex, "), std::string::npos)
      << none.error;
  ASSERT_EQ(run("run stability.toml --out one --sweeps iterations").code, 0);
  for (const Record& row : records_of("one")) EXPECT_EQ(row.get("sweep"), "iterations");
  const Result made = run("run stability.toml --out r");
  ASSERT_EQ(made.code, 0) << made.error << made.out;
  std::map<std::string, std::string> verdict, reason;
  std::map<std::string, double> explicit_step;
  for (const Record& row : records_of("r")) {
    const std::string& name = row.get("sweep");
    const std::string key = name + " " + row.get("method") + " " +
                            row.get(name == "vertex"       ? "place"
                                    : name == "explicit"   ? "step_share"
                                    : name == "iterations" ? "max_iterations"
                                                           : "pose_amount");
    verdict[key] = row.get("verdict");
    reason[key] = row.get("reason");
    if (name == "vertex") explicit_step[key] = std::stod(row.get("explicit_step_ratio"));
  }
  ASSERT_EQ(verdict.size(), 30u);
  const auto is = [&](const std::string& key, const std::string& what) {
    EXPECT_EQ(verdict[key], what) << key << ": " << reason[key];
  };
  for (const char* method : {"conventional_split", "snap_or_split", "split_and_tie"}) {
    const std::string m = std::string(" ") + method + " ";
    for (const char* place : {"0.2", "1e-06", "1e-12"}) is("vertex" + m + place, "ok");
    is("iterations" + m + "2", "solver_stalled");
    is("iterations" + m + "2000", "ok");
    is("turned_over" + m + "1.05", "ok");
    is("turned_over" + m + "-1", "inverted");
    is("piece_static" + m + "0", "solver_stalled");
    EXPECT_NE(reason["piece_static" + m + "0"].find("held nowhere"), std::string::npos);
  }
  // The sliver at a vertex breaks the explicit step of a split; snapping and constraints keep its limit.
  EXPECT_LT(explicit_step["vertex conventional_split 1e-06"], 1e-6);
  EXPECT_GT(explicit_step["vertex snap_or_split 1e-06"], 0.1);
  EXPECT_GT(explicit_step["vertex split_and_tie 1e-06"], 1e3 * explicit_step["vertex conventional_split 1e-06"]);
  EXPECT_NE(verdict["explicit conventional_split 0.1"], "ok");
  is("explicit conventional_split 1e-06", "ok");
  is("explicit snap_or_split 0.1", "ok");
  is("explicit split_and_tie 0.1", "refused");

  const Result drawn = run("methods >/dev/null; /usr/bin/python3 '" CUTBENCH_TEST_CASES
                           "/../../plots/figures/stability/stability.py' --results r/stability");
  EXPECT_EQ(drawn.code, 0) << drawn.error;
  EXPECT_GT(fs::file_size(folder_ / "r/stability/stability_near.png"), 10000u);
  const std::string table = read(folder_ / "r/stability/stability.md");
  for (const char* line : {"| conventional split | - | 1e-06 | 0.1 | ", "| snap or split | - | 0.1 | - | - |",
                           "| snap or split | cg | 2000 | 2 | solver stalled |",
                           "| split and tie | backward_euler, 1 | 1.05 | -1 | inverted |"})
    EXPECT_NE(table.find(line), std::string::npos) << line << "\n" << table;

  // Shares of the work make the same rows; a run that is there is not made again.
  for (const char* shard : {"1/2", "2/2"})
    ASSERT_EQ(run("run stability.toml --out s" + std::string(shard, 1) + " --shard " + shard).code, 0);
  std::vector<std::string> whole, parts;
  const auto keys = [&](const std::string& folder, std::vector<std::string>& to) {
    for (const Record& row : records_of(folder)) to.push_back(row.key(stability_key_columns()) + row.get("verdict"));
  };
  keys("r", whole);
  keys("s1", parts);
  keys("s2", parts);
  std::sort(whole.begin(), whole.end());
  std::sort(parts.begin(), parts.end());
  EXPECT_EQ(whole, parts);
}

/// Each time in the table of plots/figures/methods/whole_step.py is the cut's share of the cuts and the update, the
/// first step after them and as many more as 0.25 s have; and on a front what takes longer errs less.
TEST_F(Stability, WholeStepsAgainstErrors) {
  write(folder_ / "stability.toml", R"(claim = "c"
sheets = ["delaunay"]
resolutions = [800]
methods = ["conventional_split", "delaunay_refine", "edge_release", "longest_edge"]
)" + sweep("steps", R"(steps = 3
cut = "in_a_row"
place = [1.0, 4.0]
pose = "stretched"
pose_amount = 1.05
step_s = 0.016666666666666666
solver = ["multigrid", "cholmod"])"));
  ASSERT_EQ(run("run stability.toml --out r").code, 0);
  std::map<std::string, double> total;  // ms, by cuts, method and solver
  for (const Record& row : records_of("r")) {
    const auto number = [&](const char* column) { return std::stod(row.get(column)); };
    ASSERT_EQ(row.get("steps"), "3");
    EXPECT_GT(number("cut_update_us"), 0);
    total[row.get("place") + " " + row.get("method") + " " + row.get("solver")] =
        (number("cut_update_us") / number("place") + number("first_step_us") + 14 * number("step_us")) / 1000;
  }
  const Result drawn = run("methods >/dev/null; /usr/bin/python3 '" CUTBENCH_TEST_CASES
                           "/../../plots/figures/methods/whole_step.py' --results r/stability");
  ASSERT_EQ(drawn.code, 0) << drawn.error;
  for (const char* picture : {"whole_step.png", "whole_step_same_solver.png", "readme_chart.png"})
    EXPECT_GT(fs::file_size(folder_ / "r/stability" / picture), 10000u) << picture;

  const std::regex gap("  +");
  std::string front, setting;
  double ms_before = 0, error_before = 0;
  int rows = 0;
  for (const std::string& line : lines_of(read(folder_ / "r/stability/whole_step.txt"))) {
    if (line.starts_with("Fronts: ")) {
      front = line;
      setting = "";
    }
    const std::vector<std::string> cells(std::sregex_token_iterator(line.begin(), line.end(), gap, -1), {});
    if (front.empty() || cells.size() != 13 || cells[0] == "setting") continue;
    const double ms = std::stod(cells[4]), error = std::stod(cells[8]);
    const std::string name = cells[0].substr(0, 1) + " " + cells[1] + " " + cells[3];
    ASSERT_TRUE(total.contains(name)) << line;
    EXPECT_NEAR(ms, total[name], 1e-3 * ms) << line;
    if (cells[0] == setting) {
      EXPECT_GT(ms, ms_before) << line;
      EXPECT_LT(error, error_before) << line;
    }
    setting = cells[0];
    ms_before = ms;
    error_before = error;
    ++rows;
  }
  EXPECT_GE(rows, 8);  // two settings, two ways to choose the solver, two measures of the error
}

class Saboteur : public CuttingMethod {
 public:
  explicit Saboteur(bool hangs) : hangs_(hangs) {}
  void embed(Sheet&, Subdivision&, MethodNotes&) override {
    if (!hangs_) std::raise(SIGKILL);  // nobody, a sanitizer neither, can catch it
    for (volatile bool forever = true; forever;) {
    }
  }

 private:
  bool hangs_;
};

TEST_F(Stability, ACrashOrAHangCostsOneRow) {
  std::vector<MethodRow> rows{find_method("conventional_split"), find_method("conventional_split"),
                              find_method("conventional_split")};
  rows[1].name = "crashing";
  rows[1].factory = [](double) { return std::make_unique<Saboteur>(false); };
  rows[2].name = "hanging";
  rows[2].factory = [](double) { return std::make_unique<Saboteur>(true); };
  write(folder_ / "stability.toml", head(R"("crashing", "hanging", "conventional_split")") + "time_limit_s = 0.5\n" +
                                        sweep("cut", "cut = \"past_vertex\"\nplace = [0.1, 0.2]\n"));
  RunOptions options;
  options.out = folder_ / "r";
  options.quiet = true;
  options.workers = 2;
  EXPECT_FALSE(
      run_stability(read_experiment(folder_ / "stability.toml"), rows, gather_context(cholmod_version()), options));
  std::map<std::string, int> verdicts;
  for (const Record& row : records_of("r")) {
    ++verdicts[row.get("method") + " " + row.get("verdict")];
    EXPECT_EQ(row.get("reason"), row.get("verdict") == "ok" ? "" : "in the cut");
  }
  EXPECT_EQ(verdicts, (std::map<std::string, int>{
                          {"conventional_split ok", 2}, {"crashing crashed", 2}, {"hanging timed_out", 2}}));
}

/// The settings are in two tables: that of sweeps, and that of all columns.
TEST(StabilityColumns, SettingsFollowTheKeysAndEndBeforeTheStatus) {
  std::size_t column = key_columns;
  for (const SweepSetting& setting : sweep_settings()) EXPECT_EQ(stability_columns().at(column++), setting.name);
  EXPECT_EQ(stability_columns().at(column), "status");
  EXPECT_EQ(column, stability_key_columns());
}

TEST_F(Stability, RefusesWrongSweeps) {
  const auto says = [&](const std::string& text) {
    write(folder_ / "stability.toml", text);
    const Result result = run("run stability.toml --out r");
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(lines_of(result.error).size(), 1u) << result.error;
    return result.error;
  };
  const std::string start = head("\"example\"");
  for (const auto& [bad, message] : std::vector<std::pair<std::string, const char*>>{
           {start + sweep("a", "stepp_s = 1.0"), "unknown key \"stepp_s\"; did you mean \"step_s\""},
           {start + sweep("a", "solver = [\"cg\", \"gauss\"]"), "solver \"gauss\" is not known"},
           {start + sweep("a", "integrator = \"xpbd\""), "xpbd does not account for"},
           {start + sweep("a", "poisson = 0.5"), "\"poisson\" must be from 0 to below 0.5"},
           {start + sweep("a", "place = []"), "\"place\" must be a list with at least one entry"},
           {start + sweep("a", "cut = \"past_vertx\""), "cut \"past_vertx\" is not known; known are past_vertex"},
           {start + sweep("a", "pose = \"rolled_up\""), "pose \"rolled_up\" is not known"},
           {start + sweep("a", "resolutions = [800]"), "800 is not one of the experiment's"},
           {start + sweep("a", "sheets = [\"grid\"]"), "a sweep's sheet \"grid\" is not known"},
           {start + sweep("a", "") + sweep("a", ""), "names something twice"},
           {start + "[[sweeps]]\nname = \"a\"\nscene = \"none.toml\"\n", "none.toml: can't be read"}})
    EXPECT_NE(says(bad).find(message), std::string::npos) << says(bad);
}

}  // namespace
}  // namespace cutbench
