// Of the triangles that cuts divided, and of those beside them: which are parts of one triangle of the sheet before its
// first cut (its parent) and still joined, and where parts meet across edges of the sheet.
//
// A triangle is named by its place, 0 to size() - 1, in the order of the slots; a part by the first of its triangles.
#pragma once

#include <optional>
#include <vector>

#include "harness/mesh/sheet.h"
#include "methods/tools/divided.h"

namespace cutbench {

class Parts {
 public:
  /// \param before  the sheet before its first cut; both sheets must outlive this
  Parts(const Sheet& before, const Sheet& cut);
  /// Of these alone, in any order, each once.
  Parts(const Sheet& before, const Sheet& cut, std::vector<DividedTriangle> near);

  const Sheet& before() const { return before_; }
  const Sheet& cut() const { return cut_; }

  std::size_t size() const { return near_.size(); }
  const Triangle& triangle(std::size_t i) const { return cut_.triangle(near_[i].part); }
  TriangleIndex slot(std::size_t i) const { return near_[i].part; }
  const Triangle& parent(std::size_t i) const { return before_.triangle(near_[i].parent); }
  TriangleIndex parent_slot(std::size_t i) const { return near_[i].parent; }
  bool have_one_parent(std::size_t i, std::size_t j) const { return near_[i].parent == near_[j].parent; }
  std::size_t part(std::size_t i) const { return part_[i]; }
  /// size() where it is not near a cut.
  std::size_t place_of(TriangleIndex t) const;

  bool is_new(VertexIndex v) const { return cut_.is_newer(v, before_); }
  /// Of all these triangles, ascending; a vertex's number is its place here.
  const std::vector<DeformedIndex>& vertices() const { return vertices_; }
  std::size_t number_of(DeformedIndex d) const;
  bool has(std::size_t number, DeformedIndex d) const { return number < vertices_.size() && vertices_[number] == d; }
  /// The corner of i's parent that is vertex v; none where it isn't one.
  std::optional<std::size_t> corner_at(std::size_t i, VertexIndex v) const;

  /// visit(i, j, h) for each half edge h of i that is not cut, with j beyond it.
  template <class Visit>
  void for_each_joint(Visit visit) const {
    for (std::size_t i = 0; i < size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const HalfEdge h = half_edge(slot(i), k);
        if (cut_.separates(h)) continue;
        if (const std::size_t j = place_of(triangle_of(cut_.opposite(h))); j < size()) visit(i, j, h);
      }
  }

 private:
  void find_triangles();
  void join();
  TriangleIndex whole_parent(TriangleIndex t, TriangleIndex beside) const;

  const Sheet &before_, &cut_;
  std::vector<DividedTriangle> near_;  // and undivided ones that are their own parents
  std::vector<DeformedIndex> vertices_;
  std::vector<std::size_t> part_;
};

}  // namespace cutbench
