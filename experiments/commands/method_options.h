// Options that several subcommands share: the method, its knob and the chord tolerance.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "harness/cut/cut.h"
#include "methods/registry.h"

namespace cutbench {

struct ChordTolerance {
  std::string text = "0.05";

  void add_to(CLI::App& command, const char* meaning);
  /// Throws InputError: not a positive number.
  CutOptions cut_options() const;
};

struct MethodOptions {
  std::string method;
  std::vector<std::string> settings;  ///< of --set
  ChordTolerance chord_tolerance;

  /// `method` is required where it has no default.
  void add_to(CLI::App& command);
  const MethodRow& row() const { return find_method(method); }
  /// Throws InputError: not the knob of the method, or not a number. The method checks the range.
  double knob() const;
};

/// Notes on what reading the mesh changed, on standard error.
void print_notes(const MeshData& mesh);

}  // namespace cutbench
