// Records on disk: results/<stem>/records.csv, one row per measurement, and context.json beside it.
#pragma once

#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "harness/records/context.h"

namespace cutbench {

/// The version of meshes, cuts and definitions that records bear.
constexpr const char* suite_version = "6";

/// So many of the first columns say what was measured, in every record: up to `cache`.
constexpr std::size_t key_columns = 10;
/// The columns of a measured cut (harness/records/metrics.h).
const std::vector<std::string>& column_names();
/// The first columns of every record. \param subject  what is cut or solved: `cut_family`, or `problem` in accuracy
/// runs
std::vector<std::string> key_column_names(const std::string& subject = "cut_family");

/// The fields of a row or head, which commas separate.
std::vector<std::string> fields_of(const std::string& line);

/// A row: the fields in the order of the columns.
class Record {
 public:
  /// \param columns  must outlive the record
  explicit Record(const std::vector<std::string>& columns = column_names());
  Record(const std::vector<std::string>& columns, const std::string& line);
  /// \pre `column` is one of the columns.
  void set(const std::string& column, const std::string& value);
  void set(const std::string& column, double value);
  void set(const std::string& column, std::int64_t value);
  const std::string& get(const std::string& column) const;
  bool has(const std::string& column) const { return index(column) < columns_->size(); }
  std::string key(std::size_t columns = key_columns) const;  ///< the fields that say what was measured
  std::string line() const;                                  ///< CSV, without the newline

 private:
  std::size_t index(const std::string& column) const;
  const std::vector<std::string>* columns_;
  std::vector<std::string> fields_;
};

/// Appends rows to records.csv.part, headed by a line that says which run they belong to, until records.csv takes its
/// place. A killed run of the same identity resumes there: rows it finished are kept to the letter, a last one cut
/// short is dropped. Rows of another identity are thrown away, and note() says so.
class RecordFile {
 public:
  /// \param identity  all that the rows depend on; a last line of its own, "i/N", is the shard
  /// \param keys  so many of the first columns say what was measured
  /// Throws InputError where the folder can't be written.
  RecordFile(const std::filesystem::path& folder, const std::string& identity,
             const std::vector<std::string>& columns = column_names(), std::size_t keys = key_columns);
  bool has(const std::string& key) const { return done_.contains(key); }
  bool has(const Record& row) const { return has(row.key(keys_)); }
  const std::string& note() const { return note_; }  ///< what became of an earlier run's rows; empty without any
  /// Throws OutputError on a full disk.
  void append(const Record& record);
  const std::vector<std::string>& lines() const { return lines_; }
  /// Writes records.csv and context.json, whole or not at all. Throws OutputError on a full disk.
  void finish(const Context& context, const std::string& experiment, const std::string& claim,
              const std::string& command, std::uint64_t seed);

 private:
  bool resume(const std::string& head);
  void check();
  std::filesystem::path folder_, part_;
  const std::vector<std::string>& columns_;
  std::string identity_;
  std::size_t keys_;
  std::string note_;
  std::set<std::string> done_;
  std::vector<std::string> lines_;
  std::ofstream out_;
};

}  // namespace cutbench
