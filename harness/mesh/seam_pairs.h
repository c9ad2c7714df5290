// Edges that lie against each other on the two sides of a seam.
#pragma once

#include <algorithm>
#include <span>

#include "harness/mesh/seams.h"

namespace cutbench {

/// In lengths of a line: what a file's last digits may put a vertex beside the straight line that it is on.
constexpr double beside_line = 1e-4;

/// Of one seam, on both its sides.
inline bool share_more_than_a_point(const SewnEdge& a, const SewnEdge& b) {
  return a.first != b.first && std::min(a.high(), b.high()) - std::max(a.low(), b.low()) > seam_rounding;
}

/// Calls visit(edges of one seam) for each seam. \param edges  in order of their seams, as sewn_edges() gives them
template <class Visit>
void for_each_seam(std::span<const SewnEdge> edges, const Visit& visit) {
  for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
    while (end < edges.size() && edges[end].seam == edges[begin].seam) ++end;
    visit(edges.subspan(begin, end - begin));
  }
}

/// Calls visit(a, b) for each pair of edges of one seam, on its first and its second side, that share more than a
/// point.
template <class Visit>
void for_each_pair(std::span<const SewnEdge> edges, const Visit& visit) {
  for_each_seam(edges, [&](std::span<const SewnEdge> of_seam) {
    for (std::size_t i = 0; i < of_seam.size(); ++i)
      for (std::size_t k = i + 1; k < of_seam.size(); ++k)
        if (share_more_than_a_point(of_seam[i], of_seam[k])) visit(of_seam[i], of_seam[k]);
  });
}

}  // namespace cutbench
