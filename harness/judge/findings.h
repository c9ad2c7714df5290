// What a wrong result is wrong with: the cause behind the oracle's verdict, where it is, and how to mend it. The oracle
// says that something is wrong; this says what the author of another program has to look at.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "harness/judge/judgement.h"
#include "harness/oracle/oracle.h"

namespace cutbench {

struct Finding {
  std::string cause;  ///< a name of the list below
  std::string text;   ///< what is wrong and where, one line; vertices and triangles of the result are counted from 0
  std::string mend;   ///< what to do, one line
  std::optional<oracle::Point> place = {};  ///< rest position
  int cut = 0;                              ///< number of the cut nearest to the place, from 1; 0: no place
};

/// The causes that are told apart, the first that is found first:
///   rounded         rest positions have lost digits: single precision, or a few decimals; read with few digits
///                   (oracle::Request::rounding), a triangle that is too thin for them
///   moved_apart     pieces are whole, but not where they were at rest: moved apart or turned
///   other_rest      hardly a vertex of the sheet is where it was: no rest positions (`vt`), or another sheet
///   moved_vertex    a vertex of the sheet is not where it was, though asked to stay (keeps_vertices)
///   flipped         a triangle's corners run clockwise, or those of a piece, or those of all
///   folded          a triangle is turned over or flat, because a corner of it has moved
///   lips_differ     the two lips of an incision are nearly, but not bit for bit, at one place
///   t_junction      an edge is divided on one side only
///   lost_triangle   a part of the sheet has no triangle any more
///   doubled         triangles on one side of the path have copies of a vertex each, or a copy has no triangle
///   one_vertex      two fans of triangles share a vertex where the path parts them
///   shifted         the incision lies beside the path
///   not_opened      the path is not open where it should be
///   extra_pieces    something is parted that the path does not part
///   lost_loop       what a closed path cuts out is not there
///   pieces          another number of pieces than the path makes, for none of these reasons
///   other           none of these; the text is the oracle's
/// Empty where the result is right. \param judgement  of `after` by `request`
std::vector<Finding> find_causes(const oracle::Request& request, const oracle::Mesh& after, const Judgement& judgement);

}  // namespace cutbench
