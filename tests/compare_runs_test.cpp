// What `cutbench compare` says of two folders of `cutbench run`.
#include "harness/records/compare_runs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "harness/base/conversions.h"
#include "harness/base/errors.h"

namespace cutbench {
namespace {

class CompareRuns : public testing::Test {
 protected:
  ~CompareRuns() override { std::filesystem::remove_all(folder_); }

  struct Row {
    double us = 10;
    std::string status = "ok", aspect = "3.5", repetition = "0";
  };
  std::string write(const std::string& name, const std::vector<Row>& rows, const std::string& compiler = "GNU 12") {
    const auto folder = folder_ / name;
    std::filesystem::create_directories(folder);
    std::ofstream out(folder / "records.csv");
    out << "suite_version,scene,sheet,method,parameter,resolution,case,repetition,seed,cache,status,verdict,ar_max_cut,"
           "geometry_us\n";
    for (std::size_t i = 0; i < rows.size(); ++i)
      out << "4,curved,grid,bowyer_watson,rounds=1,800," << i << ',' << rows[i].repetition << ",1,warm,"
          << rows[i].status << ',' << rows[i].status << ',' << rows[i].aspect << ',' << rows[i].us << '\n';
    std::ofstream(folder / "context.json") << nlohmann::json{{"compiler", compiler},
                                                             {"flags", "-O3"},
                                                             {"build_type", "Release"},
                                                             {"cpu", "one"},
                                                             {"versions", {{"CGAL", "5.5.1"}}}};
    return folder.string();
  }

 private:
  std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / "cutbench_compare_runs";
};

TEST_F(CompareRuns, SameFolderTwice) {
  const auto a = write("a", std::vector<Row>(20));
  const RunComparison c = compare_runs(a, a);
  EXPECT_FALSE(c.is_slower());
  EXPECT_TRUE(c.quality.empty() && c.worse.empty() && c.not_comparable.empty());
  ASSERT_EQ(c.times.size(), 1u);
  EXPECT_EQ(c.times[0].cases, 20u);
  EXPECT_EQ(c.times[0].median, 1);
}

TEST_F(CompareRuns, SlowerWhereTheWholeIntervalIs) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 0.02);
  std::vector<Row> base(60), same(60), slower(60);
  for (std::size_t i = 0; i < base.size(); ++i) {
    base[i].us = std::exp(0.1 * to_double(i) + noise(random));  // cases differ far more than the change
    same[i].us = std::exp(0.1 * to_double(i) + noise(random));
    slower[i].us = 1.05 * std::exp(0.1 * to_double(i) + noise(random));
  }
  const auto a = write("a", base);
  EXPECT_FALSE(compare_runs(a, write("b", same)).is_slower());
  const RunComparison c = compare_runs(a, write("c", slower));
  EXPECT_TRUE(c.is_slower());
  EXPECT_NEAR(c.times[0].median, 1.05, 0.02);
  EXPECT_LT(c.times[0].low, c.times[0].median);
  EXPECT_GT(c.times[0].high, c.times[0].median);
  EXPECT_NE(as_text(c).find("SLOWER: 1 times of 1"), std::string::npos) << as_text(c);
  EXPECT_EQ(nlohmann::json::parse(as_json(c)).at("verdict"), "slower");
}

TEST_F(CompareRuns, FewCasesAreNoFinding) {
  const RunComparison c = compare_runs(write("a", std::vector<Row>(5)), write("b", std::vector<Row>(5, {.us = 20})));
  EXPECT_FALSE(c.is_slower());
  EXPECT_TRUE(c.has_too_few_cases());
}

