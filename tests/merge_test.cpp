// Shards put together are the run without shards, times apart; and what is not all of one run is refused by name.
#include "harness/records/merge.h"

#include <nlohmann/json.hpp>

#include "harness/records/shard_of.h"
#include "tests/helpers.h"
#include "tests/program.h"

namespace cutbench {
namespace {

/// The lines of a CSV in their order, without the columns of times and memory.
std::vector<std::string> lines_without_times(const std::string& csv) {
  std::vector<std::string> result;
  std::vector<bool> kept;
  for (const std::string& line : lines_of(csv)) {
    std::istringstream fields(line + ",");
    std::string text, field;
    for (std::size_t i = 0; std::getline(fields, field, ','); ++i) {
      if (result.empty()) kept.push_back(!field.ends_with("_us") && !field.ends_with("_mb"));
      if (kept.at(i)) text += field + ",";
    }
    result.push_back(text);
  }
  return result;
}

class Merge : public Program {
 protected:
  static std::string shard(int i, int of) { return "s" + std::to_string(i) + "of" + std::to_string(of); }
  void run_shards(const std::string& stem, int of) {
    for (int i = 1; i <= of; ++i) {
      const std::string number = std::to_string(i) + "/" + std::to_string(of);
      EXPECT_EQ(run("run " + stem + ".toml --out " + shard(i, of) + " --shard " + number).code, 0);
    }
  }
  std::string folders(const std::string& stem, int of) {
    std::string all;
    for (int i = of; i >= 1; --i) all += " " + shard(i, of) + "/" + stem;  // in any order
    return all;
  }
  void expect_equal(const std::string& stem, const std::vector<int>& numbers_of_shards = {1, 3, 5}) {
    EXPECT_EQ(run("run " + stem + ".toml --out whole").code, 0);
    const auto whole = lines_without_times(read(folder_ / "whole" / stem / "records.csv"));
    for (const int of : numbers_of_shards) {
      run_shards(stem, of);
      const std::string out = "merged" + std::to_string(of);
      const Result made = run("merge --out " + out + folders(stem, of));
      EXPECT_EQ(made.code, 0) << made.error;
      EXPECT_EQ(lines_without_times(read(folder_ / out / "records.csv")), whole) << stem << ' ' << of;
      EXPECT_EQ(run("missing --of " + std::to_string(of) + folders(stem, of)).code, 0);
    }
  }
  void expect_refused(const std::string& arguments, const std::string& what) {
    const Result refused = run("merge --out refused " + arguments);
    EXPECT_EQ(refused.code, 2) << arguments;
    EXPECT_NE(refused.error.find(what), std::string::npos) << refused.error;
    EXPECT_FALSE(fs::exists(folder_ / "refused"));
  }
};

TEST_F(Merge, CutFamilies) {
  write(folder_ / "e.toml", small_experiment());
  expect_equal("e");
}

/// Without times all cores may work; the records are the same, but for the columns of times, which are empty.
TEST_F(Merge, CutFamiliesWithoutTimes) {
  const std::string text = small_experiment("eigenvalue_cases = 1\n");
  std::string untimed = text;
  untimed.replace(untimed.find("repetitions = 2"), 15, "times = false");
  write(folder_ / "e.toml", untimed);
  expect_equal("e");
  for (const std::string jobs : {"1", "2"}) EXPECT_EQ(run("run e.toml --jobs " + jobs + " --out jobs" + jobs).code, 0);
  const std::string two = read(folder_ / "jobs2" / "e" / "records.csv");
  EXPECT_EQ(lines_without_times(read(folder_ / "jobs1" / "e" / "records.csv")), lines_without_times(two));
  write(folder_ / "e.toml", text);
  EXPECT_EQ(run("run e.toml --repetitions 1 --out timed").code, 0);
  EXPECT_EQ(lines_without_times(read(folder_ / "timed" / "e" / "records.csv")), lines_without_times(two));
  for (const std::string& line : lines_of(two))
    EXPECT_EQ(Record(column_names(), line).get("embed_us").find('.'), std::string::npos);

  write(folder_ / "e.toml", untimed + "cold = true\n");
  EXPECT_NE(run("run e.toml --out r").error.find("\"cold\" is for times"), std::string::npos);
}

TEST_F(Merge, Accuracy) {
  write(
      folder_ / "a.toml",
      "claim = \"c\"\nsheets = [\"grid\", \"delaunay\"]\nresolutions = [200]\nmethods = [\"conventional_split\"]\n"
      "[accuracy]\nproblems = [\"centre_crack\", \"two_cuts_one_geometry\"]\nmembers = [4]\ndirect = [\"cholmod\"]\n");
  expect_equal("a");
}

/// Sheets, sizes, families and problems are divided, too.
TEST_F(Merge, OneCaseOfEachKind) {
  const auto one_case = [](std::string text) { return text.replace(text.find("cases = 3"), 9, "cases = 1"); };
  std::string untimed = one_case(small_experiment());
  untimed.replace(untimed.find("repetitions = 2"), 15, "times = false");
  write(folder_ / "timed.toml", one_case(small_experiment()));
  write(folder_ / "untimed.toml", untimed);
  write(folder_ / "accuracy.toml",
        "claim = \"c\"\nsheets = [\"grid\", \"delaunay\"]\nresolutions = [72, 200]\nmethods = "
        "[\"conventional_split\"]\n[accuracy]\nproblems = [\"centre_crack\", \"two_cuts_one_geometry\"]\nmembers = "
        "[2, 1]\nreference = false\ndirect = [\"cholmod\"]\n");
  for (const std::string stem : {"timed", "untimed", "accuracy"}) {
    expect_equal(stem, {2, 3});
    for (const int of : {2, 3})
      for (int i = 1; i <= of; ++i)
        EXPECT_GT(lines_of(read(folder_ / shard(i, of) / stem / "records.csv")).size(), 1u) << stem << i << of;
  }
}

TEST_F(Merge, OneCaseOfARobustnessRun) {
  write(folder_ / "c.toml",
        "claim = \"c\"\nsheets = [\"grid\", \"delaunay\"]\nresolutions = [32, 72]\ncases = 1\nmethods = "
        "[\"conventional_split\"]\n[robustness]\ntime_limit_s = 60\n");
  expect_equal("c", {2, 3, 5});
  for (const std::string folder : {"s1of2", "s2of2"}) {
    const auto lines = lines_of(read(folder_ / folder / "c" / "records.csv"));
    const std::vector<std::string> names = fields_of(lines[0]);
    long long cases = 0;
    for (std::size_t i = 1; i < lines.size(); ++i) cases += std::stoll(Record(names, lines[i]).get("cases"));
    EXPECT_EQ(cases, 2) << folder;
  }
}

TEST(ShardOf, SpreadsWhatRecurs) {
  for (const std::size_t shards : {1, 2, 3, 8}) {
    for (std::size_t turn = 0; turn < 20; ++turn) {
      std::set<std::size_t> dealt_to;
      for (std::size_t p = 0; p < shards; ++p) dealt_to.insert(shard_of(turn * shards + p, shards));
      EXPECT_EQ(dealt_to.size(), shards) << "an item for each";
    }
    std::set<std::size_t> of_every_other;
    for (std::size_t item = 0; item < 2 * shards * shards; item += 2) of_every_other.insert(shard_of(item, shards));
    EXPECT_EQ(of_every_other.size(), shards);
  }
}

/// Its points are tried in other processes, in turns by shard.
TEST_F(Merge, Stability) {
  write(folder_ / "a.toml",
        "claim = \"c\"\nsheets = [\"grid\", \"delaunay\"]\nresolutions = [200]\nmethods = [\"conventional_split\", "
        "\"cut_polygons\"]\n[[sweeps]]\nname = \"a\"\nscene = \"" CUTBENCH_EXPERIMENTS
        "/scenes/stability_sheet.toml\"\ncases = 2\nsteps = 2\ncut = [\"straight\", \"curved\"]\n");
  expect_equal("a");
}

TEST_F(Merge, Robustness) {
  write(folder_ / "c.toml",
        "claim = \"c\"\nsheets = [\"grid\", \"delaunay\"]\nresolutions = [72]\ncases = 20\nmethods = "
        "[\"conventional_split\", \"snap_or_split\"]\n[robustness]\ntime_limit_s = 60\n");
  expect_equal("c");
}

TEST_F(Merge, WhatIsNotAllOfOneRunIsRefusedByName) {
  write(folder_ / "e.toml", small_experiment());
  run_shards("e", 3);
  EXPECT_EQ(run("missing --of 3 s1of3/e s2of3/e nowhere").out, "3\n");
  EXPECT_EQ(run("missing --of 3 s2of3/e").code, 1);
  EXPECT_EQ(run("missing --of 4 s2of3/e").code, 2);
  expect_refused("s1of3/e s3of3/e", "of 3 shards these are missing: 2");
  expect_refused("s1of3/e s2of3/e s3of3/e s2of3/e", "s2of3/e: is shard 2, as is s2of3/e");
  expect_refused("s1of3/e nowhere", "nowhere: not finished");
  EXPECT_EQ(run("run e.toml --out other --seed 99 --shard 3/3").code, 0);
  expect_refused("s1of3/e s2of3/e other/e", "other/e: is of another program, machine, experiment or seed");
  EXPECT_EQ(run("run e.toml --out half --shard 2/2").code, 0);
  expect_refused("s1of3/e half/e", "half/e: is one of 2 shards");

  const std::string whole = read(folder_ / "s2of3" / "e" / "records.csv");
  for (const std::size_t left : {whole.size() - 1, whole.size() / 2, whole.rfind('\n', whole.size() - 2) + 1}) {
    write(folder_ / "s2of3" / "e" / "records.csv", whole.substr(0, left));
    expect_refused("s1of3/e s2of3/e s3of3/e", "s2of3/e: records.csv is cut short");
    EXPECT_EQ(run("missing --of 3 s1of3/e s2of3/e s3of3/e").out, "2\n");
  }
  write(folder_ / "s2of3" / "e" / "records.csv", whole);
  write(folder_ / "s2of3" / "e" / "context.json", "{");
  expect_refused("s1of3/e s2of3/e s3of3/e", "s2of3/e: its context.json is damaged");
}

TEST_F(Merge, OnlyWhatRecordsNoTimesTakesJobs) {
  write(folder_ / "e.toml", small_experiment());
  const Result refused = run("run e.toml --jobs 2 --out r");
  EXPECT_EQ(refused.code, 2);
  EXPECT_NE(refused.error.find("records times"), std::string::npos) << refused.error;
  write(folder_ / "c.toml",
        "claim = \"c\"\nsheets = [\"grid\"]\nresolutions = [72]\ncases = 20\nmethods = [\"conventional_split\"]\n"
        "[robustness]\ntime_limit_s = 60\n");
  for (const std::string jobs : {"1", "2"}) EXPECT_EQ(run("run c.toml --jobs " + jobs + " --out jobs" + jobs).code, 0);
  EXPECT_EQ(lines_without_times(read(folder_ / "jobs1" / "c" / "records.csv")),
            lines_without_times(read(folder_ / "jobs2" / "c" / "records.csv")));
}

}  // namespace
}  // namespace cutbench
