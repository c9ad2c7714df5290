#include "harness/programs/adopt.h"

#include <algorithm>
#include <map>
#include <optional>

#include "harness/base/conversions.h"
#include "harness/cut/patch.h"
#include "harness/mesh/one_ring.h"
#include "harness/path/cut_failed.h"
#include "harness/path/walk.h"

namespace cutbench {

namespace {

using RestCorners = std::array<Point2, 3>;

bool is_before(Point2 a, Point2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); }

struct Earlier {
  bool operator()(Point2 a, Point2 b) const { return is_before(a, b); }
  bool operator()(const RestCorners& a, const RestCorners& b) const {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), is_before);
  }
};

RestCorners from_smallest(RestCorners c) {
  std::rotate(c.begin(), std::min_element(c.begin(), c.end(), is_before), c.end());
  return c;
}

std::size_t at(int corner) { return to_size(corner); }

class Adoption {
 public:
  Adoption(Sheet& sheet, const MeshData& result) : sheet_(sheet), after_(result), locator_(sheet) {}

  void run() {
    match_triangles();
    match_vertices();
    find_older_incisions();
    make_vertices();
    const std::vector<Sheet::NewTriangle> added = new_triangles();
    const std::vector<std::pair<VertexIndex, DeformedIndex>> left_out = vertices_left_out();
    if (!removed_.empty()) sheet_.replace_cavity(removed_, added);
    for (const auto& [v, d] : left_out) sheet_.drop_vertex(v, d);
    mark_path();
    // The oracle allows for points nearer than the snap distance, which the matching can't always tell apart.
    if (const auto faults = check(sheet_, false); !faults.empty())
      throw CutRefused("parts of the result lie too close together to be taken over (" + faults.front() + ")");
  }

  /// No triangle of the result is new.
  void delete_triangles() {
    match_triangles();
    for (const TriangleIndex t : kept_)
      if (!t.valid()) throw CutRefused("a program that deletes triangles makes no new ones; leave --deletes out");
    sheet_.remove(removed_);
    for (std::size_t t = 0; t < kept_.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const HalfEdge h = half_edge(TriangleIndex(t), k);
        if (after_.mark(h) != EdgeMark::incision) continue;
        const HalfEdge mine = same_side(kept_[t], after_.rest(after_.origin(h)));
        if (!sheet_.on_border(mine) && sheet_.mark(mine) == EdgeMark::none) sheet_.set_mark(mine, EdgeMark::path);
      }
  }

 private:
  /// The side of the sheet's triangle that begins there.
  HalfEdge same_side(TriangleIndex t, Point2 origin) const {
    int k = 0;
    while (k < 2 && !(sheet_.rest(sheet_.triangle(t).vertex[at(k)]) == origin)) ++k;
    return half_edge(t, k);
  }

  /// Which triangles stay: those whose corners are in both.
  void match_triangles() {
    std::map<RestCorners, TriangleIndex, Earlier> known;
    for (std::size_t t = 0; t < sheet_.triangle_slots(); ++t)
      if (sheet_.triangle(TriangleIndex(t)).alive())
        known.emplace(from_smallest(sheet_.corners(TriangleIndex(t))), TriangleIndex(t));
    kept_.resize(after_.triangle_slots());
    for (std::size_t t = 0; t < kept_.size(); ++t) {
      const auto found = known.find(from_smallest(after_.corners(TriangleIndex(t))));
      if (found == known.end()) continue;
      kept_[t] = found->second;
      known.erase(found);
    }
    place_in_removed_.assign(sheet_.triangle_slots(), -1);
    for (const auto& [corners, t] : known) {
      place_in_removed_[t()] = to_int(removed_.size());
      removed_.push_back(t);
    }
  }

