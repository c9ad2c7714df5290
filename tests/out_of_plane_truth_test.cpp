// Problems of a sheet that leaves its plane: their exact solutions by other means, and what the cut sheets make of
// them.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "harness/base/conversions.h"
#include "harness/cut/cut.h"
#include "harness/mesh/families.h"
#include "harness/problems/out_of_plane/bending_patch_slit.h"
#include "harness/problems/out_of_plane/bent_sheet.h"
#include "harness/problems/out_of_plane/flap.h"
#include "harness/problems/out_of_plane/heavy_elastica.h"
#include "harness/problems/out_of_plane/slit_strip.h"
#include "harness/problems/out_of_plane/trouser_tear.h"
#include "methods/registry.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

// --- the heavy elastica ----------------------------------------------------------------------------------------------

/// The shape of least energy of a chain of `links` rigid links with springs D / h between them, half of h at the
/// clamp: sum of D (th_i+1 - th_i)^2 / 2 h and of the links' weights times their heights. Newton's method. Second order
/// in h; shares nothing with shooting.
Eigen::Vector2d end_of_chain(double load, int links) {
  const double h = 1.0 / links;
  Eigen::VectorXd angle = Eigen::VectorXd::Zero(links);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double pull = load * std::min(1.0, (iteration + 1) / 40.0);  // bit by bit
    Eigen::VectorXd torque(links);
    Eigen::MatrixXd stiffness = Eigen::MatrixXd::Zero(links, links);
    for (int i = 0; i < links; ++i) {
      const double hangs = pull * h * (1 - (i + 0.5) * h);  // weight beyond the middle of link i, times its length
      torque[i] = hangs * std::cos(angle[i]);
      stiffness(i, i) += hangs * std::sin(angle[i]);
      const double spring = i == 0 ? 2 / h : 1 / h, before = i == 0 ? 0 : angle[i - 1];
      torque[i] -= spring * (angle[i] - before);
      stiffness(i, i) += spring;
      if (i == 0) continue;
      torque[i - 1] += spring * (angle[i] - before);
      stiffness(i - 1, i - 1) += spring;
      stiffness(i, i - 1) -= spring;
      stiffness(i - 1, i) -= spring;
    }
    angle += stiffness.ldlt().solve(torque);
  }
  return {angle.array().cos().sum() * h, -angle.array().sin().sum() * h};
}

TEST(HeavyElastica, IsTheLimitOfAChain) {
  for (const double load : {0.1, 1.0, 4.0, 20.0, 50.0}) {
    const Eigen::Vector2d coarse = end_of_chain(load, 100), fine = end_of_chain(load, 200);
    const Eigen::Vector2d expected = fine + (fine - coarse) / 3;
    const HeavyElastica::Section end = HeavyElastica(1, load).at(1);
    EXPECT_NEAR(end.x, expected.x(), 1e-5) << load;
    EXPECT_NEAR(end.z, expected.y(), 1e-5) << load;
  }
}

/// A beam: w = q (s^4 - 4 L s^3 + 6 L^2 s^2) / 24 D, q L^4 / 8 D at the end.
TEST(HeavyElastica, IsABeamUnderASmallLoad) {
  const double length = 0.7, load = 1e-3;
  const HeavyElastica elastica(length, load);
  for (const double t : {0.0, 0.1, 0.3337, 0.8, 1.0}) {
    const HeavyElastica::Section section = elastica.at(t * length);
    EXPECT_NEAR(section.z / length, -load * t * t * (t * t - 4 * t + 6) / 24, 1e-6 * load);
    EXPECT_NEAR(section.x / length, t, load * load);
  }
}

/// Inextensible between sections, too, straight before the clamp and beyond the end.
TEST(HeavyElastica, KeepsItsLength) {
  const HeavyElastica elastica(2, 10);
  double length = 0;
  HeavyElastica::Section before = elastica.at(0);
  for (int i = 1; i <= 7777; ++i) {
    const HeavyElastica::Section now = elastica.at(2 * i / 7777.0);
    length += std::hypot(now.x - before.x, now.z - before.z);
    before = now;
  }
  EXPECT_NEAR(length, 2, 1e-6);
  EXPECT_EQ(elastica.at(-0.3).x, -0.3);
  EXPECT_EQ(elastica.at(-0.3).z, 0);
  EXPECT_NEAR(std::hypot(elastica.at(2.5).x - before.x, elastica.at(2.5).z - before.z), 0.5, 1e-12);
}

// --- the problems ----------------------------------------------------------------------------------------------------

