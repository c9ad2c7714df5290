#include "methods/phantom_node/phantom_node.h"

#include "methods/tools/static_split.h"

namespace cutbench {

void PhantomNode::embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) {
  notes.recovered_segments = embed_by_static_split(sheet, trace, patch_work_);
}

Constraints PhantomNode::constraints(const Sheet& before, const Sheet& cut) const {
  return copied_elements(before, cut, options_);
}

Constraints PhantomNode::next_constraints(const Sheet& before, const Sheet& cut, const Constraints& last,
                                          const PolygonsLeft& /*left*/) const {
  return next_copied_elements(before, cut, options_, last);
}

}  // namespace cutbench
