// What tests of methods that tie vertices or make polygons share: a sheet that such a method has cut.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "harness/cases/cut_families.h"
#include "harness/mesh/families.h"
#include "methods/registry.h"
#include "tests/helpers.h"

namespace cutbench {

struct TyingMethod {
  std::string name;
  double knob;
  std::unique_ptr<CuttingMethod> make() const { return find_method(name).make(knob); }
};

struct TiedCut {
  TiedCut(const std::string& family, int n, const TyingMethod& method, const std::string& cuts, std::uint64_t seed,
          std::size_t number)
      : before(make_sheet(family, n)), table(make_sheet(family, n), find_method(method.name), method.knob) {
    for (const Curve& curve : make_case(cuts, seed, number, before)) EXPECT_EQ(table.cut(curve, 0.05), "");
    ties = method.make()->ties(before, table.sheet);
  }
  const Sheet& sheet() const { return table.sheet; }

  Sheet before;
  Table table;
  Ties ties;
};

inline const std::vector<TyingMethod> tying_methods{{"split_and_tie", 0.1}, {"phantom_node", 0}, {"phantom_node", 0.1}};
inline const TyingMethod cut_polygons{"cut_polygons", 0.7};

/// `cases` cuts of each kind by each method; the families of sheets take turns.
template <class Visit>
void for_each_tied_cut(const std::vector<TyingMethod>& methods, int n, std::size_t cases, std::uint64_t seed,
                       Visit visit) {
  std::size_t turn = 0;
  for (const TyingMethod& method : methods)
    for (const std::string cuts : {"straight", "curved", "partial", "cut_out", "recut", "several", "self_crossing",
                                   "tiny_loop", "u_turn", "through_vertices", "along_edges"})
      for (const std::string& family : families_in_turn(turn))
        for (std::size_t i = 0; i < scaled(cases); ++i) {
          SCOPED_TRACE(method.name + " " + std::to_string(method.knob) + ", " + family + ", " + cuts + " " +
                       std::to_string(i));
          visit(TiedCut(family, n, method, cuts, seed, i));
        }
}

}  // namespace cutbench
