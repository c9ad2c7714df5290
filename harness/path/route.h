// The way from one place of a sheet to the next over its seams: straight in every panel, and straight over a seam when
// the panels are laid against each other there. Where more than 360 degrees meet it may bend: it is a shortest way, at
// least among those near it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "harness/mesh/seams.h"
#include "harness/mesh/sheet.h"
#include "harness/path/curve.h"

namespace cutbench {

/// A place of the sheet.
struct PlaceAtRest {
  TriangleIndex triangle;
  Point2 point;  ///< in it
  Point3 in_space = {};
};

/// The seams of the sheet, to which it refers. Cost: the whole sheet, once; of a route the triangles that it could lead
/// through.
class Router {
 public:
  explicit Router(const Sheet& sheet);
  /// The polyline through the places, in a curve for each stretch between two seams: open, in their order, each ending
  /// on the border where the next begins. Without seams on the way it is one curve of these points, closed if `closed`.
  /// \param along  where given, gets the seams that the way would run along, where a cut opens nothing
  /// \throw InputError, beginning with `name` and the numbers of two places: they are on parts that nothing joins, and
  /// that don't lie beside each other at rest as in space; or the way runs along a seam, without `along`
  std::vector<Curve> route(const std::vector<PlaceAtRest>& places, bool closed, const std::string& name,
                           std::vector<HalfEdge>* along = nullptr) const;
  bool has_seams() const { return !edges_.empty(); }
  bool is_seam(HalfEdge h) const { return first_edge_[h()] >= 0; }

 private:
  /// A rotation or reflection of the plane, and a shift.
  struct Laying {
    Point2 x{1, 0}, y{0, 1}, shift{};
    Point2 operator()(Point2 p) const { return p.x * x + p.y * y + shift; }
    Laying after(const Laying& first) const;
  };
  /// A step from a triangle into its neighbour, through half-edges of both.
  struct Step {
    HalfEdge out, in;
    std::optional<std::size_t> seam = {};  ///< in edges_: of `out`
  };
  /// Where a way leaves a panel and enters the next one; without a seam: a point where it bends.
  struct Bend {
    Point2 leaves, enters;
    bool seam;
  };
  /// The part of both edges that a step leads through, as shares of them: at its right end, and at its left one.
  struct Gate {
    std::array<double, 2> out, in;
  };
  struct Portal {
    Step step;
    Gate gate;
    std::array<Point2, 2> ends;  ///< right and left of the way, in the strip's plane
    bool turned_over;            ///< the triangle that is left lies there on its back
  };
  struct Strip {
    std::vector<Step> way;
    std::vector<Portal> portals;
    Point2 begin, goal;
  };
  /// A bend of a way in a strip, at an end of a portal.
  struct Corner {
    std::size_t portal, side;
    Point2 point;
  };

  /// In mean edges: a way that arrives this near to its goal, by another chart's rounding, has arrived.
  static constexpr double arrived = 1e-6;

  Point2 at_share(HalfEdge h, double share) const;
  std::vector<Step> steps_out_of(TriangleIndex t) const;
  std::vector<Step> way(const PlaceAtRest& from, const PlaceAtRest& to) const;
  Laying across(const Step& step) const;
  std::optional<Step> over_seam(HalfEdge out, double share, Bend& bend) const;
  std::optional<std::vector<Bend>> straight(const PlaceAtRest& from, const PlaceAtRest& to,
                                            const std::vector<Step>& way) const;
  bool meets_seam(Point2 from, Point2 to) const;
  bool are_apart(const PlaceAtRest& from, const PlaceAtRest& to) const;
  std::pair<double, double> sides(std::size_t edge) const;
  std::vector<HalfEdge> seams_along(Point2 from, Point2 to) const;
  std::vector<HalfEdge> seams_along(const PlaceAtRest& from, const PlaceAtRest& to,
                                    const std::vector<Bend>& bends) const;

  // route_shortest.cpp
  Gate gate(const Step& step) const;
  Strip laid_flat(const PlaceAtRest& from, const PlaceAtRest& to, std::vector<Step> way) const;
  std::vector<Corner> shortest(const Strip& strip) const;
  static double length_of(const Strip& strip, const std::vector<Corner>& corners);
  std::optional<std::vector<Step>> past(const Strip& strip, const Corner& corner) const;
  Strip shortened(const PlaceAtRest& from, const PlaceAtRest& to, const std::vector<Step>& way) const;
  Strip narrowed(Strip strip) const;
  std::vector<Bend> shortest_way(const Strip& strip) const;

  bool lies_on(const std::vector<HalfEdge>& seams, const Point3& place) const;
  bool join(const PlaceAtRest& from, const PlaceAtRest& to, std::vector<Bend>& bends,
            std::vector<HalfEdge>* along) const;

  const Sheet& sheet_;
  std::vector<SewnEdge> edges_;
  std::vector<std::size_t> by_x_;                   // edges_, by where they begin in x
  double widest_ = 0;                               // of them in x
  std::vector<std::vector<std::size_t>> partners_;  // per edge: those that it shares more than a point with
  std::vector<std::size_t> part_;                   // per triangle slot
  std::vector<std::int32_t> first_edge_;            // per half-edge: the first of edges_ that it is; -1: none
};

}  // namespace cutbench
