#include "harness/truth/stress_intensity.h"

#include <cmath>

#include "harness/truth/quadrature.h"

namespace cutbench {

Eigen::Matrix2d displacement_gradient(const Element& element, const Field& displacement) {
  Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();
  for (std::size_t k = 0; k < 3; ++k)
    gradient += displacement.segment<2>(2 * element.vertex[k].value) *
                Eigen::RowVector2d(element.gradient[k].x, element.gradient[k].y);
  return gradient;
}

StressIntensity stress_intensity(const Sheet& sheet, const ElementTable& elements, const Field& displacement,
                                 const Elastic& elastic, const Tip& tip, const Ring& ring) {
  const Frame frame{tip.at, tip.angle};
  const WilliamsField mode_1(elastic, frame, 1, 0), mode_2(elastic, frame, 0, 1);
  const Eigen::Vector2d along(std::cos(tip.angle), std::sin(tip.angle));
  const double width = ring.outer - ring.inner;
  StressIntensity k;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const Element& element = elements[e];
    if (!element.alive()) continue;
    const auto corners = sheet.corners(TriangleIndex(e));
    double farthest = 0, longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      farthest = std::max(farthest, squared_length(corners[i] - tip.at));
      longest = std::max(longest, squared_length(corners[(i + 1) % 3] - corners[i]));
    }
    if (farthest < ring.inner * ring.inner || std::sqrt(farthest) - std::sqrt(longest) > ring.outer) continue;
    const Eigen::Matrix2d gradient = displacement_gradient(element, displacement);
    const Eigen::Matrix2d stress = elastic.stress((gradient + gradient.transpose()) / 2);
    integrate(corners, {}, width / 8, [&](Point2 p, double weight) {
      const double r = std::sqrt(squared_length(p - tip.at)), s = (r - ring.inner) / width;
      if (s <= 0 || s >= 1) return;
      // q = 1 - 10 s^3 + 15 s^4 - 6 s^5, with two smooth derivatives at both ends.
      const double slope = -30 * s * s * (1 - s) * (1 - s) / width * element.fraction * weight;
      const Eigen::Vector2d grad_q = slope / r * Eigen::Vector2d(p.x - tip.at.x, p.y - tip.at.y);
      const auto interaction = [&](const WilliamsField& mode) {
        const Eigen::Matrix2d mode_gradient = mode.gradient(p);
        const Eigen::Matrix2d mode_strain = (mode_gradient + mode_gradient.transpose()) / 2;
        return (stress * (mode_gradient * along) + elastic.stress(mode_strain) * (gradient * along)).dot(grad_q) -
               stress.cwiseProduct(mode_strain).sum() * along.dot(grad_q);
      };
      k.k1 += elastic.young / 2 * interaction(mode_1);
      k.k2 += elastic.young / 2 * interaction(mode_2);
    });
  }
  return k;
}

}  // namespace cutbench
