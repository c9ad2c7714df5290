// Phantom nodes: linear fields in each part of a triangle, open up to the tip, and no stiffer for little material.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "harness/base/conversions.h"
#include "harness/cut/constraint_source.h"
#include "harness/fem/model/largest_eigenvalue.h"
#include "harness/fem/model/model.h"
#include "harness/mesh/families.h"
#include "harness/mesh/predicates.h"
#include "tests/constrained_cut.h"
#include "tests/dense_constraint_matrix.h"
#include "tests/fem_helpers.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

/// The triangles of each part into which cuts divide a triangle of the sheet, and whether it lies on both sides of an
/// incision: by looking at all triangles.
struct Part {
  std::vector<TriangleIndex> triangles;
  bool slit = false;
};
std::vector<Part> parts_of(const Sheet& before, const Sheet& cut) {
  std::vector<std::size_t> parent(cut.triangle_slots()), number(cut.triangle_slots());
  const auto holds = [&](std::size_t t, Point2 p) {
    const auto c = before.corners(TriangleIndex(t));
    return orientation(c[0], c[1], p) >= 0 && orientation(c[1], c[2], p) >= 0 && orientation(c[2], c[0], p) >= 0;
  };
  for (std::size_t t = 0; t < cut.triangle_slots(); ++t) {
    const auto c = cut.corners(TriangleIndex(t));
    while (!holds(parent[t], 1.0 / 3 * (c[0] + c[1] + c[2]))) ++parent[t];
  }
  std::vector<Part> parts(1);  // 0: none yet
  for (std::size_t t = 0; t < cut.triangle_slots(); ++t) {
    if (number[t] != 0) continue;
    Part part{{TriangleIndex(t)}};
    number[t] = parts.size();
    const auto other_side = [&](std::size_t i, int k) {
      const HalfEdge o = cut.opposite(half_edge(part.triangles[i], k));
      return o.valid() && parent[triangle_of(o)()] == parent[t] ? triangle_of(o) : TriangleIndex();
    };
    for (std::size_t i = 0; i < part.triangles.size(); ++i)
      for (int k = 0; k < 3; ++k)
        if (const TriangleIndex u = other_side(i, k);
            u.valid() && number[u()] == 0 && !cut.separates(half_edge(part.triangles[i], k))) {
          number[u()] = parts.size();
          part.triangles.push_back(u);
        }
    for (std::size_t i = 0; i < part.triangles.size(); ++i)
      for (int k = 0; k < 3; ++k)
        if (const TriangleIndex u = other_side(i, k); u.valid() && cut.separates(half_edge(part.triangles[i], k)))
          part.slit |= number[u()] == parts.size();
    parts.push_back(std::move(part));
  }
  parts.erase(parts.begin());
  return parts;
}

/// The field of random unknowns is linear in every part that is not slit.
TEST(PhantomNode, IsLinearInEachPart) {
  std::size_t checked = 0, slits = 0;
  for_each_constrained_cut({{"phantom_node", 0}}, 9, 3, 641, [&](const ConstrainedCut& cut) {
    const Sheet& sheet = cut.sheet();
    const Eigen::MatrixXd c = dense_constraint_matrix(cut.constraints, sheet.deformed_slots(), 1);
    const Field x = c * Field::Random(c.cols());
    for (const Part& part : parts_of(cut.before, sheet)) {
      slits += part.slit;
      if (part.slit || part.triangles.size() == 1) continue;
      const auto twice_area = [&](TriangleIndex t) {
        const auto p = sheet.corners(t);
        return cross(p[1] - p[0], p[2] - p[0]);
      };
      const TriangleIndex largest =
          *std::max_element(part.triangles.begin(), part.triangles.end(),
                            [&](TriangleIndex a, TriangleIndex b) { return twice_area(a) < twice_area(b); });
      if (twice_area(largest) < 1e-3 * sheet.mean_edge() * sheet.mean_edge()) continue;
      const auto p = sheet.corners(largest);
      for (const TriangleIndex t : part.triangles)
        for (const DeformedIndex d : sheet.triangle(t).deformed) {
          const Point2 at = sheet.rest(sheet.rest_vertex(d));
          double linear = 0;
          for (std::size_t k = 0; k < 3; ++k)
            linear += cross(p[(k + 1) % 3] - at, p[(k + 2) % 3] - at) / twice_area(largest) *
                      x[sheet.triangle(largest).deformed[k].value];
          EXPECT_NEAR(x[d.value], linear, 1e-9);
          ++checked;
        }
    }
  });
  EXPECT_GT(checked, scaled(1000));
  EXPECT_GT(slits, scaled(20));
}

