// Walking a polyline through the rest triangles, from event to event: through an edge, through a vertex, along an edge,
// out of the sheet and back into it, and arriving at each corner of the polyline.
//
// Decisions are exact signs on stored doubles. A straight piece of the path goes through every vertex within
// `line_tolerance` of it. A corner of the path lies on a vertex within `point_tolerance`, else on an edge within
// `line_tolerance`: of several edges, on the border or an incision first (harness/mesh/tolerances.h). So every crossing
// that is left is clear of the ends of its edge, and its rounded position cannot fall behind them.
#pragma once

#include <initializer_list>

#include "harness/mesh/locator.h"
#include "harness/mesh/sheet.h"
#include "harness/path/curve.h"
#include "harness/path/cut_failed.h"

namespace cutbench {

/// Where a point of the path is. The member that the kind names is valid.
struct Place {
  enum class Kind : std::uint8_t { outside, vertex, edge, face };
  Kind kind = Kind::outside;
  VertexIndex vertex;
  HalfEdge edge;  ///< either of the edge's two
  TriangleIndex face;
  Point2 point;       ///< rest position, rounded; the vertex's own where the place is one
  double lambda = 0;  ///< on an edge: fraction from the origin of `edge`
};

/// On one edge, where the nodes of a path join, or at one vertex; elsewhere in the same point.
bool are_together(const Sheet& sheet, const Place& a, const Place& b);

inline Place place_in(TriangleIndex t, Point2 p) {
  Place place;
  place.kind = Place::Kind::face;
  place.face = t;
  place.point = p;
  return place;
}

inline Place place_at(const Sheet& sheet, VertexIndex v) {
  Place place;
  place.kind = Place::Kind::vertex;
  place.vertex = v;
  place.point = sheet.rest(v);
  return place;
}

/// What lies between two places of a walk.
struct Passage {
  enum class Kind : std::uint8_t { nothing, outside, face, along };
  Kind kind = Kind::nothing;
  TriangleIndex face;  ///< whose interior was crossed
  HalfEdge edge;       ///< that the path ran along
};

inline Passage through_face(TriangleIndex t) { return {Passage::Kind::face, t, {}}; }
inline Passage along_edge(HalfEdge h) { return {Passage::Kind::along, {}, h}; }

struct Step {
  Passage passage;
  Place place;
  bool arrived = false;  ///< at the target; else the walk goes on from `place`
};

/// A walk that can't go on: the coordinates are too close together for doubles (or the mesh is broken).
struct WalkLost : TooClose {
  WalkLost()
      : TooClose("the path can't be followed through the mesh: points of it, or older cuts, are too close together") {}
};

/// The point that divides a b as `from_a` to `from_b`, reckoned from the nearer end: that rounds less, and alike
/// whichever of the two comes first. Sets lambda, the fraction from a.
Point2 divide(Point2 a, Point2 b, double from_a, double from_b, double& lambda);

class Walk {
 public:
  Walk(const Sheet& sheet, const Locator& locator) : sheet_(sheet), locator_(locator), snap_(sheet.snap()) {}

  /// The place of p; the walk then stands there. Outside, where no triangle holds it.
  Place locate(Point2 p);
  const Place& place() const { return at_; }
  /// The next event on the straight way to `target`. \pre the target differs from the last one arrived at.
  /// \param before  the edge or vertex where the path found the target before, if it did: of several that are as near
  /// it is that one again, if need be by a last step through a triangle. The same for all steps to the target.
  Step advance(Point2 target, const Place* before = nullptr);

 private:
  struct Side {
    double distance;  // (twice the area)
    int sign;         // 0 within twice the snap distance of the line
  };
  Point2 rest(VertexIndex v) const { return sheet_.rest(v); }
  Side side(Point2 a, Point2 b, Point2 p) const;
  bool near(Point2 a, Point2 b) const { return within(a, b, snap_); }
  bool is_at(VertexIndex v, Point2 target) const {
    return near(rest(v), target) || (before_ && before_->kind == Place::Kind::vertex && before_->vertex == v);
  }
  /// Of edges as near to the target the one to be on.
  bool attracts(HalfEdge h) const {
    return sheet_.separates(h) || (before_ && before_->kind == Place::Kind::edge &&
                                   (before_->edge == h || before_->edge == sheet_.opposite(h)));
  }
  bool ahead(Point2 p, Point2 target) const { return dot(p - origin_, target - origin_) > 0; }

  // walk.cpp: the way
  Step go_on(Point2 target);
  Step from_face(TriangleIndex t, Point2 target);
  Step from_vertex(VertexIndex v, Point2 target);
  Step from_edge(Place at, Point2 target);
  Step from_outside(Point2 target);
  Step through(HalfEdge entry, double left, double right, Point2 target);
  Step leave(HalfEdge exit, double right, double left, Passage passage);
  Step leave_at_origin(HalfEdge exit);
  Step pass_vertex(Passage passage, VertexIndex v, Point2 target);
  Step along(HalfEdge h, VertexIndex end, Point2 target);
  Step reach(Passage passage, Place place);
  bool is_behind(Point2 p, Point2 target) const;
  TriangleIndex common_triangle(const Place& a, const Place& b) const;
  bool touches(TriangleIndex t, const Place& b) const;

  // walk_arrival.cpp: its end
  Step arrive(TriangleIndex t, Point2 target);
  Step arrive_behind(HalfEdge third, Point2 target);
  Step arrive_on(Passage passage, HalfEdge h, Point2 target);
  Step arrive_beyond(HalfEdge entry, Point2 target);
  bool lies_on(HalfEdge h, Point2 p) const;
  bool is_detour(VertexIndex v, Point2 target) const;
  HalfEdge way_to_better(std::initializer_list<HalfEdge> exits, Point2 p, bool edges_too) const;
  HalfEdge shortest_way(std::initializer_list<HalfEdge> exits, Point2 p, bool to_edge) const;
  Place place_on(HalfEdge h, Point2 p) const;
  Place classify(TriangleIndex t, Point2 p) const;

  const Sheet& sheet_;
  const Locator& locator_;
  double snap_;
  Place at_;
  Point2 origin_;  // of the straight line to the target
  // After an edge was crossed the line goes on through half-edge entry_ (none: it has left the sheet), whose origin and
  // target lie to its left and right by:
  bool crossing_ = false;
  HalfEdge entry_;
  double left_ = 0, right_ = 0;
  double outside_from_ = 0;  // fraction of the line at which it left the sheet
  const Place* before_ = nullptr;
  TriangleIndex joining_;  // through which the walk goes on from where it arrived to *before_
  HalfEdge beyond_;        // that the target was found on, and the walk goes on through to a better place
};

}  // namespace cutbench
