#include <sys/resource.h>

#include <cmath>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/cut/cut_all.h"
#include "harness/judge/assessment.h"
#include "harness/records/metrics.h"
#include "harness/simulation/motion_cut.h"

namespace cutbench {

namespace {

// --- where values come from ------------------------------------------------------------------------------------------

using Getter = std::function<Value(const Measured&)>;

/// Of the cut: status and counts.
template <class Get>
Getter of_cut(Get get) {
  return [get](const Measured& m) { return m.cut ? Value(get(*m.cut)) : Value(); };
}

/// Of the judged result.
template <class Get>
Getter of_result(Get get) {
  return [get](const Measured& m) { return m.assessment ? Value(get(*m.assessment)) : Value(); };
}

/// Of the shapes in the judged result.
template <class Get>
Getter of_shapes(Get get) {
  return [get](const Measured& m) { return m.assessment && m.shapes ? Value(get(*m.assessment)) : Value(); };
}

/// Of the worst of some triangles; where there are none, nothing is the worst.
Getter of_triangles(const Quality Assessment::*some, double Quality::*number) {
  return of_shapes([some, number](const Assessment& a) {
    const Quality& q = a.*some;
    return q.triangles > 0 ? Value(q.*number) : Value();
  });
}

/// A program has no phases, and none of our processor time.
bool by_program(const CutRun& c) { return c.time_us.program > 0; }

Getter of_phase(double PhaseTimes::*phase) {
  return of_cut([phase](const CutRun& c) { return by_program(c) ? Value() : Value(c.time_us.*phase); });
}

/// Of a cut in a running scene that was made.
bool made_in_motion(const Measured& m) {
  return m.motion && m.motion->verdict == Verdict::ok && m.motion->cut.status != Status::noop &&
         m.motion->cut.status != Status::refused;
}

template <class Get>
Getter of_motion(Get get) {
  return [get](const Measured& m) { return made_in_motion(m) ? Value(get(*m.motion)) : Value(); };
}

Getter of_rebuild(double RebuildTimes::*part) {
  return [part](const Measured& m) { return made_in_motion(m) ? Value(m.rebuild.*part) : Value(); };
}

Getter of_step(double StepTimes::*phase) {
  return of_motion([phase](const MotionCut& m) { return m.first_step.time_us.*phase; });
}

template <class Get>
Getter before_cut(Get get) {
  return of_motion([get](const MotionCut& m) { return get(m.before); });
}

template <class Get>
Getter jump_of(Get get) {
  return of_motion([get](const MotionCut& m) { return get(m.after) - get(m.before); });
}

Value verdict(const Measured& m) {
  if (m.assessment) return name_of(m.assessment->judgement.verdict);
  if (m.motion) return name_of(m.motion->verdict);
  return m.cut ? Value(name_of(m.cut->verdict)) : Value();
}

Value reason(const Measured& m) {
  if (m.assessment && !m.assessment->judgement.ok) return m.assessment->judgement.problems.front();
  if (m.motion) return m.motion->reason;
  return m.cut ? Value(m.cut->reason) : Value();
}

double peak_memory_mb() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return to_double(usage.ru_maxrss) / 1024;
}

double membrane(const Balance& b) { return b.energy.membrane; }
double bending(const Balance& b) { return b.energy.bending; }
double kinetic(const Balance& b) { return b.energy.kinetic; }
double residual(const Balance& b) { return b.residual; }

// --- the table -------------------------------------------------------------------------------------------------------

void add_keys_and_outcome(std::vector<Metric>& t) {
  t.push_back({"suite_version", "", "suite version", Direction::none, Group::key,
               "Version of meshes, cuts and definitions. Rows of different versions do not compare."});
  t.push_back({"cut_family", "", "cut family", Direction::none, Group::key,
               "Family of cuts, such as `curved`: harness/cases/cut_families.h."});
  t.push_back(
      {"sheet", "", "sheet", Direction::none, Group::key,
       "`grid` (the paper's), `alternating`, `delaunay`, `graded`: harness/mesh/families.h; in a robustness run "
       "also the stem of a mesh file."});
  t.push_back({"method", "", "method", Direction::none, Group::key,
               "Name of the method. `every_edge` is no method but the paper's wording taken literally: every edge of "
               "the sheet is tested against the path, and nothing is cut."});
  t.push_back({"parameter", "", "parameter", Direction::none, Group::key,
               "The one number of the method that is swept, as `rounds=1`; empty if it has none."});
  t.push_back(
      {"resolution", "", "triangles, uncut sheet", Direction::none, Group::key, "Triangles of the uncut sheet."});
  t.push_back({"case", "", "case", Direction::none, Group::key,
               "Number of the cut within its family: the same number is the same cut for every method."});
  t.push_back({"repetition", "", "repetition", Direction::none, Group::key,
               "Of the same cut on a fresh copy of the sheet, from 0. Only the first is judged and has shapes; the "
               "others have times only."});
  t.push_back({"seed", "", "seed", Direction::none, Group::key, "Seed of the cuts."});
  t.push_back({"cache", "", "cache", Direction::none, Group::key,
               "`warm`: the same cut was made and undone twice just before. `cold`: other work has driven everything "
               "out of the caches. `simulation`: made once inside a running scene, right after a step."});
  t.push_back({"status", "", "status", Direction::none, Group::outcome,
               "`ok`; `noop`: nothing to do; `deviated`: done, but not as requested, by a declared policy; "
               "`refused`: known before the cut; `failed`. After noop, refused and failed the sheet is "
               "bit-unchanged.",
               of_cut([](const CutRun& c) { return std::string(name_of(c.status)); })});
  t.push_back({"verdict", "", "verdict", Direction::none, Group::outcome,
               "`ok`, or the first thing that is wrong: see the verdicts below.", verdict});
  t.push_back({"reason", "", "reason", Direction::none, Group::outcome,
               "One line that explains the verdict or the status.", reason});
  t.push_back({"crossed_triangles", "", "crossed triangles", Direction::none, Group::outcome,
               "Triangles of the sheet before the cut whose interior the path meets: the unit of geometry cost.",
               of_cut([](const CutRun& c) { return to_int64(c.crossed_triangles); })});
  t.push_back(
      {"recovered_segments", "", "recovered segments", Direction::lower, Group::outcome,
       "Segments of the path that the method's own triangulation lacked and flips recovered.",
       [](const Measured& m) { return m.cut && m.judged ? Value(std::int64_t{m.cut->recovered_segments}) : Value(); }});
}

void add_sizes(std::vector<Metric>& t) {
  t.push_back({"pieces", "", "pieces", Direction::none, Group::size, "Parts that the sheet is in after the cut.",
               of_result([](const Assessment& a) { return std::int64_t{a.judgement.pieces}; })});
  t.push_back({"vertices_added", "", "vertices added", Direction::lower, Group::size,
               "Rest vertices after the cut minus those before.",
               of_result([](const Assessment& a) { return std::int64_t{a.vertices_added}; })});
  t.push_back({"deformed_vertices_added", "", "deformed vertices added", Direction::lower, Group::size,
               "The same of deformed vertices: after opening, each lip has its own.",
               of_result([](const Assessment& a) { return std::int64_t{a.deformed_vertices_added}; })});
  t.push_back({"triangles_added", "", "triangles added", Direction::lower, Group::size,
               "Triangles after the cut minus those before.",
               of_result([](const Assessment& a) { return std::int64_t{a.triangles_added}; })});
}

/// The same measures over the whole sheet (`_all`) and over the triangles that the cut made or changed (`_cut`).
void add_shapes(std::vector<Metric>& t, const std::string& suffix, const std::string& where,
                const Quality Assessment::*over) {
  const auto add = [&](const char* name, const char* unit, const char* label, Direction direction,
                       const char* definition, double Quality::*number) {
    t.push_back({name + suffix, unit, label, direction, Group::shape, definition + where, of_triangles(over, number)});
  };
  add("ar_max", "", "largest aspect ratio", Direction::lower,
      "Largest aspect ratio: longest edge / height on it = l_max^2 / (2 area); equilateral 1.155, right "
      "isosceles 2",
      &Quality::ar_max);
  add("ar_mean", "", "mean aspect ratio", Direction::lower, "Mean aspect ratio", &Quality::ar_mean);
  add("ar_p99", "", "99 % of aspect ratios", Direction::lower, "99th percentile of the aspect ratios, by nearest rank",
      &Quality::ar_p99);
  add("angle_min_deg", "deg", "smallest angle", Direction::higher, "Smallest interior angle", &Quality::angle_min_deg);
  add("angle_max_deg", "deg", "largest angle", Direction::lower, "Largest interior angle", &Quality::angle_max_deg);
  add("altitude_min_h", "h", "smallest altitude", Direction::higher, "Smallest height on a longest edge",
      &Quality::altitude_min);
  t.push_back({"over_3" + suffix, "", "triangles with AR > 3", Direction::lower, Group::shape,
               "Number of triangles with an aspect ratio above 3" + where,
               of_shapes([over](const Assessment& a) { return to_int64((a.*over).over_3); })});
}

void add_forced_zones(std::vector<Metric>& t) {
  t.push_back({"forced_corners", "", "forced corners", Direction::none, Group::forced,
               "Corners where the input alone (path, border, older incisions) makes an angle below asin(1/3) = 19.47 "
               "degrees: no method stays below an aspect ratio of 3 there.",
               of_shapes([](const Assessment& a) { return to_int64(a.forced_corners); })});
  t.push_back({"forced_triangles", "", "triangles in forced corners", Direction::none, Group::forced,
               "Triangles of the result in such a corner.",
               of_shapes([](const Assessment& a) { return std::int64_t{a.corner_triangles}; })});
  t.push_back({"ar_max_cut_strict", "", "largest aspect ratio, strict", Direction::lower, Group::forced,
               "ar_max_cut without the triangles in forced corners; empty if none is left.",
               of_triangles(&Assessment::strict, &Quality::ar_max)});
  t.push_back({"wedge_triangles", "", "triangles in forced wedges", Direction::none, Group::forced,
               "Triangles of the result in a forced wedge (between the legs of a forced corner where they are closer "
               "than 0.3 h, and 0.25 h round the apex) or in a forced corner.",
               of_shapes([](const Assessment& a) { return std::int64_t{a.wedge_triangles}; })});
  t.push_back({"wedge_area_rest2", "rest units squared", "area in forced wedges", Direction::none, Group::forced,
               "Area of these triangles.", of_shapes([](const Assessment& a) { return a.wedge_area; })});
  t.push_back({"ar_max_cut_outside_wedges", "", "largest aspect ratio outside wedges", Direction::lower, Group::forced,
               "ar_max_cut without the triangles in forced wedges and corners; empty if none is left.",
               of_triangles(&Assessment::outside_wedges, &Quality::ar_max)});
  t.push_back({"ar_max_cut_away_from_wedges", "", "largest aspect ratio away from wedges", Direction::lower,
               Group::forced,
               "ar_max_cut without those and without those within 0.02 h of a wedge, where incisions lie beside "
               "their curves.",
               of_shapes([](const Assessment& a) {
                 return a.ar_max_away_from_wedges > 0 ? Value(a.ar_max_away_from_wedges) : Value();
               })});
  t.push_back({"ar_p99_cut_strict", "", "99 % of aspect ratios, strict", Direction::lower, Group::forced,
               "ar_p99_cut without the triangles in forced corners.",
               of_triangles(&Assessment::strict, &Quality::ar_p99)});
  t.push_back({"ar_p99_cut_outside_wedges", "", "99 % of aspect ratios outside wedges", Direction::lower, Group::forced,
               "ar_p99_cut without the triangles in forced wedges and corners.",
               of_triangles(&Assessment::outside_wedges, &Quality::ar_p99)});
}

std::function<Value(const Measured&)> of_ratio(EigenvalueRatios Measured::*which, double EigenvalueRatios::*ratio) {
  return [which, ratio](const Measured& m) { return m.*which.*ratio >= 0 ? Value(m.*which.*ratio) : Value(); };
}

void add_stability_and_accuracy(std::vector<Metric>& t) {
  t.push_back(
      {"eigenvalue_ratio", "", "largest eigenvalue / uncut", Direction::lower, Group::stability,
       "Largest eigenvalue of the membrane's stiffness and lumped mass (harness/fem/model/largest_eigenvalue.h) over "
       "that of the uncut sheet, of the first `eigenvalue_cases` cuts only. Without bending the largest stable "
       "step of an explicit integrator shrinks by its root. Where vertices are constrained (x = C q) it is "
       "that of C^T K C and "
       "C^T M C, with ghost penalties where the method has them; that mass is not lumped, and no explicit "
       "step takes it, except for `phantom_node` and `virtual_node`, whose mass is lumped.",
       of_ratio(&Measured::membrane, &EigenvalueRatios::lumped)});
  t.push_back({"bending_eigenvalue_ratio", "", "largest eigenvalue with bending / uncut", Direction::lower,
               Group::stability,
               "The same with bending patches, D / (E h) = 4.2e-7 of the sheet's area (2 mm of skin on a side of 1 m) "
               "and nu = 0.45: by its root the largest stable step shrinks.",
               of_ratio(&Measured::bent, &EigenvalueRatios::lumped)});
  t.push_back({"stabilised_eigenvalue_ratio", "", "largest eigenvalue, stabilised mass / uncut", Direction::lower,
               Group::stability,
               "`eigenvalue_ratio` with `mass = \"stabilised\"` (harness/fem/elements/added_mass.h), no element above "
               "the largest "
               "eigenvalue of one of the uncut sheet. Empty where vertices are constrained, like the next ones.",
               of_ratio(&Measured::membrane, &EigenvalueRatios::stabilised)});
  t.push_back({"stabilised_bending_eigenvalue_ratio", "", "largest eigenvalue with bending, stabilised mass / uncut",
               Direction::lower, Group::stability, "The same with bending, as in `bending_eigenvalue_ratio`.",
               of_ratio(&Measured::bent, &EigenvalueRatios::stabilised)});
  t.push_back({"scaled_eigenvalue_ratio", "", "largest eigenvalue, scaled mass / uncut", Direction::lower,
               Group::stability, "`eigenvalue_ratio` with `mass = \"scaled\"`.",
               of_ratio(&Measured::membrane, &EigenvalueRatios::scaled)});
  t.push_back({"scaled_bending_eigenvalue_ratio", "", "largest eigenvalue with bending, scaled mass / uncut",
               Direction::lower, Group::stability, "The same with bending.",
               of_ratio(&Measured::bent, &EigenvalueRatios::scaled)});
  t.push_back({"scaled_mass_added", "", "mass added by scaling / mass", Direction::lower, Group::stability,
               "Mass that `scaled_eigenvalue_ratio` takes beside the sheet's, over the sheet's. A stabilised mass adds "
               "none to translation.",
               of_ratio(&Measured::membrane, &EigenvalueRatios::scaled_added)});
  t.push_back({"scaled_bending_mass_added", "", "mass added by scaling, with bending / mass", Direction::lower,
               Group::stability, "The same of `scaled_bending_eigenvalue_ratio`.",
               of_ratio(&Measured::bent, &EigenvalueRatios::scaled_added)});
  t.push_back(
      {"incision_error_h", "h", "incision error", Direction::lower, Group::accuracy,
       "Hausdorff distance between the requested path inside the sheet and the opened edges, both ways; of "
       "several cuts the largest.",
       [](const Measured& m) { return m.assessment ? Value(m.assessment->judgement.incision_error / m.h) : Value(); }});
  t.push_back({"area_change", "", "change of area", Direction::none, Group::accuracy,
               "Change of the rest area, (after - before) / before.",
               of_result([](const Assessment& a) { return a.judgement.area_change; })});
}

void add_times(std::vector<Metric>& t) {
  t.push_back({"locate_us", "us", "locate", Direction::lower, Group::time,
               "Time to find the first triangle and to keep the locator up to date.", of_phase(&PhaseTimes::locate)});
  t.push_back({"trace_us", "us", "trace", Direction::lower, Group::time,
               "Time of the path through the triangles, flattening included.", of_phase(&PhaseTimes::trace)});
  t.push_back({"embed_us", "us", "embed", Direction::lower, Group::time, "Time in which the path becomes edges.",
               of_phase(&PhaseTimes::embed)});
  t.push_back({"improve_us", "us", "improve", Direction::lower, Group::time, "Time in which shapes are improved.",
               of_phase(&PhaseTimes::improve)});
  t.push_back({"open_us", "us", "open", Direction::lower, Group::time, "Time in which the incision is opened.",
               of_phase(&PhaseTimes::open)});
  t.push_back({"constrain_us", "us", "constrain", Direction::lower, Group::time,
               "Time in which vertices are constrained to others, by methods that do so.",
               of_phase(&PhaseTimes::constrain)});
  t.push_back(
      {"process_us", "us", "program", Direction::lower, Group::time,
       "Time of a method that is a program of its own, instead of the phases: as it reports, else from its start to "
       "its end.",
       of_cut([](const CutRun& c) { return by_program(c) ? Value(c.time_us.program) : Value(); })});
  t.push_back({"geometry_us", "us", "geometry", Direction::lower, Group::time,
               "Sum of the six phases, or of process and constrain; for `every_edge` the search alone.",
               of_cut([](const CutRun& c) { return c.time_us.total(); })});
  t.push_back({"cpu_us", "us", "processor time", Direction::lower, Group::time,
               "Processor time of the process over the same work; empty for programs.",
               of_cut([](const CutRun& c) { return by_program(c) ? Value() : Value(c.cpu_us); })});
}

/// Of cuts made inside a running scene.
void add_steps(std::vector<Metric>& t) {
  t.push_back({"transfer_us", "us", "state transfer", Direction::lower, Group::step,
               "Positions and velocities of the vertices that the cut made, from those they came from.",
               of_motion([](const MotionCut& m) { return m.transfer_us; })});
  t.push_back({"pattern_us", "us", "pattern update", Direction::lower, Group::step,
               "Element data, mass, loads and the rows of the system matrix, where the cut touched them.",
               of_motion([](const MotionCut& m) { return m.pattern_us; })});
  t.push_back({"bending_us", "us", "bending update", Direction::lower, Group::step,
               "Stencils and rows of the bending matrix, likewise.",
               of_motion([](const MotionCut& m) { return m.bending_us; })});
  t.push_back({"rotate_us", "us", "rotate", Direction::lower, Group::step,
               "First step after the cut: deformations, forces and right-hand side.", of_step(&StepTimes::rotate)});
  t.push_back({"assemble_us", "us", "assemble", Direction::lower, Group::step,
               "First step after the cut: element matrices into the system. In accuracy runs: of the static problem.",
               of_step(&StepTimes::assemble)});
  t.push_back({"setup_us", "us", "set-up", Direction::lower, Group::step,
               "First step after the cut: preconditioner or factorisation. In accuracy runs: of the static problem.",
               of_step(&StepTimes::setup)});
  t.push_back({"solve_us", "us", "solve", Direction::lower, Group::step,
               "First step after the cut: linear solve. In accuracy runs: of the static problem.",
               of_step(&StepTimes::solve)});
  t.push_back({"rebuild_us", "us", "rebuild", Direction::lower, Group::step,
               "Instead of the pattern update: everything made anew, in the same run.",
               of_rebuild(&RebuildTimes::model)});
  t.push_back({"bending_rebuild_us", "us", "bending rebuild", Direction::lower, Group::step,
               "Instead of the bending update: everything made anew, in the same run.",
               of_rebuild(&RebuildTimes::bending)});
  t.push_back({"triplets_us", "us", "triplets", Direction::lower, Group::step,
               "Instead of assemble: the same membrane matrix by Eigen's setFromTriplets, the making of the triplets "
               "included.",
               of_rebuild(&RebuildTimes::triplets)});
  t.push_back({"solver_iterations", "", "solver iterations", Direction::lower, Group::step,
               "Iterations of the linear solve of that step.",
               of_motion([](const MotionCut& m) { return std::int64_t{m.first_step.iterations}; })});
  t.push_back({"solver_residual", "", "solver residual", Direction::lower, Group::step,
               "True residual of that solve, relative to the right-hand side.",
               of_motion([](const MotionCut& m) { return m.first_step.residual; })});
}

/// Before the cut, and after minus before at the instant of the cut.
void add_jumps(std::vector<Metric>& t) {
  t.push_back({"membrane_j", "J", "membrane energy", Direction::none, Group::jump,
               "Membrane energy right before the cut.", before_cut(membrane)});
  t.push_back({"membrane_jump_j", "J", "jump of membrane energy", Direction::none, Group::jump,
               "Jump of the membrane energy at the instant of the cut: after minus before.", jump_of(membrane)});
  t.push_back({"bending_j", "J", "bending energy", Direction::none, Group::jump, "Bending energy right before the cut.",
               before_cut(bending)});
  t.push_back({"bending_jump_j", "J", "jump of bending energy", Direction::none, Group::jump,
               "Jump of the bending energy at the instant of the cut: after minus before.", jump_of(bending)});
  t.push_back({"kinetic_j", "J", "kinetic energy", Direction::none, Group::jump, "Kinetic energy right before the cut.",
               before_cut(kinetic)});
  t.push_back({"kinetic_jump_j", "J", "jump of kinetic energy", Direction::none, Group::jump,
               "Jump of the kinetic energy at the instant of the cut: after minus before.", jump_of(kinetic)});
  t.push_back({"momentum_jump_kg_m_s", "kg m/s", "jump of momentum", Direction::lower, Group::jump,
               "Norm of the jump of the momentum.",
               of_motion([](const MotionCut& m) { return length(m.after.momentum + -1 * m.before.momentum); })});
  t.push_back({"angular_momentum_jump_kg_m2_s", "kg m2/s", "jump of angular momentum", Direction::lower, Group::jump,
               "Norm of the jump of the angular momentum about the origin.", of_motion([](const MotionCut& m) {
                 return length(m.after.angular_momentum + -1 * m.before.angular_momentum);
               })});
  t.push_back({"residual_n", "N", "residual force", Direction::none, Group::jump,
               "Norm of internal and external forces on what is not held, right before the cut.",
               before_cut(residual)});
  t.push_back({"residual_jump_n", "N", "jump of residual force", Direction::none, Group::jump,
               "Jump of the residual force at the instant of the cut: after minus before.", jump_of(residual)});
  t.push_back({"max_rss_mb", "MB", "peak memory", Direction::lower, Group::jump,
               "Peak memory of the whole process so far.",
               of_motion([](const MotionCut&) { return peak_memory_mb(); })});
}

void add_own(std::vector<Metric>& t, const std::vector<Metric>& metrics) {
  for (const Metric& m : metrics)
    if (!m.definition.empty()) t.push_back(m);
}

}  // namespace

const std::vector<Metric>& all_metrics() {
  static const std::vector<Metric> table = [] {
    std::vector<Metric> t;
    add_keys_and_outcome(t);
    add_sizes(t);
    add_shapes(t, "_all", ", over the whole sheet after the cut.", &Assessment::all);
    add_shapes(t, "_cut", ", over the triangles that the cut made or changed.", &Assessment::cut);
    add_forced_zones(t);
    add_stability_and_accuracy(t);
    add_times(t);
    add_steps(t);
    add_jumps(t);
    add_own(t, accuracy_metrics());
    add_own(t, robustness_metrics());
    add_own(t, stability_metrics());
    return t;
  }();
  return table;
}

}  // namespace cutbench
