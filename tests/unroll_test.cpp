// Meshes whose rest shape is the mesh itself, as it lies in space.
#include "harness/mesh/unroll.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "harness/base/random.h"
#include "harness/cut/cut_all.h"
#include "harness/judge/judged_sheet.h"
#include "harness/judge/oracle_request.h"
#include "harness/mesh/rest_choice.h"
#include "harness/oracle/surface.h"
#include "harness/path/pick.h"
#include "methods/registry.h"
#include "tests/helpers.h"
#include "tests/sewn_sheets.h"

namespace cutbench {
namespace {

const double pi = std::acos(-1.0);

/// The largest |length at rest / length in space - 1| of all sides.
double distortion(const MeshData& mesh) {
  double largest = 0;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = to_size(t[k]), b = to_size(t[(k + 1) % 3]);
      const double there = length(mesh.deformed[b] + -1.0 * mesh.deformed[a]);
      largest = std::max(largest, std::abs(length(mesh.rest[b] - mesh.rest[a]) / there - 1));
    }
  return largest;
}

PickedCurve ring(const std::function<Point3(double)>& at, int points) {
  PickedCurve curve{Curve::Kind::polyline, true, {}};
  for (int i = 0; i < points; ++i) curve.picks.push_back({at(to_double(i) / points), {}});
  return curve;
}

/// In rising order.
std::vector<double> areas_of_pieces(const Sheet& sheet) {
  const MeshData after = sheet.to_mesh_data();
  const auto piece = pieces_of(after);
  std::map<std::int32_t, double> area;
  for (std::size_t t = 0; t < piece.size(); ++t) {
    const auto& [a, b, c] = after.triangles[t];
    const auto rest = [&](std::int32_t v) { return after.rest[to_size(v)]; };
    area[piece[t]] += cross(rest(b) - rest(a), rest(c) - rest(a)) / 2;
  }
  EXPECT_EQ(area.size(), count_pieces(sheet));
  std::vector<double> areas;
  for (const auto& [number, size] : area) areas.push_back(size);
  std::sort(areas.begin(), areas.end());
  return areas;
}

/// Nothing where the method refuses.
std::vector<double> cut(const MeshData& mesh, const PickedCurve& path, const std::string& method) {
  const MethodRow row = find_method(method);
  const auto tool = row.make(row.parameter.value);
  Sheet sheet(mesh);
  Locator locator(sheet);
  Cutter cutter;
  const std::vector<Curve> curves = Picker(sheet).rest_curves(path, "it");
  const CutRun run = cut_all(sheet, locator, cutter, curves, *tool, {});
  if (run.status == Status::refused) return {};
  EXPECT_TRUE(run.status == Status::ok || run.status == Status::deviated) << method << ": " << run.reason;
  EXPECT_TRUE(check(sheet).empty());
  const Judgement judgement =
      judge_one_by_one(Sheet(mesh), sheet, curves, row.promises, row.make(row.parameter.value), {});
  EXPECT_TRUE(judgement.ok) << method << ": " << judgement.problems.front();
  return areas_of_pieces(sheet);
}

TEST(Unroll, ATubeHasOneSeamAndItsOwnLengths) {
  const MeshData mesh = unrolled(tube(24, 7, 2));
  EXPECT_LT(distortion(mesh), 1e-12);
  EXPECT_EQ(Sheet(mesh).seams().size(), 7u);
  EXPECT_EQ(count_pieces(Sheet(mesh)), 1u);
  EXPECT_TRUE(mesh.unrolled);
}

TEST(Unroll, AConeHasOneSeamToItsTip) {
  const MeshData mesh = unrolled(cone(24, 7));
  EXPECT_LT(distortion(mesh), 1e-12);
  EXPECT_EQ(Sheet(mesh).seams().size(), 8u);
}

TEST(Unroll, ASphereKeepsItsLengthsToo) {
  const MeshData mesh = unrolled(sphere(6));
  EXPECT_LT(distortion(mesh), 1e-12);
  EXPECT_EQ(count_pieces(Sheet(mesh)), 1u);
  EXPECT_GT(Sheet(mesh).seams().size(), 100u);
}

TEST(Unroll, ABentStripIsFlat) {
  const MeshData mesh = unrolled(surface(12, 5, false, [](double u, double v) {
    return Point3{std::sin(2 * u), v, std::cos(2 * u)};
  }));
  EXPECT_LT(distortion(mesh), 1e-12);
  EXPECT_TRUE(Sheet(mesh).seams().empty());
}

TEST(Unroll, WhatIsNoSurfaceIsRefused) {
  const auto error = [](const MeshData& mesh) {
    try {
      MeshData copy = mesh;
      unroll(copy, "it");
      return std::string();
    } catch (const InputError& e) {
      return std::string(e.what());
    }
  };
  MeshData fins = tube(8, 2, 1);
  fins.deformed.push_back({0.5, 0, 3});
  fins.triangles.push_back({8, 9, to_int32(fins.deformed.size() - 1)});
  std::vector<std::string> numbers;
  for (std::size_t t = 0; t < fins.triangles.size(); ++t)
    if (std::ranges::count(fins.triangles[t], 8) + std::ranges::count(fins.triangles[t], 9) == 2)
      numbers.push_back(std::to_string(t + 1));
  ASSERT_EQ(numbers.size(), 3u);
  EXPECT_NE(error(fins).find("triangle " + numbers[2] + " of"), std::string::npos) << error(fins);
  EXPECT_NE(error(fins).find("three triangles meet at one of its edges in space (with triangles " + numbers[0] +
                             " and " + numbers[1] + ")"),
            std::string::npos)
      << error(fins);
  MeshData flat = tube(8, 2, 1);
  flat.deformed[to_size(flat.triangles[3][1])] = flat.deformed[to_size(flat.triangles[3][0])];
  EXPECT_NE(error(flat).find("zero area in space"), std::string::npos) << error(flat);
}

TEST(Unroll, ARingRoundATubeGivesTwoPiecesByEveryMethod) {
  const MeshData mesh = unrolled(tube(24, 9, 2));
  const auto at = [](double t) {  // on the facets: between two of the 24 corners
    const double u = 24 * t, i = std::floor(u), f = u - i;
    const auto corner = [](double k) { return Point3{0.73, std::cos(2 * pi * k / 24), std::sin(2 * pi * k / 24)}; };
    return (1 - f) * corner(i) + f * corner(i + 1);
  };
  const double round = 24 * 2 * std::sin(pi / 24);
  std::size_t made = 0;
  for (const MethodRow& row : all_methods())
    for (const int points : {5, 7, 40}) {
      const std::vector<double> areas = cut(mesh, ring(at, points), row.name);
      if (areas.empty()) continue;  // refused
      ++made;
      ASSERT_EQ(areas.size(), 2u) << row.name << ", " << points;
      const double tolerance = row.promises.exact_incision ? 1e-9 : 0.2 * round;
      EXPECT_NEAR(areas[0], 0.73 * round, tolerance) << row.name;
      if (row.promises.keeps_area) {
        EXPECT_NEAR(areas[0] + areas[1], 2 * round, 1e-9) << row.name;
      }
    }
  EXPECT_GT(made, 3 * 15u);
}

/// Of rays from outside.
PickedCurve ring_at_height(double height) {
  PickedCurve path = ring([](double) { return Point3{}; }, 16);
  for (std::size_t i = 0; i < path.picks.size(); ++i) {
    const double angle = 2 * pi * to_double(i) / to_double(path.picks.size()) + 0.1;
    const Point3 out{std::cos(angle), std::sin(angle), 0};
    path.picks[i] = {2.0 * out + Point3{0, 0, height}, -1.0 * out};
  }
  return path;
}

double length_of(const Curve& curve) {
  double sum = 0;
  for (std::size_t i = 1; i < curve.points.size(); ++i) sum += length(curve.points[i] - curve.points[i - 1]);
  return sum;
}

TEST(Unroll, ARingRoundASphereGivesTwoPieces) {
  const MeshData mesh = unrolled(sphere(6));
  const PickedCurve path = ring_at_height(0.31);
  for (const char* method : {"conventional_split", "cgal_cdt", "cut_polygons"}) {
    const std::vector<double> areas = cut(mesh, path, method);
    EXPECT_EQ(areas.size(), 2u) << method;
    double all = 0;
    for (const double area : areas) all += area;
    EXPECT_NEAR(all, 4 * pi, 0.4) << method;
  }
}

/// On its inner side a shortest way runs along edges, most of which are seams: the ring goes beside them.
TEST(Unroll, ARingRoundATorusLeavesItInOnePiece) {
  const MeshData mesh = unrolled(torus(24, 12));
  for (int i = 0; i < 40; ++i)
    for (const int points : {3, 5, 8, 12}) {
      const double u = 2 * pi * (i + 0.37) / 40;
      PickedCurve path{Curve::Kind::polyline, true, {}};
      for (int j = 0; j < points; ++j) {
        const double v = 2 * pi * (j + 0.21) / points;
        const Point3 out{std::cos(v) * std::cos(u), std::cos(v) * std::sin(u), std::sin(v)};
        path.picks.push_back({{std::cos(u), std::sin(u), 0}, out});
      }
      const char* method = std::array{"conventional_split", "cgal_cdt", "cut_polygons"}[to_size(i % 3)];
      EXPECT_EQ(cut(mesh, path, method).size(), 1u) << method << ", ring " << i << " of " << points << " picks";
    }
}

/// A walk from triangle to triangle, or a ring through those round a vertex; a random place in each. Neighbours have
/// one straight way between them, which places farther apart on a curved sheet need not.
PickedCurve walk(const MeshData& mesh, std::uint64_t seed) {
  Random random(seed);
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> left_of;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) left_of[{mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]}] = t;
  const bool round = seed % 3 == 0;
  const auto first = to_size(random.unit() * to_double(mesh.triangles.size()));
  const std::int32_t centre = mesh.triangles[first][seed % 2];
  const std::uint64_t steps = round ? 100 : 3 + seed % 9;
  PickedCurve path{Curve::Kind::polyline, false, {}};
  std::size_t t = first;
  for (std::uint64_t i = 0; i < steps && !path.closed; ++i) {
    const auto& corners = mesh.triangles[t];
    double a = random.unit(), b = random.unit();
    if (a + b > 1) {
      a = 1 - a;
      b = 1 - b;
    }
    const auto at = [&](std::size_t k) { return mesh.deformed[to_size(corners[k])]; };
    path.picks.push_back({(1 - a - b) * at(0) + a * at(1) + b * at(2), {}});
    auto k = to_size(3 * random.unit());
    if (round) k = to_size(std::find(corners.begin(), corners.end(), centre) - corners.begin());
    const auto next = left_of.find({corners[(k + 1) % 3], corners[k]});
    if (next == left_of.end() && round) break;
    if (next != left_of.end()) t = next->second;
    path.closed = round && t == first && i > 1;
  }
  return path;
}

