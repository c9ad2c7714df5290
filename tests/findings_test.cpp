// Eight ways to make a right cut wrong, each of random cuts: all are rejected, with the cause, the place and the mend.

#include "harness/judge/findings.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/cut/cut_all.h"
#include "harness/judge/assessment.h"
#include "harness/judge/lost_digits.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

/// A right cut of a sheet, made by a method that keeps the sheet's vertices.
struct Made {
  Sheet before;
  std::vector<Curve> cuts;
  MeshData result;
};

std::optional<Made> make(const Sheet& before, const std::vector<Curve>& cuts, const std::string& method) {
  const MethodRow& row = find_method(method);
  Made made{before, cuts, {}};
  Sheet sheet = before;
  Locator locator(sheet);
  Cutter cutter;
  if (cut_all(sheet, locator, cutter, cuts, *row.make(row.parameter.value), {}).status != Status::ok) return {};
  made.result = sheet.to_mesh_data();
  return made;
}

/// Draws cuts until one can be made; another sheet, family and method each time.
Made random_cut(Random& random) {
  constexpr const char* families[] = {"straight", "curved", "partial", "cut_out", "several", "self_crossing"};
  constexpr const char* methods[] = {"conventional_split", "bowyer_watson", "delaunay_refine"};
  for (;;) {
    const Sheet sheet(lifted(make_sheet(sheet_families()[random.below(4)], 9 + to_int(random.below(5)))));
    const auto cuts = make_case(families[random.below(6)], random.below(1000000), random.below(100), sheet);
    if (auto made = make(sheet, cuts, methods[random.below(3)])) return std::move(*made);
  }
}

using Vertices = std::vector<std::int32_t>;
using Places = std::map<std::pair<double, double>, Vertices>;

Places vertices_by_place(const MeshData& mesh) {
  Places places;
  for (std::size_t v = 0; v < mesh.rest.size(); ++v) places[{mesh.rest[v].x, mesh.rest[v].y}].push_back(to_int32(v));
  return places;
}

Point2 rest(const MeshData& mesh, std::int32_t v) { return mesh.rest[to_size(v)]; }

Point2 centre(const MeshData& mesh, std::size_t t) {
  const auto& [a, b, c] = mesh.triangles[t];
  return 1.0 / 3 * (rest(mesh, a) + rest(mesh, b) + rest(mesh, c));
}

/// Spoils the result and says where; nothing where this draw did not suit.
using Spoil = std::function<std::optional<Point2>(Made&, Random&)>;

std::optional<Point2> flip(Made& m, Random& random) {
  const std::size_t t = random.below(m.result.triangles.size());
  std::swap(m.result.triangles[t][0], m.result.triangles[t][1]);
  return centre(m.result, t);
}

std::optional<Point2> move_vertex(Made& m, Random& random) {
  const std::size_t v = random.below(m.before.vertex_count());
  const Point2 was = m.result.rest[v];
  const double angle = random.between(0, 6.283), by = m.before.mean_edge() * random.between(0.02, 0.3);
  m.result.rest[v] = was + Point2{by * std::cos(angle), by * std::sin(angle)};
  return was;
}

/// An edge of the incision, long enough to matter, gets one vertex at each end.
std::optional<Point2> close_edge(Made& m, Random& random) {
  const Places places = vertices_by_place(m.result);
  std::map<std::pair<std::int32_t, std::int32_t>, int> edge_of;
  for (const auto& t : m.result.triangles)
    for (std::size_t k = 0; k < 3; ++k) edge_of[{t[k], t[(k + 1) % 3]}] = 1;
  std::vector<std::pair<Point2, Point2>> edges;
  for (const auto& [ends, unused] : edge_of) {
    const auto& [a, b] = ends;
    const Point2 p = rest(m.result, a), q = rest(m.result, b);
    const Vertices &at_p = places.at({p.x, p.y}), &at_q = places.at({q.x, q.y});
    if (edge_of.contains({b, a}) || at_p.size() != 2 || at_q.size() != 2) continue;
    const auto other_a = at_p[0] == a ? at_p[1] : at_p[0], other_b = at_q[0] == b ? at_q[1] : at_q[0];
    if (edge_of.contains({other_b, other_a}) && length(q - p) > 0.2 * m.before.mean_edge()) edges.emplace_back(p, q);
  }
  if (edges.empty()) return {};
  const auto [p, q] = edges[random.below(edges.size())];
  for (const Point2 end : {p, q}) {
    const Vertices both = places.at({end.x, end.y});
    for (auto& t : m.result.triangles)
      for (auto& v : t)
        if (v == both[1]) v = both[0];
  }
  return 0.5 * (p + q);
}

