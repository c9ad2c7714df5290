// Translates a cut into the oracle's own types, and a method's promises into what the oracle holds the result to.
#pragma once

#include <span>
#include <vector>

#include "harness/cut/cut.h"
#include "harness/cut/method_row.h"
#include "harness/oracle/oracle.h"

namespace cutbench {

// The oracle knows none of the harness's types.
oracle::Mesh for_oracle(const Sheet& sheet);
oracle::Curve for_oracle(const Curve& cut);
std::vector<oracle::Curve> for_oracle(std::span<const Curve> cuts);

/// What the oracle holds a cut to, or several cuts made one after the other.
/// \param improved  the method may have divided edges of the incision after embedding it
oracle::Request request_for(const Sheet& before, std::span<const Curve> cuts, const Promises& promises,
                            const CutOptions& options, bool improved);

}  // namespace cutbench
