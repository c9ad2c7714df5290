// The price of the constraints in a case of several cuts: they are found after each of its cuts, as in a simulation.
#include "harness/study/worker.h"

#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <thread>

#include "harness/base/conversions.h"
#include "harness/cut/constraint_source.h"
#include "harness/mesh/families.h"
#include "methods/registry.h"
#include "tests/fem_helpers.h"

namespace cutbench {
namespace {

constexpr std::chrono::milliseconds slowness{2};

/// Counts what it is asked for, and takes its time.
class ConstrainsSlowly final : public CuttingMethod, private ConstraintSource {
 public:
  ConstrainsSlowly(std::optional<ConstraintKind> kind, std::size_t* asked) : kind_(kind), asked_(asked) {}
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override {
    CuttingMethod::embed(sheet, trace, notes);
    if (++embedded_ == fails_at) throw CutFailed(Verdict::inverted, "on purpose");
  }
  const ConstraintSource* constraint_source() const override { return kind_ ? this : nullptr; }

  std::size_t fails_at = 0;

 private:
  ConstraintKind constraint_kind() const override { return *kind_; }
  Constraints constraints(const Sheet&, const Sheet&) const override {
    ++*asked_;
    std::this_thread::sleep_for(slowness);
    return {};
  }

  std::optional<ConstraintKind> kind_;  ///< none: it is no source of constraints
  std::size_t *asked_, embedded_ = 0;
};

class WorkerTest : public testing::Test {
 protected:
  /// Cuts once, by the method that constraints() counts for.
  CutRun cut(const std::vector<Curve>& cuts, std::optional<ConstraintKind> kind, std::size_t fails_at = 0) {
    auto row = std::make_shared<MethodRow>(find_method("conventional_split"));
    row->factory = [&](double) {
      auto method = std::make_unique<ConstrainsSlowly>(kind, &asked_);
      method->fails_at = fails_at;
      return method;
    };
    asked_ = 0;
    return Worker({row, 0}).cut(base_, cuts, {});
  }
  static double us(std::size_t times) { return 1e3 * to_double(times) * slowness.count(); }

  const BaseSheet base_{Sheet(make_sheet("grid", 10))};
  const std::vector<Curve> three_cuts_{line({-0.1, 0.22}, {1.1, 0.27}), line({0.31, 0.51}, {0.62, 0.58}),
                                       line({-0.1, 0.73}, {1.1, 0.78})};
  std::size_t asked_ = 0;
};

TEST_F(WorkerTest, ConstraintsAreFoundAfterEachCutThatIsMade) {
  const CutRun three = cut(three_cuts_, ConstraintKind::vertices);
  EXPECT_EQ(three.status, Status::ok);
  EXPECT_EQ(asked_, 3u);
  EXPECT_GE(three.time_us.constrain, us(3));

  std::vector<Curve> beside = three_cuts_;
  beside.insert(beside.begin() + 1, line({2, 2}, {3, 3}));
  EXPECT_EQ(cut(beside, ConstraintKind::phantoms).status, Status::ok);
  EXPECT_EQ(asked_, 3u) << "a cut that had nothing to do";

  const CutRun failed = cut(three_cuts_, ConstraintKind::vertices, 2);
  EXPECT_EQ(failed.status, Status::failed);
  EXPECT_EQ(asked_, 1u);
  EXPECT_GE(failed.time_us.constrain, us(1));
}

TEST_F(WorkerTest, PolygonsAreFoundOnceSinceAScenesFollowTheLastCut) {
  const CutRun three = cut(three_cuts_, ConstraintKind::polygons);
  EXPECT_EQ(three.status, Status::ok);
  EXPECT_EQ(asked_, 1u);
  EXPECT_GE(three.time_us.constrain, us(1));
}

TEST_F(WorkerTest, AMethodThatConstrainsNothingIsNotAsked) {
  EXPECT_EQ(cut(three_cuts_, {}).time_us.constrain, 0);
  EXPECT_EQ(asked_, 0u);
}

TEST_F(WorkerTest, ItsConstraintsAreThoseOfAllCuts) {
  for (const std::string name : {"split_and_tie", "phantom_node", "cut_polygons"}) {
    SCOPED_TRACE(name);
    const auto row = std::make_shared<MethodRow>(find_method(name));
    Worker worker({row, row->parameter.value});
    for (const bool cold : {false, true}) {
      const CutRun run = worker.measure(base_, three_cuts_, {}, cold);
      EXPECT_GT(run.time_us.constrain, 0);
      const Constraints all = constraints_of(*worker.method, base_.sheet, worker.sheet);
      EXPECT_FALSE(all.empty());
      EXPECT_EQ(worker.constraints.constraints.size(), all.constraints.size());
      EXPECT_EQ(worker.constraints.polygons, all.polygons);
    }
  }
}

}  // namespace
}  // namespace cutbench
