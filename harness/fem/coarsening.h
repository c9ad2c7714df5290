// One step of a multigrid hierarchy that knows where the sheet is cut: from the unknowns of one level to those of the
// next coarser one.
//
// The nodes of a lattice of equilateral triangles lie over the rest space. Each has the piecewise linear hat function,
// which is 1 at the node and 0 at its six neighbours. A node's members are the unknowns in the support of its hat. They
// are divided into the parts that links between members connect, and each part is a coarse unknown of its own. So the
// two sides of an incision get their own coarse unknowns, a tip joins them where the support reaches round it, and
// pieces are apart. An unknown is interpolated from the parts that it belongs to, with the hats as weights.
//
// The same step is made again on the coarse unknowns: their places are the nodes, their links the coarse matrix.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "harness/base/points.h"
#include "harness/base/union_find.h"

namespace cutbench {

/// Rows of column numbers: first those below the row's own, then its own, then those above.
struct SparseRows {
  std::vector<std::int32_t> begin{0}, column;
  std::size_t size() const { return begin.size() - 1; }
  std::span<const std::int32_t> operator[](std::size_t i) const {
    return {column.data() + begin[i], static_cast<std::size_t>(begin[i + 1] - begin[i])};
  }
  void clear() { begin.assign(1, 0), column.clear(); }
  void end_row() { begin.push_back(static_cast<std::int32_t>(column.size())); }
  /// Adds a row with these columns, each once. `order` gets, for each entry of the row, its place among `columns`.
  void add_row(std::span<const std::int32_t> columns, std::vector<std::int32_t>& order);
};

class Coarsening {
 public:
  /// A fine unknown and a coarse one, and how much of the coarse value it gets.
  struct Weight {
    std::int32_t other;
    float weight;
  };

  /// \param links    of the fine unknowns, symmetric; an empty row belongs to no unknown
  /// \param places   of the fine unknowns, rest units; an unknown whose place is not finite is in no hat's support
  /// \param spacing  of the lattice
  /// \param groups   rows of fine unknowns that move together: each becomes a coarse unknown, too, with the weight 1.
  ///                 Its place is not finite
  void build(const SparseRows& links, const std::vector<Point2>& places, double spacing, const SparseRows& groups);
  /// The pattern of P^T A P for a matrix A with these rows.
  void coarse_pattern(const SparseRows& fine, SparseRows& coarse);
  /// P^T A P for scalars: `values` are those of the fine entries, and `product` gets those of the coarse ones.
  void multiply(const SparseRows& fine, const std::vector<double>& values, SparseRows& coarse,
                std::vector<double>& product);

  std::size_t fine_size() const { return parent_begin_.size() - 1; }
  std::size_t coarse_size() const { return places_.size(); }
  const std::vector<Point2>& coarse_places() const { return places_; }
  /// The coarse unknowns of a fine one: those of hats, none or up to three whose weights add up to 1, and of its group.
  std::span<const Weight> parents(std::size_t fine) const { return row(parent_begin_, parents_, fine); }
  /// The fine unknowns of a coarse one, with its hat's values there.
  std::span<const Weight> members(std::size_t coarse) const { return row(member_begin_, members_, coarse); }

 private:
  struct Entry {
    std::int64_t node;
    std::int32_t fine;
    float weight;
  };
  static std::span<const Weight> row(const std::vector<std::int32_t>& begin, const std::vector<Weight>& all,
                                     std::size_t i) {
    return {all.data() + begin[i], static_cast<std::size_t>(begin[i + 1] - begin[i])};
  }
  void enter(const SparseRows& links, const std::vector<Point2>& places, double spacing);
  template <class Add>
  void coarse_rows(const SparseRows& fine, SparseRows& coarse, const Add& add);
  void divide(const SparseRows& links, std::span<const Entry> members, Point2 place);

  std::vector<std::int32_t> parent_begin_{0}, member_begin_{0};
  std::vector<Weight> parents_, members_;
  std::vector<Point2> places_;
  // Working storage of build().
  std::vector<Entry> entries_;
  std::vector<std::int32_t> in_group_;  // per fine unknown: its place among the members at hand, or -1
  std::vector<std::int32_t> part_;      // per member at hand: its coarse unknown
  std::vector<std::int32_t> place_;     // per coarse unknown: its place in the row at hand, or -1
  std::vector<std::int32_t> columns_, order_;
  std::vector<double> sums_;
  UnionFind joined_;
};

}  // namespace cutbench
