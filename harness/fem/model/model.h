// The discrete sheet: elements, mass, bending, loads, held vertices and the system matrix. After each cut it is
// updated: only what the cut touched is computed again, and the result equals that of a new model.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/fem/constraints/constraint_matrix.h"
#include "harness/fem/elements/added_mass.h"
#include "harness/fem/elements/bending.h"
#include "harness/fem/elements/copied_bending.h"
#include "harness/fem/elements/curved_bending.h"
#include "harness/fem/elements/incidence.h"
#include "harness/fem/elements/membrane_sheet.h"
#include "harness/fem/linear/system_matrix.h"
#include "harness/fem/model/energy.h"

namespace cutbench {

template <int D>
class Model {
 public:
  /// The limit of an added mass is that of this sheet's elements: \pre `sheet` is not cut yet, where there is such a
  /// mass.
  Model(const Sheet& sheet, const Material& material, const Physics& physics, std::vector<Pin> pins,
        std::vector<Traction> tractions);

  /// Reserves room to grow by half, so that the first cut of a running simulation copies no arrays. A copy of the model
  /// has no such room.
  void reserve_spare();
  /// Call both after each single cut, before the next begin_cut() clears the log, and transfer() for the state: they
  /// replace indices and add elements (Xin et al. 2018, 4.2) where the sheet's log says so.
  void update(const Sheet& sheet);
  /// Nothing without bending. \return Bending::update()'s
  double update_bending(const Sheet& sheet, const PlacesAtCut* places = nullptr);
  /// Constrains vertices and makes elements of several triangles; call it after update() and update_bending().
  /// Constraints of before are removed. Such elements of before stay, unless the cut touched their triangles or they
  /// share one with a new one. Forces, energies and the matrix remain those of all vertices; a solver solves for the
  /// unknowns of constrained(). Vertices inside such elements are no unknowns: they have no mass and are held, and
  /// follow() moves them. Of a sheet with seams it must be called at the beginning, too: it keeps them sewn.
  /// Phantom nodes are vertices without triangles of their own, behind those of the sheet, with some room between: a
  /// cut changes the rows of those alone that it gives other elements. Copied elements bend instead of their triangles;
  /// where the mass is lumped, they have theirs.
  /// \pre `sheet` is that of the last update().
  void constrain(const Sheet& sheet, const Constraints& constraints);
  /// From now on other pins hold the sheet, and forces pull at its vertices besides the scene's loads.
  /// \param force  N, per unknown; vertices that later cuts make have none. Empty: none at all
  /// \pre `sheet` is that of the last update().
  void set_pins_and_force(const Sheet& sheet, std::vector<Pin> pins, std::vector<double> force);
  /// Gives the vertices inside elements their values, positions or velocities.
  void follow(Field& x) const { elements_.template follow<D>(x); }

  /// Slots of the opened sheet, room for more where there are phantom nodes, and these.
  std::size_t vertices() const { return to_size(mass_.size()); }
  /// vertices() where there is none.
  std::size_t first_phantom() const { return phantoms_.empty() ? vertices() : first_phantom_; }
  /// The vertex of the sheet that each phantom node is a copy of.
  const std::vector<DeformedIndex>& phantoms() const { return phantoms_; }
  /// Positions of the sheet's vertices, m; a phantom node is where the vertex is that it is a copy of.
  Field positions(const Sheet& sheet) const;

  // --- of a state ----------------------------------------------------------------------------------------------------
  /// The deformation of every element; the functions below refer to this x.
  void rotate(const Field& x, Workers& workers = Workers::none());
  /// The same; does nothing where the last call had this x and the model is unchanged.
  void rotate_once(const Field& x, Workers& workers = Workers::none());
  /// f += internal forces, of membrane and bending, N. \pre rotate(x).
  void add_internal_force(const Field& x, Field& f) const;
  /// y += h (internal forces at x) - factor A v, with A of the last assemble(). Faster than one by one: bending, which
  /// is linear, is in both. \pre rotate(x).
  void add_impulse(double h, const Field& x, double factor, const Field& v, Field& y,
                   Workers& workers = Workers::none());
  void add_external_force(Field& f) const { f += external_force(); }
  /// A = mass_factor M + stiffness_factor K, with K the tangent at the rotated state. \pre rotate().
  void assemble(double mass_factor, double stiffness_factor, Workers& workers = Workers::none());
  /// Of the last assemble(). Refers to this model.
  SystemMatrix<D> system() const;
  ConstrainedSystem<D>* constrained() {
    return is_constrained_ ? &*constrained_ : nullptr;
  }  ///< null where no vertex is constrained
  /// y += factor M x.
  void add_mass_product(double factor, const Field& x, Field& y, Workers& workers = Workers::none()) const;
  /// \pre rotate(x)
  Energy energy(const Field& x, const Field& v, Workers& workers = Workers::none());

