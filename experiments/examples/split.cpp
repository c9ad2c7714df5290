// split.py once more, as a C++ program that needs nothing of this project: every crossed edge gets a vertex, which
// divides the triangles beside it; edges on the path are opened.
// Build it anywhere: g++ -O2 -std=c++20 split.cpp -o split
// usage: split mesh.obj path.json out.obj
#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

constexpr double near_path = 1e-10;  // rest units: nearer than this, a vertex lies on the path

using Point = std::array<double, 2>;
using Triangle = std::array<int, 3>;
using Edge = std::pair<int, int>;

double distance(const Point& a, const Point& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }
Point between(const Point& a, const Point& b, double t) { return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])}; }

/// How far p lies to the left of the line from a to b; 0 where it is near.
double beside(const Point& a, const Point& b, const Point& p) {
  const double cross = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]), d = cross / distance(a, b);
  return std::abs(d) > near_path ? d : 0;
}

class Sheet {
 public:
  explicit Sheet(const std::string& file) {
    std::ifstream in(file);
    std::vector<Triangle> read;
    std::vector<Point> flat;  // the rest positions of a sheet without `vt`
    std::string line, word;
    while (std::getline(in, line)) {
      std::istringstream words(line);
      words >> word;
      if (word == "v" || word == "vt") {
        Point& p = (word == "v" ? flat : rest_).emplace_back();
        words >> p[0] >> p[1];
      } else if (word == "f") {
        Triangle& t = read.emplace_back();
        for (int& v : t) words >> word, v = std::stoi(word) - 1;  // up to the first `/`
      }
    }
    if (rest_.empty()) rest_ = flat;
    add(read);
  }

  double mean_edge() const {
    double sum = 0;
    for (const auto& [edge, triangle] : left_of_) sum += distance(rest_[edge.first], rest_[edge.second]);
    return sum / static_cast<double>(left_of_.size());
  }

  /// Divides the edges that the straight piece from p to q crosses, and puts the edges along it on the path.
  void embed(const Point& p, const Point& q) {
    insert(p);
    insert(q);
    std::vector<std::pair<Edge, Point>> crossed;
    for (const auto& [edge, triangle] : left_of_) {
      Point a = rest_[edge.first], b = rest_[edge.second];
      if (b < a) std::swap(a, b);  // so that both lips of an older incision get the very same place
      const double left = beside(p, q, a), right = beside(p, q, b);
      if (left * right < 0 && beside(a, b, p) * beside(a, b, q) < 0)
        crossed.emplace_back(edge, between(a, b, left / (left - right)));
    }
    for (const auto& [edge, place] : crossed)
      if (left_of_.contains(edge)) divide_edge(edge, place);
    const Point middle = between(p, q, 0.5);
    const auto is_on = [&](int v) {
      return beside(p, q, rest_[v]) == 0 && distance(rest_[v], middle) <= distance(p, q) / 2 + near_path;
    };
    for (const auto& [edge, triangle] : left_of_)
      if (is_on(edge.first) && is_on(edge.second)) path_.insert({edge, {edge.second, edge.first}});
  }

  /// A slit of one edge, whose ends could not part, gets a vertex in its middle.
  void divide_lone_edges() {
    std::map<int, int> edges_at;
    for (const auto& [a, b] : path_) ++edges_at[a];
    for (const auto& [a, b] : std::set<Edge>(path_))
      if (a < b && edges_at[a] == 1 && edges_at[b] == 1 && left_of_.contains({a, b}) && left_of_.contains({b, a}))
        divide_edge({a, b}, between(rest_[a], rest_[b], 0.5));
  }

  /// Every fan of triangles between edges of the path gets a vertex of its own.
  void write_opened(const std::string& file) {
    std::set<int> on_path;
    for (const auto& [a, b] : path_) on_path.insert(a);
    std::map<int, std::set<Triangle>> stars;
    for (const Triangle& t : triangles_)
      for (const int v : t)
        if (on_path.contains(v)) stars[v].insert(t);
    std::map<std::pair<Triangle, int>, int> number;
    for (auto& [v, star] : stars)
      for (int mine = v; !star.empty();) {
        std::vector<Triangle> fan{*star.begin()};
        star.erase(star.begin());
        for (std::size_t i = 0; i < fan.size(); ++i) {
          number[{fan[i], v}] = mine;
          for (std::size_t k = 0; k < 3; ++k) {
            const Edge edge{fan[i][(k + 1) % 3], fan[i][k]};
            const auto other = left_of_.find(edge);
            if (path_.contains(edge) || other == left_of_.end() || star.erase(other->second) == 0) continue;
            fan.push_back(other->second);
          }
        }
        if (star.empty()) break;
        mine = static_cast<int>(rest_.size());
        rest_.push_back(Point(rest_[v]));
      }
    std::FILE* out = std::fopen(file.c_str(), "w");
    if (out == nullptr) std::exit(1);
    for (const Point& p : rest_) std::fprintf(out, "v %.17g %.17g 0\n", p[0], p[1]);
    for (const Triangle& t : triangles_) {
      Triangle c = t;
      for (int& v : c)
        if (const auto found = number.find({t, v}); found != number.end()) v = found->second;
      std::fprintf(out, "f %d %d %d\n", c[0] + 1, c[1] + 1, c[2] + 1);
    }
    std::fclose(out);
  }

