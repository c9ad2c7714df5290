#include "harness/path/subdivision.h"

#include <algorithm>
#include <cmath>

#include "harness/base/conversions.h"

namespace cutbench {

void Subdivision::reset(const Sheet& sheet) {
  sheet_ = &sheet;
  nodes.clear();
  segments.clear();
  along.clear();
  faces.clear();
  face_of_.clear(sheet.triangle_slots());
  node_at_.clear(sheet.vertex_slots());
}

std::size_t Subdivision::crossed_triangles() const {
  return to_size(std::count_if(faces.begin(), faces.end(), [](const Face& f) { return f.segments >= 0; }));
}

int Subdivision::face_of(TriangleIndex t) {
  if (face_of_.insert(t, to_int(faces.size()))) faces.emplace_back().triangle = t;
  return face_of_.at(t);
}

int Subdivision::node_of(const Place& place, double merging_distance) {
  if (place.kind == Place::Kind::edge) return node_on_edge(place, merging_distance);
  if (place.kind == Place::Kind::face) return node_inside(place, merging_distance);
  if (node_at_.insert(place.vertex, to_int(nodes.size()))) nodes.push_back({place, place.vertex, -1});
  return node_at_.at(place.vertex);
}

int Subdivision::node_on_edge(Place place, double merging_distance) {
  if (const HalfEdge h = first_half_edge(*sheet_, place.edge); h != place.edge) {
    place.edge = h;
    place.lambda = 1 - place.lambda;
  }
  const HalfEdge o = sheet_->opposite(place.edge);
  const int left = face_of(triangle_of(place.edge)), right = o.valid() ? face_of(triangle_of(o)) : -1;
  int& head = face(left).on_edge[to_size(corner_of(place.edge))];
  int before = -1, after = head;
  for (; after >= 0; before = after, after = node(after).next) {
    if (within(node(after).place.point, place.point, merging_distance)) return after;
    if (node(after).place.lambda > place.lambda) break;
  }
  const int made = to_int(nodes.size());
  nodes.push_back({place, {}, after});
  if (before >= 0)
    nodes[to_size(before)].next = made;
  else
    head = made;
  ++face(left).edge_nodes;
  if (right >= 0) {
    face(right).on_edge[to_size(corner_of(o))] = head;
    ++face(right).edge_nodes;
  }
  return made;
}

int Subdivision::node_inside(const Place& place, double merging_distance) {
  int& head = face(face_of(place.face)).inside;
  for (int i = head; i >= 0; i = node(i).next)
    if (within(node(i).place.point, place.point, merging_distance)) return i;
  nodes.push_back({place, {}, head});
  return head = to_int(nodes.size() - 1);
}

void Subdivision::add_segment(int f, int from, int to) {
  if (from == to) return;
  segments.push_back({from, to, face(f).segments});
  face(f).segments = to_int(segments.size() - 1);
}

void Subdivision::add_along(int from, int to, HalfEdge edge) {
  if (from != to) along.push_back({from, to, first_half_edge(*sheet_, edge)});
}

int Subdivision::first_on(HalfEdge first) const {
  const int f = find_face(triangle_of(first));
  return f >= 0 ? face(f).on_edge[to_size(corner_of(first))] : -1;
}

std::vector<int> Subdivision::nodes_along(const Along& piece) const {
  const Point2 from = node(piece.from).place.point, line = node(piece.to).place.point - from;
  const auto progress = [&](int n) { return dot(node(n).place.point - from, line); };
  std::vector<int> all{piece.from};
  for (int n = first_on(piece.edge); n >= 0; n = node(n).next)
    if (n != piece.from && n != piece.to && progress(n) > 0 && progress(n) < squared_length(line)) all.push_back(n);
  if (all.size() > 2 && progress(all[1]) > progress(all[2])) std::reverse(all.begin() + 1, all.end());
  all.push_back(piece.to);
  return all;
}

}  // namespace cutbench
