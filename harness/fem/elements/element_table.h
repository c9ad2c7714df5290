// What the physics knows of the mesh: one row per triangle slot, and the polygons that some triangles are members of.
// The elements of methods that don't re-mesh may overlap in rest space and be made of material in part only.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "harness/fem/algebra/growing_rows.h"
#include "harness/fem/algebra/strong_couplings.h"
#include "harness/fem/elements/polygon_element.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

struct Element {
  std::array<DeformedIndex, 3> vertex;  ///< the first is invalid where the slot is free
  std::int32_t polygon = -1;            ///< that it is a member of, and no element itself; -1: none
  std::array<Point2, 3> gradient;       ///< of the linear shape functions in rest space, 1/length
  double area = 0;                      ///< rest area
  double fraction = 1;                  ///< how much of the area is material

  bool alive() const { return vertex[0].valid(); }
  bool is_triangle() const { return alive() && polygon < 0; }  ///< an element by itself
  double material_area() const { return area * fraction; }
};

class ElementTable final : public CoupledElements {
 public:
  ElementTable() = default;
  explicit ElementTable(const Sheet& sheet);
  /// Rewrites the rows of the slots that the sheet's log names. The same as a new table. \pre these are members of no
  /// polygon.
  void update(const Sheet& sheet);
  void reserve_spare() { cutbench::reserve_spare(rows_); }
  void add_strong_couplings(double aspect_ratio, std::vector<StrongCoupling>& all) const override;

  std::size_t size() const { return rows_.size(); }
  const Element& operator[](std::size_t i) const { return rows_[i]; }
  /// The triangles of the element that t is, or is a member of.
  std::span<const TriangleIndex> members(const TriangleIndex& t) const {
    const std::int32_t polygon = rows_[t()].polygon;
    if (polygon < 0) return {&t, 1};
    return polygons_[static_cast<std::size_t>(polygon)].polygon.triangles;
  }
  /// t, one of whose corners it is, lies in a polygon that has the vertex inside.
  bool is_inside(TriangleIndex t, DeformedIndex vertex) const;
  auto begin() const { return rows_.begin(); }
  auto end() const { return rows_.end(); }

  /// Polygons have slots, which are used again. \pre its triangles are alive, and members of none.
  std::size_t add_polygon(const Sheet& sheet, const Polygon& polygon);
  void dissolve(std::size_t polygon);  ///< its triangles are elements again
  std::size_t polygon_slots() const { return polygons_.size(); }
  const PolygonElement& polygon(std::size_t slot) const { return polygons_[slot]; }

 private:
  std::vector<Element> rows_;
  std::vector<PolygonElement> polygons_;
  std::vector<std::size_t> free_polygons_;
};

/// As ElementTable::members(); null: each triangle is an element.
inline std::span<const TriangleIndex> members_of(const ElementTable* elements, const TriangleIndex& t) {
  return elements ? elements->members(t) : std::span<const TriangleIndex>(&t, 1);
}

}  // namespace cutbench
