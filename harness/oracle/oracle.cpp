#include "harness/oracle/oracle.h"

#include <cstdint>
#include <cstdio>
#include <cstring>
#include <map>
#include <set>
#include <stdexcept>

#include "harness/oracle/clip.h"
#include "harness/oracle/conversions.h"
#include "harness/oracle/deletion.h"
#include "harness/oracle/exact.h"
#include "harness/oracle/expected_pieces.h"
#include "harness/oracle/flatten.h"
#include "harness/oracle/incision_error.h"
#include "harness/oracle/search.h"
#include "harness/oracle/sheet_topology.h"

namespace cutbench::oracle {
namespace {

/// Collects problems; the first one gives the verdict.
class Problems {
 public:
  explicit Problems(Judgement& judgement) : judgement_(judgement) {}

  void add(Verdict verdict, const std::string& text) {
    constexpr int shown = 5;
    if (judgement_.verdict == Verdict::ok) judgement_.verdict = verdict;
    judgement_.ok = false;
    if (++count_[verdict] <= shown) judgement_.problems.push_back(std::string(name_of(verdict)) + ": " + text);
  }

 private:
  Judgement& judgement_;
  std::map<Verdict, int> count_;
};

std::string name(const Mesh& mesh, int t) {
  std::string text = "triangle " + std::to_string(t) + " (";
  for (int v : mesh.triangles[t]) text += std::to_string(v) + " ";
  text.back() = ')';
  return text;
}

std::string number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

std::string name(const Point& p) {
  char text[64];
  std::snprintf(text, sizeof text, "(%.17g, %.17g)", p[0], p[1]);
  return text;
}

std::string name(const Segment& s) { return name(s[0]) + "-" + name(s[1]); }

/// True where the later checks may use the indices and coordinates.
bool check_values(const Mesh& mesh, Problems& problems) {
  bool usable = true;
  for (std::size_t v = 0; v < mesh.rest.size(); ++v)
    if (!std::isfinite(mesh.rest[v][0]) || !std::isfinite(mesh.rest[v][1])) {
      problems.add(Verdict::not_finite, "vertex " + std::to_string(v));
      usable = false;
    }
  for (int t = 0; t < to_int(mesh.triangles.size()); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    const int count = to_int(mesh.rest.size());
    const bool in_range = std::min({a, b, c}) >= 0 && std::max({a, b, c}) < count;
    if (in_range && a != b && b != c && c != a) continue;
    problems.add(Verdict::bad_index, name(mesh, t) + " of " + std::to_string(count) + " vertices");
    usable = false;
  }
  return usable;
}

void check_orientation(const Mesh& mesh, Problems& problems) {
  for (int t = 0; t < to_int(mesh.triangles.size()); ++t) {
    const auto& [a, b, c] = mesh.triangles[t];
    if (orientation(mesh.rest[a], mesh.rest[b], mesh.rest[c]) <= 0) problems.add(Verdict::inverted, name(mesh, t));
  }
}

/// True where the half-edges may be used.
bool check_manifold(const Mesh& mesh, const HalfEdges& edges, Problems& problems) {
  for (int e : edges.repeated)
    problems.add(Verdict::non_manifold, "repeated edge " + std::to_string(e % 3) + " of " + name(mesh, e / 3));
  if (!edges.repeated.empty()) return false;
  for (int v : bow_ties(mesh, edges)) problems.add(Verdict::non_manifold, "bow-tie at vertex " + std::to_string(v));
  return true;
}

/// The input, its border and older incisions, and the size of its rounding errors.
struct Input {
  HalfEdges edges;
  std::vector<Segment> border, incisions;
  EdgeLengths lengths;
  double rounding = 0;  ///< eight units in the last place of the largest coordinate
  double on = 0;        ///< what lies so near to a segment lies on it
};

[[noreturn]] void refuse(const std::string& why) {
  throw std::invalid_argument("the input of a cut can't be judged: " + why);
}

Input examine(const Request& request) {
  const Mesh& mesh = request.before;
  Judgement findings;
  Problems problems(findings);
  Input input;
  if (mesh.triangles.empty()) refuse("empty: no triangles");
  if (!(request.snap >= 0 && request.tolerance >= 0 && request.vertex_tolerance >= 0 && request.rounding >= 0))
    refuse("request: negative tolerance");
  if (check_values(mesh, problems)) {
    check_orientation(mesh, problems);
    input.edges = half_edges(mesh);
    check_manifold(mesh, input.edges, problems);
  }
  if (!findings.ok) refuse(findings.problems.front());

  const Borders borders = oracle::borders(mesh, input.edges);
  for (int e : borders.single) input.border.push_back(segment(mesh, e));
  for (int e : borders.ambiguous) input.border.push_back(segment(mesh, e));
  for (const auto& lips : borders.lips) input.incisions.push_back(segment(mesh, lips[0]));
  input.lengths = edge_lengths(mesh, input.edges);
  double largest = 0;
  for (const Point& p : mesh.rest) largest = std::max({largest, std::abs(p[0]), std::abs(p[1])});
  input.rounding = 8 * std::numeric_limits<double>::epsilon() * largest;
  input.on = request.snap + input.rounding;
  return input;
}

/// The longer side of the points' bounding box.
double extent(const std::vector<Point>& points) {
  Point low{0, 0}, high{0, 0};
  for (const Point& p : points)
    for (std::size_t i = 0; i < 2; ++i) {
      low[i] = &p == &points.front() ? p[i] : std::min(low[i], p[i]);
      high[i] = &p == &points.front() ? p[i] : std::max(high[i], p[i]);
    }
  return std::max(high[0] - low[0], high[1] - low[1]);
}

/// The segments of each requested curve; curves no larger than `smallest` ask for nothing.
std::vector<std::vector<Segment>> paths(const std::vector<Curve>& cuts, double tolerance, double smallest) {
  std::vector<std::vector<Segment>> result;
  for (const Curve& cut : cuts) {
    std::vector<Segment> path;
    std::vector<Point> points;
    for (const PathSegment& s : flatten(cut, tolerance)) {
      path.push_back(s.segment);
      points.insert(points.end(), {s.segment[0], s.segment[1]});
    }
    if (extent(points) > smallest) result.push_back(std::move(path));
  }
  return result;
}

/// Judges a result whose values and edges can be used.
class Judge {
 public:
  Judge(const Request& request, const Input& input, const Mesh& after, Judgement& judgement, Problems& problems)
      : request_(request), input_(input), after_(after), judgement_(judgement), problems_(problems) {}

