// `cutbench cut`: cuts a sheet along a path, judges the result and writes it.
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <utility>

#include "experiments/program/commands/command.h"
#include "experiments/program/commands/method_options.h"
#include "experiments/program/commands/misses.h"
#include "experiments/program/drawing.h"
#include "harness/base/errors.h"
#include "harness/base/stop_watch.h"
#include "harness/cut/constraint_source.h"
#include "harness/cut/cut_all.h"
#include "harness/files/mesh_file.h"
#include "harness/files/parents_file.h"
#include "harness/files/path_file.h"
#include "harness/files/texture_file.h"
#include "harness/files/whole_file.h"
#include "harness/judge/assessment.h"
#include "harness/judge/judged_sheet.h"
#include "harness/mesh/winding.h"
#include "harness/path/clear_of_seams.h"
#include "harness/records/context.h"
#include "harness/records/report_json.h"

namespace cutbench {

namespace {

struct CutArguments {
  std::string mesh, path, out, report, parents, picture;
  MethodOptions method;
  Misses misses;
  ReadingOptions reading;
};

/// --out may be the mesh that was read: it is written over. Another file in place of a mesh or path is a mistake.
void check_place(const CutArguments& arguments, const std::string& option, const std::string& file) {
  if (file.empty()) return;
  check_writable(file, option);
  const auto place = [](const std::string& name) { return std::filesystem::weakly_canonical(name); };
  for (const std::string& other : {arguments.mesh, arguments.path, arguments.out})
    if (place(other) == place(file))
      throw InputError(option + " " + file + ": would take the place of " + other + "; give another name");
}

/// What the triangles alone don't say, in a line: none where every vertex has its own unknowns.
void print_constraints(const std::string& method, const Constraints& constraints) {
  if (constraints.empty()) return;
  std::printf("unknowns of %s:", method.c_str());
  const char* separator = " ";
  const auto print_count = [&separator](std::size_t count, const char* what) {
    if (count > 0) std::printf("%s%zu %s", std::exchange(separator, ", "), count, what);
  };
  print_count(constraints.polygons.size(), "polygons of several triangles");
  print_count(constraints.constraints.size(), "vertices that go along with others");
  print_count(constraints.phantoms.size(), "copies of vertices");
  std::printf(" (all in --parents and in a .vtu, none in an .obj)\n");
}

void draw_cut(const Drawing& drawing, const std::string& title, const Sheet& before, const CutDetails& details,
              const std::vector<Curve>& cuts) {
  write_mesh(before.to_mesh_data(), drawing.folder() / "before.obj");
  write_mesh(details.cut.to_mesh_data(), drawing.folder() / "after.obj");
  write_path(cuts, drawing.folder() / "path.json");
  WholeFile(drawing.folder() / "parents.json", details_json(details)).place();
  drawing.make("cut_picture.py", {"--before", "before.obj", "--after", "after.obj", "--path", "path.json", "--parents",
                                  "parents.json", "--title", title});
}

Exit cut_sheet(const CutArguments& arguments) {
  const MethodRow row = arguments.method.row();
  const double parameter = arguments.method.parameter();
  const auto method = row.make(parameter);
  const CutOptions options = arguments.method.chord_tolerance.cut_options();
  check_mesh_place(arguments.out, "--out");
  check_place(arguments, "--report", arguments.report);
  check_place(arguments, "--parents", arguments.parents);
  check_place(arguments, "--picture", arguments.picture);
  std::optional<Drawing> drawing;
  if (!arguments.picture.empty())
    drawing.emplace("--picture", arguments.picture, std::initializer_list<const char*>{".png", ".svg"});
  const auto path = read_path_with_picks(arguments.path);
  MeshData data = read_mesh(arguments.mesh, arguments.reading.reading());
  print_notes(data);
  clear_of_seams(data, arguments.mesh, path, arguments.path);
  const Texture texture = read_texture(arguments.mesh, arguments.reading.reading(), data);

  const Sheet before(data);
  StopWatch watch;
  const auto [cuts, cut_of] = curves_at_rest(path, before, arguments.path);
  const double pick_us = watch.lap();
  for (std::size_t i = 0; i < cuts.size(); ++i)
    arguments.misses.check(before, cuts[i], arguments.path + ", cut " + std::to_string(cut_of[i]));
  Sheet sheet = before;
  Locator locator(sheet);
  Cutter cutter;
  Incisions incisions(before);
  const CutRun run =
      cut_all(sheet, locator, cutter, cuts, *method, options, [&](std::size_t cut) { incisions.add(sheet, cut); });
  if (run.status == Status::refused) throw InputError(row.name + " refuses this cut: " + run.reason);
  if (run.status == Status::failed) {
    std::cerr << "failed (" << run.verdict << "): " << run.reason << '\n';
    return fell_short;
  }
  const Assessment a =
      assess(before, sheet, judge_one_by_one(before, sheet, cuts, row.promises, row.make(parameter), options),
             forced_corners_of(before, cuts));
  const Parents all_parents = parents_of(before, sheet);
  std::vector<IncisionEdge> incision = incisions.edges(sheet, cuts);
  for (IncisionEdge& edge : incision) edge.cut = cut_of[edge.cut];
  MeshData after = sheet.to_mesh_data();
  Texture texture_after = carried_over(texture, before, sheet, all_parents);
  wind_as_read(data, sheet, all_parents, after, texture_after);
  const CutDetails details{
      data, sheet, all_parents, incision, constraints_of(*method, before, sheet), std::move(texture_after)};
  WholeFile out = textured_file(after, details.texture, arguments.out, details_columns(details));
  std::optional<WholeFile> parents;
  if (!arguments.parents.empty()) parents.emplace(arguments.parents, details_json(details));
  if (!arguments.report.empty())
    report_file(arguments.report, row.name, run, pick_us, a, before.mean_edge()).place();  // all, or none
  if (parents) parents->place();
  out.place();
  char worst[32] = "-";  // where no triangle was changed
  if (a.cut.triangles > 0) std::snprintf(worst, sizeof worst, "%.3g", a.cut.ar_max);
  std::printf(
      "%s: %zu triangles crossed, %td %s, %d pieces, max aspect ratio of changed triangles %s, %.1f us wall%s\n",
      name_of(run.status), run.crossed_triangles, std::abs(a.triangles_added),
      a.triangles_added < 0 ? "fewer" : "added", a.judgement.pieces, worst, run.time_us.total(),
      busy_note(load_average()).empty() ? "" : " on a busy machine");
  if (!run.reason.empty()) std::cerr << "note: " << run.reason << '\n';
  print_constraints(row.name, details.constraints);
  if (drawing) draw_cut(*drawing, row.name, before, details, cuts);
  if (a.judgement.ok) return done;
  for (const auto& problem : a.judgement.problems)
    std::cerr << "failed (" << a.judgement.verdict << "): " << problem << '\n';
  return fell_short;
}

}  // namespace

Command add_cut(Options& app) {
  auto arguments = std::make_shared<CutArguments>();
  auto command = app.add_subcommand("cut", "cut a sheet along a path");
  command.add_option("--mesh", arguments->mesh, "the sheet: OBJ, OFF or PLY").required();
  command.add_option("--path", arguments->path, "the path: JSON").required();
  arguments->method.add_to(command);
  arguments->reading.add_to(command);
  arguments->misses.add_to(command);
  command.add_option("--out", arguments->out, "the sheet after the cut: OBJ, OFF or VTU").required();
  command.add_option("--parents", arguments->parents,
                     "JSON: what each vertex and triangle was before, lips, polygons, constraints");
  command.add_option("--picture", arguments->picture,
                     "PNG or SVG: the sheet before and after, and the worst triangle (needs Python with matplotlib)");
  command.add_option("--report", arguments->report, "what was measured, as JSON; none where it is not given");
  command.footer(
      "example:\n"
      "  cutbench cut --mesh experiments/examples/sheet.obj --path experiments/examples/path.json \\\n"
      "    --method warp_and_refine --out cut.obj --report report.json\n"
      "  cutbench cut --mesh sheet.obj --path path.json --command 'python3 mine.py {mesh} {path} {out}' --out cut.obj\n"
      "--parents: all numbers are counted from 0\n"
      "  vertices     [[old, weight], ...] of each: one where it is an old vertex, two on an old edge, else three\n"
      "  triangles    the old one of each\n"
      "  incision     {\"cut\", \"left\": [triangle, from, to], \"right\"} of each edge, along the path\n"
      "  polygons     [triangle, ...] of each element of several triangles\n"
      "  copies       the old vertex of each unknown that is no vertex; they are numbered after the vertices\n"
      "  texture      [[u, v], [u, v], [u, v]] at the corners of each triangle, where the OBJ has vt beside the rest\n"
      "  constraints  [vertex, [[master, weight], ...]] of each vertex that is no unknown\n"
      "exit codes:\n"
      "  0  the result was judged correct and written\n"
      "  1  the cut failed, the result was judged wrong, or a file can't be written\n"
      "  2  bad input: an option or a file, a path that misses the sheet, or a cut that the method refuses");
  return {command, [arguments](const std::string&) { return cut_sheet(*arguments); }};
}

}  // namespace cutbench