TEST_F(CompareRuns, TwoCasesAreNotCalledEqual) {
  const auto two = write("a", std::vector<Row>(2));
  const RunComparison c = compare_runs(two, two);
  EXPECT_TRUE(c.has_too_few_cases());
  EXPECT_TRUE(as_text(c).starts_with("too few cases to say that nothing is slower")) << as_text(c);
  EXPECT_EQ(as_text(c).find("nothing slower"), std::string::npos);
  EXPECT_NE(as_markdown(c).find("| none | too few cases |"), std::string::npos) << as_markdown(c);
  const auto json = nlohmann::json::parse(as_json(c));
  EXPECT_EQ(json.at("verdict"), "too_few_cases");
  EXPECT_TRUE(json.at("times")[0].at("would_show").is_null());
}

/// The very change that it names is found, a smaller one is not.
TEST_F(CompareRuns, SaysWhatChangeItCouldHaveShown) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 0.05);
  std::vector<Row> base(30), head(30), larger(30), smaller(30);
  for (Row& row : head) row.us = 10 * std::exp(noise(random));
  const auto a = write("a", base);
  const RunComparison c = compare_runs(a, write("b", head));
  ASSERT_EQ(c.times.size(), 1u);
  const double shown = c.times[0].shown;
  EXPECT_GT(shown, 1.01);
  EXPECT_LT(shown, 1.1);
  for (std::size_t i = 0; i < base.size(); ++i) {
    larger[i].us = head[i].us / c.times[0].median * shown * 1.001;
    smaller[i].us = head[i].us / c.times[0].median * shown * 0.999;
  }
  EXPECT_TRUE(compare_runs(a, write("c", larger)).is_slower());
  EXPECT_FALSE(compare_runs(a, write("d", smaller)).is_slower());
  EXPECT_NE(as_text(c).find("with these cases a slow-down of +"), std::string::npos) << as_text(c);
}

TEST_F(CompareRuns, WorseVerdictsAndShapes) {
  std::vector<Row> head(20);
  head[3].status = "wrong";
  head[4].aspect = "4";
  head[5].aspect = "3";
  head[6].aspect = "";
  const RunComparison c = compare_runs(write("a", std::vector<Row>(20)), write("b", head));
  EXPECT_TRUE(c.is_slower());
  EXPECT_EQ(c.worse.size(), 2u);  // its status and its verdict
  ASSERT_EQ(c.quality.size(), 1u);
  EXPECT_EQ(c.quality[0].column, "ar_max_cut");
  EXPECT_EQ(c.quality[0].better, 1u);
  EXPECT_EQ(c.quality[0].worse, 2u);
  EXPECT_NE(as_markdown(c).find("2 verdicts worse"), std::string::npos);
}

TEST_F(CompareRuns, OtherToolsOrRows) {
  const auto a = write("a", std::vector<Row>(8));
  EXPECT_NE(compare_runs(a, write("b", std::vector<Row>(8), "clang")).not_comparable.find("compiler"),
            std::string::npos);
  EXPECT_NE(compare_runs(a, write("c", std::vector<Row>(7))).not_comparable.find("no row"), std::string::npos);
  EXPECT_NE(compare_runs(a, write("d", std::vector<Row>(8, {.repetition = "9"}))).not_comparable.find("--seed"),
            std::string::npos);
  EXPECT_THROW(compare_runs(a, a + "/nothing"), InputError);
}

// Against the binomial distribution summed by hand: tables of Conover, A3.
TEST(MedianRanks, CoverTheMedian) {
  EXPECT_EQ(median_ranks(5), std::pair(std::size_t{0}, std::size_t{4}));
  EXPECT_EQ(median_ranks(6), std::pair(std::size_t{0}, std::size_t{5}));    // 96.9 %
  EXPECT_EQ(median_ranks(10), std::pair(std::size_t{1}, std::size_t{8}));   // 97.9 %
  EXPECT_EQ(median_ranks(20), std::pair(std::size_t{5}, std::size_t{14}));  // 95.9 %
  const auto [low, high] = median_ranks(2000);
  EXPECT_NEAR(to_double(low), 1000 - 0.98 * std::sqrt(2000.0), 2);
  EXPECT_EQ(high, 1999 - low);
}

}  // namespace
}  // namespace cutbench
