// What the physics knows of the mesh: one row per triangle slot, and the polygons that some triangles are members of.
// To what lies above this room an element is an element: it has corners, gradients and areas, be it a triangle or a
// polygon. An element of several triangles is a compound, and it is a polygon in this table, polygon_element.h and
// compound_sheet.h alone. The elements of methods that don't re-mesh may overlap in rest space and be made of material
// in part only.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "harness/base/conversions.h"
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
  bool is_member() const { return polygon >= 0; }               ///< of a compound
  bool is_triangle() const { return alive() && !is_member(); }  ///< an element by itself
  double material_area() const { return area * fraction; }
};

/// An element as its shape functions have it.
struct ElementShape {
  std::span<const DeformedIndex> corners;
  std::span<const Point2> gradient;  ///< per corner: of its shape function, in the mean over the element, 1/length
  std::span<const Point2> offset;    ///< of a compound: of each corner from the mean of all
};

/// A linear field of D values as a triangle has it.
template <int D>
struct LinearPart {
  Eigen::Matrix<double, D, 1> at_first;  ///< vertex of the triangle
  Eigen::Matrix<double, D, 2> gradient;
};

/// What became another element, or a part of one.
struct Regrouped {
  std::vector<TriangleIndex> triangles;
  std::vector<DeformedIndex> vertices;  ///< theirs
};

class ElementTable final : public CoupledElements {
 public:
  ElementTable() = default;
  explicit ElementTable(const Sheet& sheet);
  ElementTable(const Sheet& sheet, const Constraints& merged);  ///< with the compounds that they make
  /// Rewrites the rows of the slots that the sheet's log names. The same as a new table. \pre these are members of no
  /// polygon.
  void update(const Sheet& sheet);
  void reserve_spare() {
    cutbench::reserve_spare(rows_);
    polygons_of_.reserve_spare();
  }
  void add_strong_couplings(double aspect_ratio, std::vector<StrongCoupling>& all) const override;

  std::size_t size() const { return rows_.size(); }
  const Element& operator[](std::size_t i) const { return rows_[i]; }
  /// The triangles of the element that t is, or is a member of.
  std::span<const TriangleIndex> members(const TriangleIndex& t) const {
    const std::int32_t polygon = rows_[t()].polygon;
    if (polygon < 0) return {&t, 1};
    return polygons_[to_size(polygon)].polygon.triangles;
  }
  /// t, one of whose corners it is, lies in a polygon that has the vertex inside.
  bool is_inside(TriangleIndex t, DeformedIndex vertex) const;
  auto begin() const { return rows_.begin(); }
  auto end() const { return rows_.end(); }

  // --- elements, of whatever kind ------------------------------------------------------------------------------------
  ElementShape shape(TriangleIndex t) const;  ///< of the element that t is, or is a member of
  /// Calls visit(corners) for the elements that have this corner. \param triangles  Incidence::at(vertex)
  template <class Visit>
  void for_each_round(std::size_t vertex, std::span<const HalfEdge> triangles, const Visit& visit) const {
    for (const HalfEdge c : triangles)
      if (const Element& e = rows_[triangle_of(c)()]; e.is_triangle()) visit(std::span<const DeformedIndex>(e.vertex));
    for (const std::int32_t p : polygons_of_[vertex])
      visit(std::span<const DeformedIndex>(polygons_[to_size(p)].polygon.corners));
  }
  /// The area of material that stands for a vertex's mass.
  double area_round(std::size_t vertex, std::span<const HalfEdge> triangles) const;
  /// Row `vertex` of the consistent mass, whose entries are sums of areas over a number of parts: add(column, area,
  /// parts). Polygons are lumped.
  template <class Add>
  void for_each_share(std::size_t vertex, std::span<const HalfEdge> triangles, const Add& add) const {
    if (const double area = polygon_area_round(vertex); area > 0) add(DeformedIndex(vertex), area, 1);
    for (const HalfEdge c : triangles) {
      const Element& e = rows_[triangle_of(c)()];
      if (!e.is_triangle()) continue;
      for (const DeformedIndex d : e.vertex) add(d, e.material_area(), d() == vertex ? 6 : 12);
    }
  }
  /// Of all vertices: the rest areas that stand for them, all of it material.
  Field areas(std::size_t vertices) const;

  // --- compounds: elements of several triangles ----------------------------------------------------------------------
  /// Makes the compounds of these constraints, after dissolving those that they share triangles with.
  /// \return a member of each that was not there already
  std::vector<TriangleIndex> merge(const Sheet& sheet, const Constraints& merged, Regrouped& regrouped);
  /// Dissolves the compound that t is a member of, if any.
  void release(TriangleIndex t, Regrouped& regrouped);
  void begin_change() { freed_.clear(); }
  Constraints merged() const;              ///< that make these compounds
  PolygonsLeft left_since_change() const;  ///< freed: by release() since begin_change(). Refers to this.
  /// Gives the vertices inside compounds their values, D per vertex.
  template <int D>
  void follow(Field& x) const;
  /// Calls visit(vertex, corner) for each vertex inside a compound, with a corner of that.
  template <class Visit>
  void for_each_inside(const Visit& visit) const {
    for (const PolygonElement& element : polygons_)
      for (const DeformedIndex d : element.polygon.inside) visit(d, element.polygon.corners.front());
  }
  /// Of a field with D values per vertex: the linear part that a compound has of it, in member t.
  template <int D>
  LinearPart<D> linear_part(TriangleIndex t, const Field& x) const;

  // --- for compound_sheet.h ------------------------------------------------------------------------------------------
  /// Polygons have slots, which are used again.
  std::span<const std::int32_t> polygons_of(std::size_t vertex) const { return polygons_of_[vertex]; }  ///< their slots
  std::size_t polygon_slots() const { return polygons_.size(); }
  const PolygonElement& polygon(std::size_t slot) const { return polygons_[slot]; }

 private:
  /// \pre its triangles are alive, and members of none. \return its slot
  std::size_t add(const Sheet& sheet, const Polygon& polygon);
  bool merge_one(const Sheet& sheet, const Polygon& polygon, Regrouped& regrouped);
  void dissolve(std::size_t polygon, Regrouped& regrouped);
  double polygon_area_round(std::size_t vertex) const;

  std::vector<Element> rows_;
  std::vector<PolygonElement> polygons_;
  std::vector<std::size_t> free_polygons_;
  GrowingRows<std::int32_t> polygons_of_;  // per vertex: those of which it is a corner
  std::vector<TriangleIndex> freed_;
};

/// As ElementTable::members(); null: each triangle is an element.
inline std::span<const TriangleIndex> members_of(const ElementTable* elements, const TriangleIndex& t) {
  return elements ? elements->members(t) : std::span<const TriangleIndex>(&t, 1);
}

}  // namespace cutbench
