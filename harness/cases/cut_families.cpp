#include "harness/cases/cut_families.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "harness/base/errors.h"
#include "harness/base/random.h"
#include "harness/cases/cut_generator.h"

namespace cutbench {

namespace {

struct Family {
  const char* name;
  Curves (Generator::*make)();
};
constexpr Family family_table[] = {
    {"straight", &Generator::straight},       {"curved", &Generator::curved},
    {"partial", &Generator::partial},         {"border_inward", &Generator::border_inward},
    {"cut_out", &Generator::cut_out},         {"recut", &Generator::recut},
    {"several", &Generator::several},         {"self_crossing", &Generator::self_crossing},
    {"tiny_loop", &Generator::tiny_loop},     {"tiny_open", &Generator::tiny_open},
    {"u_turn", &Generator::u_turn},           {"through_vertices", &Generator::through_vertices},
    {"along_edges", &Generator::along_edges},
};

}  // namespace

SheetExtent extent_of(const Sheet& sheet) {
  SheetExtent extent{{1e300, 1e300}, {-1e300, -1e300}, sheet.mean_edge()};
  for (std::size_t i = 0; i < sheet.vertex_slots(); ++i) {
    if (!sheet.triangle_of_vertex(VertexIndex(i)).valid()) continue;
    const Point2 p = sheet.rest(VertexIndex(i));
    extent.low = {std::min(extent.low.x, p.x), std::min(extent.low.y, p.y)};
    extent.high = {std::max(extent.high.x, p.x), std::max(extent.high.y, p.y)};
  }
  return extent;
}

std::span<const char* const> cut_families() {
  static const auto names = [] {
    std::array<const char*, std::size(family_table)> result{};
    std::transform(std::begin(family_table), std::end(family_table), result.begin(),
                   [](const Family& f) { return f.name; });
    return result;
  }();
  return names;
}

std::vector<Curve> make_case(const std::string& family, std::uint64_t seed, std::size_t i, const Sheet& sheet) {
  std::string known;
  for (const Family& f : family_table) {
    known += (known.empty() ? "" : ", ") + std::string(f.name);
    if (f.name != family) continue;
    std::uint64_t key = Random(seed).bits();
    for (char c : family) key = (key ^ static_cast<unsigned char>(c)) * 0x100000001B3u;
    Generator generator(sheet, Random(key).bits() + i * 0xD1342543DE82EF95u, i);
    return (generator.*f.make)();
  }
  throw InputError("cut family '" + family + "' is unknown; choose one of " + known);
}

Curve make_small_cut(std::uint64_t seed, std::size_t i, const Sheet& sheet) {
  constexpr const char* kinds[] = {"straight", "curved", "partial", "border_inward", "cut_out", "self_crossing"};
  Random random(Random(seed).bits() + i * 0xD1342543DE82EF95u);
  Curve curve = make_case(kinds[random.below(std::size(kinds))], seed, i, sheet).front();
  const auto [low, high, h] = extent_of(sheet);
  Point2 least = curve.points.front(), most = least;
  for (Point2 p : curve.points) {
    least = {std::min(least.x, p.x), std::min(least.y, p.y)};
    most = {std::max(most.x, p.x), std::max(most.y, p.y)};
  }
  const double side = std::max(high.x - low.x, high.y - low.y);
  const double factor = random.between(0.1, 0.3) * side / std::max(most.x - least.x, most.y - least.y);
  const double u = random.unit(), v = random.unit();
  const Point2 centre{low.x + u * (high.x - low.x), low.y + v * (high.y - low.y)};
  const Point2 middle = 0.5 * (least + most);
  for (Point2& p : curve.points) p = centre + factor * (p - middle);
  if (curve.closed && curve.kind == Curve::Kind::bezier) curve.points.back() = curve.points.front();
  return curve;
}

}  // namespace cutbench