  /// The sheet's vertex for each of the result's; invalid for new ones.
  void match_vertices() {
    vertex_.resize(after_.vertex_slots());
    for (std::size_t t = 0; t < kept_.size(); ++t) {
      if (!kept_[t].valid()) continue;
      for (const VertexIndex v : after_.triangle(TriangleIndex(t)).vertex)
        for (const VertexIndex w : sheet_.triangle(kept_[t]).vertex)
          if (sheet_.rest(w) == after_.rest(v)) vertex_[v()] = w;
    }
    std::map<Point2, std::vector<VertexIndex>, Earlier> at_place;
    for (std::size_t v = 0; v < sheet_.vertex_slots(); ++v)
      if (sheet_.triangle_of_vertex(VertexIndex(v)).valid())
        at_place[sheet_.rest(VertexIndex(v))].push_back(VertexIndex(v));
    for (std::size_t v = 0; v < vertex_.size(); ++v) {
      const auto found = at_place.find(after_.rest(VertexIndex(v)));
      if (vertex_[v].valid() || found == at_place.end()) continue;
      if (found->second.size() > 1)
        throw CutRefused("several vertices of the sheet that are no lips lie at one place; move them apart");
      vertex_[v] = found->second.front();
    }
  }

  /// The edges of the sheet under the result's edges that were open already, and the new vertices on them.
  void find_older_incisions() {
    std::vector<HalfEdge> older;
    for (const TriangleIndex t : removed_)
      for (int k = 0; k < 3; ++k)
        if (sheet_.mark(half_edge(t, k)) == EdgeMark::incision) older.push_back(half_edge(t, k));
    on_incision_.resize(vertex_.size());
    const double near2 = squared(meeting_tolerance * sheet_.snap());
    for (std::size_t t = 0; t < kept_.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const HalfEdge h = half_edge(TriangleIndex(t), k);
        if (kept_[t].valid() || after_.mark(h) != EdgeMark::incision) continue;
        const VertexIndex from = after_.origin(h), to = after_.target(h);
        const Point2 a = after_.rest(from), b = after_.rest(to);
        const auto under = std::find_if(older.begin(), older.end(), [&](HalfEdge o) {
          const Point2 p = sheet_.rest(sheet_.origin(o)), q = sheet_.rest(sheet_.target(o));
          return dot(b - a, q - p) > 0 && squared_distance(a, p, q) <= near2 && squared_distance(b, p, q) <= near2;
        });
        if (under == older.end()) continue;
        older_[h] = *under;
        for (const VertexIndex v : {from, to})
          if (!vertex_[v()].valid()) on_incision_[v()] = *under;
      }
  }

  void make_vertices() {
    Walk walk(sheet_, locator_);
    std::vector<std::pair<VertexIndex, TriangleIndex>> inside;
    for (std::size_t v = 0; v < vertex_.size(); ++v)
      if (!vertex_[v].valid() && !on_incision_[v].valid())
        inside.emplace_back(VertexIndex(v), triangle_that_holds(walk, after_.rest(VertexIndex(v))));
    centroid_in_.resize(kept_.size());
    for (std::size_t t = 0; t < kept_.size(); ++t) {
      const auto c = after_.corners(TriangleIndex(t));
      if (!kept_[t].valid()) centroid_in_[t] = triangle_that_holds(walk, 1.0 / 3 * (c[0] + c[1] + c[2]));
    }
    for (const auto& [v, t] : inside) vertex_[v()] = sheet_.new_vertex(t, after_.rest(v));
    for (std::size_t v = 0; v < vertex_.size(); ++v) {
      const HalfEdge h = on_incision_[v];
      if (vertex_[v].valid() || !h.valid()) continue;
      const Point2 p = after_.rest(VertexIndex(v)), a = sheet_.rest(sheet_.origin(h));
      const Point2 along = sheet_.rest(sheet_.target(h)) - a;
      vertex_[v] = sheet_.new_vertex(h, dot(p - a, along) / squared_length(along), p);
    }
  }

