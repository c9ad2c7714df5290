// The two errors a user meets, in one line each; any other exception is a fault of the program.
#pragma once

#include <stdexcept>
#include <string>

namespace cutbench {

/// What is wrong with a file, option or number the user gave: what is wrong, where, and what to do.
struct InputError : std::runtime_error {
  explicit InputError(const std::string& what);
};

/// What could not be written, and why: the disk is full, the folder is gone.
struct OutputError : std::runtime_error {
  explicit OutputError(const std::string& what);
};

}  // namespace cutbench
