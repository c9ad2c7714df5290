// What tests of problems with exact answers share.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "harness/cut/cut.h"
#include "harness/problems/common/problem.h"
#include "methods/registry.h"

namespace cutbench {

/// The specimen's sheet with its cuts made, or the mesh fitted to them ("body_fitted", "graded_at_tips").
inline Sheet cut_by(const Specimen& specimen, const std::string& method, double parameter = 0) {
  if (method == "body_fitted") return body_fitted(specimen);
  if (method == "graded_at_tips") return graded_at_tips(specimen);
  Sheet sheet(specimen.mesh);
  Locator locator(sheet);
  const auto tool = find_method(method).make(parameter);
  for (const Curve& cut : specimen.cuts)
    EXPECT_EQ(Cutter().cut(sheet, locator, cut, *tool, {}).status, Status::ok) << method;
  return sheet;
}

inline Answer solved(const Problem& problem, const Specimen& specimen, const Sheet& sheet) {
  const Budget direct;
  Answer answer = problem.answer(specimen, sheet, {&direct, 1}).front();
  EXPECT_EQ(answer.verdict, Verdict::ok) << answer.reason;
  return answer;
}

inline const Measure& measure_of(const Answer& answer, const std::string& name) {
  for (const Measure& measure : answer.measures)
    if (measure.name == name) return measure;
  throw std::out_of_range(name);
}

}  // namespace cutbench
