// What the last cut may have changed of the copied elements: what a search from nothing would find elsewhere, it would
// find as it was.
//
// A copy of a corner is one unknown with copies of the same corner alone. So all that can have changed are the copies
// of the corners of those triangles of the sheet before its first cut of which the last cut touched a part.
#pragma once

#include <vector>

#include "harness/mesh/constraints.h"
#include "harness/mesh/sheet.h"
#include "methods/tools/divided.h"

namespace cutbench {

class LastCut {
 public:
  /// \param last  the constraints before the cut that the log of `cut` names; `copied` by rising parents
  LastCut(const Sheet& before, const Sheet& cut, const Constraints& last);

  /// v is a corner of a triangle that the cut touched.
  bool touches(VertexIndex v) const;
  /// The triangle of the sheet before its first cut has such a corner.
  bool reaches(TriangleIndex parent) const;
  /// Those that the parts of the reached ones consist of: of what is divided, and beside that.
  const std::vector<DividedTriangle>& near() const { return near_; }

 private:
  struct ByParent {
    TriangleIndex parent, part;
    auto operator<=>(const ByParent&) const = default;
  };
  void find_touched();
  void find_reached();
  void add_near(TriangleIndex parent);
  void add_if_near(TriangleIndex t, TriangleIndex parent);
  bool is_touched(TriangleIndex t) const;

  const Sheet &before_, &cut_;
  const Constraints& last_;
  std::vector<TriangleIndex> touched_;   // slots, in rising order
  std::vector<ByParent> touched_parts_;  // of `cut`, alive, in rising order
  std::vector<VertexIndex> corners_;     // in rising order
  std::vector<TriangleIndex> reached_;   // in rising order
  std::vector<DividedTriangle> near_;
};

/// The elements of a parent. \pre they are by rising parents
std::span<const CopiedElement> elements_of(const std::vector<CopiedElement>& copied, TriangleIndex parent);

}  // namespace cutbench
