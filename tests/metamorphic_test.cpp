// The same cut of the same sheet, scaled, turned, mirrored or numbered otherwise.

#include "tests/metamorphic.h"

#include "harness/base/conversions.h"

namespace cutbench {
namespace {

/// Everything is homogeneous in length and decided by exact signs, so that a power of two changes no digit. The
/// deformed sheet counts for nothing, but in adaptive_remesh, where it is scaled, too.
TEST_P(EveryVariant, IsScaledByPowersOfTwoBitForBit) {
  for_each_case(
      scaled(1), 411,
      [&](const TestCase& c) {
        if (HasFailure()) return;
        const MeshData mesh = lifted(*c.mesh);
        const CutSheet plain = cut_with(GetParam(), mesh, c.cuts, c.chord_tolerance);
        const MeshData expected = plain.sheet.to_mesh_data();
        for (int exponent : {-150, -40, 40, 150}) {
          const double s = std::ldexp(1, exponent);
          MeshData larger = mesh;
          for (Point2& p : larger.rest) p = s * p;
          const double deformed = GetParam().row->name == "adaptive_remesh" ? s : 1;
          for (Point3& p : larger.deformed) p = deformed * p;
          std::vector<Curve> cuts = c.cuts;
          for (Curve& curve : cuts)
            for (Point2& p : curve.points) p = s * p;
          const CutSheet cut = cut_with(GetParam(), larger, cuts, c.chord_tolerance);
          MeshData found = cut.sheet.to_mesh_data();
          for (Point3& p : found.deformed) p = 1 / deformed * p;
          std::vector<Point2> rest;
          for (Point2 p : expected.rest) rest.push_back(s * p);
          const bool same = cut.statuses == plain.statuses && found.triangles == expected.triangles &&
                            found.rest == rest && found.deformed == expected.deformed;
          EXPECT_TRUE(same) << "scaled by 2^" << exponent << ": " << text_of(c);
        }
      },
      true);
}

const Isometry motions[] = {
    {"turned",
     [](Point2 p) {
       return Point2{-p.y, p.x};
     },
     [](Point2 p) {
       return Point2{p.y, -p.x};
     },
     false, false},
    {"mirrored",
     [](Point2 p) {
       return Point2{-p.x, p.y};
     },
     [](Point2 p) {
       return Point2{-p.x, p.y};
     },
     true, false},
    {"renumbered", [](Point2 p) { return p; }, [](Point2 p) { return p; }, false, true},
};

/// The sine of the sum of the angles at r and s over the edge p q: zero where the four lie on one circle.
double off_circle(Point2 p, Point2 q, Point2 r, Point2 s) {
  const auto sine = [&](Point2 at) {
    return std::abs(cross(p - at, q - at)) / std::sqrt(squared_length(p - at) * squared_length(q - at));
  };
  const auto cosine = [&](Point2 at) {
    return dot(p - at, q - at) / std::sqrt(squared_length(p - at) * squared_length(q - at));
  };
  return sine(r) * cosine(s) + cosine(r) * sine(s);
}

/// Empty where each edge of `a` that `b` lacks is the diagonal of four points on one circle, up to `tolerance` in their
/// coordinates. A polygon with all its corners on one circle has only such edges inside.
std::string unconstrained_edge(const Shape& a, const Shape& b, double tolerance) {
  const auto at = [&](int i) { return a.points[to_size(i)]; };
  for (const auto& [edge, apexes] : a.apexes) {
    if (b.apexes.contains(edge)) continue;
    const Point2 p = at(edge[0]), q = at(edge[1]);
    if (apexes.size() == 2) {
      const Point2 r = at(apexes[0]), s = at(apexes[1]);
      double shortest = squared_length(q - p);
      for (Point2 x : {p, q})
        for (Point2 y : {r, s}) shortest = std::min(shortest, squared_length(y - x));
      if (std::abs(off_circle(p, q, r, s)) <= tolerance / std::sqrt(shortest)) continue;
    }
    char text[200];
    std::snprintf(text, sizeof text, "unconstrained edge {%.17g, %.17g} - {%.17g, %.17g}, off %g", p.x, p.y, q.x, q.y,
                  apexes.size() == 2 ? off_circle(p, q, at(apexes[0]), at(apexes[1])) : 0.0);
    return text;
  }
  return {};
}

/// Gives the points of `b` the numbers of those of `a`; says so where a point has no partner.
std::string renumber(Shape& b, const Shape& a, double tolerance) {
  if (a.points.size() != b.points.size()) return "number of vertices";
  std::vector<std::pair<double, int>> by_x;
  for (std::size_t i = 0; i < a.points.size(); ++i) by_x.emplace_back(a.points[i].x, to_int(i));
  std::sort(by_x.begin(), by_x.end());
  std::vector<int> number;
  std::set<int> taken;
  for (Point2 p : b.points) {
    auto it = std::lower_bound(by_x.begin(), by_x.end(), std::pair{p.x - tolerance, 0});
    while (it != by_x.end() && std::abs(a.points[to_size(it->second)].y - p.y) > tolerance) ++it;
    if (it == by_x.end() || it->first > p.x + tolerance || !taken.insert(it->second).second) {
      char text[100];
      std::snprintf(text, sizeof text, "no partner for vertex {%.17g, %.17g}", p.x, p.y);
      return text;
    }
    number.push_back(it->second);
  }
  Shape result;
  result.points = a.points;
  result.pieces = b.pieces;
  result.deformed = b.deformed;
  const auto map = [&](auto corners) {
    for (int& i : corners) i = number[to_size(i)];
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  for (const auto& edge : b.opened) result.opened.insert(map(edge));
  for (const auto& edge : b.border) result.border.insert(map(edge));
  for (const auto& [edge, apexes] : b.apexes) result.apexes[map(edge)] = map(apexes);
  b = std::move(result);
  return {};
}

/// Renumbers `b` and compares opened edges, border edges and deformed vertices.
std::string different_edges(const Shape& a, Shape& b, double tolerance) {
  if (std::string what = renumber(b, a, tolerance); !what.empty()) return what;
  if (b.opened != a.opened) return "opened edges";
  if (b.border != a.border) return "border edges";
  return b.deformed != a.deformed ? "deformed vertices" : "";
}

double largest_coordinate(const Shape& shape) {
  double largest = 0;
  for (Point2 p : shape.points) largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
  return largest;
}

/// Turned by a right angle, mirrored or renumbered, a cut opens the same edges and leaves the same triangles.
///
/// "The same" is up to three things. Crossings are reckoned from the end of the edge that lies to the path's right, so
/// mirroring moves them by an ulp, and with them exact constraints between diagonals. Where a segment had to be
/// recovered by flips, the triangles round it depend on the order of the flips. And the local split goes from triangle
/// to triangle by their numbers and changes its neighbours as it goes. In these two the incision of a first cut is
/// compared; the next one meets other triangles. Of methods that choose where the incision goes, and may have to choose
/// between two vertices equally near, the pieces after a first cut are.
TEST_P(EveryVariant, MovesWithTheSheet) {
  const bool is_exact = GetParam().row->promises.exact_incision;
  const bool splits_locally = GetParam().parameter > 0 || !is_exact || !GetParam().row->promises.keeps_vertices;
  std::size_t tried = 0, in_full = 0;
  for_each_case(scaled(2), 412, [&](TestCase c) {
    if (HasFailure()) return;
    if (splits_locally) c.cuts.resize(1);
    const CutSheet plain = cut_with(GetParam(), *c.mesh, c.cuts, c.chord_tolerance);
    const Shape expected = shape_of(plain.sheet);
    const double rounding = 4 * std::numeric_limits<double>::epsilon() * largest_coordinate(expected);
    for (const Isometry& motion : motions) {
      std::vector<Curve> cuts;
      for (const Curve& curve : c.cuts) cuts.push_back(moved(curve, motion));
      const CutSheet cut = cut_with(GetParam(), moved(*c.mesh, motion, tried), cuts, c.chord_tolerance);
      Shape found = shape_of(cut.sheet, motion.back);
      const bool recovered = plain.recovered_segments + cut.recovered_segments > 0;
      ++tried;
      if (recovered && cuts.size() > 1) continue;
      std::string what;
      if (is_exact)
        what = different_cut(expected, found, plain.sheet.snap());
      else if (found.pieces != expected.pieces)
        what = "pieces";
      if (cut.statuses != plain.statuses) what = "another status";
      if (what.empty() && !splits_locally) what = different_edges(expected, found, rounding);
      if (what.empty() && !splits_locally && !recovered) {
        ++in_full;
        what = unconstrained_edge(expected, found, rounding) + unconstrained_edge(found, expected, rounding);
      }
      EXPECT_EQ(what, "") << motion.name << ": " << text_of(c);
    }
  });
  EXPECT_TRUE(splits_locally || in_full > tried / 2) << in_full << " of " << tried;
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryVariant, testing::ValuesIn(all_variants()), name_of_variant);

}  // namespace
}  // namespace cutbench
