// Pieces of a sheet with seams, judged on the surface by the oracle (harness/oracle/surface.h).
#pragma once

#include <span>

#include "harness/cut/method_row.h"
#include "harness/judge/judgement.h"
#include "harness/mesh/sheet.h"
#include "harness/path/curve.h"

namespace cutbench {

/// By how many pieces a panel may rightly have fewer or more than expected, added up over what was judged.
struct Leeway {
  int fewer = 0, more = 0;
  void add(const Judgement& judgement);
};

/// Replaces the numbers of pieces, which the oracle has of each panel by itself, and finds `wrong_pieces`, and
/// `incision` where the path is to be opened exactly and is not where it crosses a seam; nothing where triangles are
/// taken out.
/// \param cuts  all that were made of `before`; it may not have any seam: then nothing is done
/// \pre the judgement found no fault that makes pieces unknown
void judge_on_surface(Judgement& judgement, const Sheet& before, std::span<const Curve> cuts, const oracle::Mesh& after,
                      const Promises& promises, const Leeway& leeway);

}  // namespace cutbench
