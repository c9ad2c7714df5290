#include "harness/fem/elements/membrane_sheet.h"

#include <algorithm>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/errors.h"
#include "harness/fem/algebra/growing_rows.h"
#include "harness/fem/elements/springs.h"

namespace cutbench {

namespace {

const Element no_element;

// What several threads share, and how finely.
constexpr std::size_t fours_of_job = 64, most_shares = 16, smallest_share = 256;  // the last two: of vertices

/// Element `i`, or one without vertices and area: past the end, a free slot, or a member of a compound.
const Element& element_at(const ElementTable& elements, std::size_t i) {
  return i < elements.size() && !elements[i].is_member() ? elements[i] : no_element;
}

template <class Function>
Lanes each_lane(const Function& of) {
  return Lanes{of(0), of(1), of(2), of(3)};
}

}  // namespace

/// Four consecutive elements side by side. Where there is none, its vertices are -1, and all else is zero.
template <int D>
struct MembraneSheet<D>::Four {
  Four(const ElementTable& elements, std::size_t first) {
    const std::array<const Element*, lane_count> e{&element_at(elements, first), &element_at(elements, first + 1),
                                                   &element_at(elements, first + 2), &element_at(elements, first + 3)};
    area = each_lane([&](std::size_t l) { return e[l]->material_area(); });
    for (std::size_t k = 0; k < 3; ++k) {
      gradient[k] = {each_lane([&](std::size_t l) { return e[l]->gradient[k].x; }),
                     each_lane([&](std::size_t l) { return e[l]->gradient[k].y; })};
      for (std::size_t l = 0; l < lane_count; ++l) vertex[k][l] = e[l]->vertex[k].value;
    }
  }
  /// x at corner k.
  std::array<Lanes, D> at(std::size_t k, const Field& x) const {
    std::array<const double*, lane_count> from;
    for (std::size_t l = 0; l < lane_count; ++l) from[l] = x.data() + D * std::max(0, vertex[k][l]);
    std::array<Lanes, D> p;
    for (std::size_t r = 0; r < D; ++r) p[r] = each_lane([&](std::size_t l) { return from[l][r]; });
    return p;
  }
  /// F, by its columns.
  std::array<std::array<Lanes, D>, 2> deformation_gradient(const Field& x) const {
    const auto a = at(0, x), b = at(1, x), c = at(2, x);
    std::array<std::array<Lanes, D>, 2> f;
    for (std::size_t r = 0; r < D; ++r) {
      f[0][r] = (b[r] - a[r]) * gradient[1].x + (c[r] - a[r]) * gradient[2].x;
      f[1][r] = (b[r] - a[r]) * gradient[1].y + (c[r] - a[r]) * gradient[2].y;
    }
    return f;
  }

