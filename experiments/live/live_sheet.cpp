#include "experiments/live/live_sheet.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "harness/base/errors.h"
#include "harness/base/stop_watch.h"
#include "harness/cut/constraint_source.h"
#include "harness/cut/cut_all.h"
#include "harness/fem/model/largest_eigenvalue.h"
#include "harness/judge/judged_sheet.h"
#include "harness/mesh/check_and_repair.h"
#include "harness/mesh/families.h"
#include "harness/mesh/mesh_text.h"
#include "harness/mesh/quality.h"
#include "harness/path/pick.h"
#include "methods/registry.h"

namespace cutbench::live {

using nlohmann::json;

namespace {

Point2 point2(const json& j) { return {j.at(0), j.at(1)}; }
Point3 point3(const json& j) { return {j.at(0), j.at(1), j.at(2)}; }

/// Every triangle becomes four, so that all vertices stay.
MeshData refined(const MeshData& coarse) {
  MeshData fine = coarse;
  fine.triangles.clear();
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> middles;
  const auto middle = [&](std::int32_t a, std::int32_t b) {
    const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), to_int32(fine.rest.size()));
    if (is_new) {
      const Point2 p = coarse.rest[to_size(a)], q = coarse.rest[to_size(b)];
      const Point3 x = coarse.deformed[to_size(a)], y = coarse.deformed[to_size(b)];
      fine.rest.push_back({(p.x + q.x) / 2, (p.y + q.y) / 2});
      fine.deformed.push_back({(x.x + y.x) / 2, (x.y + y.y) / 2, (x.z + y.z) / 2});
    }
    return place->second;
  };
  for (const auto& [a, b, c] : coarse.triangles) {
    const std::int32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    for (const auto& triangle : {std::array{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}})
      fine.triangles.push_back(triangle);
  }
  fine.file_vertices.clear();
  return fine;
}

Quality quality_of(const Sheet& sheet) {
  std::vector<std::array<Point2, 3>> all;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    if (sheet.triangle(TriangleIndex(t)).alive()) all.push_back(sheet.corners(TriangleIndex(t)));
  return quality(all);
}

std::unique_ptr<CuttingMethod> make_method(const MethodRow& row, double parameter) {
  return row.make(std::isnan(parameter) ? row.parameter.value : parameter);
}

/// From 0 in the order of the first triangle; triangles that share an unmarked edge are of one piece.
std::vector<int> pieces_by_triangle(const Sheet& sheet) {
  std::vector<int> piece(sheet.triangle_slots(), -1);
  std::vector<TriangleIndex> stack;
  int pieces = 0;
  for (std::size_t t = 0; t < piece.size(); ++t) {
    if (piece[t] >= 0 || !sheet.triangle(TriangleIndex(t)).alive()) continue;
    piece[t] = pieces;
    stack.push_back(TriangleIndex(t));
    while (!stack.empty()) {
      const TriangleIndex at = stack.back();
      stack.pop_back();
      for (int k = 0; k < 3; ++k) {
        const HalfEdge h = half_edge(at, k);
        if (sheet.separates(h)) continue;
        const TriangleIndex other = triangle_of(sheet.opposite(h));
        if (piece[other()] >= 0) continue;
        piece[other()] = pieces;
        stack.push_back(other);
      }
    }
    ++pieces;
  }
  return piece;
}

/// The largest |principal stretch - 1|, from rest a, b, c to x, y, z.
double strain_of(const std::array<Point2, 3>& rest, const std::array<Point3, 3>& now) {
  const Point2 u = rest[1] - rest[0], v = rest[2] - rest[0];
  const double det = u.x * v.y - u.y * v.x;
  const auto minus = [](Point3 a, Point3 b) { return Point3{a.x - b.x, a.y - b.y, a.z - b.z}; };
  const auto product = [](Point3 a, Point3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
  const Point3 x = minus(now[1], now[0]), y = minus(now[2], now[0]);
  const auto along = [&](double a, double b) {
    return Point3{a * x.x + b * y.x, a * x.y + b * y.y, a * x.z + b * y.z};
  };
  const Point3 f = along(v.y / det, -u.y / det), g = along(-v.x / det, u.x / det);
  const double ff = product(f, f), fg = product(f, g), gg = product(g, g);
  const double mean = (ff + gg) / 2, spread = std::sqrt((ff - gg) * (ff - gg) / 4 + fg * fg);
  return std::max(std::abs(std::sqrt(mean + spread) - 1), std::abs(std::sqrt(std::max(0.0, mean - spread)) - 1));
}

}  // namespace

