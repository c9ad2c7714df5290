#include "methods/phantom_node/phantom_node.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <span>
#include <tuple>
#include <utility>

#include "harness/base/union_find.h"
#include "harness/mesh/tolerances.h"
#include "methods/tools/divided.h"
#include "methods/tools/static_split.h"

namespace cutbench {

namespace {

/// A tip whose lips would be stiffer stays closed: of the shape function of a lip's vertex on the edge at which it enters,
/// the integral of the squared gradient over a triangle, times the squared weight of the phantom node there. It grows
/// without bound as the tip comes near the edge, or near the line through a bend of the path and the edge.
constexpr double most_stiffness = 3;

class Doubling {
 public:
  Doubling(const Sheet& before, const Sheet& cut) : before_(before), cut_(cut) {
    find_triangles();
    join_parts();
    find_open_tips();
    join_copies();
  }

  Ties run(const PhantomNode::Options& options) {
    number_phantoms();
    Ties ties;
    ties.phantoms = phantoms_;
    if (options.ghost > 0) add_ghosts(options.ghost, ties.ghosts);
    std::vector<std::uint8_t> seen(vertices_.size());
    // The slit parts last: where a lip enters one, it goes along with the part that it comes from.
    for (const bool slit : {false, true})
      for (std::size_t i = 0; i < near_.size(); ++i)
        for (std::size_t k = 0; k < 3 && is_slit(i) == slit; ++k) {
          const DeformedIndex d = triangle(i).deformed[k];
          if (std::exchange(seen[number_of(d)], 1)) continue;
          if (is_new(triangle(i).vertex[k]))
            ties.ties.push_back(tie_of(d, i));
          else if (const DeformedIndex one = unknown(number_of(d)); one != d)
            ties.ties.push_back({d, {one, one, one}, {1, 0, 0}});
        }
    if (options.lumped_mass) lump(ties);
    return ties;
  }

 private:
  bool is_new(VertexIndex v) const { return cut_.is_newer(v, before_); }

  /// What cuts divided, and the triangles beside it.
  void find_triangles() {
    near_ = divided_triangles(before_, cut_);
    for (std::size_t i = 0, divided = near_.size(); i < divided; ++i)
      for (int k = 0; k < 3; ++k) {
        const HalfEdge h = half_edge(near_[i].part, k);
        if (cut_.separates(h)) continue;
        const TriangleIndex u = triangle_of(cut_.opposite(h));
        const auto& corners = cut_.triangle(u).vertex;
        if (std::none_of(corners.begin(), corners.end(), [&](VertexIndex v) { return is_new(v); }))
          near_.push_back({u, whole_parent(u, near_[i].parent)});
      }
    std::sort(near_.begin(), near_.end(), [](const auto& a, const auto& b) { return a.part < b.part; });
    const auto same = [](const auto& a, const auto& b) { return a.part == b.part; };
    near_.erase(std::unique(near_.begin(), near_.end(), same), near_.end());
    for (std::size_t i = 0; i < near_.size(); ++i)
      vertices_.insert(vertices_.end(), triangle(i).deformed.begin(), triangle(i).deformed.end());
    std::sort(vertices_.begin(), vertices_.end());
    vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
  }

  /// Its own slot, unless it was made anew beside one that was divided.
  TriangleIndex whole_parent(TriangleIndex t, TriangleIndex beside) const {
    if (t() < before_.triangle_slots() && before_.triangle(t).vertex == cut_.triangle(t).vertex) return t;
    const auto c = cut_.corners(t);
    return triangle_at(before_, beside, 1.0 / 3 * (c[0] + c[1] + c[2]));
  }

  const Triangle& triangle(std::size_t i) const { return cut_.triangle(near_[i].part); }
  const Triangle& parent(std::size_t i) const { return before_.triangle(near_[i].parent); }
  std::size_t number_of(DeformedIndex d) const {
    return static_cast<std::size_t>(std::lower_bound(vertices_.begin(), vertices_.end(), d) - vertices_.begin());
  }

  /// The corner of i's parent that is vertex v; none where it isn't one.
  std::optional<std::size_t> corner_at(std::size_t i, VertexIndex v) const {
    const auto& corners = parent(i).vertex;
    const auto found = std::find(corners.begin(), corners.end(), v);
    if (found == corners.end()) return {};
    return static_cast<std::size_t>(found - corners.begin());
  }
  /// The number of what i's part has at a corner of its parent. Numbers of vertices come first.
  std::size_t copy(std::size_t i, std::size_t corner) { return vertices_.size() + 3 * parts_.find(i) + corner; }

