// What tests of the program share: a folder of their own, and the program run in it.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "harness/records/record.h"

namespace cutbench {

namespace fs = std::filesystem;

inline std::string read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// Everything but the times, and the memory.
inline std::multiset<std::string> without_times(const std::string& csv) {
  std::vector<bool> kept_column;
  for (const auto& name : column_names()) kept_column.push_back(!name.ends_with("_us") && !name.ends_with("_mb"));
  std::multiset<std::string> rows;
  for (const auto& line : lines_of(csv)) {
    std::string kept;
    std::istringstream fields(line);
    std::string field;
    for (std::size_t i = 0; std::getline(fields, field, ','); ++i)
      if (kept_column.at(i)) kept += field + ",";
    rows.insert(kept);
  }
  return rows;
}

class Program : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("cutbench_" + std::string(info->name()) + std::to_string(getpid()));
    fs::create_directories(folder_);
    write(folder_ / "path.json", R"({"cuts":[{"bezier":[[-0.1,0.3],[0.3,0.9],[0.6,0.1],[1.1,0.7]]}]})");
    write(folder_ / "sheet.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
  }
  void TearDown() override { fs::remove_all(folder_); }

  struct Result {
    int code;
    std::string out, error;
  };
  /// The shell runs it: `arguments` may hold quotes and redirections, `before` what comes before the program.
  Result run(const std::string& arguments, const std::string& before = "") {
    return run_program(CUTBENCH_PROGRAM, arguments, before);
  }
  Result run_program(const std::string& program, const std::string& arguments, const std::string& before = "") {
    const fs::path out = folder_ / "stdout", error = folder_ / "stderr";
    const std::string command =
        "cd '" + folder_.string() + "' && { " + before + " '" + program + "' " + arguments + "; } >stdout 2>stderr";
    const int status = std::system(command.c_str());
    return {WEXITSTATUS(status), read(out), read(error)};
  }
  Result cut(const std::string& more = "", const std::string& method = "conventional_split") {
    return run("cut --mesh sheet.off --path path.json --out out.obj --method " + method + " " + more);
  }
  /// Names relative to the folder, all that is in it but what run() made.
  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder_)) {
      const std::string name = fs::relative(entry.path(), folder_).string();
      if (name != "stdout" && name != "stderr") names.insert(name);
    }
    return names;
  }

  static std::string small_experiment(const std::string& more = "") {
    return "claim = \"c\"\nsheets = [\"grid\", \"delaunay\"]\nresolutions = [200]\ncut_families = [\"curved\", "
           "\"recut\"]\n"
           "cases = 3\nrepetitions = 2\nmethods = [\"conventional_split\", {name = \"bowyer_watson\", parameter = [0, "
           "1]}]\n" +
           more;
  }

  fs::path folder_;
};

}  // namespace cutbench
