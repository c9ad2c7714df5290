// Programs as methods: what they make is taken over or judged wrong, and whatever they do costs one row.
#include "harness/programs/program.h"

#include <nlohmann/json.hpp>

#include "harness/base/errors.h"
#include "harness/cases/cut_families.h"
#include "harness/files/path_file.h"
#include "tests/helpers.h"
#include "tests/program.h"

namespace cutbench {
namespace {

const std::string split = "python3 " CUTBENCH_EXPERIMENTS "/examples/split.py {mesh} {path} {out}";

std::string to_text(const Promises& p) {
  std::ostringstream text;
  text << p.exact_incision << p.keeps_area << p.conforming << p.keeps_vertices << ' ' << p.incision_bound.longest_edges
       << ' ' << p.incision_bound.chord_tolerances;
  return text.str();
}

class Programs : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    write_mesh(lifted(make_sheet("delaunay", 10)), folder_ / "sheet.obj");
  }
  Result cut_by(const std::string& command, const std::string& more = "") {
    return run("cut --mesh sheet.obj --path path.json --out out.obj --report report.json --command '" + command + "' " +
               more);
  }
  std::vector<Record> records(const std::string& stem) {
    const std::vector<std::string> lines = lines_of(read(folder_ / "r" / stem / "records.csv"));
    std::vector<std::string> names;
    std::istringstream head(lines.at(0));
    for (std::string name; std::getline(head, name, ',');) names.push_back(name);
    columns_.push_back(std::make_unique<std::vector<std::string>>(names));
    std::vector<Record> rows;
    for (std::size_t i = 1; i < lines.size(); ++i) rows.emplace_back(*columns_.back(), lines[i]);
    return rows;
  }
  std::vector<std::unique_ptr<std::vector<std::string>>> columns_;
};

TEST_F(Programs, CutASheet) {
  const Result made = cut_by(split);
  EXPECT_EQ(made.code, 0) << made.error;
  EXPECT_EQ(made.out.substr(0, 4), "ok: ");
  const auto report = nlohmann::json::parse(read(folder_ / "report.json"));
  EXPECT_EQ(report["verdict"], "ok");
  EXPECT_GT(report["process_us"], 0);
  EXPECT_EQ(report["geometry_us"], report["process_us"]);
  EXPECT_TRUE(report["embed_us"].is_null());
  EXPECT_EQ(run("score --mesh sheet.obj --path path.json --result out.obj").code, 0);
}

/// The method element_deletion as a program: it is judged, and taken over, as the method is.
TEST_F(Programs, MayDeleteTriangles) {
  EXPECT_EQ(to_text(promises_of_deleting_programs), to_text(find_method("element_deletion").promises));
  const std::string program =
      std::string(CUTBENCH_PROGRAM) + " cut --mesh {mesh} --path {path} --out {out} --method element_deletion";
  const std::vector<std::string> cuts{R"({"cuts":[{"polyline":[[0.21,0.33],[0.52,0.41],[0.83,0.64]]}]})",
                                      R"({"cuts":[{"polyline":[[0.2,0.7],[0.7,0.2],[0.9,0.9]]}]})",  // across the first
                                      R"({"cuts":[{"polyline":[[0,0.5],[1,0.5]]}]})",  // along edges of the grid
                                      R"({"cuts":[{"bezier":[[-0.1,0.3],[0.3,0.9],[0.6,0.1],[1.1,0.7]]}]})"};
  for (const std::string family : {"delaunay", "grid"}) {
    write_mesh(lifted(make_sheet(family, 10)), folder_ / "by_program.obj");
    write_mesh(lifted(make_sheet(family, 10)), folder_ / "by_method.obj");
    for (const std::string& path : cuts) {
      write(folder_ / "path.json", path);
      const Result made =
          run("cut --mesh by_program.obj --path path.json --out by_program.obj --deletes --command '" + program + "'");
      const Result own = run("cut --mesh by_method.obj --path path.json --out by_method.obj --method element_deletion");
      EXPECT_EQ(made.code, own.code) << path << made.error << own.error;
      EXPECT_EQ(made.out.substr(0, made.out.find(" pieces")), own.out.substr(0, own.out.find(" pieces")));
    }
    const Sheet a(read_mesh(folder_ / "by_program.obj")), b(read_mesh(folder_ / "by_method.obj"));
    EXPECT_EQ(a.triangle_count(), b.triangle_count());
    EXPECT_EQ(a.deformed_count(), b.deformed_count()) << "as many vertices: the same is open";
  }
  const Result without = cut_by(program);
  EXPECT_EQ(without.code, 1);
  EXPECT_NE(without.error.find("lost_triangle"), std::string::npos) << without.error;
  EXPECT_EQ(cut_by(split, "--deletes").code, 1) << "it divides";
  EXPECT_EQ(run("cut --mesh sheet.obj --path path.json --out out.obj --method example --deletes").code, 2);
}

