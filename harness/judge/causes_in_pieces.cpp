// Causes by the pieces: another number of them than the path makes.
#include <algorithm>
#include <cmath>
#include <limits>

#include "harness/base/conversions.h"
#include "harness/judge/causes.h"

namespace cutbench::causes {

auto Causes::all_pieces(const std::vector<int>& piece) const -> std::vector<Piece> {
  std::vector<Piece> all(to_size(judgement_.pieces));
  for (int t = 0; t < to_int(piece.size()); ++t) {
    const double a = area_of(t);
    Piece& p = all[piece[t]];
    p.area += a;
    if (a > p.largest_area) {
      p.largest_area = a;
      p.largest = t;
    }
  }
  return all;
}
double Causes::area_of(int t) const {
  const auto& [a, b, c] = after_.triangles[t];
  return oracle::cross(minus(after_.rest[b], after_.rest[a]), minus(after_.rest[c], after_.rest[a])) / 2;
}

std::optional<Finding> Causes::pieces(const char* cause, const char* mend) const {
  if (judgement_.verdict != Verdict::wrong_pieces) return {};
  std::vector<Piece> all = all_pieces(oracle::pieces_of_triangles(edges_));
  std::sort(all.begin(), all.end(), [](const Piece& a, const Piece& b) { return a.area < b.area; });
  std::string text = std::to_string(judgement_.pieces) + " pieces instead of " +
                     std::to_string(judgement_.expected_pieces) + "; the smallest:";
  for (std::size_t i = 0; i < std::min<std::size_t>(all.size(), 3); ++i)
    text += (i > 0 ? ", area " : " area ") + number(all[i].area, "%.3g") + " round " + at(centre(all[i].largest));
  return Finding{cause, text, mend, centre(all.front().largest)};
}

std::optional<Finding> Causes::extra_pieces() const {
  if (judgement_.pieces <= judgement_.expected_pieces) return {};
  return pieces("extra_pieces",
                "nothing but the path parts triangles: give the triangles on both sides of every other edge the same "
                "vertices");
}

std::optional<Finding> Causes::lost_loop() const {
  if (judgement_.verdict != Verdict::wrong_pieces || judgement_.pieces >= judgement_.expected_pieces) return {};
  const std::vector<int> piece = oracle::pieces_of_triangles(edges_);
  const std::vector<Piece> all = all_pieces(piece);
  double smallest = std::numeric_limits<double>::infinity();
  Point place{};
  for (std::size_t cut = 0; cut < request_.cuts.size(); ++cut) {
    const std::vector<Segment> path = path_of(cut);
    if (path.empty() || path.front()[0] != path.back()[1]) continue;
    double twice = 0;
    Point middle{0, 0};
    for (const auto& [a, b] : path) {
      twice += oracle::cross(minus(a, path.front()[0]), minus(b, path.front()[0]));
      for (std::size_t i = 0; i < 2; ++i) middle[i] += a[i] / to_double(path.size());
    }
    const double inside = std::abs(twice) / 2;
    for (int t = 0; t < to_int(piece.size()); ++t)
      if (holds(t, middle) && all[piece[t]].area > 2 * inside && inside < smallest) {
        smallest = inside;
        place = middle;
      }
  }
  if (!std::isfinite(smallest)) return {};
  return Finding{"lost_loop",
                 std::to_string(judgement_.pieces) + " pieces instead of " +
                     std::to_string(judgement_.expected_pieces) + ": the closed cut round " + at(place) +
                     " cuts out an area of " + number(smallest, "%.3g") + ", which is no piece of its own",
                 "a small loop must not shrink to a point or a line: give it three vertices at least, and open all its "
                 "edges",
                 place};
}
bool Causes::holds(int t, const Point& p) const {
  const auto& [a, b, c] = after_.triangles[t];
  return orientation(after_.rest[a], after_.rest[b], p) >= 0 && orientation(after_.rest[b], after_.rest[c], p) >= 0 &&
         orientation(after_.rest[c], after_.rest[a], p) >= 0;
}

}  // namespace cutbench::causes
