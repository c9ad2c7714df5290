#include "experiments/program/drawing.h"

#include <algorithm>
#include <cstdlib>

#include "harness/base/errors.h"
#include "harness/base/names.h"
#include "harness/files/whole_file.h"

namespace cutbench {

namespace {

constexpr ProgramLimits limits{.time_s = 3600, .memory_mb = 4096};

/// The first that has what the scripts import, as a word for the shell; empty where none has.
std::string python_that_draws(const std::filesystem::path& folder) {
  const char* const given = std::getenv("CUTBENCH_PYTHON");
  const std::vector<std::string> known{"python3", "/usr/bin/python3"};
  for (const std::string& python : given ? std::vector{quoted(given)} : known)
    if (run_program(python + " -c 'import matplotlib, numpy, PIL'", folder, limits).succeeded()) return python;
  return {};
}

/// The folder plots/figures/take_home; empty where it is nowhere.
std::filesystem::path find_scripts() {
  std::vector<std::filesystem::path> places;
  if (const char* const given = std::getenv("CUTBENCH_PLOTS")) places.emplace_back(given);
  std::error_code error;
  const std::filesystem::path beside = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  places.push_back(beside / "../share/cutbench/plots");
  places.push_back(beside / "../../plots");
  for (const auto& place : places)
    if (std::filesystem::is_regular_file(place / "figures/take_home/cut_picture.py", error))
      return std::filesystem::canonical(place / "figures/take_home", error);
  return {};
}

}  // namespace

Drawing::Drawing(const std::string& option, const std::filesystem::path& out,
                 std::initializer_list<const char*> extensions)
    : option_(option + " " + out.string() + ": "),
      python_(python_that_draws(folder_.path())),
      out_(out),
      scripts_(find_scripts()) {
  const std::vector<std::string> known(extensions.begin(), extensions.end());
  if (std::find(known.begin(), known.end(), out.extension().string()) == known.end())
    throw InputError(option_ + "unknown format of a picture; use " + listed(known));
  check_writable(out, option);
  if (python_.empty())
    throw InputError(option_ +
                     "python3 with numpy, matplotlib and Pillow draws it, and is not here; "
                     "apt-get install python3-matplotlib python3-pil");
  if (scripts_.empty())
    throw InputError(option_ +
                     "the scripts that draw are not beside this program; "
                     "set CUTBENCH_PLOTS to the folder plots/ of cutbench");
}

void Drawing::make(const std::string& script, const std::vector<std::string>& arguments) const {
  const std::filesystem::path picture = folder_.path() / ("picture" + out_.extension().string());
  std::string command = "exec " + python_ + " " + quoted((scripts_ / script).string());
  for (const std::string& argument : arguments) command += " " + quoted(argument);
  const ProgramEnd end = run_program(command + " --out " + quoted(picture.string()), folder_.path(), limits);
  if (!end.succeeded()) throw OutputError(option_ + script + ": " + end.text());
  WholeFile(out_, text_of(picture)).place();
}

}  // namespace cutbench
