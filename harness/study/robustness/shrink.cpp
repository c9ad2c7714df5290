#include "harness/study/robustness/shrink.h"

#include "harness/base/conversions.h"
#include "harness/mesh/check_and_repair.h"

namespace cutbench {

namespace {

/// Erases runs of `step`, 2 `step`, ... items, halving their number from all of them down to `step` itself, but leaves
/// `least` items. still_fails() looks at `items` as they then are.
template <class Item, class StillFails>
void leave_out(std::vector<Item>& items, std::size_t step, std::size_t least, StillFails still_fails) {
  if (items.size() <= least) return;
  for (std::size_t run = (items.size() - least) / step; run > 0; run /= 2)
    for (std::size_t i = 0; i + run * step <= items.size() && items.size() >= least + run * step;) {
      const std::vector<Item> whole = items;
      const auto first = items.begin() + to_index(i);
      items.erase(first, first + to_index(run * step));
      if (still_fails()) continue;
      items = whole;
      i += run * step;
    }
}

}  // namespace

CutCase shrunk(CutCase cut_case, const std::function<bool(const CutCase&)>& still_fails) {
  leave_out(cut_case.cuts, 1, 1, [&] { return still_fails(cut_case); });
  for (Curve& curve : cut_case.cuts) {
    const bool bezier = curve.kind == Curve::Kind::bezier;
    if (bezier && curve.closed) continue;
    leave_out(curve.points, bezier ? 3 : 1, bezier ? 4 : curve.closed ? 3 : 2, [&] { return still_fails(cut_case); });
  }
  // Each part is tried as a reader of its file would get it: without unused vertices, and with fans of triangles that
  // share only a vertex separated.
  const std::vector<std::array<std::int32_t, 3>> all = cut_case.mesh.triangles;
  MeshData whole = cut_case.mesh;
  const auto repaired = [&] {
    MeshData mesh = whole;
    mesh.notes.clear();
    check_and_repair(mesh, "a part of the sheet");
    return mesh;
  };
  leave_out(whole.triangles, 1, 1, [&] { return still_fails({repaired(), cut_case.cuts}); });
  if (whole.triangles != all) cut_case.mesh = repaired();
  return cut_case;
}

}  // namespace cutbench
