#include "harness/study/variant.h"

#include <algorithm>
#include <cstdio>

#include "harness/base/names.h"

namespace cutbench {

std::string Variant::parameter_text() const {
  if (row->parameter.name.empty()) return "";
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%s=%g", row->parameter.name.c_str(), parameter);
  return buffer;
}

namespace {

/// The row of the table, or of the experiment's own program.
MethodRow row_of(const Experiment& experiment, const std::string& name, const std::vector<MethodRow>& methods) {
  const auto row = std::find_if(methods.begin(), methods.end(), [&](const MethodRow& r) { return r.name == name; });
  for (const ProgramSettings& program : experiment.programs) {
    if (program.name != name) continue;
    if (row != methods.end())
      throw InputError(experiment.stem + ": program \"" + name + "\" has the name of a method; choose another");
    return method_of_program(program);
  }
  if (row != methods.end()) return *row;
  std::vector<std::string> known;
  for (const auto& r : methods) known.push_back(r.name);
  throw InputError(experiment.stem + ": unknown method \"" + name + "\"; " +
                   suggestion(name, known, "`cutbench methods` lists them"));
}

}  // namespace

std::vector<Variant> variants_of(const Experiment& experiment, const std::vector<MethodRow>& methods) {
  std::vector<Variant> variants;
  for (const auto& entry : experiment.methods) {
    const auto row = std::make_shared<const MethodRow>(row_of(experiment, entry.method, methods));
    if (!entry.parameter_values.empty() && row->parameter.name.empty())
      throw InputError(experiment.stem + ": method \"" + entry.method + "\" has no parameter");
    if (entry.parameter_values.empty()) variants.push_back({row, row->parameter.value});
    for (double value : entry.parameter_values) variants.push_back({row, value});
  }
  for (std::size_t i = 0; i < variants.size(); ++i) {
    variants[i].row->make(variants[i].parameter);  // refuses a value out of range
    for (std::size_t j = 0; j < i; ++j)
      if (variants[i].row->name == variants[j].row->name &&
          variants[i].parameter_text() == variants[j].parameter_text())
        throw InputError(experiment.stem + ": method \"" + variants[i].row->name + "\" is there twice" +
                         (variants[i].row->parameter.name.empty() ? "" : " with " + variants[i].parameter_text()) +
                         "; delete one");
  }
  return variants;
}

}  // namespace cutbench
