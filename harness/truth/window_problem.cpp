#include "harness/truth/window_problem.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "harness/mesh/families.h"
#include "harness/truth/members.h"
#include "harness/truth/quadrature.h"
#include "harness/truth/static_solve.h"

namespace cutbench {

namespace {

constexpr Elastic sheet_material{.young = 1000, .poisson = 0.3};

/// The same frame for a member of every size: only its distance from the mesh's cells is in units of them.
Frame member_frame(Point2 middle, int n, std::uint64_t seed, std::size_t index) {
  Random random = member_random(seed, index);
  Frame frame;
  Point2 place{0.5 + random.between(-0.5, 0.5) / n, 0.5 + random.between(-0.5, 0.5) / n};
  if (index % 2 == 0) {
    place.y = (n / 2 + distance_from_mesh_line(random)) / n;
  } else {
    frame.angle = random.between(0, 2 * std::numbers::pi);
  }
  frame.origin = place - (Frame{{0, 0}, frame.angle}).to_rest({middle.x, middle.y});
  return frame;
}

/// Integrals round the window, of the exact fields: t.u of the cut plate, and (t0.u - t.u0).
struct BorderWork {
  double after = 0, released = 0;
};

/// Panels of a side end where a cut crosses it: the field jumps there.
std::vector<double> panel_ends(Point2 a, Point2 b, const std::vector<Curve>& cuts) {
  constexpr int panels = 64;
  std::vector<double> ends;
  for (int i = 0; i <= panels; ++i) ends.push_back(static_cast<double>(i) / panels);
  for (const Curve& cut : cuts)
    for (std::size_t i = 0; i + 1 < cut.points.size(); ++i) {
      const Point2 p = cut.points[i], d = cut.points[i + 1] - p;
      const double det = cross(b - a, d);
      if (det == 0) continue;
      const double s = cross(p - a, d) / det, t = cross(p - a, b - a) / det;
      if (s > 0 && s < 1 && t > 0 && t < 1) ends.push_back(s);
    }
  std::sort(ends.begin(), ends.end());
  return ends;
}

BorderWork border_work(const ElasticField& field, const ElasticField& before, const Specimen& specimen) {
  constexpr std::array<std::array<double, 2>, 3> gauss{
      {{-0.774596669241483, 5.0 / 9}, {0, 8.0 / 9}, {0.774596669241483, 5.0 / 9}}};
  BorderWork work;
  const std::array<Point2, 5> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}};
  for (std::size_t k = 0; k < 4; ++k) {
    const Point2 a = corners[k], side = corners[k + 1] - a;
    const Eigen::Vector2d normal(side.y, -side.x);
    const auto ends = panel_ends(a, corners[k + 1], specimen.cuts);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
      for (const auto& [place, weight] : gauss) {
        const double half = (ends[i + 1] - ends[i]) / 2;
        const Point2 p = a + (ends[i] + half * (1 + place)) * side;
        const Eigen::Vector2d u = field.displacement(p), t = field.stress(p) * normal;
        work.after += weight * half * t.dot(u);
        work.released += weight * half * (u.dot(before.stress(p) * normal) - t.dot(before.displacement(p)));
      }
  }
  return work;
}

/// What the elements say of a displacement, beside the exact field; the loose pieces left out.
struct ElementSums {
  double energy = 0, error_energy = 0, error_squared = 0, exact_squared = 0, worst_stress = 0;
};

class WindowProblem final : public Problem {
 public:
  explicit WindowProblem(WindowCase window) : window_(std::move(window)) {}
  std::string name() const override { return window_.name; }
  std::string effect() const override { return window_.effect; }
  std::string truth() const override { return window_.truth; }
  std::vector<std::string> measures() const override { return window_.measures; }

  Specimen specimen(const std::string& family, int n, std::uint64_t seed, std::size_t index) const override {
    const Frame frame = member_frame(window_.middle, n, seed, index);
    Specimen specimen{make_sheet(family, n), window_.cuts, frame.origin, frame.angle};
    for (Curve& cut : specimen.cuts)
      for (Point2& p : cut.points) p = frame.to_rest({p.x, p.y});
    return specimen;
  }

