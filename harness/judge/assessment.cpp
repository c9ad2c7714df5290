#include "harness/judge/assessment.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "harness/base/conversions.h"
#include "harness/judge/on_surface.h"
#include "harness/judge/oracle_request.h"
#include "harness/oracle/sheet_topology.h"

namespace cutbench {

namespace {

using Corners = std::array<oracle::Point, 3>;

Corners corners_of(const oracle::Mesh& mesh, std::size_t t) {
  const auto at = [&](std::size_t k) { return mesh.rest[to_size(mesh.triangles[t][k])]; };
  return {at(0), at(1), at(2)};
}

/// Per triangle of `after`, whether no triangle before has the same corners in the same order round it.
std::vector<char> changed_triangles(const oracle::Mesh& before, const oracle::Mesh& after) {
  const auto from_smallest = [](const oracle::Mesh& mesh, std::size_t t) {
    Corners c = corners_of(mesh, t);
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
    return c;
  };
  std::vector<Corners> known;
  for (std::size_t t = 0; t < before.triangles.size(); ++t) known.push_back(from_smallest(before, t));
  std::sort(known.begin(), known.end());
  std::vector<char> changed;
  for (std::size_t t = 0; t < after.triangles.size(); ++t)
    changed.push_back(!std::binary_search(known.begin(), known.end(), from_smallest(after, t)));
  return changed;
}

std::size_t count_places(const oracle::Mesh& mesh) {
  std::vector<oracle::Point> places = mesh.rest;
  std::sort(places.begin(), places.end());
  return to_size(std::unique(places.begin(), places.end()) - places.begin());
}

/// Whether quality() can be asked: it wants edges, and no numbers that overflow.
bool can_be_measured(const Judgement& judgement, const oracle::Mesh& mesh) {
  if (judgement.verdict == Verdict::not_finite || judgement.verdict == Verdict::bad_index) return false;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = corners_of(mesh, t);
    for (const double length : {oracle::distance(a, b), oracle::distance(b, c), oracle::distance(c, a)})
      if (!(length >= 1e-150 && length <= 1e60)) return false;
  }
  return true;
}

std::ptrdiff_t difference(std::size_t a, std::size_t b) { return to_index(a) - to_index(b); }

Quality quality_in_h(const std::vector<std::array<Point2, 3>>& triangles, double h) {
  Quality q = quality(triangles);
  q.altitude_min /= h;
  return q;
}

/// Shapes and forced zones of a result.
void measure(Assessment& result, const oracle::Mesh& mesh, const std::vector<char>& changed,
             std::span<const oracle::ForcedCorner> forced, double h) {
  const auto zones = oracle::forced_zones({forced.begin(), forced.end()}, mesh, h);
  result.forced_corners = forced.size();
  result.corner_triangles = zones.corner_triangles;
  result.wedge_triangles = zones.zone_triangles;
  result.wedge_area = zones.zone_area;
  std::vector<std::array<Point2, 3>> all, cut, strict, outside_wedges, away;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    auto& c = all.emplace_back();
    const Corners corners = corners_of(mesh, t);
    std::transform(corners.begin(), corners.end(), c.begin(), [](const oracle::Point& p) {
      return Point2{p[0], p[1]};
    });
    if (!changed[t]) continue;
    cut.push_back(c);
    if (!zones.in_corner[t]) strict.push_back(c);
    if (!zones.in_zone[t]) outside_wedges.push_back(c);
    if (!zones.near_zone[t]) away.push_back(c);
  }
  result.all = quality_in_h(all, h);
  result.cut = quality_in_h(cut, h);
  result.strict = quality_in_h(strict, h);
  result.outside_wedges = quality_in_h(outside_wedges, h);
  result.ar_max_away_from_wedges = quality(away).ar_max;
}

/// The oracle judges places in rest space; but no simulation goes on from a vertex that is nowhere.
void check_positions(Judgement& judgement, const std::vector<Point3>& positions) {
  const auto lost = std::find_if(positions.begin(), positions.end(), [](const Point3& p) {
    return !std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z);
  });
  if (lost == positions.end() || judgement.verdict == Verdict::not_finite) return;
  judgement.ok = false;
  judgement.verdict = Verdict::not_finite;
  judgement.problems.insert(judgement.problems.begin(),
                            "not_finite: position of vertex " + std::to_string(lost - positions.begin()));
}

