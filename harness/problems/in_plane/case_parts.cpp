#include "harness/problems/in_plane/case_parts.h"

#include "harness/problems/common/members.h"

namespace cutbench {

std::vector<LipSample> straight_lips(Point2 middle, double half_length) {
  std::vector<LipSample> samples;
  const double step = 2 * half_length / lip_samples;
  for (int i = 0; i < lip_samples; ++i)
    samples.push_back({middle + Point2{-half_length + (i + 0.5) * step, 0}, {0, 1}, step});
  return samples;
}

WindowTip straight_tip(Point2 at, double angle, const StressIntensity& k) {
  const auto modes = [=](const Axes& frame) {
    return williams_modes(sheet_material, {frame.to_rest({at.x, at.y}), frame.angle + angle});
  };
  return {{at, angle}, k, modes};
}

}  // namespace cutbench
