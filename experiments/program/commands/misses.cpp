#include "experiments/program/commands/misses.h"

#include <algorithm>
#include <cstdio>

#include "harness/base/errors.h"
#include "harness/mesh/tolerances.h"
#include "harness/path/walk.h"

namespace cutbench {

namespace {

struct Bounds {
  Point2 low, high;
  void add(Point2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  std::string text() const {
    char buffer[128];
    std::snprintf(buffer, sizeof buffer, "x %.4g to %.4g, y %.4g to %.4g", low.x, high.x, low.y, high.y);
    return buffer;
  }
};

Bounds bounds_of(const Curve& curve) {
  Bounds bounds{curve.points.front(), curve.points.front()};
  for (const Point2 p : curve.points) bounds.add(p);
  return bounds;
}

Bounds bounds_of(const Sheet& sheet) {
  Bounds bounds{sheet.rest(VertexIndex(std::size_t{0})), sheet.rest(VertexIndex(std::size_t{0}))};
  for (std::size_t v = 0; v < sheet.vertex_slots(); ++v) bounds.add(sheet.rest(VertexIndex(v)));
  return bounds;
}

}  // namespace

bool meets(const Sheet& sheet, const Curve& curve) {
  const Bounds path = bounds_of(curve), all = bounds_of(sheet);
  if (path.low.x > all.high.x || path.high.x < all.low.x || path.low.y > all.high.y || path.high.y < all.low.y)
    return false;
  Polyline polyline;
  flatten(curve, default_flatten_tolerance * sheet.mean_edge(), sheet.snap(), polyline);
  const Locator locator(sheet);
  Walk walk(sheet, locator);
  if (walk.locate(polyline.points.front()).kind != Place::Kind::outside) return true;
  const std::size_t n = polyline.points.size();
  try {
    for (std::size_t i = 1; i < n + (polyline.closed ? 1 : 0); ++i)
      for (bool arrived = false; !arrived;) {
        const Step step = walk.advance(polyline.points[i % n]);
        if (step.place.kind != Place::Kind::outside) return true;
        arrived = step.arrived;
      }
  } catch (const WalkLost&) {
    return true;  // in the mesh, where the cut will say so
  }
  return false;
}

void Misses::add_to(Options& command) {
  command.add_flag("--allow-miss", allowed, "a path that misses the sheet cuts nothing, instead of being refused");
}

void Misses::check(const Sheet& sheet, const Curve& curve, const std::string& name) const {
  if (allowed || meets(sheet, curve)) return;
  throw InputError(name + ": misses the sheet: the path spans " + bounds_of(curve).text() + ", the sheet " +
                   bounds_of(sheet).text() + "; check the units, or give --allow-miss");
}

}  // namespace cutbench
