#include "harness/oracle/exact.h"

#include <limits>

#include "harness/oracle/numbers.h"

namespace cutbench::oracle {
namespace {

static_assert(std::numeric_limits<long double>::digits >= 64, "the error bound of area() needs x87 long double");

int sign(double x) { return (x > 0) - (x < 0); }

int exact_turn(const Segment& s, const Segment& t) {
  int exponent = std::numeric_limits<int>::max();
  for (const Segment& u : {s, t})
    for (const Point& p : u)
      for (const double x : p) exponent = std::min(exponent, lowest_bit(x));
  const auto along = [exponent](const Segment& u, std::size_t axis) {
    return Integer(as_integer(u[1][axis], exponent) - as_integer(u[0][axis], exponent));
  };
  return order(Integer(along(s, 0) * along(t, 1)), Integer(along(s, 1) * along(t, 0)));
}

/// Whether `difference` is a - b, not only next to it (Knuth's TwoSum).
bool is_exact(double difference, double a, double b) {
  const double b_part = a - difference, a_part = difference + b_part;
  return a - a_part == 0 && b_part - b == 0;
}

}  // namespace

int turn(const Segment& s, const Segment& t) {
  const double sx = s[1][0] - s[0][0], sy = s[1][1] - s[0][1];
  const double tx = t[1][0] - t[0][0], ty = t[1][1] - t[0][1];
  // A difference of doubles has the right sign, so this is exact.
  const int left_sign = sign(sx) * sign(ty), right_sign = sign(sy) * sign(tx);
  if (left_sign != right_sign) return left_sign > right_sign ? 1 : -1;
  if (left_sign == 0) return 0;

  // Error bound of stage A of Shewchuk, Adaptive precision floating-point arithmetic (1997). It presumes that no
  // product under- or overflows: above `tiny`, what underflow can add (2^-1074) is far below the bound.
  constexpr double unit = std::numeric_limits<double>::epsilon() / 2;
  constexpr double bound = (3 + 16 * unit) * unit;
  constexpr double tiny = 1e-280, huge = 1e300;
  const double left = sx * ty, right = sy * tx;
  const double size = std::abs(left) + std::abs(right);
  if (size > tiny && size < huge) {
    if (std::abs(left - right) > bound * size) return left > right ? 1 : -1;
    // As long as the factors are exact, so is the order of the rounded products, and behind it that of what rounding
    // left over: an fma gives it without error.
    if (is_exact(sx, s[1][0], s[0][0]) && is_exact(sy, s[1][1], s[0][1]) && is_exact(tx, t[1][0], t[0][0]) &&
        is_exact(ty, t[1][1], t[0][1]))
      return left != right ? sign(left - right) : sign(std::fma(sx, ty, -left) - std::fma(sy, tx, -right));
  }
  return exact_turn(s, t);
}

int orientation(const Point& a, const Point& b, const Point& c) { return turn({c, a}, {c, b}); }

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
