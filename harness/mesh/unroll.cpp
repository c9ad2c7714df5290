#include "harness/mesh/unroll.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/products_in_space.h"
#include "harness/base/union_find.h"
#include "harness/mesh/overlaps.h"
#include "harness/mesh/predicates.h"

namespace cutbench {

namespace {

Point3 minus(Point3 a, Point3 b) { return a + -1.0 * b; }

/// Where the third corner is that lies left of a -> b, as far along it and away from it as in space.
Point2 third_corner(Point2 a, Point2 b, Point3 in_space_a, Point3 in_space_b, Point3 in_space_c) {
  const Point3 side = minus(in_space_b, in_space_a), to = minus(in_space_c, in_space_a);
  const double along = dot(side, to) / length(side), height = length(cross(side, to)) / length(side);
  const Point2 way = (1 / length(b - a)) * (b - a);
  return a + along * way + height * Point2{-way.y, way.x};
}

/// Triangles as they are laid into the plane, one part after the other.
class Unrolling {
 public:
  Unrolling(const MeshData& mesh, const std::string& name, const FileEdges& whole)
      : mesh_(mesh), name_(name), whole_(whole) {
    triangles_.resize(mesh.triangles.size());
    find_neighbours();
    join_over_whole_edges();
    lay_all();
  }

  /// Parts are laid apart until none covers another one, or itself.
  void part_overlaps() {
    for (;;) {
      const MeshData laid = result();
      const std::optional<Overlap> overlap = find_overlap(laid);
      if (!overlap) return;
      // The one that was laid later begins a part of its own, with what whole edges join to it.
      const std::size_t later = std::max(overlap->low, overlap->high, [&](std::size_t a, std::size_t b) {
        return triangles_[a].turn < triangles_[b].turn;
      });
      if (waits_[later] != 0 && !leave_whole_edges_of(later)) can_not_be_unrolled();
      if (begins_.size() == most_parts) can_not_be_unrolled();
      begins_.insert(later);
      lay_all();
    }
  }

  MeshData result() const {
    MeshData laid;
    laid.unrolled = true;
    UnionFind joined(3 * triangles_.size());
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k)
        if (triangles_[t].meets[k]) {
          const std::size_t other = *neighbour(t, k);
          // Corners at the two ends of the edge; the neighbour's run the other way unless one of them is turned over.
          joined.join(corner(t, k), corner_at(other, vertex(t, k)));
          joined.join(corner(t, (k + 1) % 3), corner_at(other, vertex(t, (k + 1) % 3)));
        }
    // Each triangle has been laid by itself; a vertex is in the middle of where those round it have it.
    std::vector<Point2> sum(3 * triangles_.size());
    for (std::size_t c = 0; c < sum.size(); ++c)
      sum[joined.find(c)] = sum[joined.find(c)] + triangles_[c / 3].place[c % 3];
    std::vector<std::int32_t> number(3 * triangles_.size(), -1);
    std::vector<char> taken(mesh_.deformed.size(), 0);
    laid.deformed = mesh_.deformed;
    laid.rest.resize(mesh_.deformed.size());
    for (std::size_t v = 0; v < mesh_.deformed.size(); ++v) laid.sewn.push_back(to_int32(v));
    for (std::size_t t = 0; t < triangles_.size(); ++t) {
      auto& triangle = laid.triangles.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t c = joined.find(corner(t, k));
        if (number[c] < 0)
          number[c] = new_vertex(laid, to_size(vertex(t, k)), taken, (1 / to_double(joined.size(c))) * sum[c]);
        triangle[k] = number[c];
      }
    }
    laid.file_vertices = laid.sewn;
    return laid;
  }

  /// The first copy of a vertex keeps its number, others come after all.
  static std::int32_t new_vertex(MeshData& laid, std::size_t v, std::vector<char>& taken, Point2 place) {
    if (std::exchange(taken[v], 1) == 0) {
      laid.rest[v] = place;
      return to_int32(v);
    }
    laid.rest.push_back(place);
    laid.deformed.push_back(Point3(laid.deformed[v]));
    laid.sewn.push_back(to_int32(v));
    return to_int32(laid.rest.size() - 1);
  }

