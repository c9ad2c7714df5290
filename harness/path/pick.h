// A cut placed on the deformed sheet, as a surgeon places it. Its control points are picked on the sheet as it is at
// that moment. Each is carried to rest space by its barycentric coordinates in its deformed triangle, and the curve is
// built in rest space (Xin et al. 2018, 4.1.1).
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "harness/mesh/sheet.h"
#include "harness/path/curve.h"
#include "harness/path/route.h"

namespace cutbench {

/// A point in space that lies on the sheet, or a ray: the point where it first meets the sheet.
struct Pick {
  Point3 origin;                    ///< m
  std::optional<Point3> direction;  ///< of any length but 0; none: `origin` itself is the point
};

/// A curve whose points are yet to be found.
struct PickedCurve {
  Curve::Kind kind = Curve::Kind::bezier;
  bool closed = false;
  std::vector<Pick> picks;  ///< as many as Curve::points would have
};

using AnyCurve = std::variant<Curve, PickedCurve>;

/// The deformed sheet of one moment, to which it refers, in CGAL's tree of bounding boxes. Cost: the whole mesh, once.
class Picker {
 public:
  /// How far from the sheet a point may be, in mean rest edges: what is written with six digits is still found.
  static constexpr double tolerance = 1e-3;
  static constexpr double flatness = 0.05;

  explicit Picker(const Sheet& posed);
  ~Picker();
  Picker(const Picker&) = delete;
  Picker& operator=(const Picker&) = delete;

  /// Where in rest space the picked point is. A ray that runs within a triangle's plane meets it where it enters.
  /// Throws InputError, beginning with `name`: a miss, with its distance.
  Point2 rest_point(const Pick& pick, const std::string& name) const;
  /// The curve in rest space. An end that is no farther from the border than `tolerance` is put onto it: else a cut to
  /// the border would leave a bridge as wide as the last digit of a file. Where the curve crosses seams, one for each
  /// stretch between two of them (route.h). A Bezier that crosses one would be another curve on each side: it is taken
  /// as the curve in space of its picked points, and from there to the nearest places of the sheet, in chords of
  /// `flatness` mean edges.
  /// \param along  where given, gets the seams that the curve would run along, where a cut opens nothing
  /// Throws InputError, beginning with `name` and the number of the point: a miss, no way over the seams, and a way
  /// along one without `along`.
  std::vector<Curve> rest_curves(const PickedCurve& curve, const std::string& name,
                                 std::vector<HalfEdge>* along = nullptr) const;

 private:
  PlaceAtRest place(const Pick& pick, const std::string& name) const;
  void add_border(const Sheet& posed);
  PlaceAtRest on_border_if_near(const PlaceAtRest& place) const;
  std::vector<PlaceAtRest> flattened(const std::vector<PlaceAtRest>& control_points) const;

  struct Tree;
  std::unique_ptr<Tree> tree_;
  double mean_edge_;  // m
};

struct CurvesAtRest {
  std::vector<Curve> curves;
  std::vector<std::size_t> cut;  ///< per curve: the number of the cut that it is a part of
};

/// All of them in rest space. Nothing moves between them, so all picks are made on the same sheet.
/// \param along  as of Picker::rest_curves()
/// Throws InputError, beginning with `name` and the number of the cut: as Picker::rest_curves(), and places at rest of
/// a sheet that is unrolled, where they mean nothing.
CurvesAtRest curves_at_rest(std::span<const AnyCurve> path, const Sheet& posed, const std::string& name,
                            std::vector<HalfEdge>* along = nullptr);

/// Throws InputError: too few points for the kind, a closed Bezier that doesn't end where it began, no direction, or a
/// number that is not finite or beyond 1e60. `name` says where the curve comes from.
void check_picks(const PickedCurve& curve, const std::string& name);

}  // namespace cutbench
