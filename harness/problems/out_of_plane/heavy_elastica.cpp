#include "harness/problems/out_of_plane/heavy_elastica.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

constexpr int steps = 2000;
constexpr double step = 1.0 / steps;

/// What the strip is at distance t from its free end, per length: angle, d angle / dt, and how far it has gone across
/// and down from there.
using Ray = std::array<double, 4>;

Ray slope(double load, double t, const Ray& y) {
  return {y[1], -load * t * std::cos(y[0]), std::cos(y[0]), std::sin(y[0])};
}

Ray moved(const Ray& y, double by, const Ray& k) {
  return {y[0] + by * k[0], y[1] + by * k[1], y[2] + by * k[2], y[3] + by * k[3]};
}

/// From the free end, which hangs at `angle`, to the clamp.
std::vector<Ray> shot(double load, double angle) {
  std::vector<Ray> rays{{angle, 0, 0, 0}};
  for (int i = 0; i < steps; ++i) {
    const Ray y = rays.back();
    const double t = i * step;
    const Ray a = slope(load, t, y), b = slope(load, t + step / 2, moved(y, step / 2, a)),
              c = slope(load, t + step / 2, moved(y, step / 2, b)), d = slope(load, t + step, moved(y, step, c));
    rays.push_back(moved(moved(moved(moved(y, step / 6, a), step / 3, b), step / 3, c), step / 6, d));
  }
  return rays;
}

}  // namespace

HeavyElastica::HeavyElastica(double length, double load) : length_(length) {
  double low = 0, high = std::numbers::pi / 2;  // of the angle at the free end; the angle at the clamp grows with it
  for (int halved = 0; halved < 52; ++halved) {
    const double middle = (low + high) / 2;
    (shot(load, middle).back()[0] < 0 ? low : high) = middle;
  }
  const std::vector<Ray> rays = shot(load, high);
  const Ray& clamp = rays.back();
  for (auto ray = rays.rbegin(); ray != rays.rend(); ++ray)
    sections_.push_back({length * (clamp[2] - (*ray)[2]), length * ((*ray)[3] - clamp[3]), (*ray)[0]});
  sections_.front() = {0, 0, 0};
}

/// Hermite's cubic between two sections.
HeavyElastica::Section HeavyElastica::at(double s) const {
  const double from = std::clamp(s, 0.0, length_), beyond = s - from;
  const auto i = std::min(to_size(from / length_ * steps), std::size_t{steps - 1});
  const Section &a = sections_[i], &b = sections_[i + 1];
  const double h = length_ * step, t = from / h - to_double(i), u = 1 - t;
  const double at_a = u * u * (1 + 2 * t), at_b = t * t * (1 + 2 * u), out_of_a = h * t * u * u,
               into_b = -h * t * t * u;
  const Section on{at_a * a.x + at_b * b.x + out_of_a * std::cos(a.angle) + into_b * std::cos(b.angle),
                   at_a * a.z + at_b * b.z - out_of_a * std::sin(a.angle) - into_b * std::sin(b.angle),
                   u * a.angle + t * b.angle};
  return {on.x + beyond * std::cos(on.angle), on.z - beyond * std::sin(on.angle), on.angle};
}

}  // namespace cutbench
