#include "harness/fem/model/largest_eigenvalue.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/fem/constraints/constraint_matrix.h"
#include "harness/fem/elements/added_mass.h"
#include "harness/fem/elements/copied_bending.h"
#include "harness/fem/elements/element_table.h"
#include "harness/fem/elements/membrane.h"
#include "harness/fem/elements/rest_stiffness.h"

namespace cutbench {

namespace {

using Eigen::VectorXd;

/// y = L^-1 C^T K C L^-T x, element by element, with L L^T = C^T M C.
class ScaledStiffness {
 public:
  ScaledStiffness(const ScaledStiffness&) = delete;
  ScaledStiffness& operator=(const ScaledStiffness&) = delete;
  ScaledStiffness(const Sheet& sheet, const Constraints& constraints, const Elasticity& elasticity)
      : lame_(lame_of({.stiffness = 1, .poisson = elasticity.poisson}, elasticity.plane)),
        elements_(sheet, constraints),
        constraint_matrix_(constraints, sheet.deformed_slots()),
        ghosts_(constraints.ghosts) {
    membrane_.emplace(elements_, lame_);
    lumped_ = elements_.areas(constraint_matrix_.vertices());
    if (elasticity.bending != BendingKind::none)
      bending_.emplace(sheet, elasticity.bending, elasticity.bending_length2, elasticity.poisson, &elements_);
    own_mass_ = VectorXd::Zero(to_index(constraint_matrix_.unknowns()));
    if (!constraints.lumped.empty()) lump(constraints);
    if (adds_mass(elasticity.mass)) add_mass(elasticity);
    if (bending_ && !constraints.copied.empty())  // no mass is added for how these bend
      bending_->replace(CopiedBending().all(sheet, constraints, *bending_), constraint_matrix_.unknowns());
    factor();
  }

  ElementModes modes() const {
    return {
        &elements_, {lumped_.data(), lumped_.size()}, bending_ ? &*bending_ : nullptr, 2 * (lame_.mu + lame_.lambda)};
  }
  double added_mass_share() const { return added_ ? added_->total() / lumped_.sum() : 0; }

  Eigen::Index size() const { return 2 * to_index(constraint_matrix_.unknowns()); }
  bool is_mass_positive() const { return is_mass_positive_; }

  void apply(const VectorXd& x, VectorXd& y) {
    scaled_ = Eigen::Map<const TwoPerUnknown>(x.data(), mass_.rows(), 2);
    mass_.matrixU().solveInPlace(scaled_);
    scaled_ = mass_.permutationPinv() * scaled_;
    constraint_matrix_.expand(2, Eigen::Map<const VectorXd>(scaled_.data(), size()), moved_);
    force_.setZero(moved_.size());
    membrane_->add_force(moved_, force_);
    // Bending acts on each coordinate alike, so that membrane and bending together are stiffest in the plane.
    force_.conservativeResize(size());
    force_.tail(size() - moved_.size()).setZero();
    if (bending_) bend();
    constraint_matrix_.reduce(2, force_.head(moved_.size()), y);
    y.tail(size() - moved_.size()) += force_.tail(size() - moved_.size());
    for (const GhostEdge& ghost : ghosts_) add_force(ghost, y);
    scaled_ = mass_.permutationP() * Eigen::Map<const TwoPerUnknown>(y.data(), mass_.rows(), 2);
    mass_.matrixL().solveInPlace(scaled_);
    y = Eigen::Map<const VectorXd>(scaled_.data(), size());
  }

 private:
  using TwoPerUnknown = Eigen::Matrix<double, Eigen::Dynamic, 2, Eigen::RowMajor>;

  /// The mass of copied elements in place of that of their triangles.
  void lump(const Constraints& constraints) {
    for (const Constraint& constraint : constraints.constraints) lumped_[constraint.vertex.value] = 0;
    for (const auto& [unknown, area] : constraints.lumped) {
      if (unknown.value < lumped_.size()) lumped_[unknown.value] = 0;
      own_mass_[unknown.value] = area;
    }
  }

  /// The force of vertices and, behind them, that of phantom nodes, which bend as vertices do.
  void bend() {
    VectorXd all(size());
    all.head(moved_.size()) = moved_;
    for (Eigen::Index u = moved_.size() / 2; u < scaled_.rows(); ++u)
      all.segment<2>(2 * u) = scaled_.row(u).transpose();
    add_product_per_coordinate(bending_->matrix(), 2, 1, all, force_);
  }

  void add_mass(const Elasticity& elasticity) {
    Incidence incidence;
    incidence.resize(constraint_matrix_.vertices());
    for (std::size_t e = 0; e < elements_.size(); ++e)
      if (elements_[e].alive()) incidence.add(elements_[e], e);
    std::vector<std::size_t> all(constraint_matrix_.vertices());
    std::iota(all.begin(), all.end(), 0);
    added_.emplace(elasticity.mass, 1, elasticity.mass_limit);
    added_->update(modes(), incidence, all);
  }

  /// Calls act(i, j, m) for the entries of the mass of the sheet's vertices, the diagonal first.
  template <class Act>
  void for_each_mass(const Act& act) const {
    for (Eigen::Index i = 0; i < lumped_.size(); ++i) act(i, i, lumped_[i]);
    for (std::size_t v = 0; added_ && v < added_->matrix().rows(); ++v) {
      std::int32_t slot = added_->matrix().first_slot(v);
      for (const std::int32_t j : added_->matrix().columns(v)) act(to_index(v), j, added_->matrix().block(slot++)(0));
    }
  }

