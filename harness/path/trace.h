// Where a path meets the rest mesh: the points that will become vertices, and the straight segments between them. Found
// before anything is changed, so that every method opens the same incision.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/mesh/sheet.h"
#include "harness/path/curve.h"
#include "harness/path/subdivision.h"
#include "harness/path/walk.h"

namespace cutbench {

/// Whether two pieces of the polyline that are no neighbours meet. Exact.
bool crosses_itself(const std::vector<Point2>& polyline);

/// Traces paths; keeps its working storage between them.
class Tracer {
 public:
  /// Traces the polyline from where `walk` stands, at its first point, in four steps:
  /// 1. The walk goes from event to event. Each passage through a triangle gets its start, its end and the points
  ///    between.
  /// 2. A point inside a triangle becomes a node where it is farther than `chord_tolerance` (rest units; infinity:
  ///    none) from the chord. Tips, kept points, and points that keep a loop or a U-turn from collapsing always become
  ///    nodes.
  /// 3. A curved path that leaves an older incision and comes back to it, never farther from it than `chord_tolerance`,
  ///    runs along it: there is nothing to cut (along_incision.cpp).
  /// 4. In triangles with several passages, crossings of the path with itself become nodes (self_crossings.cpp).
  /// The result stays valid until the next call. \pre the polyline has two points or more. Throws WalkLost.
  Subdivision& trace(const Sheet& sheet, const Polyline& path, Walk& walk, double chord_tolerance) {
    return trace(sheet, path, walk, chord_tolerance, true);
  }

 private:
  Subdivision& trace(const Sheet& sheet, const Polyline& path, Walk& walk, double chord_tolerance,
                     bool may_begin_elsewhere);
  /// One passage of the path through one triangle: the polyline's points between two nodes.
  struct TrianglePassage {
    int from, to;
    std::size_t first, count;             // of the polyline's points, counted on past its end
    bool simplified;                      // some of them did not become nodes
    std::array<std::size_t, 2> segments;  // of the subdivision, that it became: the first, past the last
    int next;                             // next passage of the same triangle
  };
  void take(const Step& step, std::size_t point, bool tip);
  void handle(const Step& step, std::size_t point, bool tip);
  void close_loop();
  void run_along(const Place& from, const Place& to, HalfEdge edge);
  void check_room(int face) const;
  int finish(int face, const Place& from, std::size_t first, std::size_t count, const Place& to);
  void choose(bool on_one_edge, const Place& from, std::size_t first, std::size_t count, const Place& to);
  void choose_by_chord(Point2 a, Point2 b, std::size_t first, std::size_t begin, std::size_t end);
  void choose_on_loop(Point2 start, std::size_t first, std::size_t count);
  bool any_chosen() const { return std::find(chosen_.begin(), chosen_.end(), 1) != chosen_.end(); }
  /// Points are counted on past the end of a closed path, twice round at most.
  std::size_t wrapped(std::size_t i) const {
    for (const std::size_t n = path_->points.size(); i >= n;) i -= n;
    return i;
  }
  Point2 point(std::size_t i) const { return path_->points[wrapped(i)]; }

  // along_incision.cpp
  struct Taken {
    Step step;
    std::size_t point;
    bool tip;
  };
  bool is_on_incision(const Place& place) const;
  bool runs_along_incision();
  bool find_chain(const Place& to, VertexIndex before, VertexIndex v);
  void flush();

  void note(Point2 p, const Place& at);
  const Place* found_before(Point2 p) const;
  bool is_free(const Place& place, bool goes_on) const;
  void split_lone_piece();
  int common_edge(TriangleIndex t, const Place& a, const Place& b) const;
  int edges_of(TriangleIndex t, const Place& place) const;

  // self_crossings.cpp
  int passages_of(int face) const;
  const TrianglePassage& passage(int i) const { return passages_[to_size(i)]; }
  bool is_simple(int face) const;
  void arrange(int face);
  bool chords_tell_the_truth(int face) const;
  std::vector<Point2> passage_points(const TrianglePassage& passage,
                                     bool all) const;  // not all: those that became nodes
  void restore_all_points(int face);
  bool is_clear(int face) const;
  void resolve_crossings(int face);
  std::vector<int> nodes_of(int face) const;

  Subdivision trace_;
  std::vector<TrianglePassage> passages_;
  std::vector<int> passages_of_face_;            // per face: its first passage
  std::vector<std::pair<Point2, Place>> found_;  // points of the path, and the edges and vertices they were found on
  const Sheet* sheet_ = nullptr;
  const Polyline* path_ = nullptr;
  double chord_tolerance_ = std::numeric_limits<double>::infinity();

  // Steps of a curved path since it left an incision at departure_, not handled yet; their points, and the points of
  // that incision.
  bool departed_ = false;
  Place departure_;
  std::vector<Taken> excursion_;
  std::vector<Point2> way_, chain_;

  // The passage under way: from a place, through the points [first_, first_ + count_) of the polyline.
  Place from_;
  int from_node_ = -1;  // once it has one
  std::size_t first_ = 0, count_ = 0;
  // A closed path that starts inside a triangle: its first passage, which ends at head_to_, is joined to the last one.
  bool loop_ = false, head_open_ = false;
  TriangleIndex head_face_;
  Place head_to_;
  std::size_t head_count_ = 0;
  TriangleIndex face_;                // that the path is in
  std::vector<std::uint8_t> chosen_;  // per point of the passage: becomes a node
  std::vector<Point2> all_points_, chosen_points_;
};

}  // namespace cutbench