Sheet cut_open(const Specimen& specimen, const std::vector<Curve>& cuts, const std::string& method) {
  Sheet sheet(specimen.mesh);
  Locator locator(sheet);
  Cutter cutter;
  const MethodRow& row = find_method(method);
  for (const Curve& curve : cuts)
    EXPECT_EQ(cutter.cut(sheet, locator, curve, *row.make(row.parameter.value), {}).status, Status::ok);
  return sheet;
}

Answer solved(const Problem& problem, const Specimen& specimen, const Sheet& sheet) {
  const Budget directly;
  const std::vector<Answer> answers = problem.answer(specimen, sheet, {&directly, 1});
  EXPECT_EQ(answers.size(), 1u);
  EXPECT_EQ(answers[0].verdict, Verdict::ok) << answers[0].reason;
  EXPECT_GT(answers[0].unknowns, 0u);
  EXPECT_GT(answers[0].solve_us, 0);
  const std::vector<std::string> names = problem.measures();
  EXPECT_EQ(answers[0].measures.size(), names.size());
  for (std::size_t i = 0; i < answers[0].measures.size(); ++i) EXPECT_EQ(answers[0].measures[i].name, names[i]);
  return answers[0];
}

/// The errors of one member, in the order of the problem's measures, at most `bounds`.
void expect_within(const Problem& problem, int n, const std::vector<double>& bounds,
                   const std::vector<std::size_t>& members) {
  for (const std::string family : {"alternating", "delaunay"})
    for (const std::string method : {"conventional_split", "cgal_cdt"})
      for (const std::size_t i : members) {
        SCOPED_TRACE(family + ", " + method + ", member " + std::to_string(i));
        const Specimen specimen = problem.specimen(family, n, 1, i);
        EXPECT_EQ(specimen.mesh.triangles.size(), to_size(2 * n * n));
        const Answer answer = solved(problem, specimen, cut_open(specimen, specimen.cuts, method));
        for (std::size_t k = 0; k < bounds.size(); ++k) {
          const Measure& m = answer.measures.at(k);
          EXPECT_LE(m.error, bounds[k]) << m.name;
        }
      }
}

TEST(OutOfPlane, ASlitLeavesABentPatchAsItIs) { expect_within(BendingPatchSlit(), 14, {1e-4, 5e-4, 1e-6}, {0, 1, 2}); }
TEST(OutOfPlane, HalvesHangLikeTheWholeAndTheElastica) {
  expect_within(SlitStrip(), 14, {7e-3, 7e-3, 0.015}, {1, 3});
  expect_within(SlitStrip(), 14, {0.03, 0.03, 0.06}, {0, 2});  // with slivers
}
TEST(OutOfPlane, AFlapHangsAsHeavyElastica) { expect_within(Flap(), 20, {4e-3, 5e-3}, {0, 1}); }
TEST(OutOfPlane, ATearReleasesWhatPullsTheLegs) { expect_within(TrouserTear(), 20, {0.15}, {0}); }

TEST(OutOfPlane, SpecimensDependOnTheirArgumentsAlone) {
  const BendingPatchSlit patch;
  const SlitStrip strip;
  const Flap flap;
  const TrouserTear tear;
  for (const Problem* problem : std::initializer_list<const Problem*>{&patch, &strip, &flap, &tear}) {
    const Specimen a = problem->specimen("grid", 8, 3, 5), b = problem->specimen("grid", 8, 3, 5);
    EXPECT_TRUE(std::equal(a.mesh.rest.begin(), a.mesh.rest.end(), b.mesh.rest.begin(), b.mesh.rest.end()));
    EXPECT_EQ(a.cuts.at(0).points, b.cuts.at(0).points);
    // The same cut on every sheet (of odd members), another one for another member or seed.
    EXPECT_EQ(a.cuts[0].points, problem->specimen("delaunay", 12, 3, 5).cuts[0].points);
    EXPECT_NE(a.cuts[0].points, problem->specimen("grid", 8, 3, 6).cuts[0].points);
    EXPECT_NE(a.cuts[0].points, problem->specimen("grid", 8, 4, 5).cuts[0].points);
  }
}

// --- what is wrong is noticed ----------------------------------------------------------------------------------------

double primary_error(const Problem& problem, const Specimen& specimen, const Sheet& sheet) {
  return solved(problem, specimen, sheet).measures.at(0).error;
}

