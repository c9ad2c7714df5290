#include "harness/study/summary.h"

#include <algorithm>
#include <cstdio>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

/// The median of what was measured, as text; a dash where nothing was.
std::string median(const std::vector<Summary::Cut>& cuts, double (*value)(const Summary::Cut&), const char* format) {
  std::vector<double> values;
  for (const auto& cut : cuts)
    if (cut.ok && !cut.refused && value(cut) >= 0) values.push_back(value(cut));
  if (values.empty()) return "-";
  const auto middle = values.begin() + to_index(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  char text[32];
  std::snprintf(text, sizeof text, format, *middle);
  return text;
}

}  // namespace

void Summary::add(int resolution, const std::string& method, const std::string& parameter, const Cut& cut) {
  cuts_[{resolution, method, parameter}].push_back(cut);
  failed_ += !cut.ok;
}

void Summary::print(const std::string& title) const {
  std::printf("\n%s: medians over sheets, cases and repetitions\n", title.c_str());
  std::printf("%9s  %-20s %-10s %7s %7s %6s %9s %11s %9s %9s %9s %9s\n", "triangles", "method", "parameter", "cuts",
              "refused", "failed", "max AR", "AR > 3", "vertices", "us/cut", "crossed", "ns/cr.");
  std::printf("%9s  %-20s %-10s %7s %7s %6s %9s %11s %9s %9s %9s %9s\n", "", "", "", "", "", "", "(changed)",
              "(changed)", "added", "", "triangles", "triangle");
  for (const auto& [key, cuts] : cuts_) {
    const auto& [resolution, method, parameter] = key;
    const auto failed = std::count_if(cuts.begin(), cuts.end(), [](const Cut& c) { return !c.ok; });
    const auto refused = std::count_if(cuts.begin(), cuts.end(), [](const Cut& c) { return c.refused; });
    std::printf(
        "%9d  %-20s %-10s %7zu %7td %6td %9s %11s %9s %9s %9s %9s\n", resolution, method.c_str(), parameter.c_str(),
        cuts.size(), refused, failed,
        median(
            cuts, [](const Cut& c) { return c.ar_max_cut; }, "%.1f")
            .c_str(),
        median(
            cuts, [](const Cut& c) { return c.over_3_cut; }, "%.0f")
            .c_str(),
        median(
            cuts, [](const Cut& c) { return c.vertices_added; }, "%.0f")
            .c_str(),
        median(
            cuts, [](const Cut& c) { return c.geometry_us; }, "%.1f")
            .c_str(),
        median(
            cuts, [](const Cut& c) { return c.crossed_triangles; }, "%.0f")
            .c_str(),
        median(
            cuts,
            [](const Cut& c) { return c.crossed_triangles > 0 ? 1000 * c.geometry_us / c.crossed_triangles : -1; },
            "%.0f")
            .c_str());
  }
}

}  // namespace cutbench
