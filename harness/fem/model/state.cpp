#include "harness/fem/model/state.h"

#include <algorithm>
#include <unordered_map>
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

State take_phantoms(std::size_t first_phantom, int dimension, State& state) {
  State taken;
  const Eigen::Index vertices = to_index(first_phantom) * dimension;
  const std::pair<Field*, Field*> fields[] = {
      {&state.x, &taken.x}, {&state.v, &taken.v}, {&state.anchor, &taken.anchor}, {&state.dv, &taken.dv}};
  for (const auto& [from, to] : fields) {
    if (from->size() <= vertices) continue;
    *to = from->tail(from->size() - vertices);
    from->conservativeResize(vertices);
  }
  return taken;
}

namespace {

/// The elements that there were before a cut, by their parents and where they were.
class ElementsBefore {
 public:
  ElementsBefore(const Sheet& cut, const Constraints& last) : cut_(cut), all_(last.copied) {
    for (const auto& touched : cut.log().touched) touched_[touched.slot.value] = &touched.before;
  }

  /// That the new one is a part of; null: its parent was no copied element.
  const CopiedElement* find(const CopiedElement& part) const {
    const auto is_before = [](const CopiedElement& e, TriangleIndex parent) { return e.parent < parent; };
    const auto first = std::lower_bound(all_.begin(), all_.end(), part.parent, is_before);
    const auto last = std::find_if(first, all_.end(), [&](const CopiedElement& e) { return e.parent != part.parent; });
    if (first == last) return nullptr;
    const auto same = std::find_if(first, last, [&](const CopiedElement& e) { return e.triangles == part.triangles; });
    if (same != last && !is_touched(part)) return &*same;
    const auto c = cut_.corners(part.triangles.front());
    const Point2 middle = 1.0 / 3 * (c[0] + c[1] + c[2]);
    return &*std::max_element(first, last, [&](const CopiedElement& x, const CopiedElement& y) {
      return last - first > 1 && depth_in(x, middle) < depth_in(y, middle);
    });
  }

 private:
  bool is_touched(const CopiedElement& element) const {
    return std::any_of(element.triangles.begin(), element.triangles.end(), [&](TriangleIndex t) {
      return t() >= cut_.log().triangles_before || touched_.contains(t.value);
    });
  }

  /// The smallest barycentric coordinate, in the triangle that has it largest.
  double depth_in(const CopiedElement& element, Point2 p) const {
    double deepest = -1e300;
    for (const TriangleIndex t : element.triangles) {
      const auto was = touched_.find(t.value);
      const Triangle& triangle = was == touched_.end() ? cut_.triangle(t) : *was->second;
      const Point2 a = cut_.rest(triangle.vertex[0]), b = cut_.rest(triangle.vertex[1]),
                   c = cut_.rest(triangle.vertex[2]);
      const double least = std::min({cross(b - a, p - a), cross(c - b, p - b), cross(a - c, p - c)});
      deepest = std::max(deepest, least / cross(b - a, c - a));
    }
    return deepest;
  }

  const Sheet& cut_;
  const std::vector<CopiedElement>& all_;  // by rising parents
  std::unordered_map<std::int32_t, const Triangle*> touched_;
};

}  // namespace

template <int D>
void begin_phantoms(const Sheet& cut, const Constraints& last, const Constraints& now, std::size_t vertices_before,
                    const State& phantoms, const Model<D>& model, State& state) {
  const std::size_t first_now = cut.deformed_slots();
  std::vector<DeformedIndex> from(now.phantoms.size());
  const ElementsBefore before(cut, last);
  for (const CopiedElement& element : now.copied) {
    const CopiedElement* was = nullptr;
    for (std::size_t k = 0; k < 3; ++k) {
      if (element.unknown[k]() < first_now) continue;
      if (!was) was = before.find(element);
      const std::size_t i = element.unknown[k]() - first_now;
      if (!from[i].valid()) from[i] = was ? was->unknown[k] : now.phantoms[i];
    }
  }
  const std::pair<const Field*, Field*> fields[] = {
      {&phantoms.x, &state.x}, {&phantoms.v, &state.v}, {&phantoms.anchor, &state.anchor}, {&phantoms.dv, &state.dv}};
  for (const auto& [old, field] : fields) {
    if (field->size() == 0) continue;
    field->conservativeResize(to_index(D * model.vertices()));
    field->tail(to_index(D * (model.vertices() - first_now))).setZero();
    for (std::size_t i = 0; i < from.size(); ++i) {
      const std::size_t d = from[i]();
      const double* const begin = d < vertices_before ? field->data() + D * d : old->data() + D * (d - vertices_before);
      std::copy_n(begin, D, field->data() + D * (model.first_phantom() + i));
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
void place_phantoms(const Model<D>& model, State& state) {
  for (std::size_t i = 0; i < model.phantoms().size(); ++i)
    state.x.segment<D>(to_index(D * (model.first_phantom() + i))) = state.x.segment<D>(D * model.phantoms()[i].value);
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
template void begin_phantoms(const Sheet&, const Constraints&, const Constraints&, std::size_t, const State&,
                             const Model<2>&, State&);
template void begin_phantoms(const Sheet&, const Constraints&, const Constraints&, std::size_t, const State&,
                             const Model<3>&, State&);
template void place_phantoms(const Model<2>&, State&);
template void place_phantoms(const Model<3>&, State&);
template void hold_where_it_is(const Model<2>&, State&);
template void hold_where_it_is(const Model<3>&, State&);
template Balance balance_of(Model<2>&, const State&);
template Balance balance_of(Model<3>&, const State&);

}  // namespace cutbench
