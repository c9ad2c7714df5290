#include "harness/fem/elements/slope_patch.h"

#include <algorithm>
#include <cmath>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

// Smallest singular value of the quadratic part over the size of its columns. Below the first the patch widens; where
// it can't, below the second that part of the Hessian is taken to be zero.
constexpr double good_fit = 0.02, some_fit = 1e-3;

// A column that is less than this part of the quadratic ones, once the columns before it are taken out, is zero.
constexpr double round_off = 1e-14;

// Columns that keep this part are orthogonal to 1e-14 after one pass.
constexpr double enough_left = 0.01;

}  // namespace

void SlopePatch::add(DeformedIndex d, Point2 offset) {
  if (offset_.size() == max_points) return;
  for (const StencilTerm& term : terms_)
    if (term.vertex == d.value) return;
  terms_.push_back({d.value, {}});
  offset_.push_back(offset);
}

void SlopePatch::begin(const Sheet& sheet, TriangleIndex t) {
  terms_.clear();
  offset_.clear();
  windows_.clear();
  const auto c = sheet.corners(t);
  centre_ = 1.0 / 3 * (c[0] + c[1] + c[2]);
  for (std::size_t k = 0; k < 3; ++k) {
    add(sheet.triangle(t).deformed[k], c[k] - centre_);
    windows_.push_back({half_edge(t, to_int(k)), c[k] - centre_, c[(k + 1) % 3] - centre_});
  }
  own_ = 3;
}

/// \param members  sorted
void SlopePatch::begin(const Sheet& sheet, const ElementShape& compound, std::span<const TriangleIndex> members) {
  terms_.clear();
  offset_.clear();
  windows_.clear();
  const auto corners = compound.corners;
  centre_ = sheet.rest(sheet.rest_vertex(corners[0])) - compound.offset[0];
  for (std::size_t i = 0; i < corners.size(); ++i) add(corners[i], compound.offset[i]);
  own_ = offset_.size();
  const auto belongs = [&](TriangleIndex t) { return std::binary_search(members.begin(), members.end(), t); };
  for (const TriangleIndex t : members)
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(t, k);
      if (sheet.separates(h) || belongs(triangle_of(sheet.opposite(h)))) continue;
      const Point2 right = sheet.rest(sheet.origin(h)) - centre_, left = sheet.rest(sheet.target(h)) - centre_;
      if (cross(right, left) > 0) windows_.push_back({h, right, left});
    }
}

/// Takes in the triangles behind the windows; false where there is none.
bool SlopePatch::widen(const Sheet& sheet, const ElementTable* elements, bool first) {
  next_windows_.clear();
  bool any = false;
  for (const auto& [edge, right, left] : windows_) {
    if (sheet.on_border(edge) || sheet.mark(edge) == EdgeMark::incision) continue;
    any = true;
    const HalfEdge from_left = sheet.opposite(edge), from_right = Sheet::next(from_left),
                   from_far = Sheet::previous(from_left);
    const Point2 far = sheet.rest(sheet.origin(from_far)) - centre_;
    const bool left_of_right = cross(right, far) > 0, right_of_left = cross(far, left) > 0;
    const bool seen = left_of_right && right_of_left;
    const DeformedIndex vertex = sheet.triangle(triangle_of(from_far)).deformed[to_size(corner_of(from_far))];
    const bool is_unknown = !elements || !elements->is_inside(triangle_of(from_far), vertex);
    if ((seen || first) && is_unknown) add(vertex, far);
    if (left_of_right) next_windows_.push_back({from_right, right, seen ? far : left});
    if (right_of_left) next_windows_.push_back({from_far, seen ? far : right, left});
  }
  windows_.swap(next_windows_);
  return any;
}

/// Gram and Schmidt, twice where a column loses digits in the first pass. The linear columns come first, so that linear
/// functions come out exact whatever is left out of the quadratic ones.
void SlopePatch::factorise() {
  const std::size_t n = offset_.size();
  double sum = 0, corners = 0;
  for (std::size_t i = 0; i < n; ++i) {
    sum += squared_length(offset_[i]);
    if (i + 1 == own_) corners = sum / to_double(own_);
  }
  scale_ = std::sqrt(sum / to_double(n));
  reference_ = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Point2 p = 1 / scale_ * offset_[i];
    // Near points count more, by the square of their distance: then a quadratic weighs alike at all distances.
    const double w = weight_[i] = scale_ * scale_ / (squared_length(offset_[i]) + corners);
    orthogonal_[i] = {w, w * p.x, w * p.y, w * p.x * p.x / 2, w * p.x * p.y * M_SQRT1_2, w * p.y * p.y / 2, 0, 0};
    for (std::size_t j = 3; j < 6; ++j) reference_ += orthogonal_[i][j] * orthogonal_[i][j];
  }
  reference_ = std::sqrt(reference_);
  for (int pass = 0; pass < 2; ++pass) {
    std::array<Row, 6> upper{};
    bool keeps_digits = true;
    for (std::size_t j = 0; j < 6; ++j) {
      Row products{};  // of column j with all
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < 8; ++k) products[k] += orthogonal_[i][j] * orthogonal_[i][k];
      const double length = std::sqrt(products[j]), inverse = length > round_off * reference_ ? 1 / length : 0;
      for (std::size_t k = j + 1; k < 6; ++k) upper[j][k] = inverse * products[k];
      upper[j][j] = pass == 1 && inverse == 0 ? 1 : length;
      keeps_digits &= length > enough_left * reference_;
      for (std::size_t i = 0; i < n; ++i) {
        const double q = orthogonal_[i][j] *= inverse;
        for (std::size_t k = j + 1; k < 6; ++k) orthogonal_[i][k] -= q * upper[j][k];
      }
    }
    if (pass == 0) {
      upper_ = upper;
      if (keeps_digits) return;
      continue;
    }
    // What is left of the first pass was upper x orthogonal.
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t k = 6; k-- > i;) {
        double entry = 0;
        for (std::size_t j = i; j <= k; ++j) entry += upper[i][j] * upper_[j][k];
        upper_[i][k] = entry;
      }
  }
}

