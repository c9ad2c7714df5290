// The model after cuts: equal to a new one, and the invariants of the instant of a cut.

#include "harness/fem/model/model.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Geometry>
#include <map>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/mesh/families.h"
#include "tests/dense_solves.h"
#include "tests/fem_helpers.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

const Material skin{.density = 2.2, .stiffness = 1000, .poisson = 0.45, .bending = 4.2e-4};
const std::vector<Pin> corner_pins{{{{0, 0}, {0, 0}}}, {{{1, 0}, {1, 0}}}};
const std::vector<Traction> pull{{{{1, 0}, {1, 1}}, {3, 1, 0}}};

Physics physics_with(int dimension, Mass mass) {
  Physics physics;
  physics.dimension = dimension;
  physics.mass = mass;
  physics.bending = dimension == 3 ? BendingKind::patches : BendingKind::none;
  physics.gravity = dimension == 3 ? Point3{0, 0, -9.81} : Point3{0, -9.81, 0};
  return physics;
}

template <int D>
void expect_fresh(Body<D>& body) {
  Model<D> fresh = body.fresh_model();
  Model<D>& kept = body.model;
  const Field x = bent(kept, body.sheet);
  ASSERT_EQ(kept.vertices(), fresh.vertices());
  for (Model<D>* model : {&kept, &fresh}) {
    model->rotate(x);
    model->assemble(1.1, 0.01);
  }
  EXPECT_LE(max_difference(kept.blocks(), fresh.blocks()), 1e-12 * max_entry(fresh.blocks()));
  if (kept.bending()) {
    EXPECT_LE(max_difference(kept.bending()->matrix(), fresh.bending()->matrix()),
              1e-12 * max_entry(fresh.bending()->matrix()));
  }
  EXPECT_EQ(kept.held(), fresh.held());
  EXPECT_LE((kept.lumped_mass() - fresh.lumped_mass()).cwiseAbs().maxCoeff(), 1e-14);
  EXPECT_LE((kept.external_force() - fresh.external_force()).cwiseAbs().maxCoeff(), 1e-13);
  Field a = Field::Zero(x.size()), b = a, c = a, d = a;
  kept.add_internal_force(x, a);
  fresh.add_internal_force(x, b);
  EXPECT_LE((a - b).norm(), 1e-12 * b.norm());
  kept.add_mass_product(1, x, c);
  fresh.add_mass_product(1, x, d);
  EXPECT_LE((c - d).norm(), 1e-12 * d.norm());
}

template <int D>
void cut_and_compare(const std::string& method, double parameter, Mass mass) {
  std::size_t made = 0;
  for (const std::string sheet : sheet_families())
    for (const std::string family : cut_families())
      for (std::size_t i = 0; i < scaled(10); i += 5) {
        SCOPED_TRACE(sheet + ", " + family + " " + std::to_string(i));
        Body<D> body(make_sheet(sheet, 8), skin, physics_with(D, mass), corner_pins, pull);
        for (int again = 0; again < 3; ++again)  // the whole history of cuts
          for (const Curve& curve : make_case(family, 20, i + to_size(again), body.sheet)) {
            if (body.cut(curve, method, parameter) != Status::ok) continue;
            ++made;
            expect_fresh(body);
            if (testing::Test::HasFailure()) return;
          }
      }
  EXPECT_GT(made, 2 * sheet_families().size() * cut_families().size());
}

/// Stale element data after a change of topology.
TEST(Model, P3UpdatesToWhatANewOneWouldBe) {
  cut_and_compare<3>("conventional_split", 0, Mass::lumped);
  cut_and_compare<3>("bowyer_watson", 1, Mass::lumped);
  cut_and_compare<2>("cgal_cdt", 0, Mass::consistent);
}