  // --- of the model --------------------------------------------------------------------------------------------------
  const ElementTable& elements() const { return elements_; }
  const Incidence& incidence() const { return incidence_; }
  const BlockMatrix<D>& blocks() const { return blocks_; }
  const Bending* bending() const { return bending_ ? &*bending_ : nullptr; }
  Deformation<D> deformation(std::size_t element) const { return membrane_.deformation(elements_, element); }
  FieldView lumped_mass() const { return view_of(mass_); }  ///< kg, per vertex, without what is added
  const AddedMass* added_mass() const { return added_mass_ ? &*added_mass_ : nullptr; }
  FieldView external_force() const { return view_of(external_); }  ///< N
  const std::vector<std::uint8_t>& held() const { return held_; }  ///< per unknown; those of freed slots are, too
  /// Pieces no unknown of which is held: they have no equilibrium. Looks at everything.
  std::size_t unheld_pieces() const;
  bool pinned(std::size_t unknown) const { return pin_of_[unknown] >= 0; }
  /// How far from its initial place a held unknown is to be at a time, m. \pre pinned(unknown).
  double held_displacement(std::size_t unknown, double time) const;
  double held_velocity(std::size_t unknown) const;  ///< m/s
  const Material& material() const { return material_; }
  /// Of CompoundLaw, N m.
  double twist() const {
    return physics_.bending == BendingKind::none ? 0 : (1 - material_.poisson) * material_.bending;
  }
  const Physics& physics() const { return physics_; }

 private:
  static std::array<double, 3> coordinates(Point3 p) { return {p.x, p.y, p.z}; }
  static FieldView view_of(const std::vector<double>& values) { return {values.data(), to_index(values.size())}; }
  void resize(const Sheet& sheet);
  void refresh_vertices(const Sheet& sheet);
  void refresh_row(std::size_t v);
  void refresh_curved_bending(const Sheet& sheet);
  void refresh_mass(std::size_t v);
  const BlockMatrix<1>* bending_matrix() const { return bending_ && !curved_ ? &bending_->matrix() : nullptr; }
  ElementModes element_modes() const;
  void refresh_added_mass();
  const BlockMatrix<1>* mass_matrix() const;
  void refresh_loads(const Sheet& sheet, std::size_t v);
  void set_constraints(const Constraints& constraints);
  std::vector<std::uint8_t> pinned_vertices() const;
  void move_phantoms(const Sheet& sheet);
  void take_phantoms(const Sheet& sheet, const std::vector<DeformedIndex>& phantoms);
  void take_masses(const Sheet& sheet, const Constraints& constraints);
  void take_copied_bending(const Sheet& sheet, const Constraints& constraints);
  void clear_vertex(std::size_t v);
  void set_mass(const Sheet& sheet, std::size_t v, double mass);
  void begin_marking();
  void mark(std::span<const DeformedIndex> vertices);
  void mark_regrouped();
  void forget_rotation();

  Material material_;
  Physics physics_;
  std::vector<Pin> pins_;
  std::vector<Traction> tractions_;
  std::vector<double> force_;  // of set_pins_and_force()

  ElementTable elements_;
  Incidence incidence_;  // of all triangles
  BlockMatrix<D> blocks_;
  MembraneSheet<D> membrane_;
  std::optional<Bending> bending_;
  CopiedBending copied_bending_;
  std::optional<CurvedBending> curved_;  // of a sheet that is curved at rest: in the place of bending_'s matrix
  std::optional<BlockMatrix<1>> consistent_mass_;
  std::optional<AddedMass> added_mass_;
  std::optional<ConstrainedSystem<D>> constrained_;
  bool is_constrained_ = false;  // since the last update()
  std::size_t first_phantom_ = 0;
  std::vector<DeformedIndex> phantoms_;
  std::vector<DeformedIndex> own_mass_;            // vertices whose mass is that of copied elements, in rising order
  double mass_factor_ = 0, stiffness_factor_ = 0;  // of the last assemble()
  std::vector<double> mass_, external_;            // with room to grow, which a Field has not
  std::vector<std::uint8_t> held_;
  std::vector<std::int32_t> pin_of_;  // per unknown: the first pin that holds it, -1 where there is none
  std::vector<Point2> places_;        // per vertex, in rest space
  Field rotated_to_;                  // by rotate_once(); empty: by another, or not since the last change
  std::optional<Energy> elastic_;     // at the rotated positions; only what is elastic
  PatternHistory history_;            // of the system
  // Working storage of update().
  std::vector<std::uint32_t> marked_in_;
  std::uint32_t round_ = 0;
  std::vector<std::size_t> marked_;  // vertices whose rows change
  std::vector<std::int32_t> columns_;
  Regrouped regrouped_;                 // its triangles: those that bending does not know of yet
  std::vector<Lanes> velocity_, bent_;  // of add_impulse(), per vertex
};

}  // namespace cutbench
