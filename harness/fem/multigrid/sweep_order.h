// In which order the rows of a level are swept. Small levels: by their numbers. Large ones, so that threads can share a
// sweep: in bands of neighbouring numbers, first every other band, then those between, then what belongs to no band.
// No row of a band is coupled to one of another band of the same turn; within a band rows follow by number. The order
// depends on the rows alone, not on the number of threads, so neither do the results.
//
// A row that a cut makes, or couples to another band, joins a band that suits its neighbours.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/fem/multigrid/swept_scalars.h"

namespace cutbench {

class SweepOrder {
 public:
  /// \param fewest_in_bands  rows; smaller levels are swept by number
  explicit SweepOrder(std::size_t fewest_in_bands = 1000) : fewest_in_bands_(fewest_in_bands) {}

  /// Orders all rows anew.
  void follow(const LevelRows& rows, const SweptScalars& swept);
  /// After these rows have changed. \return  them, and those whose neighbours come in another order now; valid until
  ///                                          the next call
  std::span<const std::int32_t> follow(const LevelRows& rows, const SweptScalars& swept,
                                       std::span<const std::int32_t> changed);
  bool is_before(std::int32_t i, std::int32_t j) const { return rank_[to_size(i)] < rank_[to_size(j)]; }
  using Rows = std::vector<std::int32_t>;
  /// Bands that are swept at the same time: in the first turn (0) or the second (1).
  std::span<const Rows> bands(std::size_t turn) const { return bands_[turn]; }
  const Rows& rest() const { return rest_; }  ///< swept last, one after the other

 private:
  static constexpr std::int32_t none = -1;
  template <class Visit>
  void for_each_coupled(const LevelRows& rows, const SweptScalars& swept, std::size_t i, const Visit& visit) const;
  bool make_bands(const LevelRows& rows, const SweptScalars& swept, std::size_t bands);
  std::int32_t band_for(const LevelRows& rows, const SweptScalars& swept, std::size_t i) const;
  bool suits(const LevelRows& rows, const SweptScalars& swept, std::size_t i) const;
  Rows& rows_of(std::int32_t band) { return band == none ? rest_ : bands_[to_size(band % 2)][to_size(band / 2)]; }
  void put(std::size_t i, std::int32_t band);

  std::size_t fewest_in_bands_;
  std::vector<std::int32_t> band_;   // per row; even ones in the first turn, or none
  std::vector<std::uint64_t> rank_;  // per row: rows of a lower one come first
  std::array<std::vector<Rows>, 2> bands_;
  Rows rest_;
  Rows to_pack_;                         // working storage of follow()
  std::vector<std::uint8_t> is_listed_;  // likewise, per row
};

}  // namespace cutbench