/// The areas of the pieces; none where a part of the cut was not made as asked for. Every cut is judged, in its panels
/// and on the surface.
std::vector<double> cut_if_made(const MeshData& mesh, const PickedCurve& path, const char* method) {
  const MethodRow row = find_method(method);
  const auto tool = row.make(row.parameter.value);
  Sheet sheet(mesh);
  Locator locator(sheet);
  Cutter cutter;
  const std::vector<Curve> curves = Picker(sheet).rest_curves(path, "it");
  for (const Curve& curve : curves) {
    const CutRun run = cut_all(sheet, locator, cutter, {&curve, 1}, *tool, {});
    if (run.status != Status::ok && run.status != Status::noop) return {};
  }
  EXPECT_TRUE(check(sheet).empty());
  const Judgement judgement =
      judge_one_by_one(Sheet(mesh), sheet, curves, row.promises, row.make(row.parameter.value), {});
  EXPECT_TRUE(judgement.ok) << method << ": " << judgement.problems.front();
  EXPECT_EQ(to_size(judgement.pieces), count_pieces(sheet));
  return areas_of_pieces(sheet);
}

/// Two ways to unroll a surface have their seams in different places, and give the same pieces.
TEST(Unroll, RandomCutsGiveTheSamePiecesWhereverTheSeamsAre) {
  const MeshData dome = surface(12, 9, false, [](double u, double v) {
    return Point3{u, v, 0.4 * std::sin(4 * u) * std::sin(3 * v)};
  });
  const std::uint64_t cases = scaled(40);
  std::size_t compared = 0, severed = 0;
  for (const MeshData& mesh : {tube(16, 8, 2), cone(16, 8), dome, sphere(5)}) {
    MeshData other = mesh;
    std::rotate(other.triangles.begin(), other.triangles.begin() + to_int(other.triangles.size() / 2),
                other.triangles.end());
    const MeshData first = unrolled(mesh), second = unrolled(other);
    EXPECT_NE(Sheet(first).seams().front().first, Sheet(second).seams().front().first);
    for (std::uint64_t seed = 1; seed <= cases; ++seed)
      for (const char* method : {"conventional_split", "bowyer_watson", "cgal_cdt", "cut_polygons", "split_and_tie"}) {
        const PickedCurve path = walk(mesh, seed);
        const auto a = cut_if_made(first, path, method), b = cut_if_made(second, path, method);
        if (a.empty() || b.empty()) continue;
        ++compared;
        severed += a.size() > 1;
        EXPECT_EQ(a.size(), b.size()) << method << ", seed " << seed << ", " << mesh.triangles.size() << " triangles";
        if (a.size() != b.size()) continue;
        for (std::size_t i = 0; i < a.size(); ++i)
          EXPECT_NEAR(a[i], b[i], 1e-4) << method << ", seed " << seed << ", " << mesh.triangles.size() << " triangles";
      }
  }
  EXPECT_GT(compared, cases * 12);
  EXPECT_GT(severed, compared / 20);
  RecordProperty("compared", to_int(compared));
  RecordProperty("severed", to_int(severed));
}

