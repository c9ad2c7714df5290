#include "harness/study/robustness/cgal_check.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <map>
#include <memory>

#include "harness/base/conversions.h"
#include "harness/oracle/flatten.h"
#include "harness/oracle/sheet_topology.h"

namespace cutbench::oracle {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<int, Kernel>;  // its number
using PlainFaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel>;
enum class Side { unknown, outside, inside };
using FaceBase = CGAL::Triangulation_face_base_with_info_2<Side, Kernel, PlainFaceBase>;
using DataStructure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Delaunay = CGAL::Constrained_Delaunay_triangulation_2<Kernel, DataStructure, CGAL::Exact_predicates_tag>;
using Triangulation = CGAL::Constrained_triangulation_plus_2<Delaunay>;
using Vertex = Triangulation::Vertex_handle;
using Face = Triangulation::Face_handle;

Kernel::Point_2 to_cgal(const Point& p) { return {p[0], p[1]}; }
Point from_cgal(const Kernel::Point_2& p) { return {p.x(), p.y()}; }

/// Which constraints run along an edge.
struct Lines {
  int border = 0, older = 0, path = 0;
};

/// The whole plane round the sheet, triangulated.
class Plane {
 public:
  Plane(const Mesh& before, const std::vector<Segment>& path) {
    Face hint;
    for (const Point& p : before.rest) {
      vertices_.push_back(triangulation_.insert(to_cgal(p), hint));
      hint = vertices_.back()->face();
    }
    const Borders borders = oracle::borders(before, half_edges(before));
    for (int e : borders.single) insert(segment(before, e), &Lines::border);
    for (int e : borders.ambiguous) insert(segment(before, e), &Lines::border);
    for (const auto& lips : borders.lips) insert(segment(before, lips[0]), &Lines::older);
    for (const Segment& s : path) insert(s, &Lines::path);
    number_vertices();
    note_lines();
    find_inside();
  }

  /// The triangles inside the sheet, closed.
  Mesh inside() const {
    Mesh mesh;
    for (Vertex v : triangulation_.finite_vertex_handles()) mesh.rest.push_back(from_cgal(v->point()));
    for (Face f : triangulation_.finite_face_handles())
      if (f->info() == Side::inside)
        mesh.triangles.push_back({f->vertex(0)->info(), f->vertex(1)->info(), f->vertex(2)->info()});
    return mesh;
  }

  Lines lines(int a, int b) const {
    const auto found = lines_.find(std::minmax(a, b));
    return found == lines_.end() ? Lines{} : found->second;
  }

  /// For each vertex of inside(), the input's vertices there; in the input's order.
  std::vector<std::vector<int>> input_vertices() const {
    std::vector<std::vector<int>> result(triangulation_.number_of_vertices());
    for (int i = 0; i < to_int(vertices_.size()); ++i) result[vertices_[i]->info()].push_back(i);
    return result;
  }

  /// Segments of the path that are one edge and touch no other line: it would have a tip at each end and could not be
  /// opened.
  std::vector<Segment> slits() const {
    std::vector<int> degree(triangulation_.number_of_vertices(), 0);
    for (const auto& [edge, lines] : lines_) {
      ++degree[edge.first];
      ++degree[edge.second];
    }
    std::vector<Segment> result;
    for (const Constraint& c : constraints_) {
      const auto chain = triangulation_.vertices_in_constraint(c.id);
      if (c.kind == &Lines::path && std::distance(chain.begin(), chain.end()) == 2 &&
          degree[(*chain.begin())->info()] == 1 && degree[(*std::next(chain.begin()))->info()] == 1)
        result.push_back(c.asked);
    }
    return result;
  }

  double moved() const {
    double farthest = 0;
    for (const Constraint& c : constraints_)
      for (Vertex v : triangulation_.vertices_in_constraint(c.id))
        farthest = std::max(farthest, distance(from_cgal(v->point()), c.asked));
    return farthest;
  }

 private:
  struct Constraint {
    Triangulation::Constraint_id id;
    Segment asked;
    int Lines::*kind;
  };

  void insert(const Segment& s, int Lines::*kind) {
    const Triangulation::Constraint_id id = triangulation_.insert_constraint(to_cgal(s[0]), to_cgal(s[1]));
    if (id != Triangulation::Constraint_id(nullptr)) constraints_.push_back({id, s, kind});
  }

  void number_vertices() {
    int count = 0;
    for (Vertex v : triangulation_.finite_vertex_handles()) v->info() = count++;
  }

