// The result of a cut, or of several in a row, measured: what `cutbench cut` reports and what every record holds.
#pragma once

#include <span>
#include <vector>

#include "harness/cut/cut.h"
#include "harness/cut/method_row.h"
#include "harness/judge/few_digits.h"
#include "harness/judge/findings.h"
#include "harness/mesh/quality.h"
#include "harness/oracle/forced_zones.h"
#include "harness/oracle/oracle.h"

namespace cutbench {

/// What the result is like. Lengths in h = mean rest edge of the uncut sheet, unless a name says otherwise.
struct Assessment {
  Judgement judgement;
  std::vector<Finding> findings;  ///< of a wrong result, by assess_result()
  bool connected = true;  ///< false: the triangles fit together so badly that pieces and incision error are unknown
  bool measured = true;   ///< false: the result is too broken for the numbers below, which stay 0
  FewDigits read;         ///< of assess_result(): how the coordinates were read
  Quality all, cut;       ///< over the whole sheet, and over the triangles the cut made or changed; altitude in h
  std::size_t forced_corners = 0;
  int corner_triangles = 0, wedge_triangles = 0;
  double wedge_area = 0;               ///< rest units squared
  Quality strict, outside_wedges;      ///< over the cut's triangles without the exempted ones
  double ar_max_away_from_wedges = 0;  ///< of those, farther than 0.02 h from a wedge
  std::ptrdiff_t vertices_added = 0, deformed_vertices_added = 0, triangles_added = 0;
};
/// Measures a result; `judgement` (judge_one_by_one) is passed on. `forced`: forced_corners_of(before, cuts).
Assessment assess(const Sheet& before, const Sheet& after, const Judgement& judgement,
                  std::span<const oracle::ForcedCorner> forced);
/// Judges a result that anybody made, all of its cuts together, and measures it, broken as it may be: a triangle of the
/// cut is one whose corners, in their order round it, are not exactly those of a triangle before; rest vertices are
/// counted by their places. What the result has to keep is the caller's to say (`asked`). Beside the oracle's verdicts
/// there is `rounded`: rest positions have lost digits (findings.h).
/// \param digits  significant digits that the result was written with (few_digits.h): vertices of the sheet are put
///   back, and the others judged with that much room (oracle::Request::rounding). 0: strictly.
/// \throw InputError: the oracle can't use the sheet before, or so few digits can't tell its vertices apart.
Assessment assess_result(const Sheet& before, const MeshData& result, std::span<const Curve> cuts,
                         const Promises& asked, const CutOptions& options, int digits = 0);
/// The judgement and the findings of assess_result(), without the measures.
Assessment judge_result(const Sheet& before, const MeshData& result, std::span<const Curve> cuts, const Promises& asked,
                        const CutOptions& options);
/// Of everybody: the path is opened, and the area stays. Vertices may move.
constexpr Promises promises_of_everybody{.exact_incision = true, .keeps_area = true};
std::vector<oracle::ForcedCorner> forced_corners_of(const Sheet& before, std::span<const Curve> cuts);

}  // namespace cutbench
