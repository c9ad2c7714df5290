#include "harness/problems/common/stress_intensity.h"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "harness/base/conversions.h"
#include "harness/problems/common/quadrature.h"

namespace cutbench {

namespace {

/// How the cut grows, at a point of the ring: q, its gradient, and that of V.
struct Growth {
  double q;
  Eigen::Vector2d grad_q;
  Eigen::Matrix2d grad_v;  ///< d V_i / d x_j
};

Growth growth_at(const Eigen::Vector2d& from_tip, const Tip& tip, const Eigen::Matrix2d& turn, const Ring& ring) {
  const double width = ring.outer - ring.inner, r = from_tip.norm(), s = (r - ring.inner) / width;
  // q = 1 - 10 s^3 + 15 s^4 - 6 s^5, with two smooth derivatives at both ends.
  const double q = 1 - s * s * s * (10 - 15 * s + 6 * s * s), slope = -30 * s * s * (1 - s) * (1 - s) / width;
  const Eigen::Vector2d grad_q = slope / r * from_tip, tangent(std::cos(tip.angle), std::sin(tip.angle));
  return {q, grad_q, q * turn + (tangent + turn * from_tip) * grad_q.transpose()};
}

}  // namespace

Eigen::Matrix2d displacement_gradient(const Element& element, const Field& displacement) {
  Eigen::Matrix2d gradient = Eigen::Matrix2d::Zero();
  for (std::size_t k = 0; k < 3; ++k)
    gradient += displacement.segment<2>(2 * element.vertex[k].value) *
                Eigen::RowVector2d(element.gradient[k].x, element.gradient[k].y);
  return gradient;
}

LinearPart<2> displacement_in(const ElementTable& elements, std::size_t triangle, const Field& displacement) {
  const Element& element = elements[triangle];
  if (element.is_triangle())
    return {displacement.segment<2>(2 * element.vertex[0].value), displacement_gradient(element, displacement)};
  return elements.linear_part<2>(TriangleIndex(triangle), displacement);
}

std::optional<StressIntensity> intensity_of_coefficients(const TipFunctions& functions, const Eigen::VectorXd& c,
                                                         const Tip& tip, const Elastic& elastic, double reach) {
  std::optional<std::size_t> nearest;
  double least = reach * reach;
  for (std::size_t i = 0; i < functions.tips().size(); ++i) {
    const double distance = squared_length(functions.tips()[i].at - tip.at);
    if (distance <= least) {
      least = distance;
      nearest = i;
    }
  }
  if (!nearest) return std::nullopt;
  const Eigen::Vector2d opening = c.segment<2>(to_index(2 * TipFunctions::per_tip * *nearest)),
                        along(std::cos(tip.angle), std::sin(tip.angle)), across(-along.y(), along.x());
  const double factor = elastic.young * std::sqrt(2 * std::numbers::pi) / 4;
  return StressIntensity{factor * across.dot(opening), factor * along.dot(opening)};
}

std::array<Mode, 2> williams_modes(const Elastic& elastic, const Tip& tip) {
  const auto mode = [&](const StressIntensity& k) { return Mode{williams_field(elastic, {tip.at, tip.angle}, k), k}; };
  return {mode({1, 0}), mode({0, 1})};
}

InteractionIntegral::InteractionIntegral(const Sheet& sheet, const ElementTable& elements, const Elastic& elastic,
                                         const Tip& tip, const std::array<Mode, 2>& modes, const Ring& ring,
                                         const TipFunctions* functions) {
  Eigen::Matrix2d of_modes;
  of_modes << modes[0].k.k1, modes[0].k.k2, modes[1].k.k1, modes[1].k.k2;
  to_intensity_ = elastic.young / 2 * of_modes.inverse();
  Eigen::Matrix2d turn;
  turn << 0, -tip.curvature, tip.curvature, 0;
  if (functions) of_functions_ = Eigen::Matrix2Xd::Zero(2, to_index(functions->unknowns()));
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (!elements[e].alive()) continue;
    const auto corners = sheet.corners(TriangleIndex(e));
    double farthest = 0, longest = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      farthest = std::max(farthest, squared_length(corners[i] - tip.at));
      longest = std::max(longest, squared_length(corners[(i + 1) % 3] - corners[i]));
    }
    if (farthest < ring.inner * ring.inner || std::sqrt(farthest) - std::sqrt(longest) > ring.outer) continue;
    Weights weights{e, {}};
    integrate(corners, {}, (ring.outer - ring.inner) / 8, [&](Point2 p, double weight) {
      const Eigen::Vector2d from_tip(p.x - tip.at.x, p.y - tip.at.y),
          from_corner(p.x - corners[0].x, p.y - corners[0].y);
      if (from_tip.norm() <= ring.inner || from_tip.norm() >= ring.outer) return;
      const Growth growth = growth_at(from_tip, tip, turn, ring);
      weight *= elements[e].fraction;
      for (std::size_t m = 0; m < 2; ++m) {
        const ElasticField::State mode = modes[m].field.state(p);
        const Eigen::Matrix2d& h = mode.gradient;
        const Eigen::Matrix2d strain = (h + h.transpose()) / 2;
        const Eigen::Matrix2d g =
            h * growth.grad_v - turn * (growth.q * h + mode.displacement * growth.grad_q.transpose());
        // What the stress is multiplied with, and Hooke's law, which is symmetric, moved over to it.
        const Eigen::Matrix2d of_stress = (g + g.transpose()) / 2 - growth.grad_v.trace() * strain;
        // s'_ij g_ij of the sought field: of its gradient, and of its displacement, linear in the element.
        const Eigen::Matrix2d of_gradient =
            mode.stress * growth.grad_v.transpose() - growth.q * turn.transpose() * mode.stress;
        const Eigen::Vector2d of_displacement = -turn.transpose() * mode.stress * growth.grad_q;
        const Eigen::Matrix2d of_any_gradient = weight * (elastic.stress(of_stress) + of_gradient);
        weights.mode[m].gradient += of_any_gradient + weight * of_displacement * from_corner.transpose();
        weights.mode[m].corner += weight * of_displacement;
        if (functions) add_functions(m, *functions, TriangleIndex(e), p, of_any_gradient, weight * of_displacement);
      }
    });
    weights_.push_back(weights);
  }
}

void InteractionIntegral::add_functions(std::size_t mode, const TipFunctions& functions, TriangleIndex t, Point2 p,
                                        const Eigen::Matrix2d& of_gradient, const Eigen::Vector2d& of_value) {
  for (const auto& reach : functions.reaching(t)) {
    auto unknown = to_index(2 * TipFunctions::per_tip * reach.tip);
    for (const auto& [value, gradient] : functions.at(t, reach, p)) {
      of_functions_.block<1, 2>(to_index(mode), unknown) += (of_gradient * gradient + value * of_value).transpose();
      unknown += 2;
    }
  }
}

StressIntensity InteractionIntegral::of(const ElementTable& elements, const Field& displacement,
                                        const Eigen::VectorXd& of_tips) const {
  Eigen::Vector2d sum(0, 0);
  if (of_tips.size() > 0) sum = of_functions_ * of_tips;
  for (const auto& [element, mode] : weights_) {
    const auto [corner, gradient] = displacement_in(elements, element, displacement);
    for (std::size_t m = 0; m < 2; ++m)
      sum[to_index(m)] += mode[m].gradient.cwiseProduct(gradient).sum() + mode[m].corner.dot(corner);
  }
  const Eigen::Vector2d k = to_intensity_ * sum;
  return {k[0], k[1]};
}

}  // namespace cutbench
