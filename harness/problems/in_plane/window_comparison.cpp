#include "harness/problems/in_plane/window_comparison.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/problems/common/quadrature.h"

namespace cutbench {

namespace {

/// Is this edge on the border of the unit square?
bool on_square(Point2 a, Point2 b) {
  return (a.x == b.x && (a.x == 0 || a.x == 1)) || (a.y == b.y && (a.y == 0 || a.y == 1));
}

}  // namespace

WindowComparison::WindowComparison(const WindowCase& window, const Specimen& specimen, const Sheet& sheet,
                                   const StaticSolve& solve, const ElasticField& field)
    : window_(window),
      sheet_(sheet),
      solve_(solve),
      field_(field),
      border_(border_work(field, uniform_field(field.elastic(), field.frame(), window.before), specimen.cuts,
                          window.cut_off)) {
  for (const LipSample& lip : window.lips) lips_.push_back({in_rest(lip.at), turned(lip.normal), lip.length});
  opening_ = opening(field, lips_);
  border_.after += work_on_lips();
  find_fallen();
  sample_elements();
  if (window.rim) find_rim();
  for (const WindowTip& end : window.tips) {
    if (!end.modes) continue;
    const Tip tip{in_rest(end.tip.at), field.frame().angle + end.tip.angle, end.tip.curvature};
    intensities_.emplace_back(sheet, solve.elements(), field.elastic(), tip, end.modes(field.frame()), Ring{},
                              solve.tip_functions());
    tips_.push_back(tip);
  }
}

Point2 WindowComparison::in_rest(Point2 local) const { return field_.frame().to_rest({local.x, local.y}); }

Point2 WindowComparison::turned(Point2 local) const {
  return Axes{{0, 0}, field_.frame().angle}.to_rest({local.x, local.y});
}

bool WindowComparison::looked_at(std::size_t element) const {
  const Element& e = solve_.elements()[element];
  return e.alive() && !solve_.loose(e.vertex[0]) && !fallen_[element];
}

/// Marks pieces that no edge joins to the border, or that lie where a cut takes the border's piece off: some methods
/// leave such a piece hanging by a vertex, and there is no exact solution in it.
void WindowComparison::find_fallen() {
  fallen_.assign(solve_.elements().size(), 0);
  std::vector<std::uint8_t> seen(fallen_.size());
  std::vector<TriangleIndex> piece;
  for (std::size_t start = 0; start < seen.size(); ++start) {
    if (!sheet_.triangle(TriangleIndex(start)).alive() || std::exchange(seen[start], 1)) continue;
    piece.assign(1, TriangleIndex(start));
    bool held = false;
    double whole = 0, off = 0;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const auto c = sheet_.corners(piece[i]);
      const double area = cross(c[1] - c[0], c[2] - c[0]);
      whole += area;
      if (window_.cut_off && window_.cut_off(field_.frame().to_local(1.0 / 3 * (c[0] + c[1] + c[2])))) off += area;
      for (int k = 0; k < 3; ++k) {
        const HalfEdge h = half_edge(piece[i], k);
        held = held || on_square(c[to_size(k)], c[to_size((k + 1) % 3)]);
        if (sheet_.separates(h)) continue;
        const TriangleIndex next = triangle_of(sheet_.opposite(h));
        if (!std::exchange(seen[next()], 1)) piece.push_back(next);
      }
    }
    if (held && off <= whole / 2) continue;
    for (const TriangleIndex t : piece) fallen_[t()] = 1;
  }
}

