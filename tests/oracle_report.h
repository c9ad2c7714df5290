// All that the oracle says of a cut, as text. oracle_report.cpp and the oracle are compiled twice: with GMP, and with
// Boost's numbers in the namespace cutbench_boost. So nothing here is in either namespace.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace oracle_report {

struct Mesh {
  std::vector<std::array<double, 2>> rest;
  std::vector<std::array<int, 3>> triangles;
};

struct Curve {
  bool bezier, closed;
  std::vector<std::array<double, 2>> points;
};

/// As oracle::Request, and the result.
struct Cut {
  Mesh before, after;
  std::vector<Curve> curves;
  double tolerance, snap, thin, vertex_tolerance;
  bool keeps_vertices, exact_incision, keeps_area;
  double mean_edge;
};

}  // namespace oracle_report

namespace cutbench::oracle {

/// Judgement, forced corners and forced zones, numbers bit for bit.
std::string report(const oracle_report::Cut& cut);
/// Random fractions as doubles next to them on the side of zero, bit for bit; subnormal ones, too.
std::string report_of_fractions(std::size_t count);

}  // namespace cutbench::oracle
