// What tests of methods that constraint vertices or make polygons share: a sheet that such a method has cut.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "harness/cases/cut_families.h"
#include "harness/cut/constraint_source.h"
#include "harness/fem/model/model.h"
#include "harness/mesh/families.h"
#include "methods/registry.h"
#include "tests/helpers.h"

namespace cutbench {

struct ConstrainingMethod {
  std::string name;
  double parameter;
  std::unique_ptr<CuttingMethod> make() const { return find_method(name).make(parameter); }
};

struct ConstrainedCut {
  ConstrainedCut(const std::string& family, int n, const ConstrainingMethod& method, const std::string& cuts,
                 std::uint64_t seed, std::size_t number)
      : before(make_sheet(family, n)), table(make_sheet(family, n), find_method(method.name), method.parameter) {
    for (const Curve& curve : make_case(cuts, seed, number, before)) EXPECT_EQ(table.cut(curve, 0.05), "");
    constraints = constraints_of(*method.make(), before, table.sheet);
  }
  const Sheet& sheet() const { return table.sheet; }

  Sheet before;
  Table table;
  Constraints constraints;
};

inline const std::vector<ConstrainingMethod> constraining_methods{{"split_and_tie", 0.1},
                                                                  {"phantom_node", 0},
                                                                  {"phantom_node:consistent_mass", 0},
                                                                  {"phantom_node:consistent_mass", 0.1},
                                                                  {"virtual_node", 0}};
inline const ConstrainingMethod cut_polygons{"cut_polygons", 0.7};

/// `cases` cuts of each kind by each method; the families of sheets take turns.
template <class Visit>
void for_each_constrained_cut(const std::vector<ConstrainingMethod>& methods, int n, std::size_t cases,
                              std::uint64_t seed, Visit visit) {
  std::size_t turn = 0;
  for (const ConstrainingMethod& method : methods)
    for (const std::string cuts : {"straight", "curved", "partial", "cut_out", "recut", "several", "self_crossing",
                                   "tiny_loop", "u_turn", "through_vertices", "along_edges"})
      for (const std::string& family : families_in_turn(turn))
        for (std::size_t i = 0; i < scaled(cases); ++i) {
          SCOPED_TRACE(method.name + " " + std::to_string(method.parameter) + ", " + family + ", " + cuts + " " +
                       std::to_string(i));
          visit(ConstrainedCut(family, n, method, cuts, seed, i));
        }
}

/// The numbers that a model which has followed cuts has for those of a fresh one: phantom nodes have room before them.
struct NumbersOf {
  const Model<3>&followed, &fresh;
  bool is_spare(std::size_t v) const { return v >= fresh.first_phantom() && v < followed.first_phantom(); }
  std::size_t in_fresh(std::size_t v) const {
    return v < followed.first_phantom() ? v : v - followed.first_phantom() + fresh.first_phantom();
  }
};

template <int D>
void expect_same(const BlockMatrix<D>& followed, const BlockMatrix<D>& fresh, const NumbersOf& numbers, double limit) {
  const double most = limit * max_entry(fresh);
  for (std::size_t v = 0; v < followed.rows(); ++v) {
    if (numbers.is_spare(v)) {
      EXPECT_TRUE(followed.columns(v).empty());
      continue;
    }
    const std::size_t row = numbers.in_fresh(v);
    ASSERT_EQ(followed.columns(v).size(), fresh.columns(row).size());
    std::int32_t slot = followed.first_slot(v);
    for (const std::int32_t j : followed.columns(v)) {
      const std::int32_t other = fresh.find(row, to_int32(numbers.in_fresh(to_size(j))));
      ASSERT_GE(other, 0);
      EXPECT_LE((followed.block(slot++) - fresh.block(other)).cwiseAbs().maxCoeff(), most);
    }
  }
}

}  // namespace cutbench