/// The way over a cone is straight in the plane that it is unrolled in, wherever its seam is.
TEST(Unroll, AWayOverAConeIsStraight) {
  const MeshData mesh = unrolled(cone(24, 7));
  const Sheet sheet(mesh);
  const Picker picker(sheet);
  const auto pick = [](double turn, double height) {
    const double angle = 2 * pi * turn;
    return Pick{{0, 0, height}, Point3{std::cos(angle), std::sin(angle), 0}};
  };
  for (int i = 0; i < 24; ++i) {
    const double begin = (i + 0.5) / 24, end = begin + 9.0 / 24;
    const PickedCurve path{Curve::Kind::polyline, false, {pick(begin, 0.9), pick(end, 1.4)}};
    double along = 0;
    for (const Curve& curve : picker.rest_curves(path, "it")) along += length_of(curve);
    // Each of the 24 facets has the same angle at the tip.
    const double r = std::cos(pi / 24);
    const double side = std::sqrt(1 + 4.0), half = std::asin(std::sin(pi / 24) / side);
    const double facet = 2 * half, a = 0.45 * std::sqrt(r * r + 4), b = 0.7 * std::sqrt(r * r + 4);
    EXPECT_NEAR(along, std::sqrt(a * a + b * b - 2 * a * b * std::cos(9 * facet)), 1e-9) << i;
  }
}

