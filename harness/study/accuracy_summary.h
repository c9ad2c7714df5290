// The table printed at the end of an accuracy run: how good and how fast each method was, by solver and budget.
#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "harness/records/record.h"

namespace cutbench {

class AccuracySummary {
 public:
  /// \param row  of accuracy_columns()
  void add(const Record& row);
  bool all_ok() const { return all_ok_; }
  /// To standard output. `minutes`: what each method, by its label(), took in this process with all that is done to
  /// what it made.
  void print(const std::string& title, const std::map<std::string, double>& minutes) const;
  static std::string label(const std::string& method, const std::string& parameter) {
    return method + (parameter.empty() ? "" : " " + parameter);
  }

 private:
  struct Group {
    std::size_t rows = 0, refused = 0, failed = 0;
    std::vector<double> excess, total_us;
  };
  std::vector<std::string> methods_;                                   // in order of appearance
  std::map<std::tuple<std::string, std::string, int>, Group> groups_;  // method, solver (with tip functions), budget
  bool all_ok_ = true;
};

}  // namespace cutbench
