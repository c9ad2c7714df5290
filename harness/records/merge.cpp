#include "harness/records/merge.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <sstream>
#include <string>

#include "harness/base/conversions.h"
#include "harness/base/errors.h"
#include "harness/files/whole_file.h"
#include "harness/records/record.h"
#include "harness/records/shard_of.h"

namespace cutbench {

namespace {

using Fields = std::vector<std::string>;

std::string joined(const Fields& fields) {
  std::string line;
  for (const std::string& field : fields) line += (&field == &fields.front() ? "" : ",") + field;
  return line;
}

struct Shard {
  std::filesystem::path folder;
  nlohmann::json context;
  std::string head;
  std::vector<Fields> rows;

  int number() const { return context.at("shard"); }
  int of() const { return context.at("shards"); }
};

/// \param why_not  set where the folder holds no whole shard
std::optional<Shard> read_shard(const std::filesystem::path& folder, std::string& why_not) {
  Shard shard{folder, {}, {}, {}};
  const auto records = folder / "records.csv", context = folder / "context.json";
  if (!std::filesystem::is_regular_file(records) || !std::filesystem::is_regular_file(context)) {
    why_not = folder.string() + ": not finished; run its command again";
    return {};
  }
  shard.context = nlohmann::json::parse(text_of(context), nullptr, false);
  const std::string text = text_of(records);
  std::istringstream lines(text);
  std::getline(lines, shard.head);
  const std::size_t columns = fields_of(shard.head).size();
  bool whole = !text.empty() && text.back() == '\n';
  for (std::string line; std::getline(lines, line);) {
    shard.rows.push_back(fields_of(line));
    whole = whole && shard.rows.back().size() == columns;
  }
  const bool known = shard.context.is_object() && shard.context.contains("run") && shard.context.contains("rows");
  if (known && whole && shard.context["rows"] == shard.rows.size()) return shard;
  why_not = folder.string() + (known ? ": records.csv is cut short; run its command again"
                                     : ": its context.json is damaged, or of an older version; run its command again");
  return {};
}

void check_same_run(const Shard& first, const Shard& other) {
  if (first.context["run"] != other.context["run"] || first.head != other.head)
    throw InputError(other.folder.string() + ": is of another program, machine, experiment or seed than " +
                     first.folder.string());
  if (first.of() != other.of())
    throw InputError(other.folder.string() + ": is one of " + std::to_string(other.of()) + " shards, " +
                     first.folder.string() + " one of " + std::to_string(first.of()));
}

std::string listed_numbers(const std::vector<int>& numbers) {
  std::string text;
  for (const int n : numbers) text += (text.empty() ? "" : ",") + std::to_string(n);
  return text;
}

std::vector<int> missing_of(const std::vector<Shard>& shards, int of) {
  std::vector<int> missing;
  for (int n = 1; n <= of; ++n)
    if (std::none_of(shards.begin(), shards.end(), [n](const Shard& s) { return s.number() == n; }))
      missing.push_back(n);
  return missing;
}

/// Columns by name, and rows in the order of a run without shards.
class Table {
 public:
  explicit Table(const std::string& head) : names_(fields_of(head)) {}

  std::vector<Fields> merged(const std::vector<Shard>& shards) const {
    return has("tried") ? summed(shards) : dealt(shards);
  }

 private:
  bool has(const std::string& name) const { return std::find(names_.begin(), names_.end(), name) != names_.end(); }
  std::size_t column(const std::string& name) const {
    return to_size(std::find(names_.begin(), names_.end(), name) - names_.begin());
  }
  std::string key(const Fields& row, std::initializer_list<const char*> columns) const {
    std::string text;
    for (const char* name : columns) text += row.at(column(name)) + ",";
    return text;
  }

  /// The rows of a shard by work item: a measured case, or a point of a sweep, which has one row.
  std::vector<std::span<const Fields>> items(const std::vector<Fields>& rows) const {
    const bool one_row_each = has("sweep");
    const auto item_of = [&, subject = has("problem") ? "problem" : "cut_family"](const Fields& row) {
      return key(row, {subject, "sheet", "resolution", "case"});
    };
    std::vector<std::span<const Fields>> result;
    for (std::size_t begin = 0, end = 0; begin < rows.size(); begin = end) {
      for (end = begin + 1; !one_row_each && end < rows.size() && item_of(rows[end]) == item_of(rows[begin]);) ++end;
      result.emplace_back(&rows[begin], end - begin);
    }
    return result;
  }

