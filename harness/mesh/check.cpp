#include <set>

#include "harness/base/conversions.h"
#include "harness/mesh/predicates.h"
#include "harness/mesh/sheet.h"

namespace cutbench {

namespace {

/// Collects what is wrong; one method per kind of thing.
class Checker {
 public:
  Checker(const Sheet& sheet, bool opened) : sheet_(sheet), opened_(opened) {}

  std::vector<std::string> run() {
    for (std::size_t i = 0; i < sheet_.triangle_slots(); ++i)
      if (const TriangleIndex t(i); sheet_.triangle(t).alive()) triangle(t);
    if (!problems_.empty()) return problems_;  // walking round vertices needs sound links
    for (std::size_t i = 0; i < sheet_.vertex_slots(); ++i)
      if (const VertexIndex v(i); sheet_.triangle_of_vertex(v).valid()) vertex(v);
    for (std::size_t i = 0; i < corners_met_.size(); ++i)
      if (corners_met_[i] != 3 && sheet_.triangle(TriangleIndex(i)).alive())
        say("triangle " + std::to_string(i) + " is not met when turning round its corners (bow-tie)");
    for (std::size_t d = 0; d < sheet_.deformed_slots(); ++d)
      if (sheet_.rest_vertex(DeformedIndex(d)).valid() && !used_.contains(DeformedIndex(d)))
        say("deformed vertex " + std::to_string(d) + " belongs to no triangle");
    return problems_;
  }

 private:
  void say(std::string what) { problems_.push_back(std::move(what)); }

  void triangle(TriangleIndex t) {
    const std::string name = "triangle " + std::to_string(t());
    const Triangle& record = sheet_.triangle(t);
    for (auto v : record.vertex)
      if (!v.valid() || v() >= sheet_.vertex_slots() || !sheet_.triangle_of_vertex(v).valid())
        return say(name + " has no living vertex " + std::to_string(v.value));
    for (auto d : record.deformed)
      if (!d.valid() || d() >= sheet_.deformed_slots()) return say(name + " has a corner without deformed vertex");
    const auto c = sheet_.corners(t);
    if (orientation(c[0], c[1], c[2]) <= 0) say(name + " is not positive");
    for (int k = 0; k < 3; ++k) half(half_edge(t, k), name);
  }

  void half(HalfEdge h, const std::string& name) {
    const auto k = to_size(corner_of(h));
    const Triangle& record = sheet_.triangle(triangle_of(h));
    if (sheet_.rest_vertex(record.deformed[k]) != record.vertex[k]) say(name + ": corner and deformed vertex disagree");
    if (opened_ && record.mark[k] == EdgeMark::path) say(name + " has a path edge that was not opened");
    const HalfEdge o = sheet_.opposite(h);
    if (!o.valid()) {
      if (record.mark[k] != EdgeMark::none) say(name + " has a marked border edge");
      return;
    }
    if (triangle_of(o)() >= sheet_.triangle_slots() || !sheet_.triangle(triangle_of(o)).alive())
      return say(name + " has a freed neighbour");
    if (sheet_.opposite(o) != h) say(name + " and its neighbour disagree on being neighbours");
    if (sheet_.origin(o) != sheet_.target(h) || sheet_.target(o) != sheet_.origin(h))
      say(name + ": neighbour has another edge");
    if (sheet_.mark(o) != sheet_.mark(h)) say(name + ": neighbour has another mark");
  }

  /// One deformed vertex per fan, and none shared by two fans.
  void vertex(VertexIndex v) {
    const std::string name = "vertex " + std::to_string(v());
    corners_met_.resize(sheet_.triangle_slots());
    const auto& at = sheet_.triangle(sheet_.triangle_of_vertex(v)).vertex;
    if (at[0] != v && at[1] != v && at[2] != v) return say(name + " is not in its triangle");
    auto separates = [&](HalfEdge h) {
      return sheet_.on_border(h) || sheet_.mark(h) == EdgeMark::incision ||
             (opened_ && sheet_.mark(h) == EdgeMark::path);
    };
    HalfEdge first = sheet_.first_outgoing(v), h = first;
    while (!separates(h)) {  // start a fan at a separating outgoing edge, if there is one
      h = sheet_.next_outgoing(h);
      if (h == first) break;
    }
    first = h;
    DeformedIndex fan;
    std::set<DeformedIndex> fans;
    do {
      ++corners_met_[triangle_of(h)()];
      const DeformedIndex d = sheet_.triangle(triangle_of(h)).deformed[to_size(corner_of(h))];
      used_.insert(d);
      if (h == first || separates(h)) {
        if (!fans.insert(d).second) say(name + ": two fans share deformed vertex " + std::to_string(d()));
      } else if (d != fan) {
        say(name + ": one fan has two deformed vertices");
      }
      fan = d;
      h = sheet_.next_outgoing(h);
    } while (h.valid() && h != first);
  }

  const Sheet& sheet_;
  bool opened_;
  std::vector<std::string> problems_;
  std::vector<int> corners_met_;
  std::set<DeformedIndex> used_;
};

}  // namespace

std::vector<std::string> check(const Sheet& sheet, bool opened) { return Checker(sheet, opened).run(); }

}  // namespace cutbench