  template <class Visit>
  void for_each_joint(Visit visit) const {
    for (std::size_t i = 0; i < near_.size(); ++i)
      for (int k = 0; k < 3; ++k) {
        const HalfEdge h = half_edge(near_[i].part, k);
        if (cut_.separates(h)) continue;
        if (const std::size_t j = place_of(triangle_of(cut_.opposite(h))); j < near_.size()) visit(i, j, h);
      }
  }
  std::size_t place_of(TriangleIndex t) const {
    const auto found =
        std::lower_bound(near_.begin(), near_.end(), t, [](const auto& a, TriangleIndex b) { return a.part < b; });
    return found != near_.end() && found->part == t ? static_cast<std::size_t>(found - near_.begin()) : near_.size();
  }

  void join_parts() {
    parts_.reset(near_.size());
    for_each_joint([&](std::size_t i, std::size_t j, HalfEdge) {
      if (near_[i].parent == near_[j].parent) parts_.join(i, j);
    });
  }

  /// A piece of an edge of the sheet along which a slit part is joined to one beyond the edge.
  struct Piece {
    std::size_t part, far;    ///< far: the corner of its parent opposite the edge
    std::size_t i, j, group;  ///< group: of pieces without an incision between them
    HalfEdge h;
    bool operator<(const Piece& b) const { return std::tie(part, far, h) < std::tie(b.part, b.far, b.h); }
  };

  /// An incision ends in part i, which lies on both sides of it.
  bool is_slit(std::size_t i) { return slit_[parts_.find(i)] != 0; }

  /// Finds the edges at which incisions enter slit parts, and what must not be joined across them.
  void find_open_tips() {
    slit_.assign(near_.size(), 0);
    for (std::size_t i = 0; i < near_.size(); ++i)
      for (int k = 0; k < 3; ++k)
        if (const HalfEdge h = half_edge(near_[i].part, k); cut_.separates(h) && !cut_.on_border(h))
          if (const std::size_t j = place_of(triangle_of(cut_.opposite(h)));
              j < near_.size() && parts_.find(i) == parts_.find(j))
            slit_[parts_.find(i)] = 1;
    for (std::size_t i = 0; i < near_.size(); ++i)
      if (is_slit(i)) in_slit_parts_.push_back(i);
    std::vector<Piece> pieces;
    for_each_joint([&](std::size_t i, std::size_t j, HalfEdge h) {
      if (near_[i].parent == near_[j].parent || !is_slit(i)) return;
      for (std::size_t k = 0; k < 3; ++k)
        if (!corner_at(j, parent(i).vertex[k])) pieces.push_back({parts_.find(i), k, i, j, pieces.size(), h});
    });
    std::sort(pieces.begin(), pieces.end());
    for (auto first = pieces.begin(), last = first; first != pieces.end(); first = last) {
      last = std::find_if(first, pieces.end(),
                          [&](const Piece& p) { return p.part != first->part || p.far != first->far; });
      open_edge({first, last});
    }
    std::sort(apart_.begin(), apart_.end());
  }

  /// The pieces on the two sides of an incision that enters here have nothing in common. A copy of an end of the edge goes
  /// along with the pieces next to it.
  void open_edge(std::span<Piece> pieces) {
    for (std::size_t n = 0; n < pieces.size(); ++n)
      for (Piece& a : pieces)
        for (Piece& b : pieces)
          if (touch(a.h, b.h)) a.group = b.group = std::min(a.group, b.group);
    const auto c = before_.corners(near_[pieces[0].i].parent);
    const std::size_t first = (pieces[0].far + 1) % 3, second = (first + 1) % 3;
    const std::array<Point2, 2> ends{c[first], c[second]};
    std::array<std::size_t, 2> group_at{};
    for (std::size_t e = 0; e < 2; ++e) {
      const auto distance = [&](const Piece& p) {
        return std::min(squared_length(cut_.rest(cut_.origin(p.h)) - ends[e]),
                        squared_length(cut_.rest(cut_.target(p.h)) - ends[e]));
      };
      const auto next = std::min_element(pieces.begin(), pieces.end(),
                                         [&](const Piece& a, const Piece& b) { return distance(a) < distance(b); });
      group_at[e] = next->group;
    }
    for (const Piece& p : pieces)
      for (const HalfEdge h : {p.h, Sheet::next(p.h)}) {
        double weight = 0;
        for (std::size_t e = 0; e < 2; ++e)
          if (p.group != group_at[e])
            weight +=
                std::sqrt(squared_length(cut_.rest(cut_.origin(h)) - ends[1 - e]) / squared_length(ends[1] - ends[0]));
        if (is_new(cut_.origin(h)) && !is_soft(p.part, deformed_origin(h), weight)) return;
      }
    for (const Piece& p : pieces)
      for (std::size_t e = 0; e < 2; ++e)
        if (p.group != group_at[e])
          for (const HalfEdge h : {p.h, cut_.opposite(p.h)})
            apart_.emplace_back(h, parent(p.i).vertex[e == 0 ? first : second]);
  }