/// Inverts the quadratic part, if it is far enough from singular: its smallest
/// singular value is within 1 and sqrt(3) times 1 / |inverse|.
bool SlopePatch::tells_quadratics() {
  const auto& r = upper_;
  if (terms_.size() < 6 || !(std::min({r[3][3], r[4][4], r[5][5]}) > good_fit * reference_)) return false;
  const double a = 1 / r[3][3], b = 1 / r[4][4], c = 1 / r[5][5];
  inverse_ << a, -a * b * r[3][4], a * b * c * (r[3][4] * r[4][5] - r[3][5] * r[4][4]), 0, b, -b * c * r[4][5], 0, 0, c;
  return inverse_.norm() * good_fit * reference_ < 1;
}

/// Pseudo-inverse of the quadratic part, by one-sided Jacobi rotations (Hestenes 1958).
void SlopePatch::invert_what_is_known() {
  Eigen::Matrix3d a = Eigen::Matrix3d::Zero(), turn = Eigen::Matrix3d::Identity();
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = i; j < 3; ++j) a(to_int(i), to_int(j)) = upper_[3 + i][3 + j];
  bool done = false;
  for (int sweep = 0; sweep < 12 && !done; ++sweep) {
    done = true;
    for (int p = 0; p < 2; ++p)
      for (int q = p + 1; q < 3; ++q) {
        const double pp = a.col(p).squaredNorm(), qq = a.col(q).squaredNorm(), pq = a.col(p).dot(a.col(q));
        if (!(std::abs(pq) > 1e-15 * std::sqrt(pp * qq))) continue;
        done = false;
        const double z = (qq - pp) / (2 * pq), t = std::copysign(1 / (std::abs(z) + std::sqrt(1 + z * z)), z);
        const double c = 1 / std::sqrt(1 + t * t), s = c * t;
        Eigen::Matrix2d rotation;
        rotation << c, s, -s, c;
        for (Eigen::Matrix3d* m : {&a, &turn}) {
          Eigen::Matrix<double, 3, 2> pair;
          pair << m->col(p), m->col(q);
          pair = (pair * rotation).eval();
          m->col(p) = pair.col(0);
          m->col(q) = pair.col(1);
        }
      }
  }
  inverse_.setZero();
  for (int j = 0; j < 3; ++j)
    if (const double s = a.col(j).norm(); s > some_fit * reference_)
      inverse_ += turn.col(j) * a.col(j).transpose() / (s * s);
}

std::span<const StencilTerm> SlopePatch::terms(const std::array<Point2, 3>& corners) {
  std::array<std::array<double, 6>, 3> row;  // of the slope at side k, over the orthogonal columns
  for (std::size_t k = 0; k < 3; ++k) {
    const Point2 a = corners[k] - centre_, b = corners[(k + 1) % 3] - centre_, side = b - a;
    const Point2 n = 1 / (scale_ * std::sqrt(squared_length(side))) * Point2{-side.y, side.x};
    const Point2 m = 0.5 / scale_ * (a + b);
    const auto& r = upper_;
    auto& y = row[k];
    const auto over = [&](double value, double pivot) { return pivot > round_off * reference_ ? value / pivot : 0; };
    y[0] = 0;
    y[1] = over(n.x, r[1][1]);
    y[2] = over(n.y - r[1][2] * y[1], r[2][2]);
    Eigen::Vector3d quadratic(n.x * m.x, (n.x * m.y + n.y * m.x) * M_SQRT1_2, n.y * m.y);
    for (int j = 0; j < 3; ++j) {
      const auto column = to_size(3 + j);
      quadratic[j] -= r[1][column] * y[1] + r[2][column] * y[2];
    }
    quadratic = inverse_.transpose() * quadratic;
    y[3] = quadratic[0];
    y[4] = quadratic[1];
    y[5] = quadratic[2];
  }
  for (std::size_t i = 0; i < terms_.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      double sum = 0;
      for (std::size_t j = 1; j < 6; ++j) sum += row[k][j] * orthogonal_[i][j];
      terms_[i].factor[k] = weight_[i] * sum;
    }
  return terms_;
}

int SlopePatch::fit(const Sheet& sheet, const ElementTable* elements, TriangleIndex t) {
  if (elements && (*elements)[t()].is_member())
    begin(sheet, elements->shape(t), elements->members(t));
  else
    begin(sheet, t);
  int reach = 1;
  for (bool more = widen(sheet, elements, true);; more = widen(sheet, elements, false), ++reach) {
    const bool last = !more || reach == max_reach;
    if (!last && terms_.size() < 6) continue;
    factorise();
    if (tells_quadratics()) break;
    if (!last) continue;
    invert_what_is_known();
    break;
  }
  return reach;
}

}  // namespace cutbench
