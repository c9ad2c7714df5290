#include "harness/fem/elements/curved_bending.h"

#include <Eigen/Geometry>
#include <algorithm>

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
  AreaVector(const Field& x, const std::array<std::int32_t, 3>& corners) {
    const Vector3d first = at(x, corners[1]) - at(x, corners[0]), second = at(x, corners[2]) - at(x, corners[0]);
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

Field rest_positions(const Sheet& sheet) {
  Field x(3 * to_index(sheet.deformed_slots()));
  for (std::size_t v = 0; v < sheet.deformed_slots(); ++v) {
    const Point3 p = sheet.position(DeformedIndex(v));
    x.segment<3>(3 * to_index(v)) = Eigen::Vector3d(p.x, p.y, p.z);
  }
  return x;
}

}  // namespace

void CurvedBending::update(const Sheet& sheet, const Bending& bending) {
  hinges_.clear();
  const Field rest = rest_positions(sheet);
  for (std::size_t i = 0; i < sheet.triangle_slots(); ++i) {
    const TriangleIndex t(i);
    if (!sheet.triangle(t).alive()) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const HalfEdge across = bending.across(sheet, t, k);
      if (!across.valid()) continue;
      Hinge hinge = hinge_of(sheet, bending, t, k, across);
      hinge.rest = at_rest(hinge, rest);
      hinges_.push_back(hinge);
    }
  }
  std::size_t pairs = 0;
  for (const Hinge& hinge : hinges_) pairs += hinge.size * hinge.size;
  places_.assign(pairs, 0);
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

double CurvedBending::at_rest(const Hinge& hinge, const Field& x) {
  Vector row = Vector::Zero();
  for (std::size_t i = 0; i < hinge.size; ++i) row += hinge.factor[i] * at(x, hinge.vertex[i]);
  const Vector first = Direction(AreaVector(x, hinge.corners[0]).value).unit;
  const Vector second = Direction(AreaVector(x, hinge.corners[1]).value).unit;
  return row.dot(Direction(first + hinge.second_side * second).unit);
}

void CurvedBending::place(Hinge& hinge, const Field& x) {
  hinge.excess.setZero();
  for (std::size_t i = 0; i < hinge.size; ++i) {
    hinge.excess += hinge.factor[i] * at(x, hinge.vertex[i]);
    hinge.derivative[i] = hinge.factor[i] * Matrix3d::Identity();
  }
  const std::array<AreaVector, 2> area{AreaVector(x, hinge.corners[0]), AreaVector(x, hinge.corners[1])};
  const std::array<Direction, 2> normal{Direction(area[0].value), Direction(area[1].value)};
  const std::array<double, 2> side{1, hinge.second_side};
  const Direction bisector(normal[0].unit + side[1] * normal[1].unit);
  hinge.excess -= hinge.rest * bisector.unit;
  for (std::size_t n = 0; n < 2; ++n) {
    const Matrix3d by_area = hinge.rest * side[n] * bisector.derivative * normal[n].derivative;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto i =
          to_size(std::find(hinge.vertex.begin(), hinge.vertex.end(), hinge.corners[n][k]) - hinge.vertex.begin());
      hinge.derivative[i] -= by_area * area[n].derivative[k];
    }
  }
}

void CurvedBending::rotate(const Field& x) {
  for (Hinge& hinge : hinges_) place(hinge, x);
}

void CurvedBending::add_force(double factor, Field& f) const {
  for (const Hinge& hinge : hinges_)
    for (std::size_t i = 0; i < hinge.size; ++i)
      f.segment<3>(3 * to_index(to_size(hinge.vertex[i]))) -= factor * hinge.derivative[i].transpose() * hinge.excess;
}

void CurvedBending::add_stiffness(double factor, BlockMatrix<3>& blocks) {
  auto place = places_.begin();
  for (const Hinge& hinge : hinges_)
    for (std::size_t i = 0; i < hinge.size; ++i) {
      const auto row = to_size(hinge.vertex[i]);
      const auto columns = blocks.columns(row);
      for (std::size_t k = 0; k < hinge.size; ++k, ++place) {
        if (to_size(*place) >= columns.size() || columns[to_size(*place)] != hinge.vertex[k])
          *place = to_int32(std::find(columns.begin(), columns.end(), hinge.vertex[k]) - columns.begin());
        blocks.block(blocks.first_slot(row) + *place) += factor * hinge.derivative[i].transpose() * hinge.derivative[k];
      }
    }
}

double CurvedBending::energy() const {
  double sum = 0;
  for (const Hinge& hinge : hinges_) sum += hinge.excess.squaredNorm();
  return sum / 2;
}

}  // namespace cutbench
