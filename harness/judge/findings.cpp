#include "harness/judge/findings.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>

#include "harness/base/conversions.h"
#include "harness/judge/causes.h"
#include "harness/judge/few_digits.h"
#include "harness/judge/lost_digits.h"

namespace cutbench {

namespace causes {

std::string number(double x, const char* format) {
  char text[40];
  std::snprintf(text, sizeof text, format, x);
  return text;
}
std::string at(const Point& p) { return "(" + number(p[0]) + ", " + number(p[1]) + ")"; }

std::vector<Finding> Causes::find() {
  if (judgement_.verdict == Verdict::not_finite || judgement_.verdict == Verdict::bad_index) return {other()};
  before_edges_ = oracle::half_edges(before_);
  edges_ = oracle::half_edges(after_);
  h_ = oracle::edge_lengths(before_, before_edges_).mean;
  compare_places();
  std::vector<Finding> all;
  const auto try_one = [&](std::optional<Finding> found) {
    if (found && all.empty()) all.push_back(std::move(*found));
  };
  if (request_.rounding == 0) try_one(rounded());
  if (judgement_.ok) return with_cuts(all);
  if (all.empty()) try_one(moved_apart());
  try_one(other_rest());
  if (request_.keeps_vertices && all.empty()) try_one(moved_vertex());
  if (all.empty()) try_one(flipped());
  if (all.empty()) try_one(unused_copy());
  if (!edges_.repeated.empty() && all.empty()) return {other()};
  if (all.empty() && request_.keeps_area) look_at_borders(try_one);
  if (all.empty()) all.push_back(other());
  return with_cuts(all);
}

template <class Try>
void Causes::look_at_borders(Try try_one) {
  borders_ = oracle::borders(after_, edges_);
  std::vector<Segment> outline;
  for (const int e : oracle::borders(before_, before_edges_).single) outline.push_back(segment(before_, e));
  const oracle::SegmentSearch search(outline);
  for (const int e : borders_.single)
    if (!search.covers(segment(after_, e), request_.snap + 1e-12 * h_)) loose_.push_back(e);
  try_one(lips_differ());
  try_one(t_junction());
  try_one(lost_triangle());
  try_one(doubled());
  try_one(one_vertex());
  try_one(beside_path());
  try_one(extra_pieces());
  try_one(not_opened());
  try_one(lost_loop());
  try_one(pieces("pieces", "open the whole path, and nothing beside it"));
}

void Causes::compare_places() {
  const std::vector<int> unused = oracle::unused_vertices(before_);
  std::set<Point> had, has(after_.rest.begin(), after_.rest.end());
  for (int v = 0; v < to_int(before_.rest.size()); ++v)
    if (!std::binary_search(unused.begin(), unused.end(), v)) had.insert(before_.rest[v]);
  places_before_ = had.size();
  for (const Point& p : had)
    if (!has.contains(p)) gone_.push_back(p);
  for (const Point& p : has)
    if (!had.contains(p)) new_.push_back(p);
}

std::optional<Finding> Causes::rounded() const {
  std::string how;
  Point worst{};
  double farthest = -1, off = 0;
  if (!new_.empty() && 2 * gone_.size() >= places_before_) {
    std::vector<Segment> places;
    for (const Point& p : new_) places.push_back({p, p});
    const oracle::SegmentSearch search(places);
    std::size_t close = 0;
    for (const Point& p : gone_)
      if (const double d = search.distance(p); d <= 1e-4 * h_) {
        ++close;
        if (d > farthest) {
          farthest = d;
          worst = p;
        }
      }
    if (10 * close < 9 * gone_.size()) return {};
    how = std::to_string(close) + " of " + std::to_string(places_before_) +
          " vertices of the sheet are off their place by up to " + number(farthest, "%.2g") + " (" +
          number(farthest / h_, "%.1g") + " h), the most at " + at(worst);
    off = farthest;
  } else {
    std::set<double> known;  // of the sheet and the path
    for (const Point& p : before_.rest) known.insert(p.begin(), p.end());
    for (const oracle::Curve& cut : request_.cuts)
      for (const Point& p : cut.points) known.insert(p.begin(), p.end());
    const std::string digits = lost_digits(new_, known);
    if (digits.empty()) return {};
    how = "all " + std::to_string(new_.size()) + " new vertices have coordinates " + digits + ", the first at " +
          at(new_.front());
    worst = new_.front();
    double largest = 0;
    for (const Point& p : before_.rest) largest = std::max({largest, std::abs(p[0]), std::abs(p[1])});
    off = digits.starts_with("with ") ? std::pow(10.0, -std::stoi(digits.substr(5))) : 0x1p-24 * largest;
  }
  return Finding{
      "rounded", how + ": rest positions were rounded",
      std::string("compute and write rest positions in double precision, with 17 digits (%.17g), and leave those of "
                  "the sheet as they were read") +
          digits_mend(off),
      worst};
}

std::string Causes::digits_mend(double off) const {
  const int digits = off > 0 ? digits_that_allow(off, before_) : 0;
  if (digits < 1) return {};
  return "; or `cutbench score --digits " + std::to_string(digits) + "`, which allows for it";
}

std::optional<Finding> Causes::other_rest() const {
  if (10 * gone_.size() < 9 * places_before_ || judgement_.verdict == Verdict::wrong_pieces ||
      judgement_.verdict == Verdict::incision)
    return {};
  return Finding{
      "other_rest",
      "the sheet's vertices are not at their rest places: of " + std::to_string(places_before_) + " " +
          std::to_string(places_before_ - gone_.size()) + " are where they were at rest",
      "write the rest positions as `vt`, or a flat mesh whose `v` they are; check that it is a result of this sheet",
      {}};
}

std::optional<Finding> Causes::moved_vertex() const {
  for (std::size_t v = 0; v < before_.rest.size(); ++v) {
    const Point& was = before_.rest[v];
    if (v < after_.rest.size() && after_.rest[v] == was) continue;
    const std::string name = "vertex " + std::to_string(v) + " of the sheet, at " + at(was) + ", ";
    const auto same = std::find(after_.rest.begin(), after_.rest.end(), was);
    std::string text = name + "is not in the result";
    if (same != after_.rest.end())
      text = name + "is vertex " + std::to_string(same - after_.rest.begin()) + " of the result";
    else if (v < after_.rest.size())
      text = name + "is at " + at(after_.rest[v]) + " in the result, " +
             number(distance(was, after_.rest[v]) / h_, "%.3g") + " h away";
    return Finding{"moved_vertex", text,
                   "leave the sheet's vertices where they are, with their numbers; put new ones behind them", was};
  }
  return {};
}

Point Causes::centre(int t) const {
  Point c{0, 0};
  for (const int v : after_.triangles[t])
    for (std::size_t i = 0; i < 2; ++i) c[i] += after_.rest[v][i] / 3;
  return c;
}
std::string Causes::name(int t) const {
  const auto& [a, b, c] = after_.triangles[t];
  return "triangle " + std::to_string(t) + " (" + std::to_string(a) + " " + std::to_string(b) + " " +
         std::to_string(c) + ") at " + at(centre(t));
}

std::optional<Finding> Causes::flipped() const {
  if (auto piece = clockwise_piece()) return piece;
  std::optional<Finding> folded;
  for (int t = 0; t < to_int(after_.triangles.size()); ++t) {
    const auto& [a, b, c] = after_.triangles[t];
    const int turn = orientation(after_.rest[a], after_.rest[b], after_.rest[c]);
    if (turn > 0) continue;
    const bool against = turn < 0 && runs_against_neighbours(t);
    if (against)
      return Finding{"flipped", name(t) + " has its corners in clockwise order", "swap two of its corners", centre(t)};
    if (folded) continue;
    const std::string how = name(t) + (turn < 0 ? " is turned over" : " has no area") + " at rest";
    if (is_lost_in_rounding(t))
      folded = Finding{"rounded", how + ": it is thinner than what its corners are off by the digits that are lost",
                       "write the result with more digits", centre(t)};
    else
      folded =
          Finding{"folded", how,
                  "a corner of it lies across the opposite edge, or on it: move that corner back, or divide otherwise",
                  centre(t)};
  }
  return folded;
}

bool Causes::is_lost_in_rounding(int t) const {
  const auto& [a, b, c] = after_.triangles[t];
  const Point &p = after_.rest[a], &q = after_.rest[b], &r = after_.rest[c];
  const double longest = std::max({distance(p, q), distance(q, r), distance(r, p)});
  return request_.rounding > 0 && std::abs(oracle::cross(minus(q, p), minus(r, p))) <= 2 * request_.rounding * longest;
}

bool Causes::runs_against_neighbours(int t) const {
  const auto mine = [t](int e) { return e / 3 == t; };
  return std::any_of(edges_.repeated.begin(), edges_.repeated.end(), mine) ||
         (edges_.opposite[3 * t] < 0 && edges_.opposite[3 * t + 1] < 0 && edges_.opposite[3 * t + 2] < 0);
}

Finding Causes::other() const {
  const bool is_unused = judgement_.verdict == Verdict::unused_vertex;
  return {"other",
          judgement_.problems.empty() ? name_of(judgement_.verdict) : judgement_.problems.front(),
          is_unused ? "leave it out, and number those behind it anew" : "see the verdict in results/README.md",
          {}};
}

std::vector<Finding> Causes::with_cuts(std::vector<Finding> all) const {
  for (Finding& f : all) {
    if (!f.place) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < request_.cuts.size(); ++i)
      if (const double d = oracle::SegmentSearch(path_of(i)).distance(*f.place); f.cut == 0 || d < nearest) {
        nearest = d;
        f.cut = to_int(i) + 1;
      }
  }
  return all;
}

}  // namespace causes

std::vector<Finding> find_causes(const oracle::Request& request, const oracle::Mesh& after,
                                 const Judgement& judgement) {
  return causes::Causes(request, after, judgement).find();
}

}  // namespace cutbench
