// Bending that was updated, after any history of cuts and edits, against one made anew.

#include <gtest/gtest.h>

#include <Eigen/SVD>
#include <cmath>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/cut/open.h"
#include "harness/fem/elements/bending.h"
#include "harness/fem/model/state.h"
#include "harness/mesh/families.h"
#include "methods/registry.h"
#include "tests/dense_solves.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

constexpr double rigidity = 0.7, poisson = 0.3;

void expect_like_new(const Sheet& sheet, const Bending& updated, BendingKind kind) {
  const Bending fresh(sheet, kind, rigidity, poisson);
  EXPECT_EQ(updated.matrix().rows(), fresh.matrix().rows());
  EXPECT_EQ(updated.matrix().block_count(), fresh.matrix().block_count());
  EXPECT_LE(max_difference(updated.matrix(), fresh.matrix()), 1e-12 * max_entry(fresh.matrix()));
}

/// A sheet that is bent and stretched.
State bent_state(const Sheet& sheet) {
  State state;
  state.x = Field::Zero(to_index(3 * sheet.deformed_slots()));
  for (std::size_t v = 0; v < sheet.deformed_slots(); ++v) {
    const auto [a, b] = sheet.rest(sheet.rest_vertex(DeformedIndex(v)));
    state.x.segment<3>(to_index(3 * v)) << 1.1 * a + 0.1 * b, b, 0.3 * std::sin(3 * a) * std::cos(2 * b);
  }
  state.v = state.anchor = state.x;
  return state;
}

/// update(), which has to know by how much the energy changed.
void update_and_expect_change(const Sheet& sheet, State& state, Bending& bending) {
  const Field before = state.x;
  const double energy_before = bending.energy(before, 3);
  transfer(sheet.log(), sheet.deformed_slots(), 3, state);
  const PlacesAtCut places{before, state.x};
  const double change = bending.update(sheet, nullptr, {}, &places), energy = bending.energy(state.x, 3);
  EXPECT_NEAR(change, energy - energy_before, 1e-11 * (energy + energy_before));
}

TEST(BendingUpdate, IsLikeNewAfterEveryKindOfCut) {
  std::size_t turn = 0;  // not every family for every method and kind: these take turns
  for (const MethodRow& row : all_methods()) {
    ++turn;
    for (const BendingKind kind : {BendingKind::patches, BendingKind::hinges}) {
      if (is_small_scale() && (kind == BendingKind::hinges) == (turn % 2 == 0)) continue;
      const std::string family =
          sheet_families()[(turn + (turn / 4) + (kind == BendingKind::hinges)) % sheet_families().size()];
      Sheet sheet(make_sheet(family, 8));
      Bending bending(sheet, kind, rigidity, poisson);
      State state = bent_state(sheet);
      Locator locator(sheet);
      Cutter cutter;
      const auto method = row.make(row.parameter.value);
      for (const std::string cut : cut_families())
        for (const Curve& curve : make_case(cut, 92, 1, sheet)) {
          SCOPED_TRACE(row.name + ", " + family + ", " + cut);
          const CutOutcome outcome = cutter.cut(sheet, locator, curve, *method, {});
          if (outcome.status != Status::ok) continue;
          update_and_expect_change(sheet, state, bending);
          expect_like_new(sheet, bending, kind);
        }
    }
  }
}

/// Splits, flips, moves, collapses and openings at random, many between two updates, so that slots are freed and used
/// again.
TEST(BendingUpdate, IsLikeNewAfterStormsOfEdits) {
  for (std::size_t i = 0; i < scaled(12); ++i) {
    const BendingKind kind = i % 3 == 2 ? BendingKind::hinges : BendingKind::patches;
    Random random(500 + i);
    Sheet sheet(make_sheet(sheet_families()[i % 4], 6));
    Bending bending(sheet, kind, rigidity, poisson);
    for (int cut = 0; cut < 12; ++cut) {
      sheet.begin_cut();
      for (std::size_t edits = random.below(12); edits-- > 0;) {
        const HalfEdge h = any_half_edge(sheet, random);
        const VertexIndex v = sheet.origin(h);
        const auto c = sheet.corners(triangle_of(h));
        switch (random.below(6)) {
          case 0:
            sheet.split_triangle(triangle_of(h), 0.4 * c[0] + (0.3 * c[1] + 0.3 * c[2]));
            break;
          case 1:
            sheet.flip(h);
            break;
          case 2:
            if (const double step = 0.2 * std::sqrt(squared_length(c[1] - c[0]));
                !sheet.on_border(sheet.first_outgoing(v)))
              sheet.move(v, sheet.rest(v) + step * random.direction());
            break;
          case 3:
          case 4:
            sheet.collapse(h);
            break;
          default:
            if (sheet.mark(h) == EdgeMark::none) sheet.set_mark(h, EdgeMark::path);
        }
      }
      open_path(sheet);
      ASSERT_EQ(faults(sheet), "");
      if (random.coin(0.2)) {
        sheet.rollback();  // and no update
      } else {
        bending.update(sheet);
      }
      SCOPED_TRACE(std::to_string(i) + ", cut " + std::to_string(cut));
      expect_like_new(sheet, bending, kind);
    }
  }
}

