// A cut made part by part, as a blade advances: the incision in the end is that of the cut made at once.

#include "harness/path/blade.h"

#include <gtest/gtest.h>

#include <set>

#include "harness/judge/oracle_request.h"
#include "harness/mesh/families.h"
#include "harness/simulation/simulation.h"
#include "methods/conventional_split/conventional_split.h"
#include "methods/registry.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

struct Lip {
  Point2 a, b;
};

/// The opened edges, at rest.
std::vector<Lip> lips_of(const Sheet& sheet) {
  std::vector<Lip> lips;
  for (std::size_t i = 0; i < sheet.triangle_slots(); ++i) {
    const TriangleIndex t(i);
    if (!sheet.triangle(t).alive()) continue;
    for (int k = 0; k < 3; ++k)
      if (const HalfEdge h = half_edge(t, k); !sheet.on_border(h) && sheet.mark(h) != EdgeMark::none)
        lips.push_back({sheet.rest(sheet.origin(h)), sheet.rest(sheet.target(h))});
  }
  return lips;
}

double distance(Point2 p, const Lip& lip) {
  const Point2 ab = lip.b - lip.a;
  return std::sqrt(squared_length(p - (lip.a + std::clamp(dot(p - lip.a, ab) / squared_length(ab), 0.0, 1.0) * ab)));
}

/// Of points all along `from`, from `to`.
double one_sided(const std::vector<Lip>& from, const std::vector<Lip>& to) {
  double farthest = 0;
  for (const Lip& lip : from)
    for (int k = 0; k <= 8; ++k) {
      double nearest = infinite;
      for (const Lip& other : to) nearest = std::min(nearest, distance(lip.a + k / 8.0 * (lip.b - lip.a), other));
      farthest = std::max(farthest, nearest);
    }
  return farthest;
}

double hausdorff(const std::vector<Lip>& a, const std::vector<Lip>& b) {
  return std::max(one_sided(a, b), one_sided(b, a));
}

/// Distances from 0 to `length`, unevenly, and as a blade meets them: some hardly apart.
std::vector<double> stops(double length, Random& random) {
  std::vector<double> at{0};
  while (at.back() < length)
    at.push_back(std::min(length, at.back() + length * random.between(0, 1) * (random.coin() ? 0.2 : 0.01)));
  return at;
}

const std::vector<std::pair<const char*, Curve>> paths{
    {"straight", {Curve::Kind::polyline, false, {{0.21, 0.17}, {0.78, 0.66}}}},
    {"along a mesh line", {Curve::Kind::polyline, false, {{0.13, 0.5}, {0.84, 0.5}}}},
    {"across the sheet", {Curve::Kind::polyline, false, {{-0.1, 0.31}, {1.1, 0.64}}}},
    {"with a corner", {Curve::Kind::polyline, false, {{0.2, 0.2}, {0.7, 0.3}, {0.4, 0.8}}}},
    {"a triangle", {Curve::Kind::polyline, true, {{0.2, 0.2}, {0.7, 0.3}, {0.4, 0.8}}}},
    {"across itself", {Curve::Kind::polyline, false, {{0.2, 0.3}, {0.8, 0.4}, {0.7, 0.8}, {0.5, 0.1}}}},
    {"curved", {Curve::Kind::bezier, false, {{0.25, 0.3}, {0.9, 0.2}, {0.9, 0.8}, {0.25, 0.7}}}},
    {"two Beziers",
     {Curve::Kind::bezier,
      false,
      {{0.1, 0.5}, {0.2, 0.9}, {0.4, 0.9}, {0.5, 0.5}, {0.6, 0.1}, {0.8, 0.1}, {0.9, 0.5}}}},
    {"a leaf",
     {Curve::Kind::bezier, true, {{0.2, 0.5}, {0.4, 0.9}, {0.6, 0.9}, {0.8, 0.5}, {0.6, 0.1}, {0.4, 0.1}, {0.2, 0.5}}}},
};

