// What tests of scene files share: a scene of a few lines in a folder of its own, read or refused.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "harness/scenes/scene_file.h"
#include "harness/simulation/scene.h"
#include "tests/mesh_checks.h"

namespace cutbench {

namespace fs = std::filesystem;

class SceneFile : public testing::Test {
 protected:
  void SetUp() override { fs::create_directories(folder_); }
  void TearDown() override { fs::remove_all(folder_); }

  void write(const std::string& text) { std::ofstream(file_) << text; }
  /// A scene of these lines, with an effect and a truth.
  Scene read(const std::string& lines) {
    write("effect = \"e\"\ntruth = \"t\"\n" + lines);
    return read_scene(file_);
  }
  void expect_refused_text(const std::string& text, const std::string& part) {
    write(text);
    expect_refused([&] { read_scene(file_); }, part);
    EXPECT_EQ(error_of([&] { read_scene(file_); }).find(file_.string()), 0u) << "doesn't begin with the file";
  }

  fs::path folder_ = fs::temp_directory_path() / ("cutbench_scene_test" + std::to_string(getpid()));
  fs::path file_ = folder_ / "a.scene.toml";
};

}  // namespace cutbench
