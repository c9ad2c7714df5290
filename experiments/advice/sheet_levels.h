// The sheet of a scene with shorter and with longer edges. For `cutbench recommend` and `ablate`.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "harness/mesh/mesh_data.h"
#include "harness/simulation/scene.h"

namespace cutbench {

/// Every triangle as four; borders, incisions and seams stay what they are.
MeshData refined(const MeshData& mesh);

/// With edges about as long as `edge`, by CGAL's isotropic remeshing (Botsch, Kobbelt 2004) at rest. Corners of the
/// border stay; bent borders become coarser. In space, vertices lie on the old triangles.
/// \throw InputError  the sheet has incisions or seams, or comes out folded or as fine as before
MeshData remeshed(const MeshData& mesh, double edge);

class SheetLevels {
 public:
  explicit SheetLevels(const Scene& scene);

  int own() const { return own_; }                         ///< triangles of the scene's sheet
  double mean_edge(int triangles) const;                   ///< m at rest, about
  const std::string& missing() const { return missing_; }  ///< why there is no coarser one, else empty

  /// Triangles of the sheet with edges 1/fineness as long. A family has any; a sheet of its own those of fineness 2, 4,
  /// ..., and coarser ones unless missing() says why not.
  std::optional<int> triangles(double fineness);
  /// Gives the scene that sheet. \pre triangles() returned the number
  void apply(Scene& scene, int triangles) const;

 private:
  std::optional<MeshData> made(double fineness);

  const Scene& scene_;
  int own_ = 0;
  double edge_ = 0;
  std::map<double, std::optional<int>> known_;  ///< by fineness
  std::map<int, MeshData> meshes_;              ///< by triangles; none of a family
  std::string missing_;
};

/// The fewest triangles that hold the scene's cuts, about: an edge is at most half as long as the least of them is wide
/// (a closed one) or long. 0 where no cut says how large it is.
int triangles_for_cuts(const Scene& scene, const SheetLevels& levels);

}  // namespace cutbench
