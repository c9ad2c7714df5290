#include "harness/fem/model/state.h"

#include <algorithm>
#include <utility>

#include "harness/base/conversions.h"

namespace cutbench {

template <int D>
State initial_state(const Model<D>& model, const Sheet& sheet) {
  State state;
  state.anchor = state.x = model.positions(sheet);
  state.v.setZero(state.x.size());
  for (std::size_t i = 0; i < model.held().size(); ++i)
    if (model.pinned(i)) state.x[to_index(i)] += model.held_displacement(i, 0);
  return state;
}

void transfer(const EditLog& log, std::size_t deformed_slots, int dimension, State& state) {
  const auto size = to_index(deformed_slots) * dimension;
  for (Field* field : {&state.x, &state.v, &state.anchor, &state.dv}) {
    if (field == &state.dv && field->size() == 0) continue;
    const Eigen::Index old = field->size();
    field->conservativeResize(size);
    if (size > old) field->tail(size - old).setZero();
    for (const auto& made : log.ancestry) {
      std::array<double, 3> sum{};
      for (std::size_t i = 0; i < 3; ++i) {
        if (!made.parents[i].valid()) continue;
        for (int k = 0; k < dimension; ++k)
          sum[to_size(k)] += made.weights[i] * (*field)[dimension * made.parents[i].value + k];
      }
      for (int k = 0; k < dimension; ++k) (*field)[dimension * made.vertex.value + k] = sum[to_size(k)];
    }
  }
}

void renumber(const std::vector<DeformedIndex>& deformed, int dimension, State& state) {
  const auto kept = std::count_if(deformed.begin(), deformed.end(), [](DeformedIndex d) { return d.valid(); });
  for (Field* field : {&state.x, &state.v, &state.anchor, &state.dv}) {
    if (field->size() == 0) continue;
    Field renumbered(dimension * kept);
    for (std::size_t i = 0; i < deformed.size(); ++i)
      if (deformed[i].valid())
        renumbered.segment(dimension * deformed[i].value, dimension) =
            field->segment(dimension * to_index(i), dimension);
    *field = std::move(renumbered);
  }
}

template <int D>
void hold_where_it_is(const Model<D>& model, State& state) {
  for (std::size_t i = 0; i < model.held().size(); ++i) {
    if (!model.pinned(i)) continue;
    const auto k = to_index(i);
    state.anchor[k] = state.x[k] - model.held_displacement(i, state.time);
    state.v[k] = model.held_velocity(i);
  }
  state.dv.resize(0);
}

template <int D>
Balance balance_of(Model<D>& model, const State& state) {
  model.rotate(state.x);
  Balance balance;
  balance.energy = model.energy(state.x, state.v);
  Field momentum = Field::Zero(state.v.size()), force = momentum;
  model.add_mass_product(1, state.v, momentum);
  Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = linear, x = linear, p = linear;
  for (std::size_t i = 0; i < model.vertices(); ++i) {
    const auto at = to_index(D * i);
    x.head<D>() = state.x.segment<D>(at);
    p.head<D>() = momentum.segment<D>(at);
    linear += p;
    angular += x.cross(p);
  }
  balance.momentum = {linear.x(), linear.y(), linear.z()};
  balance.angular_momentum = {angular.x(), angular.y(), angular.z()};
  model.add_internal_force(state.x, force);
  model.add_external_force(force);
  for (std::size_t i = 0; i < model.held().size(); ++i)
    if (model.held()[i]) force[to_index(i)] = 0;
  if (const auto* constrained = model.constrained()) {
    Field reduced;
    constrained->reduce(model.held(), force, reduced);
    force = reduced;
  }
  balance.residual = force.norm();
  return balance;
}

template State initial_state(const Model<2>&, const Sheet&);
template State initial_state(const Model<3>&, const Sheet&);
template void hold_where_it_is(const Model<2>&, State&);
template void hold_where_it_is(const Model<3>&, State&);
template Balance balance_of(Model<2>&, const State&);
template Balance balance_of(Model<3>&, const State&);

}  // namespace cutbench
