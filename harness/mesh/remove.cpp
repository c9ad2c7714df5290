// How triangles are taken out of the sheet for good.
#include <algorithm>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/mesh/one_ring.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

/// Each fan of what is left at v gets a vertex of its own, the first one v itself; each side of an incision that ends
/// in the fan gets deformed vertices of its own. \param outgoing edges  all that v had, counter-clockwise
void Sheet::mend_vertex(VertexIndex v, std::span<const HalfEdge> outgoing) {
  const auto stays = [&](HalfEdge h) { return triangle(triangle_of(h)).alive(); };
  const auto known = [&](HalfEdge h) { return triangle(triangle_of(h)).deformed[corner(h)]; };
  const auto holds = [](const std::vector<DeformedIndex>& all, DeformedIndex d) {
    return std::find(all.begin(), all.end(), d) != all.end();
  };
  std::vector<DeformedIndex> originals;
  for (const HalfEdge h : outgoing)
    if (!holds(originals, known(h))) originals.push_back(known(h));

  // Round an inner vertex a fan may go on past the last outgoing edge: begin behind a triangle that is gone.
  const auto gone = std::find_if_not(outgoing.begin(), outgoing.end(), stays);
  const auto begin = to_size(gone - outgoing.begin());
  VertexIndex mine;                                             // of the fan under way
  std::vector<DeformedIndex> taken, kept;                       // originals: by earlier sides, by the one under way
  std::vector<std::pair<DeformedIndex, DeformedIndex>> copies;  // of this side, where it can't have the originals
  bool has_fan = false;
  for (std::size_t i = 0; i < outgoing.size(); ++i) {
    const HalfEdge h = outgoing[(begin + i) % outgoing.size()];
    if (!stays(h)) continue;
    Triangle& t = at(triangle_of(h));
    if (on_border(h)) {  // a fan begins
      mine = std::exchange(has_fan, true) ? new_rest_vertex(rest(v)) : v;
      triangle_of_vertex_[mine()] = triangle_of(h);
    }
    if (on_border(h) || mark(h) == EdgeMark::incision) {  // a side
      taken.insert(taken.end(), kept.begin(), kept.end());
      kept.clear();
      copies.clear();
    }
    const DeformedIndex d = known(h);
    if (mine == v && !holds(taken, d)) {
      kept.push_back(d);
      continue;
    }
    auto copy = std::find_if(copies.begin(), copies.end(), [&](const auto& c) { return c.first == d; });
    if (copy == copies.end()) copy = copies.insert(copies.end(), {d, new_deformed(mine, {d, {}, {}}, {1, 0, 0})});
    touch(triangle_of(h));
    t.vertex[corner(h)] = mine;
    t.deformed[corner(h)] = copy->second;
  }
  taken.insert(taken.end(), kept.begin(), kept.end());
  if (!has_fan) free_vertex(v);
  for (const DeformedIndex d : originals)
    if (!holds(taken, d)) free_deformed(d);
}

void Sheet::remove(std::span<const TriangleIndex> removed) {
  struct Star {
    VertexIndex vertex;
    std::size_t first;  // of its outgoing edges
  };
  std::vector<Star> stars;
  std::vector<HalfEdge> outgoing;
  std::vector<std::uint8_t> met(vertex_slots());
  for (const TriangleIndex t : removed)
    for (const VertexIndex v : triangle(t).vertex) {
      if (std::exchange(met[v()], 1)) continue;
      stars.push_back({v, outgoing.size()});
      for (const HalfEdge h : outgoing_edges(*this, v)) outgoing.push_back(h);
    }
  for (const TriangleIndex t : removed) {
    touch(t);
    for (const HalfEdge o : triangle(t).opposite) {
      if (!o.valid()) continue;
      touch(triangle_of(o));
      at(triangle_of(o)).opposite[corner(o)] = {};
      at(triangle_of(o)).mark[corner(o)] = EdgeMark::none;
    }
    at(t).vertex[0] = {};
    freed_triangles_.push_back(t);
  }
  stars.push_back({{}, outgoing.size()});
  for (std::size_t i = 0; i + 1 < stars.size(); ++i)
    mend_vertex(stars[i].vertex, std::span(outgoing).subspan(stars[i].first, stars[i + 1].first - stars[i].first));
}

}  // namespace cutbench
