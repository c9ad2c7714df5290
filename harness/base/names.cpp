#include "harness/base/names.h"

#include <algorithm>
#include <numeric>
#include <utility>

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

}  // namespace

std::vector<std::string> nearest_first(const std::string& name, std::vector<std::string> known) {
  std::stable_sort(known.begin(), known.end(),
                   [&](const auto& a, const auto& b) { return edit_distance(a, name) < edit_distance(b, name); });
  return known;
}

std::string suggestion(const std::string& name, const std::vector<std::string>& known, const std::string& otherwise) {
  if (name.empty() || known.empty()) return otherwise;
  const std::string nearest = nearest_first(name, known).front();
  const bool is_near = edit_distance(nearest, name) <= std::max<std::size_t>(1, nearest.size() / 3);
  return is_near ? "did you mean \"" + nearest + "\"?" : otherwise;
}

std::string listed(const std::vector<std::string>& names) {
  std::string list;
  for (const auto& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

}  // namespace cutbench
