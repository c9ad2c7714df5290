// cut_polygons in the model: cut by cut, bending, motion, solvers, and its errors.

#include <gtest/gtest.h>

#include <map>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/cut/constraint_source.h"
#include "harness/fem/model/largest_eigenvalue.h"
#include "harness/fem/time/stepper.h"
#include "harness/mesh/families.h"
#include "tests/constrained_cut.h"
#include "tests/dense_solves.h"
#include "tests/fem_helpers.h"
#include "tests/helpers.h"
#include "tests/sound_polygons.h"
#include "tests/truth_helpers.h"

namespace cutbench {
namespace {

const std::vector<std::string> cuts_to_make{"straight",      "curved",           "partial",    "cut_out",
                                            "recut",         "several",          "u_turn",     "tiny_loop",
                                            "self_crossing", "through_vertices", "along_edges"};

constexpr Material leather{.density = 2, .stiffness = 1000, .poisson = 0.3, .bending = 0.02};

void merge_as_after_a_cut(Body<3>& body, const Sheet& before, const CuttingMethod& method) {
  body.model.constrain(body.sheet, method.constraint_source()->next_constraints(
                                       before, body.sheet, {}, body.model.elements().left_since_change()));
}

// --- the model -------------------------------------------------------------------------------------------------------

/// Cut by cut, against a model made anew.
TEST(PolygonModel, FollowsCutsAsOneMadeAnew) {
  std::size_t turn = 0, kept = 0;
  for (const std::string& cuts : cuts_to_make)
    for (const std::string& family : families_in_turn(turn)) {
      SCOPED_TRACE(family + ", " + cuts);
      const Physics physics{.bending = BendingKind::patches, .gravity = {0, 0, -10}};
      Body<3> body(make_sheet(family, 7), leather, physics, {{.where = {{0, 0}, {0.2, 1}}}});
      const Sheet before = body.sheet;
      const auto method = find_method("cut_polygons").make(0.7);
      for (std::size_t number = 0; number < 3; ++number)
        for (const Curve& curve : make_case(cuts, 877, number, before)) {
          if (body.cut(curve, "cut_polygons", 0.7) != Status::ok) continue;
          kept += body.model.elements().merged().polygons.size();
          merge_as_after_a_cut(body, before, *method);
          expect_sound(body.sheet, body.model.elements().merged().polygons);
          Model<3> fresh = body.fresh_model();
          fresh.constrain(body.sheet, body.model.elements().merged());
          const Field x = bent(fresh, body.sheet);
          for (Model<3>* const model : {&body.model, &fresh}) {
            model->rotate(x);
            model->assemble(1.2, 0.1);
          }
          EXPECT_EQ(body.model.held(), fresh.held());
          EXPECT_LE((body.model.lumped_mass() - fresh.lumped_mass()).cwiseAbs().maxCoeff(), 1e-15);
          EXPECT_LE((body.model.external_force() - fresh.external_force()).cwiseAbs().maxCoeff(), 1e-13);
          const double scale = max_entry(fresh.blocks());
          EXPECT_LE(max_difference(body.model.blocks(), fresh.blocks()), 1e-12 * scale);
          EXPECT_LE(max_difference(body.model.bending()->matrix(), fresh.bending()->matrix()),
                    1e-11 * max_entry(fresh.bending()->matrix()));
        }
    }
  EXPECT_GT(kept, 0u) << "polygons far from a cut stay";
}

/// Every quadratic has its exact energy, per element, wherever patches know the curvature: with polygons as without.
TEST(PolygonBending, PassesThePatchTest) {
  for_each_constrained_cut({cut_polygons}, 12, 1, 877, [&](const ConstrainedCut& cut) {
    const Sheet& sheet = cut.sheet();
    if (count_pieces(sheet) > 1) return;  // a piece may be too small to know a curvature
    const ElementTable elements(sheet, cut.constraints);
    const double rigidity = 0.7, poisson = 0.3, xx = 0.4, yy = -0.3, xy = 0.5;
    const Bending plain(sheet, BendingKind::patches, rigidity, poisson),
        merged(sheet, BendingKind::patches, rigidity, poisson, &elements);
    Field w = Field::Zero(to_index(sheet.deformed_slots()));
    for (std::size_t d = 0; d < sheet.deformed_slots(); ++d)
      if (const VertexIndex v = sheet.rest_vertex(DeformedIndex(d)); v.valid()) {
        const auto [x, y] = sheet.rest(v);
        w[to_index(d)] = xx * x * x / 2 + xy * x * y + yy * y * y / 2 + 0.2 * x - y;
      }
    const double exact =
        rigidity / 2 * ((1 - poisson) * (xx * xx + yy * yy + 2 * xy * xy) + poisson * (xx + yy) * (xx + yy));
    // As the triangles alone have it: exact, where no strip between cuts is too narrow to know a curvature.
    if (std::abs(plain.energy(w, 1) - exact) > 1e-9 * exact) return;
    EXPECT_NEAR(merged.energy(w, 1), exact, 1e-8 * exact);
    for (const Polygon& polygon : cut.constraints.polygons)
      for (const DeformedIndex d : polygon.inside) EXPECT_TRUE(merged.matrix().columns(d()).empty());
  });
}

TEST(PolygonBending, EigenvalueWithBendingIsFarBelowThatOfTheSplit) {
  const Elasticity bends{.bending = BendingKind::patches, .bending_length2 = 1e-4};
  double worst_split = 0, worst = 0;
  for (const std::string family : sheet_families())
    for (std::size_t i = 0; i < scaled(4); ++i) {
      const ConstrainedCut cut(family, 16, cut_polygons, "straight", 877, i);
      const double whole = largest_eigenvalue(cut.before, {}, bends);
      worst_split = std::max(worst_split, largest_eigenvalue(cut.sheet(), {}, bends) / whole);
      worst = std::max(worst, largest_eigenvalue(cut.sheet(), cut.constraints, bends) / whole);
    }
  std::cout << "largest eigenvalue with bending: split " << worst_split << ", polygons " << worst << "\n";
  EXPECT_LE(worst, 0.1 * worst_split);
}

/// By what the cut touched: a polygon that lies away from it is not looked at again, so the tenth cut costs what the
/// first does.
TEST(CutPolygons, FollowTheLastCut) {
  Body<3> body(make_sheet("delaunay", 40), leather, {}, {});
  const Sheet before = body.sheet;
  const auto method = find_method("cut_polygons").make(0.7);
  std::vector<std::size_t> asked;  // per cut
  for (int i = 0; i < 10; ++i) {
    const double y = 0.05 + 0.09 * i;
    ASSERT_EQ(body.cut(line({-0.1, y}, {1.1, y + 0.01}), "cut_polygons", 0.7), Status::ok);
    asked.push_back(0);
    const PolygonsLeft left = body.model.elements().left_since_change();
    const auto counted = [&](TriangleIndex t) { return ++asked.back(), left.of(t); };
    const Constraints constraints =
        method->constraint_source()->next_constraints(before, body.sheet, {}, {counted, left.freed});
    const std::size_t old = body.model.elements().merged().polygons.size();
    body.model.constrain(body.sheet, constraints);
    EXPECT_EQ(body.model.elements().merged().polygons.size(), old + constraints.polygons.size());
  }
  EXPECT_GT(asked.front(), 40u);
  EXPECT_LT(*std::max_element(asked.begin(), asked.end()), 2 * asked.front());
}

/// The order in which cuts are made decides which parts are merged, not how good the result is.
TEST(CutPolygons, AreAsGoodCutByCutAsAtOnce) {
  double worst = 0, worst_at_once = 0, logs = 0, cases = 0;
  for (const std::string family : sheet_families())
    for (std::size_t i = 0; i < scaled(6); ++i) {
      Body<3> body(make_sheet(family, 20), leather, {}, {});
      const Sheet before = body.sheet;
      const auto method = find_method("cut_polygons").make(0.7);
      for (const Curve& curve : make_case("several", 877, i, before))
        if (body.cut(curve, "cut_polygons", 0.7) == Status::ok) merge_as_after_a_cut(body, before, *method);
      const double whole = largest_eigenvalue(before),
                   value = largest_eigenvalue(body.sheet, body.model.elements().merged()) / whole,
                   at_once = largest_eigenvalue(body.sheet, constraints_of(*method, before, body.sheet)) / whole;
      worst = std::max(worst, value);
      worst_at_once = std::max(worst_at_once, at_once);
      logs += std::log(value / at_once);
      ++cases;
    }
  std::cout << "largest eigenvalue after four cuts: cut by cut at worst " << worst << ", at once " << worst_at_once
            << ", mean ratio " << std::exp(logs / cases) << "\n";
  EXPECT_LE(std::exp(logs / cases), 1.1);
  EXPECT_LE(worst, 1.5 * worst_at_once);
}

/// Of the split the worst is thousands.
TEST(CutPolygons, EigenvalueStaysNearThatOfTheUncutSheet) {
  double worst = 0, worst_split = 0;
  for (const std::string family : sheet_families())
    for (const std::string cuts : {"straight", "curved", "partial"})
      for (std::size_t i = 0; i < scaled(4); ++i) {
        const ConstrainedCut cut(family, 16, cut_polygons, cuts, 877, i);
        const double whole = largest_eigenvalue(cut.before);
        worst = std::max(worst, largest_eigenvalue(cut.sheet(), cut.constraints) / whole);
        worst_split = std::max(worst_split, largest_eigenvalue(cut.sheet()) / whole);
      }
  std::cout << "largest eigenvalue: split " << worst_split << ", polygons " << worst << "\n";
  EXPECT_LE(worst, 20);
  EXPECT_GE(worst_split, 1e3);
}

// --- motion ----------------------------------------------------------------------------------------------------------

/// A cut sheet that is let go falls freely by every integrator, and vertices inside polygons keep to their maps.
TEST(CutPolygons, FallFreely) {
  for (const Integrator integrator : {Integrator::backward_euler, Integrator::midpoint, Integrator::symplectic_euler}) {
    const Sheet before(make_sheet("delaunay", 10));
    Body<3> body(make_sheet("delaunay", 10), {.density = 1, .stiffness = 100, .poisson = 0.3, .bending = 1e-3},
                 {.bending = BendingKind::patches, .gravity = {0, 0, -10}});
    for (const Curve& cut : {line({-0.1, 0.41}, {0.6, 0.52}), line({0.3, -0.1}, {0.44, 0.8})}) {
      ASSERT_EQ(body.cut(cut, "cut_polygons", 0.7), Status::ok);
      merge_as_after_a_cut(body, before, *find_method("cut_polygons").make(0.7));
    }
    Stepper<3> stepper({.integrator = integrator, .step = 1e-3, .solver = {.name = "cholmod"}});
    for (int i = 0; i < 20; ++i) ASSERT_EQ(stepper.step(body.model, body.state).verdict, Verdict::ok);
    for (std::size_t d = 0; d < body.sheet.deformed_slots(); ++d)
      if (body.sheet.rest_vertex(DeformedIndex(d)).valid()) {
        EXPECT_NEAR(body.state.v[to_index(3 * d + 2)], -0.2, 1e-8);
      }
    Field followed = body.state.x;
    body.model.follow(followed);
    EXPECT_LE((followed - body.state.x).cwiseAbs().maxCoeff(), 0);
  }
}

TEST(CutPolygons, EverySolverFindsTheSameStep) {
  const Sheet before(make_sheet("alternating", 24));
  std::map<std::string, Field> found;
  for (const std::string solver : {"cholmod", "cg", "multigrid", "constant_factor", "eigen_ldlt"}) {
    Body<3> body(make_sheet("alternating", 24), leather, {.bending = BendingKind::patches, .gravity = {0, 0, -10}},
                 {{.where = {{0, 0}, {0, 1}}}});
    Stepper<3> stepper({.step = 1.0 / 240, .solver = {.name = solver, .tolerance = 1e-9, .max_iterations = 5000}});
    for (const Curve& cut : {line({0.2, 0.41}, {1.1, 0.52}), line({0.4, 0.2}, {0.44, 0.8})}) {
      ASSERT_EQ(body.cut(cut, "cut_polygons", 0.7), Status::ok);
      merge_as_after_a_cut(body, before, *find_method("cut_polygons").make(0.7));
      for (int i = 0; i < 2; ++i) ASSERT_EQ(stepper.step(body.model, body.state).verdict, Verdict::ok) << solver;
    }
    found[solver] = body.state.x;
  }
  for (const auto& [solver, x] : found) EXPECT_LE((x - found["cholmod"]).cwiseAbs().maxCoeff(), 1e-7) << solver;
}

/// Measured: less than half the error of the split.
TEST(CutPolygons, CracksOpenBetterThanByTheSplit) {
  const Problem& problem = find_problem("centre_crack");
  double worst = 0;
  for (const std::string family : sheet_families())
    for (std::size_t member = 0; member < scaled(4); ++member) {
      const Specimen specimen = problem.specimen(family, 24, 877, member);
      const Sheet before(specimen.mesh), cut = cut_by(specimen, "cut_polygons", 0.7);
      const Constraints constraints = constraints_of(*find_method("cut_polygons").make(0.7), before, cut);
      const Budget direct;
      const Answer merged = problem.answer(specimen, cut, {&direct, 1}, constraints).front();
      ASSERT_EQ(merged.verdict, Verdict::ok) << merged.reason;
      const auto error = [](const Answer& answer) { return measure_of(answer, "released_energy").error; };
      worst = std::max(worst, error(merged) / error(solved(problem, specimen, cut)));
    }
  std::cout << "error of released energy over that of the split, at worst: " << worst << "\n";
  EXPECT_LE(worst, 0.7);
}

}  // namespace
}  // namespace cutbench
