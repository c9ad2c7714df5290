// A program of somebody else's, run once, within limits.
#pragma once

#include <filesystem>
#include <string>

namespace cutbench {

struct ProgramLimits {
  double time_s = 60;       ///< by the clock; the program and all that it started are ended then
  double memory_mb = 4096;  ///< data of each of its processes (RLIMIT_DATA), address space that is only reserved apart
};

struct ProgramEnd {
  enum class How { exited, signalled, timed_out };
  How how = How::exited;
  int code = 0;         ///< exit code, or number of the signal
  double us = 0;        ///< from its start to its end, steady clock
  std::string message;  ///< the last line that it wrote to standard error; may be empty

  bool succeeded() const { return how == How::exited && code == 0; }
  /// One line: how it ended, and what it said last.
  std::string text() const;
};

/// Runs `command` by /bin/sh in `folder` and waits for its end. What it writes to standard output is discarded.
/// Throws std::runtime_error where no process can be started.
ProgramEnd run_program(const std::string& command, const std::filesystem::path& folder, const ProgramLimits& limits);

/// As one word for the shell.
std::string quoted(const std::string& word);

/// A folder for files that is gone, with them, at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();  ///< throws std::runtime_error
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace cutbench
