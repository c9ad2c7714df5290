#include "harness/records/compare.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "harness/base/errors.h"
#include "harness/base/json_reader.h"
#include "harness/files/whole_file.h"
#include "harness/scenes/toml_reader.h"

namespace cutbench {

namespace {

TrackRow read_row(const nlohmann::json& json) {
  TrackRow row;
  row.id = json.at("id");
  row.phase = json.at("phase");
  row.unit = json.at("unit");
  row.fingerprint = json.at("fingerprint");
  row.units = json.at("units");
  row.instructions = json.at("instructions");
  row.misses = json.at("misses");
  for (const auto& [name, value] : json.at("counters").items()) row.counters[name] = value;
  return row;
}

std::string percent(double ratio) {
  if (!std::isfinite(ratio)) return "from 0";
  char text[32];
  std::snprintf(text, sizeof text, "%+.2f %%", 100 * (ratio - 1));
  return text;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.0f", value);
  return text;
}

std::string first_line(const Comparison& c) {
  if (!c.not_comparable.empty()) return "not comparable: " + c.not_comparable;
  std::set<std::string> slower, accepted, faster;
  for (const Change& change : c.changes) {
    if (change.faster) faster.insert(change.id);
    if (change.slower) (change.accepted.empty() ? slower : accepted).insert(change.id);
  }
  std::string text = slower.empty() ? "nothing slower" : "SLOWER: " + std::to_string(slower.size()) + " rows";
  text += " of " + std::to_string(c.rows);
  if (!accepted.empty()) text += ", " + std::to_string(accepted.size()) + " accepted";
  if (!faster.empty()) text += ", " + std::to_string(faster.size()) + " faster";
  if (!c.different.empty()) text += ", " + std::to_string(c.different.size()) + " with another result";
  return text;
}

/// The row that is worst, by the phase it is in.
std::string second_line(const Comparison& c) {
  for (const Change& change : c.changes)
    if (change.slower && change.accepted.empty())
      return "worst: phase " + change.phase + ", row " + change.id + ": " + change.what + " " + percent(change.ratio());
  return {};
}

std::string cells(const Change& c, const char* between) {
  std::string verdict = c.slower ? "slower" : "faster";
  if (!c.accepted.empty()) verdict = "accepted: " + c.accepted;
  return c.id + between + c.what + between + percent(c.ratio()) + between + number(c.base) + between + number(c.head) +
         between + verdict;
}

/// What change the rows at hand could have shown.
std::string would_show(const Comparison& c) {
  return "in these rows a change above " + percent(c.thresholds.instructions) + " of instructions, " +
         percent(c.thresholds.misses) + " of misses or " + percent(c.thresholds.counters) +
         " of a counter would have been found; in others none";
}

void sort_by_size(std::vector<Change>& changes) {
  const auto key = [](const Change& c) { return std::pair(!c.slower, -std::abs(std::log(std::max(c.ratio(), 1e-9)))); };
  std::stable_sort(changes.begin(), changes.end(), [&](const Change& a, const Change& b) { return key(a) < key(b); });
}

std::string why_not(const TrackFile& base, const TrackFile& head) {
  std::set<std::string> names;
  for (const auto* file : {&base, &head})
    for (const auto& [name, value] : file->tools) names.insert(name);
  const auto value = [](const TrackFile& file, const std::string& name) {
    const auto found = file.tools.find(name);
    return found == file.tools.end() ? std::string("nothing") : found->second;
  };
  for (const auto& name : names)
    if (value(base, name) != value(head, name))
      return name + " is \"" + value(base, name) + "\" in " + base.name + " and \"" + value(head, name) + "\" in " +
             head.name + "; count both with the same tools";
  return {};
}

}  // namespace

TrackFile read_track_file(const std::string& path) {
  TrackFile file;
  file.name = path;
  const nlohmann::json json = parse_json(
      text_of(path), {path, "a file of experiments/track", "{\"format\": 1, \"tools\": {...}, \"rows\": [...]}"});
  try {
    if (json.at("format") != 1) throw InputError(path + ": format " + json.at("format").dump() + " is not known; 1 is");
    file.commit = json.value("commit", "");
    for (const auto& [name, value] : json.at("tools").items()) file.tools[name] = value;
    std::set<std::string> ids;
    for (const auto& row : json.at("rows")) {
      file.rows.push_back(read_row(row));
      if (!ids.insert(file.rows.back().id).second)
        throw InputError(path + ": row " + file.rows.back().id + " is there twice");
    }
  } catch (const nlohmann::json::exception& error) {
    throw InputError(path + ": not a file of experiments/track: " + error.what());
  }
  return file;
}

ThresholdTable::ThresholdTable(const std::string& path) {
  const toml::table table = parse_toml(path);
  const std::vector<std::string> numbers{"instructions", "misses", "counters", "least_instructions", "least_misses"};
  std::vector<std::string> known = numbers;
  known.emplace_back("rows");
  check_keys(table, known, path);
  const auto read = [](const TomlReader& reader, const Thresholds& fallback) {
    return Thresholds{reader.positive("instructions", fallback.instructions),
                      reader.positive("misses", fallback.misses), reader.positive("counters", fallback.counters),
                      reader.positive_or_zero("least_instructions", fallback.least_instructions),
                      reader.positive_or_zero("least_misses", fallback.least_misses)};
  };
  all_ = read({table, path}, {});
  if (const auto* rows = table["rows"].as_table())
    for (const auto& [prefix, node] : *rows) {
      const std::string name(prefix.str()), where = path + ", [rows.\"" + name + "\"]";
      if (!node.is_table()) throw InputError(where + ": this is no table of thresholds");
      check_keys(*node.as_table(), numbers, where);
      by_prefix_[name] = read({*node.as_table(), where}, all_);
    }
}

Thresholds ThresholdTable::of(const std::string& id) const {
  const std::string* longest = nullptr;
  for (const auto& [prefix, thresholds] : by_prefix_)
    if (id.starts_with(prefix) && (!longest || prefix.size() > longest->size())) longest = &prefix;
  return longest ? by_prefix_.at(*longest) : all_;
}

double Change::ratio() const {
  if (base == head) return 1;
  return base > 0 ? head / base : std::numeric_limits<double>::infinity();
}

bool Comparison::is_slower() const {
  return std::any_of(changes.begin(), changes.end(), [](const Change& c) { return c.slower && c.accepted.empty(); });
}

Comparison compare(const TrackFile& base, const TrackFile& head, const ThresholdTable& thresholds,
                   const std::map<std::string, std::string>& accepted) {
  Comparison result;
  result.not_comparable = why_not(base, head);
  std::map<std::string, const TrackRow*> heads;
  for (const TrackRow& row : head.rows) heads[row.id] = &row;
  for (const TrackRow& row : base.rows) {
    const auto found = heads.find(row.id);
    if (found == heads.end()) {
      if (result.not_comparable.empty()) result.not_comparable = "row " + row.id + " is missing in " + head.name;
      continue;
    }
    const TrackRow& now = *found->second;
    heads.erase(found);
    ++result.rows;
    if (row.fingerprint != now.fingerprint) result.different.push_back(row.id);
    const Thresholds t = thresholds.of(row.id);
    const auto look = [&](const std::string& what, double before, double after, double most, double slack) {
      Change change{row.id,
                    row.phase,
                    what,
                    before,
                    after,
                    after + slack > most * (before + slack),
                    before + slack > most * (after + slack),
                    {}};
      if (!change.slower && !change.faster) return;
      if (const auto reason = accepted.find(row.id); change.slower && reason != accepted.end())
        change.accepted = reason->second;
      result.changes.push_back(change);
    };
    look("instructions", row.instructions, now.instructions, t.instructions, t.least_instructions);
    look("misses", row.misses, now.misses, t.misses, t.least_misses);
    for (const auto& [name, before] : row.counters)
      if (const auto after = now.counters.find(name); after != now.counters.end())
        look(name, before, after->second, t.counters, 0);
  }
  for (const auto& [id, row] : heads) result.added.push_back(id);
  if (result.rows == 0 && result.not_comparable.empty()) result.not_comparable = "no row is in both";
  result.thresholds = thresholds.of("");
  sort_by_size(result.changes);
  return result;
}

std::map<std::string, std::string> read_accepted(const std::string& message) {
  std::map<std::string, std::string> accepted;
  std::istringstream lines(message);
  for (std::string line; std::getline(lines, line);) {
    const std::string begin = "slower: ";
    const auto comma = line.find(", ");
    if (!line.starts_with(begin) || comma == std::string::npos) continue;
    accepted[line.substr(begin.size(), comma - begin.size())] = line.substr(comma + 2);
  }
  return accepted;
}

std::string as_text(const Comparison& c, const TrackFile& base, const TrackFile& head) {
  std::ostringstream out;
  out << first_line(c) << '\n';
  if (const auto worst = second_line(c); !worst.empty()) out << worst << '\n';
  out << "base " << base.name << (base.commit.empty() ? "" : ", commit " + base.commit) << "; head " << head.name
      << (head.commit.empty() ? "" : ", commit " + head.commit) << '\n';
  if (c.not_comparable.empty()) out << would_show(c) << '\n';
  for (const Change& change : c.changes) out << "  " << cells(change, "  ") << '\n';
  for (const auto& id : c.different) out << "  another result: " << id << '\n';
  for (const auto& id : c.added) out << "  new row: " << id << '\n';
  return out.str();
}

std::string as_markdown(const Comparison& c, const TrackFile& base, const TrackFile& head) {
  std::ostringstream out;
  out << "**" << first_line(c) << "**\n\n";
  if (const auto worst = second_line(c); !worst.empty()) out << worst << "\n\n";
  out << "Base " << (base.commit.empty() ? base.name : base.commit) << ", head "
      << (head.commit.empty() ? head.name : head.commit) << ".\n\n";
  if (c.not_comparable.empty()) out << "I" << would_show(c).substr(1) << ".\n\n";
  if (!c.changes.empty()) {
    out << "| row | what | change | base | head | verdict |\n|---|---|---|---|---|---|\n";
    for (const Change& change : c.changes) out << "| " << cells(change, " | ") << " |\n";
    out << '\n';
  }
  for (const auto& id : c.different) out << "- another result: " << id << '\n';
  for (const auto& id : c.added) out << "- new row: " << id << '\n';
  return out.str();
}

std::string as_json(const Comparison& c, const TrackFile& base, const TrackFile& head) {
  nlohmann::ordered_json json{{"verdict", !c.not_comparable.empty() ? "not_comparable"
                                          : c.is_slower()           ? "slower"
                                                                    : "ok"},
                              {"not_comparable", c.not_comparable},
                              {"base", base.commit},
                              {"head", head.commit},
                              {"rows", c.rows},
                              {"changes", nlohmann::ordered_json::array()},
                              {"different", c.different},
                              {"added", c.added}};
  for (const Change& change : c.changes)
    json["changes"].push_back({{"row", change.id},
                               {"phase", change.phase},
                               {"what", change.what},
                               {"base", change.base},
                               {"head", change.head},
                               {"verdict", change.faster             ? "faster"
                                           : change.accepted.empty() ? "slower"
                                                                     : "accepted"},
                               {"reason", change.accepted}});
  return json.dump(1) + "\n";
}

}  // namespace cutbench
