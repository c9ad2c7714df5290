// What the metamorphic tests share: variants of methods, cuts to make with them, a sheet cut by a whole case, and what
// is left of the result when numbering is forgotten.
#pragma once

#include <map>
#include <set>

#include "harness/base/conversions.h"
#include "harness/cases/adversarial.h"
#include "harness/cases/cut_families.h"
#include "harness/oracle/search.h"
#include "methods/registry.h"
#include "tests/helpers.h"

namespace cutbench {

/// A method with a value of its parameter.
struct MethodVariant {
  const MethodRow* row;
  double parameter;
  std::string name;

  friend void PrintTo(const MethodVariant& variant, std::ostream* out) { *out << variant.name; }
};

/// Every row at its default; the paper's method also without and with much local split.
inline std::vector<MethodVariant> all_variants() {
  std::vector<MethodVariant> variants;
  for (const MethodRow& row : all_methods())
    if (row.name != "bowyer_watson") variants.push_back({&row, row.parameter.value, row.name});
  for (int rounds : {0, 1, 3})
    variants.push_back(
        {&find_method("bowyer_watson"), to_double(rounds), "bowyer_watson_rounds_" + std::to_string(rounds)});
  return variants;
}

class EveryVariant : public testing::TestWithParam<MethodVariant> {};
inline std::string name_of_variant(const testing::TestParamInfo<MethodVariant>& info) { return info.param.name; }

/// One or more cuts on one of the test meshes.
struct TestCase {
  std::string name;
  const MeshData* mesh;
  std::vector<Curve> cuts;
  double chord_tolerance;
};

inline std::string text_of(const TestCase& c) {
  std::string text = c.name + ", chord tolerance " + std::to_string(c.chord_tolerance);
  for (const Curve& curve : c.cuts) text += "\n" + text_of(curve);
  return text;
}

/// Calls visit(TestCase) for `n` cases of every family on every test mesh.
/// \param adversarial  and as many of the adversarial. It lies at the very limits of snapping, where a change of
/// direction or of
///                 rounding may decide the other way.
template <class Visit>
void for_each_case(std::size_t n, std::uint64_t seed, Visit visit, bool adversarial = false) {
  static const std::vector<NamedMesh> meshes = test_meshes(5);
  for (const auto& [name, mesh] : meshes) {
    const Sheet sheet(mesh);
    for (std::size_t i = 0; i < n; ++i) {
      const double chord = i % 2 == 0 ? 0.05 : infinite;
      const std::string number = " " + std::to_string(i) + ", seed " + std::to_string(seed) + ", sheet " + name;
      for (const std::string family : cut_families())
        visit(TestCase{family + number, &mesh, make_case(family, seed, i, sheet), chord});
      for (std::size_t k = 0; adversarial && k < cut_families().size(); ++k) {
        AdversarialCase drawn = make_adversarial_case(seed, i * cut_families().size() + k, sheet);
        visit(TestCase{"adversarial " + drawn.family + " " + std::to_string(k) + number, &mesh, std::move(drawn.cuts),
                       chord});
      }
    }
  }
}

/// A sheet and what became of the cuts made in it.
struct CutSheet {
  Sheet sheet;
  std::vector<std::string> statuses;
  int recovered_segments = 0;  ///< of all cuts together
};

inline CutSheet cut_with(const MethodVariant& variant, const MeshData& mesh, const std::vector<Curve>& cuts,
                         double chord) {
  CutSheet result{Sheet(mesh), {}, 0};
  Locator locator(result.sheet);
  Cutter cutter;
  const auto method = variant.row->make(variant.parameter);
  for (const Curve& curve : cuts) {
    const CutOutcome outcome = cutter.cut(result.sheet, locator, curve, *method, {.chord_tolerance = chord});
    result.statuses.push_back(name_of(outcome.status));
    if (outcome.status != Status::ok) result.statuses.back() += " " + outcome.reason;  // else a remark on shapes
    result.recovered_segments += outcome.recovered_segments;
  }
  return result;
}

/// A map of the plane onto itself that keeps doubles exact, and a new numbering.
struct Isometry {
  std::string name;
  Point2 (*there)(Point2);
  Point2 (*back)(Point2);
  bool mirrors, renumbers;
};

inline Curve moved(Curve curve, const Isometry& motion) {
  for (Point2& p : curve.points) p = motion.there(p);
  return curve;
}

inline MeshData moved(MeshData mesh, const Isometry& motion, std::uint64_t seed) {
  for (Point2& p : mesh.rest) p = motion.there(p);
  if (motion.mirrors)
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  if (!motion.renumbers) return mesh;
  Random random(seed);
  const auto shuffle = [&](auto& items) {
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.below(i)]);
  };
  std::vector<std::int32_t> number(mesh.rest.size());
  for (std::size_t v = 0; v < number.size(); ++v) number[v] = to_int32(v);
  shuffle(number);
  MeshData result = mesh;
  for (std::size_t v = 0; v < number.size(); ++v) {
    result.rest[to_size(number[v])] = mesh.rest[v];
    result.deformed[to_size(number[v])] = mesh.deformed[v];
  }
  for (auto& t : result.triangles) {
    for (auto& v : t) v = number[to_size(v)];
    std::rotate(t.begin(), t.begin() + to_index(random.below(3)), t.end());
  }
  shuffle(result.triangles);
  return result;
}

