#include "harness/measure/exact.h"

#include <gmpxx.h>

#include <limits>

namespace cutbench::oracle {
namespace {

static_assert(std::numeric_limits<long double>::digits >= 64, "the error bound of area() needs x87 long double");

int exact_orientation(const Point& a, const Point& b, const Point& c) {
  const mpq_class cx(c[0]), cy(c[1]);
  const mpq_class left = (mpq_class(a[0]) - cx) * (mpq_class(b[1]) - cy);
  const mpq_class right = (mpq_class(a[1]) - cy) * (mpq_class(b[0]) - cx);
  return cmp(left, right) > 0 ? 1 : cmp(left, right) < 0 ? -1 : 0;
}

}  // namespace

int orientation(const Point& a, const Point& b, const Point& c) {
  // Error bound of stage A of Shewchuk, Adaptive precision floating-point arithmetic (1997). It presumes that no
  // product under- or overflows: above `tiny`, what underflow can add (2^-1074) is far below the bound.
  constexpr double unit = std::numeric_limits<double>::epsilon() / 2;
  constexpr double bound = (3 + 16 * unit) * unit;
  constexpr double tiny = 1e-280, huge = 1e300;
  const double left = (a[0] - c[0]) * (b[1] - c[1]);
  const double right = (a[1] - c[1]) * (b[0] - c[0]);
  const double determinant = left - right;
  const double size = std::abs(left) + std::abs(right);
  if (size > tiny && size < huge && std::abs(determinant) > bound * size) return determinant > 0 ? 1 : -1;
  return exact_orientation(a, b, c);
}

long double area(const Mesh& mesh) {
  long double twice = 0;
  for (const auto& [i, j, k] : mesh.triangles) {
    const Point &a = mesh.rest[i], &b = mesh.rest[j], &c = mesh.rest[k];
    const long double ux = (long double)b[0] - a[0], uy = (long double)b[1] - a[1];
    const long double vx = (long double)c[0] - a[0], vy = (long double)c[1] - a[1];
    twice += ux * vy - uy * vx;
  }
  return twice / 2;
}

}  // namespace cutbench::oracle
