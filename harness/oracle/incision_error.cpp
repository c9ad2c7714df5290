#include "harness/oracle/incision_error.h"

#include "harness/oracle/conversions.h"

namespace cutbench::oracle {
namespace {

/// Calls visit(point) along the segment, both ends included, at equal steps of at most `spacing`.
template <class Visit>
void sample(const Segment& s, double spacing, Visit visit) {
  const int steps = to_int(std::ceil(distance(s[0], s[1]) / spacing));
  for (int i = 0; i <= steps; ++i) visit(between(s[0], s[1], steps == 0 ? 0.0 : to_double(i) / steps));
}

}  // namespace

IncisionError incision_error(const std::vector<Segment>& asked, const SegmentSearch& path, const SegmentSearch& edges,
                             const std::vector<Segment>& added, const TriangleSearch& sheet, double spacing) {
  IncisionError error;
  for (const Segment& s : asked)
    sample(s, spacing, [&](const Point& p) {
      const double d = edges.distance(p);
      if (d > error.of_path && sheet.holds(p)) error.of_path = d;
    });
  for (const Segment& s : added)
    sample(s, spacing, [&](const Point& p) { error.of_edges = std::max(error.of_edges, path.distance(p)); });
  return error;
}

}  // namespace cutbench::oracle
