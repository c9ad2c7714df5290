// What tests of the physics share: a sheet under the knife with a model that follows it.
#pragma once

#include <memory>

#include "harness/base/conversions.h"
#include "harness/cut/cut.h"
#include "harness/fem/model/state.h"
#include "harness/mesh/families.h"
#include "methods/registry.h"

namespace cutbench {

/// Cuts a sheet and keeps a model and a state in step with it.
template <int D>
class Body {
 public:
  Body(const MeshData& mesh, const Material& material, const Physics& physics, std::vector<Pin> pins = {},
       std::vector<Traction> tractions = {})
      : sheet(mesh),
        model(sheet, material, physics, pins, tractions),
        state(initial_state(model, sheet)),
        locator_(sheet),
        pins_(pins),
        tractions_(tractions) {}

  Status cut(const Curve& curve, const std::string& method = "conventional_split", double parameter = 0) {
    const auto tool = find_method(method).make(parameter);
    const CutOutcome outcome = Cutter().cut(sheet, locator_, curve, *tool, {});
    if (outcome.status != Status::ok && outcome.status != Status::deviated) return outcome.status;  // bit-unchanged
    transfer(sheet.log(), sheet.deformed_slots(), D, state);
    model.update(sheet);
    model.update_bending(sheet);
    return outcome.status;
  }
  Model<D> fresh_model() const { return {sheet, model.material(), model.physics(), pins_, tractions_}; }

  Sheet sheet;
  Model<D> model;
  State state;

 private:
  Locator locator_;
  std::vector<Pin> pins_;
  std::vector<Traction> tractions_;
};

inline Curve line(Point2 a, Point2 b) { return {Curve::Kind::polyline, false, {a, b}}; }
inline Curve polygon(std::vector<Point2> points) { return {Curve::Kind::polyline, true, std::move(points)}; }

/// A smooth field that bends, stretches and turns the sheet.
template <int D>
Field bent(const Model<D>& model, const Sheet& sheet) {
  Field x = Field::Zero(to_index(D * model.vertices()));
  for (std::size_t v = 0; v < sheet.deformed_slots(); ++v) {
    if (!sheet.rest_vertex(DeformedIndex(v)).valid()) continue;
    const auto [a, b] = sheet.rest(sheet.rest_vertex(DeformedIndex(v)));
    const auto i = to_index(D * v);
    x[i] = 1.1 * a + 0.1 * std::sin(2 * b);
    x[i + 1] = b - 0.05 * a * b;
    if constexpr (D == 3) x[i + 2] = 0.3 * std::sin(3 * a) * std::cos(2 * b);
  }
  for (std::size_t i = 0; i < model.phantoms().size(); ++i)
    x.template segment<D>(to_index(D * (model.first_phantom() + i))) =
        x.template segment<D>(D * model.phantoms()[i].value);
  return x;
}

/// The matrix of the last assemble(), scalar parts included, held unknowns as they are.
template <int D>
Eigen::MatrixXd dense(const Model<D>& model) {
  const auto n = to_index(D * model.vertices());
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(n, n);
  const auto system = model.system();
  for (std::size_t i = 0; i < model.vertices(); ++i) {
    const auto row = to_index(D * i);
    for (const auto j : system.blocks->columns(i))
      a.template block<D, D>(row, D * j) += system.blocks->block(system.blocks->find(i, j));
    for (const auto& term : system.scalar)
      for (const auto j : term.matrix->columns(i))
        for (int k = 0; k < D; ++k)
          a(row + k, D * j + k) += term.factor * term.matrix->block(term.matrix->find(i, j))(0);
  }
  return a;
}

}  // namespace cutbench
