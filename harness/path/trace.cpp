#include "harness/path/trace.h"

#include <algorithm>
#include <cmath>

#include "harness/base/conversions.h"
#include "harness/mesh/one_ring.h"
#include "harness/mesh/predicates.h"
#include "harness/path/tips.h"

namespace cutbench {

namespace {

/// Segments of the path in one triangle. To embed them takes time that grows with their square, at least.
constexpr std::size_t most_segments_in_triangle = 8192;

/// Points within a distance of each other have keys within twice that.
double key_of(Point2 p) { return p.x + 0.61803398874989485 * p.y; }

}  // namespace

Subdivision& Tracer::trace(const Sheet& sheet, const Polyline& path, Walk& walk, double chord_tolerance,
                           bool may_begin_elsewhere) {
  sheet_ = &sheet;
  path_ = &path;
  chord_tolerance_ = chord_tolerance;
  trace_.reset(sheet);
  trace_.chord_tolerance = chord_tolerance;
  passages_.clear();
  passages_of_face_.clear();
  from_ = walk.place();
  from_node_ = -1;
  first_ = 1;
  count_ = 0;
  loop_ = head_open_ = path.closed && !path.kept[0] && from_.kind == Place::Kind::face;
  if (loop_) {
    first_ = 0;
    count_ = 1;
  }
  face_ = from_.face;
  excursion_.clear();
  departed_ = path.curved && std::isfinite(chord_tolerance) && is_on_incision(from_);
  departure_ = from_;

  const std::size_t n = path.points.size();
  std::size_t last = path.closed ? n : n - 1;
  bool begun = !(loop_ && path.curved && std::isfinite(chord_tolerance));
  std::size_t steps_left = 8 * (sheet.triangle_slots() + n) + 1000;
  const Place begin = from_;
  Place start;
  found_.clear();
  note(path.points.front(), from_);
  for (std::size_t i = 1; i <= last; ++i) {
    const Place* before = found_before(point(i));
    for (bool arrived = false; !arrived;) {
      const Step step = walk.advance(point(i), before);
      arrived = step.arrived;
      if (begun) {
        take(step, i, arrived && i == last && !loop_);
        // Of several edges a rounding apart only the one it started on will do.
        if (i == last && i > n && step.place.point == start.point && are_together(sheet, step.place, start))
          arrived = true;
      } else if (begun = is_on_incision(step.place); begun) {
        // A loop that may follow an incision is traced from where it meets one first, once round to there.
        excursion_.clear();
        loop_ = head_open_ = false;
        last = n + i;
        start = departure_ = from_ = step.place;
        departed_ = true;
        first_ = arrived ? i + 1 : i;
        count_ = 0;
      } else {
        excursion_.push_back({step, i, false});
      }
      if (--steps_left == 0) throw WalkLost();
    }
    if (!before) note(point(i), walk.place());
  }
  flush();
  // Back at the first point, from another side, the walk may find it on another of several vertices or edges as near:
  // the path closes only where it begins there, too.
  const bool comes_back = path.closed ? last == n : within(path.points.front(), path.points.back(), sheet.snap());
  if (comes_back && may_begin_elsewhere && !are_together(sheet, walk.place(), begin))
    return trace(sheet, path, walk, chord_tolerance, false);
  if (loop_) close_loop();
  for (int f = 0; f < to_int(trace_.faces.size()); ++f)
    if (!is_simple(f)) arrange(f);
  if (trace_.nodes.size() == 2) split_lone_piece();
  return trace_;
}

void Tracer::note(Point2 p, const Place& at) {
  if (at.kind != Place::Kind::vertex && at.kind != Place::Kind::edge) return;
  const auto behind = std::upper_bound(found_.begin(), found_.end(), key_of(p),
                                       [](double key, const auto& f) { return key < key_of(f.first); });
  found_.insert(behind, {p, at});
}

/// Where the path was when it came by this point earlier; none where it didn't, or was inside a triangle.
const Place* Tracer::found_before(Point2 p) const {
  const double snap = sheet_->snap();
  auto known = std::lower_bound(found_.begin(), found_.end(), key_of(p) - 2 * snap,
                                [](const auto& f, double key) { return key_of(f.first) < key; });
  for (; known != found_.end() && key_of(known->first) <= key_of(p) + 2 * snap; ++known)
    if (within(known->first, p, snap)) return &known->second;
  return nullptr;
}

/// Does neither the border nor an open incision pass through the place where the path ends? \param goes_on  beyond it
bool Tracer::is_free(const Place& place, bool goes_on) const {
  if (place.kind == Place::Kind::face) return true;
  if (place.kind == Place::Kind::edge) return !is_open(*sheet_, place.edge, goes_on);
  for (const HalfEdge h : outgoing_edges(*sheet_, place.vertex))
    for (const HalfEdge at : {h, Sheet::previous(h)})
      if (is_open(*sheet_, at, goes_on)) return false;
  return true;
}

/// One edge between two tips has nothing to open, since tips stay whole: it gets a node in between, on the path.
/// Between tips less than two snap distances apart, too.
void Tracer::split_lone_piece() {
  const Place a = trace_.node(0).place, b = trace_.node(1).place;
  if (!is_free(a, path_->continues) || !is_free(b, path_->goes_on)) return;
  const Point2 middle = a.point + 0.5 * (b.point - a.point);
  if (!trace_.along.empty()) {
    const HalfEdge h = trace_.along[0].edge;
    const Point2 from = sheet_->rest(sheet_->origin(h)), edge = sheet_->rest(sheet_->target(h)) - from;
    Place place;
    place.kind = Place::Kind::edge;
    place.edge = h;
    place.lambda = dot(middle - from, edge) / dot(edge, edge);
    place.point = from + place.lambda * edge;
    trace_.add_node(place);
  } else if (!trace_.segments.empty()) {
    const TrianglePassage& only = passages_.front();
    const auto crossed = std::find_if(trace_.faces.begin(), trace_.faces.end(),
                                      [](const Subdivision::Face& face) { return face.segments >= 0; });
    const TriangleIndex t = crossed->triangle;
    int node = only.count > 0 ? trace_.node_of(place_in(t, point(only.first + only.count / 2))) : 0;
    if (node < 2) node = trace_.add_node(place_in(t, middle));  // a path that goes to and fro
    // Once more in the order of the path, in which methods insert them: else an edge from tip to tip might come first.
    const Place between = trace_.node(node).place;
    trace_.reset(*sheet_);
    const int face = trace_.face_of(t), from = trace_.add_node(a), at = trace_.add_node(between),
              to = trace_.add_node(b);
    trace_.add_segment(face, from, at);
    trace_.add_segment(face, at, to);
  }
}

/// Takes in one step of the walk; `point` is the polyline point it is on its way to, `tip`: the path ends with it.
void Tracer::handle(const Step& step, std::size_t point, bool tip) {
  const Place& to = step.place;
  int to_node = -1;
  switch (step.passage.kind) {
    case Passage::Kind::along:
      run_along(from_, to, step.passage.edge);
      break;
    case Passage::Kind::face:
      face_ = step.passage.face;
      if (to.kind == Place::Kind::face && !tip) {
        ++count_;
        return;
      }
      if (head_open_) {
        head_open_ = false;
        head_face_ = face_;
        head_to_ = to;
        head_count_ = count_;
      } else {
        to_node = finish(trace_.face_of(face_), from_, first_, count_, to);
      }
      break;
    case Passage::Kind::nothing:
    case Passage::Kind::outside:
      break;
  }
  from_ = to;
  from_node_ = to_node;
  // The next passage's points start behind this place.
  first_ = step.arrived ? point + 1 : point;
  count_ = 0;
}

/// A closed path that began inside a triangle: its last passage goes on into its first.
void Tracer::close_loop() {
  if (head_open_) {  // it never left that triangle: break the loop at its first point
    const Place start = place_in(face_, point(0));
    finish(trace_.face_of(face_), start, 1, count_ - 2, start);
    return;
  }
  if (face_ != head_face_) throw WalkLost();
  // The last passage ends with the first point itself, with which the head begins.
  finish(trace_.face_of(face_), from_, first_, count_ + head_count_ - 1, head_to_);
}

/// The path runs along an edge; where that is open already there is nothing to do.
void Tracer::run_along(const Place& from, const Place& to, HalfEdge edge) {
  if (sheet_->separates(edge)) return;
  const int first =
      trace_.node_of(from);  // not within the call: compilers differ in which argument they evaluate first
  const int second = trace_.node_of(to);
  trace_.add_along(first, second, edge);
}

/// With what is chosen of the passage under way.
void Tracer::check_room(int face) const {
  std::size_t segments = 1 + to_size(std::count(chosen_.begin(), chosen_.end(), 1));
  for (int i = passages_of(face); i >= 0; i = passage(i).next)
    segments += passage(i).segments[1] - passage(i).segments[0];
  if (segments > most_segments_in_triangle)
    throw CutRefused(
        "over 8192 pieces of the path lie in one triangle; give it fewer points, or the sheet more triangles");
}

/// Records one passage through one triangle; returns the node at its end, -1 where it came to nothing. The node at its
/// start is from_node_ where that is known.
int Tracer::finish(int face, const Place& from, std::size_t first, std::size_t count, const Place& to) {
  const TriangleIndex t = trace_.face(face).triangle;
  chosen_.assign(count, 0);
  const int common = common_edge(t, from, to);
  if (count > 0) choose(common >= 0, from, first, count, to);
  check_room(face);
  if (common >= 0 && !any_chosen()) {
    run_along(from, to, half_edge(t, common));
    return -1;
  }

  const int start = from_node_ >= 0 ? from_node_ : trace_.node_of(from);
  int node = start;
  std::size_t kept = 0;
  const std::size_t segments = trace_.segments.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (!chosen_[i]) continue;
    const int next = trace_.node_of(place_in(t, point(first + i)));
    trace_.add_segment(face, node, next);
    node = next;
    ++kept;
  }
  const int end = trace_.node_of(to);
  trace_.add_segment(face, node, end);
  passages_of_face_.resize(trace_.faces.size(), -1);
  int& head = passages_of_face_[to_size(face)];
  passages_.push_back({start, end, first, count, kept < count, {segments, trace_.segments.size()}, head});
  head = to_int(passages_.size() - 1);
  return end;
}

