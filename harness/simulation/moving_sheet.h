// A scene's sheet with everything that a step or a cut changes.
#pragma once

#include <vector>

#include "harness/base/conversions.h"
#include "harness/fem/model/state.h"
#include "harness/mesh/locator.h"
#include "harness/simulation/scene.h"

namespace cutbench {

template <int D>
struct MovingSheet {
  /// At the scene's first moment. Throws InputError.
  explicit MovingSheet(const Scene& scene)
      : sheet(sheet_of(scene)),
        locator(sheet),
        pins(pins_of(scene, sheet)),
        model(sheet, scene.material, scene.physics, pins, scene.tractions),
        state(initial_state(model, sheet)) {
    hold_constrained_vertices(pins, scene.tractions, sheet);
    if (sheet.seams().empty()) return;
    model.constrain(sheet, constraints);
    keep_together();
  }

  /// The sheet with its vertices where they are now.
  Sheet posed() const {
    Sheet posed = sheet;
    for (std::size_t v = 0; v < posed.deformed_slots(); ++v) {
      const auto x = state.x.template segment<D>(to_index(D * v));
      posed.set_position(DeformedIndex(v), {x[0], x[1], D == 3 ? x[D - 1] : 0});
    }
    return posed;
  }
  Balance balance() { return balance_of(model, state); }

  /// After Model::constrain(): what goes along with other vertices goes where these are.
  void keep_together() {
    for (Field* const field : {&state.x, &state.v}) {
      if (model.constrained()) model.constrained()->satisfy(model.held(), *field);
      model.follow(*field);
    }
  }

  static Sheet sheet_of(const Scene& scene) {
    Sheet sheet(mesh_of(scene));
    check_scene_suits_seams(scene, sheet);
    return sheet;
  }

  Sheet sheet;
  Locator locator;
  std::vector<Pin> pins;
  Model<D> model;
  Constraints constraints;  ///< the method's, of the last cut
  State state;
};

}  // namespace cutbench
