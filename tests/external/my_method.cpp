// `cutbench` with one method more: the Delaunay split, whose largest angles are then flipped away once.
#include <cutbench/command_line.h>
#include <cutbench/cut/delaunay_split.h>
#include <cutbench/mesh/one_ring.h>

namespace {

using namespace cutbench;

class FlipOnce final : public CuttingMethod {
 public:
  void improve(Sheet& sheet, MethodNotes&) override {
    std::vector<TriangleIndex> changed;
    for_each_changed(sheet, [&](TriangleIndex t) { changed.push_back(t); });
    for (const TriangleIndex t : changed)
      for (int k = 0; k < 3; ++k) {
        const HalfEdge h = half_edge(t, k), o = sheet.opposite(h);
        if (!o.valid() || sheet.separates(h)) continue;
        const Point2 a = sheet.rest(sheet.origin(h)), b = sheet.rest(sheet.target(h));
        const Point2 c = sheet.rest(sheet.origin(Sheet::previous(h))), d = sheet.rest(sheet.origin(Sheet::previous(o)));
        if (in_circle(a, b, c, d) > 0) sheet.flip(h);
      }
  }
};

}  // namespace

int main(int argc, char** argv) {
  return command_line(
      argc, argv,
      {{.name = "flip_once",
        .summary = "the Delaunay split and one round of flips",
        .parameter = {},
        .promises = {.exact_incision = true, .keeps_area = true, .conforming = true, .keeps_vertices = true},
        .factory = [](double) { return std::make_unique<FlipOnce>(); }}});
}
