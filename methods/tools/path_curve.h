// The path as it was traced, remembered while its vertices are moved along it, merged or left out: how far may they go?
#pragma once

#include <vector>

#include "harness/mesh/stamped_table.h"
#include "harness/path/subdivision.h"

namespace cutbench {

/// A point of the curve is a number: i + f lies at fraction f between the trace's nodes i and i + 1. Keeps its working
/// storage from one cut to the next.
class PathCurve {
 public:
  /// Remembers the nodes of the trace. \pre nothing is moved or embedded yet.
  void read(const Subdivision& trace);
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
  double chord_tolerance() const { return chord_tolerance_; }  ///< of the trace
  /// Is all between two parameters one piece of the curve without ends, and within `tolerance` of the segment a b?
  bool stays_near(double from, double to, Point2 a, Point2 b, double tolerance) const;

 private:
  double chord_tolerance_ = 0;
  std::vector<Point2> points_;
  std::vector<std::uint8_t> goes_on_;  // from point i to the next, neither being a crossing of the path with itself
  std::vector<std::uint8_t> degree_;   // of each node
  StampedTable<VertexIndex, double> parameter_of_;
};

}  // namespace cutbench
