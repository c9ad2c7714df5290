// The small version of the accuracy experiment, and its figures and tables (tests/check_accuracy_plots.py).

#include "tests/program.h"

namespace cutbench {
namespace {

using AccuracyPlots = Program;

/// Debian's python3: that of experiments/set_up.
TEST_F(AccuracyPlots, ShowEveryMethodAndWhatFailed) {
  write(folder_ / "accuracy.toml",
        "claim = \"c\"\nsheets = [\"grid\"]\nresolutions = [72, 128, 200]\n"
        "methods = [\"conventional_split\", {name = \"bowyer_watson\", parameter = [0, 1]}]\n[accuracy]\n"
        "problems = [\"centre_crack\", \"arc_crack_45\"]\nmembers = [3, 3, 3]\ndirect = [\"cholmod\"]\n"
        "preconditioners = [\"cg\", \"cg_sliver_blocks\"]\niterations = [10, 100]\n");
  const Result made = run("run accuracy.toml --out results");
  ASSERT_EQ(made.code, 0) << made.error << made.out;
  const Result checked =
      run("methods >/dev/null; /usr/bin/python3 '" CUTBENCH_TEST_CASES "/../check_accuracy_plots.py' results");
  EXPECT_EQ(checked.code, 0) << checked.out << checked.error;
}

}  // namespace
}  // namespace cutbench
