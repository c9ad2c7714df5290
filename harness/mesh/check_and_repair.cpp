#include "harness/mesh/check_and_repair.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <sstream>

#include "harness/base/conversions.h"
#include "harness/base/union_find.h"
#include "harness/mesh/overlaps.h"
#include "harness/mesh/predicates.h"
#include "harness/mesh/rest_choice.h"
#include "harness/mesh/unroll.h"
#include "harness/mesh/winding.h"

namespace cutbench {

namespace {

constexpr double largest_coordinate = 1e60;   // far enough from the overflow of a product of four
constexpr double smallest_mean_side = 1e-60;  // and from its underflow
constexpr double hardly_flat = 1e-3;       // of the mesh's size: less is more often an exporter's rounding than a shape
constexpr double ulps_in_mean_side = 1e6;  // a cut rounds to the doubles there are: enough of them must be left

/// A half-edge, 3 t + k, filed under the two vertices it joins.
struct EdgeUse {
  std::int32_t low, high;
  std::size_t half_edge;
  bool forward;  ///< it runs from low to high

  bool same_edge(const EdgeUse& other) const { return low == other.low && high == other.high; }
  std::size_t triangle() const { return half_edge / 3; }
};

std::size_t next_half_edge(std::size_t h) { return h % 3 == 2 ? h - 2 : h + 1; }

class Repair {
 public:
  Repair(MeshData& mesh, const std::string& name, bool of_vt) : mesh_(mesh), name_(name), of_vt_(of_vt) {}

  void run() {
    // Vertices are dropped last, so that the numbers in messages are those of the file.
    number_as_in_file();
    check_indices();
    check_coordinates();
    if (mesh_.rest.empty()) take_rest_from_plane(mesh_, name_);
    check_size();
    orient();
    weld_by_rest();
    check_duplicates();
    check_edges();
    check_overlaps();
    split_bow_ties();
    drop_unused_vertices();
  }

 private:
  static std::size_t at(std::int32_t i) { return to_size(i); }
  std::int32_t& vertex(std::size_t corner) { return mesh_.triangles[corner / 3][corner % 3]; }
  std::size_t corners() const { return 3 * mesh_.triangles.size(); }

  [[noreturn]] void fail(const std::string& what) const { throw InputError(name_ + ": " + what); }
  void note(const std::string& what) { mesh_.notes.push_back(name_ + ": " + what); }

  std::string triangle_name(std::size_t t) const {
    return "triangle " + std::to_string(t + 1) + " of " + std::to_string(mesh_.triangles.size());
  }

  void number_as_in_file() {
    if (mesh_.file_vertices.size() == mesh_.deformed.size()) return;
    mesh_.file_vertices.resize(mesh_.deformed.size());
    std::iota(mesh_.file_vertices.begin(), mesh_.file_vertices.end(), 0);
  }

  void check_indices() {
    if (mesh_.triangles.empty()) fail("no triangles; the file is empty, cut short or holds no mesh");
    if (!mesh_.rest.empty() && mesh_.rest.size() != mesh_.deformed.size())
      fail(std::to_string(mesh_.rest.size()) + " rest but " + std::to_string(mesh_.deformed.size()) +
           " deformed positions; give as many of one as of the other");
    const auto count = std::ssize(mesh_.deformed);
    used_.assign(mesh_.deformed.size(), false);
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      const auto [a, b, c] = mesh_.triangles[t];
      for (std::int32_t v : {a, b, c}) {
        if (v < 0 || v >= count)
          fail(triangle_name(t) + " has a corner beyond the " + std::to_string(count) +
               " vertices; correct its indices");
        used_[at(v)] = true;
      }
      if (a == b || b == c || c == a) fail(triangle_name(t) + " has the same corner twice; delete it");
    }
  }

  void check_coordinates() const {
    auto good = [](double c) { return std::abs(c) <= largest_coordinate; };  // false for a NaN
    for (std::size_t v = 0; v < mesh_.deformed.size(); ++v) {
      if (!used_[v]) continue;
      const Point3 p = mesh_.deformed[v];
      const Point2 r = mesh_.rest.empty() ? Point2{} : mesh_.rest[v];
      if (!good(p.x) || !good(p.y) || !good(p.z) || !good(r.x) || !good(r.y))
        fail("vertex " + std::to_string(v + 1) + " of " + std::to_string(mesh_.deformed.size()) +
             " has a coordinate that is not finite or beyond 1e60; correct or rescale it");
    }
  }

