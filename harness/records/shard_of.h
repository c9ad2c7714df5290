// How the work of a run is divided among its shards: whoever runs a shard and whoever merges them must agree on it.
#pragma once

#include <cstddef>

namespace cutbench {

/// The shard, from 0, of a work item; items are numbered from 0 through the whole run. Each turn of `shards` items has
/// one for each. The next turn begins with another one, so that what recurs with the number of shards, be it a dear
/// resolution or method, is not the same one's each time.
constexpr std::size_t shard_of(std::size_t item, std::size_t shards) { return (item + item / shards) % shards; }

}  // namespace cutbench
