// The oracle on sheets whose panels are sewn together: expected pieces, pieces found, what is open at seams.
#include "harness/oracle/surface.h"

#include <gtest/gtest.h>

#include "tests/oracle_cases.h"

namespace cutbench::oracle {
namespace {

Point turned(const Point& p, int panel) {
  return panel == 0 ? p : Point{5 - p[1], p[0] + 0.25};  // by 90 degrees, so that its left side is at y = 0.25
}

Mesh both(const Mesh& first, const Mesh& second) {
  Mesh mesh = first;
  for (auto t : second.triangles) {
    for (int& v : t) v += to_int(first.rest.size());
    mesh.triangles.push_back(t);
  }
  for (const Point& p : second.rest) mesh.rest.push_back(turned(p, 1));
  return mesh;
}

/// Two unit squares. The right side of the first one is sewn to the left side of the second one; and where `round`, the
/// left side of the first one to the right side of the second one: a tube.
Surface two_panels(int n, bool round) {
  Surface surface{both(grid(n), grid(n)), {}};
  const int count = (n + 1) * (n + 1);
  for (int v = 0; v < 2 * count; ++v) surface.point.push_back(v);
  for (int y = 0; y <= n; ++y) {
    surface.point[to_size(count + y * (n + 1))] = y * (n + 1) + n;
    if (round) surface.point[to_size(count + y * (n + 1) + n)] = y * (n + 1);
  }
  return surface;
}

Curve in_panel(std::vector<Point> points, int panel) {
  for (Point& p : points) p = turned(p, panel);
  return polyline(std::move(points));
}

constexpr double tip = 1e-11;
const std::vector<Point> first_half{{-0.1, 0.237}, {1, 0.511}}, second_half{{0, 0.511}, {1.1, 0.7}};

Mesh cut(int n, const std::vector<Point>& line) { return open(split(grid(n), line[0], line[1]), on({line})); }

TEST(Surface, AnUncutSheetIsOnePiece) {
  for (const bool round : {false, true}) {
    const Surface sheet = two_panels(4, round);
    const SurfaceJudgement found = judge_surface(sheet, {}, sheet.mesh, tip);
    EXPECT_EQ(found.pieces, 1);
    EXPECT_EQ(found.expected, 1);
    EXPECT_EQ(found.crossings + found.alone + found.unopened, 0);
  }
  Surface apart = two_panels(4, false);
  std::iota(apart.point.begin(), apart.point.end(), 0);
  const SurfaceJudgement found = judge_surface(apart, {}, apart.mesh, tip);
  EXPECT_EQ(found.pieces, 2);
  EXPECT_EQ(found.expected, 2);
}

/// Both panels cut: the first along first_half, the second along this.
SurfaceJudgement both_cut(const std::vector<Point>& second) {
  return judge_surface(two_panels(4, false), {in_panel(first_half, 0), in_panel(second, 1)},
                       both(cut(4, first_half), cut(4, second)), tip);
}

TEST(Surface, ACutOverASeamPartsBothPanels) {
  const auto found = both_cut(second_half);
  EXPECT_EQ(found.expected, 2);
  EXPECT_EQ(found.least, 2);
  EXPECT_EQ(found.most, 2);
  EXPECT_EQ(found.pieces, 2);
  EXPECT_EQ(found.crossings, 2);
  EXPECT_EQ(found.alone, 0);
  EXPECT_EQ(found.unopened, 0);
}

TEST(Surface, APanelThatIsLeftWholeIsFound) {
  const Surface sheet = two_panels(4, false);
  const std::vector<Curve> cuts{in_panel(first_half, 0), in_panel(second_half, 1)};
  const auto found = judge_surface(sheet, cuts, both(cut(4, first_half), grid(4)), tip);
  EXPECT_EQ(found.expected, 2);
  EXPECT_EQ(found.pieces, 1);
  EXPECT_EQ(found.crossings, 2);
  EXPECT_EQ(found.unopened, 1);
  // Divided along the path, but not opened.
  const auto welded = judge_surface(sheet, cuts, both(cut(4, first_half), split(grid(4), {0, 0.511}, {1.1, 0.7})), tip);
  EXPECT_EQ(welded.pieces, 1);
  EXPECT_EQ(welded.unopened, 1);
}

TEST(Surface, APathThatEndsAtASeamIsAlone) {
  const Surface sheet = two_panels(4, false);
  const auto found = judge_surface(sheet, {in_panel(first_half, 0)}, both(cut(4, first_half), grid(4)), tip);
  EXPECT_EQ(found.expected, 1);
  EXPECT_EQ(found.pieces, 1);
  EXPECT_EQ(found.crossings, 0);
  EXPECT_EQ(found.alone, 1);
}

/// Ends that differ by rounding are one place; a ten thousandth of the seam is another.
TEST(Surface, PlacesOnBothSidesMayDifferByRounding) {
  for (const double off : {1e-13, -1e-13, 1e-10}) {
    const auto found = both_cut({{0, 0.511 + off}, {1.1, 0.7}});
    EXPECT_EQ(found.expected, 2) << off;
    EXPECT_EQ(found.pieces, 2) << off;
    EXPECT_EQ(found.crossings, 2) << off;
    EXPECT_EQ(found.unopened, 0) << off;
  }
  const auto found = both_cut({{0, 0.521}, {1.1, 0.7}});
  EXPECT_EQ(found.expected, 1);
  EXPECT_EQ(found.pieces, 1);
  EXPECT_EQ(found.alone, 2);
}

/// A ring round a tube gives two pieces, a cut along it one.
TEST(Surface, ATubeFallsApartByARingAlone) {
  const Surface sheet = two_panels(4, true);
  const std::vector<Point> up{{0, 0.3}, {1, 0.6}}, down{{0, 0.6}, {1, 0.3}};
  const auto ring = judge_surface(sheet, {in_panel(up, 0), in_panel(down, 1)}, both(cut(4, up), cut(4, down)), tip);
  EXPECT_EQ(ring.expected, 2);
  EXPECT_EQ(ring.pieces, 2);
  EXPECT_EQ(ring.crossings, 4);
  EXPECT_EQ(ring.unopened, 0);
  const std::vector<Point> along{{0.31, -0.1}, {0.47, 1.1}};
  const auto slit = judge_surface(sheet, {in_panel(along, 0)}, both(cut(4, along), grid(4)), tip);
  EXPECT_EQ(slit.expected, 1);
  EXPECT_EQ(slit.pieces, 1);
}

/// A square that lies on both sides of the seam is cut out as one piece.
TEST(Surface, APieceOverASeamIsOne) {
  const Surface sheet = two_panels(8, false);
  const std::vector<Point> first{{1, 0.25}, {0.75, 0.25}, {0.75, 0.75}, {1, 0.75}};
  const std::vector<Point> second{{0, 0.75}, {0.25, 0.75}, {0.25, 0.25}, {0, 0.25}};
  const auto found = judge_surface(sheet, {in_panel(first, 0), in_panel(second, 1)},
                                   both(open(grid(8), on({first})), open(grid(8), on({second}))), tip);
  EXPECT_EQ(found.expected, 2);
  EXPECT_EQ(found.pieces, 2);
  EXPECT_EQ(found.crossings, 4);
}

}  // namespace
}  // namespace cutbench::oracle
