#include "harness/path/blade.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

/// Exact at both ends.
Point2 between(Point2 a, Point2 b, double t) { return (1 - t) * a + t * b; }

/// De Casteljau's algorithm with a parameter of its own at each level (the blossom): from it come the control points of
/// any part of a cubic (Farin, Curves and Surfaces for CAGD, 2002, 4.4).
Point2 blossom(const Point2* p, double t, double u, double v) {
  const Point2 a = between(p[0], p[1], t), b = between(p[1], p[2], t), c = between(p[2], p[3], t);
  return between(between(a, b, u), between(b, c, u), v);
}

}  // namespace

Blade::Blade(Curve curve)
    : curve_(std::move(curve)),
      step_(curve_.kind == Curve::Kind::bezier ? 3 : 1),
      chords_(curve_.kind == Curve::Kind::bezier ? 256 : 1) {
  if (std::exchange(curve_.closed, false) && step_ == 1) curve_.points.push_back(curve_.points.front());
  double travelled = 0;
  for (std::size_t i = 0; (i + 1) * step_ < curve_.points.size(); ++i) {
    Point2 from = *piece(i);
    for (int k = 1; k <= chords_; ++k) {
      const double t = to_double(k) / chords_;
      const Point2 to = step_ == 3 ? blossom(piece(i), t, t, t) : piece(i)[1];
      ends_.push_back(travelled += std::sqrt(squared_length(to - from)));
      from = to;
    }
  }
}

Blade::Place Blade::place_at(double distance) const {
  const auto chord = to_size(std::lower_bound(ends_.begin(), ends_.end(), distance) - ends_.begin());
  const auto per_piece = to_size(chords_);
  if (chord == ends_.size()) return {ends_.size() / per_piece - 1, 1};
  const double begin = chord > 0 ? ends_[chord - 1] : 0, share = (distance - begin) / (ends_[chord] - begin);
  return {chord / per_piece, (to_double(chord % per_piece) + std::min(share, 1.0)) / chords_};
}

Curve Blade::part(double from, double to) const {
  const Place first = place_at(from), last = place_at(to);
  Curve part{curve_.kind, false, {}};
  for (std::size_t i = first.piece; i <= last.piece; ++i) {
    const double a = i == first.piece ? first.t : 0, b = i == last.piece ? last.t : 1;
    if (a >= b) continue;
    const Point2* p = piece(i);
    const auto at = [&](double t) { return step_ == 3 ? blossom(p, t, t, t) : between(p[0], p[1], t); };
    if (part.points.empty()) part.points.push_back(at(a));
    if (step_ == 3) {
      part.points.push_back(blossom(p, a, a, b));
      part.points.push_back(blossom(p, a, b, b));
    }
    part.points.push_back(at(b));
  }
  part.goes_on = to < length();
  return part;
}

}  // namespace cutbench
