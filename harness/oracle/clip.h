// The part of a path that a sheet can have to do with.
#pragma once

#include <optional>
#include <vector>

#include "harness/oracle/plane.h"

namespace cutbench::oracle {

/// The part of the segment in the box `low` .. `high`; its new ends are off by the last place of their coordinates,
/// however far away the old ones were. Nothing: it misses the box, or touches it in one point.
std::optional<Segment> clip(const Segment& s, const Point& low, const Point& high);

/// The parts of a path no farther outside the mesh's bounding box than that is wide and high together. Farther away it
/// is nearest to nothing of the mesh, and too long to be walked along in steps.
std::vector<Segment> near_mesh(const std::vector<Segment>& path, const Mesh& mesh);

}  // namespace cutbench::oracle
