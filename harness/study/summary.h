// The table printed at the end of a run, for people who never open a plot.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace cutbench {

class Summary {
 public:
  /// One measured cut. Negative: not measured.
  struct Cut {
    bool ok = true, refused = false;
    double crossed_triangles = -1, vertices_added = -1, ar_max_cut = -1, over_3_cut = -1, geometry_us = -1;
  };
  void add(int resolution, const std::string& method, const std::string& parameter, const Cut& cut);
  void add_failure() { ++failed_; }  ///< of something that is not in the table
  bool all_ok() const { return failed_ == 0; }
  /// To standard output: medians over sheets, cases and repetitions.
  void print(const std::string& title) const;

 private:
  std::map<std::tuple<int, std::string, std::string>, std::vector<Cut>> cuts_;
  std::size_t failed_ = 0;
};

}  // namespace cutbench
