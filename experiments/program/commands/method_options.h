// Options that several subcommands share: the method, its parameter and the chord tolerance.
#pragma once

#include <string>
#include <vector>

#include "experiments/program/options.h"
#include "harness/cut/cut.h"
#include "harness/mesh/rest_choice.h"
#include "harness/programs/program.h"
#include "harness/simulation/scene.h"
#include "methods/registry.h"

namespace cutbench {

struct ChordTolerance {
  std::string text = "0.05";

  void add_to(Options& command, const char* meaning);
  /// Throws InputError: not a positive number.
  CutOptions cut_options() const;
};

struct MethodOptions {
  std::string method;
  std::string command = {};  ///< of a program that cuts instead
  bool deletes = false;      ///< it takes triangles out
  ProgramLimits limits = {};
  Option by_name = {};                     ///< --method; owned by the app
  std::vector<std::string> settings = {};  ///< of --set
  ChordTolerance chord_tolerance;

  void add_to(Options& app);
  /// Throws InputError: no method of that name, none at all, or a command that lacks a file.
  MethodRow row() const;
  /// Throws InputError: not the parameter of the method, or not a number. The method checks the range.
  double parameter() const;
};

/// How mesh files are read.
struct ReadingOptions {
  std::string rest = "auto";
  std::string sew;  ///< empty: not given
  bool triangulate = false;

  void add_to(Options& command);
  MeshReading reading() const;
};

/// Throws InputError: not 2 n^2, or the scene's sheet is read from a file. \param resolution  0: as it is
void set_resolution(Scene& scene, int resolution);

/// Notes on what reading the mesh changed, on standard error.
void print_notes(const MeshData& mesh);

}  // namespace cutbench
