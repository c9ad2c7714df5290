#include "harness/mesh/triangulate.h"

#include <cmath>
#include <numeric>

#include "harness/base/conversions.h"
#include "harness/mesh/predicates.h"

namespace cutbench {

namespace {

class Ears {
 public:
  explicit Ears(const std::vector<Point3>& corners) : corners_(corners), left_(corners.size()) {
    std::iota(left_.begin(), left_.end(), std::size_t{0});
    project();
  }

  std::vector<std::array<std::size_t, 3>> cut() {
    std::vector<std::array<std::size_t, 3>> triangles;
    find_all();
    while (left_.size() > 3) {
      const std::size_t ear = shortest();
      if (ear == left_.size()) return {};
      triangles.push_back({before(ear), left_[ear], after(ear)});
      take_off(ear);
    }
    if (turn(left_[0], left_[1], left_[2]) <= 0) return {};
    triangles.push_back({left_[0], left_[1], left_[2]});
    return triangles;
  }

 private:
  static constexpr double no_ear = -1;

  /// Along the axis of the largest part of Newell's normal, so that the polygon is counter-clockwise.
  void project() {
    Point3 normal;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Point3 p = corners_[i] + -1.0 * corners_[0], q = corners_[(i + 1) % corners_.size()] + -1.0 * corners_[0];
      normal = normal + Point3{p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
    }
    const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
    for (const Point3& p : corners_) {
      if (z >= x && z >= y)
        flat_.push_back(normal.z > 0 ? Point2{p.x, p.y} : Point2{p.y, p.x});
      else if (y >= x)
        flat_.push_back(normal.y > 0 ? Point2{p.z, p.x} : Point2{p.x, p.z});
      else
        flat_.push_back(normal.x > 0 ? Point2{p.y, p.z} : Point2{p.z, p.y});
    }
  }

  std::size_t before(std::size_t i) const { return left_[(i + left_.size() - 1) % left_.size()]; }
  std::size_t after(std::size_t i) const { return left_[(i + 1) % left_.size()]; }
  int turn(std::size_t a, std::size_t b, std::size_t c) const { return orientation(flat_[a], flat_[b], flat_[c]); }

  /// The squared length of the diagonal that cuts corner i off, or no_ear.
  double diagonal(std::size_t i) const {
    const std::size_t a = before(i), b = left_[i], c = after(i);
    if (turn(a, b, c) <= 0) return no_ear;
    for (std::size_t other : left_) {
      if (other == a || other == b || other == c) continue;
      if (turn(a, b, other) >= 0 && turn(b, c, other) >= 0 && turn(c, a, other) >= 0) return no_ear;
    }
    if (left_.size() == 4 && turn(a, c, after((i + 1) % left_.size())) <= 0) return no_ear;
    const Point3 d = corners_[c] + -1.0 * corners_[a];
    return d.x * d.x + d.y * d.y + d.z * d.z;
  }

  void find_all() {
    for (std::size_t i = 0; i < left_.size(); ++i) diagonals_.push_back(diagonal(i));
  }

  std::size_t shortest() const {
    std::size_t best = left_.size();
    for (std::size_t i = 0; i < left_.size(); ++i)
      if (diagonals_[i] != no_ear && (best == left_.size() || diagonals_[i] < diagonals_[best])) best = i;
    return best;
  }

  void take_off(std::size_t ear) {
    left_.erase(left_.begin() + to_index(ear));
    diagonals_.erase(diagonals_.begin() + to_index(ear));
    if (left_.size() == 4) {
      for (std::size_t i = 0; i < 4; ++i) diagonals_[i] = diagonal(i);
      return;
    }
    for (std::size_t i : {(ear + left_.size() - 1) % left_.size(), ear % left_.size()}) diagonals_[i] = diagonal(i);
  }

  const std::vector<Point3>& corners_;
  std::vector<Point2> flat_;
  std::vector<std::size_t> left_;
  std::vector<double> diagonals_;  ///< per corner that is left
};

}  // namespace

std::vector<std::array<std::size_t, 3>> triangulate(const std::vector<Point3>& corners) { return Ears(corners).cut(); }

}  // namespace cutbench
