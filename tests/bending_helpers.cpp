#include "tests/bending_helpers.h"

#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/mesh/families.h"
#include "methods/registry.h"
#include "tests/helpers.h"

namespace cutbench {

Bending patches(const Sheet& sheet) { return {sheet, BendingKind::patches, rigidity, poisson}; }
Bending hinges(const Sheet& sheet) { return {sheet, BendingKind::hinges, rigidity, poisson}; }

Field sampled(const Sheet& sheet, const std::function<double(Point2)>& f) {
  Field values = Field::Zero(to_index(sheet.deformed_slots()));
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d)
    if (const VertexIndex v = sheet.rest_vertex(DeformedIndex(d)); v.valid()) values[to_index(d)] = f(sheet.rest(v));
  return values;
}

Field cylinder(const Sheet& sheet, double degrees, double curvature) {
  const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
  return sampled(sheet, [=](Point2 p) { return curvature / 2 * std::pow(c * p.y - s * p.x, 2); });
}

double form(const BlockMatrix<1>& k, const Field& x) {
  Field y = Field::Zero(x.size());
  k.add_product(1, x, y);
  return x.dot(y) / 2;
}

Field equilibrium(const Sheet& sheet, const BlockMatrix<1>& k, const std::vector<bool>& held, const Field& held_at,
                  Field load) {
  std::vector<int> unknown(held.size(), -1);
  int n = 0;
  for (std::size_t d = 0; d < held.size(); ++d)
    if (!held[d] && sheet.rest_vertex(DeformedIndex(d)).valid()) unknown[d] = n++;
  Field x = held_at;
  for (std::size_t d = 0; d < held.size(); ++d)
    if (unknown[d] >= 0) x[to_index(d)] = 0;
  k.add_product(-1, x, load);
  std::vector<Eigen::Triplet<double>> entries;
  Field right = Field::Zero(n);
  for (std::size_t i = 0; i < k.rows(); ++i) {
    if (unknown[i] < 0) continue;
    right[unknown[i]] = load[to_index(i)];
    for (const std::int32_t j : k.columns(i))
      if (const int column = unknown[to_size(j)]; column >= 0)
        entries.emplace_back(unknown[i], column, k.block(k.find(i, j))(0));
  }
  Eigen::SparseMatrix<double> reduced(n, n);
  reduced.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(reduced);
  EXPECT_EQ(factor.info(), Eigen::Success);
  const Field solution = factor.solve(right);
  for (std::size_t d = 0; d < held.size(); ++d)
    if (unknown[d] >= 0) x[to_index(d)] = solution[unknown[d]];
  return x;
}

double area(const std::array<Point2, 3>& c) { return cross(c[1] - c[0], c[2] - c[0]) / 2; }

double smallest_altitude(const Sheet& sheet) {
  double smallest = infinite;
  for_each_triangle(sheet, [&](const Triangle&, const auto& c) {
    for (std::size_t k = 0; k < 3; ++k)
      smallest = std::min(smallest, 2 * area(c) / std::sqrt(squared_length(c[(k + 1) % 3] - c[k])));
  });
  return smallest / sheet.mean_edge();
}

std::vector<Cut> cut_sheets(int n, std::size_t cases) {
  std::vector<Cut> result;
  for (const MethodRow& row : whole_sheet_methods())
    for (const std::string family : sheet_families())
      for (const std::string kind : cut_families())
        for (std::size_t i = 0; i < cases; ++i) {
          Cut cut{row.name + ", " + family + ", " + kind + " " + std::to_string(i), row.name,
                  Sheet(make_sheet(family, n))};
          Locator locator(cut.sheet);
          Cutter cutter;
          const auto method = row.make(row.parameter.value);
          for (const Curve& curve : make_case(kind, 90, i, cut.sheet))
            cutter.cut(cut.sheet, locator, curve, *method, {});
          result.push_back(std::move(cut));
        }
  return result;
}

}  // namespace cutbench
