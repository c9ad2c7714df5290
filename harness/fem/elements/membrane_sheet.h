// All membrane elements of a sheet, four at a time (lanes.h): strains and forces in one pass, stiffness in another.
// A collapsed element is computed by itself (deformation_of()), and so is each compound (compound_sheet.h).
//
// Several threads share the vertices, not the elements: each adds what the elements exert on its own vertices, in the
// order of the elements. So each sum is the same bits as by one thread.
#pragma once

#include <algorithm>
#include <vector>

#include "harness/fem/algebra/block_matrix.h"
#include "harness/fem/algebra/workers.h"
#include "harness/fem/elements/compound_sheet.h"
#include "harness/fem/elements/element_stiffness.h"

namespace cutbench {

template <int D>
class MembraneSheet {
 public:
  /// \param bends  bending keeps compounds flat (compound_sheet.h)
  explicit MembraneSheet(const MembraneLaw& law, bool bends = false) : law_(law), compounds_(law, bends) {}
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
  double energy(const ElementTable& elements) const;
  Deformation<D> deformation(const ElementTable& elements, std::size_t element) const;
  /// Adds factor x stiffness to the blocks at the slots.
  void add_stiffness(const ElementTable& elements, double factor, BlockMatrix<D>& blocks,
                     Workers& workers = Workers::none());

 private:
  using FourSlots = std::array<std::int32_t, lane_count>;
  /// Vertices from `begin` to before `end`.
  struct Span {
    std::int32_t begin, end;
    bool holds(std::int32_t vertex) const { return begin <= vertex && vertex < end; }
    bool meets(const Span& other) const { return begin < other.end && other.begin < end; }
    void add(const Span& other) {
      begin = std::min(begin, other.begin);
      end = std::max(end, other.end);
    }
  };
  /// Where block (i, j) of a triangle is in the matrix; all nine are -1 where it is no element.
  void set_slot(std::size_t triangle, std::size_t i, std::size_t j, std::int32_t slot) {
    spans_are_old_ = true;
    slots_[triangle / lane_count][i][j][triangle % lane_count] = slot;
  }
  struct Four;
  void strain(const ElementTable& elements, const Four& four, std::size_t i, const Field& x);
  void recompute_collapsed(const ElementTable& elements, std::size_t i, Lanes determined, const Field& x);
  void add_forces(const Four& four, const StrainInFrame<D, Lanes>& strained, const Span& to_vertices);
  void add_stiffness_of_four(const Four& four, std::size_t i, double factor, const Span& to,
                             BlockMatrix<D>& blocks) const;
  void find_spans(const ElementTable& elements, Workers& workers);
  template <class Act>
  void for_each_four_at(const Span& vertices, const Act& act) const;
  template <class Act>
  void share_vertices(std::size_t vertices, Workers& workers, const Act& act) const;

  MembraneLaw law_;
  std::vector<StrainInFrame<D, Lanes>> strained_;               // per four elements
  std::vector<std::array<std::array<FourSlots, 3>, 3>> slots_;  // per four elements: of their nine blocks
  Field force_;
  CompoundSheet<D> compounds_;
  std::vector<Span> spans_;           // per four elements: of their vertices; for several threads
  std::vector<Span> spans_of_parts_;  // and of every fours_of_part of these
  bool spans_are_old_ = true;
};

}  // namespace cutbench
