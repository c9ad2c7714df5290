// The cycle of multigrid as a preconditioner, and solves after cuts.

#include "harness/fem/multigrid/multigrid.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/base/random.h"
#include "harness/base/union_find.h"
#include "harness/cases/adversarial.h"
#include "harness/fem/linear/linear_solver.h"
#include "harness/fem/solvers/solver_table.h"
#include "tests/helpers.h"
#include "tests/multigrid_helpers.h"
#include "tests/random_field.h"

namespace cutbench {
namespace {

template <int D>
Eigen::MatrixXd dense(const SystemMatrix<D>& a) {
  const auto n = to_index(D * a.vertices());
  Eigen::MatrixXd all(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    Field column = Field::Zero(n);
    if (!(*a.held)[to_size(k)]) {
      Field unit = Field::Zero(n);
      unit[k] = 1;
      a.multiply(unit, column);
    }
    all.col(k) = column;
  }
  return all;
}

template <int D>
Eigen::DiagonalMatrix<double, Eigen::Dynamic> held_as_identity(const SystemMatrix<D>& a) {
  Field one(to_index(a.held->size()));
  for (Eigen::Index u = 0; u < one.size(); ++u) one[u] = (*a.held)[to_size(u)];
  return one.asDiagonal();
}

/// The largest u.Bv - v.Bu of the cycle B over the energies of both, for residuals of any kind and of pieces that move
/// without being strained.
double asymmetry(const SystemMatrix<3>& a) {
  Multigrid<3> multigrid;
  multigrid.setup(a);
  UnionFind pieces(a.vertices());
  for (std::size_t i = 0; i < a.vertices(); ++i)
    for (const std::int32_t j : a.blocks->columns(i)) pieces.join(i, to_size(j));
  const auto n = to_index(3 * a.vertices());
  std::vector<Field> residuals, corrections;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Field any = random_field(seed, n);
    Field moved(n), r(n);
    for (std::size_t i = 0; i < a.vertices(); ++i)
      moved.segment<3>(to_index(3 * i)) = any.segment<3>(to_index(3 * pieces.find(i)));
    project(*a.held, Field(moved), moved);
    a.multiply(moved, r);
    residuals.push_back(r);
    project(*a.held, any, r);
    residuals.push_back(r);
  }
  for (Field& r : residuals) {
    corrections.push_back(Field::Zero(n));
    multigrid.solve_apart(Field(r), corrections.back(), r);
    multigrid.apply(r, corrections.back());
  }
  double worst = 0;
  for (std::size_t i = 0; i < residuals.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const double scale = std::sqrt(residuals[i].dot(corrections[i]) * residuals[k].dot(corrections[k]));
      worst = std::max(worst, std::abs(residuals[i].dot(corrections[k]) - residuals[k].dot(corrections[i])) / scale);
    }
  return worst;
}

TEST(Multigrid, IsSymmetricToTheDigitsOfFloats) {
  for (const std::string family : {"grid", "delaunay"})
    for (const std::string method : {"conventional_split", "warp_and_refine"})
      EXPECT_LT(asymmetry(cut_body<3>(family, 30, BendingKind::patches, method).model.system()), 1e-5);
}

template <int D>
void expect_good_preconditioner(const SystemMatrix<D>& a) {
  Multigrid<D> multigrid;
  multigrid.setup(a);
  EXPECT_GT(multigrid.levels(), 1u);
  // Residuals of all kinds: any, of errors that are stiff, and of errors that are soft.
  const Eigen::MatrixXd matrix = dense(a) + Eigen::MatrixXd(held_as_identity(a));
  const Eigen::LLT<Eigen::MatrixXd> factor(matrix);
  std::vector<Field> residuals;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Field any = random_field(seed, matrix.rows());
    for (const Field& r : {any, Field(matrix * any), Field(factor.solve(any))}) {
      residuals.push_back(r.normalized());
      project(*a.held, Field(residuals.back()), residuals.back());
    }
  }
  std::vector<Field> corrections;
  for (const Field& r : residuals) {
    corrections.push_back(Field::Zero(r.size()));
    multigrid.apply(r, corrections.back());
    for (Eigen::Index u = 0; u < r.size(); ++u)
      if ((*a.held)[to_size(u)]) {
        ASSERT_EQ(corrections.back()[u], 0);
      }
    // Its energy is at most that of the exact correction: symmetric Gauss-Seidel and exact projections never overshoot,
    // and what the sweeps leave out is next to nothing here.
    EXPECT_GT(r.dot(corrections.back()), 0);
    EXPECT_LT(r.dot(corrections.back()), 1.001 * r.dot(factor.solve(r)));
  }
  for (std::size_t i = 0; i < residuals.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const double scale = std::sqrt(residuals[i].dot(corrections[i]) * residuals[k].dot(corrections[k]));
      EXPECT_NEAR(residuals[i].dot(corrections[k]), residuals[k].dot(corrections[i]), 1e-3 * scale);
    }
}

