// `cutbench reduce`: a cut that goes wrong, made as small as it can be and still go wrong: for a report of the fault.
#include <filesystem>
#include <iostream>
#include <memory>

#include "experiments/program/commands/command.h"
#include "experiments/program/commands/method_options.h"
#include "harness/base/conversions.h"
#include "harness/base/errors.h"
#include "harness/files/mesh_file.h"
#include "harness/files/path_file.h"
#include "harness/files/whole_file.h"
#include "harness/judge/result_svg.h"
#include "harness/study/robustness/failing_case.h"

namespace cutbench {

namespace {

struct ReduceArguments {
  std::string mesh, path, out;
  double seconds = 60;
  MethodOptions method;
};

Exit reduce(const ReduceArguments& arguments) {
  const auto row = std::make_shared<const MethodRow>(arguments.method.row());
  const Contender contender = contender_of({row, arguments.method.parameter()});
  const CutOptions options = arguments.method.chord_tolerance.cut_options();
  const std::filesystem::path stem = arguments.out;
  for (const char* extension : {".obj", ".json", ".txt", ".svg"}) check_writable(arguments.out + extension, "--out");
  const CutCase whole{read_mesh(arguments.mesh), read_path(arguments.path)};
  print_notes(whole.mesh);
  const double time_limit_s = 2 * arguments.method.limits.time_s * to_double(whole.cuts.size());
  const Fault fault = try_in_isolation(contender, whole, options, time_limit_s);
  if (fault.kind == Count::ok) throw InputError("nothing to reduce: " + row->name + " cuts this sheet right");
  const auto folder = stem.has_parent_path() ? stem.parent_path() : std::filesystem::path(".");
  const std::string name = stem.filename().string();
  save({name, arguments.mesh + ", " + arguments.path + " by " + row->name, whole, fault}, folder, contender, options,
       time_limit_s, arguments.seconds);
  const std::string small = (folder / (name + ".small")).string();
  const CutCase part{read_mesh(small + ".obj"), read_path(small + ".json")};
  const std::string text = try_in_isolation(contender, part, options, time_limit_s).text();
  const Finding finding{"reduced", text.substr(0, text.find('\n')), "", {}};
  WholeFile(small + ".svg", result_as_svg(Sheet(part.mesh), {}, part.cuts, {&finding, 1})).place();
  std::cout << text_of(folder / (name + ".txt")) << small << ".svg: a drawing\n";
  return done;
}

}  // namespace

Command add_reduce(Options& app) {
  auto arguments = std::make_shared<ReduceArguments>();
  auto command = app.add_subcommand("reduce", "make a cut that goes wrong small, for a report of the fault");
  command.add_option("--mesh", arguments->mesh, "the sheet: OBJ, OFF or PLY").required();
  command.add_option("--path", arguments->path, "the path: JSON, in rest space").required();
  arguments->method.add_to(command);
  command
      .add_option("--out", arguments->out,
                  "where to write NAME.obj, .json and .txt, and the smaller NAME.small.obj, .json and .svg")
      .required();
  command.add_option("--seconds", arguments->seconds, "about so long smaller ones are tried")
      .shows_default()
      .positive();
  command.footer(
      "example:\n"
      "  cutbench reduce --mesh sheet.obj --path path.json --command 'python3 mine.py {mesh} {path} {out}' --out "
      "fault\n"
      "exit codes:\n"
      "  0  done\n"
      "  1  a file can't be written\n"
      "  2  bad input: an option or a file, or a cut that goes right");
  return {command, [arguments](const std::string&) { return reduce(*arguments); }};
}

}  // namespace cutbench
