// Accuracy runs through the program and, for methods that do wrong on purpose, through the harness: which rows there
// are, that they agree with each other, and that a killed run goes on.

#include "harness/study/accuracy.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "harness/fem/linear/factor.h"
#include "harness/problems/common/problem.h"
#include "methods/registry.h"
#include "tests/program.h"

namespace cutbench {
namespace {

std::vector<Record> rows_of(const fs::path& records) {
  const auto lines = lines_of(read(records));
  std::vector<Record> rows;
  for (std::size_t i = 1; i < lines.size(); ++i) rows.emplace_back(accuracy_columns(), lines[i]);
  return rows;
}

double number(const Record& row, const std::string& column) { return std::stod(row.get(column)); }

/// Everything but the times.
std::vector<std::string> without_times(std::vector<Record> rows) {
  std::vector<std::string> lines;
  for (Record& row : rows) {
    for (const auto& column : accuracy_columns())
      if (column.ends_with("_us")) row.set(column, std::string());
    lines.push_back(row.line());
  }
  return lines;
}

class Accuracy : public Program {
 protected:
  static constexpr const char* methods = "[\"conventional_split\", {name = \"bowyer_watson\", parameter = [0, 1]}]";
  static std::string experiment(const std::string& more = "", const std::string& problems = "\"centre_crack\"") {
    return std::string("claim = \"c\"\nsheets = [\"delaunay\"]\nresolutions = [32, 72]\nmethods = ") + methods + "\n" +
           more + "[accuracy]\nproblems = [" + problems + "]\nmembers = [2, 1]\ndirect = [\"cholmod\"]\n" +
           "preconditioners = [\"cg\", \"cg_sliver_blocks\"]\niterations = [5, 500]\n";
  }
  std::vector<Record> run_and_read(const std::string& arguments, const std::string& out) {
    const Result result = run("run e.toml --out " + out + " " + arguments);
    EXPECT_EQ(result.code, 0) << result.error << result.out;
    return rows_of(folder_ / out / "e/records.csv");
  }
};

constexpr std::size_t budgets = 1 + 2 * 2;
constexpr std::size_t cases = 2 * (2 + 1);  // problems x members

TEST_F(Accuracy, CasesAreMembers) {
  write(folder_ / "e.toml", experiment());
  std::set<std::string> members;
  for (const Record& row : run_and_read("--cases 3 --resolutions 72 --methods conventional_split", "r"))
    members.insert(row.get("case"));
  EXPECT_EQ(members, (std::set<std::string>{"0", "1", "2"}));
}

TEST_F(Accuracy, EveryRowIsThereAndAddsUp) {
  write(folder_ / "e.toml", experiment("", "\"centre_crack\", \"parallel_stress\""));
  const auto rows = run_and_read("", "r");
  ASSERT_EQ(rows.size(), cases * 4 * budgets);  // three variants and the reference
  std::map<std::string, const Record*> reference;
  std::map<std::string, double> direct;
  const auto place = [](const Record& row) {
    return row.get("problem") + row.get("sheet") + row.get("resolution") + "," + row.get("case");
  };
  for (const Record& row : rows)
    if (row.get("method") == reference_method && row.get("budget") == "0") reference[place(row)] = &row;
  ASSERT_EQ(reference.size(), cases);
  std::size_t far_off = 0;
  for (const Record& row : rows) {
    SCOPED_TRACE(row.line());
    EXPECT_EQ(row.get("verdict"), "ok");
    EXPECT_NEAR(number(row, "total_us"),
                number(row, "cut_us") + number(row, "assemble_us") + number(row, "setup_us") + number(row, "solve_us"),
                1e-6 * number(row, "total_us"));
    EXPECT_GT(number(row, "unknowns"), 0);
    EXPECT_GE(number(row, "triangles"), row.get("method") == reference_method ? 1 : number(row, "resolution"));
    EXPECT_LE(number(row, "iterations"), number(row, "budget"));
    EXPECT_EQ(row.get("primary"), find_problem(row.get("problem")).measures().front());
    EXPECT_EQ(row.get("error"), row.get("error_" + row.get("primary")));
    EXPECT_EQ(row.get("excess_error"), row.get("excess_" + row.get("primary")));
    for (const std::string& measure : find_problem(row.get("problem")).measures()) {
      const double of_reference = number(*reference.at(place(row)), "error_" + measure);
      const std::string& excess = row.get("excess_" + measure);
      EXPECT_EQ(excess.empty(), of_reference <= 1e-9) << measure;  // an exact answer is no measuring stick
      if (!excess.empty()) {
        EXPECT_NEAR((1 + std::stod(excess)) * of_reference, number(row, "error_" + measure), 1e-9);
      }
    }
    for (const std::string& column : accuracy_columns())
      if (column.starts_with("error_") && !row.get(column).empty()) {
        const auto measures = find_problem(row.get("problem")).measures();
        EXPECT_NE(std::find(measures.begin(), measures.end(), column.substr(6)), measures.end()) << column;
      }
    // So many iterations reach on these small sheets what the direct solve does; a few do not.
    if (row.get("budget") == "0") direct[row.key()] = number(row, "error");
    if (row.get("budget") == "500") {
      EXPECT_NEAR(number(row, "error"), direct.at(row.key()), 1e-4 * direct.at(row.key()) + 1e-7);
    }
    if (row.get("budget") == "5") {
      EXPECT_EQ(number(row, "iterations"), 5);
      far_off += std::abs(number(row, "error") - direct.at(row.key())) > 0.01;
    }
  }
  EXPECT_GT(far_off, rows.size() / 2 / budgets);
}

TEST_F(Accuracy, RunsAreTheSameAndShardsPartThem) {
  write(folder_ / "e.toml", experiment());
  const auto whole = without_times(run_and_read("", "whole"));
  EXPECT_EQ(without_times(run_and_read("", "again")), whole);
  EXPECT_NE(without_times(run_and_read("--seed 2", "other")), whole);
  auto both = without_times(run_and_read("--shard 1/2", "one")),
       two = without_times(run_and_read("--shard 2/2", "two"));
  EXPECT_FALSE(two.empty());
  both.insert(both.end(), two.begin(), two.end());
  EXPECT_TRUE(std::is_permutation(both.begin(), both.end(), whole.begin(), whole.end()));
  const auto part = run_and_read("--methods conventional_split --resolutions 72", "part");
  EXPECT_EQ(part.size(), 2 * budgets);
  for (const Record& row : part) EXPECT_EQ(row.get("resolution"), "72");
}

TEST_F(Accuracy, ProblemsOfManySolvesHaveMembersOfTheirOwn) {
  std::string text = experiment("", "\"centre_crack\", \"bending_patch_slit\"");
  text.replace(text.find("[2, 1]\n"), 6, "[2, 1]\nmembers_nonlinear = [0, 1]");
  write(folder_ / "e.toml", text);
  const auto rows = run_and_read("--methods conventional_split", "r");
  ASSERT_EQ(rows.size(), 3 * 2 * budgets + 2);  // by the reference and the method; the patch is solved directly alone
  for (const Record& row : rows) {
    EXPECT_TRUE(row.get("problem") == "centre_crack" || row.get("resolution") == "72");
    EXPECT_EQ(row.get("verdict"), "ok") << row.line();
  }
}

/// Solved directly, in the plane, by methods that constrain no vertex.
TEST_F(Accuracy, TipFunctionsAreRowsOfTheirOwn) {
  std::string text = experiment("", "\"centre_crack\", \"bending_patch_slit\"");
  text.replace(text.find(methods), std::string(methods).size(), "[\"conventional_split\", \"split_and_tie\"]");
  text.replace(text.find("[32, 72]"), 8, "[200, 288]");  // with room for the functions
  write(folder_ / "e.toml", text + "tip_functions = true\nreference = false\nmembers_nonlinear = [1, 0]\n");
  EXPECT_EQ(run("run e.toml --out r").code, 1);  // a refusal is no success
  std::map<std::string, std::size_t> with, without;
  for (const Record& row : rows_of(folder_ / "r/e/records.csv")) {
    SCOPED_TRACE(row.line());
    const std::string what = row.get("problem") + " by " + row.get("method");
    if (row.get("tip_functions") == "0") {
      ++without[what];
      EXPECT_TRUE(row.get("value_tip_k1").empty());
      continue;
    }
    ++with[what];
    EXPECT_EQ(row.get("solver") + row.get("budget"), "cholmod0");
    const bool refused = row.get("method") == "split_and_tie";
    EXPECT_EQ(row.get("status"), refused ? "refused" : "ok");
    EXPECT_EQ(row.get("reason").empty(), !refused);
    EXPECT_EQ(row.get("error").empty(), refused);
    EXPECT_EQ(row.get("value_tip_k1").empty(), refused);
  }
  EXPECT_EQ(with, (std::map<std::string, std::size_t>{{"centre_crack by conventional_split", 3},
                                                      {"centre_crack by split_and_tie", 3}}));
  EXPECT_EQ(without["centre_crack by conventional_split"], 3 * budgets);
  EXPECT_EQ(without["bending_patch_slit by conventional_split"], 1u);
}

TEST_F(Accuracy, WithoutAReferenceNothingIsRanked) {
  std::string text = experiment();
  text.replace(text.find("members"), 0, "reference = false\n");
  write(folder_ / "e.toml", text);
  const auto rows = run_and_read("--methods conventional_split", "r");
  ASSERT_EQ(rows.size(), 3 * budgets);
  for (const Record& row : rows) {
    EXPECT_EQ(row.get("method"), "conventional_split");
    EXPECT_FALSE(row.get("error").empty());
    EXPECT_TRUE(row.get("excess_error").empty());
  }
}

/// As a kill leaves it, in the middle of a case: some rows, and a line cut short.
TEST_F(Accuracy, AKilledRunGoesOn) {
  write(folder_ / "e.toml", experiment());
  const auto whole = without_times(run_and_read("", "whole"));
  fs::create_directories(folder_ / "r/e/records.csv/in_the_way");  // so that the run ends without its records
  EXPECT_EQ(run("run e.toml --out r").code, 1);
  fs::remove_all(folder_ / "r/e/records.csv");
  const fs::path part = folder_ / "r/e/records.csv.part";
  const auto lines = lines_of(read(part));
  ASSERT_EQ(lines.size(), 1 + whole.size());
  const std::size_t kept = 4 * budgets + budgets + 2;  // a case, its reference, and two rows of a method
  std::string text = lines[0] + "\n";
  for (std::size_t i = 1; i <= kept; ++i) {
    Record row(accuracy_columns(), lines[i]);
    row.set("cut_us", 12345.0);  // to know it again
    text += row.line() + "\n";
  }
  write(part, text + lines[kept + 1].substr(0, 40));
  const Result again = run("run e.toml --out r");
  EXPECT_EQ(again.code, 0) << again.error;
  EXPECT_NE(again.error.find("resumed, " + std::to_string(kept) + " rows"), std::string::npos) << again.error;
  const auto rows = rows_of(folder_ / "r/e/records.csv");
  EXPECT_EQ(without_times(rows), whole);
  for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(rows[i].get("cut_us") == "12345", i < kept) << i;
}

TEST_F(Accuracy, BadExperimentsAreRefused) {
  const std::string good = experiment();
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return text.replace(text.find(from), from.size(), to);
  };
  for (const auto& [text, what] :
       {std::pair<std::string, const char*>{with("centre_crack", "nonsense"), "centre_crack"},
        {with("[2, 1]", "[2]"), "as many numbers"},
        {with("[2, 1]", "[2, 0]"), "from 1"},
        {with("[5, 500]", "[5, 0]"), "from 1"},
        {with("\"cholmod\"", "\"lu\""), "known are"},
        {with("direct", "directt"), "did you mean \"direct\""},
        {with("[5, 500]", "[5, 5]"), "twice"},
        {experiment("cases = 3\n"), "cases"}}) {
    SCOPED_TRACE(text);
    write(folder_ / "e.toml", text);
    const Result result = run("run e.toml --out r");
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(lines_of(result.error).size(), 1u) << result.error;
    EXPECT_NE(result.error.find(what), std::string::npos) << result.error;
    EXPECT_FALSE(fs::exists(folder_ / "r"));
  }
}

/// Does its work well, but for its name.
class Saboteur : public CuttingMethod {
 public:
  explicit Saboteur(bool refuses) : refuses_(refuses), method_(find_method("conventional_split").make(0)) {}
  std::optional<std::string> why_unsupported(const Sheet&) const override {
    return refuses_ ? std::optional<std::string>("on purpose") : std::nullopt;
  }
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override {
    method_->embed(sheet, trace, notes);
    for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
      for (int k = 0; k < 3; ++k)
        if (const HalfEdge h = half_edge(TriangleIndex(t), k);
            sheet.triangle(TriangleIndex(t)).alive() && sheet.mark(h) == EdgeMark::path)
          return sheet.set_mark(h, EdgeMark::none);
  }

