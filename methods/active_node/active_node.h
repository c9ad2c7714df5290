// The active node: after a Delaunay split of the whole path one node goes along it, and leaves a vertex of the path
// behind every `spacing` mean edges.
//
// How it works. adapt: where the path meets a straight part of the border close to a vertex of it, that vertex moves
// there (methods/tools/warp.h). embed: the Delaunay split of the path as it is asked for, which gives the blade's way
// through the sheet, its meetings with the border, older incisions and itself included. improve: the blade goes along
// that way once more, from crossing to crossing, and takes the active node with it:
//  - The node moves on to the next crossing, which is taken in (Sheet::collapse). Before a triangle round it would
//    turn over, an edge at the node is flipped; exact predicates decide that.
//  - A vertex of the sheet that the node comes nearer to than `near` is in the blade's way, and is taken in too.
//  - Edges round the node are flipped until they are Delaunay, border, incisions and path excepted
//    (harness/mesh/local_delaunay.h).
//  - At the distance `spacing` from the last vertex of the path the node is left behind as the next one, and the
//    following crossing is the active node. The distance is that of equal pieces up to the next vertex that must stay.
// The path opens at the end of the cut, by the harness, and not while the blade moves.
//
// Where the node does not go on, the crossing stays a vertex of the path, as the Delaunay split made it: at tips; at
// meetings with the border, an older incision or the path itself; at held vertices; where flips don't make room; and
// where the chord would leave the requested curve by more than 0.05 mean edges or the chord tolerance.
//
// Source: Nienhuys and van der Stappen, A Delaunay approach to interactive cutting in triangulated surfaces, 2004 (WAFR
// 2002); the text was not at hand, so this follows the authors' page and what others say of it. Differences known: the
// whole way is embedded before the node moves (there no points are inserted, a vertex moves with the blade), so that it
// moves from crossing to crossing; vertices in the way are removed at a distance of our choice; chords are held to a
// tolerance; the last pieces are no shorter than the others, which takes knowing where a cut ends.
// Promises: area, conforming. The incision error is at most the chord tolerance, since each step is checked against the
// requested curve (methods/tools/path_curve.h). Neither the exact path (chords of length h) nor that vertices stay.
// Where it fails: shapes have no bound. Where the path meets an older incision, or a corner of the border, beside a
// vertex of it, the sliver of the split stays, since neither may be moved. A curve of radius below some 2.5 mean edges,
// or a small chord tolerance, asks for shorter pieces than `spacing`. Removed vertices make the mesh coarser beside the
// path, and flips change the deformed surface where the sheet is bent.
#pragma once

#include <vector>

#include "harness/cut/cutting_method.h"
#include "harness/mesh/local_delaunay.h"
#include "methods/tools/path_curve.h"
#include "methods/tools/reshape.h"
#include "methods/tools/warp.h"

namespace cutbench {

class ActiveNode : public CuttingMethod {
 public:
  struct Options {
    double spacing = 1;  ///< between vertices of the path, mean rest edges; 0: every crossing stays
    double near =
        0.35;  ///< a vertex nearer to the node is taken in, mean rest edges; times `spacing` where that is < 1
    double tolerance = path_tolerance;  ///< of the chords (path_curve.h)
  };
  explicit ActiveNode(const Options& options)
      : options_(options),
        warp_({.reach = 0.35, .tolerance = options.tolerance, .border_only = true}),
        reshape_({.tolerance = options.tolerance}) {}

  void adapt(Sheet& sheet, Subdivision& trace, const Polyline& path) override;
  void embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) override;
  void improve(Sheet& sheet, MethodNotes&) override;

 private:
  bool is_as_traced(const Sheet& sheet) const;
  void measure_way();
  double next_target(std::size_t i, double from) const;
  bool advance(Sheet& sheet, VertexIndex node, VertexIndex to);
  bool slide(Sheet& sheet, std::size_t i, VertexIndex last, double to);
  VertexIndex leave_between(Sheet& sheet, VertexIndex last, VertexIndex next, double to);
  double parameter_at(double length) const;
  void make_room(Sheet& sheet, VertexIndex v, Point2 to, VertexIndex onto);
  void take_in_near(Sheet& sheet, VertexIndex node);
  void settle(Sheet& sheet, VertexIndex node);

  Options options_;
  Warp warp_;
  PathCurve curve_;
  Reshape reshape_;
  LocalDelaunay delaunay_;
  double spacing_ = 0, near_ = 0;    // rest units
  std::vector<double> node_length_;  // per node of the trace: of the way up to it, rest units
  std::vector<VertexIndex> way_;     // the crossings, in the blade's order
  std::vector<double> length_;       // of the way up to each, rest units
  std::vector<std::size_t> stop_;    // per crossing: the next at or after it that must stay
  std::vector<VertexIndex> ring_, near_vertices_;
  std::vector<TriangleIndex> turned_;  // by flips that made room
};

}  // namespace cutbench