template <int D>
void expect_good_preconditioner(const std::string& family, BendingKind bending, const std::string& method) {
  SCOPED_TRACE(family + ", " + method);
  expect_good_preconditioner(cut_body<D>(family, 14, bending, method).model.system());
}

TEST(Multigrid, IsSymmetricAndPositiveDefinite) {
  for (const std::string family : {"grid", "delaunay", "graded", "alternating"})
    for (const std::string method : {"conventional_split", "warp_and_refine"}) {
      expect_good_preconditioner<2>(family, BendingKind::none, method);
      expect_good_preconditioner<3>(family, BendingKind::patches, method);
    }
  expect_good_preconditioner<3>("delaunay", BendingKind::hinges, "bowyer_watson");
}

/// Held vertices among the clusters: the diagonal of such a one is 1, which is much in this matrix.
TEST(Multigrid, SliversAtHeldVertices) {
  Body<3> body(make_sheet("grid", 14), skin, {.bending = BendingKind::patches}, held_left());
  EXPECT_EQ(body.cut(line({1e-3, 0.21}, {1e-3, 0.83}), "conventional_split"), Status::ok);
  body.model.rotate(bent(body.model, body.sheet));
  body.model.assemble(1, 1e-5);
  expect_good_preconditioner(body.model.system());
}

/// Coarse unknowns whose members are all held along one axis.
TEST(Multigrid, PinsOfOneAxis) {
  auto pins = held_left();
  pins.front().axes = {true, false, false};
  Body<2> body(make_sheet("delaunay", 14), skin, {}, pins);
  EXPECT_EQ(body.cut(line({-0.1, 0.313}, {1.1, 0.741}), "conventional_split"), Status::ok);
  body.model.rotate(bent(body.model, body.sheet));
  body.model.assemble(1, 1e-3);
  expect_good_preconditioner(body.model.system());
}

/// Without places there are no levels, only the sweeps.
TEST(Multigrid, WithoutPlaces) {
  const Body<2> body = cut_body<2>("grid", 10, BendingKind::none, "conventional_split");
  SystemMatrix<2> a = body.model.system();
  a.places = nullptr;
  Multigrid<2> multigrid;
  multigrid.setup(a);
  EXPECT_EQ(multigrid.levels(), 1u);
  const auto solver = make_solver<2>({.name = "multigrid", .tolerance = 1e-10});
  solver->setup(a);
  Field x;
  const Field b = random_field(5, to_index(2 * a.vertices()));
  EXPECT_TRUE(solver->solve(b, x).converged);
}

template <int D>
int iterations(const Body<D>& body, const std::string& name, double tolerance) {
  const auto solver = make_solver<D>({.name = name, .tolerance = tolerance});
  const SystemMatrix<D> a = body.model.system();
  solver->setup(a);
  Field x;
  const SolveReport report = solver->solve(random_field(6, to_index(D * body.model.vertices())), x);
  EXPECT_TRUE(report.converged);
  EXPECT_FALSE(report.fell_back);
  return report.iterations;
}

/// The iterations hardly grow with the number of triangles, where those of the diagonal blocks do.
TEST(Multigrid, IterationsDoNotFollowTheResolution) {
  for (const std::string family : {"grid", "delaunay"}) {
    SCOPED_TRACE(family);
    std::vector<int> multigrid, diagonal;
    for (const int n : {10, 40}) {
      const Body<2> body = cut_body<2>(family, n, BendingKind::none, "conventional_split");
      multigrid.push_back(iterations(body, "multigrid", 1e-6));
      diagonal.push_back(iterations(body, "cg", 1e-6));
    }
    EXPECT_LE(multigrid[1], 30);
    EXPECT_LE(multigrid[1], 2 * multigrid[0]);
    EXPECT_GE(diagonal[1], 3 * diagonal[0] / 2);
    EXPECT_LE(4 * multigrid[1], diagonal[1]);
  }
}

