#include "harness/fem/model/settle.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <array>
#include <map>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/fem/elements/compound_sheet.h"
#include "harness/fem/elements/element_stiffness.h"

namespace cutbench {

namespace {

constexpr int most_iterations = 10, most_halvings = 10;
constexpr double settled = 1e-3;              // of the energy, still to be gained
constexpr double sufficient_decrease = 1e-4;  // Nocedal and Wright, Numerical Optimization, 2006, 3.1

/// A vertex that moves, and with which others: all of a group by the same.
struct Mover {
  std::int32_t vertex, group;
  bool operator<(const Mover& other) const { return vertex < other.vertex; }
};

/// The energy near the vertices that move, as a function of how far their groups do.
class NearVertices {
 public:
  /// \param movers  in order
  NearVertices(const Model<3>& model, const std::vector<Mover>& movers, std::int32_t groups)
      : model_(model),
        law_(positive(law_of(model.material(), model.physics()))),
        compound_law_(law_, model.twist()),
        movers_(movers),
        groups_(groups) {
    for (const Mover& mover : movers_) {
      const auto v = to_size(mover.vertex);
      for (const HalfEdge corner : model.incidence().at(v))
        if (const std::size_t e = triangle_of(corner)(); model.elements()[e].is_triangle()) triangles_.push_back(e);
      for (const std::int32_t p : model.elements().polygons_of(v)) compounds_.push_back(to_size(p));
      for (const auto& holder : model.bending()->stencils_of(v)) stencils_.push_back(to_size(holder.triangle));
    }
    for (auto* list : {&triangles_, &compounds_, &stencils_}) {
      std::sort(list->begin(), list->end());
      list->erase(std::unique(list->begin(), list->end()), list->end());
    }
  }

  double energy(const Field& x) {
    double sum = 0;
    for (const std::size_t e : triangles_) {
      const Element& element = model_.elements()[e];
      sum += element.material_area() * deformation_of<3>(element, x, law_.strain, law_.lame).energy;
    }
    for (const std::size_t p : compounds_) {
      const PolygonElement& compound = model_.elements().polygon(p);
      compound_law_.bend(compound, x, bent_);
      sum += compound_law_.energy(compound, bent_);
    }
    for (const std::size_t t : stencils_) sum += stencil_energy(model_.bending()->stencil(t), x, 3);
    return sum;
  }

  /// A step of Newton's method, from these forces. False: there is none.
  bool solve(const Field& x, Field& force, Field& dx) {
    force.setZero(3 * groups_);
    entries_.clear();
    for (const std::size_t e : triangles_) add_triangle(model_.elements()[e], x, force);
    for (const std::size_t p : compounds_) add_compound(model_.elements().polygon(p), x, force);
    for (const Mover& mover : movers_) add_bending(mover, x, force);
    matrix_.resize(3 * groups_, 3 * groups_);
    matrix_.setFromTriplets(entries_.begin(), entries_.end());
    factor_.compute(matrix_);
    if (factor_.info() != Eigen::Success) return false;
    dx = factor_.solve(force);
    return dx.allFinite();
  }

  /// Moves them to `from`, plus a share of a step.
  void place(const std::vector<Eigen::Vector3d>& from, double share, const Field& dx, Field& x) const {
    for (std::size_t i = 0; i < movers_.size(); ++i)
      x.segment<3>(3 * movers_[i].vertex) = from[i] + share * dx.segment<3>(3 * movers_[i].group);
  }

 private:
  /// -1: it stays.
  std::int32_t group_of(std::int32_t vertex) const {
    const auto at = std::lower_bound(movers_.begin(), movers_.end(), Mover{vertex, 0});
    return at != movers_.end() && at->vertex == vertex ? at->group : -1;
  }

  static MembraneLaw positive(MembraneLaw law) {
    if (law.of_stress == StressStiffness::full) law.of_stress = StressStiffness::positive;
    return law;
  }

  void add_triangle(const Element& element, const Field& x, Field& force) {
    const Deformation<3> now = deformation_of<3>(element, x, law_.strain, law_.lame);
    const ElementStiffness<3> tangent(element, now, law_);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t row = group_of(element.vertex[i].value);
      if (row < 0) continue;
      force.segment<3>(3 * row) += membrane_force(element, now, to_int(i));
      for (std::size_t j = 0; j < 3; ++j) {
        const std::int32_t column = group_of(element.vertex[j].value);
        if (column < 0) continue;
        const auto block = tangent.block(i, j);
        add_block(row, column, Eigen::Map<const Eigen::Matrix3d>(block.data()));
      }
    }
  }