void WindowComparison::sample_elements() {
  std::vector<Point2> tips;
  for (const WindowTip& end : window_.tips) tips.push_back(in_rest(end.tip.at));
  for (std::size_t e = 0; e < solve_.elements().size(); ++e) {
    if (!looked_at(e)) continue;
    const auto corners = sheet_.corners(TriangleIndex(e));
    integrate(corners, tips, 1, [&](Point2 p, double weight) {
      const auto exact = field_.state(p);
      samples_.push_back({p - corners[0], weight * solve_.elements()[e].fraction, exact.stress, exact.displacement});
    });
    elements_.push_back({e, samples_.size()});
  }
  // Deleted material takes its energy with it. Other methods have all of the area, and none of this.
  double area = 0;
  for (std::size_t e = 0; e < solve_.elements().size(); ++e)
    if (solve_.elements()[e].alive()) {
      const auto c = sheet_.corners(TriangleIndex(e));
      area += cross(c[1] - c[0], c[2] - c[0]) / 2;
    }
  if (area > 1 - 1e-6) return;
  double sampled = 0;
  for (const Sample& sample : samples_)
    sampled += sample.weight * sample.stress.cwiseProduct(field_.elastic().strain(sample.stress)).sum();
  missing_ = std::max(0.0, 2 * border_.after - sampled);
}

/// Half of the load on the lips times what they move.
double WindowComparison::work_on_lips() const {
  if (!window_.on_lips) return 0;
  double work = 0;
  for (const LipSample& lip : window_.lips) {
    const Point2 at = in_rest(lip.at), up = turned(lip.normal),
                 force = turned([&] {
                   const Eigen::Vector2d load = window_.on_lips(lip.at.x);
                   return Point2{load.x(), load.y()};
                 }());
    const Eigen::Vector2d jump = field_.displacement(at, at + 1e-3 * up) - field_.displacement(at, at + -1e-3 * up);
    work += lip.length / 2 * jump.dot(Eigen::Vector2d(force.x, force.y));
  }
  return work;
}

void WindowComparison::find_rim() {
  for (const auto& [e, end] : elements_)
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(TriangleIndex(e), k);
      if (sheet_.mark(h) != EdgeMark::incision) continue;
      const Point2 a = sheet_.rest(sheet_.origin(h)), b = sheet_.rest(sheet_.target(h));
      const RimPoint rim = window_.rim(field_.frame().to_local(0.5 * (a + b)));
      const Point2 tangent = turned({rim.tangent.real(), rim.tangent.imag()});
      const Eigen::Vector2d along(tangent.x, tangent.y);
      const Eigen::Matrix2d exact = field_.stress(field_.frame().to_rest(rim.at));
      rim_.push_back({e, 0.5 * (a + b), std::sqrt(squared_length(b - a)), along.dot(exact * along), along});
    }
}

WindowComparison::Sums WindowComparison::sum(const StaticSolve::Solution& solution) const {
  const Elastic& elastic = field_.elastic();
  Sums sums;
  sums.error_energy = missing_;
  sums.energy = solve_.tip_energy(solution);
  std::size_t next = 0;
  for (const auto& [e, end] : elements_) {
    const Element& element = solve_.elements()[e];
    const auto [first, gradient] = displacement_in(solve_.elements(), e, solution.displacement);
    const Eigen::Matrix2d linear = elastic.stress((gradient + gradient.transpose()) / 2);
    sums.energy += element.material_area() / 2 * linear.cwiseProduct(gradient).sum();
    const Point2 corner = sheet_.corners(TriangleIndex(e))[0];
    for (; next < end; ++next) {
      const auto& [from_corner, weight, exact, moved] = samples_[next];
      const auto of_tips = solve_.tip_displacement(solution, TriangleIndex(e), corner + from_corner);
      const Eigen::Matrix2d here = linear + elastic.stress((of_tips.gradient + of_tips.gradient.transpose()) / 2);
      const Eigen::Matrix2d off = exact - here;
      sums.error_energy += weight * off.cwiseProduct(elastic.strain(off)).sum();
      sums.worst_stress = std::max(sums.worst_stress, off.cwiseAbs().maxCoeff());
      const Eigen::Vector2d value = first + gradient * Eigen::Vector2d(from_corner.x, from_corner.y) + of_tips.value;
      sums.error_squared += weight * (value - moved).squaredNorm();
      sums.exact_squared += weight * moved.squaredNorm();
    }
  }
  return sums;
}

