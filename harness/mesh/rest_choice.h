// What the rest positions of a mesh are: its texture coordinates (`vt`), the plane it lies in, or its own shape in
// space.
//
// `vt` are rest positions in some files and a texture in others; nothing in a file says which. What is known is how
// much longer things are in space than in the `vt`: the two principal stretches of each triangle. The rule of
// RestFrom::automatic, where a file does not say it itself (mesh_text.h):
//   - All stretches are 1 within `isometry_tolerance`: the `vt`; of a flat mesh the sheet itself, perhaps turned.
//   - A part of the mesh is stretched alike in all its triangles: a texture. That is how one is laid onto a sheet; what
//     is held or pulled hardly ever stretches so evenly.
//   - In a part of a mesh that is not flat every triangle has a strain over `unstrained`: a texture. A sheet that hangs
//     has a place near its free border that is hardly stretched.
//   - Else the `vt`, where all stretches lie within `largest_stretch`.
// Without the `vt`, rest is the plane, or where the mesh is not flat its own shape (unroll.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "harness/base/enum_names.h"
#include "harness/mesh/mesh_data.h"

namespace cutbench {

enum class RestFrom { automatic, vt, plane, space };
constexpr EnumNames<RestFrom, 4> rest_names{
    {{RestFrom::automatic, "auto"}, {RestFrom::vt, "vt"}, {RestFrom::plane, "plane"}, {RestFrom::space, "space"}}};

/// Stretches nearer to 1, or to each other, than this are the same: files have coordinates of four digits and more.
constexpr double isometry_tolerance = 1e-3;
/// A sheet that is pulled may be twice as long as at rest, or half; beyond that, hardly any is still one.
constexpr double largest_stretch = 2;
/// A sheet that hangs has a place with less strain than this.
constexpr double unstrained = 0.1;
/// Where a sheet that is not flat has more strain than this, a note says that the `vt` were taken.
constexpr double worth_a_word = 0.25;
/// Of fewer triangles nothing is said by their stretches alone: a piece that was cut off may be one triangle.
constexpr std::size_t fewest_of_a_part = 8;
/// In sizes of the mesh (the diagonal of its box): a mesh this near to a plane is flat. Exporters write six digits.
constexpr double flatness_tolerance = 1e-6;

/// How a mesh file is read.
struct MeshReading {
  RestFrom rest = RestFrom::automatic;
  bool triangulate = false;        ///< faces of more than three corners
  std::optional<double> sew = {};  ///< as far apart in space at most, vertices are sewn together (sew.h)
};

/// The singular values of the map from a rest triangle to the deformed one; infinite or NaN where the rest triangle has
/// no area.
struct Stretch {
  double largest, smallest;
  double strain() const;  ///< the largest |stretch - 1|
};
Stretch stretch_of(const std::array<Point2, 3>& rest, const std::array<Point3, 3>& deformed);
Stretch stretch_of(const MeshData& mesh, const std::array<std::int32_t, 3>& triangle);

/// The least and the largest stretch of a mesh, of triangles that can be measured.
struct Stretches {
  double least, most;
  bool measured = true;  ///< no triangle has corners out of range, coordinates that aren't finite, or no rest area
  bool even = true;      ///< the two are the same in all triangles, within isometry_tolerance
  bool isometric() const;
  std::string text() const;  ///< "0.33 to 0.43 times"
};
Stretches stretches_of(const MeshData& mesh);

/// The plane x, y or z = constant that a mesh lies in. An exact one goes before others, z before y before x.
struct FlatPlane {
  char normal;                            ///< 'x', 'y' or 'z'
  double at;                              ///< the constant, of the vertex that comes first
  double deviation, size;                 ///< the largest difference of that coordinate; the diagonal of the mesh's box
  bool flat() const;                      ///< the deviation is at most flatness_tolerance sizes
  std::array<char, 2> axes() const;       ///< that are x and y at rest: x, y or x, z or y, z
  Point2 rest_of(const Point3& p) const;  ///< in these axes
  std::string text() const;               ///< "the plane y = 0, with x and z as x and y"
};
/// The flattest of the three. Corners out of range and coordinates that aren't finite are left out.
FlatPlane plane_of(const MeshData& mesh);

/// What the rule says of a mesh whose `rest` are its `vt`.
struct RestDecision {
  bool vt;           ///< else the plane, or where it is not flat its own shape
  std::string note;  ///< what was taken and why; empty where there is nothing to say
};
RestDecision decide_rest(const MeshData& mesh);

}  // namespace cutbench
