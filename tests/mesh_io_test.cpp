
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "harness/files/mesh_file.h"
#include "harness/mesh/families.h"
#include "tests/mesh_checks.h"

namespace cutbench {
namespace {

namespace fs = std::filesystem;

const fs::path cases = CUTBENCH_TEST_CASES;

/// A new folder for each test, gone at its end.
class MeshIo : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "cutbench_XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path file(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return folder_ / name;
  }
  MeshData read(const std::string& name, const std::string& content) const { return read_mesh(file(name, content)); }

  fs::path folder_;
};

TEST(MeshFiles, GoodMeshesAreReadAsTheyAre) {
  const std::map<std::string, std::pair<std::size_t, std::size_t>> expected{
      {"skfem_annulus.off", {98, 60}},     {"skfem_square.off", {184, 109}},  {"mfem_square-disc.off", {154, 101}},
      {"mfem_beam-tri.off", {16, 18}},     {"mfem_ref-triangle.off", {1, 3}}, {"libigl_grid.off", {256, 145}},
      {"pbd_plane_30x30.off", {1800, 961}}};
  const std::string in_plane = "pbd_plane_30x30.off: rest positions are the plane y = 0, with x and z as x and y|";
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(cases / "meshes")) {
    SCOPED_TRACE(entry.path());
    const auto [triangles, vertices] = expected.at(entry.path().filename().string());
    const MeshData mesh = read_mesh(entry.path());
    EXPECT_EQ(mesh.triangles.size(), triangles);
    EXPECT_EQ(mesh.rest.size(), vertices);
    const bool in_xz = entry.path().stem() == "pbd_plane_30x30";
    EXPECT_EQ(joined_notes(mesh), in_xz ? in_plane : "");
    expect_sound(mesh);
    ++files;
  }
  EXPECT_EQ(files, expected.size());
}

TEST(MeshFiles, BadMeshesAreRefusedOrRepaired) {
  struct Outcome {
    bool refused;
    std::string message;
  };
  const std::map<std::string, Outcome> expected{
      {"cgal_degtri_sliding.off", {true, "triangle 3 of 8 has zero area in rest space"}},
      {"cgal_corner_with_sharp_edge.off",
       {false,
        "the rest shape is the mesh itself, unrolled in 2 parts; give paths as places in space|"
        "cgal_corner_with_sharp_edge.off: vertices without triangles dropped: 10|"
        "cgal_corner_with_sharp_edge.off: vertices that lie where others do, though apart at rest: 1; the sheet is "
        "open there, --sew 0 sews it|"}},
      {"cgal_non_manifold_face_graph_quads.off", {true, "face 2 of 11 has 4 corners"}},
      {"blender_nonmanifold_edge_3tri.off", {true, "three triangles meet at the edge (0, 0)-(2, 0)"}},
      {"blender_duplicate_triangle.off", {true, "triangle 2 of 2 has the same rest corners as triangle 1"}},
      {"skfem_ex04.off", {false, "clockwise triangles reversed: 171 of 390|"}},
      {"skfem_ex35_2p5mm.off", {false, "clockwise triangles reversed: 612 of 1296|"}}};
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(cases / "bad_meshes")) {
    SCOPED_TRACE(entry.path());
    const Outcome outcome = expected.at(entry.path().filename().string());
    ++files;
    if (outcome.refused) {
      expect_refused([&] { read_mesh(entry.path()); }, entry.path().filename().string() + ": " + outcome.message);
    } else {
      const MeshData mesh = read_mesh(entry.path());
      EXPECT_EQ(joined_notes(mesh), entry.path().filename().string() + ": " + outcome.message);
      expect_sound(mesh);
    }
  }
  EXPECT_EQ(files, expected.size());
}

const std::string two_triangles = "v 0 0 1\nv 1 0 1.5\nv 1 1 1.75\nv 0 1 1.25\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";

TEST_F(MeshIo, ObjCornersInAllNotations) {
  const MeshData expected = read("a.obj", two_triangles + "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n");
  EXPECT_EQ(expected.deformed[3], (Point3{0, 1, 1.25}));
  EXPECT_EQ(expected.rest[3], (Point2{0, 1}));
  EXPECT_EQ(joined_notes(expected), "");
  expect_bit_equal(expected, read("b.obj", two_triangles + "f 1/1/7 2/2/8 3/3/9\nf 1/1/7 3/3/9 4/4/1\n"));
  expect_bit_equal(expected, read("c.OBJ", two_triangles + "f -4/-4 -3/-3 -2/-2\nf -4/-4 -2/-2 -1/-1\n"));
  expect_bit_equal(expected,
                   read("d.obj", "# sheet\r\nmtllib a.mtl\r\no a\r\ng b\r\ns off\r\nusemtl c\r\nvn 0 0 1\r\n\r\n" +
                                     two_triangles + "f 1/1 2/2 3/3 # first\r\n\tf 1/1 3/3  4/4 \r\n"));
  expect_bit_equal(expected, read("e.obj", "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n" + two_triangles));
}

