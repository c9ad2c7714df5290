// CGAL's Epick kernel: filtered floating point, exact where the filter can't tell. It takes seconds to parse; who wants
// decisions alone includes predicates.h. Needs CGAL_ALWAYS_ROUND_TO_NEAREST, which the interface target `cutbench_cgal`
// defines.
#pragma once

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include "harness/mesh/types.h"

namespace cutbench {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

inline Kernel::Point_2 to_cgal(Point2 p) { return {p.x, p.y}; }

}  // namespace cutbench
