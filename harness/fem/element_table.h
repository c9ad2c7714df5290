// What the physics knows of the mesh: one row per element, by default one per triangle slot. The elements of methods
// that don't re-mesh may overlap in rest space and be made of material in part only.
#pragma once

#include <array>
#include <vector>

#include "harness/mesh/sheet.h"

namespace cutbench {

struct Element {
  std::array<DeformedIndex, 3> vertex;  ///< the first is invalid where the slot is free
  std::array<Point2, 3> gradient;       ///< of the linear shape functions in rest space, 1/length
  double area = 0;                      ///< rest area
  double fraction = 1;                  ///< how much of the area is material

  bool alive() const { return vertex[0].valid(); }
  double material_area() const { return area * fraction; }
};

class ElementTable {
 public:
  ElementTable() = default;
  explicit ElementTable(const Sheet& sheet);
  /// Rewrites the rows of the slots that the sheet's log names. The same as a new table.
  void update(const Sheet& sheet);
  void reserve_spare() { rows_.reserve(rows_.size() + rows_.size() / 2); }

  std::size_t size() const { return rows_.size(); }
  const Element& operator[](std::size_t i) const { return rows_[i]; }
  auto begin() const { return rows_.begin(); }
  auto end() const { return rows_.end(); }

 private:
  std::vector<Element> rows_;
};

}  // namespace cutbench
