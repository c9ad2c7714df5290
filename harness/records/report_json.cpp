#include "harness/records/report_json.h"

#include <nlohmann/json.hpp>

namespace cutbench {

namespace {

using nlohmann::ordered_json;

void add_counts(ordered_json& document, const Assessment& a) {
  document["vertices_added"] = a.vertices_added;
  document["deformed_vertices_added"] = a.deformed_vertices_added;
  document["triangles_added"] = a.triangles_added;
}

void add_shapes(ordered_json& document, const Assessment& a) {
  const auto aspect = [](const Quality& q) {
    return ordered_json{{"max", q.ar_max}, {"mean", q.ar_mean}, {"p99", q.ar_p99}};
  };
  const auto angle = [](const Quality& q) { return ordered_json{{"min", q.angle_min_deg}, {"max", q.angle_max_deg}}; };
  document["aspect_ratio"] = {{"all", aspect(a.all)}, {"cut", aspect(a.cut)}};
  document["angle_deg"] = {{"all", angle(a.all)}, {"cut", angle(a.cut)}};
  document["altitude_min"] = {{"all", a.all.altitude_min}, {"cut", a.cut.altitude_min}};
  document["forced"] = {
      {"corners", a.forced_corners}, {"wedge_triangles", a.wedge_triangles}, {"wedge_area", a.wedge_area}};
}

}  // namespace

WholeFile report_file(const std::filesystem::path& file, const std::string& method, const CutRun& run, double pick_us,
                      const Assessment& a) {
  const PhaseTimes& t = run.time_us;
  ordered_json document{{"status", name_of(run.status)},
                        {"verdict", a.judgement.verdict},
                        {"reason", a.judgement.ok ? run.reason : a.judgement.problems.front()},
                        {"method", method},
                        {"pieces", a.judgement.pieces},
                        {"crossed_triangles", run.crossed_triangles}};
  add_counts(document, a);
  document["recovered_segments"] = run.recovered_segments;
  document["embedded_carefully"] = run.carefully;
  add_shapes(document, a);
  document["incision_error"] = a.judgement.incision_error;
  document["time_us"] = {{"pick", pick_us},      {"locate", t.locate}, {"trace", t.trace}, {"embed", t.embed},
                         {"improve", t.improve}, {"open", t.open},     {"tie", t.tie}};
  document["area_change"] = a.judgement.area_change;
  return {file, document.dump(2) + "\n"};
}

void write_score(const std::filesystem::path& file, const Assessment& a) {
  const oracle::Judgement& j = a.judgement;
  ordered_json document{
      {"verdict", j.verdict}, {"problems", j.problems}, {"pieces", j.pieces}, {"expected_pieces", j.expected_pieces}};
  add_counts(document, a);
  add_shapes(document, a);
  document["incision_error"] = j.incision_error;
  document["area_change"] = j.area_change;
  if (!a.measured)
    for (auto& [key, value] : document.items())
      if (key != "verdict" && key != "problems") value = nullptr;
  WholeFile(file, document.dump(2) + "\n").place();
}

}  // namespace cutbench
