// What tests of multigrid and of its parts share: the system of a sheet after cuts.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "harness/fem/multigrid/level_rows.h"
#include "harness/mesh/families.h"
#include "tests/fem_helpers.h"

namespace cutbench {

inline const Material skin{.density = 2.2, .stiffness = 1000, .poisson = 0.45, .bending = 4.2e-4};

inline std::vector<Pin> held_left() {
  Pin pin;
  pin.where = {{-1, -1}, {1e-9, 2}};
  return {pin};
}

/// A sheet after a cut right through and one that ends inside, pulled out of its plane, with the matrix of a step.
template <int D>
Body<D> cut_body(const std::string& family, int n, BendingKind bending, const std::string& method) {
  Body<D> body(make_sheet(family, n), skin, {.bending = bending}, held_left());
  EXPECT_EQ(body.cut(line({-0.1, 0.313}, {1.1, 0.741}), method), Status::ok);
  EXPECT_EQ(body.cut(line({0.31, 0.1}, {0.52, 0.57}), method), Status::ok);
  body.model.rotate(bent(body.model, body.sheet));
  body.model.assemble(1, 1e-3);
  return body;
}

inline LevelRows rows_of(const BlockMatrix<2>& a) {
  LevelRows rows;
  rows.resize(a.rows());
  for (std::size_t i = 0; i < a.rows(); ++i) rows.blocks.set(i, a.columns(i));
  return rows;
}

}  // namespace cutbench
