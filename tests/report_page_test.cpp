// What experiments/reproduce goes through without being told, and results/report.html of a folder with one scene in it
// (tests/check_report.py).

#include "tests/program.h"

namespace cutbench {
namespace {

using ReportPage = Program;

/// Debian's python3: that of experiments/set_up.
TEST_F(ReportPage, OpensFromDiskAndSaysWhatWasRun) {
  const fs::path scene = fs::path(CUTBENCH_TEST_CASES) / "../../experiments/scenes/picked_cut.toml";
  const Result made = run("simulate '" + scene.string() +
                              "' --method conventional_split --resolution 200 --every 40 --frames "
                              "results/picked_cut/picked_cut/conventional_split",
                          "mkdir -p results/picked_cut/picked_cut/conventional_split;");
  ASSERT_EQ(made.code, 0) << made.error << made.out;
  const Result checked =
      run("methods >/dev/null; /usr/bin/python3 '" CUTBENCH_TEST_CASES "/../check_report.py' results");
  EXPECT_EQ(checked.code, 0) << checked.out << checked.error;
}

/// Told a name it doesn't know, it lists all that it does.
TEST_F(ReportPage, ReproduceKnowsScriptsThatDraw) {
  const fs::path project = fs::path(CUTBENCH_TEST_CASES) / "../..";
  const Result refused = run("methods >/dev/null; '" + (project / "experiments/reproduce").string() + "' nope");
  EXPECT_EQ(refused.code, 2) << refused.error;
  const std::string before = "there are: ";
  const std::size_t list = refused.error.find(before);
  ASSERT_NE(list, std::string::npos) << refused.error;
  std::istringstream names(refused.error.substr(list + before.size()));
  std::size_t count = 0;
  for (std::string name; names >> name; ++count) {
    fs::path script;
    for (const auto& room : fs::directory_iterator(project / "plots/figures"))
      if (fs::exists(room.path() / (name + ".py"))) script = room.path() / (name + ".py");
    EXPECT_NE(read(script).find("__main__"), std::string::npos) << name;
  }
  EXPECT_GE(count, 10u);
}

}  // namespace
}  // namespace cutbench
