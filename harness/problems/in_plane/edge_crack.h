// A cut from the edge of a strip in tension: a finite plate, whose answer is a handbook's fit.
#pragma once

#include "harness/problems/common/problem.h"

namespace cutbench {

/// F of K1 = s sqrt(pi a) F, x = depth / width: sqrt(2/(pi x) tan(pi x/2)) (0.752 + 2.02 x + 0.37 (1 - sin(pi x/2))^3)
/// / cos(pi x/2), within 0.5 % for any x (Tada, Paris and Irwin, The Stress Analysis of Cracks Handbook).
double edge_crack_factor(double x);

/// At depths of 0.3, 0.4 and 0.5 of the width. energy_norm: the root of the energy that is missing, over that of the
/// cut strip; the fit's 1 percent of the released energy limits it, and a method that opens more than was asked for can
/// gain by it. opening: as of a window problem, against edge_crack_field(), which no fit limits. Members lie up to half
/// a cell beside the middle of the strip's height, that field in the middle. That changes the gape by 1e-7 of its norm
/// where a cell is 1/8 of the width, and by 4e-6 where it is the whole width, found with a field that is not its own
/// mirror image: the ends are two widths away, and what they do falls by a factor of 60 in each.
void append_edge_cracks(std::vector<std::unique_ptr<const Problem>>& problems);

}  // namespace cutbench
