// A sheet as files and generators know it: opened, plain arrays, no connectivity.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "harness/base/errors.h"
#include "harness/mesh/types.h"

namespace cutbench {

/// An opened sheet. One entry of `rest` and `deformed` per deformed vertex: the two lips of an incision are
/// different vertices with bit-equal rest positions.
struct MeshData {
  std::vector<Point2> rest;                            ///< per vertex, rest position
  std::vector<Point3> deformed;                        ///< per vertex, deformed position
  std::vector<std::array<std::int32_t, 3>> triangles;  ///< counter-clockwise in rest space
  std::vector<std::int32_t> file_vertices;             ///< per vertex, its number in the file; empty: its own number
  std::vector<std::string> notes;                      ///< repairs made while reading, one line each
  /// Per vertex: the number of one of those that are one point of the sheet with it, though apart at rest
  /// (harness/mesh/seams.h), the same for all of them. Empty: none are.
  std::vector<std::int32_t> sewn = {};
  /// Per triangle: 1 where its part of the file runs clockwise at rest (harness/mesh/winding.h). Empty: none does.
  std::vector<std::uint8_t> clockwise = {};
  bool unrolled = false;  ///< rest positions are no coordinates that a user knows (harness/mesh/unroll.h)
};

}  // namespace cutbench