/// Which points of a passage become nodes.
void Tracer::choose(bool on_one_edge, const Place& from, std::size_t first, std::size_t count, const Place& to) {
  for (std::size_t i = 0; i < count; ++i) chosen_[i] = path_->kept[wrapped(first + i)];
  if (within(from.point, to.point, sheet_->snap())) choose_on_loop(from.point, first, count);
  if (std::isfinite(chord_tolerance_)) {
    std::size_t begin = 0;
    Point2 a = from.point;
    for (std::size_t i = 0; i <= count; ++i) {
      if (i < count && !chosen_[i]) continue;
      const Point2 b = i < count ? point(first + i) : to.point;
      choose_by_chord(a, b, first, begin, i);
      a = b;
      begin = i + 1;
    }
  }
  if (on_one_edge && !any_chosen()) {  // a U-turn: its farthest point
    const Point2 chord = to.point - from.point;
    double farthest = sheet_->snap() * std::sqrt(squared_length(chord));
    std::size_t best = count;
    for (std::size_t i = 0; i < count; ++i)
      if (const double d = std::abs(cross(chord, point(first + i) - from.point)); d > farthest) {
        farthest = d;
        best = i;
      }
    if (best < count) chosen_[best] = 1;
  }
  // Pieces that all go the way of the chord can't meet.
  const Point2 chord = to.point - from.point;
  bool monotone = dot(to.point - point(first + count - 1), chord) > 0;
  Point2 before = from.point;
  for (std::size_t i = 0; i < count && monotone; ++i) {
    const Point2 p = point(first + i);
    monotone = dot(p - before, chord) > 0;
    before = p;
  }
  const bool all_chosen = std::find(chosen_.begin(), chosen_.end(), 0) == chosen_.end();
  if (count < 2 || monotone || all_chosen) return;
  all_points_.assign(1, from.point);
  chosen_points_ = all_points_;
  for (std::size_t i = 0; i < count; ++i) {
    all_points_.push_back(point(first + i));
    if (chosen_[i]) chosen_points_.push_back(all_points_.back());
  }
  all_points_.push_back(to.point);
  chosen_points_.push_back(to.point);
  if (crosses_itself(all_points_) || crosses_itself(chosen_points_)) chosen_.assign(count, 1);
}

