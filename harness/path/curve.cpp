#include "harness/path/curve.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "harness/base/errors.h"
#include "harness/base/json_reader.h"
#include "harness/files/whole_file.h"
#include "harness/path/pick.h"

namespace cutbench {

namespace {

Point2 bezier_point(const Point2* p, double t) {
  const double s = 1 - t;
  return s * s * s * p[0] + 3 * s * s * t * p[1] + 3 * s * t * t * p[2] + t * t * t * p[3];
}

/// Where in [a, b] a cubic is slowest: at the far end of a sharp return.
double slowest_between(const Point2* p, double a, double b) {
  const auto speed2 = [p](double t) {
    const double s = 1 - t;
    return squared_length(s * s * (p[1] - p[0]) + 2 * s * t * (p[2] - p[1]) + t * t * (p[3] - p[2]));
  };
  for (int i = 0; i < 100; ++i) {
    const double u = a + (b - a) / 3, v = b - (b - a) / 3;
    (speed2(u) < speed2(v) ? b : a) = speed2(u) < speed2(v) ? v : u;
  }
  return a + (b - a) / 2;
}

/// Two Beziers meet at `joint` with the tangents' directions more than 0.06 degrees apart.
bool is_kink(Point2 before, Point2 joint, Point2 after) {
  const Point2 in = joint - before, out = after - joint;
  return dot(in, out) <= 0 || std::abs(cross(in, out)) > 1e-3 * dot(in, out);
}

void add(Polyline& out, Point2 p, bool kept, double snap) {
  if (!out.points.empty() && within(p, out.points.back(), snap)) {
    out.kept.back() |= static_cast<std::uint8_t>(kept);
    return;
  }
  out.points.push_back(p);
  out.kept.push_back(kept);
}

void flatten_bezier(const Curve& curve, double tolerance, double snap, Polyline& out) {
  const auto& c = curve.points;
  const std::size_t n = c.size();
  for (std::size_t i = 0; i + 3 < n; i += 3) {
    const Point2* p = &c[i];
    const double bend = std::max(squared_length(p[0] - 2 * p[1] + p[2]), squared_length(p[1] - 2 * p[2] + p[3]));
    // A curve that is small itself keeps its shape.
    const double size2 =
        std::max({squared_length(p[1] - p[0]), squared_length(p[2] - p[0]), squared_length(p[3] - p[0])});
    const double finest = std::min(tolerance, 0.01 * std::sqrt(size2));
    const double steps = bend > 0 ? std::clamp(std::ceil(std::sqrt(0.75 * std::sqrt(bend) / finest)), 1.0, 1e6) : 1;
    const bool tip = i == 0 && !curve.closed;
    const bool kink = i == 0 ? is_kink(c[n - 2], c[0], c[1]) : is_kink(c[i - 1], c[i], c[i + 1]);
    add(out, p[0], tip || kink, snap);
    Point2 before = p[0] - (p[1] - p[0]), from = p[0], to = bezier_point(p, 1 / steps);
    for (double k = 1; k <= steps; ++k) {
      const Point2 after = k < steps ? bezier_point(p, (k + 1) / steps) : p[3] + (p[3] - p[2]);
      // A sharp return goes all its way, though a chord that cuts it off strays by less than the tolerance.
      if (dot(from - before, after - to) < 0)
        add(out, bezier_point(p, slowest_between(p, (k - 1) / steps, k / steps)), false, snap);
      if (k < steps) add(out, to, false, snap);
      before = from, from = to, to = after;
    }
  }
  if (!curve.closed) add(out, c.back(), true, snap);
}

using nlohmann::json;

void check_keys(const json& object, std::initializer_list<const char*> known, const std::string& where) {
  if (!object.is_object()) throw InputError(where + ": must be an object, {...}, not " + object.type_name());
  for (const auto& [key, value] : object.items()) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    std::string list;
    for (const char* k : known) list += std::string(list.empty() ? "\"" : ", \"") + k + "\"";
    throw InputError(where + ": unknown key \"" + key + "\"; " +
                     (known.size() == 1 ? "the only one is " : "known are ") + list);
  }
}

/// `shape` says how the list is written; it is part of the error.
template <std::size_t N>
std::array<double, N> read_numbers(const json& list, const std::string& where, const char* shape) {
  std::array<double, N> numbers{};
  bool good = list.is_array() && list.size() == N;
  for (std::size_t i = 0; good && i < N; ++i)
    if ((good = list[i].is_number())) numbers[i] = list[i].get<double>();
  if (!good) throw InputError(where + ": " + shape);
  return numbers;
}

Pick read_pick(const json& p, const std::string& where) {
  const auto point = [](const json& list, const std::string& place, const char* shape) {
    const auto [x, y, z] = read_numbers<3>(list, place, shape);
    return Point3{x, y, z};
  };
  if (!p.is_object())
    return {
        point(p, where, "a point in world space is [x, y, z], or {\"origin\": [x, y, z], \"direction\": [x, y, z]}"),
        {}};
  check_keys(p, {"origin", "direction"}, where);
  for (const char* key : {"origin", "direction"})
    if (!p.contains(key)) throw InputError(where + ": \"" + key + "\" is missing");
  return {point(p["origin"], where, "\"origin\" is [x, y, z], three numbers"),
          point(p["direction"], where, "\"direction\" is [x, y, z], three numbers")};
}

std::variant<Curve, PickedCurve> read_curve(const json& entry, const std::string& where) {
  check_keys(entry, {"bezier", "polyline", "closed", "space"}, where);
  const bool bezier = entry.contains("bezier");
  if (bezier == entry.contains("polyline")) throw InputError(where + ": give either \"bezier\" or \"polyline\"");
  const auto kind = bezier ? Curve::Kind::bezier : Curve::Kind::polyline;
  bool closed = false;
  if (entry.contains("closed")) {
    if (!entry["closed"].is_boolean()) throw InputError(where + ": \"closed\" must be true or false");
    closed = entry["closed"].get<bool>();
  }
  const bool world = entry.contains("space") && entry["space"] == "world";
  if (entry.contains("space") && !world && entry["space"] != "rest")
    throw InputError(where + ": \"space\" must be \"rest\" or \"world\"");
  const json& points = entry[bezier ? "bezier" : "polyline"];
  if (!points.is_array()) throw InputError(where + ": must be a list of points, [[x, y], ...]");
  Curve curve{kind, closed, {}};
  PickedCurve picked{kind, closed, {}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string place = where + ", point " + std::to_string(i);
    if (world) {
      picked.picks.push_back(read_pick(points[i], place));
    } else {
      const auto [x, y] = read_numbers<2>(points[i], place, "a point is [x, y], two numbers");
      curve.points.push_back({x, y});
    }
  }
  if (world) {
    check_picks(picked, where);
    return picked;
  }
  check_curve(curve, where);
  return curve;
}

}  // namespace