 private:
  void add(const std::vector<Triangle>& triangles) {
    for (const Triangle& t : triangles) {
      triangles_.insert(t);
      for (std::size_t k = 0; k < 3; ++k) left_of_[{t[k], t[(k + 1) % 3]}] = t;
    }
  }

  void divide_edge(Edge edge, const Point& p) {
    const int v = static_cast<int>(rest_.size());
    rest_.push_back(p);
    for (const auto& [tail, head] : {edge, Edge{edge.second, edge.first}}) {
      const auto found = left_of_.find({tail, head});
      if (found == left_of_.end()) continue;
      const Triangle t = found->second;
      left_of_.erase(found);
      triangles_.erase(t);
      const int apex = t[0] + t[1] + t[2] - tail - head;
      add({{tail, v, apex}, {v, head, apex}});
    }
    if (path_.contains(edge)) path_.insert({{edge.first, v}, {v, edge.first}, {edge.second, v}, {v, edge.second}});
  }

  /// Makes p a vertex, where it lies in the sheet; on each lip where it lies on an older incision.
  void insert(const Point& p) {
    for (const Triangle& t : std::vector<Triangle>(triangles_.begin(), triangles_.end())) {
      std::array<double, 3> side{};
      for (std::size_t k = 0; k < 3; ++k) side[k] = beside(rest_[t[k]], rest_[t[(k + 1) % 3]], p);
      const auto on = static_cast<std::size_t>(std::find(side.begin(), side.end(), 0) - side.begin());
      if (*std::min_element(side.begin(), side.end()) < 0 || !triangles_.contains(t)) continue;
      if (std::count(side.begin(), side.end(), 0) == 1) {
        divide_edge({t[on], t[(on + 1) % 3]}, p);
      } else if (on == 3) {
        const int v = static_cast<int>(rest_.size());
        rest_.push_back(p);
        triangles_.erase(t);
        add({{t[0], t[1], v}, {t[1], t[2], v}, {t[2], t[0], v}});
      }
    }
  }

  std::vector<Point> rest_;
  std::set<Triangle> triangles_;
  std::map<Edge, Triangle> left_of_;  // the triangle on the left of each edge, from vertex to vertex
  std::set<Edge> path_;
};

/// The one cut of a path file that cutbench wrote, as a polyline: each Bezier in as many equal steps as Wang's formula
/// asks for.
std::vector<Point> read_polyline(const std::string& file, double tolerance) {
  std::ifstream in(file);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  std::vector<Point> points;
  for (std::size_t i = text.find("[[", text.find("\"cuts\"") + 8); i < text.size() && points.size() < 1000000;) {
    i = text.find_first_of("-0123456789", i);
    Point& p = points.emplace_back();
    if (std::sscanf(text.c_str() + i, "%lf,%lf", &p[0], &p[1]) != 2) std::exit(1);
    i = text.find(']', i);
    if (text[i + 1] == ']') break;
  }
  if (text.find("\"bezier\"") == std::string::npos) {
    if (text.find("\"closed\":true") != std::string::npos) points.push_back(Point(points.front()));
    return points;
  }
  std::vector<Point> line{points.front()};
  for (std::size_t i = 0; i + 3 < points.size(); i += 3) {
    double bend = 0;
    for (std::size_t j = i; j < i + 2; ++j)
      bend = std::max(bend, 2 * distance(points[j + 1], between(points[j], points[j + 2], 0.5)));
    const int steps = std::max(3, static_cast<int>(std::ceil(std::sqrt(0.75 * bend / tolerance))));
    for (int k = 1; k <= steps; ++k) {
      const double t = static_cast<double>(k) / steps, s = 1 - t;
      Point& p = line.emplace_back();
      for (std::size_t c = 0; c < 2; ++c)
        p[c] = s * s * s * points[i][c] + 3 * s * s * t * points[i + 1][c] + 3 * s * t * t * points[i + 2][c] +
               t * t * t * points[i + 3][c];
    }
    line.back() = points[i + 3];
  }
  return line;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) return std::fprintf(stderr, "usage: split mesh.obj path.json out.obj [time.json]\n"), 1;
  Sheet sheet(argv[1]);
  const auto start = std::chrono::steady_clock::now();
  const std::vector<Point> line = read_polyline(argv[2], 0.03 * sheet.mean_edge());
  for (std::size_t i = 0; i + 1 < line.size(); ++i) sheet.embed(line[i], line[i + 1]);
  sheet.divide_lone_edges();
  sheet.write_opened(argv[3]);
  const double us = std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count();
  if (argc > 4) std::ofstream(argv[4]) << "{\"us\": " << us << "}\n";
  return 0;
}