  std::size_t seam_edges() const {
    std::size_t count = 0;
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) count += neighbour(t, k) && !triangles_[t].meets[k];
    return count / 2;
  }
  std::size_t inner_edges() const {
    std::size_t count = 0;
    for (std::size_t t = 0; t < triangles_.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) count += neighbour(t, k).has_value();
    return count / 2;
  }
  std::size_t parts() const { return parts_; }

 private:
  struct Laid {
    std::size_t part = 0, turn = 0;  ///< which part; when it was laid, from 1; 0: not yet
    std::array<Point2, 3> place;     ///< of the corners, in the order below
    bool turned = false;             ///< corners 1 and 2 are swapped
    std::array<bool, 3> meets{};     ///< the neighbour across edge k shares both its ends
  };

  static std::size_t corner(std::size_t t, std::size_t k) { return 3 * t + k; }
  /// The file's number of corner k, in the order that makes the triangle counter-clockwise.
  std::int32_t vertex(std::size_t t, std::size_t k) const {
    return mesh_.triangles[t][triangles_[t].turned && k > 0 ? 3 - k : k];
  }
  std::size_t corner_at(std::size_t t, std::int32_t v) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (vertex(t, k) == v) return corner(t, k);
    return 0;  // never: they share it
  }
  Point2 place_at(std::size_t t, std::int32_t v) const {
    const std::size_t c = corner_at(t, v);
    return triangles_[t].place[c % 3];
  }
  Point3 in_space(std::int32_t v) const { return mesh_.deformed[to_size(v)]; }
  static std::pair<std::int32_t, std::int32_t> ends(std::int32_t a, std::int32_t b) {
    return {std::min(a, b), std::max(a, b)};
  }

  void find_neighbours() {
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto& [a, b, c] = mesh_.triangles[t];
      const auto name = [&] {
        return name_ + ": triangle " + std::to_string(t + 1) + " of " + std::to_string(mesh_.triangles.size());
      };
      for (const std::int32_t v : {a, b, c})
        if (v < 0 || v >= std::ssize(mesh_.deformed))
          throw InputError(name() + " has a corner beyond the " + std::to_string(mesh_.deformed.size()) +
                           " vertices; correct its indices");
      const Point3 u = minus(in_space(b), in_space(a)), w = minus(in_space(c), in_space(a));
      const double area2 = length(cross(u, w));
      if (!(area2 > 0) || !std::isfinite(area2))
        throw InputError(name() + " has zero area in space; collapse or delete it");
      for (const auto& [p, q] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
        auto& sides = sides_[ends(p, q)];
        sides.push_back(t);
        for (const std::size_t other : sides)
          if (other != t && has_same_corners(other, t))
            throw InputError(name() + " has the same corners as triangle " + std::to_string(other + 1) +
                             "; delete one of them");
        if (sides.size() > 2)
          throw InputError(name() + ": three triangles meet at one of its edges in space (with triangles " +
                           std::to_string(sides[0] + 1) + " and " + std::to_string(sides[1] + 1) +
                           "); a sheet has two at most: delete one");
      }
    }
  }

  bool has_same_corners(std::size_t s, std::size_t t) const {
    return std::is_permutation(mesh_.triangles[s].begin(), mesh_.triangles[s].end(), mesh_.triangles[t].begin());
  }

  /// The triangle across edge k of t; none on the border.
  std::optional<std::size_t> neighbour(std::size_t t, std::size_t k) const {
    const auto& sides = sides_.at(ends(vertex(t, k), vertex(t, (k + 1) % 3)));
    if (sides.size() < 2) return {};
    return sides[0] == t ? sides[1] : sides[0];
  }

  [[noreturn]] void can_not_be_unrolled() const {
    throw InputError(name_ + ": can't be unrolled without parts that cover each other; flatten it, and write the " +
                     "flat places as vt");
  }

  std::pair<std::int32_t, std::int32_t> ends_of(std::size_t t, std::size_t k) const {
    return ends(vertex(t, k), vertex(t, (k + 1) % 3));
  }

  void join_over_whole_edges() {
    joined_.reset(triangles_.size());
    for (const auto& edge : whole_)
      if (const auto sides = sides_.find(edge); sides != sides_.end() && sides->second.size() == 2)
        joined_.join(sides->second[0], sides->second[1]);
  }

  /// False: it has none.
  bool leave_whole_edges_of(std::size_t t) {
    std::size_t left = 0;
    for (std::size_t k = 0; k < 3; ++k) left += whole_.erase(ends_of(t, k));
    join_over_whole_edges();
    return left > 0;
  }

  void lay_all() {
    std::fill(triangles_.begin(), triangles_.end(), Laid{});
    parts_ = laid_ = 0;
    double left = 0;
    waits_.assign(triangles_.size(), 0);
    std::set<std::size_t> first;
    for (const std::size_t t : begins_) first.insert(joined_.find(t));
    for (std::size_t t = 0; t < triangles_.size(); ++t) waits_[t] = first.contains(joined_.find(t));
    for (const bool only_begins : {false, true})
      for (std::size_t t = 0; t < triangles_.size(); ++t)
        if (triangles_[t].turn == 0 && (waits_[t] != 0) == only_begins) left = lay_part(t, left);
  }

  /// From triangle t on, as far as there are neighbours, `left` of which nothing is put. \return  the same for the next
  double lay_part(std::size_t t, double left) {
    std::vector<std::size_t> part;
    lay_first(t);
    std::deque<std::size_t> waiting;
    for (lay_over_whole_edges(t, waiting); !waiting.empty(); waiting.pop_front()) {
      const std::size_t from = waiting.front();
      part.push_back(from);
      for (std::size_t k = 0; k < 3; ++k)
        if (const auto next = next_to_lay(from, k); next && waits_[*next] == 0) {
          lay_beside(from, k, *next);
          lay_over_whole_edges(*next, waiting);
        }
    }
    ++parts_;
    return move_beside(part, left);
  }

  /// Before any others, so that these edges are laid from one side to the other.
  void lay_over_whole_edges(std::size_t laid, std::deque<std::size_t>& waiting) {
    for (std::vector<std::size_t> open{laid}; !open.empty();) {
      const std::size_t from = open.back();
      open.pop_back();
      waiting.push_back(from);
      for (std::size_t k = 0; k < 3; ++k)
        if (const auto next = next_to_lay(from, k); next && whole_.contains(ends_of(from, k))) {
          lay_beside(from, k, *next);
          open.push_back(*next);
        }
    }
  }

  /// The triangle across edge k, if it is not laid yet.
  std::optional<std::size_t> next_to_lay(std::size_t from, std::size_t k) const {
    const auto next = neighbour(from, k);
    return next && triangles_[*next].turn == 0 ? next : std::nullopt;
  }

  /// Its frame is as near to x and y of space as its plane allows.
  void lay_first(std::size_t t) {
    triangles_[t].turn = ++laid_;
    triangles_[t].part = parts_;
    const Point3 a = in_space(vertex(t, 0)), u = minus(in_space(vertex(t, 1)), a), w = minus(in_space(vertex(t, 2)), a);
    Point3 normal = cross(u, w);
    normal = (1 / length(normal)) * normal;
    triangles_[t].turned = !mesh_.unrolled && normal.z < 0 && parts_ == 0 && std::abs(normal.z) > 0.5;
    if (triangles_[t].turned) normal = -1.0 * normal;
    Point3 x = minus({1, 0, 0}, normal.x * normal);
    if (length(x) < 0.5) x = minus({0, 1, 0}, normal.y * normal);
    x = (1 / length(x)) * x;
    const Point3 y = cross(normal, x);
    for (std::size_t k = 0; k < 3; ++k) {
      const Point3 to = in_space(vertex(t, k));
      triangles_[t].place[k] = {dot(x, to), dot(y, to)};
    }
  }

  void lay_beside(std::size_t from, std::size_t k, std::size_t t) {
    const std::int32_t a = vertex(from, k), b = vertex(from, (k + 1) % 3);
    Laid& laid = triangles_[t];
    laid.turn = ++laid_;
    laid.part = parts_;
    laid.turned = !runs(t, b, a);
    const Point2 at_a = place_at(from, a), at_b = place_at(from, b);
    std::size_t third = 0;
    for (std::size_t l = 0; l < 3; ++l) {
      if (vertex(t, l) == a) laid.place[l] = at_a;
      if (vertex(t, l) == b) laid.place[l] = at_b;
      if (vertex(t, l) != a && vertex(t, l) != b) third = l;
    }
    const std::int32_t c = vertex(t, third);
    laid.place[third] = third_corner(at_b, at_a, in_space(b), in_space(a), in_space(c));
    meet(from, t);
    for (std::size_t l = 0; l < 3; ++l) {
      const auto other = neighbour(t, l);
      if (!other || triangles_[*other].turn == 0 || triangles_[*other].part != laid.part) continue;
      const std::int32_t p = vertex(t, l), q = vertex(t, (l + 1) % 3);
      const double gap = unrolled_gap * length(minus(in_space(p), in_space(q)));
      const auto near = [&](std::int32_t v) { return length(place_at(t, v) - place_at(*other, v)) <= gap; };
      if (near(p) && near(q) && !runs(*other, p, q)) meet(t, *other);
    }
  }

  /// Counter-clockwise, t has p before q.
  bool runs(std::size_t t, std::int32_t p, std::int32_t q) const {
    for (std::size_t l = 0; l < 3; ++l)
      if (vertex(t, l) == p && vertex(t, (l + 1) % 3) == q) return true;
    return false;
  }

  void meet(std::size_t s, std::size_t t) {
    for (const auto& [a, b] : {std::pair(s, t), std::pair(t, s)})
      for (std::size_t k = 0; k < 3; ++k)
        if (const auto other = neighbour(a, k); other && *other == b) triangles_[a].meets[k] = true;
  }

  double move_beside(const std::vector<std::size_t>& part, double left) {
    double low = 1e300, high = -1e300, longest = 0;
    for (const std::size_t t : part)
      for (std::size_t k = 0; k < 3; ++k) {
        low = std::min(low, triangles_[t].place[k].x);
        high = std::max(high, triangles_[t].place[k].x);
        longest = std::max(longest, length(triangles_[t].place[k] - triangles_[t].place[(k + 1) % 3]));
      }
    if (parts_ == 1) return high + longest;  // where it is
    for (const std::size_t t : part)
      for (Point2& p : triangles_[t].place) p.x += left - low;
    return left + (high - low) + longest;
  }

  const MeshData& mesh_;
  const std::string& name_;
  FileEdges whole_;
  UnionFind joined_;  // triangles, over whole edges
  std::map<std::pair<std::int32_t, std::int32_t>, std::vector<std::size_t>> sides_;
  std::vector<Laid> triangles_;
  std::set<std::size_t> begins_;  // triangles that are the first of a part
  std::vector<char> waits_;       // per triangle: it begins a part, or is joined to one that does
  std::size_t parts_ = 0, laid_ = 0;
};

