// Methods that are wrong on purpose: what is there to notice them must notice them.

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "harness/base/conversions.h"
#include "harness/judge/judged_sheet.h"
#include "harness/mesh/families.h"
#include "methods/conventional_split/conventional_split.h"
#include "methods/edge_release/edge_release.h"
#include "tests/fem_helpers.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

double length_of(const Sheet& sheet, HalfEdge h) {
  return std::sqrt(squared_length(sheet.rest(sheet.target(h)) - sheet.rest(sheet.origin(h))));
}

/// Embeds the path, and forgets its last edges: a hundredth of its length, and what is left of an edge.
class LosesAHundredth final : public CuttingMethod {
 public:
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override { split_.embed(sheet, trace, notes); }
  void improve(Sheet& sheet, MethodNotes&) override {
    std::map<VertexIndex, std::vector<HalfEdge>> outgoing;
    double length = 0;
    for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
      for (int k = 0; k < 3; ++k)
        if (const HalfEdge h = half_edge(TriangleIndex(t), k); sheet.mark(h) == EdgeMark::path) {
          outgoing[sheet.origin(h)].push_back(h);
          length += length_of(sheet, h) / 2;
        }
    const auto tip =
        std::find_if(outgoing.begin(), outgoing.end(), [](const auto& at) { return at.second.size() == 1; });
    ASSERT_NE(tip, outgoing.end());
    HalfEdge h = tip->second.front();
    for (;;) {
      sheet.set_mark(h, EdgeMark::none);
      lost += length_of(sheet, h) / length;
      if (lost >= 0.01) return;
      const auto& next = outgoing[sheet.target(h)];
      h = sheet.target(next.front()) == sheet.origin(h) ? next.back() : next.front();
    }
  }

  double lost = 0;

 private:
  ConventionalSplit split_;
};

TEST(Verdicts, AreReadAsTheyAreWritten) {
  for (const auto& entry : verdict_names) {
    EXPECT_EQ(value_named(verdict_names, name_of(entry.value)), entry.value) << entry.name;
    EXPECT_EQ(&entry - verdict_names.data(), to_int(entry.value)) << entry.name;
  }
  EXPECT_FALSE(value_named(verdict_names, "unknown"));
}

TEST(Verdicts, TheOraclesHaveTheSameNameInTheHarness) {
  for (auto i = 0; i <= to_int(oracle::Verdict::incision); ++i) {
    oracle::Judgement given;
    given.verdict = static_cast<oracle::Verdict>(i);
    EXPECT_STREQ(name_of(Judgement(given).verdict), name_of(given.verdict));
  }
}

TEST(WrongMethods, AHundredthOfTheIncisionIsMissed) {
  for (const std::string family : sheet_families())
    for (const double angle : {0.1, 0.7, 2.0}) {
      SCOPED_TRACE(family + " " + std::to_string(angle));
      const Point2 along{0.4 * std::cos(angle), 0.4 * std::sin(angle)};
      const Curve path = line(Point2{0.5, 0.5} - along, Point2{0.5, 0.5} + along);
      JudgedSheet right(Sheet(make_sheet(family, 40)), {true, true, true, true}, std::make_unique<ConventionalSplit>());
      EXPECT_TRUE(right.cut(path, {}).ok());
      auto method = std::make_unique<LosesAHundredth>();
      const LosesAHundredth& wrong_method = *method;
      JudgedSheet wrong(Sheet(make_sheet(family, 40)), {true, true, true, true}, std::move(method));
      EXPECT_EQ(wrong.cut(path, {}).verdict, Verdict::incision);
      EXPECT_NEAR(wrong.judgement.incision_error, wrong_method.lost * 0.8, 1e-3 * 0.8);
      EXPECT_LE(wrong_method.lost, 0.05);
    }
}

/// edge_release, which strays by most of an edge, under its own bound and under one that it does not keep.
TEST(WrongMethods, AnIncisionBeyondTheBoundIsNoticed) {
  const auto judge = [](const std::string& family, double longest_edges) {
    const Promises promises{.keeps_area = true,
                            .conforming = true,
                            .keeps_vertices = true,
                            .incision_bound = {.longest_edges = longest_edges}};
    JudgedSheet sheet(Sheet(make_sheet(family, 20)), promises, std::make_unique<EdgeRelease>());
    const auto finding = sheet.cut(line({0.13, 0.21}, {0.83, 0.62}), {});
    EXPECT_EQ(sheet.outcome.status, Status::ok);
    return finding.verdict;
  };
  for (const std::string family : sheet_families()) {
    EXPECT_EQ(judge(family, 1), Verdict::ok) << family;
    EXPECT_EQ(judge(family, 0.1), Verdict::incision) << family;
  }
}

