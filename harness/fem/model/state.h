// The state of a moving sheet: positions and velocities of the opened sheet's vertices, and their transfer at a cut.
#pragma once

#include "harness/fem/model/model.h"

namespace cutbench {

struct State {
  Field x;       ///< m
  Field v;       ///< m/s
  Field anchor;  ///< m: the initial place of each vertex, from which pins count
  /// m/s: what the last implicit step began with to add to v. The next step's solve starts from it. Empty: from zero.
  Field dv;
  double time = 0;  ///< s
};

/// At rest where the sheet is, held vertices where they are to be at time 0.
template <int D>
State initial_state(const Model<D>& model, const Sheet& sheet);

/// Gives the vertices that the cut made or moved their positions and velocities: weighted means of those they came
/// from, in the order of the log, so that parents come before children.
void transfer(const EditLog& log, std::size_t deformed_slots, int dimension, State& state);

/// Takes the phantom nodes out of the state, before transfer(); returns what it had for them, behind each other.
/// \param first_phantom  Model::first_phantom() before the cut
State take_phantoms(std::size_t first_phantom, int dimension, State& state);

/// After Model::constrain(): gives each phantom node of the new constraints what the element had at that corner that
/// its own was a part of before the cut: a copy of before, or the sheet's triangle.
/// \param last     the constraints of before the cut
/// \param vertices_before  the sheet's deformed slots before the cut
/// \param phantoms         the result of take_phantoms()
template <int D>
void begin_phantoms(const Sheet& cut, const Constraints& last, const Constraints& now, std::size_t vertices_before,
                    const State& phantoms, const Model<D>& model, State& state);

/// After Sheet::compact(). \param deformed  its map
void renumber(const std::vector<DeformedIndex>& deformed, int dimension, State& state);

/// Puts each phantom node where the vertex is that it is a copy of.
template <int D>
void place_phantoms(const Model<D>& model, State& state);

/// Anchors and velocities of pinned vertices where the model has pins that the state does not know yet.
template <int D>
void hold_where_it_is(const Model<D>& model, State& state);

/// Rotates the model's elements to the state.
template <int D>
Balance balance_of(Model<D>& model, const State& state);

}  // namespace cutbench
