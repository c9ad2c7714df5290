#include "methods/virtual_node/virtual_node.h"

#include "methods/tools/copied_elements.h"
#include "methods/tools/static_split.h"

namespace cutbench {

namespace {

constexpr CopyOptions whole_at_tips{.lumped_mass = true, .open_tips = false};

}  // namespace

void VirtualNode::embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) {
  notes.recovered_segments = embed_by_static_split(sheet, trace, patch_work_);
}

Constraints VirtualNode::constraints(const Sheet& before, const Sheet& cut) const {
  return copied_elements(before, cut, whole_at_tips);
}

Constraints VirtualNode::next_constraints(const Sheet& before, const Sheet& cut, const Constraints& last,
                                          const PolygonsLeft& /*left*/) const {
  return next_copied_elements(before, cut, whole_at_tips, last);
}

}  // namespace cutbench
