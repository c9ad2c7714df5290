// Linear equilibrium of an opened sheet in its plane, with given displacements and forces. It is assembled once, and
// solved once for each budget.
#pragma once

#include <functional>
#include <optional>
#include <span>

#include "harness/fem/constraints/constraint_matrix.h"
#include "harness/fem/model/model.h"
#include "harness/fem/tips/tip_system.h"
#include "harness/problems/common/elastic_field.h"
#include "harness/problems/common/problem.h"

namespace cutbench {

class StaticSolve {
 public:
  StaticSolve(const Sheet& sheet, const Elastic& elastic, const Constraints& constraints = {});

  /// Gives every vertex of the sheet's border its displacement: `value` of its rest position, and of a point inside a
  /// triangle there, which says on which lip it is.
  void hold_border(const std::function<Eigen::Vector2d(Point2, Point2)>& value);
  /// The same by a value for each deformed vertex, in two coordinates each; read on the border alone.
  void hold_border(const Field& value);
  /// Gives one coordinate (0 or 1) of all vertices at p its displacement.
  void hold(Point2 p, int axis, double value);
  /// Force per length on the border edges that `where` says yes to (by their ends), N/m.
  void pull_border(const std::function<bool(Point2, Point2)>& where, const Eigen::Vector2d& force);
  /// Loads the lips of all incisions. `load`: N per length along the x axis of `frame`, at x, on the lips above an
  /// incision; those below it take the opposite. An edge takes the load of its length along that axis, so whatever
  /// edges a method opened, the sum is that of the cut that was asked for. Tip functions don't take it.
  void load_lips(const Axes& frame, const std::function<Eigen::Vector2d(double)>& load);
  /// Holds all vertices of every piece that nothing holds yet at zero: a piece that is cut out has no unique
  /// equilibrium. `cut_off`: a piece, more than half of whose area is there, is held so, whatever else holds it.
  void hold_loose_pieces(const std::function<bool(Point2)>& cut_off = {});

  /// Makes the functions that budgets with `tip_functions` add, if one of these has them. Such budgets are refused
  /// where a vertex is constrained, and where no tip has functions.
  void make_tip_functions(std::span<const Budget> budgets);

  struct Solution {
    Field displacement;         ///< two values per slot of a deformed vertex, m: of the linear shape functions
    Eigen::VectorXd of_tips{};  ///< of the tip functions, m / sqrt(length); empty without
    Answer answer;              ///< all but the measures
  };
  /// Call it after all functions above. The first call assembles; that time is part of every answer.
  Solution solve(const Budget& budget);

  const ElementTable& elements() const { return model_.elements(); }
  /// Whether hold_loose_pieces() found this vertex in one.
  bool loose(DeformedIndex d) const { return !loose_.empty() && loose_[d()]; }
  const Field& force() const { return force_; }  ///< N
  const TipFunctions* tip_functions() const { return tips_ ? &*tips_ : nullptr; }
  /// J: what the tip functions add to the energy of the linear ones; 0 without.
  double tip_energy(const Solution& solution) const;
  /// What they add to the displacement at a point of a triangle.
  TipFunctions::Displacement tip_displacement(const Solution& solution, TriangleIndex t, Point2 p) const {
    return solution.of_tips.size() == 0 ? TipFunctions::Displacement{} : tips_->displacement(t, p, solution.of_tips);
  }

 private:
  SystemMatrix<2> held_system() const;
  void load_edge(HalfEdge h, const Axes& frame, const std::function<Eigen::Vector2d(double)>& load);

  const Sheet& sheet_;
  Model<2> model_;
  std::optional<ConstrainedSystem<2>> constrained_;
  std::optional<TipFunctions> tips_;
  std::optional<TipSystem> with_tips_;  // made with tips_
  std::string why_no_tips_;
  std::vector<std::uint8_t> held_, loose_;
  Field given_, force_;
  Field right_;  // of the assembled system, constrained where anything is
  double assemble_us_ = 0, tips_us_ = 0;
  bool assembled_ = false;
};

}  // namespace cutbench