  void run(const HalfEdges& edges) {
    check_unused();
    check_borders(borders(after_, edges));
    check_area();
    count_pieces(edges);
    if (!request_.keeps_area) return check_deletion();
    if (request_.keeps_vertices) check_vertices();
    check_pieces(edges);
    check_incision();
  }

 private:
  void check_unused() {
    const std::vector<int> before = unused_vertices(request_.before);
    for (int v : unused_vertices(after_))
      if (!std::binary_search(before.begin(), before.end(), v))
        problems_.add(Verdict::unused_vertex, "no triangle has vertex " + std::to_string(v));
  }

  void check_borders(const Borders& borders) {
    const SegmentSearch outline(input_.border), older(input_.incisions);
    std::vector<Segment> lips;
    for (int e : borders.ambiguous) problems_.add(Verdict::leak, "not just two lips " + name(segment(after_, e)));
    for (int e : borders.single) {
      edges_.push_back(segment(after_, e));
      if (request_.keeps_area && !outline.covers(edges_.back(), near()))
        problems_.add(Verdict::leak, "border edge " + name(edges_.back()));
    }
    for (const auto& pair : borders.lips) {
      lips.push_back(segment(after_, pair[0]));
      if (!older.covers(lips.back(), near())) added_.push_back(lips.back());
    }
    edges_.insert(edges_.end(), lips.begin(), lips.end());
    const SegmentSearch open(std::move(lips));
    for (const Segment& s : input_.incisions)
      if (!open.covers(s, near())) healed_.push_back(s);
  }

  void check_area() {
    const long double before = area(request_.before), after = area(after_);
    judgement_.area_change = to_double((after - before) / before);
    double perimeter = 0;
    for (const auto& [a, b] : input_.border) perimeter += distance(a, b);
    const long double allowed = 1e-12L * before + (input_.rounding + request_.rounding) * perimeter;
    if (request_.keeps_area && std::abs(after - before) > allowed)
      problems_.add(Verdict::area, "relative change " + number(judgement_.area_change));
  }

