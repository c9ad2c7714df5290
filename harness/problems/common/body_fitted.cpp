// Delaunay refinement (Ruppert 1995; Shewchuk 2002) as in CGAL's 2D mesh generator, with the sheet's border and the
// cuts as constraints; then smoothed. Not by CGAL's own Lloyd iterations: those go through the vertices in the order of
// their addresses, so that the last digits would depend on what else the process has done.
#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_mesh_face_base_2.h>
#include <CGAL/Delaunay_mesh_size_criteria_2.h>
#include <CGAL/Delaunay_mesh_vertex_base_2.h>
#include <CGAL/Delaunay_mesher_2.h>

#include <cmath>
#include <map>
#include <span>

#include "harness/base/conversions.h"
#include "harness/cut/open.h"
#include "harness/mesh/cgal_kernel.h"
#include "harness/mesh/predicates.h"
#include "harness/problems/common/problem.h"

namespace cutbench {

namespace {

using VertexBase = CGAL::Delaunay_mesh_vertex_base_2<Kernel>;
using FaceBase = CGAL::Delaunay_mesh_face_base_2<Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation = CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure, CGAL::Exact_predicates_tag>;
using Criteria = CGAL::Delaunay_mesh_size_criteria_2<Triangulation>;

using Chain = std::vector<Point2>;

/// How long edges may be: as long everywhere without tips; else like r^(3/4), r from the nearest tip, where stresses go
/// like r^(-1/2). Then all triangles have the same share of the error, and its energy norm falls like the size again.
struct Sizing {
  std::vector<Point2> tips;

  double at(Point2 p, double far) const {
    if (tips.empty()) return far;
    double r = 1e300;
    for (const Point2 tip : tips) r = std::min(r, std::sqrt(squared_length(p - tip)));
    const double least = std::max(1e-3 * far, far * (far / reach) * (far / reach) * (far / reach));
    return std::max(least, far * std::pow(std::min(1.0, r / reach), 0.75));
  }

 private:
  static constexpr double reach = 0.25;  // beyond it edges are as long as they may be
};

Point2 centre_of(const Triangulation::Face_handle& face) {
  const auto& a = face->vertex(0)->point();
  const auto &b = face->vertex(1)->point(), &c = face->vertex(2)->point();
  return {(a.x() + b.x() + c.x()) / 3, (a.y() + b.y() + c.y()) / 3};
}

/// As Criteria, with a size that depends on the place.
class GradedCriteria {
 public:
  using Face_handle = Triangulation::Face_handle;  // NOLINT(readability-identifier-naming): CGAL's name
  using Quality = Criteria::Quality;
  class Is_bad {  // NOLINT(readability-identifier-naming): CGAL's name
   public:
    Is_bad(const Sizing& sizing, double far) : sizing_(sizing), far_(far) {}
    CGAL::Mesh_2::Face_badness operator()(const Quality& quality) const { return rule(far_)(quality); }
    CGAL::Mesh_2::Face_badness operator()(const Face_handle& face, Quality& quality) const {
      return rule(sizing_.at(centre_of(face), far_))(face, quality);
    }

   private:
    static Criteria::Is_bad rule(double size) { return {0.125, size, Kernel()}; }
    const Sizing& sizing_;
    double far_;
  };
  GradedCriteria(const Sizing& sizing, double far) : sizing_(sizing), far_(far) {}
  Is_bad is_bad_object() const { return {sizing_, far_}; }

