#include "harness/oracle/chains.h"

#include "harness/oracle/conversions.h"
#include "harness/oracle/sheet_topology.h"

namespace cutbench::oracle {
namespace {

bool sharp(const PathSegment& a, const PathSegment& b) {
  constexpr double cosine = 0.7071067811865476;
  return dot(a.tangent_end, b.tangent_start) < cosine;
}

/// Divides a run of segments at its sharp turns.
void add_chains(std::vector<PathSegment> run, bool closed, bool curved, std::vector<Chain>& chains) {
  if (run.empty()) return;
  if (closed) {  // begin at a sharp turn, if there is one
    std::size_t i = 0;
    while (i < run.size() && !sharp(run[(i + run.size() - 1) % run.size()], run[i])) ++i;
    if (i == run.size()) {
      chains.push_back({std::move(run), true, curved});
      return;
    }
    std::rotate(run.begin(), run.begin() + to_index(i), run.end());
  }
  for (std::size_t i = 0; i < run.size(); ++i) {
    if (i == 0 || sharp(run[i - 1], run[i])) chains.push_back({{}, false, curved});
    chains.back().segments.push_back(run[i]);
  }
}

}  // namespace

std::vector<Chain> border_chains(const Mesh& mesh) {
  const HalfEdges edges = half_edges(mesh);
  const int count = to_int(edges.opposite.size());
  std::vector<int> from(mesh.rest.size(), -1);  // the border half-edge that leaves a vertex; there is at most one
  for (int e = 0; e < count; ++e)
    if (edges.opposite[e] < 0) from[mesh.triangles[e / 3][e % 3]] = e;

  std::vector<Chain> chains;
  std::vector<char> taken(count, 0);
  for (int first = 0; first < count; ++first) {
    if (edges.opposite[first] >= 0 || taken[first]) continue;
    std::vector<PathSegment> loop;
    for (int e = first; !taken[e]; e = from[mesh.triangles[e / 3][(e + 1) % 3]]) {
      taken[e] = 1;
      const Segment s = segment(mesh, e);
      const Point d = direction(s[0], s[1]);
      loop.push_back({s, d, d});
    }
    add_chains(std::move(loop), true, false, chains);
  }
  return chains;
}

std::vector<Chain> path_chains(const std::vector<Curve>& cuts, double tolerance) {
  std::vector<Chain> chains;
  for (const Curve& cut : cuts) {
    std::vector<PathSegment> run = flatten(cut, tolerance);
    const bool closed = !run.empty() && run.front().segment[0] == run.back().segment[1];
    add_chains(std::move(run), closed, cut.bezier, chains);
  }
  return chains;
}

Walker::Walker(const Chain& chain, int index, bool forward, const Point& start)
    : chain_(chain), index_(index), forward_(forward), position_(start) {
  const int count = to_int(chain.segments.size());
  segments_left_ = chain.closed ? count - 1 : forward ? count - 1 - index : index;
}

double Walker::advance(double length) {
  for (double left = length;;) {
    const Point& end = chain_.segments[index_].segment[forward_ ? 1 : 0];
    const double rest = distance(position_, end);
    if (left < rest) {
      position_ = between(position_, end, left / rest);
      return length;
    }
    position_ = end;
    left -= rest;
    if (segments_left_ == 0) return length - left;
    --segments_left_;
    const int count = to_int(chain_.segments.size());
    index_ = (index_ + (forward_ ? 1 : count - 1)) % count;
  }
}

}  // namespace cutbench::oracle
