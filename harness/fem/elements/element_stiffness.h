// The tangent stiffness of a membrane element, or of four side by side (membrane.h says where it comes from).
#pragma once

#include <limits>

#include "harness/fem/algebra/lanes.h"
#include "harness/fem/elements/membrane.h"
#include "harness/fem/elements/springs.h"

namespace cutbench {

/// The stiffness times a factor, N/m: 3 x 3 blocks of D x D, symmetric; positive semi-definite but for
/// StressStiffness::full under compression.
///
/// In the element's own frame (the columns of B, and the normal n) the block of two corners with gradients g and h is
/// linear in the four products of their components. So it is here, with frame and moduli put into three matrices once:
///   block = gx hx M_xx + gx hy M_xy + gy hx M_xy^T + gy hy M_yy
template <int D, class Number = double>
class ElementStiffness {
 public:
  using Block = std::array<Number, D * D>;  ///< column by column

  /// `area` is the factor times the area of material.
  ElementStiffness(const std::array<Vector2<Number>, 3>& gradient, Number area,
                   const StrainInFrame<D, Number>& strained, const MembraneLaw& law)
      : gradient_(gradient) {
    if (law.strain == Strain::springs) {
      set_springs(area * young_of(law.lame), strained, law.of_stress);
      return;
    }
    const Number lambda = area * law.lame.lambda, mu = area * law.lame.mu;
    const Moduli m = law.of_stress == StressStiffness::none ? Moduli{} : moduli_of(area, strained, law);
    const auto& [x, y] = strained.frame;
    for (std::size_t c = 0; c < D; ++c)
      for (std::size_t r = 0; r < D; ++r) {
        const Number xx = x[r] * x[c], yy = y[r] * y[c];
        xx_[D * c + r] = (lambda + 2 * mu) * xx + (mu + m.twist) * yy;
        yy_[D * c + r] = (mu + m.twist) * xx + (lambda + 2 * mu) * yy;
        xy_[D * c + r] = lambda * (x[r] * y[c]) + (mu - m.twist) * (y[r] * x[c]);
      }
    if (law.strain == Strain::green)
      add_in_every_direction(m);
    else if constexpr (D == 3)
      add_tilt(m, cross(x, y));
  }

  /// Of one element.
  ElementStiffness(const Element& e, const Deformation<D>& deformation, const MembraneLaw& law)
      : ElementStiffness({{{e.gradient[0].x, e.gradient[0].y},
                           {e.gradient[1].x, e.gradient[1].y},
                           {e.gradient[2].x, e.gradient[2].y}}},
                         e.material_area(), strain_of(deformation), law) {}

  /// Block (i, j).
  Block block(std::size_t i, std::size_t j) const { return block(gradient_[i], gradient_[j]); }
  /// Of two corners with these gradients.
  Block block(const Vector2<Number>& g, const Vector2<Number>& h) const {
    const Number xx = g.x * h.x, xy = g.x * h.y, yx = g.y * h.x, yy = g.y * h.y;
    Block b;
    for (std::size_t c = 0; c < D; ++c)
      for (std::size_t r = 0; r < D; ++r)
        b[D * c + r] = (xx * xx_[D * c + r] + yy * yy_[D * c + r]) + (xy * xy_[D * c + r] + yx * xy_[D * r + c]);
    return b;
  }

 private:
  /// Of the modes whose stiffness depends on the stress.
  struct Moduli {
    Number twist{};  ///< in the plane
    /// Of a corner's motion out of the plane, tension over stretch; of green in every direction, tension. On the
    /// principal axes of the strain.
    Number xx{}, xy{}, yy{};

    /// `modulus` of each principal strain.
    template <class Modulus>
    void set(const StrainInFrame<D, Number>& e, Number area, const Modulus& modulus) {
      const Number half = (e.xx - e.yy) / 2, radius = square_root(half * half + e.xy * e.xy);
      const Number middle = (e.xx + e.yy) / 2;
      const Number more = area / 2 * modulus(middle + radius), less = area / 2 * modulus(middle - radius);
      const Number slope = radius > 0 ? (more - less) / radius : Number{};
      xx = more + less + slope * half, yy = more + less - slope * half, xy = slope * e.xy;
    }
  };

  static Number taken(Number x, StressStiffness of_stress) {
    const double infinity = std::numeric_limits<double>::infinity();
    const double least = of_stress == StressStiffness::full       ? -infinity
                         : of_stress == StressStiffness::positive ? 0
                                                                  : infinity;
    return x > least ? x : Number{};
  }

  static Moduli moduli_of(Number area, const StrainInFrame<D, Number>& e, const MembraneLaw& law) {
    const double mu = law.lame.mu, lambda = law.lame.lambda;
    const auto taken = [&](Number x) { return ElementStiffness::taken(x, law.of_stress); };
    const Number strain = e.xx + e.yy, pressure = lambda * strain;
    Moduli m;
    if (law.strain == Strain::green) {
      m.set(e, area, [&](Number principal) { return taken(2 * mu * principal + pressure); });
      return m;
    }
    const Number twist = taken((mu + lambda) * strain / (strain + 2));
    m.twist = strain + 2 > 0 ? area * twist : Number{};
    if constexpr (D == 3)
      m.set(e, area, [&](Number principal) {
        const Number ratio = taken(2 * mu * principal + pressure) / (1 + principal);
        return 1 + principal > 0 ? ratio : Number{};
      });
    return m;
  }

  void set_springs(Number young, const StrainInFrame<D, Number>& strained, StressStiffness of_stress) {
    xx_ = {};
    xy_ = {};
    yy_ = {};
    const Springs<D, Number> springs(gradient_, strained.frame);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& [x, y] = springs.along[i];
      const Number across = taken(springs.tension_over_stretch(i), of_stress), inverse = springs.inverse(i);
      const Number along = young * (1 - across) * inverse * inverse;
      for (std::size_t c = 0; c < D; ++c)
        for (std::size_t r = 0; r < D; ++r) {
          Number both = along * (springs.edge[i][r] * springs.edge[i][c]);
          if (r == c) both += young * across;
          xx_[D * c + r] += x * x * both;
          xy_[D * c + r] += x * y * both;
          yy_[D * c + r] += y * y * both;
        }
    }
  }

  void add_in_every_direction(const Moduli& m) {
    for (std::size_t c = 0; c < D; ++c) {
      xx_[D * c + c] += m.xx;
      xy_[D * c + c] += m.xy;
      yy_[D * c + c] += m.yy;
    }
  }

  void add_tilt(const Moduli& m, const std::array<Number, D>& normal) {
    for (std::size_t c = 0; c < D; ++c)
      for (std::size_t r = 0; r < D; ++r) {
        const Number both = normal[r] * normal[c];
        xx_[D * c + r] += m.xx * both;
        xy_[D * c + r] += m.xy * both;
        yy_[D * c + r] += m.yy * both;
      }
  }

  std::array<Vector2<Number>, 3> gradient_;
  Block xx_, xy_, yy_;
};

/// The transpose of a block.
template <int D, class Block>
Block mirrored(const Block& block) {
  Block b;
  for (std::size_t c = 0; c < D; ++c)
    for (std::size_t r = 0; r < D; ++r) b[D * c + r] = block[D * r + c];
  return b;
}

}  // namespace cutbench
