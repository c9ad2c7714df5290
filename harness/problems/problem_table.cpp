#include <algorithm>

#include "harness/base/errors.h"
#include "harness/problems/common/problem.h"
#include "harness/problems/in_motion/free_strip.h"
#include "harness/problems/in_motion/hanging_sheet.h"
#include "harness/problems/in_motion/severed_strip.h"
#include "harness/problems/in_plane/edge_crack.h"
#include "harness/problems/in_plane/window_problem.h"
#include "harness/problems/out_of_plane/bending_patch_slit.h"
#include "harness/problems/out_of_plane/bent_plate.h"
#include "harness/problems/out_of_plane/flap.h"
#include "harness/problems/out_of_plane/slit_strip.h"
#include "harness/problems/out_of_plane/trouser_tear.h"

namespace cutbench {

/// The table: a problem, or a family of them, is its own file and a row here.
const std::vector<std::unique_ptr<const Problem>>& all_problems() {
  static const auto problems = [] {
    std::vector<std::unique_ptr<const Problem>> all;
    append_window_problems(all);
    append_edge_cracks(all);
    all.push_back(std::make_unique<BendingPatchSlit>());
    all.push_back(std::make_unique<SlitStrip>());
    all.push_back(std::make_unique<Flap>());
    all.push_back(std::make_unique<TrouserTear>());
    all.push_back(std::make_unique<BentPlate>(BentPlate::Cut::hole));
    all.push_back(std::make_unique<BentPlate>(BentPlate::Cut::crack));
    all.push_back(free_strip());
    all.push_back(severed_strip(Integrator::midpoint));
    all.push_back(severed_strip(Integrator::backward_euler));
    all.push_back(hanging_sheet(Integrator::midpoint));
    all.push_back(hanging_sheet(Integrator::backward_euler));
    return all;
  }();
  return problems;
}

const Problem& find_problem(const std::string& name) {
  const auto& all = all_problems();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& problem) { return problem->name() == name; });
  if (found != all.end()) return **found;
  std::string known;
  for (const auto& problem : all) known += (known.empty() ? "" : ", ") + problem->name();
  throw InputError("unknown problem \"" + name + "\"; known are " + known);
}

}  // namespace cutbench
