// Bending of a sheet that is flat at rest: one constant, positive semi-definite scalar matrix for x, y and z, whose
// null space is what is linear in rest coordinates, so rigid motions of any size cost nothing and nothing is rotated.
// Its kinds are in bending_kinds.h.
//
// Each triangle's energy is half the sum of the squares of three linear rows over the vertices near it. What lies
// across an incision is not near. An element of several triangles has the rows of one: one quadratic, and one Hessian
// from the slopes at its sides. Only kinds with slopes take such elements.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "harness/fem/algebra/block_matrix.h"
#include "harness/fem/algebra/growing_rows.h"
#include "harness/fem/algebra/row_sum.h"
#include "harness/fem/algebra/workers.h"
#include "harness/fem/elements/bending_kinds.h"
#include "harness/fem/elements/element_table.h"
#include "harness/fem/elements/physics.h"
#include "harness/fem/elements/slope_patch.h"
#include "harness/mesh/seam_edges.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

/// The stencils of elements that are no triangles of the sheet, each in the slot of one.
struct ReplacedStencils {
  std::vector<TriangleIndex> slots;  ///< each once
  GrowingRows<StencilTerm> rows;     ///< per slot
};

/// J: of three rows, at these positions, `dimension` per vertex.
double stencil_energy(std::span<const StencilTerm> terms, const Field& x, int dimension);

/// Positions of the vertices before a cut, and those after it, 3 per vertex.
struct PlacesAtCut {
  const Field& before;
  const Field& after;
};

class Bending {
 public:
  /// A stencil that holds a vertex, and its place there; one is like another if the triangle is.
  struct Holder {
    std::int32_t triangle, place;
    bool operator==(const Holder& other) const { return triangle == other.triangle; }
    bool operator<(const Holder& other) const { return triangle < other.triangle; }
  };
  Bending() = default;
  /// \pre kind is not `none`, and has slopes where elements have several triangles; rigidity D in N m.
  /// \param elements  of the sheet; null: each triangle is one
  Bending(const Sheet& sheet, BendingKind kind, double rigidity, double poisson,
          const ElementTable* elements = nullptr);
  /// After a cut: rebuilds the stencils near the slots in the sheet's log and the rows of the vertices in them. Equal
  /// to a new one but for the order of the columns within a row.
  /// \param regrouped  the triangles that joined or left an element of several since the last call
  /// \return by how much the energy changed between these places, J; without them zero
  double update(const Sheet& sheet, const ElementTable* elements = nullptr,
                std::span<const TriangleIndex> regrouped = {}, const PlacesAtCut* places = nullptr);

  /// From now on these slots have these stencils, until an update() makes them again, or clear_replaced(). Only rows of
  /// vertices whose stencils change are written.
  /// \param vertices  that there are then: a stencil may hold more than the sheet has
  void replace(const ReplacedStencils& replaced, std::size_t vertices);
  /// Slots that replace() gave stencils have none.
  void clear_replaced();

  BendingKind kind() const { return kind_of_; }
  bool has_slopes() const { return kind_->has_slopes; }
  /// Of the patch of a triangle, in unseparated edges; 0: it has none.
  int reach(std::size_t triangle) const { return reach_[triangle]; }
  double rigidity() const { return rigidity_; }
  double poisson() const { return poisson_; }
  /// N/m. Force = -K x, energy = x K x / 2, for each coordinate. Rows of freed vertices are empty.
  const BlockMatrix<1>& matrix() const { return matrix_; }
  /// By the last update(), replace() or clear_replaced().
  const std::vector<std::int32_t>& written_rows() const { return work_.rows; }
  /// The triangle slots whose stencils the last update() made again, or the constructor.
  const std::vector<TriangleIndex>& rebuilt() const { return work_.rebuilt; }
  double energy(const Field& x, int dimension, Workers& workers = Workers::none()) const;
  /// The three rows of a triangle's energy, in sqrt(N/m); none where it is free, or not the first of its element.
  std::span<const StencilTerm> stencil(std::size_t triangle) const { return stencils_[triangle]; }
  /// Side k of a triangle as the one on its other side has it, also over a seam.
  HalfEdge across(const Sheet& sheet, TriangleIndex t, std::size_t k) const {
    return other_side(sheet, seams_.across(), t, k);
  }
  std::span<const Holder> stencils_of(std::size_t vertex) const { return stencils_of_[vertex]; }
  void reserve_spare();  ///< room to grow by half, before anything has to be copied

 private:
  struct Stale {
    TriangleIndex triangle;
    int distance;  ///< in unseparated edges, from the nearest triangle that changed
  };
  void resize(std::size_t triangles, std::size_t vertices);
  void mark_stale(TriangleIndex t, int distance);
  void find_stale(const Sheet& sheet, std::span<const TriangleIndex> regrouped);
  std::span<const TriangleIndex> members(const TriangleIndex& t) const;
  double rebuild(const Sheet& sheet, const PlacesAtCut* places = nullptr);
  void fit_patch(const Sheet& sheet, TriangleIndex t);
  bool stencil_is_stale(const Sheet& sheet, TriangleIndex t) const;
  void replace_stencil(std::size_t t);
  void put_on_list(std::int32_t vertex);
  void write_row(std::size_t vertex);

  BendingKind kind_of_ = BendingKind::none;
  const BendingRow* kind_ = &row_of(BendingKind::none);
  double rigidity_ = 0, poisson_ = 0;
  GrowingRows<StencilTerm> slopes_;  ///< per triangle slot: SlopePatch::terms(), of a kind with slopes
  std::vector<int> reach_;           ///< per triangle slot: of its patch; 0 where there is none
  int longest_reach_ = 0;
  GrowingRows<StencilTerm> stencils_;  ///< per triangle slot: its three rows, in sqrt(N/m)
  GrowingRows<Holder> stencils_of_;    ///< per deformed vertex: the stencils that hold it, in order
  BlockMatrix<1> matrix_;
  std::vector<std::uint8_t> is_replaced_;  ///< per triangle slot: its stencil is not the sheet's
  SeamEdges seams_;                        ///< of a kind without slopes

  /// Working storage, kept between calls so that they don't allocate.
  struct Work {
    const ElementTable* elements = nullptr;  ///< of the call under way
    SlopePatch patch;
    std::vector<Stale> stale;                          ///< nearest first
    std::vector<std::uint32_t> stale_in, refitted_in;  ///< per triangle slot: the call that listed it, fitted its patch
    std::vector<std::uint32_t> listed_in;              ///< per deformed vertex: the call that put it in `rows`
    std::uint32_t call = 0;
    std::vector<TriangleIndex> rebuilt;
    std::vector<std::int32_t> rows;   ///< to be written
    std::vector<std::int32_t> place;  ///< per deformed vertex: in `terms`; -1: none
    std::vector<StencilTerm> terms;
    RowSum<double> row{0};
  } work_;
};

}  // namespace cutbench