TEST(OutOfPlane, HingesAreNoticed) {
  const auto compare = [](const Problem& right, const Problem& wrong) {
    const Specimen specimen = right.specimen("delaunay", 14, 1, 0);
    const Sheet sheet = cut_open(specimen, specimen.cuts, "conventional_split");
    const double error = primary_error(wrong, specimen, sheet);
    EXPECT_GT(error, 5e-3) << right.name();
    EXPECT_GT(error, 10 * primary_error(right, specimen, sheet)) << right.name();
  };
  compare(BendingPatchSlit(), BendingPatchSlit(BendingKind::hinges));
  compare(SlitStrip(), SlitStrip(BendingKind::hinges));
  compare(Flap(), Flap(BendingKind::hinges));
}

/// Lips that run in steps of a triangle, beside the requested slit.
TEST(OutOfPlane, AJaggedSlitIsNoticed) {
  const BendingPatchSlit problem;
  const Specimen specimen = problem.specimen("alternating", 14, 1, 0);
  Curve jagged = specimen.cuts[0];
  jagged.points = {};
  for (int i = 0; i <= 6; ++i)
    jagged.points.push_back(from_frame(specimen, {-0.2 + 0.4 * i / 6, i % 2 == 0 ? 0.02 : -0.02}));
  const double straight = primary_error(problem, specimen, cut_open(specimen, specimen.cuts, "conventional_split"));
  EXPECT_GT(primary_error(problem, specimen, cut_open(specimen, {jagged}, "conventional_split")), 10 * straight);
}

TEST(OutOfPlane, AFlapThatHangsOnIsNoticed) {
  const Flap problem;
  const Specimen specimen = problem.specimen("delaunay", 14, 1, 0);
  std::vector<Curve> cuts = specimen.cuts;
  cuts[0].points.back() = from_frame(specimen, {0.25, 0.2});
  EXPECT_GT(primary_error(problem, specimen, cut_open(specimen, cuts, "cgal_cdt")), 0.03);
}

/// The energy that a tear releases is in proportion to its length.
TEST(OutOfPlane, ATearThatLosesATenthIsNoticed) {
  const TrouserTear problem;
  double whole = 0, rest = 0;
  for (std::size_t i = 0; i < 2; ++i) {
    const Specimen specimen = problem.specimen("delaunay", 20, 1, i);
    std::vector<Curve> shorter = specimen.cuts;
    const double torn = shorter[1].points[1].x - shorter[1].points[0].x;
    shorter[1].points[1].x -= 0.1 * torn;
    const auto released = [&](const std::vector<Curve>& cuts) {
      const Measure m = solved(problem, specimen, cut_open(specimen, cuts, "bowyer_watson")).measures.at(0);
      return m.value / m.exact;
    };
    whole += released(specimen.cuts) / 2;
    rest += released(shorter) / 2;
  }
  std::printf("released of 2 F: %.4f by the whole tear, %.4f by nine tenths of it\n", whole, rest);
  EXPECT_NEAR(whole, 1, 0.03);
  EXPECT_NEAR(rest, 0.9, 0.03);
}

/// Where Newton's method begins makes no difference, so the exact solution it begins at can't have slipped in.
TEST(BentSheet, SettlesInTheSameShapeFromFlat) {
  const Sheet sheet(make_sheet("alternating", 10));
  const HeavyElastica elastica(1, 4);
  std::vector<Point3> ends;
  for (const bool flat : {false, true}) {
    BentSheet bent(sheet, {.density = 1, .stiffness = 2e4, .poisson = 0, .bending = 1}, BendingKind::patches, 4,
                   [&](DeformedIndex d) {
                     const Point2 p = sheet.rest(sheet.rest_vertex(d));
                     const HeavyElastica::Section s = elastica.at(p.x);
                     const bool held = p.x <= 0.2;
                     return Start{flat && !held ? Point3{p.x, p.y, 0} : Point3{s.x, p.y, s.z}, {held, held, held}};
                   });
    Answer answer;
    ASSERT_TRUE(bent.solve_to_equilibrium({.name = "cholmod"}, answer)) << answer.reason;
    for (const DeformedIndex d : vertices_in_use(sheet)) ends.push_back(bent.position(d));
    std::printf("%d Newton iterations from %s\n", answer.iterations, flat ? "flat" : "the exact shape");
  }
  const std::size_t half = ends.size() / 2;
  for (std::size_t i = 0; i < half; ++i) {
    EXPECT_NEAR(ends[i].x, ends[half + i].x, 1e-6);
    EXPECT_NEAR(ends[i].z, ends[half + i].z, 1e-6);
  }
}

}  // namespace
}  // namespace cutbench
