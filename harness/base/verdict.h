// What became of a cut, of its result, of steps and of an answer: the words of the column `verdict`
// (results/README.md).
#pragma once

#include <cstdint>
#include <ostream>

#include "harness/base/enum_names.h"

namespace cutbench {

/// From not_finite to incision the oracle's (harness/oracle/oracle.h); then those of the harness.
enum class Verdict : std::uint8_t {
  ok,
  not_finite,
  bad_index,
  inverted,
  non_manifold,
  unused_vertex,
  leak,
  area,
  moved_vertex,
  wrong_pieces,
  deletion,
  incision,
  rounded,         ///< rest positions of the result have lost digits
  changed,         ///< a cut that was not made has changed the sheet
  check,           ///< the sheet is not what its own check() wants
  not_reproduced,  ///< the same cuts, made once more, leave another sheet
  not_terminated,  ///< a loop that must end did not
  crashed,         ///< a program ended by a signal or with an exit code of its own
  timed_out,       ///< a program took too long
  no_result,       ///< a program ended well, but left no file that can be read
  refused,         ///< a cut in motion, or a scene, that was not made: why is known before
  failed,          ///< a cut in motion that the method could not make
  deviated,        ///< one that was made otherwise than asked, by a declared policy
  solver_stalled,  ///< the linear solver did not reach its tolerance, or a piece at rest is held nowhere
  newton_failed,   ///< Newton's method did not converge
  energy_growth,   ///< energy came from nowhere (harness/simulation/energy_budget.h)
  no_corner,       ///< a problem's sheet lacks the vertex that is measured
  not_severed      ///< a problem's strip hangs together after the cut
};

constexpr EnumNames<Verdict, 28> verdict_names{{{Verdict::ok, "ok"},
                                                {Verdict::not_finite, "not_finite"},
                                                {Verdict::bad_index, "bad_index"},
                                                {Verdict::inverted, "inverted"},
                                                {Verdict::non_manifold, "non_manifold"},
                                                {Verdict::unused_vertex, "unused_vertex"},
                                                {Verdict::leak, "leak"},
                                                {Verdict::area, "area"},
                                                {Verdict::moved_vertex, "moved_vertex"},
                                                {Verdict::wrong_pieces, "wrong_pieces"},
                                                {Verdict::deletion, "deletion"},
                                                {Verdict::incision, "incision"},
                                                {Verdict::rounded, "rounded"},
                                                {Verdict::changed, "changed"},
                                                {Verdict::check, "check"},
                                                {Verdict::not_reproduced, "not_reproduced"},
                                                {Verdict::not_terminated, "not_terminated"},
                                                {Verdict::crashed, "crashed"},
                                                {Verdict::timed_out, "timed_out"},
                                                {Verdict::no_result, "no_result"},
                                                {Verdict::refused, "refused"},
                                                {Verdict::failed, "failed"},
                                                {Verdict::deviated, "deviated"},
                                                {Verdict::solver_stalled, "solver_stalled"},
                                                {Verdict::newton_failed, "newton_failed"},
                                                {Verdict::energy_growth, "energy_growth"},
                                                {Verdict::no_corner, "no_corner"},
                                                {Verdict::not_severed, "not_severed"}}};

constexpr const char* name_of(Verdict verdict) { return name_of(verdict_names, verdict); }
inline std::ostream& operator<<(std::ostream& out, Verdict verdict) { return out << name_of(verdict); }

}  // namespace cutbench
