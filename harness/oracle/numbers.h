// Integers and fractions of any size: by GMP, or by Boost.Multiprecision where CUTBENCH_GMP is 0. Both give the same
// values, and so the oracle the same verdicts; Boost's are slower.
#pragma once

#if !defined(CUTBENCH_GMP) || CUTBENCH_GMP
#include <gmpxx.h>
#else
#include <boost/multiprecision/cpp_int.hpp>
#endif

namespace cutbench::oracle {

#if !defined(CUTBENCH_GMP) || CUTBENCH_GMP
using Integer = mpz_class;
using Rational = mpq_class;
#else
// Without expression templates: `auto` and intermediate results are then numbers.
using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;
using Rational =
    boost::multiprecision::number<boost::multiprecision::cpp_rational_backend, boost::multiprecision::et_off>;
#endif

/// -1 where a < b, 0 where they are equal, else 1.
template <class Number>
int order(const Number& a, const Number& b) {
  return (a > b) - (a < b);
}

/// The exponent of the lowest bit of a number that is set; 0 has none: the largest int.
int lowest_bit(double x);

/// x 2^-exponent. Precondition: that is an integer, `exponent` being at most lowest_bit(x).
Integer as_integer(double x, int exponent);

/// The double itself. Precondition: it is finite.
Rational as_rational(double x);

/// numerator / denominator 2^exponent. Precondition: the denominator is not zero.
Rational fraction(const Integer& numerator, const Integer& denominator, int exponent);

/// The double next to it on the side of zero. Precondition: it is below 2^1024.
double toward_zero(const Rational& x);

}  // namespace cutbench::oracle
