#include "harness/mesh/rest_choice.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "harness/base/conversions.h"
#include "harness/mesh/parts_at_rest.h"

namespace cutbench {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

double coordinate(const Point3& p, char axis) { return axis == 'x' ? p.x : axis == 'y' ? p.y : p.z; }

bool in_range(const MeshData& mesh, const std::array<std::int32_t, 3>& triangle) {
  return std::all_of(triangle.begin(), triangle.end(), [&](std::int32_t v) {
    return v >= 0 && v < std::ssize(mesh.deformed) && v < std::ssize(mesh.rest);
  });
}

/// The finite coordinate that comes first; NaN: there is none.
double first_of(const MeshData& mesh, char axis) {
  for (const auto& triangle : mesh.triangles)
    for (std::int32_t v : triangle) {
      if (v < 0 || v >= std::ssize(mesh.deformed)) continue;
      const double c = coordinate(mesh.deformed[to_size(v)], axis);
      if (std::isfinite(c)) return c + 0.0;  // -0 is 0
    }
  return std::numeric_limits<double>::quiet_NaN();
}

std::string digits(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// The `vt` are where the plane's coordinates are, to the digits of files.
bool agrees(const MeshData& mesh, const FlatPlane& plane) {
  const double near = isometry_tolerance * plane.size;
  for (const auto& triangle : mesh.triangles)
    for (std::int32_t v : triangle) {
      const Point2 vt = mesh.rest[to_size(v)], flat = plane.rest_of(mesh.deformed[to_size(v)]);
      if (std::abs(vt.x - flat.x) > near || std::abs(vt.y - flat.y) > near) return false;
    }
  return true;
}

}  // namespace

double Stretch::strain() const { return std::max(std::abs(largest - 1), std::abs(smallest - 1)); }

Stretch stretch_of(const std::array<Point2, 3>& rest, const std::array<Point3, 3>& deformed) {
  const Point2 u = rest[1] - rest[0], v = rest[2] - rest[0];
  const Point3 p = deformed[1] + -1.0 * deformed[0], q = deformed[2] + -1.0 * deformed[0];
  const double area2 = cross(u, v);
  const Point3 x = (1 / area2) * (v.y * p + -u.y * q), y = (1 / area2) * (u.x * q + -v.x * p);  // the columns of F
  const auto dot = [](Point3 s, Point3 t) { return s.x * t.x + s.y * t.y + s.z * t.z; };
  const double mean = (dot(x, x) + dot(y, y)) / 2, spread = std::hypot((dot(x, x) - dot(y, y)) / 2, dot(x, y));
  return {std::sqrt(mean + spread), std::sqrt(std::max(0.0, mean - spread))};
}

Stretch stretch_of(const MeshData& mesh, const std::array<std::int32_t, 3>& triangle) {
  std::array<Point2, 3> rest;
  std::array<Point3, 3> deformed;
  for (std::size_t k = 0; k < 3; ++k) {
    rest[k] = mesh.rest[to_size(triangle[k])];
    deformed[k] = mesh.deformed[to_size(triangle[k])];
  }
  return stretch_of(rest, deformed);
}

bool Stretches::isometric() const {
  return measured && least >= 1 - isometry_tolerance && most <= 1 + isometry_tolerance;
}

std::string Stretches::text() const {
  const std::string low = digits("%.3g", least), high = digits("%.3g", most);
  return (low == high ? low : low + " to " + high) + " times";
}

namespace {

/// Takes stretches one by one.
class Gathered {
 public:
  void add(const Stretch& s) {
    ++count_;
    if (!std::isfinite(s.largest) || !std::isfinite(s.smallest)) {
      measured_ = false;
      return;
    }
    low_ = {std::min(low_.largest, s.largest), std::min(low_.smallest, s.smallest)};
    high_ = {std::max(high_.largest, s.largest), std::max(high_.smallest, s.smallest)};
    least_strain_ = std::min(least_strain_, s.strain());
  }
  std::size_t count() const { return count_; }
  double least_strain() const { return least_strain_; }  ///< of the triangle that is nearest to its shape at rest
  Stretches all() const {
    const auto same = [](double a, double b) { return b - a <= isometry_tolerance * b; };
    const bool even = same(low_.largest, high_.largest) && same(low_.smallest, high_.smallest);
    return {low_.smallest, high_.largest, measured_ && count_ > 0, even};
  }