 private:
  const Sizing& sizing_;
  double far_;
};

/// The straight parts of the border, from corner to corner.
std::vector<Chain> border_of(const Sheet& sheet) {
  const auto direction = [&](HalfEdge h) { return sheet.rest(sheet.target(h)) - sheet.rest(sheet.origin(h)); };
  const auto next_on_border = [&](HalfEdge h) { return sheet.first_outgoing(sheet.target(h)); };
  const auto before_on_border = [&](HalfEdge h) {
    do h = Sheet::previous(h);
    while (!sheet.on_border(h) && (h = sheet.opposite(h), true));
    return h;
  };
  std::vector<Chain> sides;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    for (int k = 0; k < 3; ++k) {
      HalfEdge h = half_edge(TriangleIndex(t), k);
      if (!sheet.on_border(h) || cross(direction(before_on_border(h)), direction(h)) == 0) continue;
      const Point2 from = sheet.rest(sheet.origin(h));
      while (cross(direction(h), direction(next_on_border(h))) == 0) h = next_on_border(h);
      sides.push_back({from, sheet.rest(sheet.target(h))});
    }
  return sides;
}

/// The cuts, from corner to corner.
std::vector<Chain> cuts_of(const Specimen& specimen, double tolerance, double snap) {
  std::vector<Chain> chains;
  Polyline fine;
  for (const Curve& cut : specimen.cuts) {
    flatten(cut, tolerance, snap, fine);
    if (fine.closed) {
      fine.points.push_back(fine.points.front());
      fine.kept.push_back(1);
    }
    chains.push_back({fine.points.front()});
    for (std::size_t i = 1; i < fine.points.size(); ++i) {
      chains.back().push_back(fine.points[i]);
      if (fine.kept[i] && i + 1 < fine.points.size()) chains.push_back({fine.points[i]});
    }
  }
  return chains;
}

/// Ends both chains where they meet: a vertex of both, not one of each close to the other.
void end_where_they_meet(std::vector<Chain>& sides, std::vector<Chain>& cuts) {
  for (std::size_t c = 0; c < cuts.size(); ++c)
    for (std::size_t i = 0; i + 1 < cuts[c].size(); ++i)
      for (std::size_t k = 0; k < sides.size(); ++k) {
        const Point2 a = sides[k][0], along = sides[k][1] - a, p = cuts[c][i], step = cuts[c][i + 1] - p;
        const double det = cross(along, step);
        if (det == 0) continue;
        const double s = cross(p - a, step) / det, t = cross(p - a, along) / det;
        if (!(s > 0 && s < 1 && t > 0 && t < 1)) continue;
        const Point2 mouth = a + s * along;
        Chain rest(cuts[c].begin() + to_index(i), cuts[c].end());
        rest.front() = mouth;
        cuts[c].resize(i + 1);
        cuts[c].push_back(mouth);
        cuts.push_back(std::move(rest));
        sides.push_back({mouth, sides[k][1]});
        sides[k][1] = mouth;
      }
}

/// Ends two chains where they cross, at the segments from i and k on.
void end_at(Point2 p, std::size_t c, std::size_t i, std::size_t d, std::size_t k, std::vector<Chain>& chains) {
  for (const auto& [chain, segment] : {std::pair{c, i}, std::pair{d, k}}) {
    Chain rest(chains[chain].begin() + to_index(segment), chains[chain].end());
    rest.front() = p;
    chains[chain].resize(segment + 1);
    chains[chain].push_back(p);
    chains.push_back(std::move(rest));
  }
}

/// The same of cuts that cross each other.
void end_where_cuts_cross(std::vector<Chain>& cuts) {
  constexpr double apart = 1e-9;  // of a segment: one that ends on the other doesn't cross it
  for (std::size_t c = 0; c < cuts.size(); ++c)
    for (std::size_t d = c + 1; d < cuts.size(); ++d)
      for (std::size_t i = 0; i + 1 < cuts[c].size(); ++i)
        for (std::size_t k = 0; k + 1 < cuts[d].size(); ++k) {
          const Point2 a = cuts[c][i], along = cuts[c][i + 1] - a, p = cuts[d][k], step = cuts[d][k + 1] - p;
          const double det = cross(along, step);
          if (det == 0) continue;
          const double s = cross(p - a, step) / det, t = cross(p - a, along) / det;
          if (std::min(s, t) > apart && std::max(s, t) < 1 - apart) end_at(a + s * along, c, i, d, k, cuts);
        }
}

/// Divides a chain into pieces of equal length, about `step`.
void divide(const Chain& chain, double step, std::vector<std::array<Point2, 2>>& segments) {
  double length = 0;
  for (std::size_t i = 1; i < chain.size(); ++i) length += std::sqrt(squared_length(chain[i] - chain[i - 1]));
  step = length / std::max(1.0, std::round(length / step));
  double run = 0, wanted = step;
  Point2 last = chain.front();
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const double piece = std::sqrt(squared_length(chain[i] - chain[i - 1]));
    for (; wanted < length - step / 2 && wanted <= run + piece; wanted += step) {
      const Point2 p = chain[i - 1] + (wanted - run) / piece * (chain[i] - chain[i - 1]);
      segments.push_back({last, p});
      last = p;
    }
    run += piece;
  }
  segments.push_back({last, chain.back()});
}

/// The same with pieces as long as `sizing` says.
void divide(const Chain& chain, const Sizing& sizing, double far, std::vector<std::array<Point2, 2>>& segments) {
  std::vector<Point2> places{chain.front()};
  std::vector<double> pieces{0};  // up to each place
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const Point2 from = chain[i - 1], along = chain[i] - from;
    const double length = std::sqrt(squared_length(along));
    for (double run = 0; run < length;) {
      const double size = sizing.at(places.back(), far), next = std::min(length, run + size / 20);
      places.push_back(next < length ? from + next / length * along : chain[i]);
      pieces.push_back(pieces.back() + (next - run) / size);
      run = next;
    }
  }
  const double count = std::max(1.0, std::round(pieces.back()));
  Point2 last = chain.front();
  double wanted = 1;
  for (std::size_t i = 1; i + 1 < places.size(); ++i)
    if (wanted < count && pieces[i] / pieces.back() >= wanted / count) {
      segments.push_back({last, places[i]});
      last = places[i];
      ++wanted;
    }
  segments.push_back({last, chain.back()});
}

