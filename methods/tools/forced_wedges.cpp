#include "methods/tools/forced_wedges.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "harness/mesh/one_ring.h"
#include "harness/mesh/tolerances.h"

namespace cutbench {

namespace {

/// A point that goes along border, incision or path, away from a corner.
class Leg {
 public:
  Leg(const Sheet& sheet, VertexIndex apex, VertexIndex next)
      : sheet_(sheet), apex_(apex), first_(next), from_(apex), to_(next), at_(sheet.rest(apex)) {}
  Point2 at() const { return at_; }
  /// False where the leg ends before.
  bool advance(double distance) {
    for (;;) {
      const Point2 rest = sheet_.rest(to_) - at_;
      const double left = length(rest);
      if (left >= distance) {
        at_ = at_ + distance / left * rest;
        return true;
      }
      distance -= left;
      at_ = sheet_.rest(to_);
      if (!turn()) return false;
    }
  }

 private:
  /// Goes on straightest, once round at most.
  bool turn() {
    const Point2 along = sheet_.rest(to_) - sheet_.rest(from_);
    double straightest = std::sqrt(0.5);  // the cosine of 45 degrees
    VertexIndex next;
    for_each_separating_end(sheet_, to_, [&](VertexIndex v) {
      const Point2 edge = sheet_.rest(v) - sheet_.rest(to_);
      const double cosine = dot(along, edge) / (length(along) * length(edge));
      if (v != from_ && cosine > straightest) {
        straightest = cosine;
        next = v;
      }
    });
    from_ = to_;
    to_ = next;
    return next.valid() && next != first_ && next != apex_ && ++turns_ < 1000;
  }

  const Sheet& sheet_;
  VertexIndex apex_, first_, from_, to_;
  Point2 at_;
  int turns_ = 0;
};

bool lies_within(std::span<const Point2> polygon, Point2 p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point2 a = polygon[i], b = polygon[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * ((p.y - a.y) / (b.y - a.y))) inside = !inside;
  }
  return inside;
}

}  // namespace

void ForcedWedges::find(const Sheet& sheet) {
  corners_.clear();
  polygon_.clear();
  disc_ = share_ * forced_wedge_disc * sheet.mean_edge();
  for_each_sharp_corner(sheet,
                        [&](VertexIndex apex, VertexIndex right, VertexIndex left) { add(sheet, apex, right, left); });
}

/// Follows both legs equally far while they are close.
void ForcedWedges::add(const Sheet& sheet, VertexIndex apex, VertexIndex right, VertexIndex left) {
  constexpr int most_steps = 1000;
  const double step = 0.05 * sheet.mean_edge(), width = share_ * forced_wedge_width * sheet.mean_edge();
  const Point2 p = sheet.rest(apex);
  Leg along_right(sheet, apex, right), along_left(sheet, apex, left);
  Corner corner{p, {p.x - disc_, p.y - disc_}, {p.x + disc_, p.y + disc_}, polygon_.size(), 0};
  polygon_.push_back(p);
  left_.clear();
  for (int i = 0; i < most_steps && along_right.advance(step) && along_left.advance(step); ++i) {
    const Point2 r = along_right.at(), l = along_left.at();
    if (squared_length(l - r) >= width * width) break;
    polygon_.push_back(r);
    left_.push_back(l);
    corner.low = {std::min({corner.low.x, r.x, l.x}), std::min({corner.low.y, r.y, l.y})};
    corner.high = {std::max({corner.high.x, r.x, l.x}), std::max({corner.high.y, r.y, l.y})};
  }
  polygon_.insert(polygon_.end(), left_.rbegin(), left_.rend());
  corner.end = polygon_.size();
  corners_.push_back(corner);
}

bool ForcedWedges::hold(Point2 p) const {
  return std::any_of(corners_.begin(), corners_.end(), [&](const Corner& corner) {
    if (p.x < corner.low.x || p.y < corner.low.y || p.x > corner.high.x || p.y > corner.high.y) return false;
    return squared_length(p - corner.apex) < disc_ * disc_ ||
           lies_within({polygon_.data() + corner.begin, corner.end - corner.begin}, p);
  });
}

}  // namespace cutbench