/// The largest share by which a side is longer or shorter at rest than in space.
double distortion(const MeshData& laid) {
  double largest = 0;
  for (const auto& triangle : laid.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = to_size(triangle[k]), b = to_size(triangle[(k + 1) % 3]);
      const double there = length(minus(laid.deformed[b], laid.deformed[a]));
      largest = std::max(largest, std::abs(length(laid.rest[b] - laid.rest[a]) / there - 1));
    }
  return largest;
}

/// As it was before it was unrolled: the vertices of the file.
MeshData rolled_up(const MeshData& mesh) {
  MeshData file;
  file.unrolled = true;
  file.notes = mesh.notes;
  const auto number = [&](std::int32_t v) { return mesh.file_vertices[to_size(mesh.sewn[to_size(v)])]; };
  for (std::size_t v = 0; v < mesh.deformed.size(); ++v) {
    const std::size_t n = to_size(number(to_int32(v)));
    if (n >= file.deformed.size()) file.deformed.resize(n + 1);
    file.deformed[n] = mesh.deformed[v];
  }
  for (const auto& [a, b, c] : mesh.triangles) file.triangles.push_back({number(a), number(b), number(c)});
  return file;
}

}  // namespace

void unroll_anew(MeshData& mesh, const std::string& name, const FileEdges& whole) {
  const MeshData file = rolled_up(mesh);
  Unrolling unrolling(file, name, whole);
  unrolling.part_overlaps();
  mesh = unrolling.result();
  mesh.notes = file.notes;
}

void unroll(MeshData& mesh, const std::string& name) {
  const FileEdges none;
  Unrolling unrolling(mesh, name, none);
  unrolling.part_overlaps();
  MeshData laid = unrolling.result();
  laid.notes = std::move(mesh.notes);
  const std::size_t seams = unrolling.seam_edges(), edges = unrolling.inner_edges();
  std::string note = name + ": the rest shape is the mesh itself, unrolled";
  if (unrolling.parts() > 1) note += " in " + std::to_string(unrolling.parts()) + " parts";
  if (seams > 0) note += ", sewn along " + std::to_string(seams) + " of " + std::to_string(edges) + " inner edges";
  if (const double off = distortion(laid); off > 1e-9) {
    char text[48];
    std::snprintf(text, sizeof text, ", lengths kept to %.1g", off);
    note += text;
  }
  laid.notes.push_back(note + "; give paths as places in space");
  mesh = std::move(laid);
}

}  // namespace cutbench