TEST(Blade, ItsPartsAreTheCurve) {
  Random random(5);
  for (const auto& [name, curve] : paths) {
    const Blade blade(curve);
    std::vector<Lip> all, parts;
    Polyline line;
    flatten(curve, 1e-5, 0, line);
    for (std::size_t i = 0; i + (line.closed ? 0 : 1) < line.points.size(); ++i)
      all.push_back({line.points[i], line.points[(i + 1) % line.points.size()]});
    double length = 0;
    for (const Lip& lip : all) length += std::sqrt(squared_length(lip.b - lip.a));
    EXPECT_NEAR(blade.length(), length, 1e-4 * length) << name;

    Point2 end = curve.points.front();
    const auto at = stops(blade.length(), random);
    for (std::size_t i = 1; i < at.size(); ++i) {
      const Curve part = blade.part(at[i - 1], at[i]);
      EXPECT_FALSE(part.closed);
      check_curve(part, name);
      EXPECT_EQ(part.points.front(), end) << name;
      end = part.points.back();
      flatten(part, 1e-5, 0, line);
      double here = 0;
      for (std::size_t k = 1; k < line.points.size(); ++k) {
        parts.push_back({line.points[k - 1], line.points[k]});
        here += std::sqrt(squared_length(parts.back().b - parts.back().a));
      }
      EXPECT_NEAR(here, at[i] - at[i - 1], 1e-4 * length) << name;
    }
    EXPECT_EQ(end, curve.closed ? curve.points.front() : curve.points.back()) << name;
    EXPECT_LE(hausdorff(all, parts), curve.kind == Curve::Kind::bezier ? 2.1e-5 : 1e-15) << name;
  }
}

/// Where the blade is held up or not: whatever the parts, each is judged by the oracle, and so is the whole.
TEST(Blade, InTheEndTheIncisionIsThatOfTheCutAtOnce) {
  Random random(11);
  for (const MethodRow& row : all_methods()) {
    if (!row.promises.exact_incision) continue;
    const double parameter = row.parameter.name == "rounds" ? std::min(row.parameter.value, 1.0) : row.parameter.value;
    for (const char* family : {"grid", "delaunay"})
      for (const auto& [name, curve] : paths) {
        if (random.coin()) continue;  // half of them, others for the next method
        const std::string where = row.name + ", " + family + ", " + name;
        const CutOptions options;
        Table at_once(make_sheet(family, 10), row, parameter), by_parts(make_sheet(family, 10), row, parameter);
        const Sheet before = at_once.sheet;
        ASSERT_EQ(at_once.cut(curve, options.chord_tolerance), "") << where;
        const Blade blade(curve);
        double reached = 0;
        const auto at = stops(blade.length(), random);
        for (std::size_t i = 1; i < at.size(); ++i) {
          const std::string fault = by_parts.cut(blade.part(reached, at[i]), options.chord_tolerance);
          if (by_parts.outcome.status == Status::refused && i + 1 < at.size()) continue;  // goes with the next part
          ASSERT_EQ(fault, "") << where << ", up to " << at[i];
          if (by_parts.outcome.status == Status::ok) reached = at[i];
        }
        const oracle::Judgement whole =
            oracle::judge(request_for(before, {&curve, 1}, row.promises, options, true), for_oracle(by_parts.sheet));
        EXPECT_TRUE(whole.ok) << where << ": " << whole.problems.front();
        EXPECT_EQ(whole.pieces, at_once.judgement.pieces) << where;
        const bool straight = curve.kind == Curve::Kind::polyline;
        EXPECT_LE(hausdorff(lips_of(at_once.sheet), lips_of(by_parts.sheet)),
                  straight ? 1e-12 : (options.chord_tolerance + options.flatten_tolerance) * before.mean_edge())
            << where;
      }
  }
}