TEST_F(MeshIo, ObjWithoutVtTakesThePlane) {
  const std::string faces = "f 1 2 3\nf 1//1 3//1 4//1\n";
  const MeshData z = read("z.obj", "v 0 0 7\nv 2 0 7 1.0\nv 2 1 7 0.5 0.5 0.5\nv 0 1 +7e0\n" + faces);
  EXPECT_EQ(z.rest[2], (Point2{2, 1}));
  const MeshData y = read("y.obj", "v 0 7 0\nv 2 7 0\nv 2 7 1\nv 0 7 1\nf 1 3 2\nf 1 4 3\n");
  EXPECT_EQ(y.rest, z.rest);
  const MeshData x = read("x.obj", "v 7 0 0\nv 7 2 0\nv 7 2 1\nv 7 0 1\n" + faces);
  EXPECT_EQ(x.rest, z.rest);
  EXPECT_EQ(joined_notes(z), "");
  EXPECT_EQ(joined_notes(y), "y.obj: rest positions are the plane y = 7, with x and z as x and y|");
  EXPECT_EQ(joined_notes(x), "x.obj: rest positions are the plane x = 7, with y and z as x and y|");
  const MeshData curved = read("curved.obj", "v 0 0 0\nv 1 0 1e-300\nv 1 1 0\nv 0 1 1\n" + faces);
  EXPECT_EQ(joined_notes(curved),
            "curved.obj: the rest shape is the mesh itself, unrolled; give paths as places in space|");
}

TEST_F(MeshIo, SeveralVtOfOneVAreSeveralVertices) {
  // A strip of two triangles, cut open in rest space: v 1 and v 3 lie at two places each.
  const MeshData mesh = read("seam.obj", "# vt: rest positions\n" + two_triangles +
                                             "vt 5 0\nvt 6 1\nvt 5 1\nvt 0 0\nf 1/1 2/2 3/3\nf 1/5 3/6 4/7\n");
  EXPECT_EQ(mesh.rest.size(), 6u);
  EXPECT_EQ(mesh.deformed[4], mesh.deformed[0]);
  EXPECT_EQ(mesh.rest[4], (Point2{5, 0}));
  EXPECT_EQ(joined_notes(mesh),
            "seam.obj: vertices added where one v has several vt: 2; the sheet is sewn along these seams|");
  EXPECT_EQ(mesh.sewn, (std::vector<std::int32_t>{0, 1, 2, 3, 0, 2}));
  expect_sound(mesh);
  // The same place under two numbers is no seam.
  EXPECT_EQ(read("same.obj", two_triangles + "vt 0 0\nf 1/1 2/2 3/3\nf 1/5 3/3 4/4\n").rest.size(), 4u);
}

TEST_F(MeshIo, BadObjLinesAreNamed) {
  const std::vector<std::pair<std::string, std::string>> table{
      {"v 0 0\n", "line 1: a number is missing"},
      {"v 0 0 a\n", "line 1: 'a' is not a finite number"},
      {"v 0 0 1,5\n", "'1,5' is not a finite number"},
      {"v 0 0 nan\n", "'nan' is not a finite number"},
      {"v 0 0 -inf\n", "'-inf' is not a finite number"},
      {"v 0 0 1e999\n", "'1e999' is not a finite number"},
      {"vt 0\n", "line 1: a number is missing"},
      {two_triangles + "f 1 2\n", "line 9: a face with 2 corners; a triangle has three: delete it"},
      {two_triangles + "l 1 2\nl 2 3\n", "bad.obj: lines and no faces; a sheet is made of triangles"},
      {two_triangles + "f 1 2 3 4\n", "line 9: a face with 4 corners; only triangles are read: triangulate the mesh"},
      {two_triangles + "f 1 2 3 4 1\n", "a face with 5 corners"},
      {two_triangles + "f 0 1 2\n", "'0' is not a face corner"},
      {two_triangles + "f 1 2 x\n", "'x' is not a face corner"},
      {two_triangles + "f 1 2 3.5\n", "'3.5' is not a face corner"},
      {two_triangles + "f 1 2 99999999999\n", "'99999999999' is not a face corner"},
      {two_triangles + "f 1 2 -5\n", "'-5' is not a face corner"},
      {two_triangles + "f 1/1 2/2 3/y\n", "'3/y' is not a face corner"},
      {two_triangles + "f 1 2 5\n", "line 9: a corner beyond the 4 v and 4 vt"},
      {two_triangles + "f 1/1 2/2 3/5\n", "line 9: a corner beyond the 4 v and 4 vt"},
      {two_triangles + "f 1/1 2/2 3\n", "line 9: a corner without vt in a mesh with vt"},
      {std::string("v 0 0 0\n\0", 9), "not a text file"},
      {two_triangles, "no triangles"},
      {"", "no triangles"},
      {two_triangles.substr(0, 20) + "f 1 2 3\n", "bad.obj: "}};
  for (const auto& [content, message] : table) {
    SCOPED_TRACE(content);
    expect_refused([&, text = content] { read("bad.obj", text); }, "bad.obj: ");
    expect_refused([&, text = content] { read("bad.obj", text); }, message);
  }
}

