#include "experiments/program/commands/method_options.h"

#include <cmath>
#include <iostream>

#include "harness/base/errors.h"
#include "harness/mesh/families.h"

namespace cutbench {

namespace {

double number(const std::string& text, const std::string& what) {
  std::size_t end = 0;
  double value = 0;
  try {
    value = std::stod(text, &end);
  } catch (const std::exception&) {
    end = std::string::npos;
  }
  if (end != text.size() || std::isnan(value)) throw InputError(what + ": \"" + text + "\" is not a number");
  return value;
}

}  // namespace

void ChordTolerance::add_to(Options& command, const char* meaning) {
  command.add_option("--chord-tolerance", text, meaning).shows_default();
}

CutOptions ChordTolerance::cut_options() const {
  CutOptions options;
  options.chord_tolerance = number(text, "--chord-tolerance");
  if (!(options.chord_tolerance > 0)) throw InputError("--chord-tolerance: must be positive, or inf");
  return options;
}

void MethodOptions::add_to(Options& app) {
  by_name = app.add_option("--method", method, "one of those that `cutbench methods` lists");
  if (!method.empty()) by_name.shows_default();
  app.add_option("--command", command,
                 "a program that cuts instead of a method, such as: python3 mine.py {mesh} {path} {out}")
      .excludes(by_name);
  app.add_flag("--deletes", deletes,
               "the program of --command takes the triangles that the path crosses out, instead of dividing them");
  app.add_option("--command-time-limit", limits.time_s, "of each cut by the program, in seconds")
      .shows_default()
      .positive();
  app.add_option("--command-memory-limit", limits.memory_mb, "of the program, in MB").shows_default().positive();
  app.add_option("--set", settings,
                 "PARAMETER=VALUE of the method; see `cutbench methods` for parameters and defaults");
  chord_tolerance.add_to(
      app,
      "largest distance of the incision from a curved path, in mean rest edges, or inf: a straight piece "
      "from edge to edge");
}

MethodRow MethodOptions::row() const {
  if (!command.empty()) return method_of_program({"program", command, ".", limits, deletes});
  if (deletes) throw InputError("--deletes: says what the program of --command does; leave it out");
  if (method.empty() && !by_name.given())
    throw InputError("give --method NAME, or --command for a program of your own");
  return find_method(method);
}

double MethodOptions::parameter() const {
  const MethodRow m = row();
  double value = m.parameter.value;
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    const std::string name = setting.substr(0, equals);
    if (m.parameter.name.empty()) throw InputError("--set " + setting + ": method \"" + m.name + "\" has no parameter");
    if (equals == std::string::npos || name != m.parameter.name)
      throw InputError("--set " + setting + ": the parameter of \"" + m.name + "\" is set as " + m.parameter.name +
                       "=VALUE");
    value = number(setting.substr(equals + 1), "--set " + name);
  }
  return value;
}

void ReadingOptions::add_to(Options& command) {
  command
      .add_option("--rest", rest,
                  "what the rest shape is: vt (of an OBJ), the plane the mesh lies in, the mesh as it lies in space, "
                  "or auto: the "
                  "first of these that can be")
      .shows_default()
      .one_of({"auto", "vt", "plane", "space"});
  command.add_option(
      "--sew", sew,
      "sew vertices together that are no farther apart in space, in the file's unit; never an incision's");
  command.add_flag("--triangulate", triangulate, "read faces of more than three corners, too, as triangles");
}

MeshReading ReadingOptions::reading() const {
  MeshReading reading{*value_named(rest_names, rest), triangulate};
  if (sew.empty()) return reading;
  reading.sew = number(sew, "--sew");
  if (!(*reading.sew >= 0)) throw InputError("--sew: must be 0 or more");
  return reading;
}

void set_resolution(Scene& scene, int resolution) {
  if (resolution == 0) return;
  squares_per_side(resolution);
  if (scene.mesh) throw InputError("--resolution: this scene's sheet is given; leave the option out");
  scene.resolution = resolution;
}

void print_notes(const MeshData& mesh) {
  for (const auto& note : mesh.notes) std::cerr << "note: " << note << '\n';
}

}  // namespace cutbench
