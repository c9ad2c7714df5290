// Picks on the deformed sheet, carried to rest space. The oracle is the way there: a rest point in a triangle whose
// deformed corners are known is somewhere in space, and picked there it must come back.
#include "harness/path/pick.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/cut/cut.h"
#include "harness/files/mesh_file.h"
#include "harness/files/path_file.h"
#include "harness/mesh/families.h"
#include "harness/scenes/scene_file.h"
#include "harness/simulation/simulation.h"
#include "methods/registry.h"
#include "tests/mesh_checks.h"
#include "tests/program.h"

namespace cutbench {
namespace {

/// A sheet that is bent, stretched and turned: a piece of a helicoid.
Sheet helicoid(const std::string& family) {
  Sheet sheet(make_sheet(family, 10));
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d) {
    const Point2 p = sheet.rest(sheet.rest_vertex(DeformedIndex(d)));
    const double turn = 2.2 * p.x, radius = 0.3 + 0.8 * p.y;
    sheet.set_position(DeformedIndex(d), {radius * std::cos(turn), radius * std::sin(turn), 0.7 * p.x});
  }
  return sheet;
}

struct Place {
  Point2 rest;
  Point3 world, normal;
};

std::vector<Place> places(const Sheet& sheet) {
  std::vector<Place> result;
  std::uint64_t state = 7;
  const auto random = [&] { return to_double((state = state * 6364136223846793005u + 1) >> 11) * 0x1p-53; };
  for (std::size_t i = 0; i < sheet.triangle_slots(); ++i) {
    const TriangleIndex t{i};
    double u = random(), v = random();
    if (u + v > 1) {
      u = 1 - u;
      v = 1 - v;
    }
    const auto [a, b, c] = sheet.corners(t);
    const auto x = [&](std::size_t k) { return sheet.position(sheet.triangle(t).deformed[k]); };
    const Point3 p = x(1) + -1.0 * x(0), q = x(2) + -1.0 * x(0);
    result.push_back({(1 - u - v) * a + u * b + v * c,
                      (1 - u - v) * x(0) + u * x(1) + v * x(2),
                      {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x}});
  }
  return result;
}

double distance(Point2 a, Point2 b) { return std::sqrt(squared_length(a - b)); }

TEST(Pick, BadOnesAreRefused) {
  constexpr auto polyline = Curve::Kind::polyline, bezier = Curve::Kind::bezier;
  const auto expect_refused = [](const PickedCurve& curve, const std::string& what) {
    try {
      check_picks(curve, "it");
      ADD_FAILURE() << "not refused: " << what;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  };
  const Pick origin{{0, 0, 0}, {}}, one{{1, 0, 0}, {}}, lost{{0, std::nan(""), 0}, {}};
  expect_refused({polyline, false, {origin, lost}}, "it, point 1: coordinates must be finite and below 1e60");
  expect_refused({polyline, false, {{{0, 0, 0}, Point3{0, 1e61, 0}}, one}}, "it, point 0: coordinates");
  expect_refused({polyline, false, {{{0, 0, 0}, Point3{0, 0, 0}}, one}}, "it, point 0: the direction is zero");
  expect_refused({bezier, true, {origin, one, one, one}}, "must end where it began");
  EXPECT_NO_THROW(check_picks({bezier, true, {origin, one, one, origin}}, "it"));
}

/// It lies in the plane of whole triangles: the nearest point of these counts.
TEST(Pick, ARayInThePlaneOfTheSheetFindsItsBorder) {
  const Sheet sheet(make_sheet("delaunay", 6));
  const Picker picker(sheet);
  for (const double y : {0.13, 0.5, 0.87})
    for (const double side : {0.0, 1.0}) {
      const Point3 from{3 * side - 1, y, 0}, along{1 - 2 * side, 0, 0};
      EXPECT_LE(distance(picker.rest_point({from, along}, "p"), {side, y}), 1e-12);
    }
}

TEST(Pick, ToSpaceAndBackIsToRounding) {
  for (const char* family : {"grid", "delaunay", "graded"}) {
    const Sheet sheet = helicoid(family);
    const Picker picker(sheet);
    for (const Place& at : places(sheet)) {
      EXPECT_LE(distance(picker.rest_point({at.world, {}}, "p"), at.rest), 1e-12 * sheet.size());
      // From a little in front of it, slantwise: nothing else is in between.
      const Point3 along = at.normal + Point3{0.2 * at.normal.y, -0.1 * at.normal.z, 0.3 * at.normal.x};
      for (const double sign : {1.0, -1.0})
        EXPECT_LE(distance(picker.rest_point({at.world + sign * along, -0.3 * sign * along}, "p"), at.rest),
                  1e-12 * sheet.size());
    }
  }
}

TEST(Pick, ARayStopsAtTheFirstLayer) {
  Sheet sheet(make_sheet("grid", 4));  // folded along x = 0.5: above x lies 1 - x
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d) {
    const Point2 p = sheet.rest(sheet.rest_vertex(DeformedIndex(d)));
    sheet.set_position(DeformedIndex(d), p.x <= 0.5 ? Point3{p.x, p.y, 0} : Point3{1 - p.x, p.y, 0.4 * (p.x - 0.5)});
  }
  const Picker picker(sheet);
  EXPECT_LE(distance(picker.rest_point({{0.2, 0.6, 3}, Point3{0, 0, -2}}, "p"), {0.8, 0.6}), 1e-15);
  EXPECT_LE(distance(picker.rest_point({{0.2, 0.6, -3}, Point3{0, 0, 1e-3}}, "p"), {0.2, 0.6}), 1e-15);
}

std::string error_of_pick(const Picker& picker, const Pick& pick) {
  try {
    picker.rest_point(pick, "here");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Pick, AMissSaysByHowFar) {
  const Sheet sheet(make_sheet("grid", 4));
  const Picker picker(sheet);
  const auto begins = [](const std::string& text, const std::string& start) { return text.rfind(start, 0) == 0; };
  EXPECT_PRED2(begins, error_of_pick(picker, {{0.5, 0.5, 0.25}, {}}), "here: the point misses the sheet by 0.25 m ");
  EXPECT_PRED2(begins, error_of_pick(picker, {{1.125, 0.5, 3}, Point3{0, 0, -1}}),
               "here: the ray misses the sheet by 0.125 m; ");
  EXPECT_PRED2(begins, error_of_pick(picker, {{0.5, 0.5, 2}, Point3{0, 0, 1}}),
               "here: the ray misses the sheet by 2 m; ");
  EXPECT_EQ(error_of_pick(picker, {{0.5, 0.5, 1e-7}, {}}), "");  // what six digits leave
}

TEST(Pick, ACrumpledSheetIsNotPicked) {
  Sheet sheet(make_sheet("grid", 2));
  for (std::size_t d = 0; d < sheet.deformed_slots(); ++d) sheet.set_position(DeformedIndex(d), {to_double(d), 0, 0});
  EXPECT_EQ(error_of_pick(Picker(sheet), {{0, 0, 0}, {}}), "here: the sheet is crumpled to lines; pick earlier");
}

/// The scene's own words: a sheet that a pin moves by (0.3, 0.2, 0.1) in the first step, and then at 0.6 m/s along x.
class PickedScene : public Program {
 protected:
  Scene scene(const std::string& cut) {
    write(folder_ / "s.toml", R"(
effect = "e"
truth = "t"
duration = 0.1
[sheet]
resolution = 200
[[pins]]
box = [[-inf, -inf], [inf, inf]]
displacement = [0.3, 0.2, 0.1]
velocity = [0.6, 0, 0]
[integrator]
step = 0.01
)" + cut);
    return read_scene(folder_ / "s.toml");
  }
};

TEST_F(PickedScene, CutsWhereTheSheetIsThen) {
  const auto method = find_method("conventional_split").make(0);
  std::vector<MeshData> results;
  for (const std::string cut : {R"([[cuts]]
time = 0.05
space = "world"
bezier = [{origin = [0.53, 0.3, 9], direction = [0, 0, -1]}, [0.73, 0.9, 0.1], [0.93, 0.3, 0.1], [1.13, 0.5, 0.1]])",
                                R"([[cuts]]
time = 0.05
bezier = [[0.2, 0.1], [0.4, 0.7], [0.6, 0.1], [0.8, 0.3]])"}) {
    const auto motion = Simulation::start(scene(cut));
    ASSERT_EQ(motion->advance(0.1, *method, {}).verdict, Verdict::ok);
    results.push_back(motion->posed_sheet().to_mesh_data());
    EXPECT_EQ(motion->made_cuts().at(0).pick_us > 0, results.size() == 1);
  }
  ASSERT_EQ(results[0].triangles, results[1].triangles);
  EXPECT_GT(results[0].triangles.size(), 200u);
  for (std::size_t v = 0; v < results[0].rest.size(); ++v)
    EXPECT_LE(distance(results[0].rest[v], results[1].rest[v]), 1e-12);
}

TEST_F(PickedScene, AMissEndsItInOneLine) {
  scene(R"([[cuts]]
time = 0.05
space = "world"
polyline = [[0.73, 0.5, 0.1], {origin = [5.33, 0.5, 1], direction = [0, 0, -3]}])");
  const auto result = run("simulate s.toml");
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.error, "s, cut 0, point 1: the ray misses the sheet by 4 m; aim at where the sheet then is\n");