  void add_compound(const PolygonElement& compound, const Field& x, Field& force) {
    compound_law_.bend(compound, x, bent_);
    compound_law_.stiffness(compound, bent_, blocks_);
    const std::size_t k = compound.size();
    for (std::size_t i = 0; i < k; ++i) {
      const std::int32_t row = group_of(compound.polygon.corners[i].value);
      if (row < 0) continue;
      force.segment<3>(3 * row) += bent_.force.col(to_index(i));
      for (std::size_t j = 0; j < k; ++j)
        if (const std::int32_t column = group_of(compound.polygon.corners[j].value); column >= 0)
          add_block(row, column, blocks_[k * i + j]);
    }
  }

  void add_block(std::int32_t row, std::int32_t column, const Eigen::Matrix3d& block) {
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r) entries_.emplace_back(3 * row + r, 3 * column + c, block(r, c));
  }

  void add_bending(const Mover& mover, const Field& x, Field& force) {
    const BlockMatrix<1>& matrix = model_.bending()->matrix();
    const auto v = to_size(mover.vertex);
    const auto columns = matrix.columns(v);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const double factor = matrix.block(matrix.first_slot(v) + to_int32(k))(0);
      force.segment<3>(3 * mover.group) -= factor * x.segment<3>(3 * columns[k]);
      const std::int32_t column = group_of(columns[k]);
      for (int r = 0; r < 3 && column >= 0; ++r) entries_.emplace_back(3 * mover.group + r, 3 * column + r, factor);
    }
  }

  const Model<3>& model_;
  const MembraneLaw law_;
  const CompoundLaw<3> compound_law_;
  const std::vector<Mover>& movers_;
  const std::int32_t groups_;
  std::vector<std::size_t> triangles_, compounds_, stencils_;
  BentCompound<3> bent_;
  std::vector<Eigen::Matrix3d> blocks_;
  std::vector<Eigen::Triplet<double, std::int32_t>> entries_;
  Eigen::SparseMatrix<double> matrix_;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor_;
};

/// Vertices of the opened sheet that the cut made or moved, with a group for each place in space: lips that are
/// together stay so. Those of an older incision, which are apart, have a group each.
std::vector<Mover> movers_of(const Model<3>& model, const Sheet& sheet, const Field& x, std::int32_t& groups) {
  std::vector<VertexIndex> rest = sheet.log().new_vertices;
  for (const auto& moved : sheet.log().moved) rest.push_back(moved.vertex);
  std::sort(rest.begin(), rest.end());
  std::map<std::array<double, 4>, std::int32_t> places;
  std::vector<Mover> movers;
  for (const auto& made : sheet.log().ancestry) {
    const auto v = to_size(made.vertex.value);
    const VertexIndex of = sheet.rest_vertex(made.vertex);
    const bool held = model.held()[3 * v] || model.held()[3 * v + 1] || model.held()[3 * v + 2];
    if (!of.valid() || held || !std::binary_search(rest.begin(), rest.end(), of)) continue;
    const auto at = x.segment<3>(to_index(3 * v));
    const auto [place, is_new] = places.try_emplace({to_double(of.value), at[0], at[1], at[2]}, groups);
    groups += is_new;
    movers.push_back({made.vertex.value, place->second});
  }
  std::sort(movers.begin(), movers.end());
  const auto same = [](const Mover& a, const Mover& b) { return a.vertex == b.vertex; };
  movers.erase(std::unique(movers.begin(), movers.end(), same), movers.end());
  return movers;
}

}  // namespace

template <>
void settle_new_vertices(const Model<2>&, const Sheet&, Field&) {}

template <>
void settle_new_vertices(const Model<3>& model, const Sheet& sheet, Field& x) {
  if (!model.bending() || sheet.unrolled()) return;
  std::int32_t groups = 0;
  const std::vector<Mover> movers = movers_of(model, sheet, x, groups);
  if (movers.empty()) return;
  NearVertices near(model, movers, groups);
  Field force, dx;
  std::vector<Eigen::Vector3d> from(movers.size());
  double energy = near.energy(x);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    if (!near.solve(x, force, dx)) return;
    const double slope = force.dot(dx);
    if (!(slope > settled * energy)) return;
    for (std::size_t i = 0; i < movers.size(); ++i) from[i] = x.segment<3>(3 * movers[i].vertex);
    double share = 1, reached = energy;
    for (int halving = 0; halving <= most_halvings; ++halving, share /= 2) {
      near.place(from, share, dx, x);
      reached = near.energy(x);
      if (reached <= energy - sufficient_decrease * share * slope) break;
    }
    if (!(reached < energy)) return near.place(from, 0, dx, x);
    energy = reached;
  }
}

}  // namespace cutbench
