// results/report.html of a folder with one scene in it (tests/check_report.py).

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

}  // namespace
}  // namespace cutbench
