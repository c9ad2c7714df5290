#include "harness/records/report_json.h"

#include <algorithm>
#include <initializer_list>
#include <nlohmann/json.hpp>

#include "harness/cut/cut_all.h"
#include "harness/judge/assessment.h"
#include "harness/records/metrics.h"

namespace cutbench {

namespace {

using nlohmann::ordered_json;

ordered_json as_json(const Value& value) {
  return std::visit(
      [](const auto& v) {
        if constexpr (std::is_same_v<std::decay_t<decltype(v)>, std::monostate>)
          return ordered_json(nullptr);
        else
          return ordered_json(v);
      },
      value);
}

void add(ordered_json& document, const Measured& measured, std::initializer_list<Group> groups) {
  for (const Metric& m : all_metrics())
    if (m.get && std::find(groups.begin(), groups.end(), m.group) != groups.end())
      document[m.name] = as_json(m.get(measured));
}

ordered_json as_json(const std::vector<Finding>& findings) {
  ordered_json list = ordered_json::array();
  for (const Finding& f : findings)
    list.push_back({{"cause", f.cause},
                    {"text", f.text},
                    {"mend", f.mend},
                    {"place_rest", f.place ? ordered_json(*f.place) : ordered_json(nullptr)},
                    {"cut", f.cut > 0 ? ordered_json(f.cut) : ordered_json(nullptr)}});
  return list;
}

}  // namespace

std::string cut_as_json(const std::string& method, const CutRun& run, double pick_us, const Assessment& assessment,
                        double h) {
  ordered_json document{{"method", method}};
  add(document, {.h = h, .cut = &run, .judged = true, .assessment = &assessment},
      {Group::outcome, Group::size, Group::shape, Group::forced, Group::accuracy, Group::time});
  document["pick_us"] = pick_us;
  document["embedded_carefully"] = run.carefully;
  return document.dump(2) + "\n";
}

WholeFile report_file(const std::filesystem::path& file, const std::string& method, const CutRun& run, double pick_us,
                      const Assessment& assessment, double h) {
  return {file, cut_as_json(method, run, pick_us, assessment, h)};
}

std::string score_as_json(const Assessment& assessment, double h) {
  const Judgement& j = assessment.judgement;
  ordered_json document{{"verdict", name_of(j.verdict)},
                        {"findings", as_json(assessment.findings)},
                        {"problems", j.problems},
                        {"expected_pieces", j.expected_pieces}};
  if (const FewDigits& read = assessment.read; read.digits > 0)
    document["read"] = {{"digits", read.digits}, {"text", read.text()}};
  add(document, {.h = h, .assessment = &assessment}, {Group::size, Group::shape, Group::forced, Group::accuracy});
  if (!assessment.connected)
    for (const char* name : {"expected_pieces", "pieces", "incision_error_h", "area_change"}) document[name] = nullptr;
  if (!assessment.measured)
    for (auto& [key, value] : document.items())
      if (key != "verdict" && key != "problems" && key != "findings" && key != "read") value = nullptr;
  return document.dump(2) + "\n";
}

}  // namespace cutbench