/// A tip that is clear of the edges of its triangle: the lips come apart where they enter it, and only there.
TEST(PhantomNode, OpensUpToTheTip) {
  const Sheet before(make_sheet("grid", 10));
  Table table(make_sheet("grid", 10), find_method("phantom_node:consistent_mass"), 0);
  ASSERT_EQ(table.cut(line({0.225, 0.553}, {0.775, 0.553}), 0.05), "");
  const Sheet& sheet = table.sheet;
  const Constraints constraints = constraints_of(*find_method("phantom_node:consistent_mass").make(0), before, sheet);
  const Eigen::MatrixXd c = dense_constraint_matrix(constraints, sheet.deformed_slots(), 1);
  std::map<VertexIndex, std::set<std::size_t>> copies;
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d) copies[sheet.rest_vertex(DeformedIndex(d))].insert(d);
  std::size_t tips = 0, open = 0;
  for (const auto& [vertex, lips] : copies) {
    if (sheet.rest(vertex).y != 0.553) continue;
    if (lips.size() == 1) {
      ++tips;
      continue;
    }
    ASSERT_EQ(lips.size(), 2u);
    const auto a = to_index(*lips.begin()), b = to_index(*lips.rbegin());
    EXPECT_GT((c.row(a) - c.row(b)).cwiseAbs().maxCoeff(), 0.01) << sheet.rest(vertex).x;
    ++open;
  }
  EXPECT_EQ(tips, 2u);
  EXPECT_GE(open, 10u);
}

/// All that stands for a mass.
double area_of_masses(const Sheet& sheet, const Constraints& constraints) {
  Model<2> model(sheet, {.density = 1}, {.dimension = 2, .bending = BendingKind::none}, {}, {});
  model.constrain(sheet, constraints);
  return model.lumped_mass().sum();
}

/// However little material a part has. (A slit part may be stiffer, as far as most_stiffness lets it; pieces smaller
/// than a triangle have no neighbour for a penalty.)
TEST(PhantomNode, VariantsBoundTheEigenvalue) {
  double worst = 0;
  for (const std::string family : sheet_families())
    for (const std::string cuts : {"straight", "curved", "partial"})
      for (std::size_t i = 0; i < scaled(4); ++i) {
        SCOPED_TRACE(family + ", " + cuts + " " + std::to_string(i));
        const ConstrainedCut cut(family, 16, {"phantom_node:consistent_mass", 0.1}, cuts, 641, i);
        const double whole = largest_eigenvalue(cut.before);
        EXPECT_LE(largest_eigenvalue(cut.sheet(), cut.constraints), (cuts == "partial" ? 5 : 1.5) * whole);
        const Constraints plain = constraints_of(*find_method("phantom_node:consistent_mass").make(0), cut.before,
                                                 cut.sheet()),
                          lumped = constraints_of(*find_method("phantom_node").make(0), cut.before, cut.sheet());
        worst = std::max(worst, largest_eigenvalue(cut.sheet(), plain) / whole);
        EXPECT_NEAR(area_of_masses(cut.sheet(), lumped), 1, 1e-12);
        EXPECT_LE(largest_eigenvalue(cut.sheet(), lumped), 3 * whole);
      }
  EXPECT_GE(worst, 200);
}

}  // namespace
}  // namespace cutbench
