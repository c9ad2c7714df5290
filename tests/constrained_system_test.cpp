// The system of constrained vertices: against dense products, cut by cut against one made anew, and in motion.

#include <gtest/gtest.h>

#include <set>

#include "harness/base/conversions.h"
#include "harness/cut/constraint_source.h"
#include "harness/fem/constraints/constraint_matrix.h"
#include "harness/fem/model/largest_eigenvalue.h"
#include "harness/fem/time/stepper.h"
#include "harness/mesh/families.h"
#include "tests/constrained_cut.h"
#include "tests/dense_constraint_matrix.h"
#include "tests/dense_solves.h"
#include "tests/fem_helpers.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

/// The ghost penalties of a sheet with stiffness and density 1, dense; without those on phantoms that `plain`, the
/// matrix that they are added to, says nothing of.
Eigen::MatrixXd dense_ghosts(const Constraints& constraints, std::size_t vertices, const Eigen::MatrixXd& plain,
                             Eigen::Index dimension, double GhostEdge::*weight) {
  const Eigen::Index unknowns = plain.rows();
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(unknowns, unknowns);
  for (const GhostEdge& ghost : constraints.ghosts)
    for (Eigen::Index axis = 0; axis < dimension; ++axis) {
      Eigen::VectorXd jump = Eigen::VectorXd::Zero(unknowns);
      bool acts = true;
      for (std::size_t k = 0; k < 4; ++k) {
        const Eigen::Index u = dimension * ghost.unknown[k].value + axis;
        jump[u] += ghost.jump[k];
        acts &= ghost.unknown[k]() < vertices || plain(u, u) != 0;
      }
      if (acts) all += ghost.*weight * jump * jump.transpose();
    }
  return all;
}

/// C^T A C and C^T f against dense products, held unknowns among them.
TEST(Constraints, SystemIsTheDenseProduct) {
  for_each_constrained_cut(constraining_methods, 4, 1, 641, [&](const ConstrainedCut& cut) {
    const Sheet& sheet = cut.sheet();
    Model<3> model(sheet, {.stiffness = 1000, .poisson = 0.3, .bending = 0.1},
                   {.bending = BendingKind::patches, .mass = Mass::consistent},
                   {{.where = {{0, 0}, {0.3, 0.3}}}, {.where = {{0.5, 0.5}, {1, 1}}, .axes = {false, true, false}}},
                   {});
    model.rotate(bent(model, sheet));
    model.assemble(1.1, 0.01);
    Eigen::MatrixXd a = dense(model);
    const auto n = a.rows();
    Eigen::MatrixXd c = dense_constraint_matrix(cut.constraints, model.vertices(), 3);
    const auto unknowns = c.cols();
    for (Eigen::Index u = 0; u < n; ++u)
      if (model.held()[to_size(u)]) c.row(u).setZero();
    Eigen::MatrixXd expected = c.transpose() * a * c;
    expected += 7 * dense_ghosts(cut.constraints, model.vertices(), expected, 3, &GhostEdge::stiffness);
    ConstrainedSystem<3> constraint_kind(cut.constraints, model.vertices());
    constraint_kind.assemble(model.system(), 7);
    const SystemMatrix<3> small = constraint_kind.system();
    ASSERT_EQ(to_index(3 * small.vertices()), unknowns);
    Field some = Field::Random(unknowns);
    const Field force = Field::Random(n);
    for (Eigen::Index u = 0; u < unknowns; ++u)
      if ((*small.held)[to_size(u)]) some[u] = 0;
    Field all, moved, pulled, expected_all = expected * some;
    small.multiply(some, all);
    for (Eigen::Index u = 0; u < unknowns; ++u)
      if ((*small.held)[to_size(u)]) expected_all[u] = 0;
    EXPECT_LE((all - expected_all).norm(), 1e-11 * a.norm());  // slivers, whose entries cancel out
    constraint_kind.expand(some, moved);
    constraint_kind.reduce(model.held(), force, pulled);
    EXPECT_LE((moved - c * some).norm(), 1e-12 * moved.norm());
    Field expected_pull = c.transpose() * force;
    for (Eigen::Index u = 0; u < n; ++u)
      if (model.held()[to_size(u)]) expected_pull[u] = 0;
    EXPECT_LE((pulled - expected_pull).norm(), 1e-12 * pulled.norm());
    for (Eigen::Index u = 0; u < unknowns; ++u)
      EXPECT_EQ((*small.held)[to_size(u)] != 0, expected(u, u) == 0 || (u < n && model.held()[to_size(u)]));
  });
}

