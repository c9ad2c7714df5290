// Two files of `experiments/track`, row by row: what became slower, and what gives another result.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cutbench {

/// One row of a file. Totals of its region; divided by `units` they are per unit of work.
struct TrackRow {
  std::string id, phase, unit, fingerprint;
  double units = 0, instructions = 0, misses = 0;
  std::map<std::string, double> counters;
};

struct TrackFile {
  std::string name, commit;
  std::map<std::string, std::string> tools;  ///< compiler, flags, libraries: what counts depend on
  std::vector<TrackRow> rows;
};

/// Throws InputError: not such a file, a row twice, a number that is none.
TrackFile read_track_file(const std::string& path);

/// How much more is slower, as a ratio. One more or less in few is no finding: the least numbers are
/// added to both sides.
struct Thresholds {
  double instructions = 1.005, misses = 1.05, counters = 1.0, least_instructions = 1000, least_misses = 200;
};
/// Of a TOML file: values for all rows, and [rows."PATTERN"] for those whose id begins with the pattern, the longest
/// first. Throws InputError.
class ThresholdTable {
 public:
  ThresholdTable() = default;
  explicit ThresholdTable(const std::string& path);
  Thresholds of(const std::string& id) const;

 private:
  Thresholds all_;
  std::map<std::string, Thresholds> by_prefix_;
};

/// One quantity of a row that both files have.
struct Change {
  std::string id, phase, what;  ///< what: "instructions", "misses", or a counter's name
  double base = 0, head = 0;
  bool slower = false, faster = false;
  std::string accepted;  ///< the reason, where somebody has accepted it
  /// Of head over base; infinite where base is 0 and head is not.
  double ratio() const;
};

struct Comparison {
  std::vector<Change> changes;  ///< the biggest first, slower ones before faster ones; unchanged ones are left out
  std::vector<std::string> different;  ///< rows whose fingerprint differs: another result
  std::vector<std::string> added;      ///< rows that the base does not have
  std::string not_comparable;          ///< why; empty: they are
  std::size_t rows = 0;
  Thresholds thresholds;  ///< of most rows: what change would have been found
  bool is_slower() const;
};

/// \param accepted  by row: the reason
Comparison compare(const TrackFile& base, const TrackFile& head, const ThresholdTable& thresholds,
                   const std::map<std::string, std::string>& accepted);
/// The lines `slower: ROW, REASON` of a commit message.
std::map<std::string, std::string> read_accepted(const std::string& message);

std::string as_text(const Comparison& comparison, const TrackFile& base, const TrackFile& head);
std::string as_markdown(const Comparison& comparison, const TrackFile& base, const TrackFile& head);
std::string as_json(const Comparison& comparison, const TrackFile& base, const TrackFile& head);

}  // namespace cutbench
