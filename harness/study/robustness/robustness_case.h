// One case of the robustness run: the adversarial cuts made one after the other on one sheet, each of them judged.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "harness/cut/cut.h"
#include "harness/study/variant.h"

namespace cutbench {

/// What is counted, in the order of the record's columns: `tried` is the sum of those from `ok` to `timed_out`.
/// Of those, `carefully` is how many were embedded by the careful way instead of the method's own.
struct Count {
  enum Kind {
    tried,
    ok,
    noop,
    deviated,
    refused,
    failed,
    wrong,
    crashed,
    timed_out,
    carefully,
    cases,
    near_event_cases
  };
};
constexpr std::array<const char*, 12> count_names{"tried",     "ok",        "noop",  "deviated",
                                                  "refused",   "failed",    "wrong", "crashed",
                                                  "timed_out", "carefully", "cases", "near_event_cases"};
using Counts = std::array<std::int64_t, count_names.size()>;
/// How many cuts had a fault: none may.
inline std::int64_t faults_in(const Counts& c) {
  return c[Count::failed] + c[Count::wrong] + c[Count::crashed] + c[Count::timed_out];
}

/// A sheet being cut by one contender.
class Subject {
 public:
  virtual ~Subject() = default;
  struct Result {
    Count::Kind outcome = Count::ok;  ///< ok ... wrong; of a program also crashed and timed_out
    std::string verdict, reason;      ///< from refused on
    double us = 0;                    ///< the cut's own time
    bool carefully = false;           ///< CutOutcome::carefully
  };
  virtual Result cut(const Curve& curve) = 0;
};

/// A method with a value of its parameter, or the cross-check.
struct Contender {
  std::string method, parameter;   ///< as in the records
  std::optional<Variant> variant;  ///< none: the cross-check, whose faults do not make the run fail
  std::function<std::unique_ptr<Subject>(const Sheet& start, const CutOptions& options)> start;
};
Contender contender_of(const Variant& variant);
/// CGAL's constrained triangulation of the whole sheet, computed again for every cut.
Contender cgal_check();

/// The result of a case, in memory that is shared between processes. The first fault is kept in full.
struct CaseResult {
  Counts count{};
  double slowest_us = 0;
  std::int32_t cut = 0;           ///< under way; where there is a fault, the one that has it
  Count::Kind fault = Count::ok;  ///< from failed on (crashed: by an exception, or a program); ok: none
  std::array<char, 24> verdict{};
  std::array<char, 400> reason{};
  std::array<char, 400> refusal{};  ///< the last reason
};

/// Makes the cuts and counts their outcomes as it goes. A cut that is refused or fails changes nothing, and the next
/// one follows. The case ends with a cut that is wrong or throws.
void try_case(const Contender& contender, const Sheet& sheet, const std::vector<Curve>& cuts, const CutOptions& options,
              CaseResult& result);

}  // namespace cutbench
