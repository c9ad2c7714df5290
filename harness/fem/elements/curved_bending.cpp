#include "harness/fem/elements/curved_bending.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d at(const Field& x, std::int32_t vertex) { return x.segment<3>(3 * to_index(to_size(vertex))); }

/// a unit vector, or zero of one without length; and its derivative by a.
struct Direction {
  explicit Direction(const Vector3d& a) {
    const double length = a.norm();
    if (!(length > 0)) return;
    unit = a / length;
    derivative = (Matrix3d::Identity() - unit * unit.transpose()) / length;
  }
  Vector3d unit = Vector3d::Zero();
  Matrix3d derivative = Matrix3d::Zero();
};

Matrix3d cross_with(const Vector3d& a) {
  Matrix3d m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// The doubled area vector of a triangle, and its derivative by each corner.
struct AreaVector {
  explicit AreaVector(const std::array<Vector3d, 3>& corners) {
    const Vector3d first = corners[1] - corners[0], second = corners[2] - corners[0];
    value = first.cross(second);
    derivative[1] = -cross_with(second);
    derivative[2] = cross_with(first);
    derivative[0] = -derivative[1] - derivative[2];
  }
  Vector3d value;
  std::array<Matrix3d, 3> derivative;
};

std::array<std::int32_t, 3> corners_of(const Sheet& sheet, TriangleIndex t) {
  const auto& d = sheet.triangle(t).deformed;
  return {d[0].value, d[1].value, d[2].value};
}

std::array<Vector3d, 3> corners_at(const Field& x, const std::array<std::int32_t, 3>& corners) {
  return {at(x, corners[0]), at(x, corners[1]), at(x, corners[2])};
}

Vector3d in_space(const Sheet& sheet, std::int32_t vertex) {
  const Point3 p = sheet.position(DeformedIndex(to_size(vertex)));
  return {p.x, p.y, p.z};
}

}  // namespace

void CurvedBending::update(const Sheet& sheet, const Bending& bending) {
  hinges_.resize(3 * sheet.triangle_slots());
  derived_ = false;
  for (const TriangleIndex t : bending.rebuilt())
    for (std::size_t k = 0; k < 3; ++k) {
      Hinge& hinge = hinges_[3 * t() + k];
      hinge = {};
      if (!sheet.triangle(t).alive()) continue;
      const HalfEdge across = bending.across(sheet, t, k);
      if (!across.valid()) continue;
      hinge = hinge_of(sheet, bending, t, k, across);
      hinge.rest = at_rest(hinge, sheet);
    }
}

CurvedBending::Hinge CurvedBending::hinge_of(const Sheet& sheet, const Bending& bending, TriangleIndex t, std::size_t k,
                                             HalfEdge across) {
  Hinge hinge;
  hinge.corners = {corners_of(sheet, t), corners_of(sheet, triangle_of(across))};
  for (const auto& corners : hinge.corners)
    for (const std::int32_t corner : corners) {
      const auto end = hinge.vertex.begin() + to_int(hinge.size);
      if (std::find(hinge.vertex.begin(), end, corner) == end) hinge.vertex[hinge.size++] = corner;
    }
  for (const StencilTerm& term : bending.stencil(t()))
    for (std::size_t i = 0; i < hinge.size; ++i)
      if (hinge.vertex[i] == term.vertex) hinge.factor[i] = term.factor[k];
  // Neighbours that are oriented alike have their common side in opposite directions.
  const auto side = [&](const std::array<std::int32_t, 3>& corners, std::size_t first) {
    const Point3 a = sheet.position(DeformedIndex(to_size(corners[first])));
    const Point3 b = sheet.position(DeformedIndex(to_size(corners[(first + 1) % 3])));
    return Vector(b.x - a.x, b.y - a.y, b.z - a.z);
  };
  const bool alike = side(hinge.corners[0], k).dot(side(hinge.corners[1], to_size(corner_of(across)))) < 0;
  hinge.second_side = alike ? 1 : -1;
  return hinge;
}

