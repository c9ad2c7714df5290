// Bad input in files of meshes and paths: cut short, spoilt, odd, or of sizes that can't be cut.
#include <cmath>
#include <random>

#include "harness/base/conversions.h"
#include "harness/files/mesh_file.h"
#include "harness/files/path_file.h"
#include "harness/mesh/families.h"
#include "harness/path/curve.h"
#include "tests/bad_input.h"
#include "tests/mesh_checks.h"

namespace cutbench {
namespace {

TEST_F(BadInput, PathFiles) {
  const auto path = [this](const std::string& text) {
    write(folder_ / "bad.json", text);
    const std::string what = error_of([&] { read_path(folder_ / "bad.json"); });
    EXPECT_EQ(what.find('\n'), std::string::npos);
    EXPECT_LT(what.size(), 700u);
    return what;
  };
  const auto nested = [](std::size_t n, const std::string& open, const std::string& close) {
    std::string text;
    for (std::size_t i = 0; i < n; ++i) text += open;
    for (std::size_t i = 0; i < n; ++i) text += close;
    return text;
  };
  for (const auto& [text, message] : std::vector<std::pair<std::string, const char*>>{
           {"[1]", "bad.json: must be an object, {...}, not array"},
           {"1", "must be an object, {...}, not number"},
           {"null", "must be an object, {...}, not null"},
           {"{}", "\"cuts\" must be a list"},
           {R"({"cuts":1})", "\"cuts\" must be a list"},
           {R"({"cuts":{"polyline":[[0,0],[1,1]]}})", "\"cuts\" must be a list"},
           {R"({"cuts":["a"]})", "cut 0: must be an object, {...}, not string"},
           {R"({"cuts":[{}]})", "cut 0: give either \"bezier\" or \"polyline\""},
           {R"({"cuts":[{"polyline":[[0,0],[1,1]],"bezier":[]}]})", "give either"},
           {R"({"cuts":[{"polyline":{"a":[0,0],"b":[1,1]}}]})", "must be a list of points"},
           {R"({"cuts":[{"polyline":3}]})", "must be a list of points"},
           {R"({"cuts":[{"polyline":[["0",0],[1,1]]}]})", "cut 0, point 0: a point is [x, y], two numbers"},
           {R"({"cuts":[{"polyline":[[0,0],[true,1]]}]})", "cut 0, point 1: a point is [x, y], two numbers"},
           {R"({"cuts":[{"polyline":[[0,0],[null,1]]}]})", "cut 0, point 1: a point is"},
           {R"({"cuts":[{"polyline":[[0,0],[1,1]],"closed":"no"}]})", "\"closed\" must be true or false"},
           {R"({"cuts":[{"polyline":[[0,0],[NaN,1]]}]})",
            "bad.json: not a path file: line 1: \"NaN\" can't stand here"},
           {R"({"cuts":[{"polyline":[[0,0],[Infinity,1]]}]})", "not a path file"},
           {R"({"cuts":[{"polyline":[[0,0],[1e400,1]]}]})", "line 1: the number 1e400 is too large"},
           {R"({"cuts":[{"polyline":[[0,0],[1,1]]}]} x)", "not a path file: line 1: \"x\" can't stand here"},
           {"{\"cuts\": [\n{\"polyline\": [[0, 0], [1, 1],]}]}",
            "line 2: \"]\" can't stand here; delete the comma before it"},
           {"{\"cuts\": [\n{\"polyline\": [[0, 0]\n[1, 1]]}]}", "line 3: \"[\" can't stand here; is a comma missing"},
           {"{'cuts': []}", "line 1: \"'\" can't stand here; write \" instead"},
           {"// a path\n{\"cuts\": []}", "line 1: \"/\" can't stand here; JSON has no comments"},
           {"{\"cuts\": []\n", "line 2: the file ends too soon; is it complete?"},
           {" \n", "bad.json: not a path file: it is empty; a path file is {\"cuts\": "},
           {R"({"cuts":[{"polyline":[[0,0],[1,1]],"polyline":[[0,0],[2,2]]}]})", "the key \"polyline\" is there twice"},
           {R"({"cuts":[],"cuts":[]})", "the key \"cuts\" is there twice"},
           {"{\"cu\nts\":[]}", "close the string with \" in its own line"},
           {R"({"cu\nts\u001b":[]})", "unknown key \"cu?ts?\""},
           {"{\"" + std::string(100000, 'x') + "\":1}", "[...]"},
           {"\"" + std::string(100000, 'x'), "line 1: the file ends too soon"},
           {std::string("\0\1\2\377", 4), "not a path file"},
           {nested(1000000, "[", ""), "not a path file"},
           {nested(1000000, "[", "]"), "must be an object"},
           {R"({"cuts":)" + nested(100000, "[", "]") + "}", "must be an object, {...}, not array"},
           {R"({"cuts":[{"polyline":)" + nested(100000, "[", "]") + "}]}", "a point is [x, y]"}})
    EXPECT_NE(path(text).find(message), std::string::npos) << text.substr(0, 100) << "\nsays " << path(text);
  const std::string good_path = R"({"cuts":[{"polyline":[[0,0.5],[1,1]],"closed":false}]})";
  EXPECT_EQ(path(good_path), "no InputError");
  EXPECT_EQ(path("\xEF\xBB\xBF" + good_path), "no InputError");
  for (std::size_t n = 0; n < good_path.size(); ++n)
    EXPECT_NE(path(good_path.substr(0, n)).find("not a path file"), std::string::npos) << n;
}

/// Whatever is cut off or changed in a good file, it is read or refused in one line; nothing else happens.
TEST_F(BadInput, MeshesCutShortOrSpoilt) {
  write_mesh(make_sheet("delaunay", 2), folder_ / "good.obj");
  write_mesh(make_sheet("delaunay", 2), folder_ / "good.off");
  std::string ply =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
      "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
  const float coordinates[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::int32_t corners[] = {0, 1, 2};
  ply.append(reinterpret_cast<const char*>(coordinates), sizeof coordinates) += '\3';
  ply.append(reinterpret_cast<const char*>(corners), sizeof corners);
  write(folder_ / "good.ply", ply);
  std::mt19937 random(4);
  for (const std::string extension : {".obj", ".off", ".ply"}) {
    const std::string text = read(folder_ / ("good" + extension));
    const fs::path file = folder_ / ("bad" + extension);
    const auto outcome = [&](const std::string& content) {
      write(file, content);
      const std::string what = error_of([&] { read_mesh(file); });
      EXPECT_EQ(what.find('\n'), std::string::npos) << what;
      return what;
    };
    ASSERT_EQ(outcome(text), "no InputError");
    for (std::size_t n = 0; n + 2 < text.size(); n += 1 + n / 50) {
      const std::string what = outcome(text.substr(0, n));
      // An OBJ says nowhere how much there is of it: whole lines may be missing, and digits of a last number.
      const bool named = extension == ".obj" || what.find("bad" + extension + ": ") != std::string::npos;
      EXPECT_TRUE(named) << n << ": " << what;
    }
    for (int i = 0; i < 300; ++i) {
      std::string spoilt = text;
      for (std::uint32_t k = 0; k <= random() % 3; ++k)
        spoilt[random() % spoilt.size()] =
            static_cast<char>(random() % 4 ? "0123456789-+.eE/ \n\\"[random() % 20] : random());
      outcome(spoilt);
    }
  }
}

/// An announced size asks for no memory: the program may take 1 GB here, and the file announces ten times as much.
TEST_F(BadInput, AnnouncedSizesAskForNoMemory) {
  const std::string ply = "ply\nformat ascii 1.0\n";
  write(folder_ / "vertices.off", "OFF\n1000000000 1 0\n0 0 0\n");
  write(folder_ / "faces.off", "OFF\n3 1000000000 0\n0 0 0\n");
  write(folder_ / "corners.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n1000000000 0 1 2\n");
  write(folder_ / "vertices.ply",
        ply +
            "element vertex 1000000000\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n");
  write(folder_ / "corners.ply",
        ply +
            "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
            "element face 1\nproperty list int int vertex_indices\nend_header\n0 0 0\n1000000000 0\n");
  const bool sanitized = read(CUTBENCH_PROGRAM).find("__asan_init") != std::string::npos;  // which maps terabytes
  for (const char* name : {"vertices.off", "faces.off", "corners.off", "vertices.ply", "corners.ply"})
    expect({cut_with(name), 2, "not a complete"}, sanitized ? "" : "ulimit -v 1000000;");
}

TEST_F(BadInput, BadMeshesThroughTheProgram) {
  const fs::path folder = fs::path(CUTBENCH_TEST_CASES) / "bad_meshes";
  for (const auto& entry : fs::directory_iterator(folder)) fs::copy(entry.path(), folder_);
  expect_all({{cut_with("cgal_degtri_sliding.off"), 2, "triangle 3 of 8 has zero area"},
              {cut_with("cgal_corner_with_sharp_edge.off"), 2, "the sheet is unrolled, so places at rest mean nothing"},
              {cut_with("cgal_non_manifold_face_graph_quads.off"), 2, "triangulate the mesh"},
              {cut_with("blender_nonmanifold_edge_3tri.off"), 2, "three triangles meet at the edge"},
              {cut_with("blender_duplicate_triangle.off"), 2, "delete one of them"}});
  // Two are repaired, which is said.
  write(folder_ / "across.json", R"({"cuts":[{"polyline":[[-0.09,0.0011],[0.09,0.0012]]}]})");
  for (const char* name : {"skfem_ex04.off", "skfem_ex35_2p5mm.off"}) {
    const Result result = run(cut_with(name, "across.json"));
    EXPECT_EQ(result.code, 0) << result.error;
    EXPECT_TRUE(result.error.starts_with("note: " + std::string(name) + ": clockwise triangles reversed"))
        << result.error;
  }
}

TEST_F(BadInput, ObjOddities) {
  const auto mesh = [this](const std::string& text) {
    write(folder_ / "odd.obj", text);
    return read_mesh(folder_ / "odd.obj");
  };
  const std::string plain = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const MeshData expected = mesh(plain);
  for (const std::string& text :
       {"\xEF\xBB\xBF" + plain, std::string("v 0 0 0\nv 1 \\\n0 0\nv 0 1 0\nf 1 \\\r\n 2 \\\n\\\n 3"),
        std::string("# a path \\\nv 0 0 0\nv 1 0 0 # C:\\\nv 0 1 0\nf 1//1 2//-9 3//\n"),
        std::string("v 0 0 0\rv 9\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")})
    expect_bit_equal(mesh(text), expected);
  EXPECT_EQ(mesh("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r").triangles.size(), 1u);  // lines as in old programs
  expect_refused([&] { mesh(plain + "f 1//x 2 3\n"); }, "line 5: '1//x' is not a face corner");
  expect_refused([&] { mesh(plain + "f 1/1/1/1 2 3\n"); }, "line 5: '1/1/1/1' is not a face corner");
  expect_refused([&] { mesh("v 0 0 0\nv 1 \\\n \\\n x 0\n"); }, "line 4: 'x' is not a finite number");
  const std::string long_word(100000, 'x');
  expect_refused([&] { mesh("v 0 " + long_word); }, "[...]");
  expect_refused([&] { mesh("v 0 \x1b[2Jx 0"); }, "'?[2Jx' is not a finite number");
}

/// Too far out, too few doubles are left to cut with; too small, products of coordinates underflow.
TEST_F(BadInput, SizesOutOfRange) {
  const auto triangle = [](Point2 at, double side) {
    MeshData mesh{{at, at + Point2{side, 0}, at + Point2{0, side}}, {{}, {}, {}}, {{0, 1, 2}}, {}, {}};
    check_and_repair(mesh, "m");
  };
  const double ulp = std::ldexp(1, -52);  // of 1 ... 2; the mean side is 1.138 times the short one
  for (Point2 at : {Point2{1, 0}, Point2{-1, 0}, Point2{0.5, 1}, Point2{-0.1, -1}}) {
    EXPECT_EQ(error_of([&] { triangle(at, 1000000 * ulp); }), "no InputError");
    expect_refused([&] { triangle(at, 850000 * ulp); }, "m: the sheet lies too far from the origin for its size");
  }
  EXPECT_EQ(error_of([&] { triangle({1e55, 1e55}, 1e47); }), "no InputError");
  expect_refused([&] { triangle({1e55, 1e55}, 1e44); }, "move it nearer");
  EXPECT_EQ(error_of([&] { triangle({0, 0}, 1e-60); }), "no InputError");
  expect_refused([&] { triangle({0, 0}, 0.8e-60); }, "m: the sheet is too small");
  expect_refused([&] { triangle({0, 0}, 1e-200); }, "rescale it to above 1e-60");
  expect_refused([&] { triangle({0, 0}, 4e-320); }, "m: the sheet is too small");
  expect_refused([&] { triangle({0, 0}, 0); }, "zero area");
  expect_refused([&] { triangle({1, 1}, 0); }, "zero area");
}

/// Every triangle with vertices of its own, as some programs write: never merged, since that is how an incision looks.
TEST_F(BadInput, DoubledVerticesAreIncisions) {
  const MeshData sheet = make_sheet("grid", 3);
  MeshData soup;
  for (const auto& triangle : sheet.triangles)
    for (std::int32_t v : triangle) {
      soup.rest.push_back(sheet.rest[to_size(v)]);
      soup.deformed.push_back(sheet.deformed[to_size(v)]);
    }
  for (std::int32_t t = 0; t < 18; ++t) soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  const MeshData before = soup;
  check_and_repair(soup, "m");
  expect_bit_equal(soup, before);
  EXPECT_EQ(joined_notes(soup),
            "m: no two neighbouring triangles share vertices, so the sheet is read as cut open along all its 21 inner "
            "edges; merge equal vertices if that isn't meant|");
}

}  // namespace
}  // namespace cutbench