/// Removes vertices that no triangle has, as a program's writer would.
void drop_unused(MeshData& mesh) {
  std::vector<std::int32_t> number(mesh.rest.size(), -1);
  MeshData kept;
  for (auto t : mesh.triangles) {
    for (auto& v : t) {
      auto& n = number[to_size(v)];
      if (n < 0) {
        n = to_int32(kept.rest.size());
        kept.rest.push_back(rest(mesh, v));
        kept.deformed.push_back(mesh.deformed[to_size(v)]);
      }
      v = n;
    }
    kept.triangles.push_back(t);
  }
  mesh = kept;
}

/// One of the cuts is made a third of an edge beside its path.
std::optional<Point2> shift(Made& m, Random& random) {
  std::vector<Curve> moved = m.cuts;
  Curve& cut = moved[random.below(moved.size())];
  Point2 along = cut.points.back() - cut.points.front();
  if (cut.closed || length(along) < m.before.mean_edge()) along = {1, 0.3};
  const Point2 aside = 0.33 * m.before.mean_edge() / length(along) * Point2{-along.y, along.x};
  for (Point2& p : cut.points) p = p + aside;
  const auto made = make(m.before, moved, "conventional_split");
  if (!made) return {};
  m.result = made->result;
  return cut.points.front();  // not looked at: anywhere along it
}

std::optional<Point2> divide_one_side(Made& m, Random& random) {
  const std::size_t t = random.below(m.result.triangles.size());
  const auto [a, b, c] = m.result.triangles[t];
  bool inner = false;
  for (const auto& u : m.result.triangles)
    for (std::size_t k = 0; k < 3; ++k) inner |= u[k] == b && u[(k + 1) % 3] == a;
  const double share = random.between(0.3, 0.7);
  const Point2 p = (1 - share) * rest(m.result, a) + share * rest(m.result, b);
  if (!inner) return {};
  const auto v = to_int32(m.result.rest.size());
  m.result.rest.push_back(p);
  m.result.deformed.push_back({});
  m.result.triangles[t] = {a, v, c};
  m.result.triangles.push_back({v, b, c});
  return p;
}

std::optional<Point2> round_to_float(Made& m, Random&) {
  for (Point2& p : m.result.rest) p = {to_double(static_cast<float>(p.x)), to_double(static_cast<float>(p.y))};
  return Point2{};
}

std::optional<Point2> lose_triangle(Made& m, Random& random) {
  const std::size_t t = random.below(m.result.triangles.size());
  const Point2 place = centre(m.result, t);
  m.result.triangles.erase(m.result.triangles.begin() + to_index(t));
  drop_unused(m.result);
  return place;
}

std::optional<Point2> part_lips(Made& m, Random& random) {
  std::vector<Vertices> shared;
  for (const auto& [place, vertices] : vertices_by_place(m.result))
    if (vertices.size() > 1) shared.push_back(vertices);
  const Vertices& vertices = shared[random.below(shared.size())];
  Point2& p = m.result.rest[to_size(vertices[random.below(vertices.size())])];
  const Point2 was = p;
  if (random.below(2) == 0)
    p.x = std::nextafter(p.x, 9);
  else
    p = p + Point2{1e-12, -2e-12};
  return was;
}

