#include "harness/run/shrink.h"

#include "harness/mesh/mesh_io.h"

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
      const auto first = items.begin() + static_cast<std::ptrdiff_t>(i);
      items.erase(first, first + static_cast<std::ptrdiff_t>(run * step));
      if (still_fails()) continue;
      items = whole;
      i += run * step;
    }
}

}  // namespace

Specimen shrunk(Specimen specimen, const std::function<bool(const Specimen&)>& still_fails) {
  leave_out(specimen.cuts, 1, 1, [&] { return still_fails(specimen); });
  for (Curve& curve : specimen.cuts) {
    const bool bezier = curve.kind == Curve::Kind::bezier;
    if (bezier && curve.closed) continue;
    leave_out(curve.points, bezier ? 3 : 1, bezier ? 4 : curve.closed ? 3 : 2, [&] { return still_fails(specimen); });
  }
  // What is tried is what reading the file would give: unused vertices dropped, fans parted.
  const std::vector<std::array<std::int32_t, 3>> all = specimen.mesh.triangles;
  MeshData whole = specimen.mesh;
  const auto mended = [&] {
    MeshData mesh = whole;
    mesh.notes.clear();
    check_and_repair(mesh, "a part of the sheet");
    return mesh;
  };
  leave_out(whole.triangles, 1, 1, [&] { return still_fails({mended(), specimen.cuts}); });
  if (whole.triangles != all) specimen.mesh = mended();
  return specimen;
}

}  // namespace cutbench