  void check_vertices() {
    const auto same_bits = [](const Point& p, const Point& q) {
      return std::memcmp(p.data(), q.data(), sizeof p) == 0;
    };
    for (std::size_t v = 0; v < request_.before.rest.size(); ++v)
      if (v >= after_.rest.size() || !same_bits(after_.rest[v], request_.before.rest[v]))
        problems_.add(Verdict::moved_vertex, std::to_string(v));
  }

  void check_deletion() {
    const double near = std::min(request_.tolerance, input_.lengths.longest) + slack();
    const Deletion found = judge_deletion(request_.before, after_, requested_path(asks_for_nothing()), near);
    for (int t : found.invented) problems_.add(Verdict::deletion, name(after_, t) + " is none of the sheet before");
    for (int t : found.unasked)
      problems_.add(Verdict::deletion, name(request_.before, t) + " is gone, and not on the path");
    for (int t : found.left) problems_.add(Verdict::deletion, name(after_, t) + " is on the path, and still there");
  }

  void count_pieces(const HalfEdges& edges) {
    piece_ = pieces_of_triangles(edges);
    judgement_.pieces = piece_.empty() ? 0 : *std::max_element(piece_.begin(), piece_.end()) + 1;
  }

  void check_pieces(const HalfEdges& edges) {
    // A Bezier curve is requested up to flattening: 1e-3 mean edges by the code under test, less here.
    const double h = input_.lengths.mean;
    const double flattening = input_.on + (curved() ? std::min(2e-3 * h, 0.02 * smallest_extent()) : 0);
    const auto requested = paths(request_.cuts, 1e-4 * h, asks_for_nothing());
    const ExpectedPieces expected =
        expected_pieces(input_.border, input_.incisions, requested,
                        {.tip = input_.on, .touch = flattening, .thin = std::max(flattening, request_.thin)});
    judgement_.expected_pieces = expected.expected;
    int most = expected.most;
    if (judgement_.pieces > most) most += count_hairs(edges, requested, 2 * flattening);
    judgement_.least_pieces = expected.least;
    judgement_.most_pieces = most;
    if (judgement_.pieces < expected.least || judgement_.pieces > most)
      problems_.add(Verdict::wrong_pieces,
                    std::to_string(judgement_.pieces) + " instead of " + std::to_string(expected.expected));
  }

  /// Where two lines of the input run so near to each other that they may have been merged, they may have been merged
  /// here and there: how many pieces thinner than that lie between two such lines all along.
  int count_hairs(const HalfEdges& edges, const std::vector<std::vector<Segment>>& paths, double near) const {
    std::vector<Segment> lines = input_.border;
    lines.insert(lines.end(), input_.incisions.begin(), input_.incisions.end());
    for (const auto& path : paths) lines.insert(lines.end(), path.begin(), path.end());
    const SegmentSearch search(lines);
    const auto between_two = [&](const Segment& s) {
      const Point p = between(s[0], s[1], 0.5);
      std::set<int> found;
      search.for_each_in({{p[0] - near, p[1] - near}, {p[0] + near, p[1] + near}}, [&](int i) {
        if (distance(p, lines[to_size(i)]) <= near) found.insert(i);
      });
      return found.size() > 1;
    };
    struct Piece {
      double area = 0, perimeter = 0;
      bool between_lines = true;
    };
    std::vector<Piece> pieces(to_size(judgement_.pieces));
    for (std::size_t t = 0; t < piece_.size(); ++t) {
      const auto& [a, b, c] = after_.triangles[t];
      const Point &p = after_.rest[a], &q = after_.rest[b], &r = after_.rest[c];
      pieces[piece_[t]].area += cross(minus(q, p), minus(r, p)) / 2;
    }
    for (std::size_t e = 0; e < edges.opposite.size(); ++e) {
      if (edges.opposite[e] >= 0) continue;
      const Segment s = segment(after_, to_int(e));
      pieces[piece_[e / 3]].perimeter += distance(s[0], s[1]);
    }
    const auto is_thin = [&](const Piece& p) { return 4 * p.area < near * p.perimeter; };
    for (std::size_t e = 0; e < edges.opposite.size(); ++e)
      if (Piece& p = pieces[piece_[e / 3]]; edges.opposite[e] < 0 && is_thin(p) && p.between_lines)
        p.between_lines = between_two(segment(after_, to_int(e)));
    return to_int(
        std::count_if(pieces.begin(), pieces.end(), [&](const Piece& p) { return is_thin(p) && p.between_lines; }));
  }