struct Way {
  std::string name;
  Spoil spoil;
  std::vector<std::string> causes;  ///< any of them
  bool keeps_vertices = false, has_place = true;
};

std::vector<Way> ways() {
  return {{"FlippedTriangle", flip, {"flipped"}},
          {"VertexMoved", move_vertex, {"moved_vertex"}, true},
          {"LipNotOpened", close_edge, {"not_opened", "one_vertex"}},
          {"IncisionShifted", shift, {"shifted"}, false, false},
          {"NeighbourUnsplit", divide_one_side, {"t_junction"}},
          {"RoundedToFloat", round_to_float, {"rounded"}, false, false},
          {"LostTriangle", lose_triangle, {"lost_triangle"}},
          {"LipsNotBitEqual", part_lips, {"lips_differ"}}};
}

class Wrong : public testing::TestWithParam<Way> {};

TEST_P(Wrong, IsRejectedForTheRightReason) {
  const Way& way = GetParam();
  Random random(11);
  for (std::size_t done = 0; done < scaled(100);) {
    Made made = random_cut(random);
    Promises asked = promises_of_everybody;
    asked.keeps_vertices = way.keeps_vertices;
    ASSERT_TRUE(assess_result(made.before, made.result, made.cuts, asked, {}).judgement.ok);
    const auto place = way.spoil(made, random);
    if (!place) continue;
    SCOPED_TRACE(way.name + ", cut " + std::to_string(done++) + ", " + text_of(made.cuts.front()));
    if (way.name == "LipNotOpened") drop_unused(made.result);
    const Assessment a = assess_result(made.before, made.result, made.cuts, asked, {});
    EXPECT_FALSE(a.judgement.ok);
    ASSERT_EQ(a.findings.size(), 1u);
    const Finding& found = a.findings.front();
    EXPECT_TRUE(std::find(way.causes.begin(), way.causes.end(), found.cause) != way.causes.end())
        << found.cause << ": " << found.text << "\n"
        << a.judgement.problems.front();
    EXPECT_FALSE(found.mend.empty());
    ASSERT_TRUE(found.place.has_value());
    const Point2 p{(*found.place)[0], (*found.place)[1]};
    const double h = made.before.mean_edge();
    if (way.has_place) {
      EXPECT_LT(length(p - *place), 0.75 * h) << found.text;
    }
    EXPECT_GE(found.cut, 1);
    EXPECT_LE(found.cut, to_int(made.cuts.size()));
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, Wrong, testing::ValuesIn(ways()),
                         [](const auto& parameter) { return parameter.param.name; });

TEST(Findings, TheNumberOfTheCutIsThatOfTheShiftedOne) {
  const Sheet sheet(make_sheet("grid", 12));
  const auto line = [](double y) { return Curve{Curve::Kind::polyline, false, {{0.13, y}, {0.88, y + 0.01}}}; };
  const std::vector<Curve> asked{line(0.21), line(0.52), line(0.81)};
  for (std::size_t i = 0; i < asked.size(); ++i) {
    std::vector<Curve> other = asked;
    for (Point2& p : other[i].points) p.y += 0.03;
    const auto made = make(sheet, other, "conventional_split");
    ASSERT_TRUE(made);
    const Assessment a = assess_result(sheet, made->result, asked, promises_of_everybody, {});
    ASSERT_EQ(a.findings.size(), 1u);
    EXPECT_EQ(a.findings.front().cause, "shifted");
    EXPECT_EQ(a.findings.front().cut, to_int(i) + 1);
  }
}

/// Where deformed positions stand for rest positions, or another sheet was cut.
TEST(Findings, OtherRestPositions) {
  const Sheet sheet(lifted(make_sheet("delaunay", 9)));
  auto made = make(sheet, {{Curve::Kind::polyline, false, {{-0.1, 0.43}, {1.1, 0.52}}}}, "conventional_split");
  ASSERT_TRUE(made);
  for (std::size_t v = 0; v < made->result.rest.size(); ++v)
    made->result.rest[v] = {made->result.deformed[v].x, made->result.deformed[v].y};
  const Assessment a = assess_result(sheet, made->result, made->cuts, promises_of_everybody, {});
  ASSERT_EQ(a.findings.size(), 1u);
  EXPECT_EQ(a.findings.front().cause, "other_rest");
}

std::optional<Made> cut_across() {
  return make(Sheet(make_sheet("delaunay", 9)), {{Curve::Kind::polyline, false, {{-0.1, 0.43}, {1.1, 0.52}}}},
              "conventional_split");
}

TEST(Findings, AllTrianglesReversedAreFlipped) {
  auto made = cut_across();
  ASSERT_TRUE(made);
  for (auto& t : made->result.triangles) std::swap(t[0], t[1]);
  const Assessment a = assess_result(made->before, made->result, made->cuts, promises_of_everybody, {});
  ASSERT_EQ(a.findings.size(), 1u);
  EXPECT_EQ(a.findings.front().cause, "flipped");
  EXPECT_NE(a.findings.front().text.find("every triangle"), std::string::npos);
}

/// The pieces of a result, by its vertices; the first has number 0.
std::vector<int> piece_of_vertices(const MeshData& mesh) {
  std::vector<int> piece(mesh.rest.size());
  std::iota(piece.begin(), piece.end(), 0);
  for (bool changed = true; changed;) {
    changed = false;
    for (const auto& t : mesh.triangles) {
      const int least = std::min({piece[to_size(t[0])], piece[to_size(t[1])], piece[to_size(t[2])]});
      for (const auto v : t) changed |= std::exchange(piece[to_size(v)], least) != least;
    }
  }
  return piece;
}

Finding only_finding(const Made& made) {
  const Assessment a = assess_result(made.before, made.result, made.cuts, promises_of_everybody, {});
  EXPECT_FALSE(a.judgement.ok);
  EXPECT_EQ(a.findings.size(), 1u);
  return a.findings.empty() ? Finding{} : a.findings.front();
}

TEST(Findings, PiecesMovedApartAreNamed) {
  for (const Point2 by : {Point2{0, -0.3}, Point2{0.125, 0}, Point2{-3, 2}}) {
    auto made = cut_across();
    ASSERT_TRUE(made);
    const std::vector<int> piece = piece_of_vertices(made->result);
    for (std::size_t v = 0; v < piece.size(); ++v)
      if (piece[v] == 0) made->result.rest[v] = made->result.rest[v] + by;
    const Finding f = only_finding(*made);
    EXPECT_EQ(f.cause, "moved_apart") << f.text;
    EXPECT_EQ(f.text.find("the sheet's vertices are not at their rest places: "), 0u) << f.text;
    EXPECT_NE(f.text.find("is moved by ("), std::string::npos) << f.text;
  }
}

TEST(Findings, APieceThatRunsClockwiseIsNamed) {
  auto made = cut_across();
  ASSERT_TRUE(made);
  const std::vector<int> piece = piece_of_vertices(made->result);
  for (auto& t : made->result.triangles)
    if (piece[to_size(t[0])] == 0) std::swap(t[0], t[1]);
  const Finding f = only_finding(*made);
  EXPECT_EQ(f.cause, "flipped") << f.text;
  EXPECT_NE(f.text.find("every triangle of the piece round "), std::string::npos) << f.text;
}

/// The first triangle at a lip's vertex that shares it with others gets a copy.
TEST(Findings, DoubledVerticesAtTheCutAreNamed) {
  auto made = cut_across();
  ASSERT_TRUE(made);
  MeshData& mesh = made->result;
  const MeshData right = mesh;
  const auto places = vertices_by_place(mesh);
  const auto copy = to_int32(mesh.rest.size());
  bool done = false;
  for (auto& t : mesh.triangles)
    for (auto& v : t) {
      const Point2 p = rest(mesh, v);
      if (done || p.x < 0.3 || p.x > 0.7 || places.at({p.x, p.y}).size() != 2) continue;
      mesh.rest.push_back(Point2(p));
      mesh.deformed.push_back({p.x, p.y, 0});
      v = copy;
      done = true;
    }
  ASSERT_TRUE(done);
  EXPECT_EQ(only_finding(*made).cause, "doubled") << only_finding(*made).text;

  mesh = right;
  for (std::size_t v = made->before.vertex_count(); v < right.rest.size(); ++v) {
    mesh.rest.push_back(right.rest[v]);
    mesh.deformed.push_back(right.deformed[v]);
  }
  EXPECT_EQ(only_finding(*made).cause, "doubled") << only_finding(*made).text;
}

double with_digits(double x, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, x);
  return std::strtod(text, nullptr);
}

