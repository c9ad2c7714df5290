#include "harness/path/path_text.h"

#include <array>
#include <nlohmann/json.hpp>
#include <utility>

#include "harness/base/errors.h"
#include "harness/base/json_reader.h"

namespace cutbench {

namespace {

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

AnyCurve read_curve(const json& entry, const std::string& where) {
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

std::vector<Curve> read_path_text(const std::string& text, const std::string& name) {
  std::vector<Curve> cuts;
  for (auto& cut : read_path_text_with_picks(text, name)) {
    if (!std::holds_alternative<Curve>(cut))
      throw InputError(name + ", cut " + std::to_string(cuts.size()) +
                       ": is in world space, which needs a sheet to be picked on (`cutbench cut`, `cutbench score`); "
                       "give it in rest space");
    cuts.push_back(std::get<Curve>(std::move(cut)));
  }
  return cuts;
}

std::vector<AnyCurve> read_path_text_with_picks(const std::string& text, const std::string& name) {
  const json document = parse_json(text, {name, "a path file", R"({"cuts": [{"polyline": [[x, y], ...]}]})"});
  if (document.is_object() && document.contains("space"))
    throw InputError(name + R"(: "space" belongs to each cut, {"cuts": [{"space": "world", "polyline": [...]}]})");
  check_keys(document, {"cuts"}, name);
  if (!document.contains("cuts") || !document["cuts"].is_array())
    throw InputError(name + R"(: "cuts" must be a list, [{"polyline": [[x, y], ...]}])");
  std::vector<AnyCurve> cuts;
  for (const json& entry : document["cuts"])
    cuts.push_back(read_curve(entry, name + ", cut " + std::to_string(cuts.size())));
  if (cuts.empty()) throw InputError(name + ": \"cuts\" is empty; give at least one");
  return cuts;
}

std::string path_text(const std::vector<Curve>& cuts) {
  json document{{"cuts", json::array()}};
  for (const Curve& curve : cuts) {
    json points = json::array();
    for (Point2 p : curve.points) points.push_back({p.x, p.y});
    json entry{{curve.kind == Curve::Kind::bezier ? "bezier" : "polyline", points}};
    if (curve.closed) entry["closed"] = true;
    document["cuts"].push_back(entry);
  }
  return document.dump() + '\n';
}

}  // namespace cutbench
