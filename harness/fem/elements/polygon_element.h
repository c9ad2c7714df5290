// A polygon as one finite element: the virtual element of lowest order (Beirao da Veiga, Brezzi, Cangiani, Manzini,
// Marini and Russo, Basic principles of virtual element methods, M3AS 23, 2013).
//
// A polygon of k corners X_i (rest) with area A knows of the field in it only its values x_i at the corners, between
// which it is linear along the sides. So the mean gradient is exact, F = sum x_i (x) G_i with G_i the outward normal of
// X_{i+1} - X_{i-1} times its length, over 2 A. The linear map of the polygon is Pi x (X) = mean(x) + F (X - mean(X)),
// means over the corners. What the corners depart from it, (I - Pi) x, is zero for every affine x, and is what a
// stabilisation resists (compound_sheet.h).
//
// All of it holds for a polygon that is not convex, and for a slit one: G_i is then the same for the whole boundary,
// both lips of the slit included, and F the mean gradient of the material. How the slit gapes is in the departure
// alone.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/fem/algebra/block_matrix.h"
#include "harness/mesh/constraints.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

/// The linear map of a polygon: D values as a function of the rest position.
template <int D>
struct LinearMap {
  Eigen::Matrix<double, D, 1> mean;
  Eigen::Matrix<double, D, 2> gradient;  ///< F
  Eigen::Matrix<double, D, 1> at(Point2 from_mean) const {
    return mean + gradient * Eigen::Vector2d(from_mean.x, from_mean.y);
  }
};

struct PolygonElement {
  PolygonElement() = default;
  PolygonElement(const Sheet& sheet, const Polygon& polygon);

  Polygon polygon;               ///< no corners where the slot is free
  std::vector<Point2> gradient;  ///< G_i, 1/length
  std::vector<Point2> offset;    ///< of corner i from the mean of all
  std::vector<Point2> inside;    ///< likewise of the vertices inside
  Eigen::MatrixXd departure;     ///< I - Pi at the corners, k x k
  Eigen::MatrixXd departure2;    ///< departure^T departure
  /// The corners' distance from the quadratic that fits them best, k x k: what the bending of a sheet may not see.
  Eigen::MatrixXd unbent;
  double area = 0;

  std::size_t size() const { return polygon.corners.size(); }
  bool alive() const { return !polygon.corners.empty(); }
  double corner_area() const { return area / to_double(size()); }  ///< that stands for a corner's mass
  /// Of a vertex of its triangles, from the mean of the corners.
  Point2 offset_of(DeformedIndex vertex) const;
  /// \param x  D values per deformed vertex
  template <int D>
  LinearMap<D> map(const Field& x) const;
};

}  // namespace cutbench