/// Written with few digits most right results are wrong, and right when read with as many; a wrong one stays wrong.
TEST(Findings, FewDigitsAreAllowedWhereAskedFor) {
  Random random(5);
  Promises asked = promises_of_everybody;
  asked.keeps_vertices = true;
  std::size_t right = 0, strictly_wrong = 0;
  for (std::size_t i = 0; i < scaled(100); ++i) {
    Made made = random_cut(random);
    SCOPED_TRACE(text_of(made.cuts.front()));
    const int digits = 6 + to_int(random.below(8));
    for (Point2& p : made.result.rest) p = {with_digits(p.x, digits), with_digits(p.y, digits)};
    strictly_wrong += !assess_result(made.before, made.result, made.cuts, asked, {}).judgement.ok;
    const Assessment a = assess_result(made.before, made.result, made.cuts, asked, {}, digits);
    right += a.judgement.ok;
    if (!a.judgement.ok) {
      EXPECT_EQ(a.judgement.verdict, Verdict::rounded) << a.judgement.problems.front();
      continue;
    }
    EXPECT_LT(a.read.farthest, a.read.unit);
    for (const Way& way : ways()) {
      if (way.name == "RoundedToFloat" || way.name == "LipsNotBitEqual") continue;
      Made wrong = made;
      if (!way.spoil(wrong, random)) continue;
      if (way.name == "LipNotOpened") drop_unused(wrong.result);
      EXPECT_FALSE(assess_result(made.before, wrong.result, made.cuts, asked, {}, digits).judgement.ok) << way.name;
    }
  }
  EXPECT_GT(right, scaled(100) / 2);
  EXPECT_GT(strictly_wrong, scaled(100) / 2);
}

