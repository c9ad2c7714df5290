// Mass for thin elements: the bound holds, inertia is as promised, cuts update it, energies close, and explicit steps
// run that blow up without it.
#include "harness/fem/elements/added_mass.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/fem/model/largest_eigenvalue.h"
#include "harness/fem/time/stepper.h"
#include "harness/simulation/energy_budget.h"
#include "tests/dense_solves.h"
#include "tests/fem_helpers.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

const Material skin{.density = 2.2, .stiffness = 1000, .poisson = 0.45, .bending = 4.2e-4};
const std::vector<Mass> kinds{Mass::stabilised, Mass::scaled};

Physics physics_with(Mass mass, BendingKind bending = BendingKind::none) {
  return {.strain = Strain::linear, .bending = bending, .mass = mass};
}

const Point2 from{0.1901, 0.2003}, to{0.8102, 0.7999};
const Curve near_vertices = line(from, to);

/// Where the vertices nearest to the cut are: their slivers have held corners.
std::vector<Point2> nearest_to_cut(const Sheet& sheet, std::size_t count) {
  std::vector<Point2> places;
  for (std::size_t v = 0; v < sheet.deformed_slots(); ++v) {
    const Point2 p = sheet.rest(sheet.rest_vertex(DeformedIndex(v)));
    if (p.x > 0.3 && p.x < 0.7) places.push_back(p);
  }
  const auto off = [](Point2 p) { return std::abs(cross(p - from, to - from)); };
  std::sort(places.begin(), places.end(), [&](Point2 a, Point2 b) { return off(a) < off(b); });
  places.resize(count);
  return places;
}

/// M, by products with unit vectors; 1 on the diagonal of freed slots, which have no stiffness.
template <int D>
Eigen::MatrixXd dense_mass(const Model<D>& model) {
  const auto n = to_index(D * model.vertices());
  Eigen::MatrixXd mass = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    Field column = Field::Zero(n);
    model.add_mass_product(1, Field::Unit(n, i), column);
    mass.col(i) = column;
    if (model.lumped_mass()[i / D] == 0) mass(i, i) = 1;
  }
  return mass;
}

template <int D>
double dense_eigenvalue(Body<D>& body) {
  body.model.rotate(body.model.positions(body.sheet));
  body.model.assemble(0, 1);
  return largest_mode(dense(body.model), dense_mass(body.model));
}

/// The largest eigenvalue of a triangle's 2 (mu + lambda) A G G^T and its lumped mass, from the lengths of its edges:
/// the cotangents are the entries of A G G^T.
double largest_of_triangles(const MeshData& mesh, const Material& material) {
  double largest = 0;
  for (const auto& t : mesh.triangles) {
    Eigen::Matrix3d laplacian = Eigen::Matrix3d::Zero();
    std::array<Point2, 3> p;
    for (std::size_t k = 0; k < 3; ++k) p[k] = mesh.rest[to_size(t[k])];
    const double twice = cross(p[1] - p[0], p[2] - p[0]);
    for (int k = 0; k < 3; ++k) {
      const int a = (k + 1) % 3, b = (k + 2) % 3;
      const auto at = [&](int i) { return p[to_size(i)]; };
      const double cotangent = dot(at(a) - at(k), at(b) - at(k)) / twice;
      laplacian(a, b) -= cotangent / 2;
      laplacian(b, a) -= cotangent / 2;
      laplacian(a, a) += cotangent / 2;
      laplacian(b, b) += cotangent / 2;
    }
    largest = std::max(largest, 6 / twice * eigenvalues(laplacian)[2]);
  }
  return largest * material.stiffness / (1 - material.poisson) / material.density;
}

TEST(AddedMass, BoundsTheMembraneByTheElementsOfTheUncutSheet) {
  for (const std::string family : sheet_families())
    for (const Mass kind : kinds)
      for (const double limit : {1.0, 4.0}) {
        SCOPED_TRACE(family + ", " + name_of(mass_names, kind));
        Physics physics = physics_with(kind);
        physics.dimension = 2;
        physics.mass_limit = limit;
        Body<2> body(make_sheet(family, 6), skin, physics),
            lumped(make_sheet(family, 6), skin, physics_with(Mass::lumped));
        const double most = largest_of_triangles(body.sheet.to_mesh_data(), skin);
        EXPECT_NEAR(body.model.added_mass()->limit(), limit * most, 1e-12 * limit * most);
        const double uncut = dense_eigenvalue(body);
        EXPECT_NEAR(uncut, dense_eigenvalue(lumped), 1e-9 * uncut);  // it stays as it is
        for (Body<2>* const b : {&body, &lumped}) ASSERT_EQ(b->cut(near_vertices), Status::ok);
        const double with = dense_eigenvalue(body);
        EXPECT_LE(with, (1 + 1e-6) * limit * most);
        EXPECT_GT(dense_eigenvalue(lumped), 20 * most);
        const double unit = skin.density / skin.stiffness;  // of largest_eigenvalue()
        Elasticity elasticity{.poisson = skin.poisson, .mass = kind};
        const Sheet before(make_sheet(family, 6));
        elasticity.mass_limit = limit * largest_element_eigenvalue(before, elasticity);
        EXPECT_NEAR(elasticity.mass_limit, limit * most * unit, 1e-12 * elasticity.mass_limit);
        EXPECT_NEAR(largest_eigenvalue(body.sheet, {}, elasticity), with * unit, 1e-3 * with * unit);
      }
}