/// The same hierarchy object through cuts: as good as a new one, and the solution is that of the direct solver.
TEST(Multigrid, FollowsTheCuts) {
  for (const std::string method : {"conventional_split", "warp_and_refine", "delaunay_refine", "bowyer_watson"}) {
    SCOPED_TRACE(method);
    Body<3> body(make_sheet("delaunay", 12), skin, {.bending = BendingKind::patches}, held_left());
    const auto kept = make_solver<3>({.name = "multigrid", .tolerance = 1e-10});
    for (const Curve& curve : {line({0.2, 0.31}, {0.9, 0.52}), line({0.5, 0.1}, {0.61, 0.93}),
                               polygon({{0.22, 0.63}, {0.41, 0.64}, {0.33, 0.81}})}) {
      ASSERT_EQ(body.cut(curve, method), Status::ok);
      body.model.rotate(bent(body.model, body.sheet));
      body.model.assemble(1, 1e-4);
      const Field b = random_field(7, to_index(3 * body.model.vertices()));
      Field x, fresh, exact;
      const SystemMatrix<3> a = body.model.system();
      kept->setup(a);
      const SolveReport report = kept->solve(b, x);
      EXPECT_TRUE(report.converged);
      EXPECT_FALSE(report.fell_back);
      const auto other = make_solver<3>({.name = "multigrid", .tolerance = 1e-10});
      other->setup(a);
      const SolveReport anew = other->solve(b, fresh);
      EXPECT_LE(report.iterations, anew.iterations + 2);
      EXPECT_LT((x - fresh).norm(), 1e-7 * fresh.norm());
      const auto direct = make_solver<3>({.name = "cholmod"});
      direct->setup(a);
      direct->solve(b, exact);
      EXPECT_LT((x - exact).norm(), 1e-6 * exact.norm());
    }
  }
}

/// Pentagons cut each other to pieces of a few vertices, which weigh a millionth of what slivers make them stiff. In
/// floats the cycle loses 7e-4 of its symmetry.
TEST(Multigrid, FreePiecesTooLightForFloats) {
  constexpr int count = 12;
  Random random(1000 + count);
  Body<3> body(make_sheet("grid", 40), skin, {.bending = BendingKind::patches}, held_left());
  for (int k = 0; k < count; ++k) {
    const Point2 middle{random.between(0.15, 0.85), random.between(0.15, 0.85)};
    const double radius = random.between(0.02, 0.12);
    std::vector<Point2> corners;
    for (int c = 0; c < 5; ++c)
      corners.push_back(
          {middle.x + radius * std::cos(1.2566 * c + count), middle.y + radius * std::sin(1.2566 * c + count)});
    body.cut(polygon(corners), "conventional_split");
  }
  body.model.rotate(bent(body.model, body.sheet));
  constexpr double step = 1.0 / 60;
  body.model.assemble(1, step * step + 1e-3 * step);
  EXPECT_LT(asymmetry(body.model.system()), 2e-5);
  EXPECT_LE(iterations(body, "multigrid", 1e-4), 40);
}

/// At long steps a pentagon of some 200 vertices is as light. In floats the cycle loses 2e-5 of its symmetry and more.
TEST(Multigrid, LargeFreePieceTooLightForFloats) {
  Body<3> body(make_sheet("grid", 40), skin, {.bending = BendingKind::patches}, held_left());
  std::vector<Point2> corners;
  for (int c = 0; c < 5; ++c)
    corners.push_back({0.5 + 0.2 * std::cos(1.2566 * c + 0.1), 0.5 + 0.2 * std::sin(1.2566 * c + 0.1)});
  ASSERT_EQ(body.cut(polygon(corners), "conventional_split"), Status::ok);
  body.model.rotate(bent(body.model, body.sheet));
  for (const double stiffness_factor : {0.1, 10.0, 1000.0}) {
    body.model.assemble(1, stiffness_factor);
    EXPECT_LT(asymmetry(body.model.system()), 3e-6);
  }
}

/// Cuts 2e-4 beside each other leave clusters whose entries are thousands of times those round them. Where products are
/// taken of these, floats lose 7e-4 of the cycle's symmetry and more.
TEST(Multigrid, StiffClustersKeepItSymmetric) {
  Body<3> body(make_sheet("grid", 40), skin, {.bending = BendingKind::patches}, held_left());
  for (const auto& [from, to] : {std::pair<Point2, Point2>{{0.3, 0.513}, {0.7, 0.513}},
                                 {{0.3, 0.51321}, {0.6, 0.5133}},
                                 {{0.6, 0.3}, {0.6003, 0.51315}}})
    ASSERT_EQ(body.cut(line(from, to), "conventional_split"), Status::ok);
  body.model.rotate(bent(body.model, body.sheet));
  for (const double stiffness_factor : {1e-4, 1e-3, 0.1}) {
    body.model.assemble(1, stiffness_factor);
    EXPECT_LT(asymmetry(body.model.system()), 2e-4);
  }
}

