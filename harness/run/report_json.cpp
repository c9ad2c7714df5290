#include "harness/run/report_json.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "harness/mesh/mesh_data.h"

namespace cutbench {

void write_report(const std::filesystem::path& file, const std::string& method, const CutRun& run,
                  const Assessment& a) {
  using nlohmann::ordered_json;
  const auto aspect = [](const Quality& q) {
    return ordered_json{{"max", q.ar_max}, {"mean", q.ar_mean}, {"p99", q.ar_p99}};
  };
  const auto angle = [](const Quality& q) { return ordered_json{{"min", q.angle_min_deg}, {"max", q.angle_max_deg}}; };
  const PhaseTimes& t = run.time_us;
  const ordered_json document{
      {"status", name_of(run.status)},
      {"verdict", a.judgement.verdict},
      {"reason", a.judgement.ok ? run.reason : a.judgement.problems.front()},
      {"method", method},
      {"pieces", a.judgement.pieces},
      {"crossed_triangles", run.crossed_triangles},
      {"vertices_added", a.vertices_added},
      {"deformed_vertices_added", a.deformed_vertices_added},
      {"triangles_added", a.triangles_added},
      {"recovered_segments", run.recovered_segments},
      {"aspect_ratio", {{"all", aspect(a.all)}, {"cut", aspect(a.cut)}}},
      {"angle_deg", {{"all", angle(a.all)}, {"cut", angle(a.cut)}}},
      {"altitude_min", {{"all", a.all.altitude_min}, {"cut", a.cut.altitude_min}}},
      {"forced", {{"corners", a.forced_corners}, {"wedge_triangles", a.wedge_triangles}, {"wedge_area", a.wedge_area}}},
      {"incision_error", a.judgement.incision_error},
      {"time_us",
       {{"pick", 0},
        {"locate", t.locate},
        {"trace", t.trace},
        {"embed", t.embed},
        {"improve", t.improve},
        {"open", t.open}}},
      {"area_change", a.judgement.area_change}};
  const std::filesystem::path temporary = file.string() + ".tmp";
  {
    std::ofstream out(temporary);
    out << document.dump(2) << '\n';
    out.flush();
    if (!out)
      throw InputError(file.string() + ": can't be written; check that the folder exists, may be written and has room");
  }
  std::filesystem::rename(temporary, file);
}

}  // namespace cutbench
