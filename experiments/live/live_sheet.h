// A sheet in motion that is cut, pulled and poked between two steps: what the page and the C API hold. Text in and out
// is JSON, as docs/reference/browser.md describes it.
#pragma once

#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "harness/cut/cut.h"
#include "harness/cut/method_row.h"
#include "harness/fem/time/stepper.h"
#include "harness/simulation/moving_sheet.h"
#include "harness/simulation/scene_cuts.h"

namespace cutbench::live {

enum class Colour { none, aspect_ratio, strain, piece };

class LiveSheet {
 public:
  static constexpr std::size_t floats_per_triangle = 15;  ///< of draw(): per corner x, y, z, value, edges

  explicit LiveSheet(const Scene& scene);
  LiveSheet(const LiveSheet&) = delete;
  LiveSheet& operator=(const LiveSheet&) = delete;

  /// At most so many; stops at the first that fails, and never makes another. Returns how many it made.
  int step(int steps);
  /// Cuts one curve after the other. \param parameter  of the method; NaN: its default
  nlohmann::json cut(const std::string& method, double parameter, const std::vector<Curve>& curves);
  /// Back to right before the last cut, but for at most `most_saved` of them. False: there is none.
  bool undo();

  /// Where a ray meets the sheet, at rest. \throw InputError  a miss
  Point2 pick(Point3 origin, Point3 direction) const;
  /// Takes hold of what lies within `radius` of a place at rest, on the piece that is there. \throw InputError
  void grab(Point2 rest, double radius);
  /// m: from the next step on, what is held is drawn to where the grabbed place would lie here.
  void drag(Point3 to) { to_ = to; }
  void release();
  /// m/s, added to the velocity within `radius` of a place at rest, less and less towards the rim.
  void poke(Point2 rest, double radius, Point3 velocity);
  /// Where a place at rest is now, m.
  Point3 place(Point2 rest) const;

  /// Triangles of their own. Value: of the colour. Edges: 0 plain, 1 within a polygon, 2 lip, 3 border, for the edges
  /// from the corners 0, 1, 2, as sum of 4^k times that.
  const std::vector<float>& draw(Colour colour, bool at_rest);
  nlohmann::json numbers() const;
  MeshData mesh() const { return now_.posed().to_mesh_data(); }
  const Sheet& sheet() const { return now_.sheet; }
  std::span<const double> positions() const { return {now_.state.x.data(), to_size(now_.state.x.size())}; }
  std::span<const double> velocities() const { return {now_.state.v.data(), to_size(now_.state.v.size())}; }
  const std::string& fault() const { return fault_; }

 private:
  static constexpr std::size_t most_saved = 4;
  struct Near {
    std::size_t vertex;  // of the opened sheet
    double weight;       // 1 at the place, 0 at the radius
    Point3 offset;       // m, from the place
  };
  TriangleIndex holder_of(Point2 rest) const;
  std::vector<Near> near(Point2 rest, double radius) const;
  void pull();
  bool is_in_polygon(HalfEdge h) const;
  int edges_of(TriangleIndex t) const;
  std::array<Point3, 3> corners_in_space(TriangleIndex t) const;

  Scene scene_;
  MovingSheet<3> now_;
  SceneCuts<3> cuts_;
  Stepper<3> stepper_;
  Cutter cutter_;
  std::string method_name_;
  std::unique_ptr<CuttingMethod> method_;
  std::vector<std::unique_ptr<MovingSheet<3>>> saved_;
  std::vector<Near> grabbed_;
  Point3 to_{};
  std::vector<double> force_;
  std::vector<float> soup_;
  std::string fault_;
  std::size_t triangles_before_;
};

}  // namespace cutbench::live