  std::array<std::array<std::int32_t, lane_count>, 3> vertex;
  std::array<Vector2<Lanes>, 3> gradient;
  Lanes area;
};

namespace {

template <int D>
std::array<Lanes, D> normalised(const std::array<Lanes, D>& v) {
  const Lanes inverse = 1 / square_root(dot(v, v));
  std::array<Lanes, D> unit;
  for (std::size_t r = 0; r < D; ++r) unit[r] = v[r] * inverse;
  return unit;
}

/// The rotation nearest to F, in the plane of its columns: (F + its cofactors) / |...|, where the cofactors are F's
/// columns exchanged and turned by a right angle. `determined` is negative in the lanes where it can't be told.
std::array<std::array<Lanes, 2>, 2> nearest_rotation(const std::array<std::array<Lanes, 2>, 2>& f, Lanes& determined) {
  const std::array<Lanes, 2> sum{f[0][0] + f[1][1], f[0][1] - f[1][0]};
  determined = dot(sum, sum) - 1e-28 * (dot(f[0], f[0]) + dot(f[1], f[1]));
  const std::array<Lanes, 2> x = normalised<2>(sum);
  return {x, {-x[1], x[0]}};
}
std::array<std::array<Lanes, 3>, 2> nearest_rotation(const std::array<std::array<Lanes, 3>, 2>& f, Lanes& determined) {
  const std::array<Lanes, 3> across = cross(f[0], f[1]), normal = normalised<3>(across), turned = cross(f[1], normal);
  determined = dot(across, across) - 1e-28 * dot(f[0], f[0]) * dot(f[1], f[1]);
  const std::array<Lanes, 3> x = normalised<3>({f[0][0] + turned[0], f[0][1] + turned[1], f[0][2] + turned[2]});
  return {x, cross(normal, x)};
}

template <int D>
StrainInFrame<D, Lanes> strain_of(const std::array<std::array<Lanes, D>, 2>& f, Strain strain, Lanes& determined) {
  StrainInFrame<D, Lanes> e;
  switch (strain) {
    case Strain::linear:
      e.frame = {};
      e.frame[0][0] += 1;
      e.frame[1][1] += 1;
      break;
    case Strain::corotational:
      e.frame = nearest_rotation(f, determined);
      break;
    case Strain::green:
    case Strain::springs:
      e.frame = f;
      e.xx = (dot(f[0], f[0]) - 1) / 2;
      e.yy = (dot(f[1], f[1]) - 1) / 2;
      e.xy = dot(f[0], f[1]) / 2;
      return e;
  }
  e.xx = dot(e.frame[0], f[0]) - 1;
  e.yy = dot(e.frame[1], f[1]) - 1;
  e.xy = (dot(e.frame[0], f[1]) + dot(e.frame[1], f[0])) / 2;
  return e;
}

template <int D>
StrainInFrame<D, double> lane(const StrainInFrame<D, Lanes>& four, std::size_t l) {
  StrainInFrame<D, double> one;
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t r = 0; r < D; ++r) one.frame[k][r] = four.frame[k][r][l];
  one.xx = four.xx[l];
  one.xy = four.xy[l];
  one.yy = four.yy[l];
  return one;
}

template <int D>
void set_lane(const StrainInFrame<D, double>& one, std::size_t l, StrainInFrame<D, Lanes>& four) {
  for (std::size_t k = 0; k < 2; ++k)
    for (std::size_t r = 0; r < D; ++r) four.frame[k][r][l] = one.frame[k][r];
  four.xx[l] = one.xx;
  four.xy[l] = one.xy;
  four.yy[l] = one.yy;
}

bool all_positive(Lanes x) { return x[0] > 0 && x[1] > 0 && x[2] > 0 && x[3] > 0; }

}  // namespace

template <int D>
void MembraneSheet<D>::resize(std::size_t elements) {
  const std::size_t fours = (elements + lane_count - 1) / lane_count;
  shares_are_old_ = true;
  strained_.resize(fours);
  constexpr FourSlots none{-1, -1, -1, -1};
  slots_.resize(fours, {{{none, none, none}, {none, none, none}, {none, none, none}}});
}

template <int D>
void MembraneSheet<D>::reserve_spare() {
  cutbench::reserve_spare(slots_, strained_);
}

template <int D>
void MembraneSheet<D>::clear_slots(std::size_t triangle) {
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) set_slot(triangle, i, j, -1);
}

template <int D>
void MembraneSheet<D>::find_slots(const ElementTable& elements, std::size_t vertex, std::span<const HalfEdge> triangles,
                                  const BlockMatrix<D>& blocks) {
  compounds_.find_slots(elements, vertex, blocks);
  for (const HalfEdge c : triangles) {
    const std::size_t t = triangle_of(c)();
    if (!elements[t].is_triangle()) continue;
    for (std::size_t j = 0; j < 3; ++j)
      set_slot(t, to_size(corner_of(c)), j, blocks.find(vertex, elements[t].vertex[j].value));
  }
}

template <int D>
void MembraneSheet<D>::join(const ElementTable& elements, TriangleIndex t) {
  compounds_.reset(elements, t);
  for (const TriangleIndex member : elements.members(t)) clear_slots(member());
}

template <int D>
void MembraneSheet<D>::check_takes(const Constraints& constraints) const {
  if (law_.strain == Strain::springs && constraints.merge_triangles())
    throw InputError("a polygon has no springs: take another method than cut_polygons, or another \"strain\"");
}

