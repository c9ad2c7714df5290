// Constrained vertices of the model, and triangles that become one element.
#include "harness/fem/model/model.h"

namespace cutbench {

template <int D>
void Model<D>::constrain(const Sheet& sheet, const Constraints& constraints) {
  membrane_.check_takes(constraints);
  begin_marking();
  for (const TriangleIndex t : elements_.merge(sheet, constraints, regrouped_)) membrane_.join(elements_, t);
  mark_regrouped();
  refresh_vertices(sheet);
  if (!bending_) refresh_added_mass();
  if (!regrouped_.triangles.empty()) update_bending(sheet);
  is_constrained_ = !constraints.constraints.empty();
  if (is_constrained_ && constrained_)
    constrained_->change(constraints, vertices());
  else if (is_constrained_)
    constrained_.emplace(constraints, vertices());
}

// What the other files call; model.cpp instantiates the rest of the class.
template void Model<2>::constrain(const Sheet&, const Constraints&);
template void Model<3>::constrain(const Sheet&, const Constraints&);

}  // namespace cutbench
