// The oracle says the same with Boost's numbers as with GMP's.
#include <gtest/gtest.h>

#include <map>

#include "harness/cases/cut_families.h"
#include "harness/cut/cut_all.h"
#include "harness/judge/oracle_request.h"
#include "harness/mesh/families.h"
#include "methods/registry.h"
#include "tests/oracle_report.h"

namespace cutbench_boost::oracle {

std::string report(const oracle_report::Cut& cut);
std::string report_of_fractions(std::size_t count);

}  // namespace cutbench_boost::oracle

namespace cutbench {
namespace {

oracle_report::Mesh plain(const oracle::Mesh& mesh) { return {mesh.rest, mesh.triangles}; }

oracle_report::Cut cut_of(const oracle::Request& request, const oracle::Mesh& after, double mean_edge) {
  oracle_report::Cut cut{plain(request.before),
                         plain(after),
                         {},
                         request.tolerance,
                         request.snap,
                         request.thin,
                         request.vertex_tolerance,
                         request.keeps_vertices,
                         request.exact_incision,
                         request.keeps_area,
                         mean_edge};
  for (const oracle::Curve& curve : request.cuts) cut.curves.push_back({curve.bezier, curve.closed, curve.points});
  return cut;
}

/// Compares the two reports; returns the verdict.
std::string compare(const oracle_report::Cut& cut) {
  const std::string by_gmp = oracle::report(cut);
  EXPECT_EQ(by_gmp, cutbench_boost::oracle::report(cut));
  return by_gmp.substr(0, by_gmp.find(' '));
}

TEST(OracleByBoost, SaysTheSameOfCuts) {
  std::map<std::string, int> verdicts;
  for (const char* family : sheet_families()) {
    const Sheet before(make_sheet(family, squares_per_side(200)));
    for (const char* kind : cut_families())
      for (std::size_t i = 0; i < 2; ++i)
        for (const char* name : {"conventional_split", "warp_and_refine", "vertex_snap"}) {
          SCOPED_TRACE(std::string(family) + " " + kind + " " + std::to_string(i) + " " + name);
          const MethodRow& row = find_method(name);
          const std::vector<Curve> curves = make_case(kind, 11, i, before);
          Sheet sheet = before;
          Locator locator(sheet);
          Cutter cutter;
          cut_all(sheet, locator, cutter, curves, *row.make(row.parameter.value), {});
          const oracle::Request right = request_for(before, curves, row.promises, {}, true);
          ++verdicts[compare(cut_of(right, for_oracle(sheet), before.mean_edge()))];
          const std::vector<Curve> others = make_case(kind, 12, i, before);  // which nobody made
          const oracle::Request wrong = request_for(before, others, row.promises, {}, true);
          ++verdicts[compare(cut_of(wrong, for_oracle(sheet), before.mean_edge()))];
        }
  }
  EXPECT_GT(verdicts["ok"], 200);
  EXPECT_GT(verdicts["wrong_pieces"], 20);
  EXPECT_GT(verdicts["incision"], 20);
}

TEST(OracleByBoost, RoundsFractionsAlike) {
  EXPECT_EQ(oracle::report_of_fractions(20000), cutbench_boost::oracle::report_of_fractions(20000));
}

}  // namespace
}  // namespace cutbench