TEST_F(MeshIo, BadPlacesAreNamed) {
  expect_refused([&] { read_mesh(folder_ / "none.obj"); }, "none.obj: no such file");
  fs::create_directory(folder_ / "folder.obj");
  expect_refused([&] { read_mesh(folder_ / "folder.obj"); }, "folder.obj: no such file, or it can't be read");
  expect_refused([&] { read("a.stl", ""); }, "a.stl: unknown mesh format; use .obj, .off or .ply");
  expect_refused([&] { read("a", ""); }, "a: unknown mesh format; use .obj, .off or .ply");
}

TEST_F(MeshIo, BadOffFilesAreRefused) {
  const std::string good = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  EXPECT_EQ(read("good.off", good).triangles.size(), 1u);
  const std::string broken = "not a complete OFF file";
  for (const char* content :
       {"", "OFF", "OFF\n3 1 0\n0 0 0\n1 0 0\n", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n",
        "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1\n",
        "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n",
        "OFF\n3 1 0\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n", "OFF\n3 1 0\n0 0 0\n1 0 zero\n0 1 0\n3 0 1 2\n",
        "OFF\n2000000000 1 0\n0 0 0\n", "OFF\n-3 1 0\n0 0 0\n", "OFF\n3 2000000000 0\n0 0 0\n",
        "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n1e18 0 1 2\n", "x 0 0 0\n",
        "\x7f"
        "ELF\x02\x01"}) {
    SCOPED_TRACE(content);
    expect_refused([&] { read("bad.off", content); }, "bad.off: " + broken);
  }
  expect_refused([&] { read("bad.off", "OFF\n0 0 0\n"); }, "bad.off: no triangles");
  expect_refused([&] { read("bad.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1e61 0\n3 0 1 2\n"); },
                 "vertex 3 of 3 has a coordinate that is not finite or beyond 1e60");
}

