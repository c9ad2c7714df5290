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
//
// After a cut the nodes round what changed are divided again, and nothing else is. What comes out as it was is not
// passed on to the next level.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/base/points.h"
#include "harness/base/union_find.h"
#include "harness/fem/algebra/row_sum.h"
#include "harness/fem/multigrid/level_rows.h"

namespace cutbench {

class Coarsening {
 public:
  /// A fine unknown and a coarse one, and how much of the coarse value it gets. Equal where `other` is.
  struct Weight {
    std::int32_t other;
    float weight;
    bool operator==(const Weight& with) const { return other == with.other; }
  };
  /// Fine unknowns that move together become a coarse unknown, too, with the weight 1. Its place is not finite.
  struct Regrouping {
    std::vector<std::int32_t> members;              ///< the groups that they were in end
    std::vector<std::vector<std::int32_t>> groups;  ///< new ones, of some of these members
  };

  /// \param spacing  of the lattice, rest units
  explicit Coarsening(double spacing) : spacing_(spacing) {}

  /// \param fine     rows of the fine level, symmetric; an empty row belongs to no unknown. Unknowns that share a block
  ///                 are linked
  /// \param places   of the fine unknowns, rest units; one whose place is not finite is in no hat's support
  /// \param changes  since the last call; at the first call, all
  void update(const FineRows& fine, const std::vector<Point2>& places, const RowChanges& changes,
              const Regrouping& regrouping = {});
  /// Gives the coarse unknowns the rows of P^T A P, with the values of the scalars, where the last update() or the fine
  /// rows may have changed them.
  void multiply(const FineRows& fine, LevelRows& coarse);
  /// Of the coarse rows, by the last multiply().
  const RowChanges& changes() const { return changes_; }
  /// Room for half as many unknowns again, before anything has to be copied.
  void reserve_spare();

  std::size_t fine_size() const { return parents_.size(); }
  std::size_t coarse_size() const { return places_.size(); }  ///< with numbers that are free
  const std::vector<Point2>& coarse_places() const { return places_; }
  /// The coarse unknowns of a fine one: those of hats, none or up to three whose weights add up to 1, and of its group.
  std::span<const Weight> parents(std::size_t fine) const { return parents_[fine]; }
  /// The fine unknowns of a coarse one, with its hat's values there. None: the number is free.
  std::span<const Weight> members(std::size_t coarse) const { return members_[coarse]; }
  /// The coarse unknown of the group of a fine one; -1 where it is in none.
  std::int32_t group_of(std::size_t fine) const;

 private:
  using Node = std::int64_t;
  struct Entry {
    Node node;
    std::int32_t fine;
    float weight;
  };
  /// A set of numbers that is emptied at no cost.
  class Marks {
   public:
    void clear(std::size_t size) {
      marked_in_.resize(size);
      ++round_;
    }
    void grow(std::size_t size) { marked_in_.resize(size); }
    bool holds(std::int32_t i) const { return marked_in_[to_size(i)] == round_; }
    /// True if it was not there.
    bool insert(std::int32_t i) {
      auto& mark = marked_in_[to_size(i)];
      return mark != round_ && (mark = round_, true);
    }

   private:
    std::vector<std::uint32_t> marked_in_;
    std::uint32_t round_ = 0;
  };

  void begin(std::size_t fine_size);
  void regroup(const Regrouping& regrouping);
  void place(std::int32_t fine, std::span<const Entry> hats);
  /// The hats that are not zero there: those of the corners of its lattice triangle. Valid until the next call.
  std::span<const Entry> hats(std::int32_t fine, Point2 place);
  void find_members();
  void divide(const FineRows& fine, std::span<const Entry> members);
  void name_parts(std::span<const Entry> members);
  void free_parts(Node node);
  std::int32_t part_of(std::int32_t fine, Node node) const;
  std::int32_t new_coarse(Node node);
  void free_coarse(std::int32_t coarse);
  void find_touched(const FineRows& fine, const RowChanges& changes);
  void touch(std::int32_t coarse);         // its scalars
  void touch_blocks(std::int32_t coarse);  // and its blocks
  void touch_parents(std::int32_t fine);
  void touch_blocks_of_parents(std::int32_t fine);
  bool multiply_blocks(const SweepRows& fine, std::size_t coarse, SweepRows& rows);  // true: it has changed
  bool multiply_scalars(const FineRows& fine, std::size_t coarse, LevelRows& rows);
  void multiply_part_row();

  double spacing_;
  GrowingRows<Weight> parents_, members_;
  std::vector<Point2> places_;           // per coarse unknown
  std::vector<Node> node_;               // per coarse unknown, or that of groups
  std::vector<std::int32_t> next_part_;  // per coarse unknown: the next one of the same node, or -1
  std::unordered_map<Node, std::int32_t> first_part_;
  std::vector<std::int32_t> free_;
  RowChanges changes_;

  // Working storage of update().
  Marks is_placed_, has_new_parents_, is_listed_, is_listed_for_blocks_;  // of fine unknowns
  Marks is_named_, is_renumbered_, is_touched_, has_touched_blocks_;      // of coarse ones
  std::vector<Node> nodes_;                                               // to be divided again
  std::vector<Entry> hats_;
  std::vector<std::int32_t> with_new_parents_;
  std::vector<std::int32_t> touched_;        // coarse unknowns whose rows may have changed
  std::vector<Entry> entries_;               // the members of those nodes
  std::vector<std::int32_t> place_in_node_;  // per fine unknown: its place among the members at hand, or -1
  std::vector<std::int32_t> part_;           // per member at hand: its coarse unknown
  std::vector<std::int32_t> old_parts_;      // of the node at hand
  std::vector<Weight> part_members_;
  UnionFind joined_;
  // Working storage of multiply().
  RowSum<double> part_row_{0}, row_{0};  // of P^T A and of P^T A P
};

}  // namespace cutbench
