// A case of the robustness run that failed, saved so that a command reproduces it, and a smaller part of it that still
// fails.
#pragma once

#include <filesystem>
#include <string>

#include "harness/processes/isolated.h"
#include "harness/study/robustness/robustness_case.h"
#include "harness/study/robustness/shrink.h"

namespace cutbench {

struct Fault {
  Count::Kind kind = Count::ok;  ///< failed, wrong, crashed or timed_out; ok: none
  std::string verdict, reason;   ///< of a crash: `exception` and its text, or `signal`
  int cut = 0;                   ///< which has it, from 0

  std::string text() const;
  bool same_as(const Fault& o) const { return kind == o.kind && verdict == o.verdict; }
};
Fault fault_of(const CaseResult& result, Fate fate);

/// Cuts the case again, in a process of its own.
Fault try_in_isolation(const Contender& contender, const CutCase& cut_case, const CutOptions& options,
                       double time_limit_s);

struct FailingCase {
  std::string name;   ///< of its files
  std::string title;  ///< says which case it is, one line
  CutCase cut_case;
  Fault fault;
};
/// Writes <name>.obj, .json and .txt, and <name>.small.obj and .small.json, the smallest part that was found in about
/// `shrinking_s` to have the same fault. The text says what is wrong, which command shows it and what that prints. The
/// command judges all cuts of the path at once, the robustness run each of them. Throws InputError: a place that can't
/// be written.
void save(const FailingCase& failing, const std::filesystem::path& folder, const Contender& contender,
          const CutOptions& options, double time_limit_s, double shrinking_s);

}  // namespace cutbench
