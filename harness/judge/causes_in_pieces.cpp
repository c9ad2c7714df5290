// Causes by the pieces: another number of them than the path makes.
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/judge/causes.h"

namespace cutbench::causes {

auto Causes::all_pieces(const std::vector<int>& piece) const -> std::vector<Piece> {
  // Over seams the judgement counts fewer.
  std::vector<Piece> all(piece.empty() ? 0 : to_size(*std::max_element(piece.begin(), piece.end()) + 1));
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

std::optional<Finding> Causes::clockwise_piece() const {
  const std::vector<int> piece = oracle::pieces_of_triangles(edges_);
  const int count = piece.empty() ? 0 : *std::max_element(piece.begin(), piece.end()) + 1;
  std::vector<int> triangles(to_size(count), 0), clockwise(to_size(count), 0), first(to_size(count), -1);
  for (int t = 0; t < to_int(piece.size()); ++t) {
    const auto& [a, b, c] = after_.triangles[t];
    ++triangles[piece[t]];
    clockwise[piece[t]] += orientation(after_.rest[a], after_.rest[b], after_.rest[c]) < 0;
    if (first[piece[t]] < 0) first[piece[t]] = t;
  }
  if (count > 0 && triangles == clockwise)
    return Finding{"flipped", "every triangle has its corners in clockwise order", "swap two corners of each", {}};
  for (std::size_t p = 0; p < to_size(count); ++p)
    if (triangles[p] > 1 && triangles[p] == clockwise[p])
      return Finding{"flipped",
                     "every triangle of the piece round " + at(centre(first[p])) + ", " + std::to_string(triangles[p]) +
                         " of " + std::to_string(piece.size()) + " triangles, has its corners in clockwise order",
                     "swap two corners of each of these", centre(first[p])};
  return {};
}

// --- pieces that are not where they were -----------------------------------------------------------------------------

auto Causes::moves_of_pieces(const std::vector<int>& piece) const -> std::vector<Moved> {
  std::vector<Moved> moves;
  if (!piece.empty()) moves.resize(to_size(*std::max_element(piece.begin(), piece.end()) + 1));
  std::vector<char> seen(after_.rest.size(), 0);
  for (int t = 0; t < to_int(piece.size()); ++t)
    for (const int v : after_.triangles[t]) {
      if (std::exchange(seen[v], 1) != 0) continue;
      if (to_size(v) < before_.rest.size()) moves[piece[t]].old.push_back(v);
    }
  const double near = 1e-6 * h_;
  for (Moved& m : moves) {
    if (m.old.empty()) continue;
    for (std::size_t i = 0; i < 2; ++i) {
      std::vector<double> by;
      for (const int v : m.old) by.push_back(after_.rest[v][i] - before_.rest[v][i]);
      std::nth_element(by.begin(), by.begin() + to_index(by.size() / 2), by.end());
      m.by[i] = by[by.size() / 2];
    }
    for (const int v : m.old) {
      const Point by = minus(after_.rest[v], before_.rest[v]);
      m.away += distance(after_.rest[v], before_.rest[v]) > 0.02 * h_;
      m.together += distance(by, m.by) <= near;
    }
  }
  return moves;
}

std::optional<Finding> Causes::moved_apart() const {
  if (gone_.empty()) return {};
  const std::vector<Moved> moves = moves_of_pieces(oracle::pieces_of_triangles(edges_));
  const bool hardly_one_stays = 10 * gone_.size() >= 9 * places_before_;
  const std::set<Point> gone(gone_.begin(), gone_.end());
  std::string which;
  std::size_t old = 0;
  std::optional<Point> place;
  for (const Moved& m : moves) {
    const auto is_gone = [&](int v) { return gone.contains(before_.rest[v]); };
    const auto left = to_size(std::count_if(m.old.begin(), m.old.end(), is_gone));
    const bool away = m.away >= 3 && 10 * m.away >= 6 * m.old.size() && 4 * left >= m.away;
    const bool in_one = 10 * m.together >= 6 * m.old.size() && distance(m.by, Point{0, 0}) > 1e-6 * h_;
    if (!away || (!in_one && hardly_one_stays)) continue;
    which += (which.empty() ? "; the piece with vertex " : ", that with vertex ") + std::to_string(m.old.front());
    which += in_one ? " is moved by " + at(m.by) : " is turned or bent";
    old += m.away;
    if (!place) place = before_.rest[m.old.front()];
  }
  if (!place) return {};
  return Finding{
      "moved_apart",
      "the sheet's vertices are not at their rest places: " + std::to_string(old) + " of " +
          std::to_string(places_before_) + " are elsewhere" + which,
      "write the rest positions as `vt` beside the positions `v`, or a flat mesh whose pieces lie where they "
      "were in the sheet: both lips of an incision at one place",
      place};
}

bool Causes::holds(int t, const Point& p) const {
  const auto& [a, b, c] = after_.triangles[t];
  return orientation(after_.rest[a], after_.rest[b], p) >= 0 && orientation(after_.rest[b], after_.rest[c], p) >= 0 &&
         orientation(after_.rest[c], after_.rest[a], p) >= 0;
}

}  // namespace cutbench::causes
