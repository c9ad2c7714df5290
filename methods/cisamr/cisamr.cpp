#include "methods/cisamr/cisamr.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

/// The legs' length of half a square along the axes; 0 for any other triangle.
double side_of_square(const std::array<Point2, 3>& c) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Point2 a = c[(k + 1) % 3] - c[k], b = c[(k + 2) % 3] - c[k];
    const double side = std::max(std::abs(a.x), std::abs(a.y)), slack = 1e-9 * side;
    const bool along_axes =
        std::min(std::abs(a.x), std::abs(a.y)) <= slack && std::min(std::abs(b.x), std::abs(b.y)) <= slack;
    if (along_axes && std::abs(dot(a, b)) <= slack * side && std::abs(squared_length(b) - side * side) <= slack * side)
      return side;
  }
  return 0;
}

}  // namespace

std::optional<std::string> Cisamr::why_unsupported(const Sheet& sheet) const {
  std::vector<double> sides;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    if (sheet.triangle(TriangleIndex(t)).alive()) sides.push_back(side_of_square(sheet.corners(TriangleIndex(t))));
  const auto half = sides.begin() + to_index(sides.size() / 2);
  std::nth_element(sides.begin(), half, sides.end());
  const auto equal = std::count_if(sides.begin(), sides.end(),
                                   [side = *half](double s) { return s > 0 && std::abs(s - side) <= 1e-9 * side; });
  if (2 * to_size(equal) >= sides.size()) return {};
  return "the sheet is no structured grid: less than half of its triangles are halves of equal squares along the axes";
}

void Cisamr::adapt(Sheet& sheet, Subdivision& trace, const Polyline& path) {
  curve_.read(sheet, trace, path);
  warp_.run(sheet, trace, curve_);
}

void Cisamr::embed(Sheet& sheet, Subdivision& trace, MethodNotes& notes) {
  CuttingMethod::embed(sheet, trace, notes);
  curve_.find_vertices(sheet, trace);
}

void Cisamr::improve(Sheet& sheet, MethodNotes&) {
  reshape_.begin(sheet, curve_);
  reshape_.flip_and_smooth(false);
}

}  // namespace cutbench
