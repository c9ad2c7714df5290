// What rest is: of texture coordinates, planes, nearly flat meshes, overlapping islands; and faces as triangles.
#include "harness/mesh/rest_choice.h"

#include <gtest/gtest.h>

#include <cmath>

#include "harness/base/conversions.h"
#include "harness/base/products_in_space.h"
#include "harness/mesh/families.h"
#include "harness/mesh/mesh_text.h"
#include "harness/mesh/overlaps.h"
#include "harness/mesh/triangulate.h"
#include "tests/mesh_checks.h"

namespace cutbench {
namespace {

/// A sheet of 2 n^2 triangles whose vt are those of the unit square, at `place` in space.
template <class Place>
MeshData placed(Place place, int n = 4) {
  MeshData mesh = make_sheet("grid", n);
  for (std::size_t v = 0; v < mesh.rest.size(); ++v) mesh.deformed[v] = place(mesh.rest[v]);
  return mesh;
}

/// Its OBJ, as another program would write it.
template <class Place>
std::string obj_of(Place place, int n = 4) {
  const std::string text = obj_text(placed(place, n));
  return text.substr(text.find('\n') + 1);
}

MeshData read(const std::string& text, const MeshReading& reading = {}) {
  MeshData mesh = read_obj(text, "m", false, reading);
  check_and_repair(mesh, "m", !mesh.rest.empty());
  expect_sound(mesh);
  return mesh;
}

bool has_note(const MeshData& mesh, const std::string& part) {
  return joined_notes(mesh).find(part) != std::string::npos;
}

TEST(RestChoice, TexturesOfFlatSheetsAreNotRest) {
  for (const Point2 scale : {Point2{0.334, 0.432}, Point2{0.9, 1.1}, Point2{0.3, 0.3}, Point2{10, 10}}) {
    const std::string text = obj_of([&](Point2 p) { return Point3{scale.x * p.x, scale.y * p.y, 0}; });
    const MeshData mesh = read(text);
    for (std::size_t v = 0; v < mesh.rest.size(); ++v)
      EXPECT_EQ(mesh.rest[v], (Point2{mesh.deformed[v].x, mesh.deformed[v].y}));
    EXPECT_TRUE(has_note(mesh, "the vt are taken for a texture")) << joined_notes(mesh);
    EXPECT_EQ(read(text, {RestFrom::vt, false}).rest, make_sheet("grid", 4).rest);
  }
  EXPECT_TRUE(has_note(read(obj_of([](Point2 p) {
                         return Point3{0.334 * p.x, 0.432 * p.y, 0};
                       })),
                       "lengths in space are 0.334 to 0.432 times those in the vt"));
}

TEST(RestChoice, SheetsAtRestAndDeformedOnesKeepTheirVt) {
  const auto flat = [](Point2 p) { return Point3{p.x, p.y, 0}; };
  const auto turned = [](Point2 p) { return Point3{0.6 * p.x - 0.8 * p.y, 0.8 * p.x + 0.6 * p.y, 0}; };
  const auto pulled = [](Point2 p) { return Point3{p.x + 0.1 * p.x * p.x, p.y * (1 - 0.05 * p.x), 0}; };
  const auto bent = [](Point2 p) { return Point3{p.x, p.y, 0.3 * std::sin(3 * p.x)}; };
  const auto large = [](Point2 p) { return Point3{9 * p.x, 7 * p.y, std::sin(p.x)}; };
  const std::vector<Point2> rest = make_sheet("grid", 4).rest;
  EXPECT_EQ(read(obj_of(flat)).rest, rest);
  EXPECT_EQ(joined_notes(read(obj_of(flat))), "");
  EXPECT_EQ(read(obj_of(turned)).rest, rest);
  EXPECT_TRUE(has_note(read(obj_of(turned)), "lengths in space are 1 times"));
  EXPECT_EQ(read(obj_of(pulled)).rest, rest);
  EXPECT_TRUE(has_note(read(obj_of(pulled)), "stretched in its plane"));
  EXPECT_EQ(read(obj_of(bent)).rest, rest);
  EXPECT_TRUE(has_note(read(obj_of(bent)), "as of a sheet that hangs: lengths in space are 1 to 1.29"))
      << joined_notes(read(obj_of(bent)));
  const auto hardly = [](Point2 p) { return Point3{p.x, p.y, 0.1 * std::sin(3 * p.x)}; };
  EXPECT_EQ(joined_notes(read(obj_of(hardly))), "");
  const MeshData texture = read_obj(obj_of(large), "m");
  EXPECT_TRUE(texture.rest.empty());
  EXPECT_TRUE(has_note(texture, "taken for a texture: lengths in space are 7 to 9"));
}

/// Of curved sheets, where no stretch is far from 1.
TEST(RestChoice, TexturesOfCurvedSheetsAreNotRest) {
  const auto rolled = [](Point2 p) { return Point3{std::cos(1.55 * p.x), 0.9 * p.y, std::sin(1.55 * p.x)}; };
  const auto larger = [](Point2 p) { return Point3{std::cos(1.3 * p.x), 1.3 * p.y, std::sin(1.3 * p.x)}; };
  const auto wavy = [](Point2 p) { return Point3{1.5 * p.x, p.y, 0.1 * std::sin(5 * p.x)}; };
  for (const std::string& text : {obj_of(rolled, 16), obj_of(larger, 16), obj_of(wavy, 16)}) {
    const MeshData mesh = read_obj(text, "m");
    EXPECT_TRUE(mesh.rest.empty());
    EXPECT_TRUE(has_note(mesh, "the vt are taken for a texture")) << joined_notes(mesh);
  }
}

/// Islands of a texture each have a scale of their own: one that is right does not speak for the others.
TEST(RestChoice, IslandsOfAnotherScaleAreATexture) {
  for (const double height : {0.0, 0.2}) {
    std::string text;
    for (const int island : {0, 1}) {
      const double scale = island == 0 ? 1 : 0.7;
      const MeshData panel = placed([&](Point2 p) { return Point3{p.x, p.y + 2 * island, height * p.x * p.x}; });
      for (const Point3& p : panel.deformed)
        text += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
      for (const Point2 p : panel.rest)
        text += "vt " + std::to_string(scale * p.x) + " " + std::to_string(scale * p.y + 2 * island) + "\n";
      const auto corner = [&](std::int32_t v) {
        const std::string number = std::to_string(v + 1 + island * to_int32(panel.rest.size()));
        return " " + number + "/" + number;
      };
      for (const auto& [a, b, c] : panel.triangles) text += "f" + corner(a) + corner(b) + corner(c) + "\n";
    }
    const MeshData mesh = read_obj(text, "m");
    EXPECT_TRUE(mesh.rest.empty());
    EXPECT_TRUE(has_note(mesh, "the vt are taken for a texture")) << joined_notes(mesh);
  }
}

TEST(RestChoice, FilesOfOurOwnSayThatVtAreRest) {
  const MeshData pulled = placed([](Point2 p) { return Point3{1.5 * p.x, p.y, 0}; });
  EXPECT_EQ(read(obj_text(pulled)).rest, pulled.rest);
  EXPECT_EQ(joined_notes(read(obj_text(pulled))), "");
  EXPECT_EQ(read(obj_text(pulled), {RestFrom::plane, false}).rest[1].x, pulled.deformed[1].x);
}

TEST(RestChoice, ThePlaneOnRequest) {
  const std::string text = obj_of([](Point2 p) { return Point3{p.x + 0.1 * p.x * p.x, 3, p.y}; });
  const MeshData mesh = read(text, {RestFrom::plane, false});
  for (std::size_t v = 0; v < mesh.rest.size(); ++v)
    EXPECT_EQ(mesh.rest[v], (Point2{mesh.deformed[v].x, mesh.deformed[v].z}));
  EXPECT_TRUE(has_note(mesh, "rest positions are the plane y = 3, with x and z as x and y"));
  expect_refused([] { read_obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "m", false, {RestFrom::vt, false}); }, "no vt");
}

TEST(RestChoice, NearlyFlat) {
  const auto wavy = [](double height) {
    MeshData mesh = make_sheet("grid", 4);
    for (Point3& p : mesh.deformed) p.z = height * std::round(p.x);
    mesh.rest.clear();
    return mesh;
  };
  MeshData mesh = wavy(1e-6);
  check_and_repair(mesh, "m");
  EXPECT_TRUE(has_note(mesh, "nearly: z varies by 1e-06, 7.07107e-07 of the mesh's size")) << joined_notes(mesh);
  EXPECT_EQ(mesh.rest, make_sheet("grid", 4).rest);
  MeshData curved = wavy(1e-3);
  expect_refused([&] { check_and_repair(curved, "m"); }, "z varies by 0.001, 0.00070710");
  MeshData unrolled = wavy(1e-4);
  take_rest(unrolled, "m", RestFrom::automatic);
  EXPECT_TRUE(has_note(unrolled, "it is not flat: z varies by 0.0001, 7.07107e-05 of the mesh's size"));
}

TEST(RestChoice, BadVtAreNamed) {
  const std::string bent = "v 0 0 0\nv 1 0 0\nv 1 1 1\nv 0 1 0\n";
  const std::string flat = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const std::string collapsed = "vt 0 0\nvt 0 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
  const std::string equal = "vt 0 0\nf 1/1 2/1 3/1\nf 1/1 3/1 4/1\n";
  for (const std::string& vt : {collapsed, equal}) {
    const MeshData dropped = read_obj(bent + vt, "m");
    EXPECT_TRUE(dropped.rest.empty());
    EXPECT_TRUE(has_note(dropped, "some triangles have no area in the vt"));
    expect_refused(
        [&] {
          read(bent + vt, {RestFrom::vt, false});
        },
        "triangle 1 of 2 has zero area in its vt, which are taken as rest");
    expect_refused([&] { read(bent + vt, {RestFrom::vt, false}); }, "give --rest space");
    expect_refused([&] { read(flat + vt, {RestFrom::vt, false}); }, "give --rest plane");
    EXPECT_EQ(read(flat + vt).rest[2], (Point2{1, 1}));
    EXPECT_EQ(error_of([&] { read(bent + vt, {RestFrom::vt, false}); }).find("delete"), std::string::npos);
  }
}

/// Two squares of 2 n^2 triangles, the second moved, in one mesh.
MeshData two_squares(Point2 by, double scale, int n) {
  MeshData mesh = make_sheet("grid", n);
  const MeshData other = make_sheet("grid", n);
  const std::int32_t first = to_int32(mesh.rest.size());
  for (const Point2 p : other.rest) mesh.rest.push_back(by + scale * p);
  for (const Point2 p : other.rest) mesh.deformed.push_back({p.x, p.y, 0.1});
  for (const auto& [a, b, c] : other.triangles) mesh.triangles.push_back({a + first, b + first, c + first});
  return mesh;
}

TEST(RestChoice, OverlappingIslandsAreFound) {
  for (int n : {1, 2, 5}) {
    for (const auto& [by, scale] : std::vector<std::pair<Point2, double>>{{{0.3371, 0.2113}, 1},
                                                                          {{0.5, 0}, 1},
                                                                          {{0.91, 0.93}, 1},
                                                                          {{0.41, 0.43}, 0.01},
                                                                          {{0.5, 0.5}, 0.25},
                                                                          {{-1, -1}, 3},
                                                                          {{0, 0}, 0.5}}) {
      MeshData mesh = two_squares(by, scale, n);
      EXPECT_TRUE(find_overlap(mesh).has_value()) << n << ' ' << by.x << ' ' << by.y << ' ' << scale;
      expect_refused([&] { check_and_repair(mesh, "m", true); }, "vt, which are taken as rest positions");
    }
    for (const auto& [by, scale] : std::vector<std::pair<Point2, double>>{
             {{1, 0}, 1}, {{1, 0.3}, 1}, {{1, 1}, 1}, {{2, 0}, 1}, {{1 - 1e-14, 0.3}, 1}, {{1, 0.2}, 0.5}}) {
      const MeshData mesh = two_squares(by, scale, n);
      EXPECT_FALSE(find_overlap(mesh).has_value()) << n << ' ' << by.x << ' ' << by.y << ' ' << scale;
    }
  }
}

/// Every pair of triangles, against the search along borders.
TEST(RestChoice, OverlapsAsByAllPairs) {
  const MeshData unit = make_sheet("delaunay", 3);
  for (int i = 0; i < 60; ++i) {
    const double angle = 0.37 * i;
    MeshData mesh = two_squares({1.3 * std::cos(angle), 1.3 * std::sin(angle)}, 1, 3);
    const Point2 d = mesh.rest[unit.rest.size()];
    const bool overlap = std::abs(d.x) < 1 && std::abs(d.y) < 1;
    EXPECT_EQ(find_overlap(mesh).has_value(), overlap) << i;
  }
}

double area(const std::vector<Point3>& p, const std::array<std::size_t, 3>& t) {
  const Point3 a = p[t[1]] + -1.0 * p[t[0]], b = p[t[2]] + -1.0 * p[t[0]];
  return length(cross(a, b)) / 2;
}

TEST(Triangulate, ShorterDiagonalAndEars) {
  using Triangles = std::vector<std::array<std::size_t, 3>>;
  EXPECT_EQ(triangulate({{0, 0, 0}, {3, 0, 0}, {2, 1, 0}, {0, 1, 0}}).size(), 2u);
  const auto kite = triangulate({{0, 0, 0}, {2, -0.5, 0}, {4, 0, 0}, {2, 0.5, 0}});
  for (const auto& t : kite) {
    EXPECT_TRUE(std::ranges::count(t, 1u) == 1 && std::ranges::count(t, 3u) == 1);
  }
  // A dart: only the diagonal from its reflex corner lies inside.
  const auto dart = triangulate({{0, 0, 0}, {2, -1, 0}, {0.5, 0, 0}, {2, 1, 0}});
  ASSERT_EQ(dart.size(), 2u);
  for (const auto& t : dart) EXPECT_TRUE(std::ranges::count(t, 0u) == 1 && std::ranges::count(t, 2u) == 1);
  EXPECT_EQ(triangulate({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}), Triangles{});  // crosses itself
  EXPECT_EQ(triangulate({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}), Triangles{});  // no area
  EXPECT_EQ(triangulate({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}}).size(), 2u);    // a corner on a side
  for (std::size_t n : {5u, 8u, 31u}) {                                               // stars, upright and tilted
    std::vector<Point3> star;
    for (std::size_t i = 0; i < 2 * n; ++i) {
      const double r = i % 2 ? 0.4 : 1, angle = 3.141592653589793 * to_double(i) / to_double(n);
      star.push_back({r * std::cos(angle), 0.6 * r * std::sin(angle), 0.8 * r * std::sin(angle)});
    }
    const auto triangles = triangulate(star);
    ASSERT_EQ(triangles.size(), 2 * n - 2);
    double sum = 0;
    for (const auto& t : triangles) sum += area(star, t);
    EXPECT_NEAR(sum, to_double(n) * 0.4 * std::sin(3.141592653589793 / to_double(n)), 1e-12);
  }
}