/// Of methods whose tips go to vertices, the parts of a blade join, too: the sheet comes apart as by one cut.
TEST(Blade, PartsJoinWhereTipsGoToVertices) {
  for (const char* name : {"edge_release", "snap_or_split", "vertex_snap"}) {
    const MethodRow row = find_method(name);
    for (const char* family : {"grid", "delaunay"}) {
      Table by_parts(make_sheet(family, 10), row, row.parameter.value);
      const Blade blade({Curve::Kind::polyline, false, {{-0.1, 0.37}, {1.1, 0.61}}});
      double reached = 0;
      for (const double to : {0.31, 0.52, 0.68, 0.97, blade.length()}) {
        ASSERT_EQ(by_parts.cut(blade.part(reached, to), CutOptions().chord_tolerance), "") << name << ", " << family;
        reached = to;
      }
      EXPECT_EQ(count_pieces(by_parts.sheet), 2u) << name << ", " << family;
    }
  }
}

/// In the simulation: the incision ends where the blade is, at most one edge behind it.
TEST(Blade, AdvancesWithTheTime) {
  Scene scene;
  scene.resolution = 200;
  scene.duration = 0.5;
  scene.step = 0.01;
  scene.pins.push_back({{}, {.where = {{0, 0}, {0, 1}}}});
  scene.physics.gravity = {0, 0, -9.81};
  const Point2 from{0.2, 0.23}, to{0.83, 0.71};
  const double length = std::sqrt(squared_length(to - from)), speed = 2, start = 0.044;
  Scene::Cut& cut = scene.cuts.emplace_back();
  cut.time = start;
  cut.speed = speed;
  cut.curve = {Curve::Kind::polyline, false, {from, to}};
  const auto method = find_method("bowyer_watson").make(0);
  const auto motion = Simulation::start(scene);
  const double h = motion->sheet().mean_edge();
  std::set<double> tips;
  for (int step = 1; step <= 50; ++step) {
    ASSERT_EQ(motion->advance(step * scene.step, *method, {}).verdict, Verdict::ok);
    const double blade = std::clamp(speed * (motion->time() - start), 0.0, length);
    double tip = 0;
    for (const Lip& lip : lips_of(motion->sheet())) tip = std::max(tip, std::sqrt(squared_length(lip.b - from)));
    EXPECT_LE(tip, blade + 1e-12);
    EXPECT_GE(tip, std::min(blade, blade - h + (blade == length ? h : 0)) - 1e-12);
    tips.insert(tip);
  }
  ASSERT_EQ(motion->made_cuts().size(), 1u);
  EXPECT_EQ(motion->made_cuts()[0].cut.status, Status::ok);
  EXPECT_EQ(motion->made_cuts()[0].parts + 1, tips.size());  // each part opened more; the first tip is none
  EXPECT_GE(tips.size(), 10u);
  const std::vector<Lip> asked{{from, to}};
  EXPECT_LE(hausdorff(lips_of(motion->sheet()), asked), 1e-12);
}

/// A method that takes part of the blade's way only.
class GivesUp : public ConventionalSplit {
 public:
  std::optional<std::string> why_unsupported(const Sheet& sheet) const override {
    return sheet.vertex_count() > 130 ? std::optional<std::string>("too many vertices") : std::nullopt;
  }
};

TEST(Blade, SaysThatItsEndWasRefused) {
  Scene scene;
  scene.resolution = 200;
  scene.step = 0.01;
  scene.pins.push_back({{}, {.where = {{0, 0}, {0, 1}}}});
  Scene::Cut& cut = scene.cuts.emplace_back();
  cut.speed = 2;
  cut.curve = {Curve::Kind::polyline, false, {{0.2, 0.23}, {0.83, 0.71}}};
  GivesUp method;
  const auto motion = Simulation::start(scene);
  EXPECT_EQ(motion->advance(0.5, method, {}).verdict, Verdict::ok);
  ASSERT_EQ(motion->made_cuts().size(), 1u);
  const MotionCut& made = motion->made_cuts()[0];
  EXPECT_GE(made.parts, 1);
  EXPECT_EQ(made.cut.status, Status::deviated);
  EXPECT_EQ(made.reason, "its end was refused: too many vertices");
}

}  // namespace
}  // namespace cutbench