  std::vector<Answer> answer(const Specimen& specimen, const Sheet& sheet,
                             std::span<const Budget> budgets) const override {
    const Frame frame{specimen.origin, specimen.angle};
    const auto field = window_.field(frame);
    StaticSolve solve(sheet, sheet_material);
    solve.hold_border([&](Point2 p, Point2 inside) { return field->displacement(p, inside); });
    solve.hold_loose_pieces();
    std::vector<Answer> answers;
    for (const Budget& budget : budgets) {
      auto [displacement, answer] = solve.solve(budget);
      if (answer.verdict != "not_finite") answer.measures = compare(specimen, sheet, solve, displacement, *field);
      answers.push_back(std::move(answer));
    }
    return answers;
  }

 private:
  std::vector<Measure> compare(const Specimen& specimen, const Sheet& sheet, const StaticSolve& solve,
                               const Field& displacement, const ElasticField& field) const;
  ElementSums sum(const Sheet& sheet, const StaticSolve& solve, const Field& displacement,
                  const ElasticField& field) const;
  double opening_error(const Sheet& sheet, const Field& displacement, const ElasticField& field) const;
  double rim_error(const Sheet& sheet, const StaticSolve& solve, const Field& displacement,
                   const ElasticField& field) const;
  StressIntensity mean_intensity(const Sheet& sheet, const StaticSolve& solve, const Field& displacement,
                                 const Frame& frame) const;

  WindowCase window_;
};

Point2 turned(const Frame& frame, Point2 direction) {
  return Frame{{0, 0}, frame.angle}.to_rest({direction.x, direction.y});
}

ElementSums WindowProblem::sum(const Sheet& sheet, const StaticSolve& solve, const Field& displacement,
                               const ElasticField& field) const {
  std::vector<Point2> tips;
  for (const Tip& tip : window_.tips) tips.push_back(field.frame().to_rest({tip.at.x, tip.at.y}));
  const Elastic& elastic = field.elastic();
  ElementSums sums;
  for (std::size_t e = 0; e < solve.elements().size(); ++e) {
    const Element& element = solve.elements()[e];
    if (!element.alive() || solve.loose(element.vertex[0])) continue;
    const auto corners = sheet.corners(TriangleIndex(e));
    const Eigen::Matrix2d gradient = displacement_gradient(element, displacement);
    const Eigen::Matrix2d strain = (gradient + gradient.transpose()) / 2, stress = elastic.stress(strain);
    sums.energy += element.material_area() / 2 * stress.cwiseProduct(strain).sum();
    const Eigen::Vector2d first = displacement.segment<2>(2 * element.vertex[0].value);
    integrate(corners, tips, 1, [&](Point2 p, double weight) {
      const Eigen::Matrix2d off = field.stress(p) - stress;
      sums.error_energy += weight * element.fraction * off.cwiseProduct(elastic.strain(off)).sum();
      sums.worst_stress = std::max(sums.worst_stress, off.cwiseAbs().maxCoeff());
      const Eigen::Vector2d exact = field.displacement(p);
      const Eigen::Vector2d here = first + gradient * Eigen::Vector2d(p.x - corners[0].x, p.y - corners[0].y);
      sums.error_squared += weight * element.fraction * (here - exact).squaredNorm();
      sums.exact_squared += weight * element.fraction * exact.squaredNorm();
    });
  }
  return sums;
}

double WindowProblem::opening_error(const Sheet& sheet, const Field& displacement, const ElasticField& field) const {
  std::vector<LipSample> samples;
  for (const LipSample& lip : window_.lips)
    samples.push_back({field.frame().to_rest({lip.at.x, lip.at.y}), turned(field.frame(), lip.normal), lip.length});
  const auto exact = opening(field, samples), found = opening(sheet, displacement, samples, sheet.mean_edge());
  double off = 0, scale = 0;
  for (std::size_t i = 0; i < samples.size(); ++i)
    off += samples[i].length * std::pow(found[i] - exact[i], 2), scale += samples[i].length * std::pow(exact[i], 2);
  return std::sqrt(off / scale);
}