double WindowComparison::rim_error(const StaticSolve::Solution& solution) const {
  double off = 0, scale = 0;
  for (const auto& [e, middle, length, hoop, tangent] : rim_) {
    const Eigen::Matrix2d gradient = displacement_in(solve_.elements(), e, solution.displacement).gradient +
                                     solve_.tip_displacement(solution, TriangleIndex(e), middle).gradient;
    const Eigen::Matrix2d stress = field_.elastic().stress((gradient + gradient.transpose()) / 2);
    off += length * std::pow(tangent.dot(stress * tangent) - hoop, 2);
    scale += length * hoop * hoop;
  }
  return scale > 0 ? std::sqrt(off / scale) : 1;
}

/// At the ends of an arc sliding goes in opposite directions: the mean is that of the first one's.
StressIntensity WindowComparison::mean(const std::function<StressIntensity(std::size_t i)>& of_tip) const {
  StressIntensity mean;
  const auto tips = to_double(tips_.size());
  for (std::size_t i = 0; i < tips_.size(); ++i) {
    const auto [k1, k2] = of_tip(i);
    const bool mirrored = window_.tips[i].k.k2 * window_.tips[0].k.k2 < 0;
    mean.k1 += k1 / tips;
    mean.k2 += (mirrored ? -k2 : k2) / tips;
  }
  return mean;
}

std::vector<Measure> WindowComparison::measures(const StaticSolve::Solution& solution) const {
  const auto [after, released] = border_;
  const Sums sums = sum(solution);
  const StressIntensity k = mean(
      [&](std::size_t i) { return intensities_[i].of(solve_.elements(), solution.displacement, solution.of_tips); });
  const double pull = std::hypot(window_.before.xx, window_.before.yy, window_.before.xy);
  const StressIntensity exact_k = window_.tips.empty() ? StressIntensity{} : window_.tips[0].k;
  const double intensity = std::hypot(exact_k.k1, exact_k.k2);
  std::vector<Measure> measures;
  for (const std::string& name : window_.measures) {
    const auto compared = [&](double value, double exact, double scale) {
      measures.push_back({name, value, exact, std::abs(value - exact) / scale});
    };
    if (name == "released_energy") compared(released + after - sums.energy, released, released);
    if (name == "strain_energy") compared(sums.energy, after, after);
    if (name == "opening") {
      const auto found =
          opening(sheet_, solution.displacement, lips_, sheet_.mean_edge(), solve_.tip_functions(), solution.of_tips);
      compared(opening_error(lips_, found, opening_), 0, 1);
    }
    if (name == "energy_norm") compared(std::sqrt(sums.error_energy / (2 * after)), 0, 1);
    if (name == "displacement_l2") compared(std::sqrt(sums.error_squared / sums.exact_squared), 0, 1);
    if (name == "rim_stress") compared(rim_error(solution), 0, 1);
    if (name == "stress") compared(sums.worst_stress / pull, 0, 1);
    if (name == "k1") compared(k.k1, exact_k.k1, intensity);
    if (name == "k2") compared(k.k2, exact_k.k2, intensity);
  }
  if (solution.of_tips.size() == 0 || tips_.empty()) return measures;
  std::size_t missing = 0;
  const StressIntensity of_tips = mean([&](std::size_t i) {
    const auto found = intensity_of_coefficients(*solve_.tip_functions(), solution.of_tips, tips_[i], field_.elastic(),
                                                 sheet_.mean_edge());
    missing += !found;
    return found.value_or(StressIntensity{});
  });
  if (missing > 0) return measures;
  measures.push_back({tip_measures[0], of_tips.k1, exact_k.k1, std::abs(of_tips.k1 - exact_k.k1) / intensity});
  measures.push_back({tip_measures[1], of_tips.k2, exact_k.k2, std::abs(of_tips.k2 - exact_k.k2) / intensity});
  return measures;
}

}  // namespace cutbench