TEST_F(Programs, ThatDeleteAreRowsOfAComparison) {
  const std::string program =
      std::string(CUTBENCH_PROGRAM) + " cut --mesh {mesh} --path {path} --out {out} --method element_deletion";
  std::string experiment = small_experiment();
  const std::size_t begin = experiment.find("methods = ");
  experiment.replace(
      begin, experiment.find('\n', begin) - begin,
      "methods = [\"element_deletion\", {name = \"named\", deletes = true, command = \"" + program + "\"}]");
  write(folder_ / "e.toml", experiment);
  const Result made = run("run e.toml --cases 1 --out r --command 'given=" + program + "' --deletes given");
  ASSERT_EQ(made.code, 0) << made.error;
  std::map<std::string, std::vector<std::string>> by_method;
  for (const Record& row : records("e"))
    if (row.get("repetition") == "0")
      by_method[row.get("method")].push_back(row.get("status") + row.get("verdict") + row.get("triangles_added") +
                                             row.get("pieces"));
  EXPECT_EQ(by_method["named"], by_method["element_deletion"]);
  EXPECT_EQ(by_method["given"], by_method["element_deletion"]);
  EXPECT_EQ(run("run e.toml --cases 1 --out r --deletes none").code, 2);
}

TEST_F(Programs, TheirOwnTimeCounts) {
  EXPECT_EQ(cut_by(split + " && echo \"{\\\"us\\\": 12.5}\" >{time}").code, 0);
  EXPECT_EQ(nlohmann::json::parse(read(folder_ / "report.json"))["process_us"], 12.5);
}

TEST_F(Programs, ATimeThatIsMissingIsNoted) {
  for (const std::string time : {": {time}", "echo 12.5 >{time}"}) {
    const Result made = cut_by(split + " && " + time);
    EXPECT_EQ(made.code, 0);
    EXPECT_EQ(made.error, "note: program wrote no {\"us\": NUMBER} to {time}; its time from start to end counts\n");
  }
}

