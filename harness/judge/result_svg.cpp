#include "harness/judge/result_svg.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "harness/base/conversions.h"
#include "harness/mesh/tolerances.h"

namespace cutbench {

namespace {

constexpr double side = 800, margin = 40;  // points

class Drawing {
 public:
  Drawing(Point2 low, double width) : low_(low), scale_(side / width) {}

  void line(Point2 a, Point2 b, const char* colour, double width) {
    if (!is_near(a) && !is_near(b) && !is_near(0.5 * (a + b))) return;
    char text[200];
    std::snprintf(text, sizeof text,
                  "<line x1=\"%.3f\" y1=\"%.3f\" x2=\"%.3f\" y2=\"%.3f\" stroke=\"%s\" stroke-width=\"%.1f\"/>\n", x(a),
                  y(a), x(b), y(b), colour, width);
    text_ += text;
  }
  void ring(Point2 p) {
    char text[200];
    std::snprintf(text, sizeof text,
                  "<circle cx=\"%.3f\" cy=\"%.3f\" r=\"14\" fill=\"none\" stroke=\"#d55e00\" stroke-width=\"3\"/>\n",
                  x(p), y(p));
    text_ += text;
  }
  std::string finished(const std::string& caption) const {
    const std::string size = std::to_string(to_int(side + 2 * margin));
    std::string escaped;
    for (const char c : caption) escaped += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + size + " " + size +
           "\" font-family=\"sans-serif\" font-size=\"13\">\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n" +
           text_ + "<rect y=\"0\" width=\"100%\" height=\"" + std::to_string(to_int(margin)) +
           "\" fill=\"white\"/>\n<text x=\"10\" y=\"24\">" + escaped + "</text>\n</svg>\n";
  }

 private:
  /// In the picture, or not far from it.
  bool is_near(Point2 p) const {
    return std::abs(x(p) - side / 2) < 0.8 * side && std::abs(y(p) - side / 2) < 0.8 * side;
  }
  double x(Point2 p) const { return margin + scale_ * (p.x - low_.x); }
  double y(Point2 p) const { return margin + side - scale_ * (p.y - low_.y); }

  Point2 low_;
  double scale_;
  std::string text_;
};

/// A square round the place, or round the sheet.
Drawing canvas(const Sheet& before, std::span<const Finding> findings) {
  const double h = before.mean_edge();
  if (!findings.empty() && findings.front().place) {
    const auto& [px, py] = *findings.front().place;
    return {{px - 4 * h, py - 4 * h}, 8 * h};
  }
  Point2 low{1e300, 1e300}, high{-1e300, -1e300};
  for (const Point2 p : before.to_mesh_data().rest) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  return {low, std::max(high.x - low.x, high.y - low.y)};
}

/// Its edges; a border edge has one triangle.
void draw(Drawing& drawing, const MeshData& mesh, const char* inner, const char* border, double width) {
  std::map<std::pair<std::int32_t, std::int32_t>, int> triangles_at;
  const auto count = to_int32(mesh.rest.size());
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = t[k], b = t[(k + 1) % 3];
      if (std::min(a, b) >= 0 && std::max(a, b) < count) ++triangles_at[std::minmax(a, b)];
    }
  for (const auto& [ends, triangles] : triangles_at)
    drawing.line(mesh.rest[to_size(ends.first)], mesh.rest[to_size(ends.second)], triangles == 1 ? border : inner,
                 triangles == 1 ? 2 * width : width);
}

}  // namespace

std::string result_as_svg(const Sheet& before, const MeshData& result, std::span<const Curve> cuts,
                          std::span<const Finding> findings) {
  Drawing drawing = canvas(before, findings);
  draw(drawing, before.to_mesh_data(), "#c8c8c8", "#c8c8c8", 4);
  Polyline line;
  for (const Curve& cut : cuts) {
    flatten(cut, default_flatten_tolerance * before.mean_edge(), 0, line);
    for (std::size_t i = 0; i + (line.closed ? 0 : 1) < line.points.size(); ++i)
      drawing.line(line.points[i], line.points[(i + 1) % line.points.size()], "#cc2222", 4);
  }
  draw(drawing, result, "#222222", "#0072b2", 1);
  if (!findings.empty() && findings.front().place)
    drawing.ring({(*findings.front().place)[0], (*findings.front().place)[1]});
  return drawing.finished(findings.empty() ? "grey: before, red: path, black: result, blue: open"
                                           : findings.front().cause + ": " + findings.front().text);
}

}  // namespace cutbench