TEST(Triangulate, PolygonsInFilesOnRequest) {
  const std::string v = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 0 1 0\n";
  const std::string obj = v + "o a\nf 1 2 5 6\no b\nf 2 3 4 5\n";
  expect_refused([&] { read(obj); },
                 "line 8: a face with 4 corners; only triangles are read: triangulate the mesh, or");
  const MeshData mesh = read(obj, {RestFrom::automatic, true});
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_TRUE(has_note(mesh, "faces triangulated: 2 of 2"));
  EXPECT_EQ(read("f 1 2 3 4 5 6\n" + v, {RestFrom::automatic, true}).triangles.size(), 4u);
  expect_refused([&] { read(v + "f 1 2 3 9\n", {RestFrom::automatic, true}); }, "line 7: a corner beyond the 6 v");
  const std::string off = "OFF\n6 2 0\n0 0 0\n1 0 0\n2 0 0\n2 1 0\n1 1 0\n0 1 0\n4 0 1 4 5\n4 1 2 3 4\n";
  EXPECT_EQ(read_off(off, "m", true).triangles.size(), 4u);
  expect_refused([&] { read_off(off, "m"); }, "give --triangulate");
}

TEST(MeshDialects, AreRead) {
  const std::string body = "0 0 0\n1 0 0\n0 1 0\n3 0 1 2";
  for (const std::string head : {"OFF\n3 1\n", "OFF 3 1\n", "OFF\n# made by hand\n\n3 1 # counts\n", "OFF\r\n3 1\r\n"})
    EXPECT_EQ(read_off(head + body, "m").triangles.size(), 1u) << head;
  const MeshData obj = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1/1 2/2/1 3/3/1");
  EXPECT_EQ(obj.rest[2], (Point2{0, 1}));
  for (const std::string index : {"ushort", "short", "uint16", "int16", "uchar", "int", "uint"})
    for (const std::string count : {"uchar", "ushort", "int16", "uint"}) {
      const std::string ply =
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
          "property float z\nelement face 1\nproperty list " +
          count + " " + index + " vertex_indices\nend_header\n" + body;
      const MeshData mesh = read_ply(ply, "m");
      ASSERT_EQ(mesh.triangles.size(), 1u) << count << ' ' << index;
      EXPECT_EQ(mesh.triangles[0], (std::array<std::int32_t, 3>{0, 1, 2}));
      EXPECT_EQ(mesh.deformed[1], (Point3{1, 0, 0}));
    }
}

}  // namespace
}  // namespace cutbench
