// Every column of the records in one table: its name, unit, label, what is better, where it is shown, what it means,
// and where its value comes from. Records, JSON reports, `cutbench columns`, results/columns.json, the column tables of
// results/README.md and the labels of figures are made from it. A new metric is one entry here.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <string>
#include <variant>
#include <vector>

namespace cutbench {

struct Assessment;
struct CutRun;
struct MotionCut;
class Record;

/// Largest eigenvalues over that of the uncut sheet with a lumped mass; negative: not measured.
struct EigenvalueRatios {
  double lumped = -1, stabilised = -1, scaled = -1;
  double scaled_added = -1;  ///< mass that scaling adds, over the sheet's
};

/// What the updates after a cut save: the same from nothing, on the same sheet. Microseconds, steady clock.
struct RebuildTimes {
  double model = 0;     ///< instead of `pattern`: a new model, without bending
  double bending = 0;   ///< instead of `bending`: a new bending matrix
  double triplets = 0;  ///< instead of `assemble`: Eigen's setFromTriplets with scalar entries, triplets included
};

/// What has been measured of one cut, or of several in a row. A null pointer: that has not been measured.
struct Measured {
  double h = 0;                 ///< mean rest edge of the uncut sheet
  const CutRun* cut = nullptr;  ///< status and times
  bool judged = false;          ///< the repetition that was judged: it has what no repetition changes
  const Assessment* assessment = nullptr;
  bool shapes = true;                         ///< the assessment's shapes and forced zones are wanted
  const MotionCut* motion = nullptr;          ///< the cut in a running scene; then `cut` is its `cut`
  RebuildTimes rebuild = {};                  ///< of that cut
  EigenvalueRatios membrane = {}, bent = {};  ///< without and with bending
};

/// Not measured: an empty field in CSV, null in JSON.
using Value = std::variant<std::monostate, std::string, double, std::int64_t>;

enum class Direction : std::uint8_t { none, lower, higher };

/// The tables in which columns are shown together, in this order.
enum class Group : std::uint8_t {
  key,
  outcome,
  size,
  shape,
  forced,
  stability,
  accuracy,
  time,
  step,
  jump,
  accuracy_run,
  robustness,
  stability_setting,
  stability_point
};

struct Metric {
  std::string name;                       ///< of the column; ends with the unit where there is one
  std::string unit;                       ///< as printed beside a number; empty: a text, a count or a ratio
  std::string label;                      ///< short, for axes and table heads, without the unit
  Direction direction = Direction::none;  ///< which values are better
  Group group = Group::outcome;
  std::string definition;                          ///< one sentence or two
  std::function<Value(const Measured&)> get = {};  ///< empty: the runner of the experiment fills the column
};

/// The columns of all records, in their order.
const std::vector<Metric>& all_metrics();
/// What the records of other kinds of studies have behind their keys, in the order of their columns. An entry without a
/// definition is one of the whole table that they share (shared_metric()); the others are these kinds' part of it.
std::vector<Metric> accuracy_metrics();    ///< filled by harness/study/accuracy.cpp
std::vector<Metric> robustness_metrics();  ///< counts; filled by harness/study/robustness/robustness.cpp
std::vector<Metric> stability_metrics();   ///< filled by harness/study/stability
inline Metric shared_metric(const char* name) { return {.name = name, .unit = {}, .label = {}, .definition = {}}; }
/// The columns of such records: the keys with `subject` in the place of the cut family, and the metrics that are not
/// among them; without those whose name ends with `*`, which stands for several.
std::vector<std::string> record_columns(const std::string& subject, const std::vector<Metric>& metrics);
/// Names of the columns of these groups, in the table's order.
std::vector<std::string> columns_of(std::initializer_list<Group> groups);

/// Enters what has been measured into the columns of these groups that the row has (none given: of all groups). The
/// others stay as they are.
void fill(Record& row, const Measured& measured, std::initializer_list<Group> groups = {});

/// The table as Markdown, a section for each group; and as JSON, an object by name.
std::string columns_as_markdown();
std::string columns_as_json();

}  // namespace cutbench