 private:
  Stretch low_{infinity, infinity}, high_{0, 0};
  double least_strain_ = infinity;
  bool measured_ = true;
  std::size_t count_ = 0;
};

Stretch stretch_if_in_range(const MeshData& mesh, const std::array<std::int32_t, 3>& triangle) {
  return in_range(mesh, triangle) ? stretch_of(mesh, triangle) : Stretch{infinity, infinity};
}

/// Is there a part, of those that hang together in the `vt`, whose stretches are those of a texture?
/// \pre all corners are in range
bool any_part_is_texture(const MeshData& mesh, bool flat) {
  UnionFind joined = parts_at_rest(mesh);
  std::vector<Gathered> parts(mesh.rest.size());
  for (const auto& triangle : mesh.triangles)
    parts[joined.find(to_size(triangle[0]))].add(stretch_if_in_range(mesh, triangle));
  return std::any_of(parts.begin(), parts.end(), [&](const Gathered& part) {
    if (part.count() < fewest_of_a_part) return false;
    const Stretches s = part.all();
    return !s.isometric() && (s.even || (!flat && part.least_strain() > unstrained));
  });
}

}  // namespace

Stretches stretches_of(const MeshData& mesh) {
  Gathered all;
  for (const auto& triangle : mesh.triangles) all.add(stretch_if_in_range(mesh, triangle));
  return all.all();
}

bool FlatPlane::flat() const { return deviation <= flatness_tolerance * size; }

std::array<char, 2> FlatPlane::axes() const {
  if (normal == 'z') return {'x', 'y'};
  return {normal == 'y' ? 'x' : 'y', 'z'};
}

Point2 FlatPlane::rest_of(const Point3& p) const {
  const auto [x, y] = axes();
  return {coordinate(p, x), coordinate(p, y)};
}

std::string FlatPlane::text() const {
  const auto [x, y] = axes();
  return std::string("the plane ") + normal + " = " + digits("%.6g", at) + ", with " + x + " and " + y + " as x and y";
}

FlatPlane plane_of(const MeshData& mesh) {
  std::vector<std::uint8_t> used(mesh.deformed.size(), 0);
  for (const auto& triangle : mesh.triangles)
    for (std::int32_t v : triangle)
      if (v >= 0 && v < std::ssize(used)) used[to_size(v)] = 1;
  std::optional<FlatPlane> best;
  std::array<double, 3> widths{};
  for (std::size_t i = 0; i < 3; ++i) {
    const char axis = "zyx"[i];
    double low = infinity, high = -infinity;
    for (std::size_t v = 0; v < used.size(); ++v) {
      const double c = coordinate(mesh.deformed[v], axis);
      if (!used[v] || !std::isfinite(c)) continue;
      low = std::min(low, c);
      high = std::max(high, c);
    }
    widths[i] = high > low ? high - low : 0;
    if (!best || widths[i] < best->deviation) best = FlatPlane{axis, first_of(mesh, axis), widths[i], 0};
  }
  best->size = std::hypot(widths[0], widths[1], widths[2]);
  return *best;
}

RestDecision decide_rest(const MeshData& mesh) {
  const Stretches s = stretches_of(mesh);
  const FlatPlane plane = plane_of(mesh);
  const bool moderate = s.measured && s.least >= 1 / largest_stretch && s.most <= largest_stretch;
  const std::string lengths = "lengths in space are " + s.text() + " those in the vt";
  if (!plane.flat() && s.isometric()) return {true, ""};
  const bool can_be = moderate && !s.isometric() && !any_part_is_texture(mesh, plane.flat());
  if (!plane.flat()) {
    if (can_be && s.least >= 1 - worth_a_word && s.most <= 1 + worth_a_word) return {true, ""};
    if (can_be)
      return {true, "rest positions are the vt, as of a sheet that hangs: " + lengths +
                        "; if they are a texture, give --rest space"};
    const std::string why = s.measured ? lengths : "some triangles have no area in the vt";
    return {false, "the vt are taken for a texture: " + why + "; --rest vt takes the vt"};
  }
  const bool isometric = s.isometric();
  if (isometric && agrees(mesh, plane)) return {true, ""};
  if (isometric)
    return {true, "rest positions are the vt: " + lengths + ", but they are not " + plane.text() +
                      "; --rest plane takes these"};
  if (can_be)
    return {true, "rest positions are the vt, as of a sheet that is stretched in its plane: " + lengths +
                      "; if they are a texture, give --rest plane"};
  const std::string why = s.measured ? lengths : "some triangles have no area in the vt, but the mesh is flat";
  return {false, "the vt are taken for a texture: " + why + "; rest positions are " + plane.text() +
                     "; --rest vt takes the vt"};
}

}  // namespace cutbench