  /// Of work items, each of which is in one shard (harness/records/shard_of.h).
  std::vector<Fields> dealt(const std::vector<Shard>& shards) const {
    std::vector<std::vector<std::span<const Fields>>> hands;
    for (const Shard& shard : shards) hands.push_back(items(shard.rows));
    std::size_t number = 0;
    for (const auto& hand : hands) number = std::max(number, hands.size() * hand.size());
    std::vector<Fields> result;
    for (std::size_t item = 0; item < number; ++item) {
      const auto& hand = hands[shard_of(item, hands.size())];
      if (const std::size_t turn = item / hands.size(); turn < hand.size())
        result.insert(result.end(), hand[turn].begin(), hand[turn].end());
    }
    return result;
  }

  /// Of counted cases: counts are added; the family `unknown`, which few shards have, comes first.
  std::vector<Fields> summed(const std::vector<Shard>& shards) const {
    std::map<std::string, std::size_t> block_number, family_number;
    std::map<std::pair<std::size_t, std::size_t>, Fields> sums;
    family_number.emplace("unknown,", 0);
    const std::size_t first = column("tried"), slowest = column("slowest_us");
    for (const Shard& shard : shards)
      for (const Fields& row : shard.rows) {
        const std::size_t next_block = block_number.size(), next_family = family_number.size();
        const std::string block_key = key(row, {"sheet", "resolution", "method", "parameter"});
        const std::size_t block = block_number.emplace(block_key, next_block).first->second;
        const std::size_t family = family_number.emplace(key(row, {"cut_family"}), next_family).first->second;
        const auto [at, is_new] = sums.try_emplace({block, family}, row);
        if (is_new) continue;
        Fields& sum = at->second;
        for (std::size_t c = first; c < slowest; ++c) sum[c] = std::to_string(std::stoll(sum[c]) + std::stoll(row[c]));
        if (std::stod(row[slowest]) > std::stod(sum[slowest])) sum[slowest] = row[slowest];
      }
    std::vector<Fields> result;
    for (const auto& [order, row] : sums) result.push_back(row);
    return result;
  }

  Fields names_;
};

void copy_failing_cases(const std::vector<Shard>& shards, const std::filesystem::path& out) {
  std::error_code error;
  for (const Shard& shard : shards)
    if (std::filesystem::is_directory(shard.folder / "failing"))
      std::filesystem::copy(
          shard.folder / "failing", out / "failing",
          std::filesystem::copy_options::recursive | std::filesystem::copy_options::overwrite_existing, error);
  if (error) throw OutputError(out.string() + "/failing: can't be written (" + error.message() + ")");
}

}  // namespace

void merge_shards(const std::vector<std::filesystem::path>& folders, const std::filesystem::path& out) {
  std::vector<Shard> shards;
  for (const auto& folder : folders) {
    std::string why_not;
    auto shard = read_shard(folder, why_not);
    if (!shard) throw InputError(why_not);
    if (!shards.empty()) check_same_run(shards.front(), *shard);
    for (const Shard& other : shards)
      if (other.number() == shard->number())
        throw InputError(folder.string() + ": is shard " + std::to_string(shard->number()) + ", as is " +
                         other.folder.string() + "; leave one out");
    shards.push_back(std::move(*shard));
  }
  if (const auto missing = missing_of(shards, shards.front().of()); !missing.empty())
    throw InputError("of " + std::to_string(shards.front().of()) +
                     " shards these are missing: " + listed_numbers(missing));
  std::sort(shards.begin(), shards.end(), [](const Shard& a, const Shard& b) { return a.number() < b.number(); });

  const std::vector<Fields> rows = Table(shards.front().head).merged(shards);
  std::string csv = shards.front().head + '\n';
  for (const Fields& row : rows) csv += joined(row) + '\n';
  nlohmann::json context = shards.front().context;
  context["merged_shards"] = shards.size();
  context["shard"] = 1;
  context["shards"] = 1;
  context["rows"] = rows.size();
  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (error) throw InputError(out.string() + ": can't be made (" + error.message() + "); choose another --out");
  WholeFile context_file(out / "context.json", context.dump(2) + '\n');
  WholeFile records(out / "records.csv", csv);
  copy_failing_cases(shards, out);
  context_file.place();
  records.place();
}

std::vector<int> missing_shards(const std::vector<std::filesystem::path>& folders, int of) {
  std::vector<Shard> shards;
  for (const auto& folder : folders) {
    std::string why_not;
    auto shard = read_shard(folder, why_not);
    if (!shard) continue;
    if (shard->of() != of)
      throw InputError(folder.string() + ": is one of " + std::to_string(shard->of()) + " shards, not of " +
                       std::to_string(of));
    if (!shards.empty()) check_same_run(shards.front(), *shard);
    shards.push_back(std::move(*shard));
  }
  return missing_of(shards, of);
}

}  // namespace cutbench
