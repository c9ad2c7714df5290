// A curved path that runs along an older incision, such as the same curve cut again. It does not meet the chords of
// that incision, but stays within the chord tolerance of them. There the path is taken to run along the incision, which
// is open already; otherwise every repetition would cut off a thin strip.
#include <cmath>

#include "harness/mesh/one_ring.h"
#include "harness/path/trace.h"

namespace cutbench {

namespace {

bool is_near(Point2 p, const std::vector<Point2>& polyline, double tolerance) {
  for (std::size_t i = 0; i + 1 < polyline.size(); ++i)
    if (squared_distance(p, polyline[i], polyline[i + 1]) <= tolerance * tolerance) return true;
  return false;
}

}  // namespace

bool Tracer::is_on_incision(const Place& place) const {
  if (place.kind == Place::Kind::edge) return sheet_->mark(place.edge) == EdgeMark::incision;
  if (place.kind != Place::Kind::vertex) return false;
  for (const HalfEdge h : outgoing_edges(*sheet_, place.vertex)) {
    if (sheet_->mark(h) == EdgeMark::incision) return true;
  }
  return false;
}

/// Takes one step of the walk. Steps of a curved path between two places on an incision are kept back, and dropped if
/// the path ran along the incision between them.
void Tracer::take(const Step& step, std::size_t point, bool tip) {
  // Only short excursions are compared with the incision; longer ones are cut as they are.
  constexpr std::size_t longest = 256;
  const bool may_follow = path_->curved && std::isfinite(chord_tolerance_);
  if (departed_)
    excursion_.push_back({step, point, tip});
  else
    handle(step, point, tip);
  if (!may_follow) return;
  const bool back = is_on_incision(step.place);
  if (departed_ && back && runs_along_incision()) {
    excursion_.clear();
    from_ = step.place;
    from_node_ = -1;
    first_ = step.arrived ? point + 1 : point;
    count_ = 0;
  } else if (back || excursion_.size() == longest) {
    flush();
    departed_ = false;
  }
  if (back) {
    departed_ = true;
    departure_ = step.place;
  }
}

void Tracer::flush() {
  for (const Taken& taken : excursion_) handle(taken.step, taken.point, taken.tip);
  excursion_.clear();
}

/// Is there a chain of incision edges from the excursion's start to its end, such that neither strays from the other?
bool Tracer::runs_along_incision() {
  const Place &from = departure_, &to = excursion_.back().step.place;
  way_.assign(1, from.point);
  for (const Taken& taken : excursion_) {
    if (taken.step.passage.kind == Passage::Kind::outside) return false;
    way_.push_back(taken.step.place.point);
  }
  const auto way_is_near = [&] {
    return std::all_of(way_.begin(), way_.end(), [&](Point2 p) { return is_near(p, chain_, chord_tolerance_); });
  };
  chain_.assign(1, from.point);
  if (from.kind == Place::Kind::vertex) return find_chain(to, {}, from.vertex) && way_is_near();
  if (to.kind == Place::Kind::edge && (to.edge == from.edge || to.edge == sheet_->opposite(from.edge))) {
    chain_.push_back(to.point);
    return way_is_near();
  }
  for (HalfEdge h : {from.edge, sheet_->opposite(from.edge)}) {
    const VertexIndex end = sheet_->target(h);
    chain_.assign({from.point, sheet_->rest(end)});
    if (is_near(sheet_->rest(end), way_, chord_tolerance_) && find_chain(to, sheet_->origin(h), end) && way_is_near())
      return true;
  }
  return false;
}

/// Walks from v, not back to `before`, along incision edges near the path until `to`, and appends the vertices it
/// passes to chain_. Of several edges it takes the one that ends nearest to `to`.
bool Tracer::find_chain(const Place& to, VertexIndex before, VertexIndex v) {
  if (to.kind == Place::Kind::vertex && to.vertex == departure_.vertex) return false;
  for (std::size_t budget = 32 * way_.size() + 64; budget > 0; --budget) {
    if (to.kind == Place::Kind::vertex && to.vertex == v) return true;
    if (to.kind == Place::Kind::edge && (sheet_->origin(to.edge) == v || sheet_->target(to.edge) == v)) {
      chain_.push_back(to.point);
      return true;
    }
    VertexIndex best;
    double least = std::numeric_limits<double>::infinity();
    for (const HalfEdge h : outgoing_edges(*sheet_, v)) {
      const VertexIndex next = sheet_->target(h);
      const Point2 p = sheet_->rest(next);
      if (const double d = squared_length(to.point - p);
          sheet_->mark(h) == EdgeMark::incision && next != before && d < least && is_near(p, way_, chord_tolerance_)) {
        best = next;
        least = d;
      }
    }
    if (!best.valid()) return false;
    before = v;
    v = best;
    chain_.push_back(sheet_->rest(v));
  }
  return false;
}

}  // namespace cutbench