// --- who computes what -----------------------------------------------------------------------------------------------

template <int D>
void MembraneSheet<D>::find_shares(const ElementTable& elements, std::size_t vertices) {
  const bool are_of_these = !shares_.empty() && shares_.back().end == to_int32(vertices);
  if (!std::exchange(shares_are_old_, false) && are_of_these) return;
  const std::size_t length = std::max(smallest_share, (vertices + most_shares - 1) / most_shares);
  shares_.resize((vertices + length - 1) / length);
  for (std::size_t k = 0; k < shares_.size(); ++k) {
    shares_[k].begin = to_int32(k * length);
    shares_[k].end = to_int32(std::min(vertices, (k + 1) * length));
    shares_[k].elements.clear();
  }
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const Element& element = element_at(elements, e);
    if (!element.alive()) continue;
    for (const DeformedIndex v : element.vertex) {
      auto& mine = shares_[v() / length].elements;
      if (mine.empty() || mine.back() != to_int32(e)) mine.push_back(to_int32(e));
    }
  }
}

/// Calls act(share, i) for each four elements of which a share has one, in their order.
template <int D>
template <class Act>
void MembraneSheet<D>::share_vertices(const ElementTable& elements, std::size_t vertices, Workers& workers,
                                      const Act& act) {
  find_shares(elements, vertices);
  workers.run(shares_.size(), [&](std::size_t k) {
    std::size_t last = elements.size();
    for (const std::int32_t e : shares_[k].elements)
      if (const std::size_t i = to_size(e) / lane_count; std::exchange(last, i) != i) act(shares_[k], i);
  });
}

// --- of a state ------------------------------------------------------------------------------------------------------

template <int D>
void MembraneSheet<D>::rotate(const ElementTable& elements, const Field& x, Workers& workers) {
  force_.setZero(x.size());
  if (workers.acts_alone()) {
    for (std::size_t i = 0; i < strained_.size(); ++i) {
      const Four four(elements, lane_count * i);
      strain(elements, four, i, x);
      add_forces(four, strained_[i], [](std::int32_t vertex) { return vertex >= 0; });
    }
  } else {
    workers.run((strained_.size() + fours_of_job - 1) / fours_of_job, [&](std::size_t job) {
      for (std::size_t i = fours_of_job * job; i < std::min(fours_of_job * (job + 1), strained_.size()); ++i)
        strain(elements, Four(elements, lane_count * i), i, x);
    });
    share_vertices(elements, to_size(x.size()) / D, workers, [&](const Share& mine, std::size_t i) {
      add_forces(Four(elements, lane_count * i), strained_[i], [&](std::int32_t vertex) { return mine.has(vertex); });
    });
  }
  compounds_.rotate(elements, x, force_);
}

template <int D>
void MembraneSheet<D>::strain(const ElementTable& elements, const Four& four, std::size_t i, const Field& x) {
  Lanes determined = Lanes{} + 1;
  strained_[i] = strain_of<D>(four.deformation_gradient(x), law_.strain, determined);
  if (!all_positive(determined)) recompute_collapsed(elements, i, determined, x);
}

/// Elements that collapsed, one by one; where there is none, it is as at rest.
template <int D>
void MembraneSheet<D>::recompute_collapsed(const ElementTable& elements, std::size_t i, Lanes determined,
                                           const Field& x) {
  for (std::size_t l = 0; l < lane_count; ++l) {
    if (determined[l] > 0) continue;
    const Element& element = element_at(elements, lane_count * i + l);
    StrainInFrame<D, double> one{};
    one.frame[0][0] = one.frame[1][1] = 1;
    if (element.alive()) one = cutbench::strain_of<D>(deformation_of<D>(element, x, law_.strain, law_.lame));
    set_lane(one, l, strained_[i]);
  }
}

