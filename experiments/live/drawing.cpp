// The sheet as triangles of their own, to be drawn.
#include <algorithm>

#include "experiments/live/live_sheet.h"
#include "harness/mesh/mesh_text.h"
#include "harness/mesh/quality.h"
#include "harness/mesh/rest_choice.h"

namespace cutbench::live {

/// Both sides belong to one polygon.
bool LiveSheet::is_in_polygon(HalfEdge h) const {
  const ElementTable& elements = now_.model.elements();
  const TriangleIndex one = triangle_of(h), other = triangle_of(now_.sheet.opposite(h));
  const auto members = elements.members(one);
  return members.size() > 1 && std::find(members.begin(), members.end(), other) != members.end();
}

/// Of the edges from the corners 0, 1, 2, as sum of 4^k times the kind.
int LiveSheet::edges_of(TriangleIndex t) const {
  const Sheet& sheet = now_.sheet;
  int edges = 0;
  for (int k = 2; k >= 0; --k) {
    const HalfEdge h = half_edge(t, k);
    const int kind = sheet.on_border(h) ? 3 : sheet.separates(h) ? 2 : is_in_polygon(h) ? 1 : 0;
    edges = 4 * edges + kind;
  }
  return edges;
}

std::array<Point3, 3> LiveSheet::corners_in_space(TriangleIndex t) const {
  std::array<Point3, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto x = now_.state.x.segment<3>(to_index(3 * now_.sheet.triangle(t).deformed[k]()));
    corners[k] = {x[0], x[1], x[2]};
  }
  return corners;
}

const std::vector<float>& LiveSheet::draw(Colour colour, bool at_rest) {
  const Sheet& sheet = now_.sheet;
  soup_.clear();
  std::vector<std::int32_t> pieces;
  if (colour == Colour::piece) pieces = pieces_of(sheet.to_mesh_data());
  std::size_t row = 0;
  for (std::size_t i = 0; i < sheet.triangle_slots(); ++i) {
    const TriangleIndex t(i);
    if (!sheet.triangle(t).alive()) continue;
    const auto rest = sheet.corners(t);
    const auto now = corners_in_space(t);
    double value = 0;
    if (colour == Colour::aspect_ratio) value = aspect_ratio(rest[0], rest[1], rest[2]);
    if (colour == Colour::strain) value = stretch_of(rest, now).strain();
    if (colour == Colour::piece) value = pieces[row];
    ++row;
    const double edges = edges_of(t);
    for (std::size_t k = 0; k < 3; ++k) {
      const Point3 x = at_rest ? Point3{rest[k].x, rest[k].y, 0} : now[k];
      for (const double number : {x.x, x.y, x.z, value, edges}) soup_.push_back(static_cast<float>(number));
    }
  }
  return soup_;
}

}  // namespace cutbench::live
