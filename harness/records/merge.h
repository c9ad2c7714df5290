// The shards of one run (cutbench run --shard i/N), put together.
#pragma once

#include <filesystem>
#include <vector>

namespace cutbench {

/// Writes records.csv and context.json as a run without shards has them, times apart; and what is in failing/ of any
/// shard. \param shards  folders that hold these two files each, in any order
/// Throws InputError naming the folder: unfinished, cut short, of another run (program, machine, experiment or seed),
/// there twice; or naming the shards that are missing.
void merge_shards(const std::vector<std::filesystem::path>& shards, const std::filesystem::path& out);

/// The numbers, from 1 to `of`, of the shards that are not among these folders, where each is whole. Folders that are
/// not there, unfinished or cut short count as missing. Throws InputError for those of another run than the others.
std::vector<int> missing_shards(const std::vector<std::filesystem::path>& shards, int of);

}  // namespace cutbench
