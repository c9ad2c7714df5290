#include "harness/fem/elements/bending.h"

#include <algorithm>
#include <utility>

#include "harness/base/conversions.h"

namespace cutbench {

double stencil_energy(std::span<const StencilTerm> terms, const Field& x, int dimension) {
  double sum = 0;
  for (int axis = 0; axis < dimension; ++axis) {
    std::array<double, 3> row{};
    for (const auto& [vertex, factor] : terms)
      for (std::size_t k = 0; k < 3; ++k) row[k] += factor[k] * x[dimension * vertex + axis];
    sum += row[0] * row[0] + row[1] * row[1] + row[2] * row[2];
  }
  return sum / 2;
}

Bending::Bending(const Sheet& sheet, BendingKind kind, double rigidity, double poisson, const ElementTable* elements)
    : kind_of_(kind), kind_(&row_of(kind)), rigidity_(rigidity), poisson_(poisson) {
  resize(sheet.triangle_slots(), sheet.deformed_slots());
  work_.elements = elements;
  ++work_.call;
  if (!kind_->has_slopes) seams_ = SeamEdges(sheet);  // hinges go over seams; patches end there, as at the border
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) mark_stale(TriangleIndex(t), 0);
  rebuild(sheet);
}

void Bending::reserve_spare() {
  slopes_.reserve_spare();
  stencils_.reserve_spare();
  stencils_of_.reserve_spare();
  matrix_.reserve_spare();
  cutbench::reserve_spare(reach_, work_.stale_in, work_.refitted_in, work_.listed_in, work_.place);
}

double Bending::update(const Sheet& sheet, const ElementTable* elements, std::span<const TriangleIndex> regrouped,
                       const PlacesAtCut* places) {
  resize(sheet.triangle_slots(), std::max(sheet.deformed_slots(), matrix_.rows()));
  work_.elements = elements;
  ++work_.call;
  if (!kind_->has_slopes) seams_.update(sheet);
  find_stale(sheet, regrouped);
  return rebuild(sheet, places);
}

double Bending::energy(const Field& x, int dimension, Workers& workers) const {
  return workers.sum_ranges(stencils_.size(), [&](std::size_t begin, std::size_t end) {
    double sum = 0;
    for (std::size_t t = begin; t < end; ++t) sum += stencil_energy(stencils_[t], x, dimension);
    return sum;
  });
}

void Bending::resize(std::size_t triangles, std::size_t vertices) {
  slopes_.resize(triangles);
  reach_.resize(triangles);
  stencils_.resize(triangles);
  is_replaced_.resize(triangles);
  work_.stale_in.resize(triangles);
  work_.refitted_in.resize(triangles);
  stencils_of_.resize(vertices);
  matrix_.resize(vertices);
  work_.listed_in.resize(vertices);
  work_.place.resize(vertices, -1);
  work_.row.resize(vertices);
  work_.stale.clear();
  work_.rows.clear();
}

void Bending::replace(const ReplacedStencils& replaced, std::size_t vertices) {
  resize(stencils_.size(), vertices);
  ++work_.call;
  for (std::size_t i = 0; i < replaced.slots.size(); ++i) {
    const TriangleIndex t = replaced.slots[i];
    const auto terms = replaced.rows[i], before = stencils_[t()];
    is_replaced_[t()] = 1;
    if (std::equal(terms.begin(), terms.end(), before.begin(), before.end())) continue;
    work_.terms.assign(terms.begin(), terms.end());
    for (std::size_t k = 0; k < terms.size(); ++k) work_.place[to_size(terms[k].vertex)] = to_int32(k);
    replace_stencil(t());
  }
  for (const std::int32_t vertex : work_.rows) write_row(to_size(vertex));
}

void Bending::clear_replaced() {
  resize(stencils_.size(), matrix_.rows());
  ++work_.call;
  work_.terms.clear();
  for (std::size_t t = 0; t < is_replaced_.size(); ++t)
    if (std::exchange(is_replaced_[t], 0)) replace_stencil(t);
  for (const std::int32_t vertex : work_.rows) write_row(to_size(vertex));
}

// --- what a cut makes stale ------------------------------------------------------------------------------------------

/// The triangles of the element that t belongs to.
std::span<const TriangleIndex> Bending::members(const TriangleIndex& t) const { return members_of(work_.elements, t); }

void Bending::mark_stale(TriangleIndex t, int distance) {
  if (work_.stale_in[t()] == work_.call) return;
  for (const TriangleIndex member : members(t)) {
    work_.stale_in[member()] = work_.call;
    work_.stale.push_back({member, distance});
  }
}