Scene scene_of(const json& j) {
  Scene s;
  s.stem = "live";
  if (j.contains("obj")) {
    MeshData mesh = read_obj(j.at("obj").get<std::string>(), "the OBJ");
    const bool of_vt = !mesh.rest.empty();
    check_and_repair(mesh, "the OBJ", of_vt);
    s.mesh = mesh;
  } else {
    s.family = j.value("family", s.family);
    s.resolution = j.value("triangles", s.resolution);
    s.size = j.value("size", s.size);
  }
  if (j.value("refined", false)) s.mesh = refined(mesh_of(s));
  const json none = json::object();
  const json& material = j.contains("material") ? j.at("material") : none;
  s.material = {.density = material.value("density", 2.2),
                .stiffness = material.value("stiffness", 1000.0),
                .poisson = material.value("poisson", 0.45),
                .bending = material.value("bending", 4.2e-4),
                .mass_damping = material.value("mass_damping", 0.5),
                .stiffness_damping = material.value("stiffness_damping", 1e-3)};
  s.physics.bending = s.material.bending > 0 ? BendingKind::patches : BendingKind::none;
  s.physics.gravity = j.contains("gravity") ? point3(j.at("gravity")) : Point3{0, 0, -9.81};
  for (const json& pin : j.value("pins", json::array({{{"near", {0, 0}}}, {{"near", {1, 0}}}}))) {
    ScenePin made;
    if (pin.contains("near"))
      made.near = point2(pin.at("near"));
    else
      made.pin.where = {point2(pin.at("box").at(0)), point2(pin.at("box").at(1))};
    s.pins.push_back(made);
  }
  s.step = j.value("step", 1.0 / 240);
  s.solver = {.name = j.value("solver", std::string("multigrid")), .tolerance = j.value("tolerance", 1e-2)};
  return s;
}

Sheet sheet_of(const Scene& scene) {
  Sheet sheet(mesh_of(scene));
  hold_constrained_vertices(pins_of(scene, sheet), scene.tractions, sheet);
  return sheet;
}

LiveSheet::LiveSheet(const Scene& scene)
    : scene_(scene),
      now_(scene_),
      cuts_(scene_, now_),
      stepper_({scene_.integrator, scene_.step, scene_.newton, scene_.sweeps, scene_.solver, scene_.robust}),
      triangles_before_(now_.sheet.triangle_count()) {
  now_.model.reserve_spare();
}

int LiveSheet::step(int steps) {
  for (int i = 0; i < steps; ++i) {
    if (!fault_.empty()) return i;
    if (!grabbed_.empty()) pull();
    const StepReport report = stepper_.step(now_.model, now_.state);
    if (report.verdict != Verdict::ok) fault_ = std::string(name_of(report.verdict)) + ": " + report.reason;
  }
  return fault_.empty() ? steps : steps - 1;
}

json LiveSheet::cut(const std::string& method, double parameter, const std::vector<Curve>& curves) {
  const MethodRow& row = find_method(method);
  for (const Curve& curve : curves) check_curve(curve, "the stroke");
  auto next = make_method(row, parameter);
  // Constraints are found from those of the cut before: by one method, or none.
  if (method_ && method != method_name_ && (method_->constraint_source() || next->constraint_source()))
    throw InputError("the sheet was cut by " + method_name_ + ", and can't be cut on by " + method +
                     "; make a new one");
  method_ = std::move(next);
  method_name_ = method;
  release();
  if (saved_.size() == most_saved) saved_.erase(saved_.begin());
  saved_.push_back(std::make_unique<MovingSheet<3>>(now_));
  const std::size_t triangles = now_.sheet.triangle_count();
  MotionCut made;
  try {
    made = cuts_.cut(now_, curves, cutter_, *method_, {});
  } catch (...) {  // Boost's numbers refuse the infinite ones that CGAL makes of subnormal coordinates
    now_ = *saved_.back();
    throw;
  }
  json result = numbers();
  result["status"] = name_of(made.cut.status);
  result["verdict"] = name_of(made.verdict);
  result["reason"] = made.reason;
  result["added"] = to_index(now_.sheet.triangle_count()) - to_index(triangles);
  result["crossed"] = made.cut.crossed_triangles;
  return result;
}

bool LiveSheet::undo() {
  if (saved_.empty()) return false;
  release();
  now_ = *saved_.back();
  saved_.pop_back();
  now_.model.reserve_spare();
  fault_.clear();
  return true;
}

Point2 LiveSheet::pick(Point3 origin, Point3 direction) const {
  return Picker(now_.posed()).rest_point({origin, direction}, "the pick");
}

