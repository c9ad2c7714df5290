// What the readers of experiment and scene files share: values whose kind and range are checked, and errors that say
// which value is wrong.
#pragma once

#include <toml++/toml.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "harness/base/enum_names.h"
#include "harness/base/errors.h"
#include "harness/base/names.h"
#include "harness/base/points.h"

namespace cutbench {

/// Throws InputError naming the file and, where it is not TOML, the line.
toml::table parse_toml(const std::filesystem::path& file);
/// The same from a file's text. \param name  of the file
toml::table parse_toml_text(const std::string& text, const std::string& name);

/// Throws InputError for a key that is not known, naming the nearest one that is, or all.
void check_keys(const toml::table& table, const std::vector<std::string>& known, const std::string& where);

/// Throws InputError for a name that is not known, listing those that are, the nearest first.
template <class Known>
void check_names(const std::vector<std::string>& names, const Known& known, const std::string& what) {
  for (const auto& name : names) {
    if (std::find(std::begin(known), std::end(known), name) != std::end(known)) continue;
    const std::vector<std::string> all(std::begin(known), std::end(known));
    throw InputError(what + " \"" + name + "\" is not known; known are " + listed(nearest_first(name, all)));
  }
}

/// Reads the values of one table. Throws InputError for a wrong value, and for a missing one that has no fallback; the
/// message begins with `where`.
struct TomlReader {
  const toml::table& table;
  std::string where;

  bool has(const char* key) const { return table.contains(key); }
  [[noreturn]] void refuse(const std::string& what) const { throw InputError(where + ": " + what); }

  template <class T>
  static std::string kind() {
    return std::is_same_v<T, bool>       ? "true or false"
           : std::is_integral_v<T>       ? "a whole number"
           : std::is_floating_point_v<T> ? "a number"
                                         : "a word in quotes";
  }

  template <class T>
  T value(const char* key, std::optional<T> fallback = {}) const {
    const auto node = table[key];
    if (!node && fallback) return *fallback;
    if (const auto v = node.template value<T>()) return *v;
    refuse(std::string("\"") + key + (node ? "\" has a value of the wrong kind; give " + kind<T>() : "\" is missing"));
  }

  template <class T>
  std::vector<T> list(const char* key) const {
    std::vector<T> values;
    for (const auto& node : array(key)) {
      const auto v = node.value<T>();
      if (!v) refuse(std::string("\"") + key + "\" has an entry of the wrong kind; give " + kind<T>());
      values.push_back(*v);
    }
    return values;
  }

  /// The value that goes with the name that is given.
  template <class E>
  E choice(const char* key, E fallback, std::span<const EnumName<E>> choices) const {
    if (!has(key)) return fallback;
    const auto name = value<std::string>(key);
    std::vector<const char*> names;
    for (const EnumName<E>& choice : choices) {
      if (name == choice.name) return choice.value;
      names.push_back(choice.name);
    }
    check_names({name}, names, where + ": " + key);
    return fallback;
  }

  int count(const char* key, int fallback, int least = 1) const;  ///< least ... 1000000
  double finite(const char* key, double fallback) const;
  double positive(const char* key, double fallback) const;          ///< and finite
  double positive_or_zero(const char* key, double fallback) const;  ///< and finite
  const toml::array& array(const char* key) const;                  ///< not empty
  std::vector<Point2> points(const char* key) const;                ///< [[x, y], ...], infinite ones too

  /// [key], empty where it is not there.
  TomlReader section(const char* key, const std::vector<std::string>& known) const;
  /// [[key]], none where it is not there; errors say `name` and the number of the entry, from 0.
  std::vector<TomlReader> sections(const char* key, const char* name, const std::vector<std::string>& known) const;
};

}  // namespace cutbench
