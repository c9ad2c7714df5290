// What tests of bending share: fields and energies on a sheet, equilibrium, and sheets that are cut. Their definitions
// are apart: Eigen's sparse solvers take long to compile.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "harness/fem/elements/bending.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

constexpr double rigidity = 0.7, poisson = 0.3;

Bending patches(const Sheet& sheet);
Bending hinges(const Sheet& sheet);

/// One value per deformed vertex; 0 where it was freed.
Field sampled(const Sheet& sheet, const std::function<double(Point2)>& f);
Field cylinder(const Sheet& sheet, double degrees, double curvature);
double form(const BlockMatrix<1>& k, const Field& x);

/// Free values in equilibrium with the load, the others as in `held_at`.
Field equilibrium(const Sheet& sheet, const BlockMatrix<1>& k, const std::vector<bool>& held, const Field& held_at,
                  Field load);

template <class F>
void for_each_triangle(const Sheet& sheet, F f) {
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    if (sheet.triangle(TriangleIndex(t)).alive()) f(sheet.triangle(TriangleIndex(t)), sheet.corners(TriangleIndex(t)));
}

double area(const std::array<Point2, 3>& c);
double smallest_altitude(const Sheet& sheet);

/// A sheet, and what was done to it.
struct Cut {
  std::string name, method;
  Sheet sheet;
};

std::vector<Cut> cut_sheets(int n, std::size_t cases);

}  // namespace cutbench
