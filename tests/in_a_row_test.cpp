// Many cuts on one sheet, without a rest between them: no failure, and no memory but the mesh's.

#include <gtest/gtest.h>
#include <malloc.h>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/judge/oracle_request.h"
#include "harness/mesh/families.h"
#include "methods/registry.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

/// Of the heap, in use, large blocks included; 0 under sanitizers, which have their own.
std::size_t heap_bytes() {
  const auto info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

class InARow : public testing::TestWithParam<std::size_t> {
 protected:
  const MethodRow& row() const { return whole_sheet_methods()[GetParam()]; }
  /// Without local split: each round would multiply the triangles.
  std::unique_ptr<CuttingMethod> make() const {
    return row().make(row().name == "bowyer_watson" ? 0 : row().parameter.value);
  }
  /// Those that refine, or mesh the whole sheet each time, need as long for ten cuts as others for a hundred.
  std::size_t cuts() const {
    const bool long_ones =
        row().name == "global_remesh" || row().name == "adaptive_remesh" || row().parameter.name == "bound";
    return scaled(long_ones ? 50 : 500);
  }
};

TEST_P(InARow, ThousandCutsWithoutFailure) {
  for (const std::string family : {"grid", "graded"}) {
    Sheet sheet(make_sheet(family, 10));
    Locator locator(sheet);
    Cutter cutter;
    const auto method = make();
    const CutOptions options;
    std::size_t changed = 0, failures = 0;
    for (std::size_t i = 0; i < cuts(); ++i) {
      const Curve curve = make_small_cut(11, i, sheet);
      const bool judged = i % 125 == 49;  // the oracle takes far longer than the cuts
      const Sheet before = judged ? sheet : Sheet();
      const CutOutcome outcome = cutter.cut(sheet, locator, curve, *method, options);
      std::string what =
          outcome.status == Status::failed ? std::string(name_of(outcome.verdict)) + ": " + outcome.reason : "";
      if (judged && what.empty()) what = faults(sheet);
      if (judged && what.empty())
        for (const auto& problem :
             oracle::judge(request_for(before, {&curve, 1}, row().promises, options, true), for_oracle(sheet)).problems)
          what += problem + "; ";
      changed += outcome.status == Status::ok;
      if (what.empty()) continue;
      ADD_FAILURE() << what << "\ncut " << i << " on " << family << ": " << text_of(curve);
      if (++failures == 5) FAIL() << "and so on";
    }
    EXPECT_GT(changed, cuts() * 9 / 10);
  }
}

/// What is held after many cuts, against a sheet, locator and cutter that begin with the mesh as it is then.
TEST_P(InARow, HoldsNoMemoryButTheMeshs) {
  const auto hold = [this](const MeshData& mesh, std::size_t from, std::size_t to, MeshData& end) {
    const std::size_t before = heap_bytes();
    Sheet sheet(mesh);
    Locator locator(sheet);
    Cutter cutter;
    const auto method = make();
    for (std::size_t i = from; i < to; ++i)
      cutter.cut(sheet, locator, make_small_cut(11, i, sheet), *method, CutOptions());
    const std::size_t held = heap_bytes() - before;
    end = sheet.to_mesh_data();
    return to_double(held);
  };
  if (heap_bytes() == 0) GTEST_SKIP() << "the heap can't be asked";
  MeshData end, ignored;
  const double after_all = hold(make_sheet("grid", 10), 0, cuts(), end);
  const double after_one = hold(end, cuts(), cuts() + 1, ignored);
  RecordProperty("ratio_percent", to_int(100 * after_all / after_one));
  // Vectors that grew may hold twice what they need.
  EXPECT_LT(after_all, 2 * after_one) << end.triangles.size() << " triangles";
}

/// Nor for cuts that find nothing to do, and those that are undone.
TEST_P(InARow, CutsWithoutEffectTakeNoMemory) {
  if (heap_bytes() == 0) GTEST_SKIP() << "the heap can't be asked";
  constexpr std::size_t undivided = 1000;  // rests of blocks that fitted; a block lost per cut is 6,000 bytes and more
  Sheet sheet(make_sheet("delaunay", 10));
  Locator locator(sheet);
  Cutter cutter;
  const auto method = make();
  const auto& [low, high, h] = extent_of(sheet);
  const Curve line{Curve::Kind::polyline, false, {{low.x - h, low.y + 0.3 * (high.y - low.y)}, {high.x, high.y}}};
  cutter.cut(sheet, locator, line, *method, CutOptions());
  std::size_t held = 0;
  for (std::size_t i = 0; i < 200; ++i) {
    const Status again = cutter.cut(sheet, locator, line, *method, CutOptions()).status;
    ASSERT_TRUE(again == Status::noop || (i < 10 && !row().promises.exact_incision)) << name_of(again);
    if (i == 10) held = heap_bytes();
  }
  EXPECT_LE(heap_bytes(), held + undivided);
  const Locator kept = locator;
  for (std::size_t i = 0; i < 200; ++i) {
    const Curve curve = make_case("recut", 3, i % 5, sheet).front();
    ASSERT_EQ(cutter.cut(sheet, locator, curve, *method, CutOptions()).status, Status::ok);
    sheet.rollback();
    locator = kept;
    if (i == 10) held = heap_bytes();
  }
  EXPECT_LE(heap_bytes(), held + undivided);
}

INSTANTIATE_TEST_SUITE_P(Methods, InARow, testing::Range(std::size_t{0}, whole_sheet_methods().size()),
                         [](const auto& parameter) { return whole_sheet_methods()[parameter.param].name; });

}  // namespace
}  // namespace cutbench
