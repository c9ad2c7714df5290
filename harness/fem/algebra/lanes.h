// Numbers of four elements side by side, so that one instruction computes four elements. What is written for any Number
// with operators and `a > b ? c : d` serves for one element (double) and for four.
#pragma once

#include <array>
#include <cmath>
#include <cstring>

#ifdef __AVX__
#include <immintrin.h>
#endif

// Lanes passed by value are a matter between functions of one build. Who includes this without -mavx is not warned.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace cutbench {

/// A vector type of g++ and clang: all operators act lane by lane, comparisons give masks.
using Lanes = double __attribute__((vector_size(32)));
constexpr std::size_t lane_count = 4;

inline double square_root(double x) { return std::sqrt(x); }
inline Lanes square_root(Lanes x) {
#ifdef __AVX__
  return reinterpret_cast<Lanes>(_mm256_sqrt_pd(reinterpret_cast<__m256d>(x)));
#else
  return Lanes{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
#endif
}

/// Four doubles anywhere in memory.
inline Lanes load(const double* from) {
  Lanes x;
  std::memcpy(&x, from, sizeof x);
  return x;
}
inline void store(Lanes x, double* to) { std::memcpy(to, &x, sizeof x); }

/// Lane l of result k is lane k of row l.
inline std::array<Lanes, 4> transposed(Lanes a, Lanes b, Lanes c, Lanes d) {
  const Lanes ab02 = __builtin_shufflevector(a, b, 0, 4, 2, 6), ab13 = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Lanes cd02 = __builtin_shufflevector(c, d, 0, 4, 2, 6), cd13 = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  return {__builtin_shufflevector(ab02, cd02, 0, 1, 4, 5), __builtin_shufflevector(ab13, cd13, 0, 1, 4, 5),
          __builtin_shufflevector(ab02, cd02, 2, 3, 6, 7), __builtin_shufflevector(ab13, cd13, 2, 3, 6, 7)};
}

/// Vectors of Numbers.
template <class Number>
struct Vector2 {
  Number x, y;
};
template <class Number, std::size_t D>
Number dot(const std::array<Number, D>& a, const std::array<Number, D>& b) {
  if constexpr (D == 2)
    return a[0] * b[0] + a[1] * b[1];
  else
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <class Number>
std::array<Number, 3> cross(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace cutbench
