// All membrane elements of a sheet, four at a time (lanes.h): strains and forces in one pass, stiffness in another.
// A collapsed element is computed by itself (deformation_of()), and so is each compound (compound_sheet.h).
//
// Several threads share the vertices, not the elements: each adds what the elements exert on its own vertices, in the
// order of the elements. So each sum is the same bits as by one thread.
#pragma once

#include <vector>

#include "harness/fem/algebra/block_matrix.h"
#include "harness/fem/algebra/workers.h"
#include "harness/fem/elements/compound_sheet.h"
#include "harness/fem/elements/element_stiffness.h"

namespace cutbench {

template <int D>
class MembraneSheet {
 public:
  /// \param twist  (1 - nu) D of bending, N m: it keeps compounds flat (compound_sheet.h); 0: none does
  explicit MembraneSheet(const MembraneLaw& law, double twist = 0)
      : law_(law), compounds_(CompoundLaw<D>(law, twist)) {}
  void resize(std::size_t elements);
  void reserve_spare();

  /// Where the blocks of the elements round a vertex are in its row of the matrix.
  /// \param triangles  Incidence::at(vertex)
  void find_slots(const ElementTable& elements, std::size_t vertex, std::span<const HalfEdge> triangles,
                  const BlockMatrix<D>& blocks);
  void clear_slots(std::size_t triangle);  ///< its slot in the table is free
  /// Takes over the compound of t, which is new (ElementTable::merge()).
  void join(const ElementTable& elements, TriangleIndex t);
  /// Throws InputError where these make compounds, and such have no answer to the strain.
  void check_takes(const Constraints& constraints) const;

  /// Deformations of all elements at x, and the forces they exert; the functions below refer to this x.
  void rotate(const ElementTable& elements, const Field& x, Workers& workers = Workers::none());
  const Field& force() const { return force_; }  ///< N
  double energy(const ElementTable& elements, Workers& workers = Workers::none()) const;
  Deformation<D> deformation(const ElementTable& elements, std::size_t element) const;
  /// Adds factor x stiffness to the blocks at the slots.
  void add_stiffness(const ElementTable& elements, double factor, BlockMatrix<D>& blocks,
                     Workers& workers = Workers::none());

 private:
  using FourSlots = std::array<std::int32_t, lane_count>;
  using NineSlots = std::array<std::array<FourSlots, 3>, 3>;
  using Strained = StrainInFrame<D, Lanes>;
  /// Vertices from `begin` to before `end`, and the elements with one of them, in their order.
  struct Share {
    std::int32_t begin, end;
    std::vector<std::int32_t> elements;
    bool has(std::int32_t vertex) const { return begin <= vertex && vertex < end; }
  };
  /// Where block (i, j) of a triangle is in the matrix; all nine are -1 where it is no element.
  void set_slot(std::size_t triangle, std::size_t i, std::size_t j, std::int32_t slot) {
    shares_are_old_ = true;
    slots_[triangle / lane_count][i][j][triangle % lane_count] = slot;
  }
  struct Four;
  void strain(const ElementTable& elements, const Four& four, std::size_t i, const Field& x);
  void recompute_collapsed(const ElementTable& elements, std::size_t i, Lanes determined, const Field& x);
  template <class Has>
  void add_forces(const Four& four, const Strained& strained, const Has& has);
  void add_stiffness(const Four& four, double factor, const Strained& strained, const NineSlots& slots,
                     BlockMatrix<D>& blocks) const;
  void find_shares(const ElementTable& elements, std::size_t vertices);
  template <class Act>
  void share_vertices(const ElementTable& elements, std::size_t vertices, Workers& workers, const Act& act);

  MembraneLaw law_;
  std::vector<Strained> strained_;  // per four elements
  std::vector<NineSlots> slots_;    // per four elements: of their nine blocks
  Field force_;
  CompoundSheet<D> compounds_;
  std::vector<Share> shares_;  // of several threads
  bool shares_are_old_ = true;
};

}  // namespace cutbench