double WindowProblem::rim_error(const Sheet& sheet, const StaticSolve& solve, const Field& displacement,
                                const ElasticField& field) const {
  double off = 0, scale = 0;
  for (std::size_t e = 0; e < solve.elements().size(); ++e) {
    const Element& element = solve.elements()[e];
    if (!element.alive() || solve.loose(element.vertex[0])) continue;
    const Eigen::Matrix2d gradient = displacement_gradient(element, displacement);
    const Eigen::Matrix2d stress = field.elastic().stress((gradient + gradient.transpose()) / 2);
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(TriangleIndex(e), k);
      if (sheet.mark(h) != EdgeMark::incision) continue;
      const Point2 a = sheet.rest(sheet.origin(h)), b = sheet.rest(sheet.target(h));
      const Complex out = field.frame().to_local(0.5 * (a + b));
      const Point2 on_rim = field.frame().to_rest(window_.rim / std::abs(out) * out);
      const Point2 radial = turned(field.frame(), {out.real() / std::abs(out), out.imag() / std::abs(out)});
      const Eigen::Vector2d tangent(-radial.y, radial.x);
      const double exact = tangent.dot(field.stress(on_rim) * tangent), length = std::sqrt(squared_length(b - a));
      off += length * std::pow(tangent.dot(stress * tangent) - exact, 2), scale += length * exact * exact;
    }
  }
  return scale > 0 ? std::sqrt(off / scale) : 1;
}

StressIntensity WindowProblem::mean_intensity(const Sheet& sheet, const StaticSolve& solve, const Field& displacement,
                                              const Frame& frame) const {
  StressIntensity mean;
  for (const Tip& tip : window_.tips) {
    const Tip in_rest{frame.to_rest({tip.at.x, tip.at.y}), frame.angle + tip.angle};
    const auto [k1, k2] = stress_intensity(sheet, solve.elements(), displacement, sheet_material, in_rest);
    mean.k1 += k1 / static_cast<double>(window_.tips.size()), mean.k2 += k2 / static_cast<double>(window_.tips.size());
  }
  return mean;
}

std::vector<Measure> WindowProblem::compare(const Specimen& specimen, const Sheet& sheet, const StaticSolve& solve,
                                            const Field& displacement, const ElasticField& field) const {
  const auto [xx, yy, xy] = window_.before;
  const UniformField before(sheet_material, field.frame(), xx, yy, xy);
  const BorderWork exact = border_work(field, before, specimen);
  const ElementSums sums = sum(sheet, solve, displacement, field);
  std::vector<Measure> measures;
  for (const std::string& name : window_.measures) {
    const auto compared = [&](double value, double truth, double scale) {
      measures.push_back({name, value, truth, std::abs(value - truth) / scale});
    };
    if (name == "released_energy")
      compared(exact.released / 2 + exact.after / 2 - sums.energy, exact.released / 2, exact.released / 2);
    else if (name == "strain_energy")
      compared(sums.energy, exact.after / 2, exact.after / 2);
    else if (name == "opening")
      compared(opening_error(sheet, displacement, field), 0, 1);
    else if (name == "energy_norm")
      compared(std::sqrt(sums.error_energy / exact.after), 0, 1);
    else if (name == "displacement_l2")
      compared(std::sqrt(sums.error_squared / sums.exact_squared), 0, 1);
    else if (name == "rim_stress")
      compared(rim_error(sheet, solve, displacement, field), 0, 1);
    else if (name == "stress")
      compared(sums.worst_stress / (std::abs(xx) + std::abs(yy) + std::abs(xy)), 0, 1);
    else if (name == "k1")
      compared(mean_intensity(sheet, solve, displacement, field.frame()).k1, window_.k.k1,
               std::hypot(window_.k.k1, window_.k.k2));
    else if (name == "k2")
      compared(mean_intensity(sheet, solve, displacement, field.frame()).k2, window_.k.k2,
               std::hypot(window_.k.k1, window_.k.k2));
  }
  return measures;
}