/// Rows of the matrix against the energy, which is summed from the stencils: K_ij = E(e_i + e_j) - E(e_i) - E(e_j).
TEST(BendingUpdate, RowsAreTheSecondDerivativeOfTheEnergy) {
  for (const BendingKind kind : {BendingKind::patches, BendingKind::hinges}) {
    Sheet sheet(make_sheet("delaunay", 5));
    Bending bending(sheet, kind, rigidity, poisson);
    Locator locator(sheet);
    const auto method = find_method("conventional_split").make(0);
    Cutter().cut(sheet, locator, {Curve::Kind::polyline, false, {{0.2, 0.3}, {0.7, 0.61}}}, *method, {});
    bending.update(sheet);
    const auto n = to_index(sheet.deformed_slots());
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n, n), expected = k;
    for (std::size_t i = 0; i < sheet.deformed_slots(); ++i)
      for (const auto j : bending.matrix().columns(i))
        k(to_index(i), j) = bending.matrix().block(bending.matrix().find(i, j))(0);
    Field x = Field::Zero(n);
    const auto energy = [&](Eigen::Index i, Eigen::Index j) {
      x[i] += 1;
      x[j] += 1;
      const double e = bending.energy(x, 1);
      x[i] = x[j] = 0;
      return e;
    };
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j) expected(i, j) = energy(i, j) - energy(i, i) / 4 - energy(j, j) / 4;
    EXPECT_LE((k - expected).cwiseAbs().maxCoeff(), 1e-12 * k.cwiseAbs().maxCoeff());
  }
}

/// Slopes of the patches against a weighted least-squares fit by singular values, where that determines a quadratic.
TEST(SlopePatch, IsALeastSquaresFit) {
  std::size_t fitted = 0;
  for (const std::string family : sheet_families()) {
    Sheet sheet(make_sheet(family, 8));
    Locator locator(sheet);
    const auto method = find_method("conventional_split").make(0);
    Cutter().cut(sheet, locator, {Curve::Kind::polyline, false, {{0.2, 0.3}, {0.7, 0.61}}}, *method, {});
    SlopePatch patch;
    for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
      if (!sheet.triangle(TriangleIndex(t)).alive()) continue;
      patch.fit(sheet, nullptr, TriangleIndex(t));
      const auto c = sheet.corners(TriangleIndex(t));
      const auto terms = patch.terms(c);
      const Point2 centre = 1.0 / 3 * (c[0] + c[1] + c[2]);
      const double unit = std::sqrt(squared_length(c[1] - c[0]));
      double corners = 0;
      for (const Point2 p : c) corners += squared_length(p - centre) / 3;
      const auto n = to_index(patch.terms(c).size());
      Eigen::MatrixXd a(n, 6);
      Eigen::VectorXd weight(n);
      for (Eigen::Index i = 0; i < n; ++i) {
        const DeformedIndex d(to_size(patch.terms(c)[to_size(i)].vertex));
        const Point2 offset = sheet.rest(sheet.rest_vertex(d)) - centre, p = 1 / unit * offset;
        weight[i] = unit * unit / (squared_length(offset) + corners);
        a.row(i) << 1, p.x, p.y, p.x * p.x, p.x * p.y, p.y * p.y;
        a.row(i) *= weight[i];
      }
      const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
      if (n < 6 || svd.singularValues()[5] < 0.05 * svd.singularValues()[0]) continue;
      ++fitted;
      for (std::size_t k = 0; k < 3; ++k) {
        const Point2 from = 1 / unit * (c[k] - centre), to = 1 / unit * (c[(k + 1) % 3] - centre), side = to - from;
        const Point2 m = 0.5 * (from + to), inward = 1 / std::sqrt(squared_length(side)) * Point2{-side.y, side.x};
        Eigen::VectorXd slope(6);  // of 1, x, y, x^2, xy, y^2
        slope << 0, inward.x, inward.y, 2 * m.x * inward.x, m.y * inward.x + m.x * inward.y, 2 * m.y * inward.y;
        const Eigen::VectorXd expected =
            weight.cwiseProduct(svd.matrixU() * svd.singularValues().cwiseInverse().asDiagonal() *
                                (svd.matrixV().transpose() * slope)) /
            unit;
        for (Eigen::Index i = 0; i < n; ++i)
          EXPECT_NEAR(patch.terms(c)[to_size(i)].factor[k], expected[i], 1e-12 * expected.norm());
      }
    }
  }
  EXPECT_GT(fitted, 300u);
}

TEST(BendingUpdate, LeavesWhatIsFarFromTheCutWhereItIs) {
  Sheet sheet(make_sheet("delaunay", 30));
  Bending bending(sheet, BendingKind::patches, rigidity, poisson);
  const Bending before = bending;
  Locator locator(sheet);
  const auto& row = find_method("conventional_split");
  Cutter().cut(sheet, locator, {Curve::Kind::polyline, false, {{0.1, 0.1}, {0.2, 0.15}}},
               *row.make(row.parameter.value), {});
  bending.update(sheet);
  std::size_t far = 0;
  for (std::size_t d = 0; d < before.matrix().rows(); ++d) {
    const Point2 p = sheet.rest(sheet.rest_vertex(DeformedIndex(d)));
    if (p.x < 0.4 && p.y < 0.35) continue;
    ++far;
    ASSERT_EQ(bending.matrix().first_slot(d), before.matrix().first_slot(d));
    const auto old_columns = before.matrix().columns(d), columns = bending.matrix().columns(d);
    ASSERT_TRUE(std::equal(columns.begin(), columns.end(), old_columns.begin(), old_columns.end()));
  }
  EXPECT_GT(far, 700u);
}

}  // namespace
}  // namespace cutbench
