#include "harness/oracle/numbers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "harness/oracle/conversions.h"

namespace cutbench::oracle {

int lowest_bit(double x) {
  if (x == 0) return std::numeric_limits<int>::max();
  int exponent = 0;
  const auto digits = to_int64(std::ldexp(std::frexp(std::abs(x), &exponent), 53));
  return exponent - 53 + std::countr_zero(static_cast<std::uint64_t>(digits));
}

Integer as_integer(double x, int exponent) {
  if (x == 0) return 0;
  const int low = lowest_bit(x);
  Integer result(std::ldexp(x, -low));
  result <<= static_cast<unsigned long>(low - exponent);
  return result;
}

#if !defined(CUTBENCH_GMP) || CUTBENCH_GMP

Rational as_rational(double x) { return Rational(x); }

Rational fraction(const Integer& numerator, const Integer& denominator, int exponent) {
  Rational q(numerator, denominator);
  q.canonicalize();
  if (exponent < 0)
    q >>= static_cast<mp_bitcnt_t>(-exponent);
  else
    q <<= static_cast<mp_bitcnt_t>(exponent);
  return q;
}

double toward_zero(const Rational& x) { return x.get_d(); }

#else

Rational as_rational(double x) {
  if (x == 0) return 0;
  const int low = lowest_bit(x);
  return fraction(as_integer(x, low), 1, low);
}

Rational fraction(const Integer& numerator, const Integer& denominator, int exponent) {
  if (denominator < 0) return fraction(-numerator, -denominator, exponent);  // Boost 1.74 refuses these, of any size
  if (exponent < 0) return Rational(numerator, denominator << static_cast<unsigned long>(-exponent));
  return Rational(numerator << static_cast<unsigned long>(exponent), denominator);
}

double toward_zero(const Rational& x) {
  if (x == 0) return 0;
  const Integer above = abs(numerator(x)), below = denominator(x);
  // Shifted so that the quotient has 54 or 55 bits, less where the double is subnormal.
  const int shift = std::min(54 + to_int(msb(below)) - to_int(msb(above)), 1074);
  const Integer quotient = shift >= 0 ? Integer((above << static_cast<unsigned long>(shift)) / below)
                                      : Integer(above / (below << static_cast<unsigned long>(-shift)));
  auto digits = quotient.convert_to<std::uint64_t>();
  const int excess = std::max(0, to_int(std::bit_width(digits)) - 53);
  digits >>= excess;
  const double size = std::ldexp(to_double(digits), excess - shift);
  return x < 0 && size > 0 ? -size : size;  // no negative zero, as GMP
}

#endif

}  // namespace cutbench::oracle