TriangleIndex LiveSheet::triangle_at(Point2 p) const {
  const Sheet& sheet = now_.sheet;
  TriangleIndex nearest;
  double most = -1e300;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t) {
    if (!sheet.triangle(TriangleIndex(t)).alive()) continue;
    const auto [a, b, c] = sheet.corners(TriangleIndex(t));
    const double inside =
        std::min({cross(b - a, p - a), cross(c - b, p - b), cross(a - c, p - c)}) / cross(b - a, c - a);
    if (inside <= most) continue;
    most = inside;
    nearest = TriangleIndex(t);
    if (inside >= 0) break;
  }
  if (!nearest.valid()) throw InputError("the sheet has no triangles");
  return nearest;
}

Point3 LiveSheet::place(Point2 p) const {
  const TriangleIndex t = triangle_at(p);
  const auto [a, b, c] = now_.sheet.corners(t);
  const double area = cross(b - a, c - a);
  const std::array<double, 3> weight{cross(c - b, p - b) / area, cross(a - c, p - c) / area,
                                     cross(b - a, p - a) / area};
  std::array<double, 3> x{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t axis = 0; axis < 3; ++axis)
      x[axis] += weight[k] * now_.state.x[to_index(3 * now_.sheet.triangle(t).deformed[k]() + axis)];
  return {x[0], x[1], x[2]};
}

std::vector<LiveSheet::Near> LiveSheet::near(Point2 rest, double radius) const {
  const Sheet& sheet = now_.sheet;
  const Point3 at = place(rest);
  std::vector<std::uint8_t> met(sheet.deformed_slots(), 0), visited(sheet.triangle_slots(), 0);
  std::vector<TriangleIndex> stack{triangle_at(rest)};
  visited[stack[0]()] = 1;
  std::vector<Near> found;
  while (!stack.empty()) {
    const TriangleIndex t = stack.back();
    stack.pop_back();
    bool is_near = found.empty();
    for (const DeformedIndex d : sheet.triangle(t).deformed) {
      const Point2 p = sheet.rest(sheet.rest_vertex(d)) - rest;
      const double r2 = (p.x * p.x + p.y * p.y) / (radius * radius);
      if (r2 >= 1 && !found.empty()) continue;
      is_near = true;
      if (met[d()]) continue;
      met[d()] = 1;
      const auto x = now_.state.x.segment<3>(to_index(3 * d()));
      found.push_back({d(), std::max(0.05, (1 - r2) * (1 - r2)), {x[0] - at.x, x[1] - at.y, x[2] - at.z}});
    }
    for (int k = 0; is_near && k < 3; ++k) {
      const HalfEdge h = half_edge(t, k);
      if (sheet.separates(h)) continue;
      const TriangleIndex other = triangle_of(sheet.opposite(h));
      if (visited[other()]) continue;
      visited[other()] = 1;
      stack.push_back(other);
    }
  }
  return found;
}

void LiveSheet::grab(Point2 rest, double radius) {
  grabbed_ = near(rest, radius);
  to_ = place(rest);
}

void LiveSheet::release() {
  if (grabbed_.empty()) return;
  grabbed_.clear();
  now_.model.set_pins_and_force(now_.sheet, now_.pins, {});
}

/// Critically damped springs, soft enough to be stable when they are taken from the step before.
void LiveSheet::pull() {
  const double rate = 0.2 / scene_.step;
  force_.assign(to_size(now_.state.x.size()), 0);
  for (const Near& n : grabbed_) {
    const auto x = now_.state.x.segment<3>(to_index(3 * n.vertex)), v = now_.state.v.segment<3>(to_index(3 * n.vertex));
    const double mass = now_.model.lumped_mass()[to_index(n.vertex)];
    const std::array<double, 3> goal{to_.x + n.offset.x, to_.y + n.offset.y, to_.z + n.offset.z};
    for (std::size_t k = 0; k < 3; ++k)
      force_[3 * n.vertex + k] = mass * n.weight * rate * (rate * (goal[k] - x[to_index(k)]) - 2 * v[to_index(k)]);
  }
  now_.model.set_pins_and_force(now_.sheet, now_.pins, force_);
}

void LiveSheet::poke(Point2 rest, double radius, Point3 velocity) {
  const std::array<double, 3> added{velocity.x, velocity.y, velocity.z};
  for (const Near& n : near(rest, radius))
    for (std::size_t k = 0; k < 3; ++k)
      if (const auto u = 3 * n.vertex + k; !now_.model.held()[u]) now_.state.v[to_index(u)] += n.weight * added[k];
}

/// Both sides belong to one polygon.
bool LiveSheet::is_in_polygon(HalfEdge h) const {
  const ElementTable& elements = now_.model.elements();
  const TriangleIndex one = triangle_of(h), other = triangle_of(now_.sheet.opposite(h));
  const auto members = elements.members(one);
  return members.size() > 1 && std::find(members.begin(), members.end(), other) != members.end();
}

