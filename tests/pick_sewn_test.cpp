// Picks on sheets with seams, and sewing.
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "harness/base/conversions.h"
#include "harness/files/mesh_file.h"
#include "harness/files/path_file.h"
#include "harness/mesh/families.h"
#include "harness/mesh/mesh_text.h"
#include "harness/mesh/sew.h"
#include "harness/path/pick.h"
#include "tests/mesh_checks.h"
#include "tests/program.h"
#include "tests/sewn_sheets.h"

namespace cutbench {
namespace {

using SewnFiles = Program;

/// A strip of squares of 1 m along x, sewn in space of panels that lie `gap` apart at rest; the vertices of each square
/// are its own. Rolled up to a tube, the last square meets the first.
MeshData sewn_strip(int squares, int per_panel, double gap, bool rolled) {
  MeshData mesh;
  const double radius = to_double(squares) / (2 * std::acos(-1.0));
  for (int i = 0; i < squares; ++i) {
    const auto first = to_int32(mesh.rest.size());
    for (const auto& [x, y] : {std::pair{i, 0}, std::pair{i + 1, 0}, std::pair{i + 1, 1}, std::pair{i, 1}}) {
      const double turn = to_double(x % squares) / radius;
      mesh.rest.push_back({x + gap * (i / per_panel), to_double(y)});
      mesh.deformed.push_back(rolled ? Point3{radius * std::cos(turn), radius * std::sin(turn), to_double(y)}
                                     : Point3{to_double(x), to_double(y), 0});
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
  return mesh;
}

/// Where vertices of one panel have equal rest positions they are one; where they have equal positions they are sewn.
Sheet sheet_of(const MeshData& mesh, bool is_sewn = true) {
  MeshData joined;
  std::map<std::pair<double, double>, std::int32_t> number;
  for (auto triangle : mesh.triangles) {
    for (auto& v : triangle) {
      const Point2 p = mesh.rest[to_size(v)];
      const auto [place, is_new] = number.try_emplace({p.x, p.y}, to_int32(joined.rest.size()));
      if (is_new) {
        joined.rest.push_back(p);
        joined.deformed.push_back(mesh.deformed[to_size(v)]);
      }
      v = place->second;
    }
    joined.triangles.push_back(triangle);
  }
  if (is_sewn) sew(joined, 0, "joined");
  return Sheet(joined);
}

PickedCurve line_at(std::initializer_list<Point3> points, bool closed = false) {
  PickedCurve curve{Curve::Kind::polyline, closed, {}};
  for (const Point3& p : points) curve.picks.push_back({p, {}});
  return curve;
}

TEST(PickSewn, AWayGoesOnOverSeams) {
  const auto crosses = [](const Sheet& sheet, const PickedCurve& curve) {
    const std::vector<Curve> curves = Picker(sheet).rest_curves(curve, "it");
    return curves.size() > 1 || (curve.closed && !curves.front().closed);
  };
  const Sheet panels = sheet_of(sewn_strip(6, 2, 3, false)), whole = sheet_of(sewn_strip(6, 6, 0, false));
  EXPECT_TRUE(crosses(panels, line_at({{1.5, 0.5, 0}, {2.5, 0.5, 0}})));
  EXPECT_TRUE(crosses(panels, line_at({{0.5, 0.5, 0}, {1.5, 0.2, 0}, {5.5, 0.5, 0}})));
  EXPECT_FALSE(crosses(panels, line_at({{2.2, 0.5, 0}, {3.9, 0.1, 0}})));
  EXPECT_FALSE(crosses(whole, line_at({{0.5, 0.5, 0}, {5.5, 0.5, 0}})));

  const Sheet tube = sheet_of(sewn_strip(12, 12, 0, true));
  const MeshData data = tube.to_mesh_data();
  const auto at = [&](int square) {  // the middle of its diagonal
    const auto corner = [&](double x, double y) {
      for (std::size_t v = 0; v < data.rest.size(); ++v)
        if (data.rest[v] == Point2{x, y}) return data.deformed[v];
      return Point3{};
    };
    return 0.5 * (corner(square, 0) + corner(square + 1, 1));
  };
  EXPECT_TRUE(crosses(tube, line_at({at(1), at(4), at(7), at(10)}, true)));
  EXPECT_FALSE(crosses(tube, line_at({at(1), at(4), at(7), at(10)})));
  EXPECT_TRUE(crosses(tube, line_at({at(0), at(11)})));

  // Panels that nothing joins: no straight line leads through what lies between them at rest.
  const Sheet open_panels = sheet_of(sewn_strip(6, 2, 3, false), false);
  try {
    Picker(open_panels).rest_curves(line_at({{1.5, 0.5, 0}, {2.5, 0.5, 0}}), "it");
    FAIL() << "not refused";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("nothing joins"), std::string::npos) << error.what();
  }
}

/// A path over seams is one cut of the user's file, whatever stretches it is made in.
TEST_F(SewnFiles, APathOverSeamsIsOneCutAndCanBeScored) {
  const MeshData panels = in_panels(make_sheet("delaunay", 6), [](Point2 p) { return to_int(std::floor(3 * p.x)); });
  write_mesh(panels, folder_ / "sewn.obj");
  write(folder_ / "world.json", R"({"cuts": [{"space": "world", "polyline": [[0.2, 0.6, 0], [0.3, 0.62, 0]]},
    {"space": "world", "polyline": [[0.1, 0.3, 0], [0.9, 0.4, 0]]}]})");
  const auto result =
      run("cut --mesh sewn.obj --method conventional_split --path world.json --out a.obj --parents p.json");
  ASSERT_EQ(result.code, 0) << result.error;
  const std::string parents = read(folder_ / "p.json");
  EXPECT_NE(parents.find("\"cut\":0"), std::string::npos);
  EXPECT_NE(parents.find("\"cut\":1"), std::string::npos);
  EXPECT_EQ(parents.find("\"cut\":2"), std::string::npos);
  const auto right = run("score --mesh sewn.obj --path world.json --result a.obj");
  EXPECT_EQ(right.code, 0) << right.out << right.error;
  EXPECT_NE(right.out.find("1 pieces (1 expected)"), std::string::npos) << right.out;