  void check_incision() {
    const SegmentSearch path(requested_path(0));  // what needn't be cut may be
    const IncisionError error = incision_error(requested_path(asks_for_nothing()), path, SegmentSearch(edges_), added_,
                                               TriangleSearch(request_.before), 0.02 * input_.lengths.mean);
    judgement_.incision_error = std::max(error.of_path, error.of_edges);
    const double allowed = allowed_error() + request_.rounding;
    if (error.of_path > allowed) problems_.add(Verdict::incision, "path not opened, off by " + number(error.of_path));
    if (error.of_edges > allowed) problems_.add(Verdict::incision, "edges off the path by " + number(error.of_edges));
    for (const Segment& s : healed_) problems_.add(Verdict::incision, "an older one has closed at " + name(s));
    if (!request_.exact_incision) return;
    for (const Segment& s : added_)
      for (const Point& p : s)
        if (path.distance(p) > request_.vertex_tolerance + slack() + request_.rounding)
          problems_.add(Verdict::incision, "a vertex is off the path at " + name(p));
  }

  /// Finely flattened, and what of it is near the sheet.
  std::vector<Segment> requested_path(double smallest) const {
    std::vector<Segment> all;
    for (const auto& path : paths(request_.cuts, flattening(), smallest))
      all.insert(all.end(), path.begin(), path.end());
    return near_mesh(all, request_.before);
  }

  double flattening() const { return 1e-5 * input_.lengths.mean; }
  /// What lies so near to a segment lies on it, as it is written.
  double near() const { return input_.on + request_.rounding; }
  double slack() const { return input_.on + (curved() ? flattening() : 0); }

  double allowed_error() const { return std::min(request_.tolerance, input_.lengths.longest) + slack(); }

  /// The size of a curve that needn't be cut. The code under test flattens it more coarsely, by hundredths of its size,
  /// and may find it smaller. (Of a path hardly larger round an older incision's tip all lips may lie on that one.)
  double asks_for_nothing() const {
    const bool nothing_done = added_.empty() && after_.triangles.size() == request_.before.triangles.size();
    return (nothing_done ? 1.05 : 1) * 2 * input_.on;
  }

  double smallest_extent() const {
    double smallest = std::numeric_limits<double>::infinity();
    for (const Curve& cut : request_.cuts) smallest = std::min(smallest, extent(cut.points));
    return smallest;
  }

  bool curved() const {
    return std::any_of(request_.cuts.begin(), request_.cuts.end(), [](const Curve& c) { return c.bezier; });
  }

  const Request& request_;
  const Input& input_;
  const Mesh& after_;
  Judgement& judgement_;
  Problems& problems_;
  std::vector<int> piece_;       // per triangle of the result
  std::vector<Segment> edges_;   // all border edges of the result
  std::vector<Segment> added_;   // new opened edges, one per pair of lips
  std::vector<Segment> healed_;  // older incisions no longer open
};

}  // namespace

const char* name_of(Verdict verdict) {
  constexpr const char* names[] = {"ok",           "not_finite",    "bad_index", "inverted",
                                   "non_manifold", "unused_vertex", "leak",      "area",
                                   "moved_vertex", "wrong_pieces",  "deletion",  "incision"};
  return names[to_size(verdict)];
}

std::ostream& operator<<(std::ostream& out, Verdict verdict) { return out << name_of(verdict); }

Judgement judge(const Request& request, const Mesh& after) {
  const Input input = examine(request);
  Judgement judgement;
  Problems problems(judgement);
  if (!check_values(after, problems)) return judgement;
  check_orientation(after, problems);
  const HalfEdges edges = half_edges(after);
  if (!check_manifold(after, edges, problems)) return judgement;
  Judge(request, input, after, judgement, problems).run(edges);
  return judgement;
}

}  // namespace cutbench::oracle
