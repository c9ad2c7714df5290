// Polygons of triangles as finite elements: the polygons that the method makes, the element, and all of a sheet.

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "harness/base/conversions.h"
#include "harness/cases/adversarial.h"
#include "harness/cases/cut_families.h"
#include "harness/cut/constraint_source.h"
#include "harness/fem/model/largest_eigenvalue.h"
#include "harness/fem/time/stepper.h"
#include "harness/mesh/families.h"
#include "harness/mesh/predicates.h"
#include "methods/tools/divided.h"
#include "tests/constrained_cut.h"
#include "tests/dense_solves.h"
#include "tests/fem_helpers.h"
#include "tests/helpers.h"
#include "tests/sound_polygons.h"
#include "tests/truth_helpers.h"

namespace cutbench {
namespace {

TEST(Polygons, AreSound) {
  std::size_t polygons = 0, inside = 0;
  for_each_constrained_cut({cut_polygons}, 9, 3, 877, [&](const ConstrainedCut& cut) {
    expect_sound(cut.sheet(), cut.constraints.polygons);
    polygons += cut.constraints.polygons.size();
    for (const Polygon& polygon : cut.constraints.polygons) inside += polygon.inside.size();
  });
  EXPECT_GT(polygons, scaled(500));
  EXPECT_GT(inside, scaled(5));
}

/// One to five cuts that just meet or just miss vertices, edges and each other; the forces of every polygon are finite.
TEST(Polygons, AreSoundAfterAdversarialCuts) {
  for (const std::string family : sheet_families())
    for (std::size_t i = 0; i < scaled(60); ++i) {
      SCOPED_TRACE(family + ", case " + std::to_string(i));
      const Sheet before(make_sheet(family, 8));
      Sheet sheet = before;
      Locator locator(sheet);
      const auto method = find_method("cut_polygons").make(0.7);
      for (const Curve& curve : make_adversarial_case(877, i, before).cuts) {
        Cutter().cut(sheet, locator, curve, *method, {});
        const Constraints constraints = constraints_of(*method, before, sheet);
        expect_sound(sheet, constraints.polygons);
        for (const Polygon& polygon : constraints.polygons) {
          const PolygonElement element(sheet, polygon);
          EXPECT_GT(element.area, 0);
          EXPECT_TRUE(element.departure.allFinite());
        }
      }
    }
}

/// To others a polygon is an element as a triangle is: with corners, gradients that add up to nothing, and its share
/// of area.
TEST(Polygons, AreElementsOfTheTable) {
  for_each_constrained_cut({cut_polygons}, 9, 3, 877, [&](const ConstrainedCut& cut) {
    const Sheet& sheet = cut.sheet();
    ElementTable elements(sheet);
    const double area = elements.areas(sheet.deformed_slots()).sum();
    Regrouped regrouped;
    for (const Polygon& polygon : cut.constraints.polygons) {
      ASSERT_EQ(elements.merge(sheet, {.polygons = {polygon}}, regrouped).size(), 1u);
      EXPECT_TRUE(elements.merge(sheet, {.polygons = {polygon}}, regrouped).empty()) << "it is there already";
      for (const TriangleIndex t : polygon.triangles) {
        const ElementShape shape = elements.shape(t);
        EXPECT_TRUE(std::ranges::equal(shape.corners, polygon.corners));
        Point2 sum{};
        for (const Point2 g : shape.gradient) sum = sum + g;
        EXPECT_LT(squared_length(sum), 1e-18 * squared_length(shape.gradient[0]));
      }
    }
    EXPECT_EQ(elements.merged().polygons, cut.constraints.polygons);
    EXPECT_NEAR(elements.areas(sheet.deformed_slots()).sum(), area, 1e-12 * area);
    elements.begin_change();
    for (const Polygon& polygon : cut.constraints.polygons) {
      EXPECT_EQ(elements.left_since_change().of(polygon.triangles[0]).size(), polygon.triangles.size());
      elements.release(polygon.triangles[1], regrouped);
      EXPECT_EQ(elements.shape(polygon.triangles[0]).corners.size(), 3u);
      EXPECT_TRUE(elements.left_since_change().of(polygon.triangles[0]).empty());
      EXPECT_TRUE(
          std::ranges::equal(elements.left_since_change().freed.last(polygon.triangles.size()), polygon.triangles));
    }
    EXPECT_TRUE(elements.merged().polygons.empty());
    EXPECT_EQ(regrouped.triangles.size(), 2 * elements.left_since_change().freed.size());
    EXPECT_EQ(elements.areas(sheet.deformed_slots()).sum(), area);
  });
}

/// Against a look at every triangle of the sheet before.
TEST(Polygons, DividedTrianglesLieInTheirParents) {
  for_each_constrained_cut({cut_polygons}, 7, 1, 877, [&](const ConstrainedCut& cut) {
    std::set<TriangleIndex> parts;
    for (const auto& [part, parent] : divided_triangles(cut.before, cut.sheet())) {
      parts.insert(part);
      const auto c = cut.sheet().corners(part);
      const Point2 centroid = 1.0 / 3 * (c[0] + c[1] + c[2]);
      TriangleIndex holder;
      for (std::size_t t = 0; t < cut.before.triangle_slots(); ++t) {
        const auto p = cut.before.corners(TriangleIndex(t));
        if (orientation(p[0], p[1], centroid) > 0 && orientation(p[1], p[2], centroid) > 0 &&
            orientation(p[2], p[0], centroid) > 0)
          holder = TriangleIndex(t);
      }
      if (holder.valid()) {  // not a sliver on an edge
        EXPECT_EQ(parent, holder);
      }
    }
    for (std::size_t t = 0; t < cut.sheet().triangle_slots(); ++t) {
      const Triangle& triangle = cut.sheet().triangle(TriangleIndex(t));
      const bool was_there =
          t < cut.before.triangle_slots() && cut.before.triangle(TriangleIndex(t)).vertex == triangle.vertex;
      if (triangle.alive() && !was_there) {
        EXPECT_TRUE(parts.contains(TriangleIndex(t)));
      }
    }
  });
}

/// What is attached to a vertex keeps it out of polygons.
TEST(Polygons, HoldNoHeldVertexInside) {
  std::size_t free_inside = 0;
  for (std::size_t i = 0; i < scaled(20); ++i) {
    Sheet before(make_sheet("grid", 9)), held = before;
    for (std::size_t v = 0; v < held.vertex_slots(); ++v) held.hold(VertexIndex(v));
    for (const bool holds : {false, true}) {
      Sheet sheet = holds ? held : before;
      Locator locator(sheet);
      const auto method = find_method("cut_polygons").make(0.7);
      for (const Curve& curve : make_case("several", 31, i, sheet)) Cutter().cut(sheet, locator, curve, *method, {});
      for (const Polygon& polygon : constraints_of(*method, holds ? held : before, sheet).polygons)
        for (const DeformedIndex d : polygon.inside) {
          EXPECT_FALSE(sheet.is_held(sheet.rest_vertex(d)));
          free_inside += !holds;
        }
    }
  }
  EXPECT_GT(free_inside, 0u);
}

// --- the element -----------------------------------------------------------------------------------------------------

/// The mean gradient is the integral of the field along the border, here by the trapezoidal rule side by side.
TEST(PolygonElement, HasTheMeanGradientOfItsBorderAndDepartsFromNoLinearMap) {
  Random random(3);
  for_each_constrained_cut({cut_polygons}, 7, 1, 877, [&](const ConstrainedCut& cut) {
    for (const Polygon& polygon : cut.constraints.polygons) {
      const PolygonElement element(cut.sheet(), polygon);
      double area = 0;
      for (const TriangleIndex t : polygon.triangles) {
        const auto c = cut.sheet().corners(t);
        area += cross(c[1] - c[0], c[2] - c[0]) / 2;
      }
      EXPECT_NEAR(element.area, area, 1e-12 * area);
      Field x = Field::Zero(to_index(2 * cut.sheet().deformed_slots())), affine = x;
      for (auto& value : x) value = random.between(-1, 1);
      Eigen::Matrix2d expected = Eigen::Matrix2d::Zero(), slope;
      slope << 0.3, -0.7, 1.1, 0.2;
      const auto place = [&](DeformedIndex d) {
        const Point2 p = cut.sheet().rest(cut.sheet().rest_vertex(d));
        return Eigen::Vector2d(p.x, p.y);
      };
      for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
        const DeformedIndex from = polygon.corners[i], to = polygon.corners[(i + 1) % polygon.corners.size()];
        const Eigen::Vector2d side = place(to) - place(from);
        expected += (x.segment<2>(2 * from.value) + x.segment<2>(2 * to.value)) / 2 *
                    Eigen::RowVector2d(side.y(), -side.x()) / area;
        affine.segment<2>(2 * from.value) = Eigen::Vector2d(5, 2) + slope * place(from);
      }
      EXPECT_LE((element.map<2>(x).gradient - expected).norm(), 1e-10 * expected.norm());
      const LinearMap<2> map = element.map<2>(affine);
      EXPECT_LE((map.gradient - slope).norm(), 1e-11);
      for (const TriangleIndex t : polygon.triangles)
        for (const DeformedIndex d : cut.sheet().triangle(t).deformed)
          EXPECT_LE((map.at(element.offset_of(d)) - Eigen::Vector2d(5, 2) - slope * place(d)).norm(), 1e-11);
      for (std::size_t i = 0; i < polygon.corners.size(); ++i)
        for (Eigen::Index axis = 0; axis < 2; ++axis) {
          double departs = 0;
          for (std::size_t j = 0; j < polygon.corners.size(); ++j)
            departs += element.departure(to_index(i), to_index(j)) * affine[2 * polygon.corners[j].value + axis];
          EXPECT_LE(std::abs(departs), 1e-11);
        }
    }
  });
}

constexpr Material skin{.density = 2, .stiffness = 1000, .poisson = 0.3, .bending = 0.02};

/// Forces are the slope of the energy, by differences along random directions; in space with and without bending.
template <int D>
void forces_are_the_slope_of_the_energy(Strain strain, BendingKind bending) {
  const ConstrainedCut cut("alternating", 6, cut_polygons, "curved", 877, 1);
  ASSERT_FALSE(cut.constraints.polygons.empty());
  Model<D> model(cut.sheet(), skin, {.dimension = D, .strain = strain, .bending = bending}, {}, {});
  model.constrain(cut.sheet(), cut.constraints);
  Random random(5);
  Field x = bent(model, cut.sheet());
  for (auto& value : x) value += random.between(-0.01, 0.01);
  Field force = Field::Zero(x.size());
  model.rotate(x);
  model.add_internal_force(x, force);
  const auto energy = [&](const Field& at) {
    model.rotate(at);
    const Energy e = model.energy(at, Field::Zero(at.size()));
    return e.membrane + e.bending;
  };
  for (int i = 0; i < 20; ++i) {
    Field way = Field::Zero(x.size());
    for (std::size_t d = 0; d < model.vertices(); ++d)
      for (int axis = 0; axis < D; ++axis)
        if (!model.held()[D * d + to_size(axis)]) way[to_index(D * d) + axis] = random.between(-1, 1);
    constexpr double h = 1e-6;
    const double slope = (energy(x + h * way) - energy(x - h * way)) / (2 * h);
    EXPECT_NEAR(-force.dot(way), slope, 1e-6 * force.norm() * way.norm());
  }
}

TEST(PolygonSheet, ForcesAreTheSlopeOfTheEnergy) {
  for (const Strain strain : {Strain::linear, Strain::corotational, Strain::green}) {
    forces_are_the_slope_of_the_energy<2>(strain, BendingKind::none);
    forces_are_the_slope_of_the_energy<3>(strain, BendingKind::none);
    forces_are_the_slope_of_the_energy<3>(strain, BendingKind::patches);
  }
}

TEST(PolygonSheet, ASpringSheetRefusesThem) {
  const ConstrainedCut cut("alternating", 6, cut_polygons, "curved", 877, 1);
  Model<3> model(cut.sheet(), skin, {.strain = Strain::springs}, {}, {});
  EXPECT_THROW(model.constrain(cut.sheet(), cut.constraints), InputError);
}

TEST(PolygonSheet, TurningCostsNothing) {
  for_each_constrained_cut({cut_polygons}, 6, 1, 877, [&](const ConstrainedCut& cut) {
    for (const Strain strain : {Strain::corotational, Strain::green}) {
      Model<3> model(cut.sheet(), skin, {.strain = strain, .bending = BendingKind::patches}, {}, {});
      model.constrain(cut.sheet(), cut.constraints);
      const Eigen::AngleAxisd turn(2.1, Eigen::Vector3d(1, 2, -1).normalized());
      Field x = model.positions(cut.sheet()), force = Field::Zero(x.size());
      for (Eigen::Index v = 0; v < x.size(); v += 3) x.segment<3>(v) = (turn * Eigen::Vector3d(x.segment<3>(v))).eval();
      model.rotate(x);
      model.add_internal_force(x, force);
      const Energy energy = model.energy(x, Field::Zero(x.size()));
      EXPECT_LE(force.cwiseAbs().maxCoeff(), 1e-8 * skin.stiffness);
      EXPECT_LE(energy.membrane + energy.bending, 1e-20 * skin.stiffness);
    }
  });
}

/// In the plane the stiffness is that of the linear forces, and has no modes of zero energy but those of rigid pieces:
/// the stabilisation leaves none.
TEST(PolygonSheet, StiffnessIsThatOfTheForcesAndHasThreeNullModesPerPiece) {
  for_each_constrained_cut({cut_polygons}, 4, 1, 877, [&](const ConstrainedCut& cut) {
    Model<2> model(cut.sheet(), {.density = 1, .stiffness = 1, .poisson = 0.3},
                   {.dimension = 2, .strain = Strain::linear, .bending = BendingKind::none}, {}, {});
    model.constrain(cut.sheet(), cut.constraints);
    const Field rest = model.positions(cut.sheet());
    model.rotate(rest);
    model.assemble(0, 1);
    const Eigen::MatrixXd k = dense(model);
    Field u = Field::Random(rest.size()), force = Field::Zero(rest.size());
    std::size_t unknowns = 0;
    for (std::size_t i = 0; i < model.held().size(); ++i)
      if (model.held()[i])
        u[to_index(i)] = 0;
      else
        ++unknowns;
    model.rotate(rest + u);
    model.add_internal_force(rest + u, force);
    EXPECT_LE((k * u + force).norm(), 1e-9 * force.norm());
    const Eigen::VectorXd lambda = eigenvalues(k);
    const auto nulls = to_size((lambda.array() < 1e-9 * lambda.maxCoeff()).count());
    const std::size_t left_out = model.held().size() - unknowns;
    if (lambda.maxCoeff() < 1e5) {  // otherwise a strip or a small piece is as stiff as that
      EXPECT_EQ(nulls, left_out + 3 * count_pieces(cut.sheet()));
    }
    double mass = 0;
    for (const double m : model.lumped_mass()) mass += m;
    EXPECT_NEAR(mass, 1, 1e-12);
    Eigen::MatrixXd m = Eigen::MatrixXd::Identity(k.rows(), k.cols());
    for (Eigen::Index i = 0; i < k.rows(); ++i)
      if (model.lumped_mass()[i / 2] > 0) m(i, i) = model.lumped_mass()[i / 2];
    const double expected = largest_mode(k, m);
    EXPECT_NEAR(largest_eigenvalue(cut.sheet(), cut.constraints), expected, 1e-3 * expected);
  });
}

/// What corners depart from a quadratic along the normal costs what it says, in small pieces, too: else they fly off.
TEST(PolygonSheet, NoCornerLeavesThePlaneForNothing) {
  Random random(7);
  std::size_t checked = 0;
  for_each_constrained_cut({cut_polygons}, 5, 2, 877, [&](const ConstrainedCut& cut) {
    Model<3> model(cut.sheet(), skin, {.bending = BendingKind::patches}, {}, {});
    model.constrain(cut.sheet(), cut.constraints);
    for (const Polygon& polygon : cut.constraints.polygons) {
      const auto k = to_index(polygon.corners.size());
      const double area = PolygonElement(cut.sheet(), polygon).area;
      Eigen::MatrixXd quadratics(k, 6);
      Eigen::VectorXd up(k);
      const Point2 origin = cut.sheet().rest(cut.sheet().rest_vertex(polygon.corners[0]));
      for (Eigen::Index i = 0; i < k; ++i) {
        const Point2 p =
            1 / std::sqrt(area) * (cut.sheet().rest(cut.sheet().rest_vertex(polygon.corners[to_size(i)])) - origin);
        quadratics.row(i) << 1, p.x, p.y, p.x * p.x, p.x * p.y, p.y * p.y;
        up[i] = random.between(-1e-6, 1e-6) * std::sqrt(area);
      }
      up -= quadratics * quadratics.completeOrthogonalDecomposition().solve(up);
      if (k < 8 || up.norm() < 1e-7 * std::sqrt(area)) continue;
      Field x = model.positions(cut.sheet());
      for (Eigen::Index i = 0; i < k; ++i) x[3 * polygon.corners[to_size(i)].value + 2] = up[i];
      model.rotate(x);
      const Energy energy = model.energy(x, Field::Zero(x.size()));
      const double stiffness =
          std::min(8 * (1 - skin.poisson) * skin.bending / area, polygon.stabilisation * skin.stiffness);
      EXPECT_GE(energy.membrane + energy.bending, 0.99 * stiffness * up.squaredNorm() / 2);
      ++checked;
    }
  });
  EXPECT_GT(checked, is_small_scale() ? 10u : 100u);
}

/// Its twist is a quadratic, and bending of two triangles alone sees none. What holds its corners is that it stretches:
/// as von Karman's plate does (compound_sheet.h), to a quarter.
TEST(PolygonSheet, NoCornerGoesFarFromThePlaneForNothing) {
  const Sheet sheet(make_sheet("alternating", 1));
  ASSERT_EQ(sheet.triangle_count(), 2u);
  const auto corner_at = [&](Point2 p) {
    for (std::size_t d = 0;; ++d)
      if (sheet.rest(sheet.rest_vertex(DeformedIndex(d))) == p) return DeformedIndex(d);
  };
  const std::vector<DeformedIndex> corners{corner_at({0, 0}), corner_at({1, 0}), corner_at({1, 1}), corner_at({0, 1})};
  Model<3> model(sheet, skin, {.bending = BendingKind::patches}, {}, {});
  model.constrain(sheet, {.polygons = {{corners, {TriangleIndex(0), TriangleIndex(1)}, {}}}});
  for (const double up : {0.01, 0.3}) {
    Field x = model.positions(sheet);
    for (std::size_t i = 0; i < 4; ++i) x[3 * corners[i].value + 2] = i % 2 == 0 ? up : -up;
    model.rotate(x);
    EXPECT_NEAR(model.energy(x, Field::Zero(x.size())).membrane / (skin.stiffness * std::pow(up, 4)), 1.24, 0.31);
  }
}

}  // namespace
}  // namespace cutbench
