#include "harness/study/rebuild_times.h"

#include <Eigen/SparseCore>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/base/stop_watch.h"
#include "harness/fem/model/model.h"

namespace cutbench {

namespace {

/// The membrane's stiffness as most codes assemble it: a list of scalar entries, sorted and summed by the library.
template <int D>
double time_triplets(const Model<D>& model) {
  StopWatch watch;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(to_size(9 * D * D) * model.elements().size());
  const MembraneLaw law = law_of(model.material(), model.physics());
  for (std::size_t e = 0; e < model.elements().size(); ++e) {
    const Element& element = model.elements()[e];
    if (!element.alive()) continue;
    const ElementStiffness<D> k(element, model.deformation(e), law);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        const auto block = k.block(i, j);
        for (int c = 0; c < D; ++c)
          for (int r = 0; r < D; ++r)
            entries.emplace_back(D * element.vertex[i].value + r, D * element.vertex[j].value + c,
                                 block[to_size(D * c + r)]);
      }
  }
  const auto n = to_index(D * model.vertices());
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return watch.lap();
}

template <int D>
RebuildTimes time_in(const Scene& scene, const std::vector<Pin>& pins, const Sheet& sheet) {
  RebuildTimes times;
  Physics without_bending = scene.physics;
  without_bending.bending = BendingKind::none;
  StopWatch watch;
  Model<D> model(sheet, scene.material, without_bending, pins, scene.tractions);
  times.model = watch.lap();
  if (scene.physics.bending != BendingKind::none) {
    const Bending bending(sheet, scene.physics.bending, scene.material.bending, scene.material.poisson);
    times.bending = watch.lap();
  }
  model.rotate(model.positions(sheet));
  times.triplets = time_triplets(model);
  return times;
}

}  // namespace

RebuildTimes time_rebuild(const Scene& scene, const std::vector<Pin>& pins, const Sheet& sheet) {
  return scene.physics.dimension == 2 ? time_in<2>(scene, pins, sheet) : time_in<3>(scene, pins, sheet);
}

}  // namespace cutbench
