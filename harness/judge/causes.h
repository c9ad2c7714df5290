// The causes behind a verdict (findings.h) and what they are found in. findings.cpp has those that vertices and
// triangles show, causes_at_edges.cpp those at border edges and along the path, causes_in_pieces.cpp those that pieces
// show.
#pragma once

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/judge/findings.h"
#include "harness/oracle/exact.h"
#include "harness/oracle/search.h"
#include "harness/oracle/sheet_topology.h"

namespace cutbench::causes {

using oracle::area, oracle::between, oracle::bow_ties, oracle::distance, oracle::dot, oracle::minus, oracle::next;
using oracle::Mesh;
using oracle::orientation, oracle::segment;
using oracle::Point;
using oracle::Segment;

std::string number(double x, const char* format = "%.10g");
std::string at(const Point& p);

class Causes {
 public:
  Causes(const oracle::Request& request, const Mesh& after, const Judgement& judgement)
      : request_(request), before_(request.before), after_(after), judgement_(judgement) {}

  std::vector<Finding> find();

 private:
  template <class Try>
  void look_at_borders(Try try_one);
  void compare_places();

  std::optional<Finding> rounded() const;
  std::string digits_mend(double off) const;
  std::optional<Finding> moved_apart() const;
  std::optional<Finding> other_rest() const;
  std::optional<Finding> moved_vertex() const;
  Point centre(int t) const;
  std::string name(int t) const;
  std::optional<Finding> flipped() const;
  /// A piece all of whose triangles run clockwise, or all of them.
  std::optional<Finding> clockwise_piece() const;
  /// So thin that few digits may have turned it over.
  bool is_lost_in_rounding(int t) const;
  /// A neighbour has an edge in the same direction, or all of its edges are alone.
  bool runs_against_neighbours(int t) const;

  int from(int e) const { return after_.triangles[e / 3][to_size(e % 3)]; }
  int to(int e) const { return from(next(e)); }
  std::optional<Finding> lips_differ() const;
  std::optional<Finding> t_junction() const;
  std::optional<Finding> lost_triangle() const;
  std::optional<Finding> unused_copy() const;
  std::optional<Finding> doubled() const;
  std::optional<Finding> one_vertex() const;
  std::vector<Segment> path_of(std::size_t cut) const;
  std::vector<Segment> whole_path() const;
  double allowed() const;
  /// The point of the segments, where `counts`, that is farthest from the others.
  template <class Counts>
  std::pair<double, Point> farthest(const std::vector<Segment>& segments, const oracle::SegmentSearch& others,
                                    Counts counts) const;
  std::vector<Segment> older() const;
  std::optional<Finding> beside_path() const;
  /// Of the places of the path inside the sheet, the one farthest from an open edge, and how far it is.
  std::pair<double, Point> farthest_from_open() const;
  std::optional<Finding> not_opened() const;
  /// The inner edge between two border vertices that lies nearest to the path for its length; -1: none.
  int closed_edge() const;

  /// The vertices of the sheet that a piece has, by their numbers.
  struct Moved {
    std::vector<int> old;      // vertices
    Point by{};                // what most of them are moved by
    std::size_t away = 0;      // of old: not where they were
    std::size_t together = 0;  // of old: moved by this
  };
  std::vector<Moved> moves_of_pieces(const std::vector<int>& piece) const;
  struct Piece {
    double area = 0;
    int largest = 0;  // triangle
    double largest_area = -1;
  };
  std::vector<Piece> all_pieces(const std::vector<int>& piece) const;
  double area_of(int t) const;
  /// The smallest pieces, where there is another number of them than the path makes.
  std::optional<Finding> pieces(const char* cause, const char* mend) const;
  std::optional<Finding> extra_pieces() const;
  /// The smallest closed cut whose middle lies in a piece much larger than what it cuts out.
  std::optional<Finding> lost_loop() const;
  bool holds(int t, const Point& p) const;

  Finding other() const;
  std::vector<Finding> with_cuts(std::vector<Finding> all) const;

  const oracle::Request& request_;
  const Mesh &before_, &after_;
  const Judgement& judgement_;
  oracle::HalfEdges before_edges_, edges_;
  oracle::Borders borders_;
  double h_ = 0;
  std::size_t places_before_ = 0;
  std::vector<Point> gone_, new_;  // places of the sheet that the result lacks, and those that only it has
  std::vector<int> loose_;         // border half-edges of the result that are neither on the outline nor a lip
};

}  // namespace cutbench::causes