const std::vector<float>& LiveSheet::draw(Colour colour, bool at_rest) {
  const Sheet& sheet = now_.sheet;
  soup_.clear();
  std::vector<int> piece;
  if (colour == Colour::piece) piece = pieces_by_triangle(sheet);
  for (std::size_t i = 0; i < sheet.triangle_slots(); ++i) {
    const TriangleIndex t(i);
    const Triangle& triangle = sheet.triangle(t);
    if (!triangle.alive()) continue;
    int edges = 0;
    for (int k = 2; k >= 0; --k) {
      const HalfEdge h = half_edge(t, k);
      const int kind = sheet.on_border(h) ? 3 : sheet.separates(h) ? 2 : is_in_polygon(h) ? 1 : 0;
      edges = 4 * edges + kind;
    }
    const auto rest = sheet.corners(t);
    std::array<Point3, 3> now;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto x = now_.state.x.segment<3>(to_index(3 * triangle.deformed[k]()));
      now[k] = {x[0], x[1], x[2]};
    }
    double value = 0;
    if (colour == Colour::aspect_ratio) value = aspect_ratio(rest[0], rest[1], rest[2]);
    if (colour == Colour::strain) value = strain_of(rest, now);
    if (colour == Colour::piece) value = piece[i];
    for (std::size_t k = 0; k < 3; ++k) {
      const Point3 x = at_rest ? Point3{rest[k].x, rest[k].y, 0} : now[k];
      for (const double number : {x.x, x.y, x.z, value, to_double(edges)}) soup_.push_back(static_cast<float>(number));
    }
  }
  return soup_;
}

json LiveSheet::numbers() const {
  const Quality q = quality_of(now_.sheet);
  std::size_t polygons = 0;
  for (std::size_t p = 0; p < now_.model.elements().polygon_slots(); ++p)
    polygons += !now_.model.elements().polygon(p).polygon.triangles.empty();
  return {{"triangles", now_.sheet.triangle_count()},
          {"triangles_before", triangles_before_},
          {"vertices", now_.sheet.deformed_count()},
          {"aspect_ratio", q.ar_max},
          {"pieces", count_pieces(now_.sheet)},
          {"polygons", polygons},
          {"time", now_.state.time}};
}

json judged(const Scene& scene, const std::string& method, double parameter, const std::vector<Curve>& curves) {
  const MethodRow& row = find_method(method);
  const Sheet before = sheet_of(scene);
  JudgedSheet sheet(before, row.promises, make_method(row, parameter));
  json result{{"verdict", "ok"}, {"reason", ""}};
  double incision_error = 0;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    check_curve(curves[i], "the stroke");
    const JudgedSheet::Finding finding = sheet.cut(curves[i], {});
    incision_error = std::max(incision_error, sheet.judgement.incision_error);
    if (finding.ok()) continue;
    result["verdict"] = name_of(finding.verdict);
    result["reason"] = "cut " + std::to_string(i + 1) + ": " + finding.reason;
    break;
  }
  result["incision_error"] = incision_error / before.mean_edge();
  result["pieces"] = count_pieces(sheet.sheet);
  const auto maker = make_method(row, parameter);
  const Elasticity elasticity{.poisson = scene.material.poisson};
  result["eigenvalue_ratio"] =
      largest_eigenvalue(sheet.sheet, constraints_of(*maker, before, sheet.sheet), elasticity) /
      largest_eigenvalue(before, {}, elasticity);
  return result;
}

json timed(const Scene& scene, const std::string& method, double parameter, const std::vector<Curve>& curves) {
  const MethodRow& row = find_method(method);
  const auto maker = make_method(row, parameter);
  Sheet sheet = sheet_of(scene);
  Locator locator(sheet);
  Cutter cutter;
  cut_all(sheet, locator, cutter, std::span(curves).first(curves.size() - 1), *maker, {});
  const std::size_t copies = std::clamp<std::size_t>(100000 / (sheet.triangle_count() + 1), 4, 32);
  double total = 0, cuts = 0, spent = 0;
  for (int round = 0; round < 24; ++round) {  // a browser compiles anew what runs often: the first half is not counted
    std::vector<Sheet> sheets(copies, sheet);
    std::vector<Locator> locators(copies, locator);
    StopWatch watch;
    for (std::size_t i = 0; i < copies; ++i) cutter.cut(sheets[i], locators[i], curves.back(), *maker, {});
    const double round_ms = watch.lap() / 1000;
    spent += round_ms;
    if (round < 12 && spent < 400) continue;
    total += round_ms;
    cuts += to_double(copies);
    if (spent > 800) break;
  }
  return {{"ms", total / cuts}, {"cuts", cuts}, {"total_ms", total}};
}

}  // namespace cutbench::live