  ASSERT_EQ(run("cut --mesh sewn.obj --method element_deletion --path world.json --out d.obj").code, 0);
  const auto deleted = run("score --mesh sewn.obj --path world.json --result d.obj --deletes");
  EXPECT_EQ(deleted.code, 0) << deleted.out << deleted.error;

  // One panel is cut, and the next one left whole.
  const auto path = read_path_with_picks(folder_ / "world.json");
  auto stretches = curves_at_rest(path, Sheet(read_mesh(folder_ / "sewn.obj")), "it");
  EXPECT_EQ(stretches.cut, (std::vector<std::size_t>{0, 1, 1, 1}));
  stretches.curves.pop_back();
  write_path(stretches.curves, folder_ / "part.json");
  ASSERT_EQ(run("cut --mesh sewn.obj --method conventional_split --path part.json --out b.obj").code, 0);
  const auto wrong = run("score --mesh sewn.obj --path world.json --result b.obj");
  EXPECT_EQ(wrong.code, 1) << wrong.out;
  EXPECT_NE(wrong.out.find("crosses a seam where a side of it is whole"), std::string::npos) << wrong.out;
}

/// Wherever the seam of a tube is, cuts along its edges are right in the file, too: over the seam, along it, and with
/// a tip on it, where the file has one `v` with equal `vt` in two fans of triangles.
TEST_F(SewnFiles, CutsAlongTheEdgesOfATubeCanBeScored) {
  const int round = 8;
  const MeshData raw = tube(round, 4, 2);
  std::string obj;
  for (const Point3 p : raw.deformed)
    obj += "v " + std::to_string(p.x) + ' ' + std::to_string(p.y) + ' ' + std::to_string(p.z) + '\n';
  for (const auto& [a, b, c] : raw.triangles)
    obj += "f " + std::to_string(a + 1) + ' ' + std::to_string(b + 1) + ' ' + std::to_string(c + 1) + '\n';
  write(folder_ / "tube.obj", obj);
  const auto place = [&](int i, int j) {
    const Point3 p = raw.deformed[to_size(j * round + i % round)];
    return '[' + std::to_string(p.x) + ',' + std::to_string(p.y) + ',' + std::to_string(p.z) + ']';
  };
  for (int i = 0; i < round; ++i)
    for (const std::string& points : {place(i, 0) + ',' + place(i, 4),  // from end to end
                                      place(i, 2) + ',' + place(i + 1, 2) + ',' + place(i + 2, 2)}) {
      write(folder_ / "path.json", R"({"cuts": [{"space": "world", "polyline": [)" + points + "]}]}");
      const std::string common = " --mesh tube.obj --path path.json ";
      ASSERT_EQ(run("cut --method conventional_split --out a.obj" + common).code, 0) << points;
      const auto right = run("score --result a.obj" + common);
      EXPECT_EQ(right.code, 0) << points << right.out << right.error;
      EXPECT_NE(right.out.find("0 triangles"), std::string::npos) << right.out;  // none added

      write(folder_ / "scene.toml", R"(effect = "a cut"
truth = "none"
duration = 0.01
[sheet]
file = "tube.obj"
rest = "space"
[material]
density = 0.2
stiffness = 30.0
poisson = 0.3
[physics]
gravity = [3.0, 0.0, -9.3]
[[pins]]
space = "world"
box = [[-1.0, -2.0, -2.0], [0.1, 2.0, 2.0]]
[integrator]
name = "backward_euler"
step = 0.004
[[cuts]]
time = 0.0
space = "world"
polyline = [)" + points + "]\n");
      const auto moved = run("simulate scene.toml --out moved.obj");
      EXPECT_EQ(moved.code, 0) << points << moved.out << moved.error;
    }
}

/// Vertices that the file has twice: the same sheet by --sew, for both commands.
TEST_F(SewnFiles, ASheetThatIsSewnOnRequestCanBeScored) {
  MeshData panels = in_panels(make_sheet("delaunay", 6), [](Point2 p) { return p.x > 0.5 ? 1 : 0; });
  panels.sewn.clear();
  panels.file_vertices.clear();
  write_mesh(panels, folder_ / "twice.obj");
  write(folder_ / "world.json", R"({"cuts": [{"space": "world", "polyline": [[0.1, 0.3, 0], [0.9, 0.4, 0]]}]})");
  const std::string common = " --mesh twice.obj --path world.json ";
  EXPECT_EQ(run("cut --method conventional_split --out a.obj" + common).code, 2);  // nothing joins the panels
  const auto result = run("cut --method conventional_split --out a.obj --sew 1e-9" + common);
  ASSERT_EQ(result.code, 0) << result.error;
  const auto right = run("score --result a.obj --sew 1e-9" + common);
  EXPECT_EQ(right.code, 0) << right.out << right.error;
}

/// As Blender and PLY write a seam: two columns of a closed tube at one place, but for the last digit.
TEST_F(SewnFiles, VerticesThatAFileHasTwiceAreNamedAndSewnOnRequest) {
  std::string text;
  const int round = 12;
  for (int j = 0; j <= 4; ++j)
    for (int i = 0; i <= round; ++i) {
      const double angle = 2 * std::numbers::pi * i / round;
      text += "v " + std::to_string(std::cos(angle) + (i == round ? 2e-6 : 0)) + " " + std::to_string(std::sin(angle)) +
              " " + std::to_string(0.5 * j) + "\n";
    }
  for (int j = 0; j < 4; ++j)
    for (int i = 1; i <= round; ++i) {
      const int a = j * (round + 1) + i, b = a + round + 1;
      const auto face = [&](int p, int q, int r) {
        text += "f " + std::to_string(p) + " " + std::to_string(q) + " " + std::to_string(r) + "\n";
      };
      face(a, a + 1, b + 1);
      face(a, b + 1, b);
    }
  write(folder_ / "tube.obj", text);
  const std::string notes = joined_notes(read_mesh(folder_ / "tube.obj"));
  EXPECT_NE(
      notes.find("vertices that lie where others do, though apart at rest: 5; the sheet is open there, --sew 3e-06"),
      std::string::npos)
      << notes;
  EXPECT_FALSE(read_mesh(folder_ / "tube.obj", {RestFrom::automatic, false, 3e-6}).sewn.empty());
}

/// In a plane there is no telling a seam from an incision where the places are the same, bit for bit.
TEST_F(SewnFiles, SewingInAPlaneLeavesIncisionsOpen) {
  const std::string left = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
  write(folder_ / "same.obj", left + "v 1 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nf 5 6 7\nf 5 7 8\n");
  write(folder_ / "near.obj", left + "v 1.000001 0 0\nv 2 0 0\nv 2 1 0\nv 1.000001 1 0\nf 5 6 7\nf 5 7 8\n");
  const MeshData same = read_mesh(folder_ / "same.obj", {RestFrom::automatic, false, 1e-5});
  EXPECT_EQ(same.deformed.size(), 8u);
  EXPECT_NE(joined_notes(same).find("pairs of vertices at equal places in a plane: 2"), std::string::npos);
  EXPECT_EQ(read_mesh(folder_ / "near.obj", {RestFrom::automatic, false, 1e-5}).deformed.size(), 6u);
}

/// Of a tube, whose rest shape is the mesh itself.
TEST_F(SewnFiles, ACutOfATubeCanBeScored) {
  MeshData mesh = tube(12, 5, 2);
  mesh.rest.assign(mesh.deformed.size(), {});
  write_mesh(mesh, folder_ / "tube.off");  // in space alone
  write(folder_ / "ring.json", R"({"cuts": [{"space": "world", "closed": true, "polyline": [
    {"origin": [0.9, 0.1, 5], "direction": [0, 0, -1]}, {"origin": [0.9, 5, 0.1], "direction": [0, -1, 0]},
    {"origin": [0.9, 0.12, -5], "direction": [0, 0, 1]}, {"origin": [0.9, -5, 0.11], "direction": [0, 1, 0]}]}]})");
  const auto result =
      run("cut --mesh tube.off --method conventional_split --path ring.json --out a.obj --report r.json");
  ASSERT_EQ(result.code, 0) << result.error;
  EXPECT_NE(result.out.find(" 2 pieces"), std::string::npos) << result.out;
  const auto right = run("score --mesh tube.off --path ring.json --result a.obj");
  EXPECT_EQ(right.code, 0) << right.out << right.error;
  EXPECT_NE(right.out.find("2 pieces (2 expected)"), std::string::npos) << right.out;
}

}  // namespace
}  // namespace cutbench
