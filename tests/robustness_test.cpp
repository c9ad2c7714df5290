// The robustness run counts, saves and makes small what goes wrong, and a crash or a hang costs one case: tried on
// methods that do wrong on purpose.

#include "harness/study/robustness/robustness.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "harness/base/conversions.h"
#include "harness/cases/adversarial.h"
#include "harness/fem/linear/factor.h"
#include "harness/files/path_file.h"
#include "harness/mesh/families.h"
#include "harness/processes/isolated.h"
#include "harness/records/record.h"
#include "harness/study/robustness/failing_case.h"
#include "harness/study/robustness/robustness_case.h"
#include "harness/study/robustness/shrink.h"
#include "methods/registry.h"
#include "tests/helpers.h"
#include "tests/mesh_checks.h"

namespace cutbench {
namespace {

namespace fs = std::filesystem;

/// Does its work well, but on every fifth number of crossed triangles what its name says.
class Saboteur : public CuttingMethod {
 public:
  enum class Deed { crash, hang, fail, leave_closed, give_up };
  explicit Saboteur(Deed deed) : deed_(deed), method_(find_method("conventional_split").make(0)) {}

  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override {
    const bool strike = trace.crossed_triangles() % 5 == 0;
    if (strike && deed_ == Deed::crash) std::raise(SIGKILL);  // nobody, a sanitizer neither, can catch it
    if (strike && deed_ == Deed::hang)
      for (volatile bool forever = true; forever;) {
      }
    method_->embed(sheet, trace, notes);
    if (strike && deed_ == Deed::give_up) throw TooClose("on purpose");
    if (strike && deed_ == Deed::fail) throw CutFailed(Verdict::inverted, "on purpose");
    if (strike && deed_ == Deed::leave_closed && !sheet.log().new_vertices.empty()) un_mark(sheet);
  }

 private:
  /// One edge of the incision stays closed.
  static void un_mark(Sheet& sheet) {
    for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
      for (int k = 0; k < 3; ++k)
        if (const HalfEdge h = half_edge(TriangleIndex(t), k);
            sheet.triangle(TriangleIndex(t)).alive() && sheet.mark(h) == EdgeMark::path)
          return sheet.set_mark(h, EdgeMark::none);
  }

  Deed deed_;
  std::unique_ptr<CuttingMethod> method_;
};

MethodRow row_of(const std::string& name, Saboteur::Deed deed) {
  MethodRow row = find_method("conventional_split");
  row.name = name;
  row.factory = [deed](double) { return std::make_unique<Saboteur>(deed); };
  return row;
}

const std::vector<MethodRow>& rows() {
  static const std::vector<MethodRow> all{find_method("conventional_split"),
                                          row_of("crashing", Saboteur::Deed::crash),
                                          row_of("hanging", Saboteur::Deed::hang),
                                          row_of("failing", Saboteur::Deed::fail),
                                          row_of("giving_up", Saboteur::Deed::give_up),
                                          row_of("wrong", Saboteur::Deed::leave_closed)};
  return all;
}

class RobustnessRun : public testing::Test {
 protected:
  void SetUp() override { folder_ = fs::temp_directory_path() / ("cutbench_robustness_" + std::to_string(getpid())); }
  void TearDown() override { fs::remove_all(folder_); }

  static Experiment experiment(const std::vector<std::string>& methods, int cases) {
    Experiment e;
    e.stem = "small";
    e.claim = "c";
    e.seed = 3;
    e.sheets = {"grid", "delaunay"};
    e.resolutions = {32};
    for (const auto& method : methods) e.methods.push_back({method, {}});
    e.study = RobustnessStudy{
        .cases = cases, .mesh_files = {CUTBENCH_TEST_CASES "/meshes/mfem_beam-tri.off"}, .time_limit_s = 0.5};
    return e;
  }
  /// Runs, and returns the records without the times.
  std::vector<Record> run(const Experiment& e, const std::string& out, int workers = 2, int shard = 1, int shards = 1) {
    RunOptions options;
    options.out = folder_ / out;
    options.quiet = true;
    options.workers = workers;
    options.shard = shard;
    options.shards = shards;
    all_ok_ = run_robustness(e, rows(), gather_context(cholmod_version()), options);
    std::ifstream in(folder_ / out / "small" / "records.csv");
    std::vector<Record> records;
    std::string line;
    for (std::getline(in, line); std::getline(in, line);) {
      records.emplace_back(robustness_columns(), line).set("slowest_us", std::string());
    }
    return records;
  }
  static std::vector<std::string> lines_of(const std::vector<Record>& records) {
    std::vector<std::string> lines;
    for (const Record& record : records) lines.push_back(record.line());
    return lines;
  }
  static std::int64_t count(const Record& record, Count::Kind c) { return std::stoll(record.get(count_names[c])); }
  static std::int64_t sum(const std::vector<Record>& records, Count::Kind c) {
    std::int64_t n = 0;
    for (const Record& record : records) n += count(record, c);
    return n;
  }