/// Strained polygons stiffen pairs of vertices without a cut: these are found as if the levels were new.
TEST(Multigrid, FollowsWhatStiffens) {
  const Body<3> body = cut_body<3>("delaunay", 20, BendingKind::patches, "conventional_split");
  SystemMatrix<3> a = body.model.system();
  BlockMatrix<3> blocks = *a.blocks;
  a.blocks = &blocks;
  const auto kept = make_solver<3>({.name = "multigrid", .tolerance = 1e-6});
  const Field b = random_field(7, to_index(3 * a.vertices()));
  Field x;
  for (const double spring : {0.0, 1e2, 1e4}) {
    for (std::size_t i = 5; i < a.vertices(); i += 40) {
      if (blocks.columns(i).size() < 2) continue;
      const std::int32_t j = blocks.columns(i)[1];
      const Eigen::Matrix3d by = spring * a.diagonal(i).trace() * Eigen::Matrix3d::Identity();
      blocks.block(blocks.find(i, to_int32(i))) += by;
      blocks.block(blocks.find(to_size(j), j)) += by;
      blocks.block(blocks.find(i, j)) -= by;
      blocks.block(blocks.find(to_size(j), to_int32(i))) -= by;
    }
    kept->setup(a);
    const SolveReport report = kept->solve(b, x);
    EXPECT_TRUE(report.converged && !report.fell_back);
    const auto fresh = make_solver<3>({.name = "multigrid", .tolerance = 1e-6});
    fresh->setup(a);
    EXPECT_LE(report.iterations, fresh->solve(b, x).iterations + 2);
  }
}

/// A needle so thin that floats cannot hold its stiffness beside the sheet's.
TEST(Multigrid, ExtremeSlivers) {
  for (const double distance : {1e-4, 1e-7, 1e-10}) {
    SCOPED_TRACE(distance);
    Body<3> body(make_sheet("grid", 16), skin, {.bending = BendingKind::patches}, held_left());
    ASSERT_EQ(body.cut(line({0.1, 0.5 + distance}, {0.9, 0.5 + 2 * distance})), Status::ok);
    body.model.rotate(body.model.positions(body.sheet));
    body.model.assemble(1, 1e-4);
    const auto solver = make_solver<3>({.name = "multigrid", .tolerance = 1e-2});
    const SystemMatrix<3> a = body.model.system();
    solver->setup(a);
    Field x;
    Field b = Field::Zero(to_index(3 * body.model.vertices()));
    body.model.add_external_force(b);
    b += random_field(8, b.size());
    const SolveReport report = solver->solve(b, x);
    EXPECT_TRUE(x.allFinite());
    const auto plain = make_solver<3>({.name = "cg", .tolerance = 1e-2});
    plain->setup(a);
    Field y;
    const bool can_be_solved = plain->solve(b, y).converged;  // in doubles, by any iteration
    EXPECT_TRUE(report.converged || (distance < 1e-9 && !can_be_solved))
        << report.iterations << " iterations, residual " << report.residual;
  }
}

/// All in floats, all but the rows of slivers, and all in doubles. No row is off by more than floats lose of an entry
/// of a thousand median ones.
TEST(Multigrid, ItsProductIsNearlyThatOfTheMatrix) {
  std::array<int, 3> seen{};
  for (const double distance : {0.02, 1e-4, 1e-5, 3e-6, 1e-6, 1e-9}) {
    SCOPED_TRACE(distance);
    Body<3> body(make_sheet("grid", 16), skin, {.bending = BendingKind::patches}, held_left());
    ASSERT_EQ(body.cut(line({0.1, 0.5 + distance}, {0.9, 0.5 + 2 * distance})), Status::ok);
    body.model.rotate(body.model.positions(body.sheet));
    body.model.assemble(1, 1e-4);
    const SystemMatrix<3> a = body.model.system();
    std::vector<double> sizes;
    for (std::size_t i = 0; i < a.vertices(); ++i) sizes.push_back(a.diagonal(i).trace());
    std::sort(sizes.begin(), sizes.end());
    const double median = sizes[sizes.size() / 2], ratio = sizes.back() / median;
    ++seen[ratio < 1e3 ? 0 : ratio < 1e5 ? 1 : 2];
    Multigrid<3> multigrid;
    multigrid.setup(a);
    Field x = random_field(5, to_index(3 * a.vertices())), exact, y = Field::Zero(x.size());
    project(*a.held, Field(x), x);
    a.multiply(x, exact);
    ASSERT_TRUE(multigrid.multiply_roughly(x, y));
    EXPECT_LT((y - exact).cwiseAbs().maxCoeff(), 1e-3 * median * x.cwiseAbs().maxCoeff()) << ratio;
    for (Eigen::Index u = 0; u < y.size(); ++u) EXPECT_TRUE(y[u] == 0 || !(*a.held)[to_size(u)]);
  }
  for (const int count : seen) EXPECT_GT(count, 0);
}

