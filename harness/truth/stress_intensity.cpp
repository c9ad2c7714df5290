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

InteractionIntegral::InteractionIntegral(const Sheet& sheet, const ElementTable& elements, const Elastic& elastic,
                                         const Tip& tip, const Ring& ring) {
  const Axes frame{tip.at, tip.angle};
  const WilliamsField mode_1(elastic, frame, 1, 0), mode_2(elastic, frame, 0, 1);
  const Eigen::Vector2d along(std::cos(tip.angle), std::sin(tip.angle));
  const double width = ring.outer - ring.inner;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (!elements[e].alive()) continue;
    const auto corners = sheet.corners(TriangleIndex(e));
    double farthest = 0, longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      farthest = std::max(farthest, squared_length(corners[i] - tip.at));
      longest = std::max(longest, squared_length(corners[(i + 1) % 3] - corners[i]));
    }
    if (farthest < ring.inner * ring.inner || std::sqrt(farthest) - std::sqrt(longest) > ring.outer) continue;
    Weights weights{e, Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero()};
    integrate(corners, {}, width / 8, [&](Point2 p, double weight) {
      const double r = std::sqrt(squared_length(p - tip.at)), s = (r - ring.inner) / width;
      if (s <= 0 || s >= 1) return;
      // q = 1 - 10 s^3 + 15 s^4 - 6 s^5, with two smooth derivatives at both ends.
      const double slope = -30 * s * s * (1 - s) * (1 - s) / width;
      const Eigen::Vector2d grad_q = slope / r * Eigen::Vector2d(p.x - tip.at.x, p.y - tip.at.y);
      const double factor = elastic.young / 2 * elements[e].fraction * weight;
      const auto add = [&](const ElasticField& mode, Eigen::Matrix2d& sum) {
        const Eigen::Matrix2d gradient = mode.gradient(p), strain = (gradient + gradient.transpose()) / 2;
        const Eigen::Matrix2d turn = grad_q * (gradient * along).transpose();
        // What the stress is multiplied with, and Hooke's law, which is symmetric, moved over to it.
        const Eigen::Matrix2d of_stress = (turn + turn.transpose()) / 2 - along.dot(grad_q) * strain;
        sum += factor * (elastic.stress(of_stress) + elastic.stress(strain) * grad_q * along.transpose());
      };
      add(mode_1, weights.mode_1), add(mode_2, weights.mode_2);
    });
    weights_.push_back(weights);
  }
}

StressIntensity InteractionIntegral::of(const ElementTable& elements, const Field& displacement) const {
  StressIntensity k;
  for (const auto& [element, mode_1, mode_2] : weights_) {
    const Eigen::Matrix2d gradient = displacement_gradient(elements[element], displacement);
    k.k1 += mode_1.cwiseProduct(gradient).sum(), k.k2 += mode_2.cwiseProduct(gradient).sum();
  }
  return k;
}

}  // namespace cutbench