// --- the problems
// ----------------------------------------------------------------------------------------------------------

constexpr double pull = 1;            // N/m
constexpr double half_length = 0.25;  // of straight cuts
constexpr double degree = std::numbers::pi / 180;
const double root = std::sqrt(std::numbers::pi * half_length);

Curve line(Point2 a, Point2 b) { return {Curve::Kind::polyline, false, {a, b}}; }

/// An arc round the origin as cubic Beziers, each so short that it is within 1e-7 of the radius.
Curve arc(double radius, double from, double to) {
  const int pieces = static_cast<int>(std::ceil((to - from) / (22.5 * degree) - 1e-9));
  const double step = (to - from) / pieces, handle = 4.0 / 3 * std::tan(step / 4) * radius;
  const auto at = [&](double t) { return Point2{radius * std::cos(t), radius * std::sin(t)}; };
  const auto along = [&](double t) { return Point2{-handle * std::sin(t), handle * std::cos(t)}; };
  Curve curve{Curve::Kind::bezier, to - from >= 359 * degree, {at(from)}};
  for (int i = 0; i < pieces; ++i) {
    const double a = from + i * step, b = a + step;
    const Point2 end = curve.closed && i + 1 == pieces ? curve.points.front() : at(b);
    curve.points.insert(curve.points.end(), {at(a) + along(a), end - along(b), end});
  }
  return curve;
}

constexpr int lip_samples = 400;

std::vector<LipSample> straight_lips() {
  std::vector<LipSample> samples;
  const double step = 2 * half_length / lip_samples;
  for (int i = 0; i < lip_samples; ++i) samples.push_back({{-half_length + (i + 0.5) * step, 0}, {0, 1}, step});
  return samples;
}

/// A straight cut across the middle, pulled with xx, yy, xy.
WindowCase straight(double xx, double yy, double xy) {
  WindowCase window;
  window.measures = {"released_energy", "opening", "energy_norm", "displacement_l2", "strain_energy", "k1", "k2"};
  window.field = [=](const Frame& frame) {
    return std::make_unique<StraightCrackField>(sheet_material, frame, half_length, xx, yy, xy);
  };
  window.cuts = {line({-half_length, 0}, {half_length, 0})};
  window.before = {xx, yy, xy};
  window.tips = {{{half_length, 0}, 0}, {{-half_length, 0}, std::numbers::pi}};
  window.k = {yy * root, xy * root};
  window.lips = straight_lips();
  return window;
}

WindowCase centre_crack() {
  WindowCase window = straight(0, pull, 0);
  window.name = "centre_crack";
  window.effect = "a cut across the tension gapes, and gives off energy";
  window.truth = "infinite plate: pi s^2 a^2 / E, gape (4 s / E) sqrt(a^2 - x^2), K1 = s sqrt(pi a); Muskhelishvili";
  return window;
}

WindowCase two_cuts_one_geometry() {
  WindowCase window = centre_crack();
  window.name = "two_cuts_one_geometry";
  window.effect = "the centre crack in two cuts, the second from the first one's tip on: no worse than by one";
  constexpr double joint = 0.3 * half_length;
  window.cuts = {line({-half_length, 0}, {joint, 0}), line({joint, 0}, {half_length, 0})};
  return window;
}

WindowCase inclined_crack() {
  const double c = std::cos(30 * degree), s = std::sin(30 * degree);
  WindowCase window = straight(pull * s * s, pull * c * c, pull * s * c);
  window.name = "inclined_crack";
  window.effect = "a cut at 30 degrees to the normal of the tension gapes and slides";
  window.truth = "infinite plate: K1 = s sqrt(pi a) cos^2 b, K2 = s sqrt(pi a) sin b cos b; Muskhelishvili";
  return window;
}