  void check_size() {
    double sum = 0, largest = 0;
    for (std::size_t h = 0; h < corners(); ++h) {
      const Point2 a = mesh_.rest[at(vertex(h))], b = mesh_.rest[at(vertex(next_half_edge(h)))];
      sum += std::hypot(b.x - a.x, b.y - a.y);  // sides whose squares are zero count, too
      largest = std::max({largest, std::abs(a.x), std::abs(a.y)});
    }
    const double mean = sum / to_double(corners());
    const double ulp = std::nextafter(largest, 2 * largest_coordinate) - largest;
    std::ostringstream sizes;
    sizes << "the mean side of its triangles is " << mean << ", its largest rest coordinate " << largest;
    if (mean == 0) return;  // orient() says what is wrong
    if (mean < smallest_mean_side) fail("the sheet is too small (" + sizes.str() + "); rescale it to above 1e-60");
    if (mean < ulps_in_mean_side * ulp)
      fail("the sheet lies too far from the origin for its size (" + sizes.str() +
           "), so that too few doubles are left between its vertices; move it nearer");
  }

  /// Every triangle on its own: in the plane, a mesh that is not folded is then consistent too.
  void orient() {
    const std::size_t all = mesh_.triangles.size();
    std::vector<std::uint8_t> clockwise(all);
    for (std::size_t t = 0; t < all; ++t) {
      auto& [a, b, c] = mesh_.triangles[t];
      const int turn = orientation(mesh_.rest[at(a)], mesh_.rest[at(b)], mesh_.rest[at(c)]);
      if (turn == 0)
        fail(triangle_name(t) + " has zero area in " + (of_vt_ ? vt_mend() : "rest space; collapse or delete it"));
      clockwise[t] = turn < 0;
      if (clockwise[t]) std::swap(b, c);
    }
    const auto reversed = to_size(std::count(clockwise.begin(), clockwise.end(), 1));
    if (reversed == 0) return;
    mesh_.clockwise = of_clockwise_parts(mesh_, clockwise);
    note("clockwise triangles reversed: " + (reversed < all ? std::to_string(reversed) + " of " : "all ") +
         std::to_string(all));
  }

  /// Who reads vt as rest positions has to mend them, not the triangles.
  std::string vt_mend() const {
    return std::string("its vt, which are taken as rest positions; correct the vt or, if they are a texture, ") +
           (plane_of(mesh_).flat() ? "give --rest plane" : "give --rest space");
  }

  void check_overlaps() const {
    const std::optional<Overlap> overlap = find_overlap(mesh_);
    if (!overlap) return;
    std::ostringstream place;
    place << '(' << overlap->near.x << ", " << overlap->near.y << ')';
    fail(triangle_name(overlap->high) + " overlaps triangle " + std::to_string(overlap->low + 1) + " near " +
         place.str() + " in " +
         (of_vt_ ? "islands of " + vt_mend() : "rest space, where a sheet covers a place once; move the parts apart"));
  }

  /// Vertices with equal rest positions get the same number: a fold must not hide behind doubled vertices.
  void weld_by_rest() {
    auto before = [this](std::int32_t a, std::int32_t b) {
      const Point2 p = mesh_.rest[at(a)], q = mesh_.rest[at(b)];
      return p.x != q.x ? p.x < q.x : p.y < q.y;
    };
    std::vector<std::int32_t> order;
    for (std::size_t v = 0; v < mesh_.rest.size(); ++v)
      if (used_[v]) order.push_back(to_int32(v));
    std::sort(order.begin(), order.end(), before);
    welded_.assign(mesh_.rest.size(), -1);
    for (std::size_t i = 0; i < order.size(); ++i)
      welded_[at(order[i])] = i > 0 && !before(order[i - 1], order[i]) ? welded_[at(order[i - 1])] : order[i];
  }

