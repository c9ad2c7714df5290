#include "methods/tools/region.h"

#include "harness/base/conversions.h"
#include "harness/mesh/one_ring.h"

namespace cutbench {

void Region::clear(const Sheet& sheet) {
  triangles_.clear();
  place_.clear(sheet.triangle_slots());
}

void Region::add(TriangleIndex t) {
  if (place_.insert(t, to_int(triangles_.size()))) triangles_.push_back(t);
}

void Region::add_changed(const Sheet& sheet) {
  for_each_changed(sheet, [&](TriangleIndex t) { add(t); });
}

void Region::grow(const Sheet& sheet, int rings) {
  std::size_t begin = 0;
  for (int ring = 0; ring < rings; ++ring) {
    const std::size_t end = triangles_.size();
    for (; begin < end; ++begin)
      for (int k = 0; k < 3; ++k)
        if (const HalfEdge o = sheet.opposite(half_edge(triangles_[begin], k)); o.valid()) add(triangle_of(o));
  }
  const auto sees_right_angle = [&](HalfEdge h) {  // or a wider one, at the corner opposite h
    const Point2 c = sheet.rest(sheet.origin(Sheet::previous(h)));
    return dot(sheet.rest(sheet.origin(h)) - c, sheet.rest(sheet.target(h)) - c) <= 0;
  };
  for (std::size_t i = 0; i < triangles_.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(triangles_[i], k), o = sheet.opposite(h);
      if (o.valid() && !holds(triangle_of(o)) && (sees_right_angle(h) || sees_right_angle(o))) add(triangle_of(o));
    }
}

}  // namespace cutbench
