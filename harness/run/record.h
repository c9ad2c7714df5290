// Records on disk: results/<stem>/records.csv, one row per measurement, and context.json beside it.
#pragma once

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "harness/run/context.h"

namespace cutbench {

/// A row: the fields in the order of column_names(). The first ones, up to `cache`, say what was measured.
class Record {
 public:
  Record();
  /// \pre `column` is one of column_names().
  void set(const std::string& column, const std::string& value);
  void set(const std::string& column, double value);
  void set(const std::string& column, std::int64_t value);
  std::string key() const;   ///< the fields that say what was measured
  std::string line() const;  ///< CSV, without the newline

 private:
  std::vector<std::string> fields_;
};

const std::vector<std::string>& column_names();

/// Appends rows to records.csv.part, headed by a line that says which run they belong to, and renames it at the end. A
/// killed run of the same identity resumes there.
class RecordFile {
 public:
  /// Throws InputError where the folder can't be written.
  RecordFile(std::filesystem::path folder, const std::string& identity);
  bool has(const std::string& key) const { return done_.contains(key); }
  std::size_t resumed() const { return done_.size(); }
  void append(const Record& record);
  /// Writes records.csv and context.json (temporary file, then rename). Throws InputError on a full disk.
  void finish(const Context& context, const std::string& experiment, const std::string& claim,
              const std::string& command, std::uint64_t seed);

 private:
  void check();
  std::filesystem::path folder_, part_;
  std::set<std::string> done_;
  std::vector<std::string> lines_;
  std::ofstream out_;
};

}  // namespace cutbench