/// A cut sheet without its numbering.
struct Shape {
  using Edge = std::array<int, 2>;
  std::vector<Point2> points;  ///< rest vertices; the others by their places in here, in ascending order
  std::set<Edge> opened, border;
  std::map<Edge, std::vector<int>> apexes;  ///< of the triangles at each edge
  std::size_t pieces = 0, deformed = 0;
};

inline Shape shape_of(
    const Sheet& sheet, Point2 (*back)(Point2) = [](Point2 p) { return p; }) {
  Shape shape;
  std::vector<int> number(sheet.vertex_slots(), -1);
  for (std::size_t v = 0; v < number.size(); ++v)
    if (sheet.triangle_of_vertex(VertexIndex(v)).valid()) {
      number[v] = to_int(shape.points.size());
      shape.points.push_back(back(sheet.rest(VertexIndex(v))));
    }
  for (std::size_t i = 0; i < sheet.triangle_slots(); ++i) {
    const TriangleIndex t(i);
    if (!sheet.triangle(t).alive()) continue;
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(t, k);
      const int a = number[sheet.origin(h)()], b = number[sheet.target(h)()];
      const Shape::Edge edge{std::min(a, b), std::max(a, b)};
      shape.apexes[edge].push_back(number[sheet.origin(Sheet::previous(h))()]);
      if (sheet.on_border(h)) shape.border.insert(edge);
      if (sheet.mark(h) == EdgeMark::incision) shape.opened.insert(edge);
    }
  }
  shape.pieces = count_pieces(sheet);
  shape.deformed = sheet.deformed_count();
  return shape;
}

inline std::vector<oracle::Segment> segments(const Shape& shape, const std::set<Shape::Edge>& edges) {
  const auto point = [&](int i) {
    const Point2 p = shape.points[to_size(i)];
    return oracle::Point{p.x, p.y};
  };
  std::vector<oracle::Segment> result;
  for (const auto& [a, b] : edges) result.push_back({point(a), point(b)});
  return result;
}

/// Empty where the two shapes have the same pieces, and the same incision and border as sets of points, however these
/// are divided into edges.
inline std::string different_cut(const Shape& a, const Shape& b, double tolerance) {
  if (a.pieces != b.pieces) return std::to_string(a.pieces) + " pieces, then " + std::to_string(b.pieces);
  for (auto edges : {&Shape::opened, &Shape::border}) {
    const std::string what = edges == &Shape::opened ? "incision" : "border";
    const oracle::SegmentSearch in_a(segments(a, a.*edges)), in_b(segments(b, b.*edges));
    for (const auto& [search, others] : {std::pair{&in_a, &in_b}, std::pair{&in_b, &in_a}})
      for (const oracle::Segment& s : others->segments())
        if (!search->covers(s, tolerance)) {
          char text[160];
          std::snprintf(text, sizeof text, " is missing {%.17g, %.17g} - {%.17g, %.17g} the %s time", s[0][0], s[0][1],
                        s[1][0], s[1][1], search == &in_a ? "first" : "second");
          return what + text;
        }
  }
  return {};
}

}  // namespace cutbench