/// No vertex without mass, and what is held stays held, whatever the numbers.
TEST(Model, P2P4EveryVertexHasMassAndPinsStay) {
  for (const std::string sheet : sheet_families()) {
    Body<3> body(make_sheet(sheet, 10), skin, physics_with(3, Mass::lumped), corner_pins);
    const double before = body.model.lumped_mass().sum();
    for (std::size_t i = 0; i < 5; ++i)
      for (const Curve& curve : make_case("several", 3, i, body.sheet)) body.cut(curve);
    EXPECT_NEAR(body.model.lumped_mass().sum(), before, 1e-12 * before);
    for (std::size_t v = 0; v < body.model.vertices(); ++v) {
      const bool used = body.sheet.rest_vertex(DeformedIndex(v)).valid();
      EXPECT_EQ(body.model.lumped_mass()[to_index(v)] > 0, used);
    }
    // A cut through the pinned corner: every copy of it is held.
    ASSERT_EQ(body.cut(line({0, 0}, {0.4, 0.5})), Status::ok);
    std::size_t copies = 0;
    for (std::size_t v = 0; v < body.model.vertices(); ++v) {
      const VertexIndex rest = body.sheet.rest_vertex(DeformedIndex(v));
      if (!rest.valid() || !(body.sheet.rest(rest) == Point2{0, 0})) continue;
      ++copies;
      EXPECT_TRUE(body.model.held()[3 * v] && body.model.held()[3 * v + 1] && body.model.held()[3 * v + 2]);
    }
    EXPECT_EQ(copies, 2u);
  }
}

/// Of a cut sheet, membrane and bending together: each piece turned and moved on its own feels nothing, and the force
/// is the derivative of the energy.
TEST(Model, RigidMotionOfAnyPieceGivesNoForceAndForceIsTheDerivativeOfTheEnergy) {
  for (const auto& row : whole_sheet_methods())
    for (const std::string sheet : sheet_families()) {
      SCOPED_TRACE(row.name + ", " + sheet);
      Body<3> body(make_sheet(sheet, 6), skin, {.bending = BendingKind::patches});
      ASSERT_EQ(body.cut(line({-0.1, 0.43}, {1.1, 0.57}), row.name, 0), Status::ok);
      Model<3>& model = body.model;
      Field x = body.state.x;
      for (std::size_t e = 0; e < model.elements().size(); ++e) {
        if (!body.sheet.triangle(TriangleIndex(e)).alive()) continue;
        const Element& element = model.elements()[e];
        const auto c = body.sheet.corners(TriangleIndex(e));
        const bool upper = c[0].y + c[1].y + c[2].y > 3 * 0.43 + 0.14 * (c[0].x + c[1].x + c[2].x + 0.3) / 1.2;
        const Eigen::AngleAxisd turn(upper ? 2.1 : -0.7, Eigen::Vector3d(1, upper ? 2 : -1, 3).normalized());
        for (const auto d : element.vertex) {
          const Point2 rest = body.sheet.rest(body.sheet.rest_vertex(d));
          x.segment<3>(3 * d.value) = turn * Eigen::Vector3d(rest.x, rest.y, 0) + Eigen::Vector3d(upper ? 5 : -2, 1, 0);
        }
      }
      model.rotate(x);
      Field force = Field::Zero(x.size());
      model.add_internal_force(x, force);
      EXPECT_LE(force.cwiseAbs().maxCoeff(), 1e-12 * skin.stiffness);

      const Field still = Field::Zero(x.size());
      x = bent(model, body.sheet);
      model.rotate(x);
      force.setZero();
      model.add_internal_force(x, force);
      Random random(8);
      for (int i = 0; i < 10; ++i) {
        Field direction(x.size());
        for (auto& value : direction) value = random.between(-1, 1);
        const double h = 1e-7;
        const auto energy = [&](double step) {
          const Field moved = x + step * direction;
          model.rotate(moved);
          return model.energy(moved, still).total();
        };
        EXPECT_NEAR((energy(h) - energy(-h)) / (2 * h), -force.dot(direction), 1e-5 * force.norm() * direction.norm());
      }
    }
}

/// Linear momentum and membrane energy do not change where vertices neither move nor edges flip.
TEST(Model, NothingJumpsInThePlaneAtASplit) {
  for (const Mass mass : {Mass::lumped, Mass::consistent})
    for (const std::string sheet : sheet_families())
      for (const std::string family : cut_families()) {
        SCOPED_TRACE(sheet + ", " + family);
        Body<3> body(make_sheet(sheet, 10), skin, physics_with(3, mass));
        body.state.x = bent(body.model, body.sheet);
        body.state.v = (2 * body.state.x.array()).sin();
        const Balance before = balance_of(body.model, body.state);
        for (const Curve& curve : make_case(family, 4, 1, body.sheet)) body.cut(curve, "conventional_split");
        const Balance after = balance_of(body.model, body.state);
        EXPECT_NEAR(after.energy.membrane, before.energy.membrane, 1e-12 * before.energy.membrane);
        const double scale = body.model.lumped_mass().sum();
        EXPECT_NEAR(after.momentum.x, before.momentum.x, 1e-12 * scale);
        EXPECT_NEAR(after.momentum.y, before.momentum.y, 1e-12 * scale);
        EXPECT_NEAR(after.momentum.z, before.momentum.z, 1e-12 * scale);
        if (mass == Mass::consistent) {
          EXPECT_NEAR(after.energy.kinetic, before.energy.kinetic, 1e-12 * before.energy.kinetic);
        }
      }
}