  // Nor does it leave frames: none at all where there were none, and those of a whole run as they were.
  const auto files_before = files();
  EXPECT_EQ(run("simulate s.toml --frames f --every 1").code, 2);
  EXPECT_EQ(files(), files_before);
  scene("");
  ASSERT_EQ(run("simulate s.toml --frames f --every 1").code, 0);
  const auto whole = files();
  const std::string series = read(folder_ / "f/frames.pvd"), frame = read(folder_ / "f/frame_0003.vtu");
  scene("[[cuts]]\ntime = 0.05\nspace = \"world\"\npolyline = [[9, 0, 0], [9, 1, 0]]\n");
  EXPECT_EQ(run("simulate s.toml --frames f --every 2").code, 2);
  EXPECT_EQ(files(), whole);
  EXPECT_EQ(read(folder_ / "f/frames.pvd"), series);
  EXPECT_EQ(read(folder_ / "f/frame_0003.vtu"), frame);
}

TEST_F(PickedScene, APathFileMayBeInWorldSpace) {
  write(folder_ / "bent.obj",  // half of the unit square, raised along y = 1; vt: rest
        "v 0 0 0\nv 1 0 0\nv 1 0.6 0.8\nv 0 0.6 0.8\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
  write(folder_ / "world.json", R"({"cuts": [{"space": "world", "polyline":
    [[0.2, 0.06, 0.08], {"origin": [0.9, 0.42, 5], "direction": [0, 0, -1]}]}]})");
  write(folder_ / "rest.json", R"({"cuts": [{"space": "rest", "polyline": [[0.2, 0.1], [0.9, 0.7]]}]})");
  const std::string cut = "cut --mesh bent.obj --method conventional_split --path ";
  ASSERT_EQ(run(cut + "rest.json --out a.obj").code, 0);
  const auto result = run(cut + "world.json --out b.obj --report b.json");
  ASSERT_EQ(result.code, 0) << result.error;
  const MeshData a = read_mesh(folder_ / "a.obj"), b = read_mesh(folder_ / "b.obj");
  ASSERT_EQ(a.triangles, b.triangles);
  for (std::size_t v = 0; v < a.rest.size(); ++v) EXPECT_LE(distance(a.rest[v], b.rest[v]), 1e-12);
  EXPECT_EQ(read(folder_ / "b.json").find("\"pick\": 0,"), std::string::npos);

  write(folder_ / "miss.json", R"({"cuts": [{"space": "world", "polyline": [[0.2, 0.06, 0.08], [0.9, 0.42, 5]]}]})");
  const auto miss = run(cut + "miss.json --out c.obj");
  EXPECT_EQ(miss.code, 2);
  EXPECT_EQ(miss.error.rfind("miss.json, cut 0, point 1: the point misses the sheet by ", 0), 0u) << miss.error;
  EXPECT_FALSE(fs::exists(folder_ / "c.obj"));
  for (const char* made : {"a.obj", "b.obj"}) {
    const auto scored = run(std::string("score --mesh bent.obj --path world.json --result ") + made);
    EXPECT_EQ(scored.code, 0) << scored.out << scored.error;
  }
  const auto wrong = run("score --mesh bent.obj --path world.json --result bent.obj");
  EXPECT_EQ(wrong.code, 1) << wrong.error;
  try {
    read_path(folder_ / "world.json");
    ADD_FAILURE() << "not refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("is in world space, which needs a sheet"), std::string::npos)
        << error.what();
  }
}