/// Breadth first from the triangles that changed. A patch that reached a changed triangle over r edges, the first one
/// on its way, still finds a changed one behind the same edges: neighbours of what changed are linked anew, but not
/// logged.
void Bending::find_stale(const Sheet& sheet, std::span<const TriangleIndex> regrouped) {
  for (const TriangleIndex t : regrouped) mark_stale(t, 0);
  for (const auto& touched : sheet.log().touched) mark_stale(touched.slot, 0);
  for (std::size_t t = sheet.log().triangles_before; t < sheet.triangle_slots(); ++t) mark_stale(TriangleIndex(t), 0);
  for (const TriangleIndex t : seams_.changed()) mark_stale(t, 0);
  for (std::size_t i = 0; i < work_.stale.size(); ++i) {
    const auto [t, distance] = work_.stale[i];
    if (!sheet.triangle(t).alive() || distance > longest_reach_) continue;
    for (std::size_t k = 0; k < 3; ++k)
      if (const HalfEdge o = sheet.triangle(t).opposite[k];
          o.valid() && sheet.triangle(t).mark[k] != EdgeMark::incision)
        mark_stale(triangle_of(o), distance + 1);
  }
}

bool Bending::stencil_is_stale(const Sheet& sheet, TriangleIndex t) const {
  for (const TriangleIndex member : members(t)) {
    if (work_.refitted_in[member()] == work_.call) return true;
    for (const HalfEdge o : sheet.triangle(member).opposite)
      if (o.valid() && work_.refitted_in[triangle_of(o)()] == work_.call) return true;
  }
  return false;
}

double Bending::rebuild(const Sheet& sheet, const PlacesAtCut* places) {
  for (const auto& [t, distance] : work_.stale)
    if (t == members(t).front() && distance <= reach_[t()]) fit_patch(sheet, t);
  BendingStencil stencil{sheet,   rigidity_,   poisson_,    work_.elements,
                         slopes_, work_.place, work_.terms, seams_.across()};
  double change = 0;
  work_.rebuilt.clear();
  for (const auto& [t, distance] : work_.stale) {
    if (!stencil_is_stale(sheet, t)) continue;
    work_.rebuilt.push_back(t);
    work_.terms.clear();
    if (sheet.triangle(t).alive() && t == members(t).front()) kind_->add_rows(stencil, t);
    if (places)
      change += stencil_energy(work_.terms, places->after, 3) - stencil_energy(stencils_[t()], places->before, 3);
    replace_stencil(t());
    is_replaced_[t()] = 0;
  }
  for (const std::int32_t vertex : work_.rows) write_row(to_size(vertex));
  return change;
}

void Bending::fit_patch(const Sheet& sheet, TriangleIndex t) {
  for (const TriangleIndex member : members(t)) work_.refitted_in[member()] = work_.call;
  if (!kind_->has_slopes) return;
  if (!sheet.triangle(t).alive()) return slopes_.set(t(), {});
  const int reach = work_.patch.fit(sheet, work_.elements, t);
  longest_reach_ = std::max(longest_reach_, reach);
  for (const TriangleIndex member : members(t)) {
    reach_[member()] = reach;
    slopes_.set(member(), work_.patch.terms(sheet.corners(member)));
  }
}

// --- matrix ----------------------------------------------------------------------------------------------------------

void Bending::put_on_list(std::int32_t vertex) {
  auto& listed = work_.listed_in[to_size(vertex)];
  if (listed == work_.call) return;
  listed = work_.call;
  work_.rows.push_back(vertex);
}

void Bending::replace_stencil(std::size_t t) {
  const auto slot = to_int32(t);
  for (const StencilTerm& term : stencils_[t]) {
    const auto vertex = to_size(term.vertex);
    put_on_list(term.vertex);
    if (work_.place[vertex] < 0) {
      stencils_of_.erase(vertex, {slot, 0});
    } else {  // it stays
      stencils_of_.replace(vertex, {slot, work_.place[vertex]});
      work_.place[vertex] = -1;
    }
  }
  stencils_.set(t, work_.terms);
  for (const StencilTerm& term : work_.terms) {
    const auto vertex = to_size(term.vertex);
    if (work_.place[vertex] < 0) continue;
    put_on_list(term.vertex);
    stencils_of_.insert(vertex, {slot, work_.place[vertex]});
    work_.place[vertex] = -1;
  }
}

/// Sums a row of the matrix from the stencils that hold its vertex, in the order of their triangles, so that the sums
/// don't depend on the cuts that led here.
void Bending::write_row(std::size_t vertex) {
  RowSum<double>& row = work_.row;
  row.clear();
  const auto stencils = stencils_of_[vertex];
  if (!stencils.empty()) row[to_int32(vertex)] = 0;
  for (const auto& [t, mine] : stencils) {
    const auto terms = stencils_[to_size(t)];
    const auto f = terms[to_size(mine)].factor;
    for (const auto& [column, g] : terms) row[column] += f[0] * g[0] + f[1] * g[1] + f[2] * g[2];
  }
  matrix_.set_row(vertex, row.columns());
  std::int32_t slot = matrix_.first_slot(vertex);
  for (const double value : row.sums()) matrix_.block(slot++)(0) = value;
}

}  // namespace cutbench
