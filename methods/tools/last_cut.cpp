#include "methods/tools/last_cut.h"

#include <algorithm>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

template <class T>
void sort_and_unite(std::vector<T>& all) {
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
}

template <class T>
bool holds(const std::vector<T>& sorted, const T& one) {
  return std::binary_search(sorted.begin(), sorted.end(), one);
}

}  // namespace

std::span<const CopiedElement> elements_of(const std::vector<CopiedElement>& copied, TriangleIndex parent) {
  const auto first = std::lower_bound(copied.begin(), copied.end(), parent,
                                      [](const CopiedElement& e, TriangleIndex p) { return e.parent < p; });
  const auto last = std::find_if(first, copied.end(), [&](const CopiedElement& e) { return e.parent != parent; });
  return std::span(copied).subspan(to_size(first - copied.begin()), to_size(last - first));
}

LastCut::LastCut(const Sheet& before, const Sheet& cut, const Constraints& last)
    : before_(before), cut_(cut), last_(last) {
  find_touched();
  find_reached();
  for (const TriangleIndex parent : reached_) add_near(parent);
}

bool LastCut::touches(VertexIndex v) const { return holds(corners_, v); }
bool LastCut::reaches(TriangleIndex parent) const { return holds(reached_, parent); }
bool LastCut::is_touched(TriangleIndex t) const { return t() >= cut_.log().triangles_before || holds(touched_, t); }

void LastCut::find_touched() {
  for (const auto& touched : cut_.log().touched) touched_.push_back(touched.slot);
  sort_and_unite(touched_);
  TriangleIndex parent{0};
  const auto add = [&](TriangleIndex t) {
    if (!cut_.triangle(t).alive()) return;
    parent = parent_of(before_, cut_, t, parent);
    touched_parts_.push_back({parent, t});
    for (const VertexIndex v : before_.triangle(parent).vertex) corners_.push_back(v);
  };
  for (const TriangleIndex t : touched_) add(t);
  for (std::size_t t = cut_.log().triangles_before; t < cut_.triangle_slots(); ++t) add(TriangleIndex(t));
  sort_and_unite(touched_parts_);
  sort_and_unite(corners_);
}

void LastCut::find_reached() {
  for (const VertexIndex v : corners_) {
    const HalfEdge first = before_.first_outgoing(v);
    HalfEdge h = first;
    do reached_.push_back(triangle_of(h));
    while ((h = before_.next_outgoing(h)).valid() && h != first);
  }
  sort_and_unite(reached_);
}

/// What is left of its parts from before the cut, and what the cut made of them; or it is whole.
void LastCut::add_near(TriangleIndex parent) {
  const auto old = elements_of(last_.copied, parent);
  for (const CopiedElement& element : old)
    for (const TriangleIndex t : element.triangles)
      if (!is_touched(t)) add_if_near(t, parent);
  auto made = std::lower_bound(touched_parts_.begin(), touched_parts_.end(), ByParent{parent, TriangleIndex{0}});
  if (old.empty() && (made == touched_parts_.end() || made->parent != parent)) add_if_near(parent, parent);
  for (; made != touched_parts_.end() && made->parent == parent; ++made) add_if_near(made->part, parent);
}

void LastCut::add_if_near(TriangleIndex t, TriangleIndex parent) {
  bool near = is_part(before_, cut_, t);
  for (int k = 0; k < 3 && !near; ++k)
    if (const HalfEdge h = half_edge(t, k); !cut_.separates(h))
      near = is_part(before_, cut_, triangle_of(cut_.opposite(h)));
  if (near) near_.push_back({t, parent});
}

}  // namespace cutbench
