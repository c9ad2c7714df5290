#include "harness/fem/elements/compound_sheet.h"

#include <Eigen/LU>
#include <algorithm>

#include "harness/base/conversions.h"
#include "harness/fem/elements/element_stiffness.h"

namespace cutbench {

namespace {

template <int D>
Eigen::Matrix<double, D, 1> normal_of(const Deformation<D>& deformation) {
  if constexpr (D == 3)
    return deformation.frame.col(0).cross(deformation.frame.col(1)).normalized();
  else
    return Eigen::Matrix<double, D, 1>::Zero();  // nothing lies across a plane
}

Vector2<double> vector(Point2 p) { return {p.x, p.y}; }

Eigen::Vector2d gradient(const PolygonElement& polygon, Eigen::Index corner) {
  const auto [x, y] = polygon.gradient[to_size(corner)];
  return {x, y};
}

/// 2 k x 2 k, N/m.
Eigen::MatrixXd stiffness_of(const PolygonElement& polygon, const Lame& lame) {
  const auto k = to_index(polygon.size());
  StrainInFrame<2, double> at_rest{};
  at_rest.frame[0][0] = at_rest.frame[1][1] = 1;
  const ElementStiffness<2> stiffness({}, polygon.area, at_rest, {Strain::linear, StressStiffness::none, lame});
  const Eigen::MatrixXd stabilisation =
      polygon.polygon.stabilisation * young_of(lame) * polygon.departure.transpose() * polygon.departure;
  Eigen::MatrixXd matrix(2 * k, 2 * k);
  for (Eigen::Index i = 0; i < k; ++i)
    for (Eigen::Index j = 0; j < k; ++j) {
      const auto block = stiffness.block(vector(polygon.gradient[to_size(i)]), vector(polygon.gradient[to_size(j)]));
      matrix.block<2, 2>(2 * i, 2 * j) =
          Eigen::Map<const Eigen::Matrix2d>(block.data()) + stabilisation(i, j) * Eigen::Matrix2d::Identity();
    }
  return matrix;
}

void add_force(const PolygonElement& polygon, const Eigen::MatrixXd& stiffness, const Field& moved, Field& force) {
  Field at_corners(stiffness.rows());
  Eigen::Index next = 0;
  for (const auto d : polygon.polygon.corners) at_corners.segment<2>(2 * next++) = moved.segment<2>(2 * d.value);
  const Field pull = stiffness * at_corners;
  next = 0;
  for (const auto d : polygon.polygon.corners) force.segment<2>(2 * d.value) += pull.segment<2>(2 * next++);
}

}  // namespace

CompoundStiffness::CompoundStiffness(const ElementTable& elements, const Lame& lame) {
  for (std::size_t p = 0; p < elements.polygon_slots(); ++p)
    stiffness_.push_back(stiffness_of(elements.polygon(p), lame));
}

void CompoundStiffness::add_force(const ElementTable& elements, const Field& moved, Field& force) const {
  for (std::size_t p = 0; p < stiffness_.size(); ++p)
    cutbench::add_force(elements.polygon(p), stiffness_[p], moved, force);
}

template <int D>
void CompoundSheet<D>::reset(const ElementTable& elements, TriangleIndex t) {
  const std::size_t slot = to_size(elements[t()].polygon);
  const PolygonElement& polygon = elements.polygon(slot);
  if (slot >= states_.size()) states_.resize(slot + 1);
  states_[slot].stabilisation = polygon.departure.transpose() * polygon.departure;
  states_[slot].slots.assign(polygon.size() * polygon.size(), -1);
}

template <int D>
void CompoundSheet<D>::find_slots(const ElementTable& elements, std::size_t vertex, const BlockMatrix<D>& blocks) {
  for (const std::int32_t p : elements.polygons_of(vertex)) {
    const auto slot = to_size(p);
    const auto& corners = elements.polygon(slot).polygon.corners;
    const auto own = std::find(corners.begin(), corners.end(), DeformedIndex(vertex)) - corners.begin();
    auto to = states_[slot].slots.begin() + own * to_index(corners.size());
    for (const DeformedIndex d : corners) *to++ = blocks.find(vertex, d.value);
  }
}

template <int D>
void CompoundSheet<D>::rotate(const ElementTable& elements, const Field& x, Field& force) {
  for (std::size_t p = 0; p < elements.polygon_slots(); ++p)
    if (elements.polygon(p).alive()) rotate(elements.polygon(p), x, states_[p], force);
}

template <int D>
void CompoundSheet<D>::rotate(const PolygonElement& polygon, const Field& x, State& state, Field& force) const {
  const LinearMap<D> map = polygon.map<D>(x);
  state.deformation = deformation_of<D>(map.gradient, law_.strain, law_.lame);
  const auto k = to_index(polygon.size());
  state.departure.resize(D, k);
  for (Eigen::Index i = 0; i < k; ++i) {
    const auto corner = to_size(i);
    state.departure.col(i) = x.segment<D>(D * polygon.polygon.corners[corner].value) - map.at(polygon.offset[corner]);
  }
  const auto& d = state.departure;
  Eigen::Matrix<double, D, 2> pull = polygon.area * state.deformation.frame * state.deformation.stress;
  const auto [in_plane, less, twist] = stabilisation_of(polygon);
  Eigen::Matrix<double, D, Eigen::Dynamic> resisted = in_plane * d;
  state.across.setZero(k);
  state.tilt.setZero(D, k);
  if (D == 3 && less != 0) {
    const Eigen::Matrix<double, D, 1> n = normal_of<D>(state.deformation);
    state.across = d.transpose() * n;
    state.unbent = polygon.unbent * state.across;
    const Eigen::VectorXd back = twist * polygon.unbent.transpose() * state.unbent - less * state.across;
    resisted += n * back.transpose();
    const Eigen::Matrix2d metric = map.gradient.transpose() * map.gradient;
    if (law_.strain != Strain::linear && metric.determinant() > 1e-14 * metric.squaredNorm()) {
      const Eigen::Matrix<double, D, 2> dual = map.gradient * metric.inverse();
      for (Eigen::Index i = 0; i < k; ++i) state.tilt.col(i) = dual * gradient(polygon, i);
      pull -= n * (d * back).transpose() * dual;
    }
  }
  resisted = resisted * polygon.departure;
  for (Eigen::Index i = 0; i < k; ++i) {
    const auto corner = to_size(i);
    force.segment<D>(D * polygon.polygon.corners[corner].value) -= pull * gradient(polygon, i) + resisted.col(i);
  }
}

template <int D>
double CompoundSheet<D>::energy(const ElementTable& elements) const {
  double sum = 0;
  for (std::size_t p = 0; p < elements.polygon_slots(); ++p) {
    if (!elements.polygon(p).alive()) continue;
    const auto [in_plane, less, twist] = stabilisation_of(elements.polygon(p));
    sum += elements.polygon(p).area * states_[p].deformation.energy +
           (in_plane * states_[p].departure.squaredNorm() - less * states_[p].across.squaredNorm() +
            twist * states_[p].unbent.squaredNorm()) /
               2;
  }
  return sum;
}

template <int D>
void CompoundSheet<D>::add_stiffness(const ElementTable& elements, double factor, BlockMatrix<D>& blocks) const {
  for (std::size_t p = 0; p < elements.polygon_slots(); ++p) {
    const PolygonElement& polygon = elements.polygon(p);
    if (!polygon.alive()) continue;
    const State& state = states_[p];
    const ElementStiffness<D> stiffness({}, factor * polygon.area, strain_of<D>(state.deformation), law_);
    const Eigen::Matrix<double, D, 1> n = normal_of<D>(state.deformation);
    const auto [in_plane, less, twist] = stabilisation_of(polygon);
    Eigen::MatrixXd unbent;  // how c changes with the corners along n, times its transpose
    if (twist != 0) {
      const Eigen::MatrixXd change = polygon.unbent * (polygon.departure - state.departure.transpose() * state.tilt);
      unbent = twist * change.transpose() * change;
    }
    const Block flat = in_plane * Block::Identity() - less * n * n.transpose();
    const Eigen::VectorXd pulled = polygon.departure.transpose() * state.across;
    const double across = state.across.squaredNorm();
    const auto k = to_index(polygon.size());
    for (Eigen::Index i = 0; i < k; ++i)
      for (Eigen::Index j = 0; j < k; ++j) {
        const auto block = stiffness.block(vector(polygon.gradient[to_size(i)]), vector(polygon.gradient[to_size(j)]));
        Block stabilisation = state.stabilisation(i, j) * flat;
        if (D == 3 && less != 0)
          stabilisation +=
              less * (pulled[i] * state.tilt.col(j) * n.transpose() + pulled[j] * n * state.tilt.col(i).transpose() +
                      across * state.tilt.col(i).dot(state.tilt.col(j)) * n * n.transpose());
        if (twist != 0) stabilisation += unbent(i, j) * n * n.transpose();
        blocks.block(state.slots[to_size(i * k + j)]) += Eigen::Map<const Block>(block.data()) + factor * stabilisation;
      }
  }
}

template class CompoundSheet<2>;
template class CompoundSheet<3>;

}  // namespace cutbench