Triangulation mesh_of(const std::vector<std::array<Point2, 2>>& constraints, double size, const Sizing& sizing) {
  Triangulation mesh;
  for (const auto& [a, b] : constraints) mesh.insert_constraint(to_cgal(a), to_cgal(b));
  if (sizing.tips.empty())
    CGAL::refine_Delaunay_mesh_2(mesh, Criteria(0.125, size));
  else
    CGAL::refine_Delaunay_mesh_2(mesh, GradedCriteria(sizing, size));
  return mesh;
}

/// Where the triangles round a vertex want it: their circumcentres, weighted by their areas, over the fourth power of
/// the wanted size (Chen and Xu, Optimal Delaunay triangulations, J. Comput. Math. 22, 2004). The vertex stays where it
/// is on a constraint, and where that would turn one of its triangles over.
Kernel::Point_2 smoothed(const Triangulation& mesh, Triangulation::Vertex_handle vertex, const Sizing& sizing) {
  if (mesh.are_there_incident_constraints(vertex)) return vertex->point();
  Kernel::Vector_2 sum(0, 0);
  double area = 0;
  auto face = mesh.incident_faces(vertex), end = face;
  do {
    const double weight = mesh.triangle(face).area() * std::pow(sizing.at(centre_of(face), 1), -4);
    sum = sum + weight * (mesh.circumcenter(face) - CGAL::ORIGIN);
    area += weight;
  } while (++face != end);
  const Kernel::Point_2 place = CGAL::ORIGIN + sum / area;
  do {
    const int k = face->index(vertex);
    if (CGAL::orientation(face->vertex(face->ccw(k))->point(), face->vertex(face->cw(k))->point(), place) !=
        CGAL::LEFT_TURN)
      return vertex->point();
  } while (++face != end);
  return place;
}

Triangulation smoothed(const Triangulation& mesh, const Sizing& sizing) {
  Triangulation result;
  for (const auto& [face, k] : mesh.constrained_edges())
    result.insert_constraint(face->vertex(face->ccw(k))->point(), face->vertex(face->cw(k))->point());
  Triangulation::Face_handle near;
  for (const auto& vertex : mesh.finite_vertex_handles())
    if (!mesh.are_there_incident_constraints(vertex))
      near = result.insert(smoothed(mesh, vertex, sizing), near)->face();
  return result;
}

std::size_t triangles_in(const Triangulation& mesh) {
  std::size_t count = 0;
  for (const auto& face : mesh.finite_face_handles()) count += face->is_in_domain();
  return count;
}

