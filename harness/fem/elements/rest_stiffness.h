// The linear stiffness of a sheet at rest in its plane, element by element: no matrix is assembled.
#pragma once

#include "harness/fem/elements/compound_sheet.h"
#include "harness/fem/elements/element_table.h"
#include "harness/fem/elements/membrane.h"

namespace cutbench {

class RestStiffness {
 public:
  /// Refers to the elements. \param lame  of the sheet, per thickness
  RestStiffness(const ElementTable& elements, const Lame& lame);
  /// force += K moved, for two values per vertex.
  void add_force(const Field& moved, Field& force) const;

 private:
  void add_force(const Element& element, const Field& moved, Field& force) const;

  const ElementTable& elements_;
  Lame lame_;
  CompoundStiffness compounds_;
};

}  // namespace cutbench