/// Picks with the digits of a file lie a little inside of a border that runs askew, or outside; the sheet falls in two.
TEST(Pick, EndsAtTheBorderReachIt) {
  MeshData mesh = make_sheet("delaunay", 8);
  for (Point2& p : mesh.rest) p = {0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y};
  for (std::size_t v = 0; v < mesh.rest.size(); ++v) mesh.deformed[v] = {mesh.rest[v].x, 0.1, mesh.rest[v].y};
  const Sheet sheet(mesh);
  for (int i = 1; i < 20; ++i) {
    PickedCurve cut{Curve::Kind::polyline, false, {}};
    for (const Point2 p : {Point2{0.05 * i, 0}, Point2{1 - 0.047 * i, 1}}) {
      const auto digits = [](double c) { return std::round(1e6 * c) / 1e6; };
      cut.picks.push_back({{digits(0.8 * p.x - 0.6 * p.y), 0.1, digits(0.6 * p.x + 0.8 * p.y)}, {}});
    }
    Sheet after = sheet;
    Locator locator(after);
    Cutter cutter;
    const auto method = find_method("conventional_split").make(0);
    for (const Curve& curve : Picker(sheet).rest_curves(cut, "it")) cutter.cut(after, locator, curve, *method, {});
    const auto pieces = pieces_of(after.to_mesh_data());
    EXPECT_EQ(*std::max_element(pieces.begin(), pieces.end()), 1) << i;
  }
}

}  // namespace
}  // namespace cutbench