/// -A B s g at each corner (membrane_force()).
template <int D>
template <class Has>
void MembraneSheet<D>::add_forces(const Four& four, const Strained& e, const Has& has) {
  const auto [mu, lambda] = law_.lame;
  const Lanes pressure = lambda * (e.xx + e.yy);
  Lanes sxx = 2 * mu * e.xx + pressure, syy = 2 * mu * e.yy + pressure, sxy = 2 * mu * e.xy;
  if (law_.strain == Strain::springs) {
    const auto s = Springs<D, Lanes>(four.gradient, e.frame).stress(young_of(law_.lame));
    sxx = s.xx;
    syy = s.yy;
    sxy = s.xy;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const auto& [gx, gy] = four.gradient[k];
    const Lanes along = four.area * (sxx * gx + sxy * gy), across = four.area * (sxy * gx + syy * gy);
    std::array<Lanes, D> pull;
    for (std::size_t r = 0; r < D; ++r) pull[r] = e.frame[0][r] * along + e.frame[1][r] * across;
    for (std::size_t l = 0; l < lane_count; ++l) {
      if (!has(four.vertex[k][l])) continue;
      double* const to = force_.data() + D * four.vertex[k][l];
      for (std::size_t r = 0; r < D; ++r) to[r] -= pull[r][l];
    }
  }
}

template <int D>
double MembraneSheet<D>::energy(const ElementTable& elements, Workers& workers) const {
  const auto energy_of = [&](std::size_t begin, std::size_t end) {
    Lanes sum{};
    for (std::size_t i = begin; i < end; ++i) {
      const Four four(elements, lane_count * i);
      if (law_.strain == Strain::springs) {
        sum += four.area * Springs<D, Lanes>(four.gradient, strained_[i].frame).energy(young_of(law_.lame));
        continue;
      }
      const Lanes xx = strained_[i].xx, yy = strained_[i].yy, xy = strained_[i].xy, trace = xx + yy;
      sum += four.area * (law_.lame.mu * (xx * xx + yy * yy + 2 * (xy * xy)) + law_.lame.lambda / 2 * (trace * trace));
    }
    return sum[0] + sum[1] + sum[2] + sum[3];
  };
  return workers.sum_ranges(strained_.size(), energy_of) + compounds_.energy(elements);
}

template <int D>
Deformation<D> MembraneSheet<D>::deformation(const ElementTable& elements, std::size_t element) const {
  if (elements[element].is_member()) return compounds_.deformation(elements[element]);
  return deformation_of<D>(elements[element], lane<D>(strained_[element / lane_count], element % lane_count),
                           law_.strain, law_.lame);
}

template <int D>
void MembraneSheet<D>::add_stiffness(const ElementTable& elements, double factor, BlockMatrix<D>& blocks,
                                     Workers& workers) {
  if (workers.acts_alone()) {
    for (std::size_t i = 0; i < strained_.size(); ++i)
      add_stiffness(Four(elements, lane_count * i), factor, strained_[i], slots_[i], blocks);
  } else {
    share_vertices(elements, blocks.rows(), workers, [&](const Share& mine, std::size_t i) {
      const Four four(elements, lane_count * i);
      NineSlots slots = slots_[i];
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t l = 0; l < lane_count; ++l)
          if (!mine.has(four.vertex[a][l]))
            for (auto& four_slots : slots[a]) four_slots[l] = -1;
      add_stiffness(four, factor, strained_[i], slots, blocks);
    });
  }
  compounds_.add_stiffness(elements, factor, blocks);
}

template <int D>
void MembraneSheet<D>::add_stiffness(const Four& four, double factor, const Strained& strained, const NineSlots& slots,
                                     BlockMatrix<D>& blocks) const {
  const ElementStiffness<D, Lanes> k(four.gradient, factor * four.area, strained, law_);
  for (std::size_t a = 0; a < 3; ++a) {
    blocks.add(slots[a][a], k.block(a, a));
    for (std::size_t b = a + 1; b < 3; ++b) {
      const auto block = k.block(a, b);
      blocks.add(slots[a][b], block);
      blocks.add(slots[b][a], mirrored<D>(block));
    }
  }
}

template class MembraneSheet<2>;
template class MembraneSheet<3>;

}  // namespace cutbench
