#include "methods/tools/parts.h"

#include <algorithm>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/union_find.h"
#include "harness/mesh/locator.h"

namespace cutbench {

Parts::Parts(const Sheet& before, const Sheet& cut) : before_(before), cut_(cut) {
  find_triangles();
  join();
}

Parts::Parts(const Sheet& before, const Sheet& cut, std::vector<DividedTriangle> near)
    : before_(before), cut_(cut), near_(std::move(near)) {
  join();
}

void Parts::join() {
  std::sort(near_.begin(), near_.end(), [](const auto& a, const auto& b) { return a.part < b.part; });
  const auto same = [](const auto& a, const auto& b) { return a.part == b.part; };
  near_.erase(std::unique(near_.begin(), near_.end(), same), near_.end());
  for (std::size_t i = 0; i < size(); ++i)
    vertices_.insert(vertices_.end(), triangle(i).deformed.begin(), triangle(i).deformed.end());
  std::sort(vertices_.begin(), vertices_.end());
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  UnionFind joined(size());
  for_each_joint([&](std::size_t i, std::size_t j, HalfEdge) {
    if (have_one_parent(i, j)) joined.join(i, j);
  });
  part_.resize(size());
  for (std::size_t i = 0; i < size(); ++i) part_[i] = joined.find(i);
}

void Parts::find_triangles() {
  near_ = divided_triangles(before_, cut_);
  for (std::size_t i = 0, divided = near_.size(); i < divided; ++i)
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(near_[i].part, k);
      if (cut_.separates(h)) continue;
      const TriangleIndex u = triangle_of(cut_.opposite(h));
      const auto& corners = cut_.triangle(u).vertex;
      if (std::none_of(corners.begin(), corners.end(), [&](VertexIndex v) { return is_new(v); }))
        near_.push_back({u, whole_parent(u, near_[i].parent)});
    }
}

/// Its own slot, unless it was made anew beside one that was divided.
TriangleIndex Parts::whole_parent(TriangleIndex t, TriangleIndex beside) const {
  if (t() < before_.triangle_slots() && before_.triangle(t).vertex == cut_.triangle(t).vertex) return t;
  const auto c = cut_.corners(t);
  return triangle_at(before_, beside, 1.0 / 3 * (c[0] + c[1] + c[2]));
}

std::size_t Parts::place_of(TriangleIndex t) const {
  const auto found =
      std::lower_bound(near_.begin(), near_.end(), t, [](const auto& a, TriangleIndex b) { return a.part < b; });
  return found != near_.end() && found->part == t ? to_size(found - near_.begin()) : near_.size();
}

std::size_t Parts::number_of(DeformedIndex d) const {
  return to_size(std::lower_bound(vertices_.begin(), vertices_.end(), d) - vertices_.begin());
}

std::optional<std::size_t> Parts::corner_at(std::size_t i, VertexIndex v) const {
  const auto& corners = parent(i).vertex;
  const auto found = std::find(corners.begin(), corners.end(), v);
  if (found == corners.end()) return {};
  return to_size(found - corners.begin());
}

}  // namespace cutbench
