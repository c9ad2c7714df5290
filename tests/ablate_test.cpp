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
  EXPECT_EQ(rows[""]["free_pieces"], 1);
  EXPECT_NE(result.out.find("left out of moved, gape and dev.: 1 piece that nothing holds"), std::string::npos);
  EXPECT_LT(rows[""]["deflection_m"], whole / 2) << "of the frame alone, which is held";
  EXPECT_EQ(rows[""]["gape_m"], 0) << "the two lips are not of one piece that is held";
  EXPECT_NEAR(rows[""]["fall_m"], whole, 1e-6);
  EXPECT_EQ(rows[""]["deviation_m"], 0);
  EXPECT_EQ(rows[""]["steps"], 60);
  EXPECT_NEAR(rows["bending"]["fall_m"], whole, 1e-6);
  EXPECT_NEAR(rows["stiffness from stress"]["fall_m"], whole, 1e-6);
  EXPECT_NEAR(rows["triangles (springs)"]["fall_m"], whole, 1e-6);
  EXPECT_NEAR(rows["linear solves (xpbd)"]["fall_m"], fall(600, 0.25), 1e-6);
  EXPECT_EQ(rows["linear solves (xpbd)"]["steps"], 600);
  EXPECT_NEAR(rows["motion far from the cuts"]["fall_m"], whole, 1e-6) << "what is cut out moves";
  EXPECT_GT(rows["motion far from the cuts"]["deviation_m"], 1e-3) << "what is round it does not";
  EXPECT_NEAR(rows["every second step"]["fall_m"], coarse, 1e-6);
  EXPECT_EQ(rows["every second step"]["steps"], 30);
  EXPECT_LT(rows["every second step"]["deviation_m"], rows[""]["deflection_m"]) << "of the frame";
  EXPECT_LT(rows["the third dimension"]["deflection_m"], 1e-14) << "nothing moves in the plane";
  EXPECT_TRUE(rows["implicit steps"]["steps"].get<int>() > 60) << result.out;
  EXPECT_NEAR(rows["three of four triangles"]["fall_m"], whole, 1e-6);
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

/// A sheet of one's own, made coarser by remeshing; one with an incision can't be, and the row says so.
TEST_F(Ablate, ASheetFromAFileIsMadeCoarser) {
  ASSERT_EQ(run("cut --mesh sheet.off --path path.json --out one.obj --method longest_edge").code, 0);
  const auto scene = [&](const std::string& file) {
    write(folder_ / "own.toml",
          "effect = \"e\"\ntruth = \"t\"\nduration = 0.02\n[sheet]\nfile = \"" + file +
              "\"\n[physics]\ngravity = [0.0, 0.0, -9.81]\n[[pins]]\nbox = [[-1.0, -1.0], [0.001, 2.0]]\n"
              "[integrator]\nname = \"backward_euler\"\nstep = 0.01\n");
    const auto result = run("ablate own.toml --report r.json");
    EXPECT_EQ(result.code, 0) << result.error;
    return rows_of(read(folder_ / "r.json"))["three of four triangles"];
  };
  const auto refused = scene("one.obj");
  EXPECT_EQ(refused["verdict"], "refused");
  EXPECT_NE(refused["reason"].get<std::string>().find("incisions"), std::string::npos) << refused;
  std::string grid = "";
  const int n = 8;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      grid += "v " + std::to_string(1.0 * i / n) + " " + std::to_string(1.0 * j / n) + " 0\n";
  for (int j = 0; j < n; ++j)
    for (int i = 1; i <= n; ++i) {
      const auto corner = [&](int x, int y) { return " " + std::to_string(y * (n + 1) + x); };
      grid += "f" + corner(i, j) + corner(i + 1, j) + corner(i + 1, j + 1) + "\n";
      grid += "f" + corner(i, j) + corner(i + 1, j + 1) + corner(i, j + 1) + "\n";
    }
  write(folder_ / "grid.obj", grid);
  const auto coarser = scene("grid.obj");
  EXPECT_EQ(coarser["verdict"], "ok") << coarser;
  EXPECT_GT(coarser["deflection_m"], 0);
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