TEST(Constraints, LargestEigenvalueIsThatOfADenseSolve) {
  for_each_constrained_cut(constraining_methods, 4, 1, 641, [&](const ConstrainedCut& cut) {
    const Sheet& sheet = cut.sheet();
    Model<2> model(sheet, {.density = 1, .stiffness = 1, .poisson = 0.3},
                   {.dimension = 2, .strain = Strain::linear, .bending = BendingKind::none}, {}, {});
    model.rotate(Field::Zero(to_index(2 * model.vertices())));
    model.assemble(0, 1);
    const Eigen::MatrixXd k = dense(model);
    const auto n = k.rows();
    const Eigen::MatrixXd c = dense_constraint_matrix(cut.constraints, model.vertices(), 2);
    Eigen::VectorXd mass(n);
    for (Eigen::Index u = 0; u < n; ++u) mass[u] = model.lumped_mass()[u / 2];
    Eigen::VectorXd own = Eigen::VectorXd::Zero(c.cols());
    for (const auto& [unknown, area] : cut.constraints.lumped) {
      if (unknown.value < n / 2) mass.segment<2>(2 * unknown.value).setZero();
      own.segment<2>(2 * unknown.value).setConstant(area);
    }
    if (!cut.constraints.lumped.empty())
      for (const Constraint& constraint : cut.constraints.constraints)
        mass.segment<2>(2 * constraint.vertex.value).setZero();
    Eigen::MatrixXd m = c.transpose() * mass.asDiagonal() * c, stiffness = c.transpose() * k * c;
    m.diagonal() += own;
    m += dense_ghosts(cut.constraints, model.vertices(), m, 2, &GhostEdge::mass);
    stiffness += dense_ghosts(cut.constraints, model.vertices(), stiffness, 2, &GhostEdge::stiffness);
    for (Eigen::Index u = 0; u < m.rows(); ++u)
      if (m(u, u) == 0) m(u, u) = 1;
    const double expected = largest_mode(stiffness, m);
    EXPECT_NEAR(largest_eigenvalue(sheet, cut.constraints), expected, 1e-3 * expected);
  });
}

/// Cut by cut: the system that has followed them against one made anew, with bending, held vertices and phantom nodes.
TEST(Constraints, SystemFollowsCutsAsOneMadeAnew) {
  for (const ConstrainingMethod& method : constraining_methods) {
    SCOPED_TRACE(method.name + " " + std::to_string(method.parameter));
    Body<3> body(make_sheet("delaunay", 16), {.stiffness = 1000, .poisson = 0.3, .bending = 0.1},
                 {.bending = BendingKind::patches, .mass = Mass::consistent},
                 {{.where = {{0, 0}, {0.3, 0.3}}}, {.where = {{0.5, 0.5}, {1, 1}}, .axes = {false, true, false}}});
    const Sheet before = body.sheet;
    std::uint64_t last = 0;
    for (const Curve& cut : {line({-0.1, 0.41}, {0.6, 0.52}), line({0.3, -0.1}, {0.44, 0.8}),
                             line({0.7, 0.5}, {0.9, 0.1}), line({-0.1, 0.9}, {1.1, 0.85})}) {
      ASSERT_EQ(body.cut(cut, method.name, method.parameter), Status::ok);
      const Constraints constraints = constraints_of(*method.make(), before, body.sheet);
      body.model.constrain(body.sheet, constraints);
      ASSERT_TRUE(body.model.constrained());
      Model<3> fresh = body.fresh_model();
      fresh.constrain(body.sheet, constraints);
      for (Model<3>* const model : {&body.model, &fresh}) {
        model->rotate(bent(*model, body.sheet));
        model->assemble(1.2, 0.1);
        model->constrained()->assemble(model->system(), 7);
      }
      const SystemMatrix<3> a = body.model.constrained()->system(), b = fresh.constrained()->system();
      const NumbersOf numbers{body.model, fresh};
      expect_same(*a.blocks, *b.blocks, numbers, 1e-12);
      ASSERT_EQ(a.scalar.size(), b.scalar.size());
      for (std::size_t k = 0; k < a.scalar.size(); ++k)
        expect_same(*a.scalar[k].matrix, *b.scalar[k].matrix, numbers, 1e-11);
      for (std::size_t v = 0; v < a.vertices(); ++v)
        for (std::size_t k = 0; k < 3 && !numbers.is_spare(v); ++k) {
          EXPECT_EQ((*a.held)[3 * v + k], (*b.held)[3 * numbers.in_fresh(v) + k]);
          if (!a.blocks->columns(v).empty()) {
            EXPECT_EQ((*a.places)[v].x, (*b.places)[numbers.in_fresh(v)].x);
          }
        }
      if (last > 0) {  // rows far from the cut stay
        ASSERT_TRUE(a.history->holds(last));
        const auto rows = a.history->changed_since(last);
        EXPECT_LT(std::set<std::int32_t>(rows.begin(), rows.end()).size(), a.vertices());
      }
      last = a.pattern;
    }
  }
}

