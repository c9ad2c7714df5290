#include "methods/tools/open_tips.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

/// A tip whose lips would be stiffer stays closed: of the shape function of a lip's vertex on the edge at which it
/// enters, the integral of the squared gradient over a triangle, times the squared weight of the phantom node there. It
/// grows without bound as the tip comes near the edge, or near the line through a bend of the path and the edge.
constexpr double most_stiffness = 3;

}  // namespace

/// A piece of an edge of the sheet along which a slit part is joined to one beyond the edge.
struct OpenTips::Piece {
  std::size_t part, far;    ///< far: the corner of its parent opposite the edge
  std::size_t i, j, group;  ///< group: of pieces without an incision between them
  HalfEdge h;
  bool operator<(const Piece& b) const { return std::tie(part, far, h) < std::tie(b.part, b.far, b.h); }
};

OpenTips::OpenTips(const Parts& parts, Rule rule) : parts_(parts), rule_(rule) {
  slit_.assign(parts_.size(), 0);
  if (rule == Rule::closed) return;
  find_slit_parts();
  std::vector<Piece> pieces;
  parts_.for_each_joint([&](std::size_t i, std::size_t j, HalfEdge h) {
    if (parts_.have_one_parent(i, j) || !is_slit(i)) return;
    for (std::size_t k = 0; k < 3; ++k)
      if (!parts_.corner_at(j, parts_.parent(i).vertex[k]))
        pieces.push_back({parts_.part(i), k, i, j, pieces.size(), h});
  });
  std::sort(pieces.begin(), pieces.end());
  for (auto first = pieces.begin(), last = first; first != pieces.end(); first = last) {
    last =
        std::find_if(first, pieces.end(), [&](const Piece& p) { return p.part != first->part || p.far != first->far; });
    open_edge({&*first, to_size(last - first)});
  }
  std::sort(apart_.begin(), apart_.end());
}

void OpenTips::find_slit_parts() {
  for (std::size_t i = 0; i < parts_.size(); ++i)
    for (int k = 0; k < 3; ++k)
      if (const HalfEdge h = half_edge(parts_.slot(i), k); parts_.cut().separates(h) && !parts_.cut().on_border(h))
        if (const std::size_t j = parts_.place_of(triangle_of(parts_.cut().opposite(h)));
            j < parts_.size() && parts_.part(i) == parts_.part(j))
          slit_[parts_.part(i)] = 1;
  for (std::size_t i = 0; i < parts_.size(); ++i)
    if (is_slit(i)) in_slit_parts_.push_back(i);
}

bool OpenTips::are_apart(HalfEdge h, VertexIndex end) const {
  return std::binary_search(apart_.begin(), apart_.end(), std::pair(h, end));
}

/// The pieces on the two sides of an incision that enters here have nothing in common. A copy of an end of the edge
/// goes along with the pieces next to it.
void OpenTips::open_edge(std::span<Piece> pieces) {
  for (std::size_t n = 0; n < pieces.size(); ++n)
    for (Piece& a : pieces)
      for (Piece& b : pieces)
        if (touch(a.h, b.h)) a.group = b.group = std::min(a.group, b.group);
  const auto c = parts_.before().corners(parts_.parent_slot(pieces[0].i));
  const std::size_t first = (pieces[0].far + 1) % 3, second = (first + 1) % 3;
  const std::array<Point2, 2> ends{c[first], c[second]};
  std::array<std::size_t, 2> group_at{};
  for (std::size_t e = 0; e < 2; ++e) {
    const auto distance = [&](const Piece& p) {
      return std::min(squared_length(parts_.cut().rest(parts_.cut().origin(p.h)) - ends[e]),
                      squared_length(parts_.cut().rest(parts_.cut().target(p.h)) - ends[e]));
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
          weight += std::sqrt(squared_length(parts_.cut().rest(parts_.cut().origin(h)) - ends[1 - e]) /
                              squared_length(ends[1] - ends[0]));
      if (parts_.is_new(parts_.cut().origin(h)) && !is_soft(p, deformed_origin(h), weight)) return;
    }
  for (const Piece& p : pieces)
    for (std::size_t e = 0; e < 2; ++e)
      if (p.group != group_at[e])
        for (const HalfEdge h : {p.h, parts_.cut().opposite(p.h)})
          apart_.emplace_back(h, parts_.parent(p.i).vertex[e == 0 ? first : second]);
}

bool OpenTips::is_soft(const Piece& p, DeformedIndex d, double weight) const {
  const double most = most_stiffness * (rule_ == Rule::open_for_lumped_mass ? share_of_parent(p.j) : 1);
  for (const std::size_t i : in_slit_parts_)
    for (std::size_t k = 0; k < 3; ++k) {
      if (parts_.part(i) != p.part || parts_.triangle(i).deformed[k] != d) continue;
      const auto c = parts_.cut().corners(parts_.slot(i));
      const double across = squared_length(c[(k + 2) % 3] - c[(k + 1) % 3]),
                   twice_area = cross(c[1] - c[0], c[2] - c[0]);
      if (weight * weight * across > most * 2 * twice_area) return false;
    }
  return true;
}

/// Of the area of its parent, that of the part of i.
double OpenTips::share_of_parent(std::size_t i) const {
  const auto twice_area = [](const std::array<Point2, 3>& c) { return cross(c[1] - c[0], c[2] - c[0]); };
  double sum = 0;
  for (std::size_t j = 0; j < parts_.size(); ++j)
    if (parts_.part(j) == parts_.part(i)) sum += twice_area(parts_.cut().corners(parts_.slot(j)));
  return sum / twice_area(parts_.before().corners(parts_.parent_slot(i)));
}

/// They have a vertex of the opened sheet in common.
bool OpenTips::touch(HalfEdge a, HalfEdge b) const {
  for (const HalfEdge from : {a, Sheet::next(a)})
    for (const HalfEdge to : {b, Sheet::next(b)})
      if (deformed_origin(from) == deformed_origin(to)) return true;
  return false;
}
DeformedIndex OpenTips::deformed_origin(HalfEdge h) const {
  return parts_.cut().triangle(triangle_of(h)).deformed[to_size(corner_of(h))];
}

}  // namespace cutbench
