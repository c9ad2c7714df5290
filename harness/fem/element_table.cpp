#include "harness/fem/element_table.h"

namespace cutbench {

namespace {

Element element_of(const Sheet& sheet, TriangleIndex t) {
  if (!sheet.triangle(t).alive()) return {};
  Element e;
  e.vertex = sheet.triangle(t).deformed;
  const auto c = sheet.corners(t);
  const double twice = cross(c[1] - c[0], c[2] - c[0]);
  e.area = twice / 2;
  // Each shape function rises across the triangle, at right angles to the edge opposite its corner.
  for (std::size_t k = 0; k < 3; ++k) {
    const Point2 edge = c[(k + 2) % 3] - c[(k + 1) % 3];
    e.gradient[k] = {-edge.y / twice, edge.x / twice};
  }
  return e;
}

}  // namespace

ElementTable::ElementTable(const Sheet& sheet) : rows_(sheet.triangle_slots()) {
  for (std::size_t t = 0; t < rows_.size(); ++t) rows_[t] = element_of(sheet, TriangleIndex(t));
}

void ElementTable::update(const Sheet& sheet) {
  const EditLog& log = sheet.log();
  rows_.resize(sheet.triangle_slots());
  for (const auto& touched : log.touched) rows_[touched.slot()] = element_of(sheet, touched.slot);
  for (std::size_t t = log.triangles_before; t < rows_.size(); ++t) rows_[t] = element_of(sheet, TriangleIndex(t));
}

}  // namespace cutbench
