// A sheet from plain arrays, back to plain arrays, and without its freed slots.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <set>
#include <unordered_map>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/union_find.h"
#include "harness/mesh/sheet.h"
#include "harness/mesh/tolerances.h"

namespace cutbench {

namespace {

/// std::bit_cast, which libc++ has from version 14 on.
std::uint64_t bits_of(double x) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}

struct RestEdge {
  Point2 a, b;
  bool operator==(const RestEdge&) const = default;
};

struct RestEdgeHash {
  std::size_t operator()(const RestEdge& e) const {
    std::uint64_t hash = 0;
    for (double c : {e.a.x, e.a.y, e.b.x, e.b.y}) {
      hash = (hash ^ bits_of(c + 0.0)) * 0x9E3779B97F4A7C15u;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

double ulp(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()) - x; }

}  // namespace

Sheet::Sheet(const MeshData& data) {
  const std::size_t n = data.triangles.size();
  auto rest_of = [&](std::int32_t v) { return data.rest[to_size(v)]; };
  triangles_.resize(n);

  // Neighbours through shared vertices.
  EdgeTable edges;
  edges.reset(3 * n);
  for (std::size_t t = 0; t < n; ++t)
    for (int k = 0; k < 3; ++k) {
      const auto a = data.triangles[t][to_size(k)];
      const auto b = data.triangles[t][to_size(next_corner(k))];
      const HalfEdge h = half_edge(TriangleIndex(t), k);
      triangles_[t].deformed[corner(h)] = DeformedIndex(to_size(a));
      const HalfEdge o = edges.pair_or_insert(VertexIndex(to_size(a)), VertexIndex(to_size(b)), h);
      triangles_[t].opposite[corner(h)] = o;
      if (o.valid()) at(triangle_of(o)).opposite[corner(o)] = h;
    }

  // The lips of an incision: border edges with bit-equal ends in opposite directions.
  UnionFind welded(data.rest.size());
  std::unordered_map<RestEdge, HalfEdge, RestEdgeHash> lips;
  for (std::size_t t = 0; t < n; ++t)
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(TriangleIndex(t), k);
      if (triangles_[t].opposite[corner(h)].valid()) continue;
      const auto a = data.triangles[t][corner(h)], b = data.triangles[t][to_size(next_corner(k))];
      const auto other = lips.find({rest_of(b), rest_of(a)});
      if (other == lips.end()) {
        lips.emplace(RestEdge{rest_of(a), rest_of(b)}, h);
        continue;
      }
      const HalfEdge o = other->second;
      lips.erase(other);
      triangles_[t].opposite[corner(h)] = o;
      at(triangle_of(o)).opposite[corner(o)] = h;
      triangles_[t].mark[corner(h)] = at(triangle_of(o)).mark[corner(o)] = EdgeMark::incision;
      const auto& twin = data.triangles[triangle_of(o)()];
      welded.join(a, twin[to_size(next_corner(corner_of(o)))]);
      welded.join(b, twin[corner(o)]);
    }

  vertex_of_deformed_.resize(data.rest.size());
  for (std::size_t d = 0; d < data.rest.size(); ++d) {
    const auto representative = welded.find(d);
    if (representative == d) rest_.push_back(data.rest[d]);
    vertex_of_deformed_[d] = representative == d ? VertexIndex(rest_.size() - 1) : vertex_of_deformed_[representative];
  }
  triangle_of_vertex_.resize(rest_.size());
  born_in_.resize(rest_.size());
  for (std::size_t t = 0; t < n; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      triangles_[t].vertex[k] = vertex_of_deformed_[triangles_[t].deformed[k]()];
      triangle_of_vertex_[triangles_[t].vertex[k]()] = TriangleIndex(t);
    }
  position_ = data.deformed;

