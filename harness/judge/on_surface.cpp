#include "harness/judge/on_surface.h"

#include <algorithm>

#include "harness/judge/oracle_request.h"
#include "harness/mesh/tolerances.h"
#include "harness/oracle/surface.h"

namespace cutbench {

namespace {

oracle::Surface surface_of(const Sheet& sheet) {
  const MeshData data = sheet.to_mesh_data();
  oracle::Surface surface{{{}, data.triangles}, data.sewn};
  for (const Point2 p : data.rest) surface.mesh.rest.push_back({p.x, p.y});
  const auto segment = [](const std::array<Point2, 2>& side) {
    return oracle::Segment{{{side[0].x, side[0].y}, {side[1].x, side[1].y}}};
  };
  for (const Seam& seam : sheet.seams()) surface.seams.push_back({segment(seam.first), segment(seam.second)});
  return surface;
}

}  // namespace

void Leeway::add(const Judgement& judgement) {
  fewer += std::max(0, judgement.expected_pieces - judgement.least_pieces);
  more += std::max(0, judgement.most_pieces - judgement.expected_pieces);
}

void judge_on_surface(Judgement& judgement, const Sheet& before, std::span<const Curve> cuts, const oracle::Mesh& after,
                      const Promises& promises, const Leeway& leeway) {
  if (before.seams().empty()) return;
  const oracle::SurfaceJudgement found =
      oracle::judge_surface(surface_of(before), for_oracle(cuts), after, line_tolerance * before.snap());
  judgement.pieces = found.pieces;
  if (!promises.keeps_area) return;
  judgement.expected_pieces = found.expected;
  judgement.least_pieces = std::max(1, found.least - leeway.fewer);
  judgement.most_pieces = found.most + leeway.more;
  const auto add = [&judgement](Verdict verdict, const std::string& text) {
    if (judgement.ok) judgement.verdict = verdict;
    judgement.ok = false;
    judgement.problems.push_back(std::string(name_of(verdict)) + ": " + text);
  };
  if (found.pieces < judgement.least_pieces || found.pieces > judgement.most_pieces)
    add(Verdict::wrong_pieces,
        std::to_string(found.pieces) + " instead of " + std::to_string(found.expected) + ", over seams");
  if (promises.exact_incision && found.unopened > 0)
    add(Verdict::incision, "the path crosses a seam where a side of it is whole, at " + std::to_string(found.unopened) +
                               " of " + std::to_string(found.crossings) + " ends of its parts");
}

}  // namespace cutbench
