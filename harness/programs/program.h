// A cutting method that is a program of its own, in any language: it reads the sheet and the path from files and writes
// the opened sheet to a file. docs/how-to/a_program_as_a_method.md says what the files hold.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "harness/cut/cut.h"
#include "harness/cut/method_row.h"
#include "harness/mesh/mesh_data.h"
#include "harness/processes/subprocess.h"

namespace cutbench {

struct ProgramSettings {
  std::string name;              ///< of the method in records and figures: letters, digits, `_`, `-`, `.` and `:`
  std::string command;           ///< for /bin/sh, with {mesh}, {path} and {out}, and {time} where it reports its own
  std::filesystem::path folder;  ///< where it runs
  ProgramLimits limits;
  bool deletes = false;  ///< it takes the triangles that the path crosses out, instead of dividing them
};

/// What every program promises, as `cutbench score` asks of it: the path is opened up to the chord tolerance, the area
/// stays, the result is conforming. Vertices may move.
constexpr Promises promises_of_programs{.keeps_area = true, .conforming = true};
/// And one that deletes, as `cutbench score --deletes` asks: those of the method element_deletion.
constexpr Promises promises_of_deleting_programs{.conforming = true, .incision_bound = {.longest_edges = 1}};

/// A row of the table of methods. A cut is the program's alone, as it stands in the file, once the oracle has accepted
/// it. Else the cut has failed, with the oracle's verdict, or `crashed` (it ended by a signal or with another exit code
/// than 0 and 3), `timed_out`, or `no_result` (there is no file, or one that can't be read). Exit code 3 refuses the
/// cut. The last line that the program wrote to standard error is the reason.
/// Throws InputError: a name with other letters, a command without one of the three files, or a folder that is not
/// there.
MethodRow method_of_program(const ProgramSettings& settings);

/// By this exit code a program refuses a cut. Not 2, by which interpreters say that they can't open a script.
constexpr int exit_refused = 3;

/// What a program does with its result, for whoever makes results in this process: the sheet takes `result` over, as
/// adopt() does, once the oracle accepts it as `cutbench score` would. Throws CutFailed with the oracle's verdict and
/// the mend, and CutRefused. \pre begin_cut()
/// \param deletes  see ProgramSettings
void take_over(Sheet& sheet, Subdivision& trace, const MeshData& result, const Curve& curve, const CutOptions& options,
               bool deletes = false);

/// The command and what it runs, for telling one version of a program from another: names, sizes and times of the files
/// that the command names.
std::string fingerprint_of_program(const ProgramSettings& settings);

}  // namespace cutbench