double CurvedBending::at_rest(const Hinge& hinge, const Sheet& sheet) {
  const auto normal = [&](const std::array<std::int32_t, 3>& corners) {
    const AreaVector area({in_space(sheet, corners[0]), in_space(sheet, corners[1]), in_space(sheet, corners[2])});
    return Direction(area.value).unit;
  };
  Vector row = Vector::Zero();
  for (std::size_t i = 0; i < hinge.size; ++i) row += hinge.factor[i] * in_space(sheet, hinge.vertex[i]);
  const Vector first = normal(hinge.corners[0]), second = normal(hinge.corners[1]);
  return row.dot(Direction(first + hinge.second_side * second).unit);
}

CurvedBending::Vector CurvedBending::excess_at(const Hinge& hinge, const Field& x) {
  Vector excess = Vector::Zero();
  for (std::size_t i = 0; i < hinge.size; ++i) excess += hinge.factor[i] * at(x, hinge.vertex[i]);
  const Vector first = Direction(AreaVector(corners_at(x, hinge.corners[0])).value).unit;
  const Vector second = Direction(AreaVector(corners_at(x, hinge.corners[1])).value).unit;
  return excess - hinge.rest * Direction(first + hinge.second_side * second).unit;
}

CurvedBending::Derivatives CurvedBending::derivatives_at(const Hinge& hinge, const Field& x) {
  Derivatives derivative{};
  for (std::size_t i = 0; i < hinge.size; ++i) derivative[i] = hinge.factor[i] * Matrix3d::Identity();
  const std::array<AreaVector, 2> area{AreaVector(corners_at(x, hinge.corners[0])),
                                       AreaVector(corners_at(x, hinge.corners[1]))};
  const std::array<Direction, 2> normal{Direction(area[0].value), Direction(area[1].value)};
  const std::array<double, 2> side{1, hinge.second_side};
  const Direction bisector(normal[0].unit + side[1] * normal[1].unit);
  for (std::size_t n = 0; n < 2; ++n) {
    const Matrix3d by_area = hinge.rest * side[n] * bisector.derivative * normal[n].derivative;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i =
          to_size(std::find(hinge.vertex.begin(), hinge.vertex.end(), hinge.corners[n][k]) - hinge.vertex.begin());
      derivative[i] -= by_area * area[n].derivative[k];
    }
  }
  return derivative;
}

void CurvedBending::rotate(const Field& x) {
  x_ = x;
  derived_ = false;
  for (Hinge& hinge : hinges_)
    if (hinge.size > 0) hinge.excess = excess_at(hinge, x);
}

const std::vector<CurvedBending::Derivatives>& CurvedBending::derivatives() const {
  if (std::exchange(derived_, true)) return derivatives_;
  derivatives_.resize(hinges_.size());
  for (std::size_t h = 0; h < hinges_.size(); ++h)
    if (hinges_[h].size > 0) derivatives_[h] = derivatives_at(hinges_[h], x_);
  return derivatives_;
}

void CurvedBending::add_force(double factor, Field& f) const {
  const std::vector<Derivatives>& by = derivatives();
  for (std::size_t h = 0; h < hinges_.size(); ++h)
    for (std::size_t i = 0; i < hinges_[h].size; ++i)
      f.segment<3>(3 * to_index(to_size(hinges_[h].vertex[i]))) -= factor * by[h][i].transpose() * hinges_[h].excess;
}

void CurvedBending::add_stiffness(double factor, BlockMatrix<3>& blocks) {
  const std::vector<Derivatives>& by = derivatives();
  for (std::size_t h = 0; h < hinges_.size(); ++h) {
    Hinge& hinge = hinges_[h];
    auto place = hinge.places.begin();
    for (std::size_t i = 0; i < hinge.size; ++i) {
      const auto row = to_size(hinge.vertex[i]);
      const auto columns = blocks.columns(row);
      for (std::size_t k = 0; k < hinge.size; ++k, ++place) {
        if (to_size(*place) >= columns.size() || columns[to_size(*place)] != hinge.vertex[k])
          *place = to_int32(std::find(columns.begin(), columns.end(), hinge.vertex[k]) - columns.begin());
        if (to_size(*place) == columns.size()) throw std::logic_error("curved bending: a row lacks a hinge's column");
        blocks.block(blocks.first_slot(row) + *place) += factor * by[h][i].transpose() * by[h][k];
      }
    }
  }
}

double CurvedBending::energy() const {
  double sum = 0;
  for (const Hinge& hinge : hinges_) sum += hinge.excess.squaredNorm();
  return sum / 2;
}

}  // namespace cutbench
