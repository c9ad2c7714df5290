#include "experiments/score.h"

#include <cstdio>
#include <iostream>

#include "harness/judge/assessment.h"
#include "harness/mesh/mesh_io.h"
#include "harness/records/report_json.h"

namespace cutbench {

namespace {

void print_shapes(const char* which, const Quality& q) {
  std::printf(
      "%s triangles: %zu, aspect ratio max %.4g, mean %.4g, p99 %.4g, angles %.4g to %.4g deg, "
      "smallest altitude %.4g h\n",
      which, q.triangles, q.ar_max, q.ar_mean, q.ar_p99, q.angle_min_deg, q.angle_max_deg, q.altitude_min);
}

void print(const Assessment& a, double h) {
  const oracle::Judgement& j = a.judgement;
  std::printf("%s\n", j.ok ? "ok" : ("failed: " + j.verdict).c_str());
  for (const std::string& problem : j.problems) std::printf("%s\n", problem.c_str());
  if (!a.measured) return;
  std::printf("%d pieces (%d expected), incision error %.4g h, area change %.3g\n", j.pieces, j.expected_pieces,
              j.incision_error / h, j.area_change);
  std::printf("added: %td rest vertices, %td deformed vertices, %td triangles\n", a.vertices_added,
              a.deformed_vertices_added, a.triangles_added);
  print_shapes("all", a.all);
  print_shapes("changed", a.cut);
  std::printf(
      "forced: %zu corners with %d triangles; %d triangles in wedges, area %.4g; "
      "max aspect ratio without corners %.4g, without wedges %.4g\n",
      a.forced_corners, a.corner_triangles, a.wedge_triangles, a.wedge_area, a.strict.ar_max, a.outside_wedges.ar_max);
}

}  // namespace

bool score(const ScoreArguments& arguments, const CutOptions& options) {
  const std::vector<Curve> cuts = read_path(arguments.path);
  const MeshData data = read_mesh(arguments.mesh);
  for (const auto& note : data.notes) std::cerr << "note: " << note << '\n';
  const MeshData result = read_mesh_as_is(arguments.result);
  const Sheet before(data);
  const Assessment a = assess_result(before, result, cuts, arguments.keeps_vertices, options);
  if (!arguments.report.empty()) write_score(arguments.report, a, before.mean_edge());
  print(a, before.mean_edge());
  return a.judgement.ok;
}

}  // namespace cutbench