/// A passage that ends where it starts: the point farthest from there, and on both ways the one farthest from that
/// line.
void Tracer::choose_on_loop(Point2 start, std::size_t first, std::size_t count) {
  auto farthest = [&](std::size_t begin, std::size_t end, auto distance) {
    std::size_t best = begin;
    for (std::size_t i = begin; i < end; ++i)
      if (distance(point(first + i)) > distance(point(first + best))) best = i;
    if (begin < end) chosen_[best] = 1;
    return best;
  };
  const std::size_t far = farthest(0, count, [&](Point2 p) { return squared_length(p - start); });
  if (count == 0) return;
  const Point2 axis = point(first + far) - start;
  const auto from_axis = [&](Point2 p) { return std::abs(cross(axis, p - start)); };
  farthest(0, far, from_axis);
  farthest(far + 1, count, from_axis);
}

/// Douglas-Peucker: while the polyline strays from a chord by more than the tolerance, its farthest point is chosen.
void Tracer::choose_by_chord(Point2 a, Point2 b, std::size_t first, std::size_t begin, std::size_t end) {
  if (begin >= end) return;
  double farthest = chord_tolerance_;
  std::size_t best = end;
  for (std::size_t i = begin; i < end; ++i) {
    const Point2 p = point(first + i);
    const double s = std::clamp(dot(p - a, b - a) / squared_length(b - a), 0.0, 1.0);
    const double d = std::sqrt(squared_length(p - (a + s * (b - a))));
    if (d > farthest) {
      farthest = d;
      best = i;
    }
  }
  if (best == end) return;
  chosen_[best] = 1;
  choose_by_chord(a, point(first + best), first, begin, best);
  choose_by_chord(point(first + best), b, first, best + 1, end);
}

