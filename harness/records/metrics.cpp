#include "harness/records/metrics.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "harness/base/conversions.h"
#include "harness/records/record.h"

namespace cutbench {

namespace {

const char* name_of(Direction direction) {
  switch (direction) {
    case Direction::none:
      return "";
    case Direction::lower:
      return "lower";
    case Direction::higher:
      return "higher";
  }
  return "";
}

struct GroupText {
  Group group;
  const char *name, *title;
};
constexpr std::array<GroupText, 14> group_texts{{
    {Group::key, "key", "What was measured"},
    {Group::outcome, "outcome", "What came of it"},
    {Group::size, "size", "Sizes"},
    {Group::shape, "shape", "Shapes"},
    {Group::forced, "forced", "Forced corners and wedges"},
    {Group::stability, "stability", "Stability"},
    {Group::accuracy, "accuracy", "Accuracy of the incision"},
    {Group::time, "time", "Time of the cut, by the wall clock but for `cpu_us`"},
    {Group::step, "step", "Only of cuts inside a running scene: the update and the first step, by the wall clock"},
    {Group::jump, "jump", "Only of cuts inside a running scene: energies, forces and their jumps"},
    {Group::accuracy_run, "accuracy_run", "Only of accuracy runs"},
    {Group::robustness, "robustness", "Only of robustness runs"},
    {Group::stability_setting, "stability_setting", "Only of the stability sweeps: the settings of a point"},
    {Group::stability_point, "stability_point", "Only of the stability sweeps: what came of a point"},
}};

const char* name_of(Group group) { return group_texts[to_size(group)].name; }

}  // namespace

std::vector<std::string> columns_of(std::initializer_list<Group> groups) {
  std::vector<std::string> names;
  for (const Metric& m : all_metrics())
    if (std::find(groups.begin(), groups.end(), m.group) != groups.end()) names.push_back(m.name);
  return names;
}

const std::vector<std::string>& column_names() {
  static const std::vector<std::string> names =
      columns_of({Group::key, Group::outcome, Group::size, Group::shape, Group::forced, Group::stability,
                  Group::accuracy, Group::time, Group::step, Group::jump});
  return names;
}

std::vector<std::string> key_column_names(const std::string& subject) {
  std::vector<std::string> names = columns_of({Group::key});
  std::replace(names.begin(), names.end(), std::string("cut_family"), subject);
  return names;
}

std::vector<std::string> record_columns(const std::string& subject, const std::vector<Metric>& metrics) {
  std::vector<std::string> names = key_column_names(subject);
  for (const Metric& m : metrics)
    if (m.name != subject && !m.name.ends_with('*')) names.push_back(m.name);
  return names;
}

void fill(Record& row, const Measured& measured, std::initializer_list<Group> groups) {
  for (const Metric& m : all_metrics()) {
    if (groups.size() > 0 && std::find(groups.begin(), groups.end(), m.group) == groups.end()) continue;
    if (!m.get || !row.has(m.name)) continue;
    const Value value = m.get(measured);
    if (const auto* text = std::get_if<std::string>(&value)) row.set(m.name, *text);
    if (const auto* number = std::get_if<double>(&value)) row.set(m.name, *number);
    if (const auto* count = std::get_if<std::int64_t>(&value)) row.set(m.name, *count);
  }
}

std::string columns_as_markdown() {
  std::string text;
  for (const GroupText& group : group_texts) {
    text += (text.empty() ? "### " : "\n### ") + std::string(group.title) +
            "\n\n| column | unit | better | meaning |\n|---|---|---|---|\n";
    for (const Metric& m : all_metrics())
      if (m.group == group.group)
        text += "| `" + m.name + "` | " + m.unit + " | " + name_of(m.direction) + " | " + m.definition + " |\n";
  }
  return text;
}

std::string columns_as_json() {
  nlohmann::ordered_json document = nlohmann::ordered_json::object();
  for (const Metric& m : all_metrics())
    document[m.name] = {{"unit", m.unit},
                        {"label", m.label},
                        {"direction", name_of(m.direction)},
                        {"group", name_of(m.group)},
                        {"definition", m.definition}};
  return document.dump(1) + "\n";
}

}  // namespace cutbench