  void check_duplicates() const {
    std::vector<std::pair<std::array<std::int32_t, 3>, std::size_t>> sorted;
    for (std::size_t t = 0; t < mesh_.triangles.size(); ++t) {
      auto [a, b, c] = mesh_.triangles[t];
      std::array<std::int32_t, 3> key{welded_[at(a)], welded_[at(b)], welded_[at(c)]};
      std::sort(key.begin(), key.end());
      sorted.push_back({key, t});
    }
    std::sort(sorted.begin(), sorted.end());
    for (std::size_t i = 1; i < sorted.size(); ++i)
      if (sorted[i].first == sorted[i - 1].first)
        fail(triangle_name(sorted[i].second) + " has the same rest corners as triangle " +
             std::to_string(sorted[i - 1].second + 1) + (of_vt_ ? " in " + vt_mend() : "; delete one of them"));
  }

  /// All half-edges sorted by edge; `number` gives the number a vertex goes by.
  template <class Number>
  std::vector<EdgeUse> edges(Number number) {
    std::vector<EdgeUse> result;
    for (std::size_t h = 0; h < corners(); ++h) {
      const std::int32_t a = number(vertex(h)), b = number(vertex(next_half_edge(h)));
      result.push_back({std::min(a, b), std::max(a, b), h, a < b});
    }
    std::sort(result.begin(), result.end(), [](const EdgeUse& p, const EdgeUse& q) {
      return std::tie(p.low, p.high, p.half_edge) < std::tie(q.low, q.high, q.half_edge);
    });
    return result;
  }

  void check_edges() {
    const std::vector<EdgeUse> uses = edges([this](std::int32_t v) { return welded_[at(v)]; });
    std::size_t inner_edges = 0, together = 0;
    for (std::size_t i = 1; i < uses.size(); ++i) {
      if (!uses[i].same_edge(uses[i - 1])) continue;
      if (i >= 2 && uses[i].same_edge(uses[i - 2]))
        fail("three triangles meet at the edge " + edge_name(uses[i]) + ": " + triangle_name(uses[i - 2].triangle()) +
             ", " + std::to_string(uses[i - 1].triangle() + 1) + " and " + std::to_string(uses[i].triangle() + 1) +
             "; a sheet has two at most: delete one");
      const bool third_follows = i + 1 < uses.size() && uses[i + 1].same_edge(uses[i]);
      if (!third_follows && uses[i].forward == uses[i - 1].forward)
        fail(triangle_name(uses[i].triangle()) + " overlaps triangle " + std::to_string(uses[i - 1].triangle() + 1) +
             " in rest space, on the same side of the edge " + edge_name(uses[i]) +
             (of_vt_ ? " in " + vt_mend() : "; unfold the rest positions"));
      ++inner_edges;
      together += vertex(uses[i].half_edge) == vertex(next_half_edge(uses[i - 1].half_edge));
    }
    if (inner_edges > 0 && together == 0)
      note("no two neighbouring triangles share vertices, so the sheet is read as cut open along all its " +
           std::to_string(inner_edges) + " inner edges; merge equal vertices if that isn't meant");
  }

  std::string edge_name(const EdgeUse& e) const {
    const Point2 a = mesh_.rest[at(e.low)], b = mesh_.rest[at(e.high)];
    std::ostringstream text;
    text << '(' << a.x << ", " << a.y << ")-(" << b.x << ", " << b.y << ')';
    return text.str();
  }

  /// Corners are joined across shared edges; the first fan at a vertex keeps it, every other gets a copy.
  void split_bow_ties() {
    const std::vector<EdgeUse> uses = edges([](std::int32_t v) { return v; });
    UnionFind fans(corners());  // corners that share a triangle fan
    for (std::size_t i = 1; i < uses.size(); ++i)
      if (uses[i].same_edge(uses[i - 1])) {
        fans.join(uses[i].half_edge, next_half_edge(uses[i - 1].half_edge));
        fans.join(next_half_edge(uses[i].half_edge), uses[i - 1].half_edge);
      }
    const std::size_t before = mesh_.rest.size();
    std::vector<bool> taken(before, false);
    for (std::size_t c = 0; c < corners(); ++c) {
      if (const std::size_t first = fans.find(c); first != c) {
        vertex(c) = vertex(first);
      } else if (const std::size_t v = at(vertex(c)); !taken[v]) {
        taken[v] = true;
      } else {
        vertex(c) = to_int32(mesh_.rest.size());
        mesh_.rest.push_back(Point2(mesh_.rest[v]));
        mesh_.deformed.push_back(Point3(mesh_.deformed[v]));
        mesh_.file_vertices.push_back(std::int32_t{mesh_.file_vertices[v]});
        if (!mesh_.sewn.empty()) mesh_.sewn.push_back(std::int32_t{mesh_.sewn[v]});
      }
    }
    used_.resize(mesh_.rest.size(), true);
    if (const std::size_t added = mesh_.rest.size() - before; added > 0)
      note("vertices added where triangles met in a point only: " + std::to_string(added));
  }

