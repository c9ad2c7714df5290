// `cutbench ablate` against what is known without it: the fall of a piece that is cut free, by a recursion.

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/program.h"

namespace cutbench {
namespace {

class Ablate : public Program {
 protected:
  void expect_refused(const std::string& arguments, const std::string& what) {
    const auto result = run(arguments);
    EXPECT_EQ(result.code, 2) << result.error;
    EXPECT_NE(result.error.find(what), std::string::npos) << result.error;
  }
};

const std::string scenes = CUTBENCH_TEST_CASES "/../../experiments/scenes/";

/// v+ = (v - g h) / (1 + alpha h): backward Euler of a free piece, as falling_piece.toml says.
double fall(int steps, double seconds) {
  const double h = seconds / steps;
  double v = 0, fallen = 0;
  for (int i = 0; i < steps; ++i) {
    v = (v + 9.81 * h) / (1 + 0.5 * h);
    fallen += h * v;
  }
  return fallen;
}

std::map<std::string, nlohmann::json> rows_of(const std::string& report) {
  std::map<std::string, nlohmann::json> rows;
  for (const auto& row : nlohmann::json::parse(report)) rows[row["without"]] = row;
  return rows;
}

TEST_F(Ablate, AFallingPieceFallsAlikeWithoutWhatDoesNotAct) {
  const auto result = run("ablate '" + scenes + "falling_piece.toml' --resolution 200 --report r.json");
  ASSERT_EQ(result.code, 0) << result.error;
  auto rows = rows_of(read(folder_ / "r.json"));
  ASSERT_EQ(rows.size(), 11u) << result.out;
  const double whole = fall(60, 0.25), coarse = fall(30, 0.25);
  EXPECT_NEAR(rows[""]["deflection_m"], whole, 1e-6);
  EXPECT_EQ(rows[""]["deviation_m"], 0);
  EXPECT_EQ(rows[""]["steps"], 60);
  EXPECT_NEAR(rows["bending"]["deflection_m"], whole, 1e-6);
  EXPECT_NEAR(rows["stiffness from stress"]["deflection_m"], whole, 1e-6);
  EXPECT_NEAR(rows["triangles (springs)"]["deflection_m"], whole, 1e-6);
  EXPECT_NEAR(rows["linear solves (xpbd)"]["deflection_m"], fall(600, 0.25), 1e-6);
  EXPECT_EQ(rows["linear solves (xpbd)"]["steps"], 600);
  EXPECT_NEAR(rows["motion far from the cuts"]["deflection_m"], whole, 1e-6) << "what is cut out moves";
  EXPECT_GT(rows["motion far from the cuts"]["deviation_m"], 1e-3) << "what is round it does not";
  EXPECT_NEAR(rows["every second step"]["deflection_m"], coarse, 1e-6);
  EXPECT_EQ(rows["every second step"]["steps"], 30);
  EXPECT_GE(rows["every second step"]["deviation_m"], coarse - whole - 1e-6);
  EXPECT_LT(rows["the third dimension"]["deflection_m"], 1e-14) << "nothing moves in the plane";
  EXPECT_TRUE(rows["implicit steps"]["steps"].get<int>() > 60) << result.out;
  EXPECT_NEAR(rows["three of four triangles"]["deflection_m"], whole, 1e-6);
  EXPECT_TRUE(rows["three of four triangles"]["deviation_m"].is_null()) << "other vertices";
  EXPECT_NE(result.out.find("(whole model)"), std::string::npos);
}

TEST_F(Ablate, ARunThatEndsEarlyHasNoResult) {
  const auto result =
      run("ablate '" + scenes + "falling_piece.toml' --resolution 200 --time-limit 1e-6 --report r.json");
  EXPECT_EQ(result.code, 1) << result.error;
  for (const auto& [without, row] : rows_of(read(folder_ / "r.json"))) {
    EXPECT_EQ(row["verdict"], "timed_out") << without;
    EXPECT_TRUE(row["deflection_m"].is_null() && row["gape_m"].is_null() && row["deviation_m"].is_null()) << without;
  }
}

TEST_F(Ablate, BadInput) {
  expect_refused("ablate missing.toml", "missing.toml");
  const std::string scene = "ablate '" + scenes + "falling_piece.toml' ";
  expect_refused(scene + "--resolution 801", "resolution 801");
  expect_refused(scene + "--report none/r.json", "none");
  expect_refused(scene + "--method no_such", "no_such");
}

}  // namespace
}  // namespace cutbench
