#include "harness/run/variant.h"

#include <algorithm>
#include <cstdio>

#include "harness/base/names.h"

namespace cutbench {

std::string Variant::knob_text() const {
  if (row->knob.name.empty()) return "";
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%s=%g", row->knob.name.c_str(), knob);
  return buffer;
}

std::vector<Variant> variants_of(const Experiment& experiment, const std::vector<MethodRow>& methods) {
  std::vector<Variant> variants;
  for (const auto& entry : experiment.methods) {
    const auto row =
        std::find_if(methods.begin(), methods.end(), [&](const MethodRow& r) { return r.name == entry.method; });
    if (row == methods.end()) {
      std::vector<std::string> known;
      for (const auto& r : methods) known.push_back(r.name);
      throw InputError(experiment.stem + ": unknown method \"" + entry.method + "\"; " +
                       suggestion(entry.method, known, "`cutbench methods` lists them"));
    }
    if (!entry.knob_values.empty() && row->knob.name.empty())
      throw InputError(experiment.stem + ": method \"" + entry.method + "\" has no knob");
    if (entry.knob_values.empty()) variants.push_back({&*row, row->knob.value});
    for (double value : entry.knob_values) variants.push_back({&*row, value});
  }
  for (std::size_t i = 0; i < variants.size(); ++i) {
    variants[i].row->make(variants[i].knob);  // refuses a value out of range
    for (std::size_t j = 0; j < i; ++j)
      if (variants[i].row == variants[j].row && variants[i].knob_text() == variants[j].knob_text())
        throw InputError(experiment.stem + ": method \"" + variants[i].row->name + "\" is there twice" +
                         (variants[i].row->knob.name.empty() ? "" : " with " + variants[i].knob_text()) +
                         "; delete one");
  }
  return variants;
}

}  // namespace cutbench
