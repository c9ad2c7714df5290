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
  const Eigen::MatrixXd stabilisation = polygon.polygon.stabilisation * young_of(lame) * polygon.departure2;
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
void CompoundLaw<D>::bend(const PolygonElement& polygon, const Field& x, BentCompound<D>& bent) const {
  const LinearMap<D> map = polygon.map<D>(x);
  bent.deformation = deformation_of<D>(map.gradient, law_.strain, law_.lame);
  const auto k = to_index(polygon.size());
  bent.departure.resize(D, k);
  for (Eigen::Index i = 0; i < k; ++i) {
    const auto corner = to_size(i);
    bent.departure.col(i) = x.segment<D>(D * polygon.polygon.corners[corner].value) - map.at(polygon.offset[corner]);
  }
  const auto& d = bent.departure;
  Eigen::Matrix<double, D, 2> pull = polygon.area * bent.deformation.frame * bent.deformation.stress;
  const auto [in_plane, less, twist, stretch] = stabilisation_of(polygon);
  Eigen::Matrix<double, D, Eigen::Dynamic> resisted = in_plane * d;
  bent.across.setZero(k);
  bent.tilt.setZero(D, k);
  if (D == 3 && less != 0) {
    const Eigen::Matrix<double, D, 1> n = normal_of<D>(bent.deformation);
    bent.across = d.transpose() * n;
    bent.unbent = polygon.unbent * bent.across;
    const Eigen::VectorXd back =
        twist * polygon.unbent.transpose() * bent.unbent + (stretch * bent.across.squaredNorm() - less) * bent.across;
    resisted += n * back.transpose();
    const Eigen::Matrix2d metric = map.gradient.transpose() * map.gradient;
    if (law_.strain != Strain::linear && metric.determinant() > 1e-14 * metric.squaredNorm()) {
      const Eigen::Matrix<double, D, 2> dual = map.gradient * metric.inverse();
      for (Eigen::Index i = 0; i < k; ++i) bent.tilt.col(i) = dual * gradient(polygon, i);
      pull -= n * (d * back).transpose() * dual;
    }
  }
  bent.force = -resisted * polygon.departure;
  for (Eigen::Index i = 0; i < k; ++i) bent.force.col(i) -= pull * gradient(polygon, i);
}

template <int D>
double CompoundLaw<D>::energy(const PolygonElement& polygon, const BentCompound<D>& bent) const {
  const auto [in_plane, less, twist, stretch] = stabilisation_of(polygon);
  const double across2 = bent.across.squaredNorm();
  return polygon.area * bent.deformation.energy +
         (in_plane * bent.departure.squaredNorm() + (stretch * across2 / 2 - less) * across2 +
          twist * bent.unbent.squaredNorm()) /
             2;
}

template <int D>
void CompoundLaw<D>::stiffness(const PolygonElement& polygon, const BentCompound<D>& bent,
                               std::vector<Block>& blocks) const {
  const ElementStiffness<D> stiffness({}, polygon.area, strain_of<D>(bent.deformation), law_);
  const Eigen::Matrix<double, D, 1> n = normal_of<D>(bent.deformation);
  const auto [in_plane, less, twist, stretch] = stabilisation_of(polygon);
  const double across2 = bent.across.squaredNorm();
  Eigen::MatrixXd along_n;
  if (D == 3 && less != 0) {
    const Eigen::MatrixXd change = polygon.departure - bent.departure.transpose() * bent.tilt;  // of n d_i
    const Eigen::MatrixXd unbent = polygon.unbent * change;
    const Eigen::VectorXd farther = change.transpose() * bent.across;
    along_n = twist * unbent.transpose() * unbent +
              stretch * (across2 * change.transpose() * change + 2 * farther * farther.transpose());
  }
  const Block flat = in_plane * Block::Identity() - less * n * n.transpose();
  const Eigen::VectorXd pulled = polygon.departure.transpose() * bent.across;
  const auto k = to_index(polygon.size());
  blocks.resize(to_size(k * k));
  for (Eigen::Index i = 0; i < k; ++i)
    for (Eigen::Index j = 0; j < k; ++j) {
      const auto linear = stiffness.block(vector(polygon.gradient[to_size(i)]), vector(polygon.gradient[to_size(j)]));
      Block& block = blocks[to_size(i * k + j)];
      block = Eigen::Map<const Block>(linear.data()) + polygon.departure2(i, j) * flat;
      if (D == 3 && less != 0)
        block += less * (pulled[i] * bent.tilt.col(j) * n.transpose() + pulled[j] * n * bent.tilt.col(i).transpose() +
                         across2 * bent.tilt.col(i).dot(bent.tilt.col(j)) * n * n.transpose()) +
                 along_n(i, j) * n * n.transpose();
    }
}

template <int D>
void CompoundSheet<D>::reset(const ElementTable& elements, TriangleIndex t) {
  const std::size_t slot = to_size(elements[t()].polygon);
  const PolygonElement& polygon = elements.polygon(slot);
  if (slot >= states_.size()) states_.resize(slot + 1);
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
  for (std::size_t p = 0; p < elements.polygon_slots(); ++p) {
    const PolygonElement& polygon = elements.polygon(p);
    if (!polygon.alive()) continue;
    law_.bend(polygon, x, states_[p].bent);
    for (std::size_t i = 0; i < polygon.size(); ++i)
      force.segment<D>(D * polygon.polygon.corners[i].value) += states_[p].bent.force.col(to_index(i));
  }
}

template <int D>
double CompoundSheet<D>::energy(const ElementTable& elements) const {
  double sum = 0;
  for (std::size_t p = 0; p < elements.polygon_slots(); ++p)
    if (elements.polygon(p).alive()) sum += law_.energy(elements.polygon(p), states_[p].bent);
  return sum;
}

template <int D>
void CompoundSheet<D>::add_stiffness(const ElementTable& elements, double factor, BlockMatrix<D>& blocks) const {
  std::vector<typename CompoundLaw<D>::Block> own;
  for (std::size_t p = 0; p < elements.polygon_slots(); ++p) {
    if (!elements.polygon(p).alive()) continue;
    law_.stiffness(elements.polygon(p), states_[p].bent, own);
    for (std::size_t i = 0; i < own.size(); ++i) blocks.block(states_[p].slots[i]) += factor * own[i];
  }
}

template class CompoundLaw<2>;
template class CompoundLaw<3>;
template class CompoundSheet<2>;
template class CompoundSheet<3>;

}  // namespace cutbench
