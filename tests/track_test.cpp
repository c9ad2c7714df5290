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

}  // namespace
}  // namespace cutbench
