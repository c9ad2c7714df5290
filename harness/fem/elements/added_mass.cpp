#include "harness/fem/elements/added_mass.h"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/portable_hypot.h"

namespace cutbench {

namespace {

using BendingRows = Eigen::Matrix<double, Eigen::Dynamic, 3>;

Eigen::Vector2d eigen_vector(Point2 p) { return {p.x, p.y}; }

using Decomposition = Eigen::JacobiSVD<Eigen::Matrix3d, Eigen::NoQRPreconditioner>;
/// The singular values of `rows`, and their right vectors. R in rows = Q R has the same ones, and a decomposition of
/// three rows compiles in half the time.
Decomposition decomposed(const BendingRows& rows) {
  const Eigen::HouseholderQR<BendingRows> qr(rows);
  const Eigen::Index n = std::min<Eigen::Index>(rows.rows(), 3);
  Eigen::Matrix3d r = Eigen::Matrix3d::Zero();
  r.topRows(n) = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
  return Decomposition(r, Eigen::ComputeFullV);
}

}  // namespace

ElementModes::InPlane ElementModes::membrane(std::size_t triangle) const {
  const Element& element = (*elements)[triangle];
  Eigen::Matrix2d t = Eigen::Matrix2d::Zero();
  for (const Point2 g : element.gradient) t += 3 * speed2 * eigen_vector(g) * eigen_vector(g).transpose();
  // The determinant is known without a difference, so that the smaller eigenvalue of a sliver has all its digits.
  const double determinant = 27 * speed2 * speed2 / (4 * element.area * element.area);
  const double larger = t.trace() / 2 + portable_hypot((t(0, 0) - t(1, 1)) / 2, t(0, 1));
  InPlane modes{{larger, determinant / larger}, Eigen::Vector2d::UnitX()};
  t.diagonal().array() -= modes.eigenvalue[1];
  const Eigen::Vector2d column = t.col(t(0, 0) > t(1, 1) ? 0 : 1);
  if (column.norm() > 0) modes.first = column.normalized();
  return modes;
}

void ElementModes::bending_rows(std::size_t triangle, BendingRows& rows) const {
  const auto stencil = bending->stencil(triangle);
  rows.resize(to_index(stencil.size()), 3);
  Eigen::Index next = 0;
  for (const auto& [vertex, factor] : stencil) {
    const auto holders = to_double(bending->stencils_of(to_size(vertex)).size());
    rows.row(next++) = Eigen::Map<const Eigen::RowVector3d>(factor.data()) * std::sqrt(holders / lumped[vertex]);
  }
}

double ElementModes::largest() const {
  double largest = 0;
  BendingRows rows;
  for (std::size_t e = 0; e < elements->size(); ++e) {
    if ((*elements)[e].is_triangle()) largest = std::max(largest, membrane(e).eigenvalue[0]);
    if (!bending || bending->stencil(e).empty()) continue;
    bending_rows(e, rows);
    largest = std::max(largest, std::pow(decomposed(rows).singularValues()[0], 2));
  }
  return largest;
}

void AddedMass::list(std::size_t vertex) {
  if (std::exchange(listed_in_[vertex], round_) != round_) rows_.push_back(vertex);
}

void AddedMass::update(const ElementModes& modes, const Incidence& incidence, std::span<const std::size_t> changed) {
  const auto vertices = to_size(modes.lumped.size()), triangles = modes.elements->size();
  ++round_;
  rows_.clear();
  matrix_.resize(vertices);
  place_.resize(vertices, -1);
  listed_in_.resize(vertices);
  in_plane_.resize(triangles, Eigen::Matrix2d::Zero());
  if (modes.bending) {
    bent_.resize(triangles, Eigen::Matrix3d::Zero());
    bent_in_.resize(triangles);
  }
  for (const std::size_t v : changed) {
    list(v);
    for (const auto c : incidence.at(v)) find_in_plane(modes, triangle_of(c)());
    if (!modes.bending) continue;
    for (const auto& [triangle, place] : modes.bending->stencils_of(v)) {
      const auto t = to_size(triangle);
      if (std::exchange(bent_in_[t], round_) != round_ && find_bent(modes, t))
        for (const StencilTerm& term : modes.bending->stencil(t)) list(to_size(term.vertex));
    }
  }
  for (const std::size_t v : rows_) write_row(modes, incidence, v);
}

double AddedMass::excess(double eigenvalue) const { return std::max(0.0, 1 / limit_ - 1 / eigenvalue); }

void AddedMass::find_in_plane(const ElementModes& modes, std::size_t triangle) {
  Eigen::Matrix2d& f = in_plane_[triangle];
  f.setZero();
  if (!(*modes.elements)[triangle].is_triangle()) return;
  const auto [eigenvalue, first] = modes.membrane(triangle);
  if (eigenvalue[0] <= limit_) return;
  const Eigen::Vector2d second(-first.y(), first.x());
  if (kind_ == Mass::scaled)
    f(0, 0) = eigenvalue[0] / limit_ - 1;
  else
    f = excess(eigenvalue[0]) * first * first.transpose() + excess(eigenvalue[1]) * second * second.transpose();
}

/// Whether there is or was something.
bool AddedMass::find_bent(const ElementModes& modes, std::size_t triangle) {
  Eigen::Matrix3d& f = bent_[triangle];
  const bool was = !f.isZero(0);
  f.setZero();
  modes.bending_rows(triangle, bending_rows_);
  if (bending_rows_.squaredNorm() <= limit_) return was;  // the sum of the eigenvalues
  const auto svd = decomposed(bending_rows_);
  const Eigen::Vector3d eigenvalue = svd.singularValues().cwiseAbs2();
  if (kind_ == Mass::scaled)
    f(0, 0) = std::max(0.0, eigenvalue[0] / limit_ - 1);
  else
    f = svd.matrixV() * eigenvalue.unaryExpr([this](double l) { return excess(l); }).asDiagonal() *
        svd.matrixV().transpose();
  return was || !f.isZero(0);
}

void AddedMass::write_row(const ElementModes& modes, const Incidence& incidence, std::size_t v) {
  columns_.clear();
  values_.clear();
  const auto add = [&](std::int32_t column, double value) {
    std::int32_t& place = place_[to_size(column)];
    if (place < 0) {
      place = to_int32(columns_.size());
      columns_.push_back(column);
      values_.push_back(0);
    }
    values_[to_size(place)] += value;
  };
  const auto own = to_int32(v);
  for (const auto c : incidence.at(v)) {
    const std::size_t t = triangle_of(c)();
    const Element& e = (*modes.elements)[t];
    const Eigen::Matrix2d& f = in_plane_[t];
    if (f.isZero(0)) continue;
    add(own, kind_ == Mass::scaled ? density_ * e.material_area() / 3 * f(0, 0) : 0);  // the diagonal comes first
    if (kind_ == Mass::scaled) continue;
    const Eigen::Vector2d pull =
        density_ * modes.speed2 * e.material_area() * f * eigen_vector(e.gradient[to_size(corner_of(c))]);
    for (std::size_t k = 0; k < 3; ++k) add(e.vertex[k].value, pull.dot(eigen_vector(e.gradient[k])));
  }
  if (modes.bending) {
    const auto stencils = modes.bending->stencils_of(v);
    for (const auto& [triangle, place] : stencils) {
      const Eigen::Matrix3d& f = bent_[to_size(triangle)];
      if (f.isZero(0)) continue;
      const auto share = modes.lumped[to_index(v)] / to_double(stencils.size());
      add(own, kind_ == Mass::scaled ? share * f(0, 0) : 0);
      if (kind_ == Mass::scaled) continue;
      const auto terms = modes.bending->stencil(to_size(triangle));
      const auto row = [](const StencilTerm& term) { return Eigen::Map<const Eigen::Vector3d>(term.factor.data()); };
      const Eigen::Vector3d pull = f * row(terms[to_size(place)]);
      for (const StencilTerm& term : terms) add(term.vertex, pull.dot(row(term)));
    }
  }
  matrix_.set_row(v, columns_);
  std::int32_t slot = matrix_.first_slot(v);
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    matrix_.block(slot++)(0) = values_[k];
    place_[to_size(columns_[k])] = -1;
  }
}

double AddedMass::total() const {
  double sum = 0;
  for (std::size_t v = 0; v < matrix_.rows(); ++v)
    for (std::size_t k = 0; k < matrix_.columns(v).size(); ++k)
      sum += matrix_.block(matrix_.first_slot(v) + to_int32(k))(0);
  return sum;
}

}  // namespace cutbench