TEST_F(Programs, EachFailureIsNamed) {
  struct Case {
    std::string command, more;
    int code;
    std::string what;
  };
  const std::string unused = " # {mesh} {path} {out}";
  for (const Case& c : std::vector<Case>{
           {"exit 2" + unused, "", 1, "failed (crashed): exit code 2"},
           {"python3 none.py" + unused, "", 1, "can't open file"},
           {"echo first >&2; echo the reason >&2; exit 1" + unused, "", 1, "failed (crashed): exit code 1: the reason"},
           {"kill -SEGV $$" + unused, "", 1, "failed (crashed): ended by signal 11"},
           {"sh -c \"echo the reason >&2; kill -ABRT \\$\\$\"; exit $?" + unused, "", 1, "6 (Aborted): the reason"},
           {"sleep 60" + unused, "--command-time-limit 0.3", 1, "failed (timed_out): ended at its time limit"},
           {"sleep 60 & while :; do :; done" + unused, "--command-time-limit 0.3", 1, "failed (timed_out): "},
           {"python3 -c \"x = bytearray(10**9)\"" + unused, "--command-memory-limit 200", 1,
            "failed (crashed): exit code 1: MemoryError"},
           {"echo too hard >&2; exit 3" + unused, "", 2, "program refuses this cut: too hard"},
           {"true" + unused, "", 1, "failed (no_result): the program ended well, but wrote no {out}"},
           {"echo nonsense >{out}" + unused, "", 1, "failed (no_result): out.obj: no triangles"},
           {"cp {mesh} {out}" + unused, "", 1, "failed (wrong_pieces): not_opened: the path at ("},
           {"no_such_program" + unused, "", 1, "failed (crashed): exit code 127: "},
           {"cp {mesh} {out}", "", 2, "its command lacks {path}; such as: "}}) {
    const Result made = cut_by(c.command, c.more);
    EXPECT_EQ(made.code, c.code) << c.command << made.error;
    EXPECT_NE(made.error.find(c.what), std::string::npos) << c.command << '\n' << made.error;
    EXPECT_FALSE(fs::exists(folder_ / "out.obj"));
  }
  EXPECT_EQ(run("cut --mesh sheet.obj --path path.json --out out.obj").code, 2);
  EXPECT_EQ(
      run("cut --mesh sheet.obj --path path.json --out out.obj --method example --command 'x {mesh}{path}{out}'").code,
      2);
}

/// A cut is wrong for the same reason, in the same words, whether `cut` or `score` judges it.
TEST_F(Programs, AreJudgedAsScoreJudges) {
  const std::string kept = " && cp {out} kept.obj";
  for (const auto& [command, verdict] : std::vector<std::pair<std::string, std::string>>{
           {split + " && sed -E -i \"s/([.][0-9]{6})[0-9]+/\\1/g\" {out}", "rounded"},
           {"cat {path} >/dev/null; cp {mesh} {out}", "wrong_pieces"},
           {split + " && sed -E -i \"s/^f ([0-9]+) ([0-9]+)/f \\2 \\1/\" {out}", "inverted"},
           {split + " && sed -i \"\\$ d\" {out}", "unused_vertex"}}) {
    const Result made = cut_by(command + kept);
    EXPECT_EQ(made.code, 1) << command << made.error;
    const Result scored = run("score --mesh sheet.obj --path path.json --result kept.obj");
    EXPECT_EQ(scored.code, 1);
    const std::vector<std::string> lines = lines_of(scored.out);
    ASSERT_GE(lines.size(), 3u) << scored.out << scored.error;
    EXPECT_EQ(lines[0], "failed: " + verdict);
    EXPECT_EQ(made.error, "failed (" + verdict + "): " + lines[1] + "\n" + lines[2] + "\n");
    EXPECT_EQ(lines[2].substr(0, 6), "mend: ");
  }
}

/// The second cut runs beside the first within the snap distance. The oracle allows for such a result, but a sheet that
/// took it over was broken, and the third cut ended by an internal error.
TEST_F(Programs, AResultTooCloseToItselfIsRefused) {
  write_mesh(make_sheet("graded", 6), folder_ / "sheet.obj");
  write(
      folder_ / "path.json",
      R"({"cuts":[{"polyline":[[0.5967568027844311,0.30112806395172453],[0.398799080976413,0.7039807385691422],)"
      R"([0.9967200980491203,0.0016368765536538816],[0.8410462482739741,0.34855717342487513],)"
      R"([0.4656824756620728,0.27567981533165953],[1.0697074778404851,0.3929520445473573]]},)"
      R"({"polyline":[[0.8410462482746501,0.3485571734233654],[0.46568247566207366,0.2756798153316598]]},)"
      R"({"closed":true,"polyline":[[0.6408600646157762,0.09581844004706838],[0.6408600388758943,0.09581844597755454],)"
      R"([0.6408600335288995,0.09581845355750129],[0.6408600685304696,0.09581846423666042],)"
      R"([0.6408600239324022,0.0958184462691079],[0.6408600723130384,0.09581844141539649]]}]})");
  const Result made = cut_by(CUTBENCH_CGAL_PROGRAM " {mesh} {path} {out}");
  EXPECT_EQ(made.code, 2) << made.error;
  EXPECT_NE(made.error.find("too close together"), std::string::npos) << made.error;
}

