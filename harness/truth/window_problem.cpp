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

/// The same frame for a member of every size: only its distance from the mesh's cells is in units of them.
Axes member_frame(Point2 middle, int n, std::uint64_t seed, std::size_t index) {
  Random random = member_random(seed, index);
  Axes frame;
  Point2 place{0.5 + random.between(-0.5, 0.5) / n, 0.5 + random.between(-0.5, 0.5) / n};
  if (index % 2 == 0) {
    const int row = n / 2;
    place.y = (row + distance_from_mesh_line(random)) / n;
  } else {
    frame.angle = random.between(0, 2 * std::numbers::pi);
  }
  frame.origin = place - (Axes{{0, 0}, frame.angle}).to_rest({middle.x, middle.y});
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

/// What a norm of an error is made of.
struct ElementSums {
  double energy = 0, error_energy = 0, error_squared = 0, exact_squared = 0, worst_stress = 0;
};

/// The exact side of all measures, worked out once for all solutions on a cut sheet.
class Comparison {
 public:
  Comparison(const WindowCase& window, const Specimen& specimen, const Sheet& sheet, const StaticSolve& solve,
             const ElasticField& field);
  std::vector<Measure> measures(const Field& displacement) const;

 private:
  /// A point of a quadrature rule.
  struct Sample {
    Point2 from_corner;  ///< from the element's corner 0
    double weight;
    Eigen::Matrix2d stress;
    Eigen::Vector2d displacement;
  };
  struct SampledElement {
    std::size_t element, end;  ///< of its samples; they begin where those of the element before end
  };
  struct RimEdge {
    std::size_t element;
    double length, hoop;  ///< exact hoop stress in its middle
    Eigen::Vector2d tangent;
  };
  bool looked_at(std::size_t element) const;
  void sample_elements();
  void find_rim();
  ElementSums sum(const Field& displacement) const;
  double opening_error(const Field& displacement) const;
  double rim_error(const Field& displacement) const;
  StressIntensity mean_intensity(const Field& displacement) const;
  Eigen::Matrix2d stress(std::size_t element, const Field& displacement) const;
  Point2 in_rest(Point2 local) const { return field_.frame().to_rest({local.x, local.y}); }
  Point2 turned(Point2 local) const { return Axes{{0, 0}, field_.frame().angle}.to_rest({local.x, local.y}); }

  const WindowCase& window_;
  const Sheet& sheet_;
  const StaticSolve& solve_;
  const ElasticField& field_;
  BorderWork border_;
  std::vector<SampledElement> elements_;
  std::vector<Sample> samples_;
  std::vector<LipSample> lips_;
  std::vector<double> opening_;
  std::vector<RimEdge> rim_;
  std::vector<InteractionIntegral> intensities_;  ///< per tip
};

Comparison::Comparison(const WindowCase& window, const Specimen& specimen, const Sheet& sheet, const StaticSolve& solve,
                       const ElasticField& field)
    : window_(window), sheet_(sheet), solve_(solve), field_(field) {
  const auto [xx, yy, xy] = window.before;
  border_ = border_work(field, UniformField(field.elastic(), field.frame(), xx, yy, xy), specimen);
  sample_elements();
  for (const LipSample& lip : window.lips) lips_.push_back({in_rest(lip.at), turned(lip.normal), lip.length});
  opening_ = opening(field, lips_);
  if (window.rim > 0) find_rim();
  if (std::find(window.measures.begin(), window.measures.end(), "k1") != window.measures.end())
    for (const Tip& tip : window.tips)
      intensities_.emplace_back(sheet, solve.elements(), field.elastic(),
                                Tip{in_rest(tip.at), field.frame().angle + tip.angle});
}

bool Comparison::looked_at(std::size_t element) const {
  const Element& e = solve_.elements()[element];
  return e.alive() && !solve_.loose(e.vertex[0]);
}

void Comparison::sample_elements() {
  std::vector<Point2> tips;
  for (const Tip& tip : window_.tips) tips.push_back(in_rest(tip.at));
  for (std::size_t e = 0; e < solve_.elements().size(); ++e) {
    if (!looked_at(e)) continue;
    const auto corners = sheet_.corners(TriangleIndex(e));
    integrate(corners, tips, 1, [&](Point2 p, double weight) {
      const auto exact = field_.state(p);
      samples_.push_back({p - corners[0], weight * solve_.elements()[e].fraction, exact.stress, exact.displacement});
    });
    elements_.push_back({e, samples_.size()});
  }
}

void Comparison::find_rim() {
  for (const auto& [e, end] : elements_)
    for (int k = 0; k < 3; ++k) {
      const HalfEdge h = half_edge(TriangleIndex(e), k);
      if (sheet_.mark(h) != EdgeMark::incision) continue;
      const Point2 a = sheet_.rest(sheet_.origin(h)), b = sheet_.rest(sheet_.target(h));
      const Complex middle = field_.frame().to_local(0.5 * (a + b)), out = middle / std::abs(middle);
      const Point2 tangent = turned({-out.imag(), out.real()});
      const Eigen::Vector2d along(tangent.x, tangent.y);
      const Eigen::Matrix2d exact = field_.stress(field_.frame().to_rest(window_.rim * out));
      rim_.push_back({e, std::sqrt(squared_length(b - a)), along.dot(exact * along), along});
    }
}

Eigen::Matrix2d Comparison::stress(std::size_t element, const Field& displacement) const {
  const Eigen::Matrix2d gradient = displacement_gradient(solve_.elements()[element], displacement);
  return field_.elastic().stress((gradient + gradient.transpose()) / 2);
}

ElementSums Comparison::sum(const Field& displacement) const {
  const Elastic& elastic = field_.elastic();
  ElementSums sums;
  std::size_t next = 0;
  for (const auto& [e, end] : elements_) {
    const Element& element = solve_.elements()[e];
    const Eigen::Matrix2d gradient = displacement_gradient(element, displacement), here = stress(e, displacement);
    sums.energy += element.material_area() / 2 * here.cwiseProduct(gradient).sum();
    const Eigen::Vector2d first = displacement.segment<2>(2 * element.vertex[0].value);
    for (; next < end; ++next) {
      const auto& [from_corner, weight, exact, moved] = samples_[next];
      const Eigen::Matrix2d off = exact - here;
      sums.error_energy += weight * off.cwiseProduct(elastic.strain(off)).sum();
      sums.worst_stress = std::max(sums.worst_stress, off.cwiseAbs().maxCoeff());
      sums.error_squared +=
          weight * (first + gradient * Eigen::Vector2d(from_corner.x, from_corner.y) - moved).squaredNorm();
      sums.exact_squared += weight * moved.squaredNorm();
    }
  }
  return sums;
}

double Comparison::opening_error(const Field& displacement) const {
  const auto found = opening(sheet_, displacement, lips_, sheet_.mean_edge());
  double off = 0, scale = 0;
  for (std::size_t i = 0; i < lips_.size(); ++i)
    off += lips_[i].length * std::pow(found[i] - opening_[i], 2), scale += lips_[i].length * std::pow(opening_[i], 2);
  return std::sqrt(off / scale);
}

double Comparison::rim_error(const Field& displacement) const {
  double off = 0, scale = 0;
  for (const auto& [e, length, hoop, tangent] : rim_) {
    off += length * std::pow(tangent.dot(stress(e, displacement) * tangent) - hoop, 2);
    scale += length * hoop * hoop;
  }
  return scale > 0 ? std::sqrt(off / scale) : 1;
}

StressIntensity Comparison::mean_intensity(const Field& displacement) const {
  StressIntensity mean;
  const auto tips = static_cast<double>(intensities_.size());
  for (const InteractionIntegral& intensity : intensities_) {
    const auto [k1, k2] = intensity.of(solve_.elements(), displacement);
    mean.k1 += k1 / tips, mean.k2 += k2 / tips;
  }
  return mean;
}

std::vector<Measure> Comparison::measures(const Field& displacement) const {
  const double released = border_.released / 2, after = border_.after / 2;
  const ElementSums sums = sum(displacement);
  const StressIntensity k = mean_intensity(displacement);
  const double pull = std::hypot(window_.before[0], window_.before[1], window_.before[2]);
  const double intensity = std::hypot(window_.k.k1, window_.k.k2);
  std::vector<Measure> measures;
  for (const std::string& name : window_.measures) {
    const auto compared = [&](double value, double exact, double scale) {
      measures.push_back({name, value, exact, std::abs(value - exact) / scale});
    };
    if (name == "released_energy") compared(released + after - sums.energy, released, released);
    if (name == "strain_energy") compared(sums.energy, after, after);
    if (name == "opening") compared(opening_error(displacement), 0, 1);
    if (name == "energy_norm") compared(std::sqrt(sums.error_energy / (2 * after)), 0, 1);
    if (name == "displacement_l2") compared(std::sqrt(sums.error_squared / sums.exact_squared), 0, 1);
    if (name == "rim_stress") compared(rim_error(displacement), 0, 1);
    if (name == "stress") compared(sums.worst_stress / pull, 0, 1);
    if (name == "k1") compared(k.k1, window_.k.k1, intensity);
    if (name == "k2") compared(k.k2, window_.k.k2, intensity);
  }
  return measures;
}

class WindowProblem final : public Problem {
 public:
  explicit WindowProblem(WindowCase window) : window_(std::move(window)) {}
  std::string name() const override { return window_.name; }
  std::string effect() const override { return window_.effect; }
  std::string truth() const override { return window_.truth; }
  std::vector<std::string> measures() const override { return window_.measures; }

  Specimen specimen(const std::string& family, int n, std::uint64_t seed, std::size_t index) const override {
    const Axes frame = member_frame(window_.middle, n, seed, index);
    Specimen specimen{make_sheet(family, n), window_.cuts, frame.origin, frame.angle};
    for (Curve& cut : specimen.cuts)
      for (Point2& p : cut.points) p = frame.to_rest({p.x, p.y});
    return specimen;
  }

  std::vector<Answer> answer(const Specimen& specimen, const Sheet& sheet,
                             std::span<const Budget> budgets) const override {
    const auto field = window_.field({specimen.origin, specimen.angle});
    StaticSolve solve(sheet, sheet_material);
    solve.hold_border([&](Point2 p, Point2 inside) { return field->displacement(p, inside); });
    solve.hold_loose_pieces();
    const Comparison comparison(window_, specimen, sheet, solve, *field);
    std::vector<Answer> answers;
    for (const Budget& budget : budgets) {
      auto [displacement, answer] = solve.solve(budget);
      if (answer.verdict != "not_finite") answer.measures = comparison.measures(displacement);
      answers.push_back(std::move(answer));
    }
    return answers;
  }

 private:
  WindowCase window_;
};

// --- the problems
// ----------------------------------------------------------------------------------------------------------

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
  window.field = [=](const Axes& frame) {
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
  window.field = [=](const Axes& frame) { return std::make_unique<WilliamsField>(sheet_material, frame, k1, k2); };
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
  window.field = [=](const Axes& frame) {
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
  window.field = [=](const Axes& frame) { return std::make_unique<HoleField>(sheet_material, frame, radius, pull); };
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