TEST(AddedMass, BoundsMembraneAndBendingTogetherByTwiceThat) {
  for (const BendingKind bending : {BendingKind::patches, BendingKind::hinges})
    for (const Mass kind : kinds) {
      SCOPED_TRACE(name_of(mass_names, kind));
      Body<3> body(make_sheet("delaunay", 5), skin, physics_with(kind, bending)),
          lumped(make_sheet("delaunay", 5), skin, physics_with(Mass::lumped, bending));
      for (Body<3>* const b : {&body, &lumped}) ASSERT_EQ(b->cut(near_vertices), Status::ok);
      const double limit = body.model.added_mass()->limit(), with = dense_eigenvalue(body);
      EXPECT_LE(with, 2 * (1 + 1e-6) * limit);
      EXPECT_GT(dense_eigenvalue(lumped), 20 * limit);
      const double unit = skin.density / skin.stiffness;
      const Elasticity elasticity{.poisson = skin.poisson,
                                  .bending = bending,
                                  .bending_length2 = skin.bending / skin.stiffness,
                                  .mass = kind,
                                  .mass_limit = limit * unit};
      EXPECT_NEAR(largest_eigenvalue(body.sheet, {}, elasticity), with * unit, 1e-3 * with * unit);
    }
}

/// Stabilised: translation is as heavy as the area, and turning at rest hardly heavier. Scaled: what is added is said.
TEST(AddedMass, KeepsTheInertiaOfTranslation) {
  for (const Mass kind : kinds) {
    Body<3> body(make_sheet("graded", 8), skin, physics_with(kind, BendingKind::patches));
    ASSERT_EQ(body.cut(near_vertices), Status::ok);
    const auto n = to_index(body.model.vertices());
    Field shift = Field::Zero(3 * n), momentum = shift;
    for (Eigen::Index v = 0; v < n; ++v) shift[3 * v + 1] = 1;
    body.model.add_mass_product(1, shift, momentum);
    double added = 0, largest = 0;
    for (Eigen::Index v = 0; v < n; ++v) {
      added += momentum[3 * v + 1] - body.model.lumped_mass()[v];
      largest = std::max(largest, std::abs(momentum[3 * v + 1] - body.model.lumped_mass()[v]));
      EXPECT_EQ(momentum[3 * v], 0);
    }
    EXPECT_NEAR(body.model.lumped_mass().sum(), skin.density, 1e-12);
    EXPECT_NEAR(added, body.model.added_mass()->total(), 1e-9 * (1 + added));
    const double unit = skin.density / skin.stiffness;
    const Elasticity elasticity{.poisson = skin.poisson,
                                .bending = BendingKind::patches,
                                .bending_length2 = skin.bending / skin.stiffness,
                                .mass = kind,
                                .mass_limit = body.model.added_mass()->limit() * unit};
    if (kind == Mass::scaled) {
      EXPECT_GT(added, 1e-3);
      EXPECT_NEAR(added_mass_share(body.sheet, {}, elasticity), added / skin.density, 1e-9 * added);
    } else {
      EXPECT_LE(largest, 1e-9);
    }
  }
}

template <int D>
void cut_and_compare(const std::string& method, Mass kind, BendingKind bending) {
  std::size_t made = 0, heavy = 0;
  for (const std::string sheet : sheet_families())
    for (const std::string family : cut_families()) {
      SCOPED_TRACE(sheet + ", " + family);
      Physics physics = physics_with(kind, bending);
      physics.dimension = D;
      Body<D> body(make_sheet(sheet, 8), skin, physics);
      for (std::size_t again = 0; again < 3; ++again)
        for (const Curve& curve : make_case(family, 20, again, body.sheet)) {
          if (body.cut(curve, method, find_method(method).parameter.value) != Status::ok) continue;
          ++made;
          const double limit = body.model.added_mass()->limit();
          physics.mass_limit = 1;
          physics.mass_limit = limit / Model<D>(body.sheet, skin, physics, {}, {}).added_mass()->limit();
          const Model<D> fresh(body.sheet, skin, physics, {}, {});
          const BlockMatrix<1>&kept = body.model.added_mass()->matrix(), &anew = fresh.added_mass()->matrix();
          EXPECT_LE(max_difference(kept, anew), 1e-8 * max_entry(anew));
          heavy += max_entry(anew) > 0;
          if (testing::Test::HasFailure()) return;
        }
    }
  EXPECT_GT(made, sheet_families().size() * cut_families().size());
  EXPECT_GT(2 * heavy, made);
}