bool crosses_itself(const std::vector<Point2>& p) {
  const Point2 chord = p.back() - p.front();
  bool monotone = true;  // all pieces go the way of the chord: then they can't meet
  for (std::size_t i = 0; i + 1 < p.size() && monotone; ++i) monotone = dot(p[i + 1] - p[i], chord) > 0;
  if (monotone) return false;
  const bool loop = p.front() == p.back();
  for (std::size_t i = 0; i + 1 < p.size(); ++i)
    for (std::size_t j = i + 2; j + 1 < p.size(); ++j) {
      if (loop && i == 0 && j + 2 == p.size()) continue;  // neighbours round the start
      if (orientation(p[i], p[i + 1], p[j]) * orientation(p[i], p[i + 1], p[j + 1]) <= 0 &&
          orientation(p[j], p[j + 1], p[i]) * orientation(p[j], p[j + 1], p[i + 1]) <= 0)
        return true;
    }
  return false;
}

/// The edges of t on which the place lies, as bits.
int Tracer::edges_of(TriangleIndex t, const Place& place) const {
  int bits = 0;
  for (int k = 0; k < 3; ++k) {
    const HalfEdge h = half_edge(t, k);
    if (place.kind == Place::Kind::vertex && sheet_->origin(h) == place.vertex)
      bits |= 1 << k | 1 << previous_corner(k);
    if (place.kind == Place::Kind::edge && (place.edge == h || place.edge == sheet_->opposite(h))) bits |= 1 << k;
  }
  return bits;
}

/// An edge of t on which both places lie, else -1.
int Tracer::common_edge(TriangleIndex t, const Place& a, const Place& b) const {
  if (a.kind == Place::Kind::face || b.kind == Place::Kind::face) return -1;
  if (a.kind == Place::Kind::edge && b.kind == Place::Kind::edge && a.edge != b.edge &&
      sheet_->opposite(a.edge) != b.edge)
    return -1;
  const int both = edges_of(t, a) & edges_of(t, b);
  return both & 1 ? 0 : both & 2 ? 1 : both & 4 ? 2 : -1;
}

}  // namespace cutbench