/// What is wrong behind the verdict. Lost digits are wrong even where the oracle allows for what they change.
void find_faults(Assessment& a, const oracle::Request& request, const oracle::Mesh& mesh,
                 const std::vector<Point3>& positions) {
  a.findings = find_causes(request, mesh, a.judgement);
  if (!a.findings.empty() && a.findings.front().cause == "rounded") {
    a.judgement.ok = false;
    a.judgement.verdict = Verdict::rounded;
    a.judgement.problems.insert(a.judgement.problems.begin(), "rounded: " + a.findings.front().text);
  }
  check_positions(a.judgement, positions);
  if (!a.judgement.ok && a.findings.empty())
    a.findings.push_back({"other", a.judgement.problems.front(), "write a number for each coordinate", {}});
}

}  // namespace

std::vector<oracle::ForcedCorner> forced_corners_of(const Sheet& before, std::span<const Curve> cuts) {
  return oracle::forced_corners(for_oracle(before), for_oracle(cuts), before.mean_edge());
}

Assessment assess(const Sheet& before, const Sheet& after, const Judgement& judgement,
                  std::span<const oracle::ForcedCorner> forced) {
  Assessment result;
  result.judgement = judgement;
  const oracle::Mesh mesh = for_oracle(after);
  measure(result, mesh, changed_triangles(for_oracle(before), mesh), forced, before.mean_edge());
  result.vertices_added = difference(after.vertex_count(), before.vertex_count());
  result.deformed_vertices_added = difference(after.deformed_count(), before.deformed_count());
  result.triangles_added = difference(after.triangle_count(), before.triangle_count());
  return result;
}

namespace {

/// What a result that anybody made is judged by.
struct Exam {
  oracle::Request request;
  oracle::Mesh mesh;
  Assessment assessment;

  Exam(const Sheet& before, const MeshData& result, std::span<const Curve> cuts, const Promises& asked,
       const CutOptions& options, int digits)
      : request(request_for(before, cuts, asked, options, true)) {
    for (Point2 p : result.rest) mesh.rest.push_back({p.x, p.y});
    mesh.triangles = result.triangles;
    if (digits > 0) {
      assessment.read = put_back(mesh, request.before, digits);
      request.rounding = assessment.read.rounding;
    }
    Judgement& judgement = assessment.judgement;
    try {
      judgement = oracle::judge(request, mesh);
    } catch (const std::invalid_argument& error) {
      throw InputError(error.what());
    }
    assessment.connected = judgement.verdict != Verdict::not_finite && judgement.verdict != Verdict::bad_index &&
                           oracle::half_edges(mesh).repeated.empty();
    if (assessment.connected) {
      Leeway leeway;
      leeway.add(judgement);
      judge_on_surface(judgement, before, cuts, mesh, asked, leeway);
    }
    assessment.measured = can_be_measured(judgement, mesh);
    find_faults(assessment, request, mesh, result.deformed);
  }
};

}  // namespace

Assessment judge_result(const Sheet& before, const MeshData& result, std::span<const Curve> cuts, const Promises& asked,
                        const CutOptions& options) {
  return Exam(before, result, cuts, asked, options, 0).assessment;
}

Assessment assess_result(const Sheet& before, const MeshData& result, std::span<const Curve> cuts,
                         const Promises& asked, const CutOptions& options, int digits) {
  Exam exam(before, result, cuts, asked, options, digits);
  Assessment& a = exam.assessment;
  if (!a.measured) return a;
  const oracle::Mesh &mesh = exam.mesh, &was = exam.request.before;
  measure(a, mesh, changed_triangles(was, mesh), forced_corners_of(before, cuts), before.mean_edge());
  a.vertices_added = difference(count_places(mesh), count_places(was));
  a.deformed_vertices_added = difference(mesh.rest.size(), was.rest.size());
  a.triangles_added = difference(mesh.triangles.size(), was.triangles.size());
  return a;
}

}  // namespace cutbench