/// A state that is not finite makes matrices of NaN. The solver says that it has not converged, and comes back.
TEST(Multigrid, NotFinite) {
  for (const std::size_t every : {1, 2, 3, 7}) {
    Body<3> body = cut_body<3>("delaunay", 14, BendingKind::patches, "conventional_split");
    Field x = body.model.positions(body.sheet);
    for (Eigen::Index u = 0; u < x.size(); u += to_index(3 * every)) x[u] = std::numeric_limits<double>::quiet_NaN();
    body.model.rotate(x);
    body.model.assemble(1, 1e-4);
    const SystemMatrix<3> a = body.model.system();
    const auto solver = make_solver<3>({.name = "multigrid", .tolerance = 1e-2, .max_iterations = 50});
    solver->setup(a);
    Field y;
    EXPECT_FALSE(solver->solve(random_field(3, x.size()), y).converged);
  }
}

/// The first step after cuts drawn as those of the robustness run. CUTBENCH_TEST_SCALE=200 makes 99,200 solves.
TEST(Multigrid, AdversarialCuts) {
  constexpr std::uint64_t seed = 99173;
  std::size_t solves = 0, unsolved = 0, fallbacks = 0, iterations = 0;
  const auto solve = [&](const SystemMatrix<3>& a, const Field& b, const std::string& name, int most) {
    const auto solver = make_solver<3>({.name = name, .tolerance = 1e-2, .max_iterations = most});
    solver->setup(a);
    Field x;
    const SolveReport report = solver->solve(b, x);
    EXPECT_TRUE(x.allFinite() || !b.allFinite() || !report.converged);
    return report;
  };
  for (const std::string family : {"grid", "delaunay", "graded", "alternating"})
    for (const int n : {6, 20}) {
      const MeshData mesh = make_sheet(family, n);
      for (std::size_t i = 0; i < scaled(2); ++i)
        for (const MethodRow& row : all_methods()) {
          SCOPED_TRACE(family + ", n " + std::to_string(n) + ", case " + std::to_string(i) + ", " + row.name);
          Body<3> body(mesh, skin, {.bending = BendingKind::patches, .gravity = {0, 0, -9.81}}, held_left());
          const auto method = row.make(row.parameter.value);
          if (method->why_unsupported(body.sheet)) continue;
          for (const Curve& curve : make_adversarial_case(seed, i, Sheet(mesh)).cuts)
            body.cut(curve, row.name, row.parameter.value);
          Field x = body.model.positions(body.sheet);
          x += 0.01 / n * random_field(i + 1, x.size());
          body.model.rotate(x);
          Field b = Field::Zero(x.size());
          body.model.add_internal_force(x, b);
          body.model.add_external_force(b);
          for (const double step : {1.0 / 240, 1.0 / 60}) {
            body.model.assemble(1, step * step + 1e-3 * step);
            const SystemMatrix<3> a = body.model.system();
            const SolveReport report = solve(a, b, "multigrid", 20000);
            ++solves;
            fallbacks += report.fell_back;
            iterations += to_size(report.iterations);
            if (report.converged) continue;
            ++unsolved;
            EXPECT_FALSE(solve(a, b, "cg", 20000).converged);
          }
        }
    }
  std::printf("%zu solves, %.2f iterations in the mean, %zu fall-backs; %zu not solved, nor by cg\n", solves,
              to_double(iterations) / to_double(solves), fallbacks, unsolved);
  EXPECT_LT(100 * unsolved, solves);
  EXPECT_LT(20 * fallbacks, solves);
}

}  // namespace
}  // namespace cutbench