TEST(Findings, DigitsThatMixUpVerticesAreRefused) {
  const auto made = cut_across();
  ASSERT_TRUE(made);
  EXPECT_THROW(assess_result(made->before, made->result, made->cuts, promises_of_everybody, {}, 1), InputError);
}

/// A flat triangle beside the incision that has vertices of its own is a piece more.
TEST(Findings, TheSmallestOfTooManyPiecesIsNamed) {
  auto made = cut_across();
  ASSERT_TRUE(made);
  MeshData& mesh = made->result;
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) edges.insert({t[k], t[(k + 1) % 3]});
  const auto on_path = [](Point2 p) { return std::abs(p.y - 0.43 - 0.075 * (p.x + 0.1)) < 1e-12; };
  const auto place_of = [&](std::int32_t v) { return rest(mesh, v); };
  std::size_t torn = mesh.triangles.size(), corner = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto p = mesh.triangles[t][k], q = mesh.triangles[t][(k + 1) % 3];
      if (on_path(place_of(p)) && on_path(place_of(q)) && place_of(p).x > 0.4) {
        torn = t;
        corner = k;
      }
    }
  ASSERT_LT(torn, mesh.triangles.size());
  const auto add = [&](Point2 p) {
    mesh.rest.push_back(p);
    mesh.deformed.push_back({p.x, p.y, 0});
    return to_int32(mesh.rest.size() - 1);
  };
  const auto was = mesh.triangles[torn];
  const auto p = was[corner], q = was[(corner + 1) % 3], apex = was[(corner + 2) % 3];
  const Point2 a = place_of(p), b = place_of(q), inside = 0.5 * (a + b) + 0.02 * (place_of(apex) - 0.5 * (a + b));
  const std::int32_t middle = add(inside);
  mesh.triangles[torn] = {q, apex, middle};
  mesh.triangles.push_back({apex, p, middle});
  const std::int32_t own_p = add(a), own_q = add(b), own_middle = add(inside);
  mesh.triangles.push_back({own_p, own_q, own_middle});
  const Assessment found = assess_result(made->before, mesh, made->cuts, promises_of_everybody, {});
  ASSERT_EQ(found.findings.size(), 1u);
  const Finding& f = found.findings.front();
  EXPECT_EQ(f.cause, "extra_pieces") << f.text;
  ASSERT_EQ(f.text.find("3 pieces instead of 2; the smallest: area "), 0u) << f.text;
  const double area = 0.5 * cross(b - a, inside - a);
  EXPECT_NEAR(std::stod(f.text.substr(f.text.find("area ") + 5)), area, 0.01 * area);
  ASSERT_TRUE(f.place);
  EXPECT_LT(length(Point2{(*f.place)[0], (*f.place)[1]} - 1.0 / 3 * (a + b + inside)), 1e-12);
}

