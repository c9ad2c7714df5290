#include "harness/scenes/scene_file_cuts.h"

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/files/path_file.h"

namespace cutbench {

void exclude(const TomlReader& reader, const char* present, std::initializer_list<const char*> others) {
  for (const char* key : others)
    if (reader.has(key)) reader.refuse(std::string("\"") + key + "\" does not go with " + present + "; leave it out");
}

Point3 read_place(const TomlReader& reader, const toml::array* numbers, const std::string& what) {
  Point3 p;
  if (numbers == nullptr || numbers->size() != 3) reader.refuse(what + " is [x, y, z]");
  for (std::size_t i = 0; i < 3; ++i) {
    const auto x = (*numbers)[i].value<double>();
    if (!x) reader.refuse(what + " is [x, y, z], three numbers");
    (i == 0 ? p.x : i == 1 ? p.y : p.z) = *x;
  }
  return p;
}

namespace {

PickedCurve read_picks(const TomlReader& reader, const char* key) {
  exclude(reader, "a curve", {"seed", "case"});
  PickedCurve curve{key == std::string("bezier") ? Curve::Kind::bezier : Curve::Kind::polyline,
                    reader.value<bool>("closed", false),
                    {}};
  for (const auto& node : reader.array(key)) {
    const std::string point = "point " + std::to_string(curve.picks.size());
    const toml::table* ray = node.as_table();
    if (ray == nullptr) {
      curve.picks.push_back({read_place(reader, node.as_array(), point + " in world space"), {}});
      continue;
    }
    check_keys(*ray, {"origin", "direction"}, reader.where + ", " + point);
    curve.picks.push_back({read_place(reader, (*ray)["origin"].as_array(), point + ": \"origin\""),
                           read_place(reader, (*ray)["direction"].as_array(), point + ": \"direction\"")});
  }
  check_picks(curve, reader.where);
  return curve;
}

Curve read_curve(const TomlReader& reader, bool bezier) {
  exclude(reader, "a curve", {"seed", "case"});
  const Curve curve{bezier ? Curve::Kind::bezier : Curve::Kind::polyline, reader.value<bool>("closed", false),
                    reader.points(bezier ? "bezier" : "polyline")};
  check_curve(curve, reader.where);
  return curve;
}

Scene::Cut read_cut(const TomlReader& reader) {
  const bool bezier = reader.has("bezier"), polyline = reader.has("polyline"), seeded = reader.has("family");
  if (bezier + polyline + seeded != 1) reader.refuse("give either \"bezier\", \"polyline\", \"path\" or \"family\"");
  Scene::Cut cut;
  cut.time = reader.positive_or_zero("time", 0);
  if (!seeded) {
    if (reader.has("speed")) cut.speed = reader.positive("speed", 0);
    constexpr EnumNames<bool, 2> spaces{{{false, "rest"}, {true, "world"}}};
    const bool world = reader.choice<bool>("space", false, spaces);
    if (world) cut.picked = read_picks(reader, bezier ? "bezier" : "polyline");
    if (!world) cut.curve = read_curve(reader, bezier);
    return cut;
  }
  exclude(reader, "\"family\"", {"closed", "space", "speed"});
  cut.family = reader.value<std::string>("family");
  check_names({cut.family}, cut_families(), reader.where + ": cut family");
  cut.seed = static_cast<std::uint64_t>(reader.value<std::int64_t>("seed", 1));
  const auto index = reader.value<std::int64_t>("case", 0);
  if (index < 0) reader.refuse("\"case\" must be positive, or 0");
  cut.index = to_size(index);
  return cut;
}

/// Those of a path file, whose lengths are in the unit of the sheet's file.
std::vector<Scene::Cut> read_cuts_of_path(const TomlReader& reader, const std::filesystem::path& folder, double scale) {
  exclude(reader, "\"path\"", {"space", "bezier", "polyline", "closed", "family", "seed", "case"});
  std::vector<Scene::Cut> cuts;
  for (const auto& curve : read_path_with_picks(folder / reader.value<std::string>("path"))) {
    Scene::Cut& cut = cuts.emplace_back();
    cut.time = reader.positive_or_zero("time", 0);
    if (reader.has("speed")) cut.speed = reader.positive("speed", 0);
    if (const auto* rest = std::get_if<Curve>(&curve)) cut.curve = *rest;
    if (const auto* picked = std::get_if<PickedCurve>(&curve)) cut.picked = *picked;
    for (Point2& p : cut.curve.points) p = scale * p;
    for (Pick& pick : cut.picked.picks) pick.origin = scale * pick.origin;
  }
  return cuts;
}

}  // namespace

std::vector<Scene::Cut> read_cuts(const TomlReader& file, const std::filesystem::path& folder, double scale) {
  std::vector<Scene::Cut> cuts;
  for (const auto& cut : file.sections(
           "cuts", "cut", {"time", "speed", "space", "path", "bezier", "polyline", "closed", "family", "seed", "case"}))
    if (!cut.has("path"))
      cuts.push_back(read_cut(cut));
    else
      for (const Scene::Cut& of_file : read_cuts_of_path(cut, folder, scale)) cuts.push_back(of_file);
  return cuts;
}

}  // namespace cutbench