/// The way over a sphere is an arc of a great circle but for the size of its triangles, squared.
TEST(Unroll, AWayOverASphereHasTheLengthOfAnArc) {
  const auto largest_error = [](int n) {
    const MeshData mesh = unrolled(sphere(n));
    const Sheet sheet(mesh);
    const Picker picker(sheet);
    Random random(7);
    double largest = 0;
    for (int i = 0; i < 40; ++i) {
      const auto direction = [&] {
        const double z = 2 * random.unit() - 1, angle = 2 * pi * random.unit(), r = std::sqrt(1 - z * z);
        return Point3{r * std::cos(angle), r * std::sin(angle), z};
      };
      const Point3 a = direction(), b = direction();
      const double arc = std::acos(a.x * b.x + a.y * b.y + a.z * b.z);
      if (arc > 2) continue;  // there are several ways that are hardly longer
      const PickedCurve path{Curve::Kind::polyline, false, {{2.0 * a, -1.0 * a}, {2.0 * b, -1.0 * b}}};
      double along = 0;
      for (const Curve& curve : picker.rest_curves(path, "it")) along += length_of(curve);
      largest = std::max(largest, std::abs(along - arc));
    }
    return largest;
  };
  const double coarse = largest_error(5), fine = largest_error(10), finest = largest_error(20);
  RecordProperty("errors", std::to_string(coarse) + " " + std::to_string(fine) + " " + std::to_string(finest));
  EXPECT_LT(coarse, 0.08);
  EXPECT_GT(coarse / fine, 3);
  EXPECT_GT(fine / finest, 3);
}