/// Nothing that a program started goes on after its time.
TEST_F(Programs, LeaveNothingRunning) {
  cut_by("(sleep 0.8; touch " + quoted((folder_ / "late").string()) + ") & sleep 60; : {mesh} {path} {out}",
         "--command-time-limit 0.2");
  ::usleep(1200000);
  EXPECT_FALSE(fs::exists(folder_ / "late"));
}

std::string methods_with_programs() {
  return "methods = [\"conventional_split\", {name = \"mine\", command = \"" + split +
         "\"}, {name = \"closed\", command = \"cp {mesh} {out} # {path}\"}, {name = \"dies\", command = \"exit 1 # "
         "{mesh} {path} {out}\"}]\n";
}

TEST_F(Programs, AreRowsOfAComparison) {
  write(folder_ / "e.toml",
        "claim = \"c\"\nsheets = [\"grid\", \"delaunay\"]\nresolutions = [200]\ncut_families = [\"curved\", "
        "\"recut\"]\ncases = 2\nrepetitions = 2\neigenvalue_cases = 1\n" +
            methods_with_programs() + "scene = \"scene.toml\"\ncut_time = 0.05\nscene_cases = 1\n");
  write(folder_ / "scene.toml",
        "effect = \"e\"\ntruth = \"none\"\nduration = 0.2\n[sheet]\nfamily = \"grid\"\nsize = 1.0\nresolution = 200\n"
        "[material]\ndensity = 2.2\nstiffness = 1000.0\n[physics]\ngravity = [0.0, 0.0, -9.81]\n[[pins]]\nbox = "
        "[[-inf, -inf], [0.0, inf]]\n");
  EXPECT_EQ(run("run e.toml --out r").code, 1);  // two of the programs are wrong
  std::map<std::string, int> rows;
  for (const Record& row : records("e")) {
    const std::string &method = row.get("method"), &cache = row.get("cache");
    ++rows[method + " " + cache];
    if (method == "closed") {
      EXPECT_EQ(row.get("status"), "failed");
      EXPECT_TRUE(row.get("verdict") == "wrong_pieces" || row.get("verdict") == "incision") << row.line();
    }
    if (method == "dies") {
      EXPECT_EQ(row.get("verdict"), "crashed");
    }
    if (method != "mine") continue;
    EXPECT_EQ(row.get("verdict"), "ok") << row.line();
    EXPECT_NE(row.get("process_us"), "");
    EXPECT_EQ(row.get("embed_us"), "");
    if (row.get("repetition") == "0" && cache == "warm") {
      EXPECT_NE(row.get("ar_max_cut"), "");
      EXPECT_NE(row.get("incision_error_h"), "");
      EXPECT_EQ(row.get("eigenvalue_ratio") != "", row.get("case") == "0");
    }
    if (cache == "simulation") {  // interpolated positions: hardly a jump
      EXPECT_LE(std::abs(std::stod(row.get("membrane_jump_j"))), 1e-6 * std::stod(row.get("membrane_j")) + 1e-20);
    }
  }
  for (const std::string method : {"conventional_split", "mine", "closed", "dies"}) {
    EXPECT_EQ(rows[method + " warm"], 16) << method;
    EXPECT_EQ(rows[method + " simulation"], 4) << method;
  }
}

TEST_F(Programs, AreRowsOfAnAccuracyRun) {
  write(folder_ / "a.toml", "claim = \"c\"\nsheets = [\"grid\"]\nresolutions = [200]\n" + methods_with_programs() +
                                "[accuracy]\nproblems = [\"centre_crack\"]\nmembers = [1]\ndirect = [\"cholmod\"]\n");
  EXPECT_EQ(run("run a.toml --out r").code, 1);
  std::map<std::string, std::string> errors;
  for (const Record& row : records("a")) errors[row.get("method")] = row.get("error");
  EXPECT_EQ(errors.size(), 5u);
  EXPECT_LT(std::stod(errors["mine"]), 2 * std::stod(errors["conventional_split"]));
  EXPECT_EQ(errors["closed"], "");
}

