// Public inputs of constrained triangulations, collected from their bug reports and test suites, as cuts: every segment
// one, made one after the other in a sheet that covers them all.

#include <gtest/gtest.h>

#include <fstream>

#include "harness/mesh/families.h"
#include "methods/registry.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

const std::filesystem::path folder = CUTBENCH_TEST_CASES "/pslg";

/// `nV nE`, then `x y` lines, then `a b` lines (from 0).
std::vector<Curve> read_segments(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::size_t points = 0, edges = 0;
  in >> points >> edges;
  std::vector<Point2> point(points);
  for (Point2& p : point) in >> p.x >> p.y;
  std::vector<Curve> segments(edges);
  for (Curve& s : segments) {
    std::size_t a = 0, b = 0;
    in >> a >> b;
    s = {Curve::Kind::polyline, false, {point.at(a), point.at(b)}};
  }
  EXPECT_TRUE(in) << path;
  return segments;
}

/// 8 x 8 squares over the segments, with a tenth of the longer side to spare.
MeshData sheet_over(const std::vector<Curve>& segments) {
  Point2 low{infinite, infinite}, high{-infinite, -infinite};
  for (const Curve& s : segments)
    for (Point2 p : s.points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
  const double margin = 0.1 * std::max(high.x - low.x, high.y - low.y);
  MeshData mesh = make_sheet("grid", 8);
  for (std::size_t v = 0; v < mesh.rest.size(); ++v) {
    Point2& p = mesh.rest[v];
    p = {low.x - margin + (high.x - low.x + 2 * margin) * p.x, low.y - margin + (high.y - low.y + 2 * margin) * p.y};
    mesh.deformed[v] = {p.x, p.y, 0};
  }
  return mesh;
}

class Pslg : public testing::TestWithParam<std::string> {};

TEST_P(Pslg, SegmentsAreCut) {
  const std::vector<Curve> segments = read_segments(folder / (GetParam() + ".pslg"));
  const MeshData mesh = sheet_over(segments);
  for (const MethodRow& method : all_methods()) {
    Table table(mesh, method, method.parameter.value);
    for (std::size_t i = 0; i < segments.size(); ++i)
      ASSERT_EQ(table.cut(segments[i], 0.05), "") << method.name << ", segment " << i << ": " << text_of(segments[i]);
  }
}

INSTANTIATE_TEST_SUITE_P(Files, Pslg, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const auto& entry : std::filesystem::directory_iterator(folder))
                             names.push_back(entry.path().stem());
                           std::sort(names.begin(), names.end());
                           return names;
                         }()),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           for (char& c : name)
                             if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                           return name;
                         });

}  // namespace
}  // namespace cutbench
