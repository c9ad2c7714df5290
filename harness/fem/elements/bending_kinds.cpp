#include "harness/fem/elements/bending_kinds.h"

#include "harness/base/conversions.h"
#include "harness/fem/elements/bending_hinges.h"
#include "harness/fem/elements/bending_patches.h"

namespace cutbench {

namespace {

/// In the order of BendingKind; those that it does not name follow.
constexpr BendingRow rows[] = {
    {"none", "no bending", nullptr},
    {"patches", "slopes from quadratics through the vertices round a triangle: on any mesh", patch_rows, true},
    {"hinges", "angles at the edges: depends on the mesh", hinge_rows},
};

}  // namespace

const BendingRow& row_of(BendingKind kind) { return rows[to_size(kind)]; }

const std::vector<EnumName<BendingKind>>& bending_names() {
  static const std::vector<EnumName<BendingKind>> names = [] {
    std::vector<EnumName<BendingKind>> all;
    for (const BendingRow& row : rows) all.push_back({static_cast<BendingKind>(all.size()), row.name});
    return all;
  }();
  return names;
}

}  // namespace cutbench