  fs::path folder_;
  bool all_ok_ = false;
};

TEST_F(RobustnessRun, RowsAddUpAndDoNotDependOnTheWorkers) {
  Experiment e = experiment({"conventional_split", "failing"}, 30);
  std::get<RobustnessStudy>(e.study).cross_check = true;
  const auto one = run(e, "one", 1), two = run(e, "two", 2);
  EXPECT_EQ(lines_of(one), lines_of(two));
  EXPECT_EQ(one.size(), 3 * 3 * adversarial_families().size());  // sheets x contenders x families
  for (const Record& row : one) {
    std::int64_t outcomes = 0;
    for (int c = Count::ok; c <= Count::timed_out; ++c) outcomes += count(row, static_cast<Count::Kind>(c));
    EXPECT_EQ(outcomes, count(row, Count::tried)) << row.line();
    EXPECT_GE(count(row, Count::tried), count(row, Count::cases)) << row.line();
    EXPECT_LE(count(row, Count::near_event_cases), count(row, Count::cases)) << row.line();
  }
  EXPECT_EQ(sum(one, Count::cases), 3 * 3 * 30);
  // Each contender has had the same cases.
  for (const auto& family : adversarial_families()) {
    std::set<std::int64_t> numbers;
    for (const Record& row : one)
      if (row.get("cut_family") == family && row.get("sheet") == "grid") numbers.insert(count(row, Count::cases));
    EXPECT_EQ(numbers.size(), 1u) << family;
  }
}

TEST_F(RobustnessRun, ShardsPartTheCases) {
  const Experiment e = experiment({"failing"}, 31);
  const auto whole = run(e, "whole");
  const auto first = run(e, "first", 2, 1, 2), second = run(e, "second", 2, 2, 2);
  ASSERT_EQ(first.size(), whole.size());
  ASSERT_EQ(second.size(), whole.size());
  for (std::size_t r = 0; r < whole.size(); ++r)
    for (int c = Count::tried; c <= Count::near_event_cases; ++c)
      EXPECT_EQ(count(first[r], static_cast<Count::Kind>(c)) + count(second[r], static_cast<Count::Kind>(c)),
                count(whole[r], static_cast<Count::Kind>(c)));
}

/// The deed of each, how it is counted, and with which verdict it is saved.
TEST_F(RobustnessRun, AFaultCostsOneCaseAndIsSavedAndMadeSmall) {
  struct Row {
    const char* method;
    Count::Kind kind;
    const char* verdict;
  };
  for (const Row& expected : {Row{"crashing", Count::crashed, "signal"}, Row{"failing", Count::failed, "inverted"},
                              Row{"wrong", Count::wrong, ""}, Row{"hanging", Count::timed_out, ""}}) {
    SCOPED_TRACE(expected.method);
    Experiment e = experiment({expected.method}, expected.kind == Count::timed_out ? 4 : 14);
    if (expected.kind == Count::timed_out)
      std::get<RobustnessStudy>(e.study).time_limit_s = 0.2;  // each trial of making it small takes that long
    const auto records = run(e, expected.method);
    EXPECT_FALSE(all_ok_);
    EXPECT_GT(sum(records, expected.kind), 0);
    EXPECT_GT(sum(records, Count::ok), 0);  // and the others went on
    for (Count::Kind other : {Count::failed, Count::wrong, Count::crashed, Count::timed_out})
      EXPECT_EQ(sum(records, other) > 0, other == expected.kind) << count_names[other];
    std::size_t saved = 0;
    for (const auto& file : fs::directory_iterator(folder_ / expected.method / "small" / "failing")) {
      if (file.path().extension() != ".txt") continue;
      ++saved;
      std::ifstream in(file.path());
      const std::string text((std::istreambuf_iterator<char>(in)), {});
      SCOPED_TRACE(text);
      EXPECT_EQ(text.find("NOT the same"), std::string::npos);
      EXPECT_NE(text.find("cutbench cut --mesh"), std::string::npos);
      EXPECT_NE(text.find(count_names[expected.kind]), std::string::npos);
      EXPECT_NE(text.find(expected.verdict), std::string::npos);
      // What was saved, and its small part, do it again.
      const std::string stem = fs::path(file.path()).replace_extension().string();
      const auto row =
          std::find_if(rows().begin(), rows().end(), [&](const auto& r) { return r.name == expected.method; });
      std::vector<std::size_t> triangles;
      for (const std::string kind : {"", ".small"}) {
        const CutCase again{read_mesh(stem + kind + ".obj"), read_path(stem + kind + ".json")};
        EXPECT_EQ(try_in_isolation(contender_of({std::make_shared<const MethodRow>(*row), 0}), again, {},
                                   std::get<RobustnessStudy>(e.study).time_limit_s)
                      .kind,
                  expected.kind);
        triangles.push_back(again.mesh.triangles.size());
      }
      if (expected.kind != Count::timed_out) {  // there each trial takes its time
        EXPECT_LT(triangles[1], triangles[0]);
      }
    }
    EXPECT_GT(saved, 0u);
    EXPECT_LE(saved, to_size(sum(records, expected.kind)));
  }
}

TEST_F(RobustnessRun, CountsWhereTheHarnessHadToEmbed) {
  const auto own_way = run(experiment({"conventional_split"}, 20), "own"),
             helped = run(experiment({"giving_up"}, 20), "helped");
  EXPECT_TRUE(all_ok_);
  EXPECT_GT(sum(helped, Count::carefully), sum(own_way, Count::carefully));
  EXPECT_LE(sum(helped, Count::carefully), sum(helped, Count::tried));
}

TEST_F(RobustnessRun, AllOfTheMethodsPass) {
  run(experiment({"conventional_split"}, 20), "out");
  EXPECT_TRUE(all_ok_);
  EXPECT_FALSE(fs::exists(folder_ / "out" / "small" / "failing"));
}

/// As a kill leaves it: rows of a whole group, rows of half of one, and a line cut short.
TEST_F(RobustnessRun, AKilledRobustnessRunGoesOn) {
  const Experiment e = experiment({"conventional_split", "failing"}, 20);
  const auto whole = run(e, "whole");
  std::ifstream in(folder_ / "whole" / "small" / "records.csv");
  std::string head, line, rest;
  std::getline(in, head);
  const std::size_t kept = adversarial_families().size() + 2;
  std::vector<std::string> rows;
  while (std::getline(in, line)) rows.push_back(line);

  // The head of a .part says which run it is of: taken from one that finds its folder's failing/ blocked.
  fs::create_directories(folder_ / "killed" / "small");
  std::ofstream(folder_ / "killed" / "small" / "failing") << "not a folder";
  EXPECT_THROW(run(e, "killed"), InputError);
  fs::remove(folder_ / "killed" / "small" / "failing");
  const fs::path part = folder_ / "killed" / "small" / "records.csv.part";
  {
    std::ifstream part_in(part);
    std::getline(part_in, head);
  }
  std::ofstream out(part);
  out << head << '\n';
  for (std::size_t r = 0; r < kept; ++r) {
    Record record(robustness_columns(), rows[r]);
    record.set("slowest_us", std::string("12345"));  // to know it again
    out << record.line() << '\n';
  }
  out << "2,straight,gr";
  out.close();
  EXPECT_EQ(lines_of(run(e, "killed")), lines_of(whole));
  std::ifstream again(folder_ / "killed" / "small" / "records.csv");
  const std::string text((std::istreambuf_iterator<char>(again)), {});
  std::size_t known = 0;
  for (std::size_t at = 0; (at = text.find("12345\n", at)) != std::string::npos; ++at) ++known;
  EXPECT_EQ(known, kept);
}

TEST_F(RobustnessRun, ACaseThatCannotBeSavedIsSaid) {
  const Variant variant{std::make_shared<const MethodRow>(rows().front()), 0};
  const FailingCase failing{
      "taken", "title", {make_sheet("grid", 1), {{Curve::Kind::polyline, false, {{0, 0.2}, {1, 0.7}}}}}, {}};
  fs::create_directories(folder_ / "taken.txt");
  expect_refused([&] { save(failing, folder_, contender_of(variant), {}, 1, 0); },
                 "taken.txt: can't be written; check");
}

TEST(Adversarial, MostCasesComeNearToSomething) {
  for (const std::string family : sheet_families()) {
    const Sheet sheet(make_sheet(family, 6));
    int near = 0;
    for (std::size_t i = 0; i < 200; ++i) near += nearest_event(make_adversarial_case(8, i, sheet).cuts, sheet) < 1e-9;
    EXPECT_GE(near, 120) << family << ": of 200; the claim is 30 %";
  }
}

TEST(Isolated, EveryPieceHasItsFate) {
  const SharedArray<int> done(40);
  const auto fates = run_isolated(done.size(), {3, 0.2}, [&](std::size_t i) {
    if (i % 10 == 3) std::_Exit(0);  // ends early, as if well
    if (i % 10 == 5) std::raise(SIGKILL);
    if (i % 10 == 9) throw std::runtime_error("that somebody may catch further up");
    if (i == 7)
      for (volatile bool forever = true; forever;) {
      }
    ++done[i];
  });
  for (std::size_t i = 0; i < done.size(); ++i) {
    const bool dies = i % 10 == 3 || i % 10 == 5 || i % 10 == 9;
    EXPECT_EQ(fates[i], dies ? Fate::crashed : i == 7 ? Fate::timed_out : Fate::done) << i;
    EXPECT_EQ(done[i], dies || i == 7 ? 0 : 1) << i;
  }
  EXPECT_TRUE(run_isolated(0, {}, [](std::size_t) {}).empty());
}

/// A user who may start no process is told so; root, who always may, becomes nobody.
TEST(IsolatedDeathTest, SaysThatNoProcessStarts) {
  const auto try_it = [] {
    const rlimit none{0, 0};
    setrlimit(RLIMIT_NPROC, &none);
    if (geteuid() == 0 && setuid(65534) != 0) std::_Exit(2);
    try {
      run_isolated(1, {1, 1}, [](std::size_t) {});
    } catch (const std::runtime_error& error) {
      std::fputs(error.what(), stderr);
      std::_Exit(1);
    }
    std::_Exit(0);
  };
  EXPECT_EXIT(try_it(), testing::ExitedWithCode(1), "can't start a process: ");
}

/// Of three cuts, of a path with many points and of a whole sheet, what it takes is left.
TEST(Shrink, LeavesOutAllThatIsNotNeeded) {
  const auto needs = [](const CutCase& s) {
    const bool path = std::any_of(s.cuts.begin(), s.cuts.end(), [](const Curve& c) {
      return std::count(c.points.begin(), c.points.end(), Point2{0.5, 0.5}) == 1;
    });
    const bool sheet = std::any_of(s.mesh.triangles.begin(), s.mesh.triangles.end(), [&](const auto& t) {
      return s.mesh.rest[to_size(t[0])] == Point2{0.5, 0.5};
    });
    return path && sheet;
  };
  CutCase cut_case{make_sheet("grid", 6), {}};
  const Curve line{Curve::Kind::polyline, false, {{0, 0}, {1, 1}}};
  const Curve loop{Curve::Kind::polyline, true, {{0, 0}, {0.3, 0.1}, {0.5, 0.5}, {0.2, 0.4}, {0.1, 0.3}, {0, 0.2}}};
  cut_case.cuts = {line, loop, line};
  ASSERT_TRUE(needs(cut_case));
  const CutCase small = shrunk(cut_case, needs);
  EXPECT_TRUE(needs(small));
  EXPECT_EQ(small.mesh.triangles.size(), 1u);
  EXPECT_EQ(small.mesh.rest.size(), 3u);
  ASSERT_EQ(small.cuts.size(), 1u);
  EXPECT_EQ(small.cuts[0].points.size(), 3u);
}

}  // namespace
}  // namespace cutbench