  void note_lines() {
    for (const Constraint& c : constraints_) {
      Vertex last;
      for (Vertex v : triangulation_.vertices_in_constraint(c.id)) {
        if (last != Vertex()) ++(lines_[std::minmax(last->info(), v->info())].*c.kind);
        last = v;
      }
    }
  }

  /// Walks in from infinity; where an odd number of border edges is crossed, the side changes.
  void find_inside() {
    for (Face f : triangulation_.all_face_handles()) f->info() = Side::unknown;
    std::vector<Face> open{triangulation_.infinite_face()};
    open.back()->info() = Side::outside;
    while (!open.empty()) {
      const Face f = open.back();
      open.pop_back();
      for (int i = 0; i < 3; ++i) {
        const Face other = f->neighbor(i);
        if (other->info() != Side::unknown) continue;
        other->info() = f->info();
        if (f->is_constrained(i) && lines(f->vertex((i + 1) % 3)->info(), f->vertex((i + 2) % 3)->info()).border % 2)
          other->info() = f->info() == Side::inside ? Side::outside : Side::inside;
        open.push_back(other);
      }
    }
  }

  Triangulation triangulation_;
  std::vector<Vertex> vertices_;  // the input's; equal for bit-equal points
  std::vector<Constraint> constraints_;
  std::map<std::pair<int, int>, Lines> lines_;
};

/// Opens a mesh along the half-edges without an opposite one: one vertex per fan of triangles. The input's vertices
/// keep their indices; new ones come behind them.
Mesh opened(const Mesh& closed, const std::vector<int>& opposite, const Mesh& before,
            const std::vector<std::vector<int>>& input_vertices) {
  Mesh mesh{before.rest, closed.triangles};
  std::vector<std::size_t> fans(closed.rest.size(), 0);
  std::vector<char> seen(opposite.size(), 0);
  for (int start = 0; start < to_int(opposite.size()); ++start) {
    if (seen[start]) continue;
    const int v = closed.triangles[start / 3][start % 3];
    const std::size_t fan = fans[v]++;
    int index = to_int(mesh.rest.size());
    if (fan < input_vertices[v].size())
      index = input_vertices[v][fan];
    else
      mesh.rest.push_back(closed.rest[v]);

    const auto visit = [&](int corner) {
      seen[corner] = 1;
      mesh.triangles[corner / 3][corner % 3] = index;
    };
    int e = start;
    do {
      visit(e);
      e = opposite[previous(e)];
    } while (e >= 0 && e != start);
    if (e == start) continue;
    for (e = opposite[start]; e >= 0; e = opposite[e]) {
      e = next(e);
      visit(e);
    }
  }
  return mesh;
}

/// The path with a point in the middle of each slit.
std::vector<Segment> halved(const std::vector<Segment>& path, const std::vector<Segment>& slits) {
  std::vector<Segment> result;
  for (const Segment& s : path) {
    const Point middle = between(s[0], s[1], 0.5);
    if (std::find(slits.begin(), slits.end(), s) == slits.end()) {
      result.push_back(s);
    } else {
      result.push_back({s[0], middle});
      result.push_back({middle, s[1]});
    }
  }
  return result;
}

}  // namespace

CrossCheckResult cgal_whole_sheet_cut(const Mesh& before, const Curve& curve, double flatten_tolerance) {
  std::vector<Segment> path;
  for (const PathSegment& s : flatten(curve, flatten_tolerance)) path.push_back(s.segment);
  if (path.empty()) return {before, false, {}, 0};
  try {
    auto plane = std::make_unique<Plane>(before, path);
    if (const std::vector<Segment> slits = plane->slits(); !slits.empty())
      plane = std::make_unique<Plane>(before, halved(path, slits));
    const Mesh closed = plane->inside();
    std::vector<int> opposite = half_edges(closed).opposite;
    bool opens = false;
    for (int e = 0; e < to_int(opposite.size()); ++e) {
      if (opposite[e] < 0) continue;
      const Lines lines = plane->lines(closed.triangles[e / 3][e % 3], closed.triangles[e / 3][next(e) % 3]);
      opens = opens || (lines.path && !lines.older && !lines.border);
      if (lines.path || lines.older || lines.border) opposite[e] = -1;
    }
    const double moved = plane->moved();
    if (!opens) return {before, false, {}, moved};
    return {opened(closed, opposite, before, plane->input_vertices()), false, {}, moved};
  } catch (const CGAL::Failure_exception& problem) {
    return {before, true, "CGAL: " + problem.expression() + " does not hold", 0};
  }
}

}  // namespace cutbench::oracle
