#include "harness/judge/few_digits.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <optional>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/base/errors.h"

namespace cutbench {

namespace {

using oracle::Mesh;
using oracle::Point;

double largest_coordinate(const Mesh& mesh) {
  double largest = 0;
  for (const Point& p : mesh.rest) largest = std::max({largest, std::abs(p[0]), std::abs(p[1])});
  return largest;
}

double unit_of(int digits, const Mesh& mesh) {
  return std::pow(10.0, std::floor(std::log10(largest_coordinate(mesh))) + 1 - digits);
}

double farther_coordinate(const Point& a, const Point& b) {
  return std::max(std::abs(a[0] - b[0]), std::abs(a[1] - b[1]));
}

std::string text_of(const char* format, double a, double b) {
  char text[200];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

/// The places of a sheet in square cells.
class Places {
 public:
  Places(const Mesh& mesh, double cell) : cell_(cell) {
    for (const Point& p : mesh.rest) {
      std::vector<Point>& there = places_[cell_of(p)];
      if (std::find(there.begin(), there.end(), p) == there.end()) there.push_back(p);
    }
  }

  /// The nearest place within the reach, at most a cell, in both coordinates, p itself aside.
  std::optional<Point> other_place(const Point& p, double reach) const { return nearest(p, reach, true); }
  std::optional<Point> place(const Point& p, double reach) const { return nearest(p, reach, false); }

 private:
  using Cell = std::pair<double, double>;  // whole numbers
  Cell cell_of(const Point& p) const { return {std::floor(p[0] / cell_), std::floor(p[1] / cell_)}; }

  std::optional<Point> nearest(const Point& p, double reach, bool other) const {
    std::optional<Point> found;
    const auto [column, row] = cell_of(p);
    for (const double i : {column - 1, column, column + 1})
      for (const double j : {row - 1, row, row + 1}) {
        const auto there = places_.find({i, j});
        if (there == places_.end()) continue;
        for (const Point& place : there->second) {
          if (farther_coordinate(place, p) > reach || (other && place == p)) continue;
          reach = farther_coordinate(place, p);
          found = place;
        }
      }
    return found;
  }

  double cell_;
  std::map<Cell, std::vector<Point>> places_;
};

}  // namespace

FewDigits put_back(Mesh& after, const Mesh& before, int digits) {
  FewDigits few{.digits = digits, .unit = unit_of(digits, before), .vertices = after.rest.size()};
  // Decimal units are no doubles, and neither are what is written.
  const double reach = few.unit * (1 + 1e-6);
  few.rounding = std::sqrt(2.0) * reach;
  const Places places(before, 2 * reach);
  for (const Point& p : before.rest)
    if (const auto other = places.other_place(p, 2 * reach))
      throw InputError("--digits " + std::to_string(digits) + " can't tell two vertices of the sheet apart, at " +
                       text_of("(%.17g, %.17g)", p[0], p[1]) + " and " +
                       text_of("(%.17g, %.17g)", (*other)[0], (*other)[1]) + ": more digits are needed");
  for (Point& p : after.rest) {
    const auto place = places.place(p, reach);
    if (!place) continue;
    few.farthest = std::max(few.farthest, farther_coordinate(*place, p));
    ++few.of_the_sheet;
    p = *place;
  }
  return few;
}

std::string FewDigits::text() const {
  return "read with " + std::to_string(digits) + " digits" +
         text_of(": coordinates may be off by %.1g; the vertices of the sheet were, by up to %.2g, and are put back: ",
                 unit, farthest) +
         std::to_string(of_the_sheet) + " of " + std::to_string(vertices) +
         "; the others may lie that much off the border, older incisions and the path";
}

int digits_that_allow(double off, const Mesh& before) {
  return to_int(std::floor(std::log10(largest_coordinate(before)))) + 1 - to_int(std::ceil(std::log10(off)));
}

}  // namespace cutbench
