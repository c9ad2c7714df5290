#include "harness/oracle/clip.h"

#include <utility>

#include "harness/oracle/numbers.h"

namespace cutbench::oracle {
namespace {

struct Box {
  Point low, high;
};

bool holds(const Box& box, const Point& p) {
  return box.low[0] <= p[0] && p[0] <= box.high[0] && box.low[1] <= p[1] && p[1] <= box.high[1];
}

/// Exact, then rounded once.
Point at(const Segment& s, const Rational& t) {
  Point p;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const Rational a = as_rational(s[0][axis]), b = as_rational(s[1][axis]);
    p[axis] = toward_zero(a + t * (b - a));
  }
  return p;
}

}  // namespace

std::optional<Segment> clip(const Segment& s, const Point& low, const Point& high) {
  const Box box{low, high};
  if (holds(box, s[0]) && holds(box, s[1])) return s;
  Rational first = 0, last = 1;  // Liang and Barsky, 1984
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const Rational from = as_rational(s[0][axis]), along = as_rational(s[1][axis]) - from;
    if (along == 0) {
      if (s[0][axis] < low[axis] || s[0][axis] > high[axis]) return {};
      continue;
    }
    Rational in = (as_rational(low[axis]) - from) / along, out = (as_rational(high[axis]) - from) / along;
    if (in > out) std::swap(in, out);
    if (in > first) first = in;
    if (out < last) last = out;
  }
  if (first >= last) return {};
  return Segment{first == 0 ? s[0] : at(s, first), last == 1 ? s[1] : at(s, last)};
}

std::vector<Segment> near_mesh(const std::vector<Segment>& path, const Mesh& mesh) {
  Point low = mesh.rest.front(), high = low;
  for (const Point& p : mesh.rest)
    for (std::size_t axis = 0; axis < 2; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  const double margin = high[0] - low[0] + high[1] - low[1];
  for (std::size_t axis = 0; axis < 2; ++axis) {
    low[axis] -= margin;
    high[axis] += margin;
  }
  std::vector<Segment> near;
  for (const Segment& s : path)
    if (const auto part = clip(s, low, high)) near.push_back(*part);
  return near;
}

}  // namespace cutbench::oracle
