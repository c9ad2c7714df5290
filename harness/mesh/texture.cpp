#include "harness/mesh/texture.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/number_from_chars.h"
#include "harness/mesh/mesh_text.h"
#include "harness/mesh/row_numbers.h"

namespace cutbench {

namespace {

/// Triangles that are looked at for one that has a new vertex, beside that of the new triangle: more than there are at
/// a vertex of any sensible sheet.
constexpr std::size_t most_searched = 200;

std::size_t after(std::size_t k) { return to_size(next_corner(to_int(k))); }

class Carrier {
 public:
  Carrier(const Texture& texture, const Sheet& before, const Sheet& cut, const Parents& parents)
      : texture_(texture), before_(before), cut_(cut), parents_(parents), row_(before) {}

  std::array<Point2, 3> corners_of(TriangleIndex t) const {
    const TriangleIndex old = parents_.triangles[t()];
    std::array<Point2, 3> result;
    for (std::size_t k = 0; k < 3; ++k) {
      const DeformedIndex vertex = cut_.triangle(t).deformed[k];
      const auto& parts = parents_.vertices[vertex()];
      const std::optional<TriangleIndex> holder = holder_of(parts, old);
      result[k] = holder ? mean(parts, *holder) : beyond(old, cut_.rest(cut_.rest_vertex(vertex)));
    }
    return result;
  }

 private:
  const std::array<Point2, 3>& of(TriangleIndex old) const { return texture_[to_size(row_.triangle[old()])]; }

  std::optional<std::size_t> corner_at(TriangleIndex old, DeformedIndex vertex) const {
    const auto& corner = before_.triangle(old).deformed;
    for (std::size_t k = 0; k < 3; ++k)
      if (corner[k] == vertex) return k;
    return {};
  }

  bool has_all(TriangleIndex old, const std::vector<VertexPart>& parts) const {
    return std::all_of(parts.begin(), parts.end(),
                       [&](const VertexPart& part) { return corner_at(old, part.vertex).has_value(); });
  }

  /// Is the texture the same on both sides of h, an old edge?
  bool goes_on(HalfEdge h) const {
    const HalfEdge o = before_.opposite(h);
    if (!o.valid()) return false;
    const TriangleIndex here = triangle_of(h), there = triangle_of(o);
    const std::size_t k = to_size(corner_of(h)), l = to_size(corner_of(o));
    const auto &mine = before_.triangle(here).deformed, &other = before_.triangle(there).deformed;
    return mine[k] == other[after(l)] && mine[after(k)] == other[l] && of(here)[k] == of(there)[after(l)] &&
           of(here)[after(k)] == of(there)[l];
  }

  /// The old triangle that has all of `parts`, the first one from `start` on without a step over a seam.
  std::optional<TriangleIndex> holder_of(const std::vector<VertexPart>& parts, TriangleIndex start) const {
    std::vector<TriangleIndex> reached{start};
    for (std::size_t i = 0; i < reached.size() && i < most_searched; ++i) {
      const TriangleIndex here = reached[i];
      if (has_all(here, parts)) return here;
      for (int k = 0; k < 3; ++k) {
        const HalfEdge h = half_edge(here, k);
        if (!goes_on(h)) continue;
        const TriangleIndex there = triangle_of(before_.opposite(h));
        if (std::find(reached.begin(), reached.end(), there) == reached.end()) reached.push_back(there);
      }
    }
    return {};
  }

  Point2 mean(const std::vector<VertexPart>& parts, TriangleIndex old) const {
    if (parts.size() == 1) return of(old)[*corner_at(old, parts[0].vertex)];
    Point2 sum;
    for (const VertexPart& part : parts) sum = sum + part.weight * of(old)[*corner_at(old, part.vertex)];
    return sum;
  }

  /// The linear coordinates of `old` at p, which lies outside of it.
  Point2 beyond(TriangleIndex old, Point2 p) const {
    const auto c = before_.corners(old);
    const double area2 = cross(c[1] - c[0], c[2] - c[0]);
    Point2 sum;
    for (std::size_t k = 0; k < 3; ++k) sum = sum + cross(c[after(k)] - p, c[after(after(k))] - p) / area2 * of(old)[k];
    return sum;
  }

  const Texture& texture_;
  const Sheet &before_, &cut_;
  const Parents& parents_;
  const RowNumbers row_;  ///< of `before`
};

/// Numbers from 1, in the order of what comes first.
class Numbers {
 public:
  std::size_t of(Point2 p) {
    const auto [entry, is_new] = number_.try_emplace({p.x, p.y}, number_.size() + 1);
    if (is_new) in_order_.push_back(p);
    return entry->second;
  }
  const std::vector<Point2>& in_order() const { return in_order_; }

 private:
  std::map<std::pair<double, double>, std::size_t> number_;
  std::vector<Point2> in_order_;
};

std::string number(double value) {
  char digits[32];
  return {digits, number_to_chars(digits, digits + sizeof digits, value)};
}

std::string line(const char* keyword, Point2 p) { return keyword + (number(p.x) + ' ') + number(p.y) + '\n'; }

}  // namespace

Texture carried_over(const Texture& texture, const Sheet& before, const Sheet& cut, const Parents& parents) {
  Texture result;
  if (texture.empty()) return result;
  const Carrier carrier(texture, before, cut, parents);
  for (std::size_t t = 0; t < cut.triangle_slots(); ++t)
    if (cut.triangle(TriangleIndex(t)).alive()) result.push_back(carrier.corners_of(TriangleIndex(t)));
  return result;
}

std::vector<Point2> texture_of_vertices(const MeshData& mesh, const Texture& texture) {
  if (texture.empty()) return {};
  std::vector<Point2> result(mesh.deformed.size());
  std::vector<bool> known(mesh.deformed.size(), false);
  for (std::size_t t = 0; t < texture.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = to_size(mesh.triangles[t][k]);
      if (known[v] && result[v] != texture[t][k]) return {};
      known[v] = true;
      result[v] = texture[t][k];
    }
  return result;
}

std::string textured_obj_text(const MeshData& mesh, const Texture& texture) {
  const ObjPoints points = obj_points(mesh);
  std::string text = std::string(vt_are_texture) + '\n' + points.lines;
  Numbers numbers;
  std::string faces;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    std::string rest = "#fr";
    faces += 'f';
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = to_size(mesh.triangles[t][k]);
      faces += ' ' + std::to_string(points.number[v]) + '/' + std::to_string(numbers.of(texture[t][k]));
      rest += ' ' + std::to_string(v + 1);
    }
    faces += '\n' + rest + '\n';
  }
  for (const Point2 p : numbers.in_order()) text += line("vt ", p);
  for (const Point2 p : mesh.rest) text += line("#vr ", p);
  return text + faces;
}

}  // namespace cutbench
