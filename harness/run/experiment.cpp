#include "harness/run/experiment.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "harness/mesh/families.h"
#include "harness/run/cases.h"

namespace cutbench {

namespace {

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j)
      diagonal = std::exchange(row[j + 1], std::min({row[j] + 1, row[j + 1] + 1, diagonal + (a[i] != b[j])}));
  }
  return row.back();
}

void check_keys(const toml::table& table, const std::vector<std::string>& known, const std::string& where) {
  for (const auto& [key, value] : table) {
    const std::string name(key.str());
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const auto nearest = std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) {
      return edit_distance(a, name) < edit_distance(b, name);
    });
    throw InputError(where + ": unknown key \"" + name + "\"; did you mean \"" + *nearest + "\"?");
  }
}

void check_names(const std::vector<std::string>& names, std::span<const char* const> known, const std::string& what) {
  for (const auto& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    std::string list;
    for (const char* k : known) list += std::string(list.empty() ? "" : ", ") + k;
    throw InputError(what + " \"" + name + "\" is not known; known are " + list);
  }
}

/// Reads values of one table, and says where one is wrong.
struct Reader {
  const toml::table& table;
  std::string where;

  template <class T>
  T value(const char* key, std::optional<T> fallback = {}) const {
    const auto node = table[key];
    if (!node && fallback) return *fallback;
    if (const auto v = node.template value<T>()) return *v;
    throw InputError(where + ": \"" + key + (node ? "\" has a value of the wrong kind" : "\" is missing"));
  }

  template <class T>
  std::vector<T> list(const char* key) const {
    std::vector<T> values;
    const toml::array* array = table[key].as_array();
    if (!array || array->empty()) throw InputError(where + ": \"" + key + "\" must be a list with at least one entry");
    for (const auto& node : *array) {
      const auto v = node.value<T>();
      if (!v) throw InputError(where + ": \"" + key + "\" has an entry of the wrong kind");
      values.push_back(*v);
    }
    return values;
  }

  int count(const char* key, int fallback) const {
    const auto n = value<std::int64_t>(key, fallback);
    if (n < 1 || n > 1000000) throw InputError(where + ": \"" + key + "\" must be between 1 and 1000000");
    return static_cast<int>(n);
  }
};

Experiment::Entry read_entry(const toml::node& node, const std::string& where) {
  if (const auto name = node.value<std::string>()) return {*name, {}};
  const toml::table* table = node.as_table();
  if (!table) throw InputError(where + ": an entry of \"methods\" is a name, or {name = ..., knob = [...]}");
  check_keys(*table, {"name", "knob"}, where + ", methods");
  const Reader reader{*table, where + ", methods"};
  return {reader.value<std::string>("name"),
          table->contains("knob") ? reader.list<double>("knob") : std::vector<double>{}};
}

}  // namespace

int squares_per_side(int triangles) {
  const int n = static_cast<int>(std::lround(std::sqrt(triangles / 2.0)));
  if (n >= 1 && 2 * n * n == triangles) return n;
  throw InputError("resolution " + std::to_string(triangles) +
                   ": a sheet has 2 n^2 triangles, such as 800, 1800, 3200, " + "5000, 7200, 9800, 12800");
}

Experiment read_experiment(const std::filesystem::path& file) {
  const std::string name = file.string();
  toml::table table;
  try {
    table = toml::parse_file(name);
  } catch (const toml::parse_error& error) {
    throw InputError(name + ", line " + std::to_string(error.source().begin.line) + ": " +
                     std::string(error.description()));
  }
  check_keys(table,
             {"claim", "sheets", "cut_families", "resolutions", "methods", "seed", "cases", "repetitions", "cold",
              "quality", "every_edge", "chord_tolerance"},
             name);
  const Reader reader{table, name};
  Experiment e;
  e.stem = file.stem().string();
  e.claim = reader.value<std::string>("claim");
  e.sheets = reader.list<std::string>("sheets");
  e.cut_families = reader.list<std::string>("cut_families");
  check_names(e.sheets, sheet_families(), name + ": sheet");
  check_names(e.cut_families, cut_families(), name + ": cut family");
  for (auto triangles : reader.list<std::int64_t>("resolutions")) {
    squares_per_side(static_cast<int>(triangles));
    e.resolutions.push_back(static_cast<int>(triangles));
  }
  const toml::array* methods = table["methods"].as_array();
  if (!methods || methods->empty()) throw InputError(name + ": \"methods\" must be a list with at least one entry");
  for (const auto& node : *methods) e.methods.push_back(read_entry(node, name));
  e.seed = static_cast<std::uint64_t>(reader.value<std::int64_t>("seed", 1));
  e.cases = reader.count("cases", 1), e.repetitions = reader.count("repetitions", 1);
  e.cold = reader.value<bool>("cold", false), e.quality = reader.value<bool>("quality", true);
  e.every_edge = reader.value<bool>("every_edge", false);
  e.chord_tolerance = reader.value<double>("chord_tolerance", 0.05);  // TOML has inf
  if (!(e.chord_tolerance > 0)) throw InputError(name + ": \"chord_tolerance\" must be positive, or inf");
  return e;
}

}  // namespace cutbench
