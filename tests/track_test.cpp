// The rows of performance tracking: each is the same twice, and compare takes what they print.
#include <nlohmann/json.hpp>

#include "tests/program.h"

namespace cutbench {
namespace {

class Track : public Program {
 protected:
  Result track(const std::string& arguments) { return run_program(CUTBENCH_TRACK_PROGRAM, arguments); }
};

TEST_F(Track, RowsRepeat) {
  const auto rows = lines_of(track("list").out);
  EXPECT_GT(rows.size(), 50u);
  for (const auto& row : rows) {
    if (!row.ends_with("/800")) continue;
    const auto first = track("count " + row), second = track("count " + row);
    ASSERT_EQ(first.code, 0) << row << ": " << first.error;
    EXPECT_EQ(first.out, second.out) << row;
    const auto json = nlohmann::json::parse(first.out);
    EXPECT_EQ(json.at("id"), row);
    EXPECT_GT(json.at("units"), 0) << row;
  }
}

TEST_F(Track, UnknownRow) {
  const auto result = track("count nothing/800");
  EXPECT_EQ(result.code, 2);
  EXPECT_NE(result.error.find("there is no row nothing/800"), std::string::npos) << result.error;
}

// The smallest form of tests/injection.
TEST_F(Track, SpentInstructionsAreFoundAndNamed) {
  write(folder_ / "count.py", R"(import json, sys
sys.path.insert(0, sys.argv[1])
import tracking
row = tracking.count_phase(sys.argv[2], "trace/800", int(sys.argv[3]))
print(json.dumps({"format": 1, "commit": "", "tools": {"of": "this test"}, "rows": [row]})))");
  const auto count = [&](const std::string& turns, const std::string& name) {
    const auto result = run_program(
        "/usr/bin/python3", "count.py '" CUTBENCH_EXPERIMENTS "/scripts' '" CUTBENCH_TRACK_PROGRAM "' " + turns);
    EXPECT_EQ(result.code, 0) << result.error;
    write(folder_ / name, result.out);
  };
  count("0", "base.json");
  count("0", "same.json");
  count("2500", "slower.json");
  const auto same = run("compare base.json same.json");
  EXPECT_EQ(same.code, 0) << same.out << same.error;
  const auto slower = run("compare base.json slower.json");
  EXPECT_EQ(slower.code, 1) << slower.error;
  EXPECT_TRUE(slower.out.starts_with("SLOWER: 1 rows of 1\nworst: phase trace, row trace/800: instructions +"))
      << slower.out;
}

/// As experiments/track_wall and `experiments/history --time` ask for it.
TEST_F(Track, ARowHasATime) {
  write(folder_ / "time.py", R"(import pathlib, sys
sys.path.insert(0, sys.argv[1])
import tracking
programs = tracking.Programs(tracking.Tracked(), ".", pathlib.Path(sys.argv[2]).parent)
with tracking.timer(programs, "trace/800") as run:
    print("time" if run() > 0 else "no time"))");
  const auto timed =
      run_program("/usr/bin/python3", "time.py '" CUTBENCH_EXPERIMENTS "/scripts' '" CUTBENCH_TRACK_PROGRAM "'");
  EXPECT_EQ(timed.code, 0) << timed.error;
  EXPECT_EQ(timed.out, "time\n");
}

/// Debian's python3: that of experiments/set_up.
TEST_F(Track, HistoryAndPairsFindChanges) {
  const auto checked = run("methods >/dev/null; /usr/bin/python3 '" CUTBENCH_TEST_CASES "/../check_tracking.py' .");
  EXPECT_EQ(checked.code, 0) << checked.out << checked.error;
}

}  // namespace
}  // namespace cutbench