 private:
  bool refuses_;
  std::unique_ptr<CuttingMethod> method_;
};

TEST_F(Accuracy, AFailureIsARow) {
  std::vector<MethodRow> contenders{find_method("conventional_split")};
  for (const bool refuses : {false, true}) {
    contenders.push_back(contenders.front());
    contenders.back().name = refuses ? "refusing" : "closing";
    contenders.back().factory = [refuses](double) { return std::make_unique<Saboteur>(refuses); };
  }
  Experiment e;
  e.stem = "e";
  e.claim = "c";
  e.sheets = {"grid"};
  e.resolutions = {72};
  for (const MethodRow& row : contenders) e.methods.push_back({row.name, {}});
  e.study = AccuracyStudy{{"centre_crack"}, {"cholmod"}, {"cg"}, {5}, {{72, 2}}, {{72, 2}}};
  RunOptions options;
  options.out = folder_;
  options.quiet = true;
  EXPECT_FALSE(run_accuracy(e, contenders, gather_context(cholmod_version()), options));
  const auto rows = rows_of(folder_ / "e/records.csv");
  ASSERT_EQ(rows.size(), 4u * 2 * 2);
  for (const Record& row : rows) {
    SCOPED_TRACE(row.line());
    const std::string& method = row.get("method");
    EXPECT_EQ(row.get("status"), method == "refusing" ? "refused" : "ok");
    EXPECT_EQ(row.get("verdict") == "ok", method != "closing");
    EXPECT_EQ(row.get("reason").empty(), method != "closing" && method != "refusing");
    EXPECT_EQ(row.get("error").empty(), method == "closing" || method == "refusing");
    if (method == "closing") {
      EXPECT_GT(number(row, "incision_error_h"), 0.01);
    }
  }
}

}  // namespace
}  // namespace cutbench