/// The ends of cuts inside the sheet, a rectangle, and the corners in them.
std::vector<Point2> tips_of(const Specimen& specimen) {
  Point2 low = specimen.mesh.rest.front(), high = low;
  for (const Point2 p : specimen.mesh.rest) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  std::vector<Point2> tips;
  const auto add = [&](Point2 p) {
    if (p.x > low.x && p.x < high.x && p.y > low.y && p.y < high.y) tips.push_back(p);
  };
  for (const Curve& cut : specimen.cuts) {
    if (cut.closed) continue;
    if (cut.kind == Curve::Kind::polyline)
      for (const Point2 p : cut.points) add(p);
    else
      for (const Point2 p : {cut.points.front(), cut.points.back()}) add(p);
  }
  return tips;
}

Sheet fitted(const Specimen& specimen, const Sizing& sizing) {
  const Sheet uncut(specimen.mesh);
  const auto wanted = to_double(specimen.mesh.triangles.size());
  double area = 0;
  for (std::size_t t = 0; t < uncut.triangle_slots(); ++t) {
    const auto [a, b, c] = uncut.corners(TriangleIndex(t));
    area += cross(b - a, c - a) / 2;
  }
  const double edge = std::sqrt(4 / std::sqrt(3) * area / wanted);  // of as many equilateral triangles
  auto sides = border_of(uncut), cuts = cuts_of(specimen, 1e-3 * edge, uncut.snap());
  end_where_they_meet(sides, cuts);
  end_where_cuts_cross(cuts);
  const auto mesh_at = [&](double size) {
    std::vector<std::array<Point2, 2>> constraints;
    for (const auto* chains : {&sides, &cuts})
      for (const Chain& chain : *chains) {
        if (sizing.tips.empty())
          divide(chain, edge, constraints);
        else
          divide(chain, sizing, size / 1.2, constraints);
      }
    return mesh_of(constraints, size, sizing);
  };
  // The number goes with 1 / size^2, roughly: a few steps come as near as can be told beforehand.
  double size = 1.2 * edge, best_size = size, best = 1e300;
  for (int step = 0; step < 8; ++step) {
    const auto count = to_double(triangles_in(mesh_at(size)));
    if (std::abs(count - wanted) < best) {
      best = std::abs(count - wanted);
      best_size = size;
    }
    if (best <= 0.01 * wanted) break;
    size *= std::sqrt(count / wanted);
  }
  constexpr int rounds = 10;
  Triangulation mesh = mesh_at(best_size);
  for (int round = 0; round < rounds; ++round) mesh = smoothed(mesh, sizing);
  const std::span<const Kernel::Point_2> no_holes;
  CGAL::Delaunay_mesher_2<Triangulation, Criteria>::mark_facets(mesh, no_holes.begin(), no_holes.end());

  MeshData data;
  std::map<Triangulation::Vertex_handle, std::int32_t> number;
  std::vector<std::array<bool, 3>> cut;  // per triangle and edge
  for (const auto& face : mesh.finite_face_handles()) {
    if (!face->is_in_domain()) continue;
    auto& triangle = data.triangles.emplace_back();
    for (int k = 0; k < 3; ++k) {
      const auto [entry, fresh] = number.emplace(face->vertex(k), to_int32(data.rest.size()));
      if (fresh) data.rest.push_back({face->vertex(k)->point().x(), face->vertex(k)->point().y()});
      triangle[to_size(k)] = entry->second;
    }
    // CGAL's edge k is opposite corner k.
    cut.push_back({face->is_constrained(2), face->is_constrained(0), face->is_constrained(1)});
  }
  for (Point2 p : data.rest) data.deformed.push_back({p.x, p.y, 0});
  Sheet sheet(data);
  sheet.begin_cut();
  for (std::size_t t = 0; t < cut.size(); ++t)
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(TriangleIndex(t), k);
      if (cut[t][to_size(k)] && !sheet.on_border(h)) sheet.set_mark(h, EdgeMark::path);
    }
  open_path(sheet);
  sheet.begin_cut();
  return sheet;
}

}  // namespace

Sheet body_fitted(const Specimen& specimen) { return fitted(specimen, {}); }

Sheet graded_at_tips(const Specimen& specimen) { return fitted(specimen, {tips_of(specimen)}); }

}  // namespace cutbench