/// A linear field in the plane leaves no force inside, on any mesh of any shapes, cut or not.
TEST(Model, PatchTestOnCutSheets) {
  double worst_ratio = 0;
  for (const auto& row : whole_sheet_methods())
    for (const std::string sheet : sheet_families())
      for (std::size_t i = 0; i < scaled(10); ++i) {
        Body<2> body(make_sheet(sheet, 10), {.stiffness = 1e6, .poisson = 0.25},
                     {.dimension = 2, .strain = Strain::linear});
        ASSERT_EQ(body.cut(make_case("straight", 5, i, body.sheet).front(), row.name, row.parameter.value), Status::ok);
        Model<2>& model = body.model;
        Field u = Field::Zero(body.state.x.size());
        for (std::size_t v = 0; v < model.vertices(); ++v) {
          const VertexIndex rest = body.sheet.rest_vertex(DeformedIndex(v));
          if (!rest.valid()) continue;
          const Point2 p = body.sheet.rest(rest);
          u[2 * to_index(v)] = 1e-3 * (p.x + p.y / 2);
          u[2 * to_index(v) + 1] = 1e-3 * (p.y + p.x / 2);
        }
        model.rotate(model.positions(body.sheet) + u);
        model.assemble(0, 1);
        Field residual = Field::Zero(u.size());
        model.blocks().add_product(1, u, residual);
        const double scale = max_entry(model.blocks()) * u.cwiseAbs().maxCoeff();
        // Vertices that neither the border nor an incision touches.
        for (std::size_t v = 0; v < model.vertices(); ++v) {
          bool inner = true;
          for (const auto c : model.incidence().at(v))
            for (const HalfEdge h : {c, Sheet::previous(c)})
              inner &= !body.sheet.on_border(h) && body.sheet.mark(h) == EdgeMark::none;
          if (!inner) continue;
          for (int k = 0; k < 2; ++k)
            worst_ratio = std::max(worst_ratio, std::abs(residual[2 * to_index(v) + k]) / scale);
        }
      }
  EXPECT_LE(worst_ratio, 1e-12);
  std::cout << "largest interior residual of the exact field: " << worst_ratio << " |K||u|\n";
}

/// Three in-plane rigid motions for every piece, and the two unknowns of every vertex that a method took out.
TEST(Model, NullModesArePiecesTimesThree) {
  for (const auto& row : whole_sheet_methods())
    for (const std::string sheet : sheet_families()) {
      SCOPED_TRACE(row.name + ", " + sheet);
      Body<2> body(make_sheet(sheet, 5), {.stiffness = 1000, .poisson = 0.3},
                   {.dimension = 2, .strain = Strain::linear});
      body.cut(line({-0.1, 0.43}, {1.1, 0.57}), row.name, row.parameter.value);
      body.cut(polygon({{0.22, 0.71}, {0.55, 0.73}, {0.41, 0.93}}), row.name, row.parameter.value);
      ASSERT_EQ(count_pieces(body.sheet), 3u);
      body.model.rotate(body.state.x);
      body.model.assemble(0, 1);
      const Eigen::VectorXd modes = eigenvalues(dense(body.model));
      const double zero = 1e-12 * modes[modes.size() - 1];
      const auto expected = to_index(9 + 2 * (body.sheet.deformed_slots() - body.sheet.deformed_count()));
      EXPECT_EQ((modes.array() < zero).count(), expected);
      EXPECT_GT(modes[expected], 1e3 * zero) << "a gap";
    }
}

/// add_impulse() against forces and the dense matrix, one by one.
template <int D>
void expect_plain_impulse(const Physics& physics) {
  Body<D> body(make_sheet("delaunay", 6), skin, physics, corner_pins);
  ASSERT_EQ(body.cut(line({0.2, 0.3}, {0.7, 0.61})), Status::ok);
  Model<D>& model = body.model;
  const Field x = bent(model, body.sheet), v = (3 * x.array()).sin();
  const double h = 0.01, factor = 0.7;
  model.rotate(x);
  model.assemble(1.1, 0.02);
  Field force = Field::Zero(x.size()), impulse = v;
  model.add_internal_force(x, force);
  model.add_impulse(h, x, factor, v, impulse);
  const Field pushed = h * force, slowed = factor * (dense(model) * v);
  EXPECT_LE((impulse - (v + pushed - slowed)).norm(), 1e-12 * (v.norm() + pushed.norm() + slowed.norm()));
}