/// Takes triangles out, but not those that it should.
class DeletesOthers final : public CuttingMethod {
 public:
  explicit DeletesOthers(bool too_many) : too_many_(too_many) {}
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes&) override {
    std::vector<TriangleIndex> gone;
    const auto add = [&](TriangleIndex t) {
      if (std::find(gone.begin(), gone.end(), t) == gone.end()) gone.push_back(t);
    };
    for (const Subdivision::Face& face : trace.faces) {
      if (face.segments < 0 || !too_many_) continue;
      add(face.triangle);
      for (int k = 0; k < 3; ++k)
        if (const HalfEdge o = sheet.opposite(half_edge(face.triangle, k)); o.valid()) add(triangle_of(o));
    }
    sheet.remove(gone);
    trace.along.clear();
  }

 private:
  bool too_many_;
};

TEST(WrongMethods, DeletingNothingOrTooMuchIsNoticed) {
  constexpr Promises deletion{.exact_incision = false, .keeps_area = false, .conforming = true};
  const Curve path = line({-0.1, 0.43}, {1.1, 0.52});
  for (const std::string family : sheet_families())
    for (const bool too_many : {false, true}) {
      JudgedSheet wrong(Sheet(make_sheet(family, 20)), deletion, std::make_unique<DeletesOthers>(too_many));
      EXPECT_FALSE(wrong.cut(path, {}).ok()) << family << ' ' << too_many;
      EXPECT_EQ(wrong.outcome.status, Status::ok);
    }
}

/// Splits, and moves the vertices of the mesh near the path a little.
class MovesVertices final : public CuttingMethod {
 public:
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override { split_.embed(sheet, trace, notes); }
  void improve(Sheet& sheet, MethodNotes&) override {
    for (std::size_t v = 0; v < sheet.log().vertices_before; ++v) {
      const Point2 p = sheet.rest(VertexIndex(v));
      if (std::abs(p.x - 0.5) < 0.3 && std::abs(p.y - 0.5) < 0.1) sheet.move(VertexIndex(v), p + Point2{0.01, 0.005});
    }
  }

 private:
  ConventionalSplit split_;
};

TEST(WrongMethods, MovingVerticesWithoutTheirStateJumps) {
  for (const std::string family : sheet_families())
    for (const bool with_state : {true, false}) {
      SCOPED_TRACE(family);
      Sheet sheet(make_sheet(family, 20));
      Locator locator(sheet);
      Model<2> model(sheet, {.stiffness = 1000, .poisson = 0.3}, {.dimension = 2, .bending = BendingKind::none}, {},
                     {});
      State state = initial_state(model, sheet);
      // Stretched and sheared evenly, so that an interpolated place is where the vertex belongs.
      for (Eigen::Index v = 0; v < state.x.size() / 2; ++v) {
        const double x = state.x[2 * v], y = state.x[2 * v + 1];
        state.x[2 * v] = 1.05 * x + 0.02 * y;
        state.x[2 * v + 1] = 0.99 * y;
      }
      const Balance before = balance_of(model, state);
      MovesVertices method;
      ASSERT_EQ(Cutter().cut(sheet, locator, line({0.2, 0.43}, {0.8, 0.51}), method, {}).status, Status::ok);
      EditLog log = sheet.log();
      ASSERT_FALSE(log.displaced.empty());
      if (!with_state)
        for (const auto& displaced : log.displaced)
          std::erase_if(log.ancestry, [&](const auto& made) { return made.vertex == displaced.vertex; });
      transfer(log, sheet.deformed_slots(), 2, state);
      model.update(sheet);
      const double jump = std::abs(balance_of(model, state).energy.membrane - before.energy.membrane);
      if (with_state)
        EXPECT_LE(jump, 1e-10 * before.energy.membrane);
      else
        EXPECT_GE(jump, 0.01 * before.energy.membrane);
    }
}

}  // namespace
}  // namespace cutbench