/// A loop so flat that a slit lies within the tolerance of it.
TEST(Findings, ALoopThatBecameASlitIsNamed) {
  const Sheet sheet(make_sheet("grid", 10));
  const double h = sheet.mean_edge();
  const Point2 a{0.31, 0.47}, b{0.31 + 2.5 * h, 0.52}, c = 0.5 * (a + b) + Point2{0, 0.04 * h};
  const auto made = make(sheet, {{Curve::Kind::polyline, false, {a, b}}}, "conventional_split");
  ASSERT_TRUE(made);
  const std::vector<Curve> asked{{Curve::Kind::polyline, true, {a, b, c}}};
  const Assessment found = assess_result(sheet, made->result, asked, promises_of_everybody, {});
  EXPECT_EQ(found.judgement.verdict, Verdict::wrong_pieces);
  ASSERT_EQ(found.findings.size(), 1u);
  EXPECT_EQ(found.findings.front().cause, "lost_loop") << found.findings.front().text;
  ASSERT_TRUE(found.findings.front().place);
  EXPECT_NEAR((*found.findings.front().place)[0], (a.x + b.x + c.x) / 3, 0.1 * h);
}

TEST(Findings, LostDigitsAreSeenAndShortNumbersAreNot) {
  using Points = std::vector<oracle::Point>;
  Random random(3);
  Points doubles, floats, decimals, simple{{0.5, 0.25}, {0.125, 0.75}, {1, 0}, {0, 0.375}};
  for (int i = 0; i < 20; ++i) {
    const double x = random.between(0, 1), y = random.between(0, 1);
    doubles.push_back({x, y});
    floats.push_back({to_double(static_cast<float>(x)), to_double(static_cast<float>(y))});
    decimals.push_back({std::round(1e6 * x) / 1e6, std::round(1e6 * y) / 1e6});
  }
  EXPECT_EQ(lost_digits(doubles), "");
  EXPECT_EQ(lost_digits(simple), "");
  EXPECT_EQ(lost_digits({}), "");
  EXPECT_EQ(lost_digits(floats), "in single precision");
  EXPECT_EQ(lost_digits(decimals), "with 6 decimals");
  const double known = 0.500001;  // of a path along an axis: at every vertex of it
  EXPECT_EQ(lost_digits({{0.1, known}, {0.2, known}, {0.3, known}, {0.4, known}, {0.5, known}}), "");
  std::set<double> all_of_them;
  for (const oracle::Point& p : decimals) all_of_them.insert(p.begin(), p.end());
  EXPECT_EQ(lost_digits(decimals, all_of_them), "");
  floats.push_back(doubles.front());
  EXPECT_EQ(lost_digits(floats), "");
}

}  // namespace
}  // namespace cutbench
