// Indices. Every index is its own type, so that a triangle can't be used where a vertex is meant.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>

#include "harness/base/conversions.h"
#include "harness/base/points.h"

namespace cutbench {

/// A 32-bit index into one particular array; negative means "none".
template <class Tag>
struct Index {
  std::int32_t value = -1;

  constexpr Index() = default;
  constexpr explicit Index(std::size_t i) : value(to_int32(i)) {}
  constexpr bool valid() const { return value >= 0; }
  constexpr std::size_t operator()() const { return to_size(value); }
  constexpr auto operator<=>(const Index&) const = default;
};

using VertexIndex = Index<struct VertexTag>;      ///< vertex of the (welded) rest mesh
using DeformedIndex = Index<struct DeformedTag>;  ///< vertex of the opened, deformed sheet
using TriangleIndex = Index<struct TriangleTag>;  ///< slot in the triangle array

/// Half-edge k of triangle t runs from corner k to corner k+1 (mod 3), counter-clockwise. It is 4 t + k: both parts
/// come back with a shift and a mask, and every fourth number is unused.
using HalfEdge = Index<struct HalfEdgeTag>;

constexpr HalfEdge half_edge(TriangleIndex t, int k) { return HalfEdge(4 * t() + to_size(k)); }
constexpr TriangleIndex triangle_of(HalfEdge h) { return TriangleIndex(h() >> 2); }
constexpr int corner_of(HalfEdge h) { return to_int(h() & 3); }
constexpr int next_corner(int k) { return k == 2 ? 0 : k + 1; }
constexpr int previous_corner(int k) { return k == 0 ? 2 : k - 1; }

}  // namespace cutbench