TEST(Model, ImpulseIsForcesLessMatrixTimesVelocity) {
  for (const Mass mass : {Mass::lumped, Mass::consistent}) {
    expect_plain_impulse<2>(physics_with(2, mass));
    for (const BendingKind kind : {BendingKind::none, BendingKind::patches, BendingKind::hinges}) {
      Physics physics = physics_with(3, mass);
      physics.bending = kind;
      expect_plain_impulse<3>(physics);
    }
  }
}

/// The order of vertices and triangles does not matter.
/// What rotate_once() and energy() keep is gone with the next positions, and with the next cut.
TEST(Model, KeepsNoRotationOfBefore) {
  const Physics physics{.bending = BendingKind::patches, .gravity = {0, 0, -9.81}};
  Body<3> body(make_sheet("delaunay", 6), {.bending = 4.2e-4}, physics, {{.where = {{0, 0}, {0, 1}}}});
  const auto total = [](Model<3>& model, const Field& x) {
    model.rotate_once(x);
    return model.energy(x, 0.1 * x).total();
  };
  const auto expect_current = [&](const Field& x) {
    Model<3> fresh = body.fresh_model();
    const double expected = total(fresh, x);
    EXPECT_NEAR(total(body.model, x), expected, 1e-11 * std::abs(expected));
    EXPECT_NEAR(total(body.model, x), expected, 1e-11 * std::abs(expected)) << "for nothing";
  };
  body.state.x = bent(body.model, body.sheet);
  expect_current(body.state.x);
  expect_current(0.9 * body.state.x);
  body.model.rotate(body.state.x);
  expect_current(0.9 * body.state.x);
  const double before = total(body.model, body.state.x);
  ASSERT_EQ(body.cut(line({0.31, 0.2}, {0.48, 0.83})), Status::ok);
  expect_current(body.state.x);
  EXPECT_NE(total(body.model, body.state.x), before);
}

TEST(Model, P8NumberingDoesNotMatter) {
  MeshData mesh = make_sheet("delaunay", 8), shuffled = mesh;
  Random random(6);
  std::vector<std::size_t> to(mesh.rest.size());
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = i;
  for (std::size_t i = to.size(); i > 1; --i) std::swap(to[i - 1], to[random.below(i)]);
  for (std::size_t i = 0; i < to.size(); ++i) {
    shuffled.rest[to[i]] = mesh.rest[i];
    shuffled.deformed[to[i]] = mesh.deformed[i];
  }
  for (auto& t : shuffled.triangles) {
    for (auto& v : t) v = to_int(to[to_size(v)]);
    std::rotate(t.begin(), t.begin() + to_index(random.below(3)), t.end());
  }
  for (std::size_t i = shuffled.triangles.size(); i > 1; --i)
    std::swap(shuffled.triangles[i - 1], shuffled.triangles[random.below(i)]);
  std::vector<std::map<std::pair<double, double>, Eigen::Vector3d>> forces;
  for (const MeshData& data : {mesh, shuffled}) {
    Body<3> body(data, skin, physics_with(3, Mass::consistent));
    body.cut(line({0.2, 0.3}, {0.7, 0.61}));
    const Field x = bent(body.model, body.sheet);
    body.model.rotate(x);
    body.model.assemble(1, 1);
    Field f = Field::Zero(x.size()), y = f;
    body.model.add_internal_force(x, f);
    body.model.system().add_product(x, y);
    auto& all = forces.emplace_back();
    for (std::size_t v = 0; v < body.model.vertices(); ++v) {
      const Point2 p = body.sheet.rest(body.sheet.rest_vertex(DeformedIndex(v)));
      const auto entry = all.try_emplace({p.x, p.y}, Eigen::Vector3d::Zero()).first;
      entry->second += (f + y).segment<3>(3 * to_index(v));  // both lips together
    }
  }
  ASSERT_EQ(forces[0].size(), forces[1].size());
  for (const auto& [p, f] : forces[0]) {
    const auto other = forces[1].find(p);
    ASSERT_NE(other, forces[1].end());
    EXPECT_LE((f - other->second).norm(), 1e-9 * (1 + f.norm()));
  }
}

}  // namespace
}  // namespace cutbench
