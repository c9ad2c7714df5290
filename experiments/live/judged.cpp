#include "experiments/live/judged.h"

#include <algorithm>

#include "experiments/live/method_maker.h"
#include "experiments/live/scene_json.h"
#include "harness/base/stop_watch.h"
#include "harness/cut/constraint_source.h"
#include "harness/cut/cut_all.h"
#include "harness/fem/model/largest_eigenvalue.h"
#include "harness/judge/judged_sheet.h"
#include "methods/registry.h"

namespace cutbench::live {

using nlohmann::json;

json judged(const Scene& scene, const std::string& method, double parameter, const std::vector<Curve>& curves) {
  const MethodRow& row = find_method(method);
  const Sheet before = sheet_of(scene);
  JudgedSheet sheet(before, row.promises, make_method(row, parameter));
  json result{{"verdict", "ok"}, {"reason", ""}};
  double incision_error = 0;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    check_curve(curves[i], "the stroke");
    const JudgedSheet::Finding finding = sheet.cut(curves[i], {});
    incision_error = std::max(incision_error, sheet.judgement.incision_error);
    if (finding.ok()) continue;
    result["verdict"] = name_of(finding.verdict);
    result["reason"] = "cut " + std::to_string(i + 1) + ": " + finding.reason;
    break;
  }
  result["incision_error"] = incision_error / before.mean_edge();
  result["pieces"] = count_pieces(sheet.sheet);
  const auto maker = make_method(row, parameter);
  const Elasticity elasticity{.poisson = scene.material.poisson};
  result["eigenvalue_ratio"] =
      largest_eigenvalue(sheet.sheet, constraints_of(*maker, before, sheet.sheet), elasticity) /
      largest_eigenvalue(before, {}, elasticity);
  return result;
}

json timed(const Scene& scene, const std::string& method, double parameter, const std::vector<Curve>& curves) {
  const MethodRow& row = find_method(method);
  const auto maker = make_method(row, parameter);
  Sheet sheet = sheet_of(scene);
  Locator locator(sheet);
  Cutter cutter;
  cut_all(sheet, locator, cutter, std::span(curves).first(curves.size() - 1), *maker, {});
  const std::size_t copies = std::clamp<std::size_t>(100000 / (sheet.triangle_count() + 1), 4, 32);
  double total = 0, cuts = 0, spent = 0;
  for (int round = 0; round < 24; ++round) {  // a browser compiles anew what runs often: the first half is not counted
    std::vector<Sheet> sheets(copies, sheet);
    std::vector<Locator> locators(copies, locator);
    StopWatch watch;
    for (std::size_t i = 0; i < copies; ++i) cutter.cut(sheets[i], locators[i], curves.back(), *maker, {});
    const double round_ms = watch.lap() / 1000;
    spent += round_ms;
    if (round < 12 && spent < 400) continue;
    total += round_ms;
    cuts += to_double(copies);
    if (spent > 800) break;
  }
  return {{"ms", total / cuts}, {"cuts", cuts}, {"total_ms", total}};
}

}  // namespace cutbench::live