/// A cut far from those of before changes the rows of the system near it alone.
TEST(Constraints, SystemFollowsTheLastCut) {
  for (const std::string name : {"split_and_tie", "phantom_node", "virtual_node"}) {
    SCOPED_TRACE(name);
    const auto method = find_method(name).make(find_method(name).parameter.value);
    Body<3> body(make_sheet("delaunay", 40), {.stiffness = 1000, .poisson = 0.3, .bending = 0.1},
                 {.bending = BendingKind::patches});
    const Sheet before = body.sheet;
    Constraints constraints;
    std::uint64_t last = 0;
    std::size_t changed = 0;
    for (const Curve& cut : {line({-0.1, 0.81}, {0.6, 0.92}), line({0.3, 0.3}, {0.44, 1.1}),
                             line({-0.1, 0.6}, {1.1, 0.65}), line({0.8, 0.1}, {0.9, 0.12})}) {
      ASSERT_EQ(body.cut(cut, name, find_method(name).parameter.value), Status::ok);
      constraints = method->constraint_source()->next_constraints(before, body.sheet, constraints, {});
      body.model.constrain(body.sheet, constraints);
      body.model.rotate(bent(body.model, body.sheet));
      body.model.assemble(1.2, 0.1);
      body.model.constrained()->assemble(body.model.system(), 0);
      const SystemMatrix<3> a = body.model.constrained()->system();
      if (last > 0) {
        ASSERT_TRUE(a.history->holds(last));
        const auto rows = a.history->changed_since(last);
        changed = std::set<std::int32_t>(rows.begin(), rows.end()).size();
      }
      last = a.pattern;
    }
    EXPECT_GT(changed, 0U);
    EXPECT_LT(changed, body.model.vertices() / 10);
  }
}

/// How far a field of the vertices is from all that x = C q can be, in the mean square.
double off_range(const Eigen::MatrixXd& c, const Field& x) { return (nearest_in_range(c, x) - x).norm(); }

/// A cut sheet that is let go falls freely, shaken or not, and what is constrained stays constrained.
TEST(Constraints, HoldInMotion) {
  for (const std::string name : {"split_and_tie", "phantom_node", "phantom_node:consistent_mass"})
    for (const bool shaken : {false, true}) {
      SCOPED_TRACE(name + (shaken ? ", shaken" : ""));
      const Sheet before(make_sheet("delaunay", 8));
      Body<3> body(make_sheet("delaunay", 8), {.density = 1, .stiffness = 1000, .poisson = 0.3},
                   {.bending = BendingKind::none, .gravity = {0, 0, -10}});
      ASSERT_EQ(body.cut(line({-0.1, 0.41}, {0.6, 0.52}), name, find_method(name).parameter.value), Status::ok);
      const Constraints constraints =
          constraints_of(*find_method(name).make(find_method(name).parameter.value), before, body.sheet);
      ASSERT_FALSE(constraints.empty());
      body.model.constrain(body.sheet, constraints);
      const std::size_t vertices = body.sheet.deformed_slots();
      begin_phantoms(body.sheet, {}, constraints, vertices, {}, body.model, body.state);
      const Eigen::MatrixXd c = dense_constraint_matrix(constraints, vertices, 3);
      if (shaken) {
        const Field some = 0.1 * Field::Random(c.cols());
        body.state.v.head(c.rows()) = c * some;
        body.state.v.tail(c.cols() - c.rows()) = some.tail(c.cols() - c.rows());
      }
      const Balance start = balance_of(body.model, body.state);
      Stepper<3> stepper({.step = 0.01, .solver = {.name = "cholmod"}});
      for (int i = 0; i < 5; ++i) ASSERT_EQ(stepper.step(body.model, body.state).verdict, Verdict::ok);
      const Balance end = balance_of(body.model, body.state);
      EXPECT_NEAR(end.momentum.z - start.momentum.z, -0.5, 1e-9);
      EXPECT_NEAR(end.momentum.x, start.momentum.x, 1e-9);
      if (!shaken)
        for (Eigen::Index v = 2; v < body.state.v.size(); v += 3) {
          const auto d = DeformedIndex(to_size(v / 3));
          if (d() >= vertices || body.sheet.rest_vertex(d).valid()) {
            EXPECT_NEAR(body.state.v[v], -0.5, 1e-8);
          }
        }
      EXPECT_LE(off_range(c, body.state.v.head(c.rows())), 1e-9);
      EXPECT_LE(off_range(c, body.state.x.head(c.rows())), 1e-9);
    }
}

}  // namespace
}  // namespace cutbench
