#include "harness/problems/out_of_plane/out_of_plane.h"

namespace cutbench {

void append_out_of_plane(std::vector<std::unique_ptr<const Problem>>& problems) {
  problems.push_back(bending_patch_slit());
  problems.push_back(slit_strip());
  problems.push_back(flap());
  problems.push_back(trouser_tear());
}

}  // namespace cutbench
