// The time series that `cutbench simulate` writes, read back by other programs' readers.
#include "tests/program.h"

namespace cutbench {
namespace {

class FramesOnDisk : public Program {
 protected:
  /// A scene of the repository with other numbers: `changes` in pairs of what is there and what takes its place.
  void write_scene(const std::string& stem, std::initializer_list<std::pair<const char*, const char*>> changes) {
    std::string text = read(fs::path(CUTBENCH_TEST_CASES) / "../../experiments/scenes" / (stem + ".toml"));
    for (const auto& [from, to] : changes) {
      ASSERT_NE(text.find(from), std::string::npos) << from;
      text.replace(text.find(from), std::string(from).size(), to);
    }
    write(folder_ / "scene.toml", text);
  }
};

/// Debian's python3: that of experiments/set_up, with meshio. The scene is the paper's figure 6, shortened.
TEST_F(FramesOnDisk, AreReadByMeshioAndTheCutOutFallsByTheLaw) {
  write_scene("fig6_partial_and_cutout_cutout", {{"duration = 0.8", "duration = 0.2"}, {"time = 0.5", "time = 0.1"}});
  for (const std::string method : {"conventional_split", "bowyer_watson"}) {
    const auto result =
        run("simulate scene.toml --resolution 200 --method " + method + " --frames " + method + " --every 1");
    ASSERT_EQ(result.code, 0) << result.error;
    const auto check = run("methods >/dev/null; /usr/bin/python3 '" CUTBENCH_TEST_CASES "/../check_frames.py' " +
                           method + " 0.004166666666666667 0.5 9.81 0.1");
    EXPECT_EQ(check.code, 0) << check.out << check.error;
  }
}

TEST_F(FramesOnDisk, AreAsManyAsAskedForAndTheLast) {
  write_scene("fig5_single_cuts_straight", {{"duration = 1.5", "duration = 0.05"}, {"time = 0.5", "time = 0.02"}});
  ASSERT_EQ(run("simulate scene.toml --resolution 200 --frames f --every 5").code, 0);  // 12 steps
  EXPECT_EQ(files(), (std::set<std::string>{"f", "f/energy.csv", "f/frame_0000.vtu", "f/frame_0001.vtu",
                                            "f/frame_0002.vtu", "f/frame_0003.vtu", "f/frames.pvd", "f/last.obj",
                                            "f/simulation.json", "path.json", "scene.toml", "sheet.off"}));
  ASSERT_EQ(run("simulate scene.toml --resolution 200 --frames f --every 50").code, 0);
  const std::string pvd = read(folder_ / "f/frames.pvd");  // the older, longer series is not in it
  EXPECT_NE(pvd.find("frame_0001.vtu"), std::string::npos);
  EXPECT_EQ(pvd.find("frame_0002.vtu"), std::string::npos);
}

TEST_F(FramesOnDisk, SayWhatIsWrongBeforeTheWork) {
  write_scene("fig5_single_cuts_straight", {});
  for (const auto& [arguments, what] : {std::pair{"--frames none/f", "there is no folder none"},
                                        {"--frames scene.toml", "--frames scene.toml: "},
                                        {"--every 3", "--every requires --frames"},
                                        {"--frames f --every 0", "--every"}}) {
    const auto result = run("simulate scene.toml " + std::string(arguments));
    EXPECT_EQ(result.code, 2);
    EXPECT_NE(result.error.find(what), std::string::npos) << result.error;
    EXPECT_EQ(lines_of(result.error).size(), 1u) << result.error;
  }
}

}  // namespace
}  // namespace cutbench