  /// The sheet's triangle on p's side of every incision.
  TriangleIndex triangle_that_holds(Walk& walk, Point2 p) const {
    const Place place = walk.locate(p);
    if (place.kind == Place::Kind::face) return place.face;
    if (place.kind == Place::Kind::edge) {
      const HalfEdge h = place.edge, o = sheet_.opposite(h);
      const bool left = orientation(sheet_.rest(sheet_.origin(h)), sheet_.rest(sheet_.target(h)), p) >= 0;
      return triangle_of(left || !o.valid() ? h : o);
    }
    if (place.kind == Place::Kind::outside) throw CutRefused("a vertex of the result lies outside the sheet");
    TriangleIndex holder = sheet_.triangle_of_vertex(place.vertex);
    for_each_outgoing(sheet_, place.vertex, [&](HalfEdge h) {
      const auto c = sheet_.corners(triangle_of(h));
      if (orientation(c[0], c[1], p) >= 0 && orientation(c[1], c[2], p) >= 0 && orientation(c[2], c[0], p) >= 0)
        holder = triangle_of(h);
    });
    return holder;
  }

  /// A triangle of the result has as parent the one that lies under it: at a corner they share they are on one side.
  std::vector<Sheet::NewTriangle> new_triangles() const {
    std::vector<Sheet::NewTriangle> added;
    for (std::size_t t = 0; t < kept_.size(); ++t) {
      if (kept_[t].valid()) continue;
      Sheet::NewTriangle& made = added.emplace_back();
      made.parent = place_in_removed_[centroid_in_[t]()];
      for (int k = 0; k < 3; ++k) {
        made.vertex[at(k)] = vertex_[after_.triangle(TriangleIndex(t)).vertex[at(k)]()];
        const auto under = older_.find(half_edge(TriangleIndex(t), k));
        if (under == older_.end()) continue;
        made.mark[at(k)] = EdgeMark::incision;
        made.parent = place_in_removed_[triangle_of(under->second)()];
      }
    }
    return added;
  }

  std::vector<std::pair<VertexIndex, DeformedIndex>> vertices_left_out() const {
    std::vector<char> used(sheet_.vertex_slots(), 0);
    for (const VertexIndex v : vertex_) used[v()] = 1;
    std::map<VertexIndex, DeformedIndex> left_out;
    for (const TriangleIndex t : removed_)
      for (std::size_t k = 0; k < 3; ++k) {
        const VertexIndex v = sheet_.triangle(t).vertex[k];
        const DeformedIndex d = sheet_.triangle(t).deformed[k];
        if (used[v()]) continue;
        if (sheet_.is_held(v)) throw CutRefused("a vertex that a pin or a load holds is gone; keep it where it is");
        if (left_out.emplace(v, d).first->second != d)
          throw CutRefused("a vertex of an older incision is gone; keep it where it is");
      }
    return {left_out.begin(), left_out.end()};
  }

  void mark_path() {
    for (std::size_t t = 0; t < kept_.size(); ++t)
      for (int k = 0; k < 3; ++k) {
        const HalfEdge h = half_edge(TriangleIndex(t), k);
        if (after_.mark(h) != EdgeMark::incision) continue;
        const HalfEdge mine = find_half_edge(sheet_, vertex_[after_.origin(h)()], vertex_[after_.target(h)()]);
        if (mine.valid() && sheet_.mark(mine) == EdgeMark::none) sheet_.set_mark(mine, EdgeMark::path);
      }
  }

  static double squared(double x) { return x * x; }

  Sheet& sheet_;
  const Sheet after_;  // welded
  const Locator locator_;
  std::vector<TriangleIndex> kept_;         // per triangle of the result: the sheet's, where it has it
  std::vector<TriangleIndex> removed_;      // of the sheet
  std::vector<int> place_in_removed_;       // per slot of the sheet, -1: it stays
  std::vector<VertexIndex> vertex_;         // per vertex of the result: the sheet's
  std::vector<HalfEdge> on_incision_;       // per vertex of the result, where it divides an older incision
  std::vector<TriangleIndex> centroid_in_;  // per triangle of the result that is new
  std::map<HalfEdge, HalfEdge> older_;      // from the result's half-edges to the sheet's
};

}  // namespace

void adopt(Sheet& sheet, const MeshData& result, bool deletes) {
  Adoption adoption(sheet, result);
  if (deletes)
    adoption.delete_triangles();
  else
    adoption.run();
}

}  // namespace cutbench
