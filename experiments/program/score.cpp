#include "experiments/program/score.h"

#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "harness/files/mesh_file.h"
#include "harness/files/path_file.h"
#include "harness/files/whole_file.h"
#include "harness/judge/assessment.h"
#include "harness/judge/result_svg.h"
#include "harness/mesh/winding.h"
#include "harness/path/clear_of_seams.h"
#include "harness/records/report_json.h"
#include "methods/registry.h"

namespace cutbench {

namespace {

/// A dash where nothing was measured.
std::string number(bool measured, const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return measured ? text : "-";
}

/// Such as "43 triangles" or "62 fewer triangles".
std::string more_or_fewer(std::ptrdiff_t count, const char* what) {
  return std::to_string(std::abs(count)) + (count < 0 ? " fewer " : " ") + what;
}

void print_shapes(const char* which, const Quality& q) {
  const auto text = [&](double value) { return number(q.triangles > 0, "%.4g", value); };
  std::cout << which << " triangles: " << q.triangles << ", aspect ratio max " << text(q.ar_max) << ", mean "
            << text(q.ar_mean) << ", p99 " << text(q.ar_p99) << ", angles " << text(q.angle_min_deg) << " to "
            << text(q.angle_max_deg) << " deg, smallest altitude " << text(q.altitude_min) << " h\n";
}

void print_findings(const Assessment& a, std::size_t cuts) {
  for (const Finding& f : a.findings) {
    std::cout << f.cause << ": " << f.text;
    if (f.cut > 0 && cuts > 1) std::cout << "; the nearest cut is number " << f.cut << " of " << cuts;
    std::cout << "\nmend: " << f.mend << '\n';
  }
}

/// Where another number of pieces than the exact path's is right.
void print_why_another_number(const Judgement& j, std::size_t cuts) {
  if (!j.ok || j.expected_pieces == 0 || j.pieces == j.expected_pieces) return;
  std::cout
      << j.pieces << " pieces instead of " << j.expected_pieces << " are right, too: " << j.least_pieces << " to "
      << j.most_pieces
      << " are allowed, since the incision may lie beside the path, and pieces or gaps thinner than that may come or "
         "go";
  if (cuts > 1) std::cout << "; score the " << cuts << " cuts one after the other to have each judged more narrowly";
  std::cout << '\n';
}

void print(const Assessment& a, double h, std::size_t cuts) {
  const Judgement& j = a.judgement;
  std::cout << (j.ok ? "ok" : "failed: " + std::string(name_of(j.verdict))) << '\n';
  if (a.read.digits > 0) std::cout << a.read.text() << '\n';
  print_findings(a, cuts);
  for (const std::string& problem : j.problems)
    if (a.findings.empty() || problem != a.findings.front().cause + ": " + a.findings.front().text)
      std::cout << problem << '\n';
  if (!a.measured) return;
  print_why_another_number(j, cuts);
  std::cout << number(a.connected, "%.0f", j.pieces) << " pieces ("
            << number(a.connected && j.expected_pieces > 0, "%.0f", j.expected_pieces) << " expected), incision error "
            << number(a.connected, "%.4g", j.incision_error / h) << " h, area change "
            << number(a.connected, "%.3g", j.area_change) << '\n';
  std::cout << "added: " << more_or_fewer(a.vertices_added, "rest vertices") << ", "
            << more_or_fewer(a.deformed_vertices_added, "deformed vertices") << ", "
            << more_or_fewer(a.triangles_added, "triangles") << '\n';
  print_shapes("all", a.all);
  print_shapes("changed", a.cut);
  std::cout << "forced: " << a.forced_corners << " corners with " << a.corner_triangles << " triangles; "
            << a.wedge_triangles << " triangles in wedges, area " << number(true, "%.4g", a.wedge_area)
            << "; max aspect ratio without corners " << number(a.strict.triangles > 0, "%.4g", a.strict.ar_max)
            << ", without wedges " << number(a.outside_wedges.triangles > 0, "%.4g", a.outside_wedges.ar_max) << '\n';
}

}  // namespace

bool score(const ScoreArguments& arguments, const CutOptions& options) {
  const std::vector<AnyCurve> path = read_path_with_picks(arguments.path);
  MeshData data = read_mesh(arguments.mesh, arguments.reading);
  for (const auto& note : data.notes) std::cerr << "note: " << note << '\n';
  clear_of_seams(data, arguments.mesh, path, arguments.path);
  const bool texture = leaves_vt(arguments.mesh, arguments.reading);
  const MeshReading of_result{texture ? RestFrom::automatic : RestFrom::vt, arguments.reading.triangulate};
  MeshData result = read_mesh_as_is(arguments.result, of_result);
  turn_clockwise_parts(data, result);
  const Sheet before(data);
  const std::vector<Curve> cuts = curves_at_rest(path, before, arguments.path).curves;
  Promises asked = promises_of_everybody;
  if (arguments.deletes) asked = find_method("element_deletion").promises;
  asked.keeps_vertices = arguments.keeps_vertices;
  const Assessment a = assess_result(before, result, cuts, asked, options, arguments.digits);
  const double h = before.mean_edge();
  if (!arguments.report.empty()) WholeFile(arguments.report, score_as_json(a, h)).place();
  if (!arguments.svg.empty()) WholeFile(arguments.svg, result_as_svg(before, result, cuts, a.findings)).place();
  if (arguments.json)
    std::cout << score_as_json(a, h);
  else
    print(a, h, path.size());
  return a.judgement.ok;
}

}  // namespace cutbench