  void drop_unused_vertices() {
    std::vector<std::int32_t> number(used_.size(), -1);
    std::size_t kept = 0;
    for (std::size_t v = 0; v < used_.size(); ++v) {
      if (!used_[v]) continue;
      mesh_.rest[kept] = mesh_.rest[v];
      mesh_.deformed[kept] = mesh_.deformed[v];
      mesh_.file_vertices[kept] = mesh_.file_vertices[v];
      if (!mesh_.sewn.empty()) mesh_.sewn[kept] = mesh_.sewn[v];
      number[v] = to_int32(kept++);
    }
    mesh_.rest.resize(kept);
    mesh_.deformed.resize(kept);
    mesh_.file_vertices.resize(kept);
    if (!mesh_.sewn.empty()) mesh_.sewn.resize(kept);
    for (std::size_t c = 0; c < corners(); ++c) vertex(c) = number[at(vertex(c))];
    std::map<std::int32_t, std::int32_t> first;  // of those that are sewn together
    for (std::size_t v = 0; v < mesh_.sewn.size(); ++v)
      mesh_.sewn[v] = first.try_emplace(mesh_.sewn[v], to_int32(v)).first->second;
    if (kept < used_.size()) note("vertices without triangles dropped: " + std::to_string(used_.size() - kept));
  }

  MeshData& mesh_;
  const std::string& name_;
  bool of_vt_;
  std::vector<bool> used_;            ///< per vertex: it is a corner of a triangle
  std::vector<std::int32_t> welded_;  ///< per used vertex: one vertex number per rest position
};

std::string deviation_of(const FlatPlane& plane) {
  std::ostringstream off;
  off << plane.normal << " varies by " << plane.deviation << ", " << plane.deviation / plane.size
      << " of the mesh's size";
  return off.str();
}

void take_rest_from(const FlatPlane& plane, MeshData& mesh, const std::string& name) {
  if (!plane.flat())
    throw InputError(name + ": no rest positions: neither x, y nor z is constant (" + deviation_of(plane) +
                     "); give --rest space, use an OBJ with vt (rest positions), or flatten it");
  for (const Point3& p : mesh.deformed) mesh.rest.push_back(plane.rest_of(p));
  if (plane.normal == 'y')
    for (auto& triangle : mesh.triangles) std::swap(triangle[1], triangle[2]);
  const std::string nearly = plane.deviation > 0 ? ", nearly: " + deviation_of(plane) : "";
  if (plane.normal != 'z' || !nearly.empty())
    mesh.notes.push_back(name + ": rest positions are " + plane.text() + nearly);
}

}  // namespace

void take_rest_from_plane(MeshData& mesh, const std::string& name) { take_rest_from(plane_of(mesh), mesh, name); }

bool lies_in_space(const MeshData& mesh, RestFrom from) {
  return from == RestFrom::space || (from == RestFrom::automatic && !mesh.triangles.empty() && !plane_of(mesh).flat());
}

void take_rest(MeshData& mesh, const std::string& name, RestFrom from) {
  if (from == RestFrom::space) return unroll(mesh, name);
  const FlatPlane plane = plane_of(mesh);  // takes as long as a check: once
  if (from != RestFrom::automatic || mesh.triangles.empty() || plane.flat()) return take_rest_from(plane, mesh, name);
  unroll(mesh, name);
  if (plane.deviation <= hardly_flat * plane.size)
    mesh.notes.push_back(name + ": it is not flat: " + deviation_of(plane) +
                         "; up to 1e-06 is, so flatten it if it should be");
}

void check_and_repair(MeshData& mesh, const std::string& name, bool of_vt) { Repair(mesh, name, of_vt).run(); }

}  // namespace cutbench
