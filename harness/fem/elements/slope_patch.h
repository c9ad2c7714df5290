// Slopes of a bent sheet at the sides of a triangle, recovered from the vertices round it: a quadratic in rest
// coordinates through the triangle's corners and the far corners of its neighbours, six points, as in the enhanced
// rotation-free shell triangle (Flores and Onate, CMAME 194, 2005). Where there are fewer neighbours, or the six lie
// near a conic, so that several quadratics fit them, the patch grows ring by ring and the quadratic is the best fit
// (weighted least squares).
//
// A compound, an element of several triangles, has one patch, which begins with all its corners; vertices inside it
// are in none.
// The patch does not contain vertices behind an incision, or out of sight of the triangle's centroid, for example
// behind a tip.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "harness/fem/elements/element_table.h"

namespace cutbench {

/// What one deformed vertex contributes to three rows.
struct StencilTerm {
  std::int32_t vertex;
  std::array<double, 3> factor;
  bool operator==(const StencilTerm&) const = default;
};

class SlopePatch {
 public:
  /// Fits the patch of the element that has triangle t. Returns its reach: the number of unseparated edges from the
  /// element to the farthest triangle that it depends on.
  /// \param elements  null: each triangle is one
  int fit(const Sheet& sheet, const ElementTable* elements, TriangleIndex t);
  /// Of a triangle of the element with these corners. Row k: derivative into the triangle, at right angles to side k,
  /// at the side's midpoint; factors in 1/length. Exact for quadratics where the patch determines one, else for linear
  /// functions.
  std::span<const StencilTerm> terms(const std::array<Point2, 3>& corners);

 private:
  static constexpr int max_points = 32, max_reach = 6;
  /// Where the centroid sees through an edge: between two directions, counter-clockwise.
  struct Window {
    HalfEdge edge;
    Point2 right, left;
  };
  using Row = std::array<double, 8>;  ///< six columns, and two of zeros that make loops even

  void begin(const Sheet& sheet, TriangleIndex t);
  void begin(const Sheet& sheet, const ElementShape& compound, std::span<const TriangleIndex> members);
  bool widen(const Sheet& sheet, const ElementTable* elements, bool first);
  void add(DeformedIndex d, Point2 offset);
  void factorise();
  bool tells_quadratics();
  void invert_what_is_known();

  // Points of the patch, as offsets from the centroid, which is the origin below.
  Point2 centre_;
  std::size_t own_ = 3;  // points: the element's corners, which come first
  std::vector<Point2> offset_;
  std::vector<StencilTerm> terms_;
  std::vector<Window> windows_, next_windows_;
  // The fit: values of 1, x, y | x^2/2, xy/sqrt(2), y^2/2 at the points, each row times its weight, as an orthogonal
  // matrix times an upper triangular one.
  double scale_ = 1;  ///< unit of x and y
  std::array<double, max_points> weight_{};
  std::array<Row, max_points> orthogonal_{};
  std::array<Row, 6> upper_{};
  double reference_ = 0;     ///< size of the quadratic columns
  Eigen::Matrix3d inverse_;  ///< of the quadratic part of upper_, or its pseudo-inverse
};

}  // namespace cutbench
