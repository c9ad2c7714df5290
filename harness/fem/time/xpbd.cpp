#include "harness/fem/time/xpbd.h"

#include <span>

#include "harness/base/conversions.h"
#include "harness/fem/elements/springs.h"

namespace cutbench {

namespace {

/// Of one triangle: C, and its derivative by each corner's place, which is a column for each value of C.
template <int D>
struct Projection {
  Eigen::Vector3d value;
  std::array<Eigen::Matrix<double, D, 3>, 3> gradient;
};

template <int D>
Projection<D> strain_constraint(const Element& element, const Field& x, Strain strain, const Lame& lame) {
  const Deformation<D> now = deformation_of<D>(element, x, strain, lame);
  Projection<D> c;
  c.value = {now.strain(0, 0), now.strain(1, 1), 2 * now.strain(0, 1)};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& [gx, gy] = element.gradient[k];
    c.gradient[k].col(0) = gx * now.frame.col(0);
    c.gradient[k].col(1) = gy * now.frame.col(1);
    c.gradient[k].col(2) = gy * now.frame.col(0) + gx * now.frame.col(1);
  }
  return c;
}

template <int D>
Projection<D> spring_constraint(const Element& element, const Field& x) {
  std::array<std::array<double, D>, 2> f{};
  std::array<Vector2<double>, 3> gradient;
  for (std::size_t k = 0; k < 3; ++k) {
    gradient[k] = {element.gradient[k].x, element.gradient[k].y};
    for (std::size_t d = 0; d < D; ++d) {
      const double place = x[to_index(D * element.vertex[k]() + d)];
      f[0][d] += place * gradient[k].x;
      f[1][d] += place * gradient[k].y;
    }
  }
  const Springs<D, double> springs(gradient, f);
  Projection<D> c;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto column = to_index(i);
    c.value[column] = springs.stretch[i] - 1;
    for (std::size_t k = 0; k < 3; ++k) {
      const double along = springs.along[i].x * gradient[k].x + springs.along[i].y * gradient[k].y;
      for (std::size_t d = 0; d < D; ++d)
        c.gradient[k](to_index(d), column) = along * springs.inverse(i) * springs.edge[i][d];
    }
  }
  return c;
}

/// S over the area, N/m.
Eigen::Matrix3d stiffness_of(const MembraneLaw& law) {
  if (law.strain == Strain::springs) return young_of(law.lame) * Eigen::Matrix3d::Identity();
  const auto [mu, lambda] = law.lame;
  Eigen::Matrix3d s;
  s << lambda + 2 * mu, lambda, 0, lambda, lambda + 2 * mu, 0, 0, 0, mu;
  return s;
}

}  // namespace

template <int D>
void Xpbd<D>::solve(const Model<D>& model, double h, int sweeps, const Field& x0, Field& x) {
  const double mass_factor = 1 + h * model.material().mass_damping;
  inverse_mass_.assign(model.held().size(), 0);
  for (std::size_t i = 0; i < inverse_mass_.size(); ++i) {
    const double mass = model.lumped_mass()[to_index(i / D)];
    if (!model.held()[i] && mass > 0) inverse_mass_[i] = 1 / (mass_factor * mass);
  }
  membrane_.assign(model.elements().size(), Eigen::Vector3d::Zero());
  bending_.assign(model.bending() ? model.elements().size() : 0, {});
  for (int i = 0; i < sweeps; ++i) {
    sweep_membrane(model, h, x0, x);
    if (model.bending()) sweep_bending(*model.bending(), h, model.material().stiffness_damping / h, x0, x);
  }
}

template <int D>
void Xpbd<D>::sweep_membrane(const Model<D>& model, double h, const Field& x0, Field& x) {
  const double damping = model.material().stiffness_damping / h;
  const MembraneLaw law = law_of(model.material(), model.physics());
  const Eigen::Matrix3d stiffness = stiffness_of(law);
  for (std::size_t e = 0; e < model.elements().size(); ++e) {
    const Element& element = model.elements()[e];
    if (!element.alive()) continue;
    Projection<D> c = law.strain == Strain::springs ? spring_constraint<D>(element, x)
                                                    : strain_constraint<D>(element, x, law.strain, law.lame);
    std::array<Eigen::Matrix<double, D, 3>, 3> moves;  // W G^T
    Eigen::Matrix3d mobility = Eigen::Matrix3d::Zero();
    for (std::size_t k = 0; k < 3; ++k) {
      const Eigen::Map<const Eigen::Matrix<double, D, 1>> w(&inverse_mass_[D * element.vertex[k]()]);
      moves[k] = w.asDiagonal() * c.gradient[k];
      mobility += (1 + damping) * c.gradient[k].transpose() * moves[k];
      const auto first = to_index(D * element.vertex[k]());
      c.value += damping * c.gradient[k].transpose() * (x.template segment<D>(first) - x0.template segment<D>(first));
    }
    const Eigen::Matrix3d s = h * h * element.material_area() * stiffness;
    const Eigen::Vector3d change =
        -(s * mobility + Eigen::Matrix3d::Identity()).partialPivLu().solve(s * c.value + membrane_[e]);
    membrane_[e] += change;
    for (std::size_t k = 0; k < 3; ++k) x.template segment<D>(to_index(D * element.vertex[k]())) += moves[k] * change;
  }
}

template <int D>
void Xpbd<D>::sweep_bending(const Bending& bending, double h, double damping, const Field& x0, Field& x) {
  for (std::size_t t = 0; t < bending_.size(); ++t) {
    const std::span<const StencilTerm> terms = bending.stencil(t);
    for (std::size_t row = 0; row < 3 && !terms.empty(); ++row)
      for (std::size_t d = 0; d < D; ++d) {
        double value = 0, mobility = 0;
        for (const StencilTerm& term : terms) {
          const std::size_t i = D * to_size(term.vertex) + d;
          const auto k = to_index(i);
          value += term.factor[row] * (x[k] + damping * (x[k] - x0[k]));
          mobility += (1 + damping) * term.factor[row] * term.factor[row] * inverse_mass_[i];
        }
        const double change = -(h * h * value + bending_[t][row][d]) / (h * h * mobility + 1);
        bending_[t][row][d] += change;
        for (const StencilTerm& term : terms) {
          const std::size_t i = D * to_size(term.vertex) + d;
          x[to_index(i)] += inverse_mass_[i] * term.factor[row] * change;
        }
      }
  }
}

template class Xpbd<2>;
template class Xpbd<3>;

}  // namespace cutbench
