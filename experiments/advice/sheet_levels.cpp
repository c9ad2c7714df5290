#include "experiments/advice/sheet_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/errors.h"
#include "harness/mesh/families.h"

namespace cutbench {

namespace {

constexpr double edges_in_a_cut = 2;  // at least

using Edge = std::pair<std::int32_t, std::int32_t>;

/// Edges with a triangle on one side alone.
std::map<Edge, int> uses_of_edges(const MeshData& mesh) {
  std::map<Edge, int> uses;
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) ++uses[std::minmax({t[k], t[(k + 1) % 3]})];
  return uses;
}

/// The middles of edges: vertices of the refined mesh.
class Middles {
 public:
  Middles(const MeshData& coarse, MeshData& fine) : coarse_(coarse), fine_(fine), uses_(uses_of_edges(coarse)) {}

  std::int32_t of(std::int32_t a, std::int32_t b) {
    const Edge edge = std::minmax(a, b);
    const auto [place, is_new] = middles_.try_emplace(edge, to_int32(fine_.rest.size()));
    if (!is_new) return place->second;
    fine_.rest.push_back(0.5 * (coarse_.rest[to_size(a)] + coarse_.rest[to_size(b)]));
    fine_.deformed.push_back(0.5 * (coarse_.deformed[to_size(a)] + coarse_.deformed[to_size(b)]));
    if (!fine_.sewn.empty()) fine_.sewn.push_back(sewn_of(edge, place->second));
    return place->second;
  }

 private:
  /// Those of two edges of the border are sewn where both their ends are.
  std::int32_t sewn_of(const Edge& edge, std::int32_t middle) {
    if (uses_.at(edge) > 1) return middle;
    const Edge ends = std::minmax({coarse_.sewn[to_size(edge.first)], coarse_.sewn[to_size(edge.second)]});
    return by_ends_.try_emplace(ends, middle).first->second;
  }

  const MeshData& coarse_;
  MeshData& fine_;
  std::map<Edge, int> uses_;
  std::map<Edge, std::int32_t> middles_, by_ends_;
};

/// Width of a closed curve's box, or length of an open one's chord polygon. Infinite without points at rest.
double size_of(const Scene::Cut& cut) {
  std::vector<Point3> points;
  for (const Point2 p : cut.curve.points) points.push_back({p.x, p.y, 0});
  bool closed = cut.curve.closed;
  for (const Pick& pick : cut.picked.picks) {
    if (pick.direction) return std::numeric_limits<double>::infinity();
    points.push_back(pick.origin);
    closed = cut.picked.closed;
  }
  if (points.size() < 2) return std::numeric_limits<double>::infinity();
  double along = 0;
  Point3 low = points[0], high = points[0];
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point3 p = points[i];
    along += length(p + -1.0 * points[i - 1]);
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  if (!closed) return along;
  std::array<double, 3> sides{high.x - low.x, high.y - low.y, high.z - low.z};
  std::sort(sides.begin(), sides.end());
  return cut.picked.picks.empty() ? sides[1] : sides[2];  // in the plane the third is 0; in space it may be turned
}

}  // namespace

MeshData refined(const MeshData& mesh) {
  MeshData fine = mesh;
  fine.triangles.clear();
  fine.file_vertices.clear();
  Middles middle(mesh, fine);
  for (const auto& [a, b, c] : mesh.triangles) {
    const std::int32_t ab = middle.of(a, b), bc = middle.of(b, c), ca = middle.of(c, a);
    for (const auto& triangle : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
      fine.triangles.push_back(triangle);
  }
  return fine;
}

SheetLevels::SheetLevels(const Scene& scene) : scene_(scene) {
  const MeshData mesh = mesh_of(scene);
  own_ = to_int(mesh.triangles.size());
  edge_ = Sheet(mesh).mean_edge();
}

double SheetLevels::mean_edge(int triangles) const { return edge_ * std::sqrt(to_double(own_) / triangles); }

std::optional<int> SheetLevels::triangles(double fineness) {
  if (!scene_.mesh) {
    const int side = std::max(1, to_int(std::lround(fineness * squares_per_side(scene_.resolution))));
    return 2 * side * side;
  }
  if (fineness == 1) return own_;
  const auto [known, is_new] = known_.try_emplace(fineness);
  if (!is_new) return known->second;
  std::optional<MeshData> mesh = made(fineness);
  if (!mesh) return {};
  const int count = to_int(mesh->triangles.size());
  meshes_.try_emplace(count, std::move(*mesh));
  return known->second = count;
}

std::optional<MeshData> SheetLevels::made(double fineness) {
  if (fineness > 1) {
    const double halvings = std::log2(fineness);
    if (halvings != std::round(halvings)) return {};
    MeshData mesh = *scene_.mesh;
    for (int i = 0; i < to_int(std::lround(halvings)); ++i) mesh = refined(mesh);
    return mesh;
  }
  try {
    return remeshed(*scene_.mesh, edge_ / fineness);
  } catch (const InputError& error) {
    if (missing_.empty()) missing_ = error.what();
    return {};
  }
}

void SheetLevels::apply(Scene& scene, int triangles) const {
  scene.resolution = triangles;
  if (const auto mesh = meshes_.find(triangles); mesh != meshes_.end()) scene.mesh = mesh->second;
}

int triangles_for_cuts(const Scene& scene, const SheetLevels& levels) {
  double least = std::numeric_limits<double>::infinity();
  for (const Scene::Cut& cut : scene.cuts) least = std::min(least, size_of(cut));
  if (!std::isfinite(least) || !(least > 0)) return 0;
  const double edges = edges_in_a_cut * levels.mean_edge(levels.own()) / least;
  return to_int(std::ceil(levels.own() * edges * edges - 1e-9));
}

}  // namespace cutbench
