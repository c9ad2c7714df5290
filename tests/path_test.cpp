// Flattening held against dense sampling, and every line the reader of paths refuses.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "harness/files/path_file.h"
#include "harness/path/curve.h"
#include "tests/helpers.h"
#include "tests/mesh_checks.h"

namespace cutbench {
namespace {

Point2 bezier_point(const Curve& curve, std::size_t piece, double t) {
  const Point2* p = &curve.points[3 * piece];
  const double s = 1 - t;
  return s * s * s * p[0] + 3 * s * s * t * p[1] + 3 * s * t * t * p[2] + t * t * t * p[3];
}

double distance_from(const Polyline& line, Point2 p) {
  double nearest = 1e300;
  const std::size_t n = line.points.size();
  for (std::size_t i = 0; i + (line.closed ? 0 : 1) < n; ++i) {
    const Point2 a = line.points[i], ab = line.points[(i + 1) % n] - a;
    const double s = std::clamp(dot(p - a, ab) / squared_length(ab), 0.0, 1.0);
    nearest = std::min(nearest, std::sqrt(squared_length(p - (a + s * ab))));
  }
  return nearest;
}

TEST(Flatten, StaysWithinTheTolerance) {
  Random random(1);
  for (double tolerance : {1e-2, 1e-3, 1e-5})
    for (int i = 0; i < 40; ++i) {
      Curve curve{Curve::Kind::bezier, i % 2 == 1, {}};
      for (int k = 0; k < 7; ++k) curve.points.push_back({random.between(-1, 1), random.between(-1, 1)});
      if (curve.closed) curve.points.back() = curve.points.front();
      Polyline line;
      flatten(curve, tolerance, 1e-12, line);
      EXPECT_EQ(line.closed, curve.closed);
      ASSERT_EQ(line.kept.size(), line.points.size());
      EXPECT_EQ(line.points.front(), curve.points.front());
      EXPECT_TRUE(curve.closed || line.points.back() == curve.points.back());
      double farthest = 0;
      for (std::size_t piece = 0; piece < 2; ++piece)
        for (int k = 0; k <= 500; ++k)
          farthest = std::max(farthest, distance_from(line, bezier_point(curve, piece, k / 500.0)));
      EXPECT_LE(farthest, tolerance * (1 + 1e-9));
      EXPECT_LT(line.points.size(), 20 + 4 / std::sqrt(tolerance)) << "far more points than the tolerance asks for";
    }
}

TEST(Flatten, KeepsTipsAndKinksOnly) {
  Polyline line;
  const auto kept = [&] {
    std::vector<Point2> points;
    for (std::size_t i = 0; i < line.points.size(); ++i)
      if (line.kept[i]) points.push_back(line.points[i]);
    return points;
  };
  // Smooth at (1, 0), a kink at (2, 0).
  flatten({Curve::Kind::bezier,
           false,
           {{0, 0}, {0.3, 1}, {0.7, 1}, {1, 0}, {1.3, -1}, {1.7, -1}, {2, 0}, {2.3, -1}, {2.7, 1}, {3, 0}}},
          1e-3, 1e-12, line);
  EXPECT_EQ(kept(), (std::vector<Point2>{{0, 0}, {2, 0}, {3, 0}}));
  // Closed and smooth everywhere: nothing.
  flatten({Curve::Kind::bezier, true, {{1, 0}, {1, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {1, -1}, {1, 0}}}, 1e-3, 1e-12,
          line);
  EXPECT_TRUE(kept().empty());
  EXPECT_NE(line.points.front(), line.points.back()) << "a closed polyline repeats no point";
  // Closed with a kink at its start.
  flatten({Curve::Kind::bezier, true, {{0, 0}, {1, 1}, {-1, 1}, {0, 0}}}, 1e-3, 1e-12, line);
  EXPECT_EQ(kept(), (std::vector<Point2>{{0, 0}}));
  flatten({Curve::Kind::polyline, true, {{0, 0}, {1, 0}, {1, 1}}}, 1e-3, 1e-12, line);
  EXPECT_EQ(kept().size(), 3u);
}

TEST(Flatten, DropsPointsWithinTheSnapDistance) {
  Polyline line;
  flatten({Curve::Kind::polyline, false, {{0, 0}, {0, 0}, {1e-9, 0}, {1, 0}, {1, 1e-9}, {1, 1}, {1, 1}}}, 1e-3, 1e-8,
          line);
  EXPECT_EQ(line.points, (std::vector<Point2>{{0, 0}, {1, 0}, {1, 1}}));
  flatten({Curve::Kind::polyline, true, {{0, 0}, {1, 0}, {1, 1}, {0, 1e-9}}}, 1e-3, 1e-8, line);
  EXPECT_EQ(line.points, (std::vector<Point2>{{0, 0}, {1, 0}, {1, 1}})) << "the closing step, too, has a length";
  flatten({Curve::Kind::polyline, false, {{1, 2}, {1, 2}}}, 1e-3, 1e-8, line);
  EXPECT_EQ(line.points.size(), 1u);
  flatten({Curve::Kind::polyline, true, {{1, 2}, {1, 2}, {1, 2}}}, 1e-3, 1e-8, line);
  EXPECT_LT(line.points.size(), 2u);
}

TEST(Flatten, DegenerateControlPoints) {
  Polyline line;
  const auto bezier = [&](Point2 a, Point2 b, Point2 c, Point2 d) {
    const Curve curve{Curve::Kind::bezier, false, {a, b, c, d}};
    flatten(curve, 1e-3, 1e-12, line);
    for (int k = 0; k <= 100 && line.points.size() > 1; ++k)
      EXPECT_LE(distance_from(line, bezier_point(curve, 0, k / 100.0)), 1e-3);
    return line.points.size();
  };
  EXPECT_EQ(bezier({1, 1}, {1, 1}, {1, 1}, {1, 1}), 1u);
  EXPECT_GE(bezier({0, 0}, {0, 0}, {1, 1}, {1, 1}), 2u);  // straight, at rest at its ends
  EXPECT_GE(bezier({0, 0}, {0, 0}, {0, 0}, {1, 1}), 2u);
  EXPECT_EQ(bezier({0, 0}, {1, 0}, {2, 0}, {3, 0}), 2u);   // straight, even
  EXPECT_GT(bezier({0, 0}, {3, 0}, {-2, 0}, {1, 0}), 4u);  // there and back on a line
  EXPECT_GT(bezier({0, 0}, {1, 1}, {1, 1}, {0, 0}), 2u);   // there and back to its start
}

TEST(CheckCurve, RefusesWhatCannotBeCut) {
  const auto check = [](Curve::Kind kind, bool closed, std::vector<Point2> points) {
    return [=] { check_curve({kind, closed, points}, "it"); };
  };
  const auto bezier = Curve::Kind::bezier, polyline = Curve::Kind::polyline;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refused(check(bezier, false, {{0, 0}, {1, 1}, {2, 2}}),
                 "it: a chain of cubic Beziers has 4, 7, 10, ... points, this one has 3");
  expect_refused(check(bezier, false, {}), "has 0");
  expect_refused(check(bezier, false, {{0, 0}}), "has 1");
  expect_refused(check(bezier, false, std::vector<Point2>(6)), "has 6");
  expect_refused(check(bezier, true, {{0, 0}, {1, 1}, {2, 2}, {1, 0}}), "must end where it began");
  expect_refused(check(polyline, false, {{0, 0}}), "at least 2 points");
  expect_refused(check(polyline, true, {{0, 0}, {1, 0}}), "at least 3 points when closed");
  expect_refused(check(polyline, false, {{0, 0}, {nan, 0}}), "it, point 1: coordinates must be finite and below 1e60");
  expect_refused(check(polyline, false, {{0, infinite}, {0, 0}}), "point 0");
  expect_refused(check(polyline, false, {{0, 0}, {0, 1}, {-2e60, 0}}), "point 2");
  EXPECT_NO_THROW(check(polyline, false, {{0, 0}, {0, 0}})());
  EXPECT_NO_THROW(check(polyline, false, {{-0.0, 5e-324}, {1e60, 0}})());
  EXPECT_NO_THROW(check(bezier, true, {{0, 0}, {1, 1}, {2, 2}, {0, 0}})());
}

class PathFile : public testing::Test {
 protected:
  std::filesystem::path file_ = testing::TempDir() + "cutbench_path_test.json";
  void TearDown() override { std::filesystem::remove(file_); }
  std::function<void()> reading(const std::string& text) {
    return [=, this] {
      std::ofstream(file_) << text;
      read_path(file_);
    };
  }
};

TEST_F(PathFile, SaysWhatIsWrong) {
  expect_refused([] { read_path("no_such_folder/path.json"); }, "no_such_folder/path.json: can't be read");
  expect_refused(reading(""), "not a path file");
  expect_refused(reading("[1, 2"), "not a path file");
  expect_refused(reading("[]"), "must be an object");
  expect_refused(reading("{}"), "\"cuts\" must be a list");
  expect_refused(reading(R"({"cuts": []})"), "\"cuts\" is empty");
  expect_refused(reading(R"({"cuts": 3})"), "path_test.json");
  expect_refused(reading(R"({"cuts": [3]})"), "path_test.json");
  expect_refused(reading(R"({"cut": []})"), "unknown key \"cut\"");
  expect_refused(reading(R"({"cuts": [{"line": [[0,0],[1,1]]}]})"), "cut 0: unknown key \"line\"");
  expect_refused(reading(R"({"cuts": [{"closed": true}]})"), "cut 0: give either");
  expect_refused(reading(R"({"cuts": [{"space": "screen", "polyline": [[0,0],[1,1]]}]})"),
                 "\"space\" must be \"rest\" or \"world\"");
  expect_refused(reading(R"({"cuts": [{"polyline": [[0,0],[1,1]], "bezier": [[0,0],[1,1],[1,2],[2,2]]}]})"),
                 "give either");
  expect_refused(reading(R"({"cuts": [{"polyline": [[0,0],[1,1]]}, {"polyline": [[0,0],[1,1,2]]}]})"),
                 "cut 1, point 1: a point is [x, y]");
  expect_refused(reading(R"({"cuts": [{"polyline": [0,0,1,1]}]})"), "a point is [x, y]");
  expect_refused(reading(R"({"cuts": [{"polyline": [["0","0"],[1,1]]}]})"), "point 0: a point is [x, y], two numbers");
  expect_refused(reading(R"({"cuts": [{"polyline": [[null,0],[1,1]]}]})"), "two numbers");
  expect_refused(reading(R"({"cuts": [{"polyline": [[0,0],[1,1]], "closed": 1}]})"),
                 "\"closed\" must be true or false");
  expect_refused(reading(R"({"cuts": [{"polyline": [[0,0]]}]})"), "at least 2 points");
  expect_refused(reading(R"({"cuts": [{"polyline": [[0,0],[1e70,0]]}]})"), "below 1e60");
  expect_refused(reading(R"({"cuts": [{"polyline": [[0,0],[1e700,0]]}]})"), "path_test.json");
}

TEST_F(PathFile, ReadsWhatWasWritten) {
  const std::vector<Curve> cuts{{Curve::Kind::bezier, false, {{0.1, 1.0 / 3}, {1e-300, -0.0}, {1e17, 3}, {0.2, 0.7}}},
                                {Curve::Kind::polyline, true, {{0, 0}, {1, 0}, {0.1 + 0.2, 1}}},
                                {Curve::Kind::bezier, true, {{0, 0}, {1, 1}, {-1, 1}, {0, 0}}}};
  write_path(cuts, file_);
  const std::vector<Curve> read = read_path(file_);
  ASSERT_EQ(read.size(), cuts.size());
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    EXPECT_EQ(read[i].kind, cuts[i].kind);
    EXPECT_EQ(read[i].closed, cuts[i].closed);
    EXPECT_EQ(read[i].points, cuts[i].points);
  }
  EXPECT_THROW(write_path(cuts, "no_such_folder/path.json"), OutputError);
}

}  // namespace
}  // namespace cutbench