TEST_F(Programs, AreCountedByARobustnessRun) {
  write(folder_ / "c.toml", "claim = \"c\"\nsheets = [\"delaunay\"]\nresolutions = [72]\ncases = 4\n" +
                                methods_with_programs() + "[robustness]\ntime_limit_s = 60\n");
  EXPECT_EQ(run("run c.toml --out r").code, 1);
  std::map<std::string, std::map<std::string, int>> counts;
  for (const Record& row : records("c"))
    for (const char* count : {"tried", "ok", "noop", "wrong", "crashed"})
      counts[row.get("method")][count] += std::stoi(row.get(count));
  EXPECT_EQ(counts["closed"]["ok"], 0);
  EXPECT_GT(counts["closed"]["wrong"], 0);
  EXPECT_GT(counts["dies"]["crashed"], 0);
  EXPECT_GT(counts["mine"]["ok"], 0);
}

/// The same method in two languages, and a triangulation that is another one.
TEST_F(Programs, ExamplesCutRight) {
  const std::string files = " {mesh} {path} {out}";
  for (const char* family : {"straight", "curved", "partial", "cut_out", "self_crossing"})
    for (std::size_t i = 0; i < 3; ++i) {
      const Sheet sheet(read_mesh(folder_ / "sheet.obj"));
      write_path(make_case(family, 9, i, sheet), folder_ / "path.json");
      SCOPED_TRACE(read(folder_ / "path.json"));
      std::vector<nlohmann::json> reports;
      for (const std::string& command : {split, CUTBENCH_SPLIT_PROGRAM + files, CUTBENCH_CGAL_PROGRAM + files}) {
        const Result made = cut_by(command);
        EXPECT_EQ(made.code, 0) << family << ' ' << i << ' ' << command << made.error;
        reports.push_back(nlohmann::json::parse(read(folder_ / "report.json")));
      }
      EXPECT_EQ(reports[0]["pieces"], reports[1]["pieces"]);
      EXPECT_NEAR(reports[0]["vertices_added"], reports[1]["vertices_added"], 2);  // edges come in another order
      EXPECT_EQ(reports[0]["pieces"], reports[2]["pieces"]);
    }
}

/// Opens nothing, but only where the path has more than four points.
TEST_F(Programs, FaultsAreMadeSmall) {
  write(folder_ / "faulty.py", read(fs::path(CUTBENCH_EXPERIMENTS) / "examples" / "split.py") +
                                   "    if len(json.load(open(sys.argv[2]))['cuts'][0]['polyline']) > 4:\n"
                                   "        open(sys.argv[3], 'w').write(open(sys.argv[1]).read())\n");
  write(
      folder_ / "long.json",
      R"({"cuts":[{"polyline":[[-0.1,0.3],[0.2,0.4],[0.3,0.6],[0.5,0.5],[0.6,0.3],[0.7,0.5],[0.8,0.4],[1.2,0.7]]}]})");
  const std::string command = " --command 'python3 faulty.py {mesh} {path} {out}'";
  const Result made = run("reduce --mesh sheet.obj --path long.json --out fault --seconds 8" + command);
  ASSERT_EQ(made.code, 0) << made.error;
  EXPECT_NE(made.out.find("wrong_pieces"), std::string::npos) << made.out;
  const MeshData small = read_mesh(folder_ / "fault.small.obj");
  EXPECT_LT(small.triangles.size(), 20u);
  EXPECT_EQ(read_path(folder_ / "fault.small.json").front().points.size(), 5u);
  EXPECT_EQ(run("cut --mesh fault.small.obj --path fault.small.json --out out.obj" + command).code, 1);
  const std::string drawing = read(folder_ / "fault.small.svg");
  EXPECT_EQ(drawing.substr(0, 4), "<svg");
  const std::vector<std::string> told = lines_of(read(folder_ / "fault.txt"));  // of the smaller one last
  const auto small_part =
      std::find_if(told.begin(), told.end(), [](const std::string& line) { return line.starts_with("fault.small: "); });
  ASSERT_LT(small_part + 1, told.end());
  const std::string its_fault = (small_part + 1)->substr((small_part + 1)->find("cut 1 "));
  EXPECT_NE(drawing.find(its_fault), std::string::npos) << drawing.substr(drawing.find("<text"));
  const Result right = run("reduce --mesh sheet.obj --path path.json --out none --method example");
  EXPECT_EQ(right.code, 2);
  EXPECT_NE(right.error.find("nothing to reduce: example cuts this sheet right"), std::string::npos) << right.error;
}