  double total = 0, count = 0, largest = 0;
  Point2 low{1e300, 1e300}, high{-1e300, -1e300};
  for (const Triangle& t : triangles_)
    for (std::size_t k = 0; k < 3; ++k) {
      const Point2 a = rest(t.vertex[k]), b = rest(t.vertex[k == 2 ? 0 : k + 1]);
      low = {std::min(low.x, a.x), std::min(low.y, a.y)};
      high = {std::max(high.x, a.x), std::max(high.y, a.y)};
      largest = std::max({largest, std::abs(a.x), std::abs(a.y)});
      const double share = t.opposite[k].valid() ? 0.5 : 1;  // an inner edge is met twice
      total += share * length(b - a);
      count += share;
    }
  mean_edge_ = total / count;
  size_ = length(high - low);
  snap_ = snap_distance(size_, ulp(largest));
  if (!data.sewn.empty()) take_seams(data);
  unrolled_ = data.unrolled;
}

void Sheet::take_seams(const MeshData& data) {
  auto seams = seams_of(data);
  if (seams.empty()) return;
  std::set<std::pair<double, double>> ends;
  for (const Seam& seam : seams)
    for (const auto& side : {seam.first, seam.second})
      for (const Point2 p : side) ends.emplace(p.x, p.y);
  for (std::size_t v = 0; v < rest_.size(); ++v)
    if (ends.contains({rest_[v].x, rest_[v].y})) hold(VertexIndex(v));
  seams_ = std::make_shared<const std::vector<Seam>>(std::move(seams));
}

MeshData Sheet::to_mesh_data() const {
  MeshData data;
  std::vector<std::int32_t> number(position_.size(), -1);
  for (std::size_t d = 0; d < position_.size(); ++d) {
    if (!vertex_of_deformed_[d].valid()) continue;
    number[d] = to_int32(data.rest.size());
    data.rest.push_back(rest(vertex_of_deformed_[d]));
    data.deformed.push_back(position_[d]);
  }
  for (const Triangle& t : triangles_)
    if (t.alive())
      data.triangles.push_back({number[t.deformed[0]()], number[t.deformed[1]()], number[t.deformed[2]()]});
  data.unrolled = unrolled_;
  if (!seams_) return data;
  data.sewn.resize(data.rest.size());
  std::iota(data.sewn.begin(), data.sewn.end(), 0);
  for (const SeamTie& tie : seam_ties(*this))
    if (tie.weights[0] == 1) data.sewn[to_size(number[tie.vertex()])] = number[tie.masters[0]()];
  return data;
}

namespace {

/// Keeps the entries of `data` that are alive, in order, and returns where each went.
template <class Index, class Alive>
std::vector<Index> renumber(std::size_t n, Alive alive) {
  std::vector<Index> map(n);
  std::size_t next = 0;
  for (std::size_t i = 0; i < n; ++i)
    if (alive(i)) map[i] = Index(next++);
  return map;
}

template <class Index, class T>
void keep(std::vector<T>& data, const std::vector<Index>& map) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < data.size(); ++i)
    if (map[i].valid()) {
      data[map[i]()] = data[i];
      ++kept;
    }
  data.resize(kept);
}

}  // namespace

Sheet::Compaction Sheet::compact() {
  begin_cut();
  Compaction map{
      renumber<TriangleIndex>(triangles_.size(), [&](std::size_t i) { return triangles_[i].alive(); }),
      renumber<VertexIndex>(rest_.size(), [&](std::size_t i) { return triangle_of_vertex_[i].valid(); }),
      renumber<DeformedIndex>(position_.size(), [&](std::size_t i) { return vertex_of_deformed_[i].valid(); })};
  keep(triangles_, map.triangles);
  held_.resize(rest_.size());
  keep(held_, map.vertices);
  keep(rest_, map.vertices);
  keep(triangle_of_vertex_, map.vertices);
  keep(born_in_, map.vertices);
  keep(position_, map.deformed);
  keep(vertex_of_deformed_, map.deformed);
  for (Triangle& t : triangles_)
    for (std::size_t k = 0; k < 3; ++k) {
      t.vertex[k] = map.vertices[t.vertex[k]()];
      t.deformed[k] = map.deformed[t.deformed[k]()];
      if (const HalfEdge o = t.opposite[k]; o.valid())
        t.opposite[k] = half_edge(map.triangles[triangle_of(o)()], corner_of(o));
    }
  for (auto& t : triangle_of_vertex_) t = map.triangles[t()];
  for (auto& v : vertex_of_deformed_) v = map.vertices[v()];
  free_triangles_.clear();
  free_vertices_.clear();
  free_deformed_.clear();
  begin_cut();
  return map;
}

}  // namespace cutbench
