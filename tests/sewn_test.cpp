// Sheets with seams: they move, are cut and are counted like the same sheet without.
#include <gtest/gtest.h>

#include <array>
#include <numeric>

#include "harness/base/random.h"
#include "harness/cut/cut_all.h"
#include "harness/judge/judged_sheet.h"
#include "harness/mesh/mesh_text.h"
#include "harness/mesh/seam_edges.h"
#include "harness/path/pick.h"
#include "harness/simulation/simulation.h"
#include "methods/registry.h"
#include "tests/helpers.h"
#include "tests/sewn_sheets.h"

namespace cutbench {
namespace {

PickedCurve polyline(const std::vector<Point3>& points, bool closed = false) {
  PickedCurve curve{Curve::Kind::polyline, closed, {}};
  for (const Point3& p : points) curve.picks.push_back({p, {}});
  return curve;
}

Scene hanging(const MeshData& mesh) {
  Scene scene;
  scene.mesh = mesh;
  scene.material = {.density = 0.3, .stiffness = 200};
  scene.physics.gravity = {0, 0, -9.81};
  scene.solver.name = "constant_factor";
  ScenePin pin;
  pin.in_space = {{{-1e9, -1e9, -1e9}, {0, 1e9, 1e9}}};
  scene.pins.push_back(pin);
  return scene;
}

/// Where the vertices of the file are after the scene's time; of several copies any, which must agree.
std::map<std::int32_t, Point3> places(const Scene& scene, const char* method, double* apart = nullptr) {
  const auto motion = Simulation::start(scene);
  const auto cutter = find_method(method).make(find_method(method).parameter.value);
  const StepReport report = motion->advance(0.25, *cutter, {});
  EXPECT_EQ(report.verdict, Verdict::ok) << report.reason;
  for (const MotionCut& cut : motion->made_cuts()) EXPECT_EQ(cut.cut.status, Status::ok) << cut.reason;
  const MeshData now = motion->posed_sheet().to_mesh_data();
  std::map<std::int32_t, Point3> result;
  for (std::size_t v = 0; v < scene.mesh->deformed.size(); ++v) {
    const std::int32_t id = scene.mesh->sewn.empty() ? to_int32(v) : scene.mesh->file_vertices[v];
    const auto [place, is_new] = result.try_emplace(id, now.deformed[v]);
    if (!is_new && apart) *apart = std::max(*apart, length(place->second + -1.0 * now.deformed[v]));
  }
  return result;
}

double largest_difference(const std::map<std::int32_t, Point3>& a, const std::map<std::int32_t, Point3>& b) {
  double largest = 0;
  for (const auto& [v, p] : a) largest = std::max(largest, length(p + -1.0 * b.at(v)));
  return largest;
}

TEST(Sewn, APanelledSheetHangsLikeAWholeOne) {
  const MeshData whole = make_sheet("delaunay", 12), panels = in_panels(whole, in_quarters);
  EXPECT_EQ(count_pieces(Sheet(panels)), 1u);
  double apart = 0;
  const auto expected = places(hanging(whole), "conventional_split");
  const auto found = places(hanging(panels), "conventional_split", &apart);
  double fallen = 0;
  for (const auto& [v, p] : expected) fallen = std::max(fallen, -p.z);
  EXPECT_GT(fallen, 0.1);
  EXPECT_LT(largest_difference(expected, found), 2e-5);  // the solver's tolerance
  EXPECT_EQ(apart, 0);
}

TEST(Sewn, ACutThatRunsOverSeamsOpensBothSidesAndMovesAlike) {
  const MeshData whole = make_sheet("delaunay", 12), panels = in_panels(whole, in_quarters);
  const auto with_cut = [](const MeshData& mesh) {
    Scene scene = hanging(mesh);
    Scene::Cut& cut = scene.cuts.emplace_back();
    cut.time = 0;
    cut.picked = polyline({{0.31, 0.12, 0}, {0.62, 0.33, 0}, {0.71, 0.74, 0}});
    return scene;
  };
  for (const char* method : {"conventional_split", "split_and_tie", "virtual_node", "cut_polygons"}) {
    double apart = 0;
    const auto expected = places(with_cut(whole), method), found = places(with_cut(panels), method, &apart);
    const double bound = method == std::string("split_and_tie") ? 1e-2 : 2e-3;
    EXPECT_LT(largest_difference(expected, found), bound) << method;
    EXPECT_EQ(apart, 0) << method;
  }
}

/// Random polylines within the sheet, cut one after the other.
std::vector<PickedCurve> random_cuts(std::uint64_t seed) {
  Random random(seed);
  const auto inside = [&] { return 0.03 + 0.94 * random.unit(); };
  std::vector<PickedCurve> cuts(1 + seed % 3);
  for (PickedCurve& cut : cuts) {
    std::vector<Point3> points;
    for (std::uint64_t i = 0; i < 2 + seed % 4; ++i) points.push_back({inside(), inside(), 0});
    cut = polyline(points, seed % 7 == 0 && points.size() > 2);
  }
  return cuts;
}

struct Outcome {
  bool made = true;  ///< none refused, failed or deviated
  std::size_t pieces = 0;
  double area = 0;
};

Outcome cut_in_space(const MeshData& mesh, const std::vector<PickedCurve>& cuts, const char* method) {
  const MethodRow row = find_method(method);
  const auto cutter_method = row.make(row.parameter.value);
  Sheet sheet(mesh);
  Locator locator(sheet);
  Cutter cutter;
  Outcome outcome;
  std::vector<Curve> curves;
  for (const PickedCurve& cut : cuts)
    for (const Curve& curve : Picker(Sheet(mesh)).rest_curves(cut, "cut")) curves.push_back(curve);
  for (const Curve& curve : curves) {
    const CutRun run = cut_all(sheet, locator, cutter, {&curve, 1}, *cutter_method, {});
    outcome.made = outcome.made && (run.status == Status::ok || run.status == Status::noop);
  }
  EXPECT_TRUE(check(sheet).empty()) << check(sheet).front();
  if (outcome.made) {
    const Judgement judgement =
        judge_one_by_one(Sheet(mesh), sheet, curves, row.promises, row.make(row.parameter.value), {});
    EXPECT_TRUE(judgement.ok) << method << ": " << judgement.problems.front();
    EXPECT_EQ(to_size(judgement.pieces), count_pieces(sheet)) << method;
  }
  outcome.pieces = count_pieces(sheet);
  for (std::size_t i = 0; i < sheet.triangle_slots(); ++i)
    if (const TriangleIndex t(i); sheet.triangle(t).alive()) {
      const auto [a, b, c] = sheet.corners(t);
      outcome.area += cross(b - a, c - a) / 2;
    }
  return outcome;
}

TEST(Sewn, RandomCutsOverSeamsGiveThePiecesOfTheWholeSheet) {
  const std::uint64_t cases = scaled(60);
  const MeshData whole = make_sheet("delaunay", 10);
  const MeshData quarters = in_panels(whole, in_quarters);
  const MeshData strips = in_panels(whole, [](Point2 p) { return to_int(std::floor(5 * p.x)); });
  std::size_t made = 0, severed = 0;
  for (std::uint64_t seed = 1; seed <= cases; ++seed) {
    const auto cuts = random_cuts(seed);
    // Those that keep the path exactly: others may rightly lose the smallest pieces.
    for (const char* method : {"conventional_split", "bowyer_watson", "cgal_cdt", "cut_polygons", "split_and_tie"}) {
      const Outcome expected = cut_in_space(whole, cuts, method);
      for (const MeshData* panels : {&quarters, &strips}) {
        const Outcome found = cut_in_space(*panels, cuts, method);
        if (!expected.made || !found.made) continue;
        ++made;
        severed += expected.pieces > 1;
        EXPECT_EQ(found.pieces, expected.pieces)
            << method << ", seed " << seed << (panels == &strips ? ", strips" : "");
        EXPECT_NEAR(found.area, 1, 1e-12);
      }
    }
  }
  EXPECT_GT(made, cases * 9);
  EXPECT_GT(severed, made / 10);
  RecordProperty("made", to_int(made));
  RecordProperty("severed", to_int(severed));
}

TEST(Sewn, EdgesAcrossSeamsFollowCuts) {
  const MeshData panels = in_panels(make_sheet("delaunay", 10), in_quarters);
  std::size_t all = 0, looked_at = 0;
  for (const char* method : {"conventional_split", "delaunay_refine", "adaptive_remesh", "element_deletion"}) {
    const MethodRow row = find_method(method);
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      Sheet sheet(panels);
      Locator locator(sheet);
      Cutter cutter;
      const auto tool = row.make(row.parameter.value);
      SeamEdges kept(sheet);
      for (const PickedCurve& picked : random_cuts(seed))
        for (const Curve& curve : Picker(Sheet(panels)).rest_curves(picked, "cut")) {
          if (cutter.cut(sheet, locator, curve, *tool, {}).status != Status::ok) continue;
          kept.update(sheet);
          const SeamEdges anew(sheet);
          ASSERT_EQ(kept.across(), anew.across()) << method << ", seed " << seed;
          all += anew.across().size();
          looked_at += kept.changed().size();
        }
    }
  }
  EXPECT_GT(all, 1000u);
  EXPECT_LT(looked_at, all / 2);
}

/// Four clicks on different panels, and a ring of two Beziers: the pieces have the areas that the curves enclose.
TEST(Sewn, ABezierGoesOverSeams) {
  const MeshData whole = make_sheet("delaunay", 20);
  const Sheet sewn(in_panels(whole, in_quarters));
  PickedCurve bow{Curve::Kind::bezier, false, {}};
  for (const Point3 p : {Point3{0.2, 0.2, 0}, {0.9, 0.1, 0}, {0.1, 0.9, 0}, {0.8, 0.8, 0}})
    bow.picks.push_back({p, {}});
  const std::vector<Curve> stretches = Picker(sewn).rest_curves(bow, "bow");
  EXPECT_GE(stretches.size(), 3u);
  double along = 0;
  for (const Curve& curve : stretches)
    for (std::size_t i = 1; i < curve.points.size(); ++i) along += length(curve.points[i] - curve.points[i - 1]);
  double expected = 0;
  const Sheet one(whole);
  const std::vector<Curve> flat = Picker(one).rest_curves(bow, "bow");
  ASSERT_EQ(flat.size(), 1u);
  const auto& b = flat.front().points;
  Point2 last = b[0];
  for (int i = 1; i <= 10000; ++i) {
    const double t = i / 1e4, s = 1 - t;
    const Point2 p = s * s * s * b[0] + 3 * s * s * t * b[1] + 3 * s * t * t * b[2] + t * t * t * b[3];
    expected += length(p - last);
    last = p;
  }
  EXPECT_NEAR(along, expected, 0.01 * expected);

  PickedCurve ring{Curve::Kind::bezier, true, {}};
  for (const Point3 p :
       {Point3{0.3, 0.5, 0}, {0.3, 0.8, 0}, {0.7, 0.8, 0}, {0.7, 0.5, 0}, {0.7, 0.2, 0}, {0.3, 0.2, 0}, {0.3, 0.5, 0}})
    ring.picks.push_back({p, {}});
  const Outcome found = cut_in_space(in_panels(whole, in_quarters), {ring}, "conventional_split");
  EXPECT_TRUE(found.made);
  EXPECT_EQ(found.pieces, 2u);
}

/// Within one panel it stays a Bezier.
TEST(Sewn, ABezierWithinAPanelIsKept) {
  const Sheet sewn(in_panels(make_sheet("delaunay", 20), in_quarters));
  PickedCurve bow{Curve::Kind::bezier, false, {}};
  for (const Point3 p : {Point3{0.1, 0.1, 0}, {0.2, 0.3, 0}, {0.3, 0.3, 0}, {0.4, 0.1, 0}})
    bow.picks.push_back({p, {}});
  const std::vector<Curve> curves = Picker(sewn).rest_curves(bow, "bow");
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_EQ(curves.front().kind, Curve::Kind::bezier);
  EXPECT_EQ(curves.front().points.size(), 4u);
}

TEST(Sewn, AnObjKeepsItsSeams) {
  const MeshData panels = in_panels(make_sheet("delaunay", 6), in_quarters);
  const Sheet sheet(panels);
  MeshData again = read_obj(obj_text(sheet.to_mesh_data()), "again");
  check_and_repair(again, "again");
  EXPECT_EQ(Sheet(again).seams().size(), sheet.seams().size());
  EXPECT_GT(sheet.seams().size(), 10u);
  EXPECT_EQ(count_pieces(Sheet(again)), 1u);
  EXPECT_EQ(pieces_of(again), std::vector<std::int32_t>(again.triangles.size(), 0));
}

TEST(Sewn, NoWayOverASeamIsRefusedWhereNoneIsThere) {
  MeshData panels = in_panels(make_sheet("grid", 4), [](Point2 p) { return p.x > 0.5 ? 1 : 0; });
  const Sheet sheet(panels);
  const Picker picker(sheet);
  EXPECT_EQ(picker.rest_curves(polyline({{0.2, 0.3, 0}, {0.8, 0.4, 0}}), "it").size(), 2u);
  std::iota(panels.sewn.begin(), panels.sewn.end(), 0);  // now two parts that nothing joins
  EXPECT_EQ(Sheet(panels).seams().size(), 0u);
}

}  // namespace
}  // namespace cutbench
