#include "harness/judge/judgement.h"

#include <stdexcept>

namespace cutbench {

namespace {

/// Both know a verdict by its name.
Verdict verdict_of(oracle::Verdict given) {
  const std::string name = oracle::name_of(given);
  if (const auto verdict = value_named(verdict_names, name)) return *verdict;
  throw std::logic_error("the oracle's verdict \"" + name + "\" has no name in the harness");
}

}  // namespace

Judgement::Judgement(const oracle::Judgement& given)
    : ok(given.ok),
      verdict(verdict_of(given.verdict)),
      problems(given.problems),
      pieces(given.pieces),
      expected_pieces(given.expected_pieces),
      least_pieces(given.least_pieces),
      most_pieces(given.most_pieces),
      incision_error(given.incision_error),
      area_change(given.area_change) {}

}  // namespace cutbench