TEST_F(MeshIo, Ply) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\n"
      "property double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const MeshData mesh = read("a.ply", head + "0 0 0\n1 0 0\n0 0.1 0\n3 0 1 2\n");
  EXPECT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.rest[2], (Point2{0, 0.1}));

  std::string binary = head;
  binary.replace(binary.find("ascii"), 5, "binary_little_endian");
  const double coordinates[] = {0, 0, 0, 1, 0, 0, 0, 0.1, 0};
  binary.append(reinterpret_cast<const char*>(coordinates), sizeof coordinates);
  const std::int32_t corners[] = {0, 1, 2};
  binary += '\3';
  binary.append(reinterpret_cast<const char*>(corners), sizeof corners);
  expect_bit_equal(read("b.ply", binary), mesh);

  for (const std::string& content :
       {std::string(), head + "0 0 0\n1 0 0\n", head + "0 0 0\n1 0 0\n0 x 0\n3 0 1 2\n",
        head + "0 0 0\n1 0 0\n0 1 0\n3 0 1\n", binary.substr(0, binary.size() - 1), std::string("solid\n")}) {
    SCOPED_TRACE(content);
    EXPECT_NE(error_of([&] { read("bad.ply", content); }).find("bad.ply: "), std::string::npos);
  }
  expect_refused([&] { read("bad.ply", binary.substr(0, binary.size() - 1)); }, "not a complete PLY file");
  expect_refused([&] { read("bad.ply", "ply\nformat ascii 1.0\nproperty double x\nend_header\n"); },
                 "not a complete PLY");
  expect_refused([&] { read("bad.ply", "ply\nformat ascii 1.0\nelement vertex 0\nend_header\n"); }, "no triangles");
  expect_refused([&] { read("bad.ply", head + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n"); },
                 "triangle 1 of 1 has a corner beyond the 3 vertices");
  expect_refused([&] { read("bad.ply", head + "0 0 0\n1 0 0\n0 1 0\n4 0 1 2 1\n"); }, "face 1 of 1 has 4 corners");
}

/// In space the unit square, from four vertices of its own for each half.
std::string ply_of_halves(const std::string& names, const std::vector<std::string>& textures) {
  std::istringstream name(names);
  std::string u, v;
  name >> u >> v;
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
      "property float " +
      u + "\nproperty float " + v + "\nelement face 2\nproperty list uchar ushort vertex_indices\nend_header\n";
  const std::vector<std::string> places{"0 0 0", "1 0 0", "1 1 0", "0 0 0", "1 1 0", "0 1 0"};
  for (std::size_t i = 0; i < 6; ++i) text += places[i] + " " + textures[i] + "\n";
  return text + "3 0 1 2\n3 3 4 5\n";
}

TEST_F(MeshIo, TextureCoordinatesOfAPly) {
  const std::vector<std::string> apart{"0 0", "1 0", "1 1", "5 0", "6 1", "5 1"};
  const std::vector<std::string> texture{"0 0", ".1 0", ".1 .1", ".5 0", ".6 .1", ".5 .1"};
  for (const char* names : {"s t", "u v", "texture_u texture_v"}) {
    SCOPED_TRACE(names);
    const MeshData mesh = read("apart.ply", ply_of_halves(names, apart));
    EXPECT_EQ(mesh.rest[4], (Point2{6, 1}));
    EXPECT_NE(joined_notes(mesh).find("--sew 0 sews it"), std::string::npos) << joined_notes(mesh);
  }
  const fs::path in_file = file("sewn.ply", ply_of_halves("s t", apart));
  EXPECT_EQ(Sheet(read_mesh(in_file, {.sew = 0})).seams().size(), 1u);
  EXPECT_EQ(read_mesh(in_file, {.rest = RestFrom::plane}).rest[4], (Point2{1, 1}));
  const fs::path small = file("texture.ply", ply_of_halves("s t", texture));
  EXPECT_EQ(read_mesh(small).rest[4], (Point2{1, 1}));
  EXPECT_NE(joined_notes(read_mesh(small)).find("the vt are taken for a texture"), std::string::npos);
  EXPECT_EQ(read_mesh(small, {.rest = RestFrom::vt}).rest[4].x, 0.6F);
  const fs::path other = file("other.ply", ply_of_halves("confidence intensity", texture));
  expect_refused([&] { read_mesh(other, {.rest = RestFrom::vt}); }, "other.ply: no vt");
}

TEST_F(MeshIo, OtherWaysToWriteAFile) {
  const auto with_carriage_returns = [](std::string text) {
    std::replace(text.begin(), text.end(), '\n', '\r');
    return text;
  };
  const std::string obj = two_triangles + "f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
  expect_bit_equal(read("a.obj", with_carriage_returns(obj)), read("b.obj", obj));
  const std::string off = "OFF\n3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  expect_bit_equal(read("a.off", with_carriage_returns(off)), read("b.off", off));
  const std::string ply = ply_of_halves("s t", {"0 0", "1 0", "1 1", "5 0", "6 1", "5 1"});
  expect_bit_equal(read("a.ply", with_carriage_returns(ply)), read("b.ply", ply));

  const std::string rename = ": by its text it is of the format ";
  expect_refused([&] { read("c.off", obj); }, "c.off" + rename + "OBJ; rename it to .obj");
  expect_refused([&] { read("c.ply", "# made by hand\n\n" + off); }, "c.ply" + rename + "OFF; rename it to .off");
  expect_refused([&] { read("c.obj", ply); }, "c.obj" + rename + "PLY; rename it to .ply");
  expect_refused([&] { read("d.obj", "solid\nfacet normal 0 0 1\n"); }, "d.obj" + rename + "STL; convert it");
  expect_refused([&] { read("e.obj", "$MeshFormat\n"); }, "e.obj" + rename + "Gmsh; convert it");

  expect_refused([&] { read("f.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n2 0 1\n"); },
                 "face 1 of 1 has 2 corners; a triangle has three: delete it");
  expect_refused(
      [&] {
        read("strips.ply",
             "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
             "element tristrips 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
      },
      "strips.ply: its triangles are strips (tristrips), which are not read; export them as faces");
  expect_refused([&] { read("twice.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 1\nf 1 2 3\nf 1 3 4\nf 2 3 1\n"); },
                 "twice.obj: triangle 3 of 3 has the same corners as triangle 1; delete one of them");
}

/// An opened sheet, bent, with numbers that need all 17 digits.
MeshData bent_sheet() {
  MeshData mesh = make_sheet("delaunay", 6);
  for (std::size_t v = 0; v < mesh.rest.size(); ++v) {
    const Point2 p = mesh.rest[v];
    mesh.deformed[v] = {p.x / 3, std::sin(p.y) * 1e-9, std::exp(40 * p.x * p.y)};
  }
  mesh.deformed[0].x = -0.0;
  mesh.deformed[1].x = std::numeric_limits<double>::denorm_min();
  mesh.deformed[2].x = 1e60;
  return mesh;
}

TEST_F(MeshIo, ObjRoundTripIsBitEqual) {
  const MeshData mesh = bent_sheet();
  write_mesh(mesh, folder_ / "a.obj");
  const MeshData back = read_mesh(folder_ / "a.obj");
  expect_bit_equal(mesh, back);
  EXPECT_EQ(joined_notes(back), "");
  EXPECT_FALSE(fs::exists(folder_ / "a.obj.tmp"));

  // The lips of an incision: different vertices at bit-equal rest positions stay apart.
  MeshData open{{{0, 0}, {1, 0}, {0, 1}, {1, 0}, {1, 1}, {0, 1}},
                {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, .1}, {1, 1, .1}, {0, 1, .1}},
                {{0, 1, 2}, {3, 4, 5}},
                {},
                {}};
  write_mesh(open, folder_ / "a.obj");
  expect_bit_equal(open, read_mesh(folder_ / "a.obj"));
}

TEST_F(MeshIo, OffRoundTripOfAFlatSheet) {
  const MeshData mesh = make_sheet("delaunay", 6);
  write_mesh(mesh, folder_ / "a.off");
  expect_bit_equal(mesh, read_mesh(folder_ / "a.off"));
}

std::string content_of(const fs::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST_F(MeshIo, Vtu) {
  const MeshData open{{{0, 0}, {1, 0}, {0, 1}, {1, 0}, {1, 1}, {0, 1}},
                      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, .5}, {1, 1, .5}, {0, 1, .5}},
                      {{0, 1, 2}, {3, 4, 5}},
                      {},
                      {}};
  write_mesh(open, folder_ / "a.vtu");
  const std::string text = content_of(folder_ / "a.vtu");
  for (const char* part : {"NumberOfPoints=\"6\" NumberOfCells=\"2\"",
                           "Name=\"connectivity\" NumberOfComponents=\"1\" format=\"ascii\">\n0 1 2\n3 4 5\n",
                           "Name=\"offsets\" NumberOfComponents=\"1\" format=\"ascii\">\n3\n6\n",
                           "Name=\"types\" NumberOfComponents=\"1\" format=\"ascii\">\n5\n5\n",
                           "Name=\"rest\" NumberOfComponents=\"3\" format=\"ascii\">\n0 0 0\n1 0 0\n",
                           "Name=\"piece\" NumberOfComponents=\"1\" format=\"ascii\">\n0\n1\n",
                           "Name=\"aspect_ratio\" NumberOfComponents=\"1\" format=\"ascii\">\n2\n2\n", "\n1 0 0.5\n"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

TEST_F(MeshIo, UnwritablePlaces) {
  const MeshData mesh = make_sheet("grid", 1);
  expect_refused([&] { write_mesh(mesh, folder_ / "a.ply"); }, "a.ply: unknown mesh format; use .obj, .off or .vtu");
  EXPECT_THROW(write_mesh(mesh, folder_ / "none" / "a.obj"), OutputError);
  fs::create_directories(folder_ / "taken.obj" / "inside");
  EXPECT_THROW(write_mesh(mesh, folder_ / "taken.obj"), OutputError);
  EXPECT_FALSE(fs::exists(folder_ / "taken.obj.tmp"));
  // A full disk: the old file stays.
  write_mesh(mesh, folder_ / "old.obj");
  const std::string old = content_of(folder_ / "old.obj");
  fs::create_symlink("/dev/full", folder_ / "old.obj.tmp");
  EXPECT_THROW(write_mesh(mesh, folder_ / "old.obj"), OutputError);
  EXPECT_EQ(content_of(folder_ / "old.obj"), old);
}

}  // namespace
}  // namespace cutbench
