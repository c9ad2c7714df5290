// A triangle as three springs along its edges, the cheapest model of cloth (Baraff and Witkin, Large steps in cloth
// simulation, SIGGRAPH 1998, give the implicit step).
//
// Their constants come from the material: k = E A / L^2 of each triangle at an edge of rest length L (van Gelder,
// Approximate simulation of elastic membranes by triangulated spring meshes, J. Graphics Tools 3(2), 1998), so the
// energy per rest area is E / 2 sum (l_i - 1)^2, with the stretch l_i = |F t_i| of edge i, whose direction at rest is
// t_i. The stress is s = E sum (1 - 1 / l_i) t_i t_i^T, and P = F s. The second derivative has E (t_i g)(t_i h) for
// corners with gradients g and h, times u u^T + (1 - 1 / l_i) (I - u u^T) where the edge points to u = F t_i / l_i: the
// second term is the stiffness from stress.
//
// Springs along edges have one Poisson's ratio, 1/3, where the edges point into all directions alike (Lloyd, Szekely
// and Harders, Identification of spring parameters for deformable object simulation, TVCG 13(5), 2007), and they are
// isotropic only where all triangles are equilateral. No spring keeps a triangle from being turned over. An edge
// between two triangles is two springs side by side here, so that cuts are followed as those of any other element.
#pragma once

#include "harness/fem/algebra/lanes.h"
#include "harness/fem/elements/membrane.h"

namespace cutbench {

/// Of one triangle or of several side by side (lanes.h).
template <int D, class Number>
struct Springs {
  /// \param gradient  of a triangle, or zero
  Springs(const std::array<Vector2<Number>, 3>& gradient, const std::array<std::array<Number, D>, 2>& f) {
    const Number size2 = dot(f[0], f[0]) + dot(f[1], f[1]);
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& [x, y] = gradient[i];  // across the edge
      const Number across2 = x * x + y * y, inverse = across2 > 0 ? 1 / square_root(across2) : Number{};
      along[i] = {-y * inverse, x * inverse};
      for (std::size_t r = 0; r < D; ++r) edge[i][r] = along[i].x * f[0][r] + along[i].y * f[1][r];
      const Number stretch2 = dot(edge[i], edge[i]);
      stretch[i] = stretch2 > 1e-28 * size2 ? square_root(stretch2) : Number{};
    }
  }
  /// 1 / l; an edge without length points nowhere, and pulls nowhere.
  Number inverse(std::size_t i) const { return stretch[i] > 0 ? 1 / stretch[i] : Number{}; }
  Number tension_over_stretch(std::size_t i) const { return stretch[i] > 0 ? 1 - 1 / stretch[i] : Number{}; }

  struct Stress {
    Number xx{}, xy{}, yy{};
  };
  /// N/m, for Young's modulus in N/m.
  Stress stress(double young) const {
    Stress s;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto& [x, y] = along[i];
      const Number weight = young * tension_over_stretch(i);
      s.xx += weight * (x * x);
      s.xy += weight * (x * y);
      s.yy += weight * (y * y);
    }
    return s;
  }
  /// Per rest area, N/m.
  Number energy(double young) const {
    Number sum{};
    for (const Number l : stretch) sum += (l - 1) * (l - 1);
    return young / 2 * sum;
  }

  std::array<Vector2<Number>, 3> along;       ///< t
  std::array<std::array<Number, D>, 3> edge;  ///< F t
  std::array<Number, 3> stretch;              ///< l
};

}  // namespace cutbench
