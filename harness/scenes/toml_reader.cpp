#include "harness/scenes/toml_reader.h"

#include <cmath>

#include "harness/base/conversions.h"
#include "harness/files/whole_file.h"

namespace cutbench {

namespace {

std::string quoted(const char* key) { return std::string("\"") + key + "\""; }

}  // namespace

toml::table parse_toml(const std::filesystem::path& file) { return parse_toml_text(text_of(file), file.string()); }

toml::table parse_toml_text(const std::string& text, const std::string& name) {
  try {
    return toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    throw InputError(name + ", line " + std::to_string(error.source().begin.line) + ": " +
                     std::string(error.description()));
  }
}

void check_keys(const toml::table& table, const std::vector<std::string>& known, const std::string& where) {
  for (const auto& [key, value] : table) {
    const std::string name(key.str());
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    throw InputError(where + ": unknown key \"" + name + "\"; " +
                     suggestion(name, known, "known are " + listed(known)));
  }
}

int TomlReader::count(const char* key, int fallback, int least) const {
  const auto n = value<std::int64_t>(key, fallback);
  if (n < least || n > 1000000) refuse(quoted(key) + " must be between " + std::to_string(least) + " and 1000000");
  return to_int(n);
}

double TomlReader::finite(const char* key, double fallback) const {
  const auto x = value<double>(key, fallback);
  if (!std::isfinite(x)) refuse(quoted(key) + " must be finite");
  return x;
}

double TomlReader::positive(const char* key, double fallback) const {
  const double x = finite(key, fallback);
  if (!(x > 0)) refuse(quoted(key) + " must be positive");
  return x;
}

double TomlReader::positive_or_zero(const char* key, double fallback) const {
  const double x = finite(key, fallback);
  if (x < 0) refuse(quoted(key) + " must be positive, or 0");
  return x;
}

const toml::array& TomlReader::array(const char* key) const {
  const toml::array* array = table[key].as_array();
  if (!array || array->empty()) refuse(quoted(key) + " must be a list with at least one entry");
  return *array;
}

std::vector<Point2> TomlReader::points(const char* key) const {
  std::vector<Point2> points;
  for (const auto& node : array(key)) {
    const toml::array* pair = node.as_array();
    const auto x = pair && pair->size() == 2 ? (*pair)[0].value<double>() : std::nullopt;
    const auto y = x ? (*pair)[1].value<double>() : std::nullopt;
    if (!y) refuse(quoted(key) + " is a list of points, each [x, y]");
    points.push_back({*x, *y});
  }
  return points;
}

TomlReader TomlReader::section(const char* key, const std::vector<std::string>& known) const {
  static const toml::table none;
  const toml::table* found = has(key) ? table[key].as_table() : &none;
  if (!found) refuse(quoted(key) + " must be a table, headed [" + key + "]");
  TomlReader reader{*found, where + ", [" + key + "]"};
  check_keys(*found, known, reader.where);
  return reader;
}

std::vector<TomlReader> TomlReader::sections(const char* key, const char* name,
                                             const std::vector<std::string>& known) const {
  std::vector<TomlReader> readers;
  if (!has(key)) return readers;
  const std::string wrong = quoted(key) + " must be a list of tables, each headed [[" + key + "]]";
  const toml::array* entries = table[key].as_array();
  if (!entries) refuse(wrong);
  for (const auto& entry : *entries) {
    if (!entry.is_table()) refuse(wrong);
    readers.push_back({*entry.as_table(), where + ", " + name + " " + std::to_string(readers.size())});
    check_keys(readers.back().table, known, readers.back().where);
  }
  return readers;
}

}  // namespace cutbench
