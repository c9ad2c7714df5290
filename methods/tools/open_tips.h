// The tip rule of phantom_node.h, or none: which parts are slit, and which copies on the two sides of an incision have
// nothing in common where it enters a slit part, so that it opens up to its tip.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "methods/tools/parts.h"

namespace cutbench {

class OpenTips {
 public:
  enum class Rule : std::uint8_t {
    open,
    open_for_lumped_mass,  ///< a lip must not be stiff for the mass that its copies have then, either
    closed                 ///< no part is slit: where an incision enters its last triangle, it ends
  };
  /// \param parts  must outlive this
  OpenTips(const Parts& parts, Rule rule);

  /// An incision ends in the part of i, which lies on both sides of it.
  bool is_slit(std::size_t i) const { return slit_[parts_.part(i)] != 0; }
  /// The joint across h, of two parents, does not join the copies of `end`, an end of their edge.
  bool are_apart(HalfEdge h, VertexIndex end) const;

 private:
  struct Piece;
  void find_slit_parts();
  void open_edge(std::span<Piece> pieces);
  bool is_soft(const Piece& p, DeformedIndex d, double weight) const;
  double share_of_parent(std::size_t i) const;
  bool touch(HalfEdge a, HalfEdge b) const;
  DeformedIndex deformed_origin(HalfEdge h) const;

  const Parts& parts_;
  const Rule rule_;
  std::vector<std::uint8_t> slit_;  // per part, at its first triangle
  std::vector<std::size_t> in_slit_parts_;
  std::vector<std::pair<HalfEdge, VertexIndex>> apart_;
};

}  // namespace cutbench
