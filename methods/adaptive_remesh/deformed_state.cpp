#include "methods/adaptive_remesh/deformed_state.h"

#include "harness/base/conversions.h"

namespace cutbench {

void DeformedState::follow(const Sheet& sheet) {
  if (!motion_) return;
  made_.grow(sheet.deformed_slots());
  const auto& ancestry = sheet.log().ancestry;
  for (; followed_ < ancestry.size(); ++followed_) {
    const EditLog::Ancestry& from = ancestry[followed_];
    Vertex sum;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!from.parents[i].valid()) continue;
      const Vertex parent = of(from.parents[i]);
      sum.position = sum.position + from.weights[i] * parent.position;
      sum.velocity = sum.velocity + from.weights[i] * parent.velocity;
    }
    made_.set(from.vertex, sum);
  }
}

DeformedState::Vertex DeformedState::of(DeformedIndex d) const {
  if (made_.holds(d)) return made_.at(d);
  const auto at = to_size(motion_->dimension) * d();
  const auto point = [&](std::span<const double> all) {
    return Point3{all[at], all[at + 1], motion_->dimension == 3 ? all[at + 2] : 0};
  };
  return {point(motion_->x), point(motion_->v)};
}

}  // namespace cutbench