/// A path over a net of seams is in one piece: each stretch ends where the next one begins, as the oracle sees it.
TEST(Unroll, TheStretchesOfAPathMeetAtSeams) {
  const MeshData dome = surface(12, 9, false, [](double u, double v) {
    return Point3{u, v, 0.4 * std::sin(4 * u) * std::sin(3 * v)};
  });
  int crossings = 0;
  for (const MeshData& raw : {tube(16, 8, 2), cone(16, 8), dome, sphere(5)}) {
    const MeshData mesh = unrolled(raw);
    oracle::Surface surface{{{}, mesh.triangles}, mesh.sewn};
    for (const Point2 p : mesh.rest) surface.mesh.rest.push_back({p.x, p.y});
    const Sheet sheet(mesh);
    const Picker picker(sheet);
    Random random(3);
    const auto place = [&] {
      const auto& t = mesh.triangles[to_size(random.unit() * to_double(mesh.triangles.size()))];
      const double a = random.unit(), b = (1 - a) * random.unit();
      const auto at = [&](std::size_t k) { return mesh.deformed[to_size(t[k])]; };
      return (1 - a - b) * at(0) + a * at(1) + b * at(2);
    };
    for (int i = 0; i < 50; ++i) {
      const PickedCurve path{Curve::Kind::polyline, i % 5 == 0, {{place(), {}}, {place(), {}}, {place(), {}}}};
      std::vector<oracle::Curve> cuts;
      for (const Curve& curve : picker.rest_curves(path, "it")) cuts.push_back(for_oracle(curve));
      const auto found = oracle::judge_surface(surface, cuts, surface.mesh, 1e-11);
      EXPECT_EQ(found.alone, 0) << mesh.triangles.size() << " triangles, path " << i;
      crossings += found.crossings;
    }
  }
  EXPECT_GT(crossings, 1000);
}

/// A cap is cut off. At rest no area is lost by any method that keeps it; in space none by those that leave the sheet's
/// vertices and edges where they are, and by the others less than the square of the triangles' size.
TEST(Unroll, ACutOfASphereKeepsItsArea) {
  const auto in_space = [](const MeshData& mesh) {
    double sum = 0;
    for (const auto& [i, j, k] : mesh.triangles) {
      const auto at = [&](std::int32_t v) { return mesh.deformed[to_size(v)]; };
      const Point3 u = at(j) + -1.0 * at(i), v = at(k) + -1.0 * at(i);
      sum += length(Point3{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x}) / 2;
    }
    return sum;
  };
  const std::set<std::string> swap_edges{"cgal_cdt", "cgal_refine", "delaunay_refine", "longest_edge"};
  std::size_t made = 0;
  for (const int n : {6, 12}) {
    const MeshData mesh = unrolled(sphere(n));
    const double before = in_space(mesh);
    const PickedCurve path = ring_at_height(0.31);
    for (const MethodRow& row : all_methods()) {
      if (!row.promises.keeps_area) continue;
      const auto tool = row.make(row.parameter.value);
      Sheet sheet(mesh);
      Locator locator(sheet);
      Cutter cutter;
      const CutRun run = cut_all(sheet, locator, cutter, Picker(sheet).rest_curves(path, "it"), *tool, {});
      if (run.status == Status::refused) continue;
      ++made;
      double at_rest = 0;
      for (const double area : areas_of_pieces(sheet)) at_rest += area;
      EXPECT_NEAR(at_rest, before, 1e-11) << row.name;
      const double lost = std::abs(in_space(sheet.to_mesh_data()) - before);
      const bool is_exact = row.promises.keeps_vertices && !swap_edges.contains(row.name);
      EXPECT_LT(lost, is_exact ? 1e-11 : 1.0 / (n * n)) << row.name << ", " << n;
    }
  }
  EXPECT_GT(made, 2 * 12u);
}

/// A chart beside a net of seams: how far its lengths are off is said, and is what unrolling allows at most.
TEST(Unroll, TheDistortionOfAChartIsSaid) {
  MeshData mesh = surface(16, 16, false, [](double u, double v) {
    const double x = 0.1 * u - 0.05, y = 0.1 * v - 0.05;
    return Point3{x, y, std::sqrt(0.0625 - x * x - y * y)};
  });
  const MeshData laid = unrolled(mesh);
  const double off = distortion(laid);
  EXPECT_GT(off, 1e-9);
  EXPECT_LT(off, unrolled_gap);
  EXPECT_GT(Sheet(laid).seams().size(), 50u);
  char said[48];
  std::snprintf(said, sizeof said, "lengths kept to %.1g", off);
  EXPECT_NE(laid.notes.back().find(said), std::string::npos) << laid.notes.back() << ", " << off;
}

}  // namespace
}  // namespace cutbench