TEST_F(Programs, CanBeAddedToAnExperiment) {
  write(folder_ / "e.toml", small_experiment());
  EXPECT_EQ(run("run e.toml --out r --cases 1 --methods conventional_split --command 'mine=" + split + "'").code, 0);
  std::set<std::string> methods;
  for (const Record& row : records("e")) methods.insert(row.get("method"));
  EXPECT_EQ(methods, (std::set<std::string>{"conventional_split", "mine"}));
  for (const auto& [command, what] :
       {std::pair<std::string, std::string>{"python3", "give NAME=COMMAND"},
        {"mine=python3 x.py", "its command lacks {mesh}"},
        {"a,b=x {mesh} {path} {out}", "the name of a method has letters"},
        {"conventional_split=x {mesh} {path} {out}", "has the name of a method; choose another"}}) {
    const Result refused = run("run e.toml --out r --command '" + command + "'");
    EXPECT_EQ(refused.code, 2);
    EXPECT_NE(refused.error.find(what), std::string::npos) << refused.error;
  }
}

/// Not one line of the table, but nothing in the medians: a mistake in a command must not look like success.
TEST_F(Programs, ThatMakeNoCutAreNamed) {
  write(folder_ / "e.toml", small_experiment());
  write(folder_ / "c.toml",
        "claim = \"c\"\nsheets = [\"delaunay\"]\nresolutions = [72]\ncases = 4\nmethods = "
        "\"all\"\n[robustness]\ntime_limit_s = 60\n");
  write(folder_ / "a.toml",
        "claim = \"c\"\nsheets = [\"grid\"]\nresolutions = [200]\nmethods = \"all\"\n[accuracy]\n"
        "problems = [\"centre_crack\"]\nmembers = [1]\nreference = false\ndirect = [\"cholmod\"]\n");
  const auto run_alone = [&](const std::string& experiment, const std::string& command) {
    return run("run " + experiment + " --out r --cases 1 --methods mine --command 'mine=" + command +
               " # {mesh} {path} {out}'");
  };
  for (const char* experiment : {"e.toml", "a.toml", "c.toml"}) {
    const Result missing = run_alone(experiment, "python3 none.py");
    EXPECT_EQ(missing.code, 1) << experiment;
    EXPECT_NE(missing.error.find("can't open file"), std::string::npos) << missing.error;
    const Result refuses = run_alone(experiment, "echo too hard >&2; exit 3");
    EXPECT_EQ(refuses.code, 1) << experiment;
    EXPECT_NE(refuses.error.find(": mine made none of its "), std::string::npos) << refuses.error;
    EXPECT_NE(refuses.error.find(" results right; the last: refused: too hard\n"), std::string::npos) << refuses.error;
    const std::vector<std::string> table = lines_of(refuses.out);
    EXPECT_TRUE(std::any_of(table.begin(), table.end(), [](const std::string& line) {
      return line.find("mine") != std::string::npos;
    })) << refuses.out;
  }
  const Result right = run("run e.toml --out r --cases 1 --methods mine --command 'mine=" + split + "'");
  EXPECT_EQ(right.code, 0);
  EXPECT_EQ(right.error.find("none of its"), std::string::npos) << right.error;
  for (const Record& row : records("e")) EXPECT_EQ(row.get("method"), "mine");
}

}  // namespace
}  // namespace cutbench
