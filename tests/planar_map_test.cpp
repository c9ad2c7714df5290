// The oracle's arrangement of segments against CGAL's.

#include "harness/oracle/planar_map.h"

#include <CGAL/Arr_consolidated_curve_data_traits_2.h>
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "harness/base/conversions.h"
#include "tests/helpers.h"

namespace cutbench::oracle {
namespace {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using SegmentTraits = CGAL::Arr_segment_traits_2<ExactKernel>;
using Traits = CGAL::Arr_consolidated_curve_data_traits_2<SegmentTraits, int>;
using Arrangement = CGAL::Arrangement_2<Traits>;

/// Area and perimeter.
using FaceSize = std::pair<double, double>;

struct Map {
  std::size_t vertices = 0;
  std::vector<std::vector<int>> edges;  ///< the segments of each
  std::vector<FaceSize> faces;
};

void add_cycle(Arrangement::Ccb_halfedge_const_circulator start, FaceSize& size) {
  auto c = start;
  do {
    const auto &p = c->source()->point(), &q = c->target()->point();
    size.first += CGAL::to_double(p.x() * q.y() - p.y() * q.x()) / 2;
    size.second += std::sqrt(CGAL::to_double((q - p).squared_length()));
  } while (++c != start);
}

Map by_cgal(const std::vector<Segment>& segments) {
  std::vector<Traits::Curve_2> curves;
  for (const auto& [a, b] : segments)
    curves.emplace_back(SegmentTraits::Curve_2({a[0], a[1]}, {b[0], b[1]}), to_int(curves.size()));
  Arrangement arrangement;
  CGAL::insert(arrangement, curves.begin(), curves.end());
  Map map{arrangement.number_of_vertices(), {}, {}};
  for (auto e = arrangement.edges_begin(); e != arrangement.edges_end(); ++e) {
    auto& edge = map.edges.emplace_back(e->curve().data().begin(), e->curve().data().end());
    std::sort(edge.begin(), edge.end());
  }
  for (auto f = arrangement.faces_begin(); f != arrangement.faces_end(); ++f) {
    FaceSize& size = map.faces.emplace_back(0, 0);
    for (auto c = f->outer_ccbs_begin(); c != f->outer_ccbs_end(); ++c) add_cycle(*c, size);
    for (auto c = f->inner_ccbs_begin(); c != f->inner_ccbs_end(); ++c) add_cycle(*c, size);
  }
  return map;
}

Map by_us(const std::vector<Segment>& segments) {
  const PlanarMap planar = planar_map(segments);
  Map map{to_size(planar.vertices), {}, {}};
  for (const auto& edge : planar.edges) map.edges.push_back(edge.segments);
  for (const auto& face : planar.faces) map.faces.emplace_back(face.area, face.perimeter);
  return map;
}

void expect_same(const std::vector<Segment>& segments) {
  Map a = by_us(segments), b = by_cgal(segments);
  EXPECT_EQ(a.vertices, b.vertices);
  std::sort(a.edges.begin(), a.edges.end());
  std::sort(b.edges.begin(), b.edges.end());
  EXPECT_EQ(a.edges, b.edges);
  ASSERT_EQ(a.faces.size(), b.faces.size());
  // Rounded, so that sums in another order sort alike.
  const auto rounded = [](const FaceSize& f) {
    return std::pair(std::round(f.first * 1e9), std::round(f.second * 1e9));
  };
  const auto smaller = [&](const FaceSize& f, const FaceSize& g) { return rounded(f) < rounded(g); };
  std::sort(a.faces.begin(), a.faces.end(), smaller);
  std::sort(b.faces.begin(), b.faces.end(), smaller);
  for (std::size_t i = 0; i < a.faces.size(); ++i) {
    EXPECT_NEAR(a.faces[i].first, b.faces[i].first, 2e-9);
    EXPECT_NEAR(a.faces[i].second, b.faces[i].second, 2e-9);
  }
}

Point random_point(Random& random, std::size_t steps) {
  const auto coordinate = [&] { return to_double(random.below(steps + 1)) / to_double(steps); };
  const double x = coordinate();
  return {x, coordinate()};
}

TEST(PlanarMap, OfSegmentsBetweenFewPointsAsCgals) {  // crossings of many, touches, overlaps; loose parts
  for (std::uint64_t seed = 1; seed <= scaled(300); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const std::size_t steps = 2 + random.below(9);  // thirds, sevenths: crossings that no double is equal to
    std::vector<Segment> segments;
    for (std::size_t n = 1 + random.below(30); n > 0; --n) {
      const Point a = random_point(random, steps), b = random_point(random, steps);
      if (a != b) segments.push_back({a, b});
    }
    expect_same(segments);
  }
}

TEST(PlanarMap, OfSegmentsAFewUlpsApartAsCgals) {
  for (std::uint64_t seed = 1; seed <= scaled(300); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::vector<Segment> segments;
    for (std::size_t n = 1 + random.below(12); n > 0; --n) {
      Segment s{random_point(random, 3), random_point(random, 3)};
      for (Point& p : s)
        for (double& x : p)
          for (std::size_t steps = random.below(3); steps > 0; --steps) x = std::nextafter(x, 2);
      if (s[0] != s[1]) segments.push_back(s);
    }
    expect_same(segments);
  }
}

TEST(PlanarMap, OfSquaresWithinAndBesideOneAnotherAsCgals) {
  const auto add_square = [](std::vector<Segment>& to, Point low, double side) {
    const double x = low[0], y = low[1];
    const Point corners[] = {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
    for (std::size_t k = 0; k < 4; ++k) to.push_back({corners[k], corners[(k + 1) % 4]});
  };
  for (std::uint64_t seed = 1; seed <= scaled(200); ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    std::vector<Segment> segments;
    for (std::size_t n = 2 + random.below(12); n > 0; --n) {
      const Point low = random_point(random, 64);
      add_square(segments, low, to_double(1 + random.below(32)) / 128);
    }
    expect_same(segments);
  }
}

TEST(PlanarMap, KeepsItsNumbersWhereTheyAreHugeOrTiny) {
  const std::vector<Segment> cross{{Point{0, 0}, Point{1, 1}}, {Point{1, 0}, Point{0, 1}}, {Point{0, 0}, Point{1, 0}}};
  for (const int exponent : {-450, 0, 450}) {
    std::vector<Segment> segments = cross;
    for (Segment& s : segments)
      for (Point& p : s)
        for (double& x : p) x = std::ldexp(x, exponent);
    const PlanarMap map = planar_map(segments);
    EXPECT_EQ(map.vertices, 5);
    EXPECT_EQ(map.edges.size(), 5u);
    ASSERT_EQ(map.faces.size(), 2u);
    EXPECT_DOUBLE_EQ(std::ldexp(map.faces[1].area, -2 * exponent), 0.25);
  }
}

TEST(PlanarMap, OfNothingIsOneFace) {
  EXPECT_EQ(planar_map({}).faces.size(), 1u);
  EXPECT_EQ(planar_map({{Point{1, 1}, Point{1, 1}}}).faces.size(), 1u);
}

}  // namespace
}  // namespace cutbench::oracle