TEST(AddedMass, IsUpdatedToWhatANewOneWouldBe) {
  cut_and_compare<2>("conventional_split", Mass::stabilised, BendingKind::none);
  cut_and_compare<3>("conventional_split", Mass::stabilised, BendingKind::patches);
  cut_and_compare<3>("delaunay_refine", Mass::stabilised, BendingKind::hinges);
  cut_and_compare<3>("conventional_split", Mass::scaled, BendingKind::patches);
}

/// At half of the largest stable step of the uncut sheet.
TEST(AddedMass, LetsExplicitStepsRunAndTheirEnergyClose) {
  for (const Mass kind : {Mass::stabilised, Mass::scaled, Mass::lumped}) {
    SCOPED_TRACE(name_of(mass_names, kind));
    const MeshData mesh = make_sheet("delaunay", 8);
    const auto pinned = nearest_to_cut(Sheet(mesh), 3);
    Body<3> body(mesh, skin,
                 {.strain = Strain::linear, .bending = BendingKind::patches, .mass = kind, .gravity = {0, 0, -9.81}},
                 {{.where = {pinned[0], pinned[0]}, .velocity = {0, 0, 0.1}},
                  {.where = {pinned[1], pinned[1]}, .axes = {false, true, false}},
                  {.where = {pinned[2], pinned[2]}, .axes = {true, false, false}, .velocity = {0.05, 0, 0}}});
    const Elasticity elasticity{
        .poisson = skin.poisson, .bending = BendingKind::patches, .bending_length2 = skin.bending / skin.stiffness};
    const double step = 0.5 * explicit_step_limit(largest_eigenvalue(body.sheet, {}, elasticity), skin);
    Stepper<3> stepper({.integrator = Integrator::symplectic_euler, .step = step, .solver = {}});
    for (Eigen::Index i = 0; i < body.state.v.size(); ++i) body.state.v[i] = 0.3 * std::sin(to_double(37 * i * i));
    EnergyBudget budget(balance_of(body.model, body.state), Integrator::symplectic_euler);
    Verdict verdict = Verdict::ok;
    for (int n = 0; n < 400 && verdict == Verdict::ok; ++n) {
      if (n == 100) {
        const Balance before = balance_of(body.model, body.state);
        ASSERT_EQ(body.cut(near_vertices), Status::ok);
        budget.add_cut(before, balance_of(body.model, body.state));
      }
      const State before = body.state;
      verdict = stepper.step(body.model, body.state).verdict;
      if (verdict == Verdict::ok) budget.add_step(body.model, before, body.state, step);
    }
    const BudgetRow& end = budget.rows().back();
    if (kind == Mass::lumped) {
      EXPECT_TRUE(verdict == Verdict::not_finite || end.energy.kinetic > 1e6 * budget.rows()[99].energy.kinetic);
      continue;
    }
    EXPECT_EQ(verdict, Verdict::ok);
    EXPECT_GT(std::abs(end.pin_work), 1e-4);
    EXPECT_NEAR(end.remainder, 0, 1e-9 * end.energy.kinetic);
    EXPECT_LT(budget.gains().unexplained, EnergyBudget::most_unexplained_explicit);
    EXPECT_NE(end.jumps, 0);
  }
}

TEST(AddedMass, ImplicitStepsCloseToRounding) {
  for (const Integrator integrator : {Integrator::backward_euler, Integrator::midpoint})
    for (const std::string solver : {"cholmod", "cg", "multigrid"})
      for (const Mass kind : kinds) {
        SCOPED_TRACE(solver);
        Body<3> body(make_sheet("delaunay", 8), skin, physics_with(kind, BendingKind::patches),
                     {{.where = {{0, 0}, {0, 1}}},
                      {.where = {{1, 0}, {1, 1}}, .displacement = {0.05, 0, 0.1}, .velocity = {0.2, -0.1, 0.4}}});
        const double step = 1.0 / 120;
        Stepper<3> stepper({.integrator = integrator, .step = step, .solver = {solver, 1e-12, 20000}});
        EnergyBudget budget(balance_of(body.model, body.state), integrator);
        for (int n = 0; n < 10; ++n) {
          if (n == 5) {
            const Balance before = balance_of(body.model, body.state);
            ASSERT_EQ(body.cut(near_vertices), Status::ok);
            budget.add_cut(before, balance_of(body.model, body.state));
          }
          const State before = body.state;
          ASSERT_EQ(stepper.step(body.model, body.state).verdict, Verdict::ok);
          budget.add_step(body.model, before, body.state, step);
        }
        const BudgetRow& end = budget.rows().back();
        EXPECT_NEAR(end.remainder, 0, 1e-8 * (std::abs(end.pin_work) + end.energy.kinetic));
      }
}

}  // namespace
}  // namespace cutbench
