// One cut, or several in a row, carried out and measured: what `cutbench cut` reports and what every record holds.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "harness/cut/cut.h"
#include "harness/measure/forced_zones.h"
#include "harness/measure/oracle.h"
#include "harness/mesh/quality.h"

namespace cutbench {

/// Several curves cut one after the other. A failure ends it; what came before stays.
struct CutRun {
  Status status = Status::ok;
  std::string verdict = "ok", reason;
  std::size_t crossed_triangles = 0;
  int recovered_segments = 0;
  bool carefully = false;  ///< one of them, at least: see CutOutcome
  PhaseTimes time_us;
  double cpu_us = 0;  ///< process CPU time of the whole
};
CutRun cut_all(Sheet& sheet, Locator& locator, Cutter& cutter, std::span<const Curve> cuts, CuttingMethod& method,
               const CutOptions& options);

// The oracle knows none of our types.
oracle::Mesh for_oracle(const Sheet& sheet);
oracle::Curve for_oracle(const Curve& cut);

/// What the oracle is to hold a cut to, or several made one after the other.
/// \param improved  the method may have divided edges of the incision after embedding it
oracle::Request request_for(const Sheet& before, std::span<const Curve> cuts, const Promises& promises,
                            const CutOptions& options, bool improved);

/// What the result is like. Lengths in h = mean rest edge of the uncut sheet, unless a name says otherwise.
struct Assessment {
  oracle::Judgement judgement;
  bool measured = true;  ///< false: the result is too broken for the numbers below, which stay 0
  Quality all, cut;      ///< over the whole sheet, and over the triangles the cut made or changed; altitude in h
  std::size_t forced_corners = 0;
  int corner_triangles = 0, wedge_triangles = 0;
  double wedge_area = 0;               ///< rest units squared
  Quality strict, outside_wedges;      ///< over the cut's triangles without the exempted ones
  double ar_max_away_from_wedges = 0;  ///< of those, farther than 0.02 h from a wedge
  std::ptrdiff_t vertices_added = 0, deformed_vertices_added = 0, triangles_added = 0;
};
/// Measures a result; `judgement` (judge_one_by_one) is passed on. `forced`: forced_corners_of(before, cuts).
Assessment assess(const Sheet& before, const Sheet& after, const oracle::Judgement& judgement,
                  std::span<const oracle::ForcedCorner> forced);
/// Judges a result that anybody made, all of its cuts together, and measures it, broken as it may be: a triangle of the
/// cut is one whose corners, in their order round it, are not exactly those of a triangle before; rest vertices are
/// counted by their places. Whether the old vertices must stay what they are (`keeps_vertices`) is the caller's to say.
/// \throw InputError: the oracle can't use the sheet before.
Assessment assess_result(const Sheet& before, const MeshData& result, std::span<const Curve> cuts, bool keeps_vertices,
                         const CutOptions& options);
std::vector<oracle::ForcedCorner> forced_corners_of(const Sheet& before, std::span<const Curve> cuts);

}  // namespace cutbench