WindowCase williams(double k1, double k2) {
  WindowCase window;
  window.measures = {"energy_norm", "displacement_l2", "strain_energy", "k1", "k2"};
  window.field = [=](const Frame& frame) { return std::make_unique<WilliamsField>(sheet_material, frame, k1, k2); };
  window.cuts = {line({-2, 0}, {0, 0})};
  window.tips = {{{0, 0}, 0}};
  window.k = {k1, k2};
  return window;
}

WindowCase williams_mode_1() {
  WindowCase window = williams(1, 0);
  window.name = "williams_mode_1";
  window.effect = "the end of a cut inside a triangle, opening: stresses like 1 / sqrt(r)";
  window.truth = "Williams 1957, mode I, K1 = 1";
  return window;
}

WindowCase williams_mode_2() {
  WindowCase window = williams(0, 1);
  window.name = "williams_mode_2";
  window.effect = "the end of a cut inside a triangle, sliding";
  window.truth = "Williams 1957, mode II, K2 = 1";
  return window;
}

WindowCase arc_crack(int degrees) {
  constexpr double half_chord = 0.2;
  const double half = degrees * degree, radius = half_chord / std::sin(half);
  WindowCase window;
  window.name = "arc_crack_" + std::to_string(degrees);
  window.effect = "a curved cut, an arc of twice " + std::to_string(degrees) + " degrees, pulled in all directions";
  window.truth = "infinite plate: Muskhelishvili's potentials; K left out, since straight auxiliary fields don't fit";
  window.measures = {"released_energy", "opening", "energy_norm", "strain_energy"};
  window.field = [=](const Frame& frame) {
    return std::make_unique<ArcCrackField>(sheet_material, frame, radius, half, pull);
  };
  window.cuts = {arc(radius, -half, half)};
  window.middle = {radius * (1 + std::cos(half)) / 2, 0};
  window.before = {pull, pull, 0};
  window.tips = {{{half_chord / std::tan(half), half_chord}, half + std::numbers::pi / 2},
                 {{half_chord / std::tan(half), -half_chord}, -half - std::numbers::pi / 2}};
  const double step = 2 * half / lip_samples;
  for (int i = 0; i < lip_samples; ++i) {
    const Point2 out{std::cos(-half + (i + 0.5) * step), std::sin(-half + (i + 0.5) * step)};
    window.lips.push_back({radius * out, out, radius * step});
  }
  return window;
}

WindowCase kirsch_hole() {
  constexpr double radius = 0.2;
  WindowCase window;
  window.name = "kirsch_hole";
  window.effect = "a round piece cut out: three times the tension at the rim";
  window.truth = "infinite plate: hoop stress s (1 - 2 cos 2t); Kirsch 1898";
  window.measures = {"rim_stress", "energy_norm", "released_energy"};
  window.field = [=](const Frame& frame) { return std::make_unique<HoleField>(sheet_material, frame, radius, pull); };
  window.cuts = {arc(radius, 0, 2 * std::numbers::pi)};
  window.before = {pull, 0, 0};
  window.rim = radius;
  return window;
}

WindowCase parallel_stress() {
  WindowCase window = straight(pull, 0, 0);
  window.name = "parallel_stress";
  window.effect = "a cut along the tension changes nothing, whatever the triangles look like";
  window.truth = "the uniform stress, to round-off";
  window.measures = {"stress", "energy_norm", "displacement_l2"};
  return window;
}

}  // namespace

std::unique_ptr<const Problem> make_window_problem(WindowCase window) {
  return std::make_unique<WindowProblem>(std::move(window));
}

void append_window_problems(std::vector<std::unique_ptr<const Problem>>& problems) {
  for (WindowCase window : {centre_crack(), inclined_crack(), williams_mode_1(), williams_mode_2(), arc_crack(30),
                            arc_crack(45), arc_crack(60), kirsch_hole(), parallel_stress(), two_cuts_one_geometry()})
    problems.push_back(make_window_problem(std::move(window)));
}

}  // namespace cutbench