  void factor() {
    const auto n = to_index(constraint_matrix_.unknowns());
    if (n == 0) return;
    std::vector<Eigen::Triplet<double>> entries;
    VectorXd diagonal = VectorXd::Zero(n);
    for (Eigen::Index u = 0; u < n; ++u)
      if (own_mass_[u] > 0) entries.emplace_back(to_int(u), to_int(u), diagonal[u] = own_mass_[u]);
    for_each_mass([&](Eigen::Index i, Eigen::Index j, double mass) {
      if (mass == 0) return;
      const auto &row = constraint_matrix_.row(to_size(i)), &column = constraint_matrix_.row(to_size(j));
      for (std::size_t k = 0; k < row.size; ++k)
        for (std::size_t l = 0; l < column.size; ++l)
          entries.emplace_back(row.unknown[k], column.unknown[l], row.weight[k] * column.weight[l] * mass);
      for (std::size_t k = 0; k < row.size && i == j; ++k) diagonal[row.unknown[k]] += mass;
    });
    for (const GhostEdge& ghost : ghosts_)
      for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t l = 0; l < 4; ++l)
          entries.emplace_back(ghost.unknown[k].value, ghost.unknown[l].value,
                               ghost.mass * ghost.jump[k] * ghost.jump[l]);
        diagonal[ghost.unknown[k].value] += ghost.mass;
      }
    for (Eigen::Index u = 0; u < n; ++u)  // what nothing depends on has no stiffness either, and any mass will do
      if (diagonal[u] == 0) entries.emplace_back(to_int(u), to_int(u), 1);
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    mass_.compute(matrix);
    is_mass_positive_ = mass_.info() == Eigen::Success;
  }

  void add_force(const GhostEdge& ghost, VectorXd& y) const {
    Eigen::RowVector2d jump = Eigen::RowVector2d::Zero();
    for (std::size_t k = 0; k < 4; ++k) jump += ghost.jump[k] * scaled_.row(ghost.unknown[k].value);
    for (std::size_t k = 0; k < 4; ++k)
      y.segment<2>(2 * ghost.unknown[k].value) += ghost.stiffness * ghost.jump[k] * jump.transpose();
  }

  Lame lame_;
  ElementTable elements_;
  std::optional<RestStiffness> membrane_;
  ConstraintMatrix constraint_matrix_;
  std::vector<GhostEdge> ghosts_;
  VectorXd lumped_, own_mass_;  // per vertex; per unknown: of copied elements
  std::optional<Bending> bending_;
  std::optional<AddedMass> added_;
  Eigen::SimplicialLLT<Eigen::SparseMatrix<double>> mass_;
  bool is_mass_positive_ = true;
  TwoPerUnknown scaled_;
  VectorXd moved_, force_;
};

}  // namespace

double largest_element_eigenvalue(const Sheet& sheet, const Elasticity& elasticity) {
  Elasticity lumped = elasticity;
  lumped.mass = Mass::lumped;
  return ScaledStiffness(sheet, {}, lumped).modes().largest();
}

double added_mass_share(const Sheet& sheet, const Constraints& constraints, const Elasticity& elasticity) {
  return ScaledStiffness(sheet, constraints, elasticity).added_mass_share();
}

double explicit_step_limit(double eigenvalue, const Material& material) {
  const double w2 = eigenvalue * material.stiffness / material.density;
  const double c = material.mass_damping + material.stiffness_damping * w2;
  return 4 / (c + std::sqrt(c * c + 4 * w2));
}

double largest_eigenvalue(const Sheet& sheet, const Constraints& constraints, const Elasticity& elasticity) {
  constexpr double tolerance = 1e-3;  // met at two checks, for at the first it may be met by the second largest
  constexpr int most_steps = 1000, between_checks = 8;
  ScaledStiffness stiffness(sheet, constraints, elasticity);
  const Eigen::Index n = stiffness.size();
  if (n == 0) return 0;
  if (!stiffness.is_mass_positive()) return std::numeric_limits<double>::quiet_NaN();
  std::mt19937_64 bits(1);  // its bits, unlike the distributions, are the same everywhere
  VectorXd q(n), before = VectorXd::Zero(n), next;
  for (double& x : q) x = to_double(bits() >> 11) * 0x1p-53 - 0.5;
  q.normalize();
  // Without orthogonalisation: what that costs is copies of eigenvalues already found.
  std::vector<double> diagonal, beside;
  bool met = false;
  for (int step = 1;; ++step) {
    stiffness.apply(q, next);
    const double alpha = q.dot(next);
    next -= alpha * q;
    if (!beside.empty()) next -= beside.back() * before;
    const double beta = next.norm();
    diagonal.push_back(alpha);
    const bool exhausted = step == n || beta <= 1e-14 * std::abs(alpha) || step == most_steps;
    if (exhausted || step % between_checks == 0) {
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> small;
      small.computeFromTridiagonal(Eigen::Map<VectorXd>(diagonal.data(), step),
                                   Eigen::Map<VectorXd>(beside.data(), step - 1));
      const double value = small.eigenvalues()[step - 1];
      const bool meets = beta * std::abs(small.eigenvectors()(step - 1, step - 1)) <= tolerance * value;
      if (exhausted || (meets && met)) return value;
      met = meets;
    }
    beside.push_back(beta);
    before.swap(q);
    q = next / beta;
  }
}

}  // namespace cutbench
