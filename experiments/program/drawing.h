// Pictures that a command leaves beside its results, drawn by the scripts of plots/figures/take_home.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <vector>

#include "harness/processes/subprocess.h"

namespace cutbench {

class Drawing {
 public:
  /// Before the work: finds a Python that has what is needed, $CUTBENCH_PYTHON or python3, and the scripts, in
  /// $CUTBENCH_PLOTS or beside the program, installed or in the tree. \param option  begins every error
  /// \throw InputError: another extension than these, a place that can't be written, no such Python, no scripts.
  Drawing(const std::string& option, const std::filesystem::path& out, std::initializer_list<const char*> extensions);
  /// The folder for what the script reads; gone in the end.
  const std::filesystem::path& folder() const { return folder_.path(); }
  /// Runs the script there with these arguments and `--out`, and puts the picture in its place. \throw OutputError
  void make(const std::string& script, const std::vector<std::string>& arguments) const;

 private:
  TemporaryFolder folder_;
  std::string option_, python_;
  std::filesystem::path out_, scripts_;
};

}  // namespace cutbench
