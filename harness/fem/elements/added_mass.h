// Mass that thin elements get beside the lumped one, so that no element is stiffer for its mass than a limit. Explicit
// steps then need not shrink where a cut passes close to a vertex.
//
// Theory. Let K = sum K_e and M = sum M_e. Where K_e <= l M_e for every element, K <= l M: the largest eigenvalue of
// the sheet is at most that of an element (Irons and Treharne, A bound theorem in eigenvalues and its practical
// applications, 1971). With K_e = R^T R, the eigenvalues of (K_e, M_e) are those of T = R M_e^-1 R^T, and
//
//   stabilised   M_e += R^T (1/l - T^-1)_+ R, which is the sum of (l_k / l - 1) M_e p_k p_k^T M_e over the modes (l_k,
//                p_k) of the element above l, p_k^T M_e p_k = 1: each of them comes down to l (selective mass scaling;
//                eigenvalue stabilisation, arXiv 2310.11935). What has no energy keeps its inertia.
//   scaled       M_e *= l_max / l, which is diagonal; all motion becomes heavier.
//
// Elements are
//
//   a triangle of the membrane, M_e = density A / 3 at each corner. Its K_e turns with it. So that the mass does not,
//   which would change the energy of motion, it is bounded by what acts on each coordinate alike: K_e <= s A G G^T,
//   with the gradients G of the shape functions and s = 2 (mu + lambda), the largest stiffness of the material.
//   Translation keeps its inertia. That of a turning sliver grows, as if it were about as wide as the elements that l
//   comes from. a stencil of bending (bending.h), R its three rows, M_e the mass of each vertex over the number of
//   stencils that hold it. All that is linear in rest coordinates, turning too, keeps its inertia.
//
// Membrane and bending are each at most l, both together at most 2 l. Elements of several triangles get no mass for
// their membrane. The added mass has no weight: equilibria stay as they are.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "harness/fem/algebra/block_matrix.h"
#include "harness/fem/elements/bending.h"
#include "harness/fem/elements/element_table.h"
#include "harness/fem/elements/incidence.h"
#include "harness/fem/elements/membrane.h"
#include "harness/fem/elements/physics.h"

namespace cutbench {

/// What elements are made of, and the sheet they are in.
struct ElementModes {
  const ElementTable* elements;
  FieldView lumped;        ///< kg, per vertex
  const Bending* bending;  ///< null: none
  double speed2;           ///< m2/s2: 2 (mu + lambda) / density

  /// Of T of a triangle of the membrane.
  struct InPlane {
    std::array<double, 2> eigenvalue;  ///< 1/s2, the larger one first
    Eigen::Vector2d first;             ///< eigenvector of the larger one
  };
  InPlane membrane(std::size_t triangle) const;
  /// M_e^-1/2 R^T of a bending stencil, 1/s: its squared singular values are the eigenvalues.
  void bending_rows(std::size_t triangle, Eigen::Matrix<double, Eigen::Dynamic, 3>& rows) const;
  /// The largest eigenvalue of any element, 1/s2. Looks at everything.
  double largest() const;
};

class AddedMass {
 public:
  /// \pre kind is `stabilised` or `scaled`; limit > 0, 1/s2.
  AddedMass(Mass kind, double density, double limit) : kind_(kind), density_(density), limit_(limit) {}
  double limit() const { return limit_; }

  /// After a change of the sheet: looks again at the elements round these vertices. The result is that of a new one.
  /// \param changed  the vertices whose mass, triangles or stencils changed; all of them the first time
  void update(const ElementModes& modes, const Incidence& incidence, std::span<const std::size_t> changed);

  /// kg, acts on each coordinate alike, symmetric and positive semi-definite. Rows without added mass are empty.
  const BlockMatrix<1>& matrix() const { return matrix_; }
  const std::vector<std::size_t>& written_rows() const { return rows_; }  ///< by the last update()
  double total() const;  ///< kg: what translation gains; zero to rounding where it is stabilised

 private:
  double excess(double eigenvalue) const;
  void find_in_plane(const ElementModes& modes, std::size_t triangle);
  bool find_bent(const ElementModes& modes, std::size_t triangle);
  void write_row(const ElementModes& modes, const Incidence& incidence, std::size_t v);
  void list(std::size_t vertex);

  Mass kind_;
  double density_, limit_;
  // Per triangle slot, (1/l - T^-1)_+ of the membrane and of the stencil, zero for most; where the mass is scaled,
  // l_max / l - 1 in their first entries.
  std::vector<Eigen::Matrix2d> in_plane_;
  std::vector<Eigen::Matrix3d> bent_;
  BlockMatrix<1> matrix_;
  // Working storage of update().
  std::uint32_t round_ = 0;
  std::vector<std::uint32_t> listed_in_, bent_in_;  // per vertex, per triangle slot: the last update that looked at it
  std::vector<std::size_t> rows_;
  std::vector<std::int32_t> columns_, place_;  // of the row under way; place_ per vertex, -1: none
  std::vector<double> values_;
  Eigen::Matrix<double, Eigen::Dynamic, 3> bending_rows_;
};

}  // namespace cutbench
