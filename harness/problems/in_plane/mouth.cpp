#include "harness/problems/in_plane/mouth.h"

#include <cmath>
#include <numbers>

#include "harness/base/conversions.h"
#include "harness/problems/common/border_edges.h"

namespace cutbench {

namespace {

/// At p, on this side of the cut or, where p lies beyond it, continued over it.
Eigen::Vector2d on_side(const ElasticField& field, Point2 p, bool above) {
  const Complex z = field.frame().to_local(p), up(0, 1);
  const Eigen::Vector2d over = field.displacement(p, field.frame().to_rest(z + up)),
                        under = field.displacement(p, field.frame().to_rest(z - up));
  if (over != under) return above ? over : under;  // p is on the cut itself
  return z.real() < 0 && above == std::signbit(z.imag()) ? -over : over;
}

}  // namespace

Field continued_over_the_mouth(const ElasticField& field, const Sheet& sheet) {
  const std::size_t none = sheet.deformed_slots();
  std::vector<std::size_t> next(none, none);
  std::vector<std::uint8_t> reached(none, 0);
  const auto rest = [&](std::size_t d) { return sheet.rest(sheet.rest_vertex(DeformedIndex(d))); };
  const auto place = [&](std::size_t d) { return field.frame().to_local(rest(d)); };
  Field values = Field::Zero(to_index(2 * none));
  const auto value = [&](std::size_t d) { return values.segment<2>(to_index(2 * d)); };
  for_each_border_edge(sheet, [&](HalfEdge h) {
    const auto [from, to] = deformed_ends(sheet, h);
    next[from()] = to();
    reached[to()] = 1;
    value(from()) = field.displacement(rest(from()));
  });

  std::vector<std::size_t> part;
  std::vector<double> angle;
  for (std::size_t start = 0; start < none; ++start) {
    if (reached[start] || next[start] == none) continue;
    part.assign(1, start);
    angle.assign(1, std::arg(place(start)));
    for (std::size_t d = start; next[d] != none; d = next[d]) {
      part.push_back(next[d]);
      angle.push_back(angle.back() + std::arg(place(next[d]) / place(d)));
    }
    // Of the angles that differ by whole turns, those whose mean over both ends is nearest to 0.
    const double turn = 2 * std::numbers::pi, middle = (angle.front() + angle.back()) / 2;
    for (std::size_t i = 0; i < part.size(); ++i)
      value(part[i]) = on_side(field, rest(part[i]), angle[i] > turn * std::round(middle / turn));
  }
  return values;
}

}  // namespace cutbench
