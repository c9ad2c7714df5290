// What a hand does to the sheet: it grabs, drags, lets go and pokes.
#include <algorithm>

#include "experiments/live/live_sheet.h"

namespace cutbench::live {

std::vector<LiveSheet::Near> LiveSheet::near(Point2 rest, double radius) const {
  const Sheet& sheet = now_.sheet;
  const Point3 at = place(rest);
  std::vector<std::uint8_t> met(sheet.deformed_slots(), 0), visited(sheet.triangle_slots(), 0);
  std::vector<TriangleIndex> stack{holder_of(rest)};
  visited[stack[0]()] = 1;
  std::vector<Near> found;
  while (!stack.empty()) {
    const TriangleIndex t = stack.back();
    stack.pop_back();
    bool is_near = found.empty();
    for (const DeformedIndex d : sheet.triangle(t).deformed) {
      const Point2 p = sheet.rest(sheet.rest_vertex(d)) - rest;
      const double r2 = (p.x * p.x + p.y * p.y) / (radius * radius);
      if (r2 >= 1 && !found.empty()) continue;
      is_near = true;
      if (met[d()]) continue;
      met[d()] = 1;
      const auto x = now_.state.x.segment<3>(to_index(3 * d()));
      found.push_back({d(), std::max(0.05, (1 - r2) * (1 - r2)), {x[0] - at.x, x[1] - at.y, x[2] - at.z}});
    }
    for (int k = 0; is_near && k < 3; ++k) {
      const HalfEdge h = half_edge(t, k);
      if (sheet.separates(h)) continue;
      const TriangleIndex other = triangle_of(sheet.opposite(h));
      if (visited[other()]) continue;
      visited[other()] = 1;
      stack.push_back(other);
    }
  }
  return found;
}

void LiveSheet::grab(Point2 rest, double radius) {
  grabbed_ = near(rest, radius);
  to_ = place(rest);
}

void LiveSheet::release() {
  if (grabbed_.empty()) return;
  grabbed_.clear();
  now_.model.set_pins_and_force(now_.sheet, now_.pins, {});
}

/// Critically damped springs, soft enough to be stable when they are taken from the step before.
void LiveSheet::pull() {
  const double rate = 0.2 / scene_.step;
  force_.assign(to_size(now_.state.x.size()), 0);
  for (const Near& n : grabbed_) {
    const auto x = now_.state.x.segment<3>(to_index(3 * n.vertex)), v = now_.state.v.segment<3>(to_index(3 * n.vertex));
    const double mass = now_.model.lumped_mass()[to_index(n.vertex)];
    const std::array<double, 3> goal{to_.x + n.offset.x, to_.y + n.offset.y, to_.z + n.offset.z};
    for (std::size_t k = 0; k < 3; ++k)
      force_[3 * n.vertex + k] = mass * n.weight * rate * (rate * (goal[k] - x[to_index(k)]) - 2 * v[to_index(k)]);
  }
  now_.model.set_pins_and_force(now_.sheet, now_.pins, force_);
}

void LiveSheet::poke(Point2 rest, double radius, Point3 velocity) {
  const std::array<double, 3> added{velocity.x, velocity.y, velocity.z};
  for (const Near& n : near(rest, radius))
    for (std::size_t k = 0; k < 3; ++k)
      if (const auto u = 3 * n.vertex + k; !now_.model.held()[u]) now_.state.v[to_index(u)] += n.weight * added[k];
}

}  // namespace cutbench::live
