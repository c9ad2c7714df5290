#include "harness/fem/elements/polygon_element.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "harness/base/conversions.h"
#include "harness/fem/elements/rest_corners.h"

namespace cutbench {

namespace {

/// I - the projection onto quadratic functions of the places.
Eigen::MatrixXd rest_of_quadratics(const std::vector<Point2>& places) {
  const auto n = to_index(places.size());
  double size = 0;
  for (const Point2 p : places) size = std::max({size, std::abs(p.x), std::abs(p.y)});
  Eigen::MatrixXd functions(n, 6);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Point2 p = 1 / size * places[to_size(i)];
    functions.row(i) << 1, p.x, p.y, p.x * p.x, p.x * p.y, p.y * p.y;
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> fit(functions);
  const Eigen::MatrixXd base = fit.householderQ() * Eigen::MatrixXd::Identity(n, fit.rank());
  return Eigen::MatrixXd::Identity(n, n) - base * base.transpose();
}

/// The others lie in its plane, which its corners give best.
TriangleIndex largest_of(const Sheet& sheet, const std::vector<TriangleIndex>& triangles) {
  const auto twice_area = [&](TriangleIndex t) {
    const auto c = sheet.corners(t);
    return cross(c[1] - c[0], c[2] - c[0]);
  };
  return *std::max_element(triangles.begin(), triangles.end(),
                           [&](TriangleIndex s, TriangleIndex t) { return twice_area(s) < twice_area(t); });
}

}  // namespace

PolygonElement::PolygonElement(const Sheet& sheet, const Polygon& of) : polygon(of) {
  const RestPlane place(sheet, largest_of(sheet, polygon.triangles));
  const std::size_t k = size();
  const Point2 origin = place(polygon.corners[0]);  // differences, so that a sheet far from zero loses nothing
  Point2 mean{};
  for (const DeformedIndex d : polygon.corners) offset.push_back(place(d) - origin);
  for (const Point2 p : offset) mean = mean + 1 / to_double(k) * p;
  for (Point2& p : offset) p = p - mean;
  for (const DeformedIndex d : polygon.inside) inside.push_back(place(d) - origin - mean);
  for (std::size_t i = 0; i < k; ++i) area += cross(offset[i], offset[(i + 1) % k]) / 2;
  for (std::size_t i = 0; i < k; ++i) {
    const Point2 across = offset[(i + 1) % k] - offset[(i + k - 1) % k];
    gradient.push_back({across.y / (2 * area), -across.x / (2 * area)});
  }
  const auto n = to_index(k);
  departure = Eigen::MatrixXd::Identity(n, n) - Eigen::MatrixXd::Constant(n, n, 1.0 / to_double(k));
  for (Eigen::Index i = 0; i < n; ++i)
    for (Eigen::Index j = 0; j < n; ++j) departure(i, j) -= dot(offset[to_size(i)], gradient[to_size(j)]);
  departure2 = departure.transpose() * departure;
  unbent = rest_of_quadratics(offset);
}

Point2 PolygonElement::offset_of(DeformedIndex vertex) const {
  const auto corner = std::find(polygon.corners.begin(), polygon.corners.end(), vertex);
  if (corner != polygon.corners.end()) return offset[to_size(corner - polygon.corners.begin())];
  const auto other = std::find(polygon.inside.begin(), polygon.inside.end(), vertex);
  return inside[to_size(other - polygon.inside.begin())];
}

template <int D>
LinearMap<D> PolygonElement::map(const Field& x) const {
  const auto at = [&](std::size_t i) { return x.segment<D>(D * polygon.corners[i].value); };
  const Eigen::Matrix<double, D, 1> first = at(0);
  LinearMap<D> map{Eigen::Matrix<double, D, 1>::Zero(), Eigen::Matrix<double, D, 2>::Zero()};
  for (std::size_t i = 1; i < size(); ++i) {
    const Eigen::Matrix<double, D, 1> away = at(i) - first;
    map.mean += away;
    map.gradient += away * Eigen::RowVector2d(gradient[i].x, gradient[i].y);
  }
  map.mean = first + map.mean / to_double(size());
  return map;
}

template LinearMap<2> PolygonElement::map<2>(const Field&) const;
template LinearMap<3> PolygonElement::map<3>(const Field&) const;

}  // namespace cutbench