  bool is_soft(std::size_t part, DeformedIndex d, double weight) {
    for (const std::size_t i : in_slit_parts_)
      for (std::size_t k = 0; k < 3; ++k) {
        if (parts_.find(i) != part || triangle(i).deformed[k] != d) continue;
        const auto c = cut_.corners(near_[i].part);
        const double across = squared_length(c[(k + 2) % 3] - c[(k + 1) % 3]),
                     twice_area = cross(c[1] - c[0], c[2] - c[0]);
        if (weight * weight * across > most_stiffness * 2 * twice_area) return false;
      }
    return true;
  }

  /// They have a vertex of the opened sheet in common.
  bool touch(HalfEdge a, HalfEdge b) const {
    for (const HalfEdge from : {a, Sheet::next(a)})
      for (const HalfEdge to : {b, Sheet::next(b)})
        if (deformed_origin(from) == deformed_origin(to)) return true;
    return false;
  }
  DeformedIndex deformed_origin(HalfEdge h) const {
    return cut_.triangle(triangle_of(h)).deformed[static_cast<std::size_t>(corner_of(h))];
  }

  void join_copies() {
    copies_.reset(vertices_.size() + 3 * near_.size());
    for (std::size_t i = 0; i < near_.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        if (const auto corner = corner_at(i, triangle(i).vertex[k]))
          copies_.join(copy(i, *corner), number_of(triangle(i).deformed[k]));
    for_each_joint([&](std::size_t i, std::size_t j, HalfEdge h) {
      if (near_[i].parent == near_[j].parent) return;
      for (std::size_t k = 0; k < 3; ++k)
        if (const auto other = corner_at(j, parent(i).vertex[k]);
            other && !std::binary_search(apart_.begin(), apart_.end(), std::pair(h, parent(i).vertex[k])))
          copies_.join(copy(i, k), copy(j, *other));
    });
  }

  void number_phantoms() {
    phantom_.assign(3 * near_.size(), -1);
    for (std::size_t i = 0; i < near_.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t one = copies_.find(copy(i, k));
        if (one < vertices_.size()) continue;
        if (auto& number = phantom_[one - vertices_.size()]; number < 0)
          number = static_cast<std::int32_t>(phantoms_++);
      }
  }

  /// A third of the mass of each part to each copy of its parent's corners, where it is slit to those that its vertices
  /// depend on. Looks at the whole sheet.
  void lump(Ties& ties) {
    ties.lumped.assign(cut_.deformed_slots() + phantoms_, 0);
    std::vector<const Tie*> tie_of_vertex(vertices_.size());
    for (const Tie& tie : ties.ties) tie_of_vertex[number_of(tie.vertex)] = &tie;
    for (std::size_t slot = 0; slot < cut_.triangle_slots(); ++slot) {
      const TriangleIndex t(slot);
      if (!cut_.triangle(t).alive()) continue;
      const auto c = cut_.corners(t);
      const double share = std::max(0.0, cross(c[1] - c[0], c[2] - c[0])) / 6;
      const std::size_t i = place_of(t);
      for (std::size_t k = 0; k < 3; ++k) {
        const DeformedIndex d = cut_.triangle(t).deformed[k];
        if (i == near_.size())
          ties.lumped[whole_unknown(d)()] += share;
        else if (!is_slit(i))
          ties.lumped[unknown(copy(i, k))()] += share;
        else if (const Tie* const tie = tie_of_vertex[number_of(d)]; tie == nullptr)
          ties.lumped[d()] += share;
        else
          for (std::size_t l = 0; l < 3; ++l) ties.lumped[tie->masters[l]()] += share * std::max(0.0, tie->weights[l]);
      }
    }
  }

  /// Of a triangle away from all divided ones.
  DeformedIndex whole_unknown(DeformedIndex d) {
    const std::size_t number = number_of(d);
    return number < vertices_.size() && vertices_[number] == d ? unknown(number) : d;
  }

  /// Across every edge of the sheet at which two parts are joined, one of them of a divided parent.
  void add_ghosts(double factor, std::vector<GhostEdge>& ghosts) {
    std::vector<std::pair<TriangleIndex, std::size_t>> parts;  // with their parents
    for (std::size_t i = 0; i < near_.size(); ++i)
      if (parts_.find(i) == i) parts.emplace_back(near_[i].parent, i);
    std::sort(parts.begin(), parts.end());
    const auto is_divided = [&](std::size_t i) {
      const auto first = std::lower_bound(parts.begin(), parts.end(), std::pair(near_[i].parent, std::size_t{0}));
      return first + 1 != parts.end() && first[1].first == near_[i].parent;
    };
    std::set<std::pair<std::size_t, std::size_t>> done;
    for_each_joint([&](std::size_t i, std::size_t j, HalfEdge) {
      if (near_[i].parent == near_[j].parent || !(is_divided(i) || is_divided(j))) return;
      if (!done.insert(std::minmax(parts_.find(i), parts_.find(j))).second) return;
      const auto& corners = parent(i).vertex;
      for (std::size_t k = 0; k < 3; ++k)  // the corner of i's parent opposite the edge that both have
        if (!corner_at(j, corners[k]) && corner_at(j, corners[(k + 1) % 3]) && corner_at(j, corners[(k + 2) % 3]))
          ghosts.push_back(ghost_across(i, j, k, factor));
    });
  }

  GhostEdge ghost_across(std::size_t i, std::size_t j, std::size_t k, double factor) {
    const auto c = before_.corners(near_[i].parent), d = before_.corners(near_[j].parent);
    const Point2 a = c[(k + 1) % 3], edge = c[(k + 2) % 3] - a;
    const double length = std::sqrt(squared_length(edge));
    // A field that is 1 at the corner k alone has the slope 1 / height there, along the normal into the triangle; at
    // the ends of the edge it is what makes the field of all three constant.
    std::size_t far = 0;
    while (corner_at(i, parent(j).vertex[far])) ++far;
    const double slope_c = length / cross(edge, c[k] - a), slope_d = length / cross(edge, d[far] - a);  // signed
    const double foot_c = dot(c[k] - a, edge) / (length * length), foot_d = dot(d[far] - a, edge) / (length * length);
    // A slit part has a field for each lip here: its own copy of the corner k, and its neighbour's of the edge's ends.
    const auto end = [&](std::size_t corner) {
      return unknown(is_slit(i) ? copy(j, *corner_at(j, parent(i).vertex[corner])) : copy(i, corner));
    };
    GhostEdge ghost;
    ghost.unknown = {unknown(copy(i, k)), end((k + 1) % 3), end((k + 2) % 3), unknown(copy(j, far))};
    ghost.jump = {slope_c, (foot_c - 1) * slope_c - (foot_d - 1) * slope_d, foot_d * slope_d - foot_c * slope_c,
                  -slope_d};
    ghost.stiffness = factor * length * length, ghost.mass = ghost.stiffness * length * length;
    return ghost;
  }

  DeformedIndex unknown(std::size_t number) {
    const std::size_t one = copies_.find(number), vertices = vertices_.size();
    if (one < vertices) return vertices_[one];
    return DeformedIndex(cut_.deformed_slots() + static_cast<std::size_t>(phantom_[one - vertices]));
  }

  Tie tie_of(DeformedIndex d, std::size_t i) {
    const Point2 p = cut_.rest(cut_.rest_vertex(d));
    const auto c = before_.corners(near_[i].parent);
    const double twice = cross(c[1] - c[0], c[2] - c[0]);
    Tie tie{d, {}, {}};
    for (std::size_t k = 0; k < 3; ++k) {
      tie.masters[k] = unknown(copy(i, k));
      const Point2 from = c[(k + 1) % 3], to = c[(k + 2) % 3];
      const double area = cross(from - p, to - p);
      // A path that is no farther from an edge goes along it, so this is the rounding of a crossing.
      const bool on_edge = std::abs(area) <= rounding_tolerance * before_.snap() * std::sqrt(squared_length(to - from));
      tie.weights[k] = on_edge ? 0 : area / twice;
    }
    *std::max_element(tie.weights.begin(), tie.weights.end()) += 1 - (tie.weights[0] + tie.weights[1] + tie.weights[2]);
    return tie;
  }

  const Sheet &before_, &cut_;
  std::vector<DividedTriangle> near_;    // and undivided ones that are their own parents; a triangle is its place here
  std::vector<DeformedIndex> vertices_;  // of these triangles; a vertex's number is its place here
  UnionFind parts_;                      // of triangles of one parent
  UnionFind copies_;                     // of vertices, and three for the corners of the parent of each part
  std::vector<std::uint8_t> slit_;       // per part, at its first triangle
  std::vector<std::size_t> in_slit_parts_;
  std::vector<std::pair<HalfEdge, VertexIndex>> apart_;  // joints that do not join the copies of this end of their edge
  std::vector<std::int32_t> phantom_;                    // per copy that is no vertex: its number
  std::size_t phantoms_ = 0;
};

}  // namespace

void PhantomNode::embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) {
  notes.recovered_segments = embed_by_static_split(sheet, trace, patch_work_);
}

Ties PhantomNode::ties(const Sheet& before, const Sheet& cut) const { return Doubling(before, cut).run(options_); }

}  // namespace cutbench
