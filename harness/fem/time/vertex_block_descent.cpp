#include "harness/fem/time/vertex_block_descent.h"

#include <Eigen/Cholesky>

#include "harness/base/conversions.h"
#include "harness/fem/elements/element_stiffness.h"

namespace cutbench {

namespace {

/// The quadratic of one vertex: H dx = f.
template <int D>
struct Quadratic {
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;

  Vector force = Vector::Zero();
  Matrix stiffness = Matrix::Zero();

  void add_inertia(double mass_over_h2, const Vector& from_inertia) {
    stiffness.diagonal().array() += mass_over_h2;
    force -= mass_over_h2 * from_inertia;
  }

  void add_triangle(const Element& element, std::size_t corner, const MembraneLaw& law, double damping, const Field& x0,
                    const Field& x) {
    const Deformation<D> now = deformation_of<D>(element, x, law.strain, law.lame);
    const ElementStiffness<D> tangent(element, now, law);
    const auto block = [&](std::size_t k) { return Matrix(Eigen::Map<const Matrix>(tangent.block(corner, k).data())); };
    force += membrane_force(element, now, to_int(corner));
    stiffness += (1 + damping) * block(corner);
    for (std::size_t k = 0; k < 3 && damping > 0; ++k) {
      const auto at = to_index(D * element.vertex[k]());
      force -= damping * block(k) * (x.template segment<D>(at) - x0.template segment<D>(at));
    }
  }

  void add_bending(const BlockMatrix<1>& matrix, std::size_t vertex, double damping, const Field& x0, const Field& x) {
    const auto columns = matrix.columns(vertex);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const double factor = matrix.block(matrix.first_slot(vertex) + to_int32(k))(0);
      const auto at = D * to_index(to_size(columns[k]));
      const Vector place = x.template segment<D>(at);
      force -= factor * (place + damping * (place - x0.template segment<D>(at)));
      if (k == 0) stiffness.diagonal().array() += (1 + damping) * factor;
    }
  }

  Vector minimum(const std::uint8_t* held) const {
    Matrix h = stiffness;
    Vector f = force;
    for (int k = 0; k < D; ++k) {
      if (held[k] == 0) continue;
      h.row(k).setZero();
      h.col(k).setZero();
      h(k, k) = 1;
      f[k] = 0;
    }
    return h.ldlt().solve(f);
  }
};

}  // namespace

template <int D>
void VertexBlockDescent<D>::solve(const Model<D>& model, double h, int sweeps, const Field& x0, const Field& y,
                                  Field& x) const {
  const Material& material = model.material();
  MembraneLaw law = law_of(material, model.physics());
  if (law.of_stress == StressStiffness::full) law.of_stress = StressStiffness::positive;
  const double inertia = (1 + h * material.mass_damping) / (h * h), damping = material.stiffness_damping / h;
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t v = 0; v < model.vertices(); ++v) {
      const double mass = model.lumped_mass()[to_index(v)];
      if (!(mass > 0)) continue;
      const auto at = to_index(D * v);
      Quadratic<D> vertex;
      vertex.add_inertia(inertia * mass, x.template segment<D>(at) - y.template segment<D>(at));
      for (const HalfEdge corner : model.incidence().at(v))
        vertex.add_triangle(model.elements()[triangle_of(corner)()], to_size(corner_of(corner)), law, damping, x0, x);
      if (const Bending* bending = model.bending()) vertex.add_bending(bending->matrix(), v, damping, x0, x);
      x.template segment<D>(at) += vertex.minimum(&model.held()[D * v]);
    }
}

template class VertexBlockDescent<2>;
template class VertexBlockDescent<3>;

}  // namespace cutbench
