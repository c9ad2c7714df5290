// What tests of bad input through every door share: one line that says what, where and what to do, the right exit code,
// nothing left behind. What a single reader refuses, line by line, is in mesh_io_test, check_and_repair_test, path_test
// and refused_scenes_test.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/program.h"

namespace cutbench {

class BadInput : public Program {
 protected:
  struct Case {
    std::string arguments;
    int code;
    const char* message;  ///< part of the one line
  };

  /// The last line is the error; lines before it are notes. No file comes, goes or changes.
  void expect(const Case& c, const std::string& before = "") {
    SCOPED_TRACE(c.arguments);
    const auto files_before = files();
    const std::string sheet = read(folder_ / "sheet.off"), path = read(folder_ / "path.json");
    const Result result = run(c.arguments, before);
    EXPECT_EQ(result.code, c.code) << result.error;
    auto lines = lines_of(result.error);
    std::erase_if(lines, [](const std::string& line) { return line.starts_with("note: "); });
    ASSERT_EQ(lines.size(), 1u) << result.error;
    EXPECT_NE(lines[0].find(c.message), std::string::npos) << lines[0];
    EXPECT_EQ(lines[0].find("internal error"), std::string::npos) << lines[0];
    EXPECT_LT(lines[0].size(), 700u);
    EXPECT_EQ(files(), files_before);
    EXPECT_EQ(read(folder_ / "sheet.off"), sheet);
    EXPECT_EQ(read(folder_ / "path.json"), path);
  }
  void expect_all(const std::vector<Case>& table) {
    for (const Case& c : table) expect(c);
  }
  static std::string cut_with(const std::string& mesh, const std::string& path = "path.json",
                              const std::string& out = "out.obj") {
    return "cut --method cgal_cdt --mesh " + mesh + " --path " + path + " --out " + out;
  }
};

}  // namespace cutbench
