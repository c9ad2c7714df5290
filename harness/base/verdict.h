// What became of a cut and of its result: the words of the column `verdict` (results/README.md).
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
  no_result        ///< a program ended well, but left no file that can be read
};

constexpr EnumNames<Verdict, 20> verdict_names{{{Verdict::ok, "ok"},
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
                                                {Verdict::no_result, "no_result"}}};

constexpr const char* name_of(Verdict verdict) { return name_of(verdict_names, verdict); }
inline std::ostream& operator<<(std::ostream& out, Verdict verdict) { return out << name_of(verdict); }

}  // namespace cutbench
