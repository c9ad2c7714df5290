// The requested path, kept while vertices of the incision are moved along it, merged or removed: how far may they go?
#pragma once

#include <cmath>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/mesh/stamped_table.h"
#include "harness/path/curve.h"
#include "harness/path/subdivision.h"

namespace cutbench {

/// How far the edges of the path may leave the curve where a method leaves out vertices or moves them, mean rest edges:
/// the default of every such method; the chord tolerance where that is smaller.
constexpr double path_tolerance = 0.05;

/// A point of the curve is given by a parameter: i is node i of the trace, i + f lies between the nodes i and i + 1, at
/// the fraction f of the curve's length there. Where a Bezier is cut with a finite chord tolerance, the curve between
/// two nodes is the flattened Bezier, whose points the trace left out; otherwise it is the straight segment. So all
/// deviations, of the trace and of later changes, are measured from one curve and do not add up. Keeps its working
/// storage from one cut to the next.
class PathCurve {
 public:
  /// \pre `trace` is that of `path` in the sheet; nothing is moved or embedded yet.
  void read(const Sheet& sheet, const Subdivision& trace, const Polyline& path);
  /// Learns which vertices of the sheet lie where. \pre `trace` is the one read or what a PathGraph made of it, its
  /// nodes being points of the one read, and is embedded.
  void find_vertices(const Sheet& sheet, const Subdivision& trace);

  /// Where v lies; negative where it is not a vertex of the path, or one that must stay.
  double parameter(VertexIndex v) const { return v() < parameter_of_.size() ? parameter_of_.get(v, -1) : -1; }
  /// v is a new vertex of the path.
  void add(VertexIndex v, double s) {
    if (parameter_of_.size() <= v()) parameter_of_.grow(2 * v());
    parameter_of_.set(v, s);
  }
  void set_parameter(VertexIndex v, double s) { parameter_of_.at(v) = s; }
  Point2 at(double s) const;
  /// Whether the path's edge between vertices of these parameters stands for the piece between them. It does not where
  /// a parameter is unknown, or where the edge closes a closed path, from its last node to its first: then all of the
  /// path lies between them.
  bool is_piece(double from, double to) const {
    return from >= 0 && to >= 0 && !(closed_ && 2 * std::abs(to - from) > to_double(points_.size()));
  }
  double chord_tolerance() const { return chord_tolerance_; }  ///< of the trace, rest units; infinity: none
  /// Whether all between two parameters is one piece of the curve, without ends or crossings of the path with itself,
  /// and may be replaced by the segment a b: the trace's nodes there lie within `tolerance` of it (rest units), and the
  /// other points of the curve within the larger of `tolerance` and the chord tolerance.
  bool stays_near(double from, double to, Point2 a, Point2 b, double tolerance) const;
  /// Whether v, on the path between its neighbours, may be left out: the segment between these, at a and b, stays near.
  bool may_leave_out(VertexIndex before, VertexIndex v, VertexIndex after, Point2 a, Point2 b, double tolerance) const {
    const double from = parameter(before), s = parameter(v), to = parameter(after);
    return s >= 0 && (s - from) * (to - s) > 0 && stays_near(from, to, a, b, tolerance);
  }
  /// Whether the path's edge a b may be divided at the curve's point halfway between the ends' parameters.
  bool may_divide(double from, double to, Point2 a, Point2 b, double tolerance) const;
  /// The same for a piece between the nodes `from` and `to` that may end at a crossing of the path with itself. Where
  /// the points that the trace left out there are not known, the answer is true if there can be none.
  bool stays_near_between_nodes(int from, int to, Point2 a, Point2 b, double tolerance) const;
  /// Whether the trace may have left out points: a Bezier with a finite chord tolerance.
  bool is_simplified() const { return simplified_; }

 private:
  struct LeftOut {
    double s;
    Point2 point;
  };
  void locate_nodes(const Polyline& path, double snap);
  void add_left_out(std::size_t node, const Polyline& path);
  bool is_within(double from, double to, Point2 a, Point2 b, double tolerance) const;
  std::size_t first_behind(double s) const;

  double chord_tolerance_ = 0;
  bool simplified_ = false, closed_ = false;
  std::vector<Point2> points_;          // of the nodes
  std::vector<LeftOut> left_out_;       // in ascending order of s
  std::vector<std::uint8_t> is_known_;  // node i is joined to node i + 1, and what the trace left out there is known
  std::vector<std::uint8_t> goes_on_;   // and neither is a crossing of the path with itself
  std::vector<std::uint8_t> degree_;    // of each node
  std::vector<double> place_;  // of each node on the polyline: k + f lies between its points k and k + 1; or -1
  StampedTable<VertexIndex, double> parameter_of_;
};

}  // namespace cutbench