void flatten(const Curve& curve, double tolerance, double snap, Polyline& out) {
  out.points.clear(), out.kept.clear();
  out.closed = curve.closed, out.curved = curve.kind == Curve::Kind::bezier;
  if (curve.kind == Curve::Kind::bezier)
    flatten_bezier(curve, tolerance, snap, out);
  else
    for (Point2 p : curve.points) add(out, p, true, snap);
  if (!out.closed || out.points.size() < 2) return;
  if (within(out.points.back(), out.points.front(), snap))  // the closing step has a length, too
    out.points.pop_back(), out.kept.pop_back();
}

void check_curve(const Curve& curve, const std::string& name) {
  const std::size_t n = curve.points.size();
  const bool bezier = curve.kind == Curve::Kind::bezier;
  if (bezier && (n < 4 || n % 3 != 1))
    throw InputError(name + ": a chain of cubic Beziers has 4, 7, 10, ... points, this one has " + std::to_string(n));
  if (!bezier && n < (curve.closed ? 3u : 2u))
    throw InputError(name + ": a polyline needs at least " + (curve.closed ? "3 points when closed" : "2 points") +
                     ", this one has " + std::to_string(n));
  for (std::size_t i = 0; i < n; ++i)
    for (double c : {curve.points[i].x, curve.points[i].y})
      if (!std::isfinite(c) || std::abs(c) > 1e60)
        throw InputError(name + ", point " + std::to_string(i) + ": coordinates must be finite and below 1e60");
  if (bezier && curve.closed && curve.points.front() != curve.points.back())
    throw InputError(name + ": a closed Bezier must end where it began; repeat its first point at the end");
}

std::vector<Curve> read_path(const std::filesystem::path& file) {
  std::vector<Curve> cuts;
  for (auto& cut : read_path_with_picks(file)) {
    if (!std::holds_alternative<Curve>(cut))
      throw InputError(file.string() + ", cut " + std::to_string(cuts.size()) +
                       ": is in world space, which only `cutbench cut` takes; give it in rest space");
    cuts.push_back(std::get<Curve>(std::move(cut)));
  }
  return cuts;
}

std::vector<std::variant<Curve, PickedCurve>> read_path_with_picks(const std::filesystem::path& file) {
  const std::string name = file.string();
  const json document = parse_json(text_of(file), {name, "a path file", R"({"cuts": [{"polyline": [[x, y], ...]}]})"});
  if (document.is_object() && document.contains("space"))
    throw InputError(name + R"(: "space" belongs to each cut, {"cuts": [{"space": "world", "polyline": [...]}]})");
  check_keys(document, {"cuts"}, name);
  if (!document.contains("cuts") || !document["cuts"].is_array())
    throw InputError(name + R"(: "cuts" must be a list, [{"polyline": [[x, y], ...]}])");
  std::vector<std::variant<Curve, PickedCurve>> cuts;
  for (const json& entry : document["cuts"])
    cuts.push_back(read_curve(entry, name + ", cut " + std::to_string(cuts.size())));
  if (cuts.empty()) throw InputError(name + ": \"cuts\" is empty; give at least one");
  return cuts;
}

void write_path(const std::vector<Curve>& cuts, const std::filesystem::path& file) {
  json document{{"cuts", json::array()}};
  for (const Curve& curve : cuts) {
    json points = json::array();
    for (Point2 p : curve.points) points.push_back({p.x, p.y});
    json entry{{curve.kind == Curve::Kind::bezier ? "bezier" : "polyline", points}};
    if (curve.closed) entry["closed"] = true;
    document["cuts"].push_back(entry);
  }
  WholeFile(file, document.dump() + '\n').place();
}

}  // namespace cutbench
