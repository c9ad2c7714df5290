// Bad input through every door: one line that says what, where and what to do, the right exit code, nothing left
// behind. What a single reader refuses, line by line, is in mesh_io_test, check_and_repair_test, path_test and
// scene_test.
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include <random>

#include "harness/mesh/families.h"
#include "harness/path/curve.h"
#include "harness/records/context.h"
#include "harness/run/experiment.h"
#include "tests/mesh_checks.h"
#include "tests/program.h"

namespace cutbench {
namespace {

struct Case {
  std::string arguments;
  int code;
  const char* message;  ///< part of the one line
};

class BadInput : public Program {
 protected:
  /// The last line is the error; lines before it are notes. No file comes, goes or changes.
  void expect(const Case& c, const std::string& before = "") {
    SCOPED_TRACE(c.arguments);
    const auto files_before = files();
    const std::string sheet = read(folder_ / "sheet.off"), path = read(folder_ / "path.json");
    const Result result = run(c.arguments, before);
    EXPECT_EQ(result.code, c.code) << result.error;
    auto lines = lines_of(result.error);
    std::erase_if(lines, [](const std::string& line) { return line.starts_with("note: "); });
    ASSERT_EQ(lines.size(), 1u) << result.error;
    EXPECT_NE(lines[0].find(c.message), std::string::npos) << lines[0];
    EXPECT_EQ(lines[0].find("internal error"), std::string::npos) << lines[0];
    EXPECT_LT(lines[0].size(), 700u);
    EXPECT_EQ(files(), files_before);
    EXPECT_EQ(read(folder_ / "sheet.off"), sheet);
    EXPECT_EQ(read(folder_ / "path.json"), path);
  }
  void expect_all(const std::vector<Case>& table) {
    for (const Case& c : table) expect(c);
  }
  static std::string cut_with(const std::string& mesh, const std::string& path = "path.json",
                              const std::string& out = "out.obj") {
    return "cut --method cgal_cdt --mesh " + mesh + " --path " + path + " --out " + out;
  }
};

const std::string good = "cut --method cgal_cdt --mesh sheet.off --path path.json --out out.obj";

std::string knob(const std::string& method, const std::string& value) {
  return "cut --method " + method + " --set " + value + " --mesh sheet.off --path path.json --out out.obj";
}

TEST_F(BadInput, Options) {
  expect_all({{"", 2,
               "no subcommand given; known are methods, cut, score, simulate, ablate, recommend, run, reduce, merge, "
               "missing, columns, compare; see cutbench --help"},
              {"nonsense", 2, "unknown subcommand \"nonsense\"; known are "},
              {"scroe", 2, "unknown subcommand \"scroe\"; known are score, "},
              {"cut", 2, "is required; see cutbench cut --help"},
              {"--nonsense", 2, "see cutbench --help"},
              {good + " --nonsense 1", 2, "--nonsense"},
              {good + " --out", 2, "--out"},
              {good + " --mesh sheet.off", 2, "--mesh"},
              {"cut --method '' --mesh sheet.off --path path.json --out out.obj", 2,
               "unknown method \"\"; `cutbench methods` lists them"},
              {"cut --method bowyer_watson --set rounds=inf --mesh sheet.off --path path.json --out out.obj", 2,
               "rounds must be a whole number from 0 to 6"},
              {knob("bowyer_watson", "rounds=0.5"), 2, "rounds must be a whole number from 0 to 6"},
              {knob("cgal_refine", "bound=1"), 2, "bound must be 0, or a number from 2 to 1000"},
              {knob("delaunay_refine", "bound=1001"), 2, "bound must be 0, or a number from 2 to 1000"},
              {knob("longest_edge", "cap=101"), 2, "cap must be a number from 0 to 100"},
              {knob("snap_or_split", "tolerance=0.6"), 2, "tolerance must be a number from 0 to 0.5"},
              {knob("adaptive_remesh", "tip=0.05"), 2, "tip must be 0, or a number from 0.1 to 1"},
              {knob("cut_polygons", "thinness=2"), 2, "thinness must be a number from 0 to 1"},
              {knob("split_and_tie", "thinness=-1"), 2, "thinness must be a number from 0 to 0.3"},
              {knob("vertex_snap", "reach=0.6"), 2, "reach must be a number from 0 to 0.5"},
              {knob("active_node", "spacing=0.1"), 2, "spacing must be 0, or a number from 0.25 to 4"},
              {knob("warp_and_refine", "reach=-1"), 2, "reach must be a number from 0 to 0.5"},
              {good + " --chord-tolerance 1x", 2, "\"1x\" is not a number"},
              {"simulate " + std::string(CUTBENCH_TEST_CASES) +
                   "/../../experiments/scenes/falling_piece.toml "
                   "--resolution -800",
               2, "--resolution"}});
}

TEST_F(BadInput, PlacesToReadFrom) {
  fs::create_directory(folder_ / "folder.obj");
  write(folder_ / "empty.off", ""), write(folder_ / "empty.json", ""), write(folder_ / "empty.toml", "");
  expect_all({{cut_with("none.obj"), 2, "none.obj: no such file"},
              {cut_with("folder.obj"), 2, "folder.obj: no such file, or it can't be read"},
              {cut_with("empty.off"), 2, "empty.off: not a complete OFF file"},
              {cut_with("path.json"), 2, "path.json: unknown mesh format; use .obj, .off or .ply"},
              {cut_with("sheet.off", "none.json"), 2, "none.json: can't be read"},
              {cut_with("sheet.off", "."), 2, ".: can't be read"},
              {cut_with("sheet.off", "empty.json"), 2, "empty.json: not a path file"},
              {cut_with("sheet.off", "sheet.off"), 2, "sheet.off: not a path file"},
              {"run none.toml", 2, "none.toml: can't be read"},
              {"run folder.obj", 2, "folder.obj: can't be read"},
              {"run empty.toml", 2, "\"claim\" is missing"},
              {"simulate folder.obj", 2, "folder.obj: can't be read"},
              {"simulate empty.toml", 2, "\"effect\" is missing"}});
  if (geteuid() == 0) return;  // who may read everything
  for (const char* name : {"sheet.off", "path.json", "empty.toml"}) fs::permissions(folder_ / name, fs::perms::none);
  expect_all({{"run empty.toml", 2, "empty.toml: can't be read"}});
  EXPECT_NE(run(good).error.find("path.json: can't be read"), std::string::npos);
  fs::permissions(folder_ / "path.json", fs::perms::owner_all);
  EXPECT_NE(run(good).error.find("sheet.off: no such file, or it can't be read"), std::string::npos);
}

/// Where the result can't go is known before the work.
TEST_F(BadInput, PlacesToWriteTo) {
  fs::create_directories(folder_ / "folder.obj"), fs::create_directory(folder_ / "r");
  write(folder_ / "e.toml", small_experiment());
  expect_all(
      {{cut_with("sheet.off", "path.json", "out.ply"), 2, "out.ply: unknown mesh format; use .obj, .off or .vtu"},
       {cut_with("sheet.off", "path.json", "out"), 2, "unknown mesh format"},
       {cut_with("sheet.off", "path.json", "''"), 2, "unknown mesh format"},
       {cut_with("sheet.off", "path.json", "none/out.obj"), 2, "there is no folder none; make it first"},
       {cut_with("sheet.off", "path.json", "sheet.off/out.obj"), 2, "there is no folder sheet.off"},
       {cut_with("sheet.off", "path.json", "folder.obj"), 2, "--out folder.obj: is a folder"},
       {good + " --report none/r.json", 2, "there is no folder none"},
       {good + " --report r", 2, "--report r: is a folder"},
       {good + " --report ./sheet.off", 2, "would take the place of sheet.off"},
       {good + " --report path.json", 2, "would take the place of path.json"},
       {good + " --report out.obj", 2, "would take the place of out.obj"},
       {"run e.toml --out sheet.off", 2, "sheet.off/e: can't be made"},
       {"simulate e.toml --out none/out.obj", 2, "there is no folder none"}});
  if (geteuid() == 0) return;  // who may write everywhere
  fs::permissions(folder_ / "r", fs::perms::owner_read | fs::perms::owner_exec);
  expect_all({{cut_with("sheet.off", "path.json", "r/out.obj"), 2, "Permission denied"},
              {good + " --report r/r.json", 2, "Permission denied"},
              {"run e.toml --out r", 2, "can't be made (Permission denied)"}});
  fs::permissions(folder_ / "r", fs::perms::owner_all);
}

/// Files that may not grow beyond one block stand for a disk that is full, for everybody and every kind of file.
TEST_F(BadInput, FullDisk) {
  write_mesh(make_sheet("grid", 10), folder_ / "big.obj");
  write(folder_ / "big.json", R"({"cuts":[{"polyline":[[-0.1,0.31],[1.1,0.7]]}]})");
  write(folder_ / "e.toml", small_experiment());
  write(folder_ / "old.obj", "old");
  const std::string full = "ulimit -f 1; ";
  for (const char* out : {"out.obj", "out.off", "out.vtu", "old.obj"})
    expect({cut_with("big.obj", "big.json", out), 1, "can't be written (File too large)"}, full);
  EXPECT_EQ(read(folder_ / "old.obj"), "old");
  // The mesh of two triangles fits; its report doesn't, so there is neither.
  expect({cut_with("sheet.off", "path.json", "out.off") + " --report r.json", 1, "r.json: can't be written"}, full);

  const Result result = run("run e.toml --out r", full);
  EXPECT_EQ(result.code, 1);
  EXPECT_NE(result.error.find("records.csv.part: can't be written (File too large); make room and run"),
            std::string::npos)
      << result.error;
  EXPECT_FALSE(fs::exists(folder_ / "r/e/records.csv"));
  EXPECT_EQ(run("run e.toml --out r").code, 0);  // with room again
  EXPECT_EQ(lines_of(read(folder_ / "r/e/records.csv")).size(), 1u + 2 * 2 * 3 * 3 * 2);
  EXPECT_FALSE(fs::exists(folder_ / "r/e/records.csv.part"));
}

/// A real file system without room, in a mount namespace of its own.
TEST_F(BadInput, FullFileSystem) {
  const std::string mount = "unshare -m sh -c 'mkdir -p small && mount -t tmpfs -o size=16k none small && ";
  if (std::system(("cd '" + folder_.string() + "' && " + mount + "true' 2>/dev/null").c_str()) != 0)
    GTEST_SKIP() << "needs the right to mount";
  write_mesh(make_sheet("grid", 20), folder_ / "big.obj");
  write(folder_ / "big.json", R"({"cuts":[{"polyline":[[-0.1,0.31],[1.1,0.7]]}]})");
  for (const char* out : {"out.obj", "out.off", "out.vtu"}) {
    const std::string command = "cd '" + folder_.string() + "' && " + mount + "'" CUTBENCH_PROGRAM "' " +
                                cut_with("big.obj", "big.json", std::string("small/") + out) +
                                "; echo code $?; ls small' >stdout 2>stderr";
    ASSERT_EQ(std::system(command.c_str()), 0);
    EXPECT_EQ(read(folder_ / "stdout"), "code 1\n");
    EXPECT_NE(read(folder_ / "stderr").find("No space left on device"), std::string::npos) << read(folder_ / "stderr");
  }
}

/// A device is written, never replaced by a file. The devices are the test's own: the machine's would be lost to a
/// mistake.
TEST_F(BadInput, Devices) {
  const auto device = [this](const char* name, unsigned minor) {
    return mknod((folder_ / name).c_str(), S_IFCHR | 0666, makedev(1, minor)) == 0 &&
           std::ofstream(folder_ / name).good();
  };
  if (!device("full.obj", 7) || !device("null.obj", 3)) GTEST_SKIP() << "needs the right to make devices";
  fs::create_symlink("full.obj", folder_ / "link.obj");
  expect_all(
      {{cut_with("sheet.off", "path.json", "full.obj"), 1, "full.obj: can't be written (No space left on device)"},
       {cut_with("sheet.off", "path.json", "link.obj"), 1, "can't be written (No space left on device)"},
       {good + " --report full.obj", 1, "full.obj: can't be written (No space left on device)"},
       {"methods > full.obj", 1, "standard output: can't be written"},
       {"methods --json > full.obj", 1, "standard output: can't be written"}});
  EXPECT_EQ(run(cut_with("sheet.off", "path.json", "null.obj")).code, 0);
  for (const char* name : {"full.obj", "null.obj"}) EXPECT_TRUE(fs::is_character_file(folder_ / name)) << name;
}

TEST_F(BadInput, OutputMayTakeTheInputsPlace) {
  fs::copy(folder_ / "sheet.off", folder_ / "copy.off");
  fs::create_symlink("copy.off", folder_ / "link.off");
  ASSERT_EQ(run(cut_with("sheet.off", "path.json", "expected.off")).code, 0);
  ASSERT_EQ(run(cut_with("link.off", "path.json", "link.off")).code, 0);
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.off"));
  EXPECT_EQ(read(folder_ / "copy.off"), read(folder_ / "expected.off"));
}

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
  write(folder_ / "vertices.off", "OFF\n1000000000 1 0\n0 0 0\n"),
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
              {cut_with("cgal_corner_with_sharp_edge.off"), 2, "use an OBJ with vt (rest positions), or flatten it"},
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
  expect_refused([&] { mesh("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r"); }, "no triangles");  // lines end in nothing known
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
    MeshData mesh{{at, at + Point2{side, 0}, at + Point2{0, side}}, {{}, {}, {}}, {{0, 1, 2}}, {}};
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
      soup.rest.push_back(sheet.rest[static_cast<std::size_t>(v)]);
      soup.deformed.push_back(sheet.deformed[static_cast<std::size_t>(v)]);
    }
  for (std::int32_t t = 0; t < 18; ++t) soup.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  const MeshData before = soup;
  check_and_repair(soup, "m");
  expect_bit_equal(soup, before);
  EXPECT_EQ(joined_notes(soup),
            "m: no two neighbouring triangles share vertices, so the sheet is read as cut open along all its 21 inner "
            "edges; merge equal vertices if that isn't meant|");
}

std::string scene_of(const std::string& more) {
  return "effect = \"e\"\ntruth = \"t\"\nduration = 0.1\n[integrator]\nstep = 0.01\n" + more;
}

/// What only the cut or the run finds out.
TEST_F(BadInput, MethodsThatDoNotFit) {
  write_mesh(make_sheet("delaunay", 4), folder_ / "irregular.off");
  expect({"cut --method cisamr --mesh irregular.off --path path.json --out out.obj", 2, "cisamr refuses this cut: "});
  write(folder_ / "of_a_file.toml", scene_of("[sheet]\nfile = \"sheet.off\"\n"));
  expect(
      {"simulate of_a_file.toml --resolution 200", 2, "this scene's sheet is read from a file; leave the option out"});

  // In a scene the sheet goes on moving without that cut; the program says so, and that it fell short.
  const std::string cut = "[[cuts]]\ntime = 0\npolyline = [[0.2, 0.3], [0.8, 0.6]]\n[sheet]\nresolution = 200\n";
  write(folder_ / "explicit.toml", scene_of("name = \"symplectic_euler\"\n" + cut));
  write(folder_ / "sweeps.toml", scene_of("name = \"xpbd\"\n" + cut));
  write(folder_ / "bent.toml", scene_of(cut + "[material]\nbending = 1e-4\n[physics]\nbending = \"patches\"\n"));
  for (const auto& [arguments, message] :
       {std::pair{"explicit.toml --method split_and_tie", "symplectic_euler does not take"},
        std::pair{"sweeps.toml --method cut_polygons", "xpbd does not take"},
        std::pair{"bent.toml --method phantom_node", "phantom nodes do not bend; set bending to none"}}) {
    const Result result = run(std::string("simulate ") + arguments);
    EXPECT_EQ(result.code, 1) << result.error;
    EXPECT_NE(result.out.find("cut: refused"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find(message), std::string::npos) << result.out;
  }
}

TEST_F(BadInput, ASceneThatFailsBeforeItsCut) {
  write(folder_ / "stalls.toml", scene_of("[sheet]\nresolution = 200\n[physics]\ngravity = [0.0, 1.0, 0.0]\n"
                                          "[solver]\ntolerance = 1e-15\nmax_iterations = 1\n"));
  write(folder_ / "e.toml", small_experiment("scene = \"stalls.toml\"\ncut_time = 0.05\n"));
  const Result result = run("run e.toml --out r");
  EXPECT_EQ(result.code, 2) << result.error;
  EXPECT_NE(result.error.find("stalls: the scene fails before its cut (solver_stalled"), std::string::npos)
      << result.error;
}

/// One linear solve per step, far too long for a sheet as stiff as that.
TEST_F(BadInput, ASceneThatGainsEnergy) {
  write(folder_ / "gains.toml",
        "effect = \"e\"\ntruth = \"t\"\nduration = 1.0\n[integrator]\nstep = 0.04\n"
        "[sheet]\nresolution = 200\n[material]\nstiffness = 1e5\ndensity = 0.2\n"
        "[solver]\nname = \"cholmod\"\n[physics]\ngravity = [0.0, 0.0, -10.0]\n"
        "[[pins]]\nbox = [[-inf, -inf], [0.0, inf]]\n");
  for (const std::string more : {"", " --frames f"}) {
    const Result result = run("simulate gains.toml" + more);
    EXPECT_EQ(result.code, 1) << result.error;
    EXPECT_NE(result.out.find("energy_growth at "), std::string::npos) << result.out;
  }
}

TEST(Context, ASeedOfTheCommitWantsACommit) {
  expect_refused([] { seed_of_commit({}); }, "neither .git nor an archived commit number; give a number instead");
}

TEST_F(BadInput, Experiments) {
  const auto experiment = [this](const std::string& text) {
    write(folder_ / "e.toml", text);
    const std::string what = error_of([&] { read_experiment(folder_ / "e.toml"); });
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
    return what;
  };
  const std::string text = small_experiment();
  const auto with = [&](const std::string& part, const std::string& instead) {
    std::string changed = text;
    return changed.replace(changed.find(part), part.size(), instead);
  };
  ASSERT_EQ(experiment(text), "no InputError");
  ASSERT_EQ(experiment(text + "eigenvalue_cases = 0\n"), "no InputError");  // the default
  const std::string head = "claim = \"c\"\nsheets = [\"grid\"]\nresolutions = [200]\nmethods = [\"example\"]\n";
  const std::string campaign = head + "[campaign]\n", accuracy = head + "[accuracy]\n";
  ASSERT_EQ(experiment(campaign), "no InputError");
  ASSERT_EQ(experiment(accuracy + "direct = [\"cholmod\"]\nmembers = [1]\n"), "no InputError");
  write(folder_ / "of_a_file.toml", scene_of("[sheet]\nfile = \"sheet.off\"\n"));
  write(folder_ / "of_a_family.toml", scene_of("[sheet]\nresolution = 200\n"));
  std::string deep = "claim = ";
  for (int i = 0; i < 1000000; ++i) deep += '[';
  for (const auto& [bad, message] : std::vector<std::pair<std::string, const char*>>{
           {"claim = 3\n" + text.substr(text.find('\n') + 1), "\"claim\" has a value of the wrong kind"},
           {text + "claim = \"again\"\n", "line"},
           {with("[200]", "200"), "\"resolutions\" must be a list"},
           {with("[200]", "[]"), "\"resolutions\" must be a list with at least one entry"},
           {with("[200]", "[\"200\"]"), "\"resolutions\" has an entry of the wrong kind"},
           {with("[200]", "[200, 200]"), "\"resolutions\" names something twice"},
           {with("[200]", "[-200]"), "resolution -200: a sheet has 2 n^2 triangles"},
           {with("[200]", "[0]"), "resolution 0"},
           {with("[200]", "[4294967496]"), "resolution 4294967496"},
           {with("[200]", "[2000000]"), "at most 1000000"},
           {with("\"grid\", \"delaunay\"", "\"grid\", \"grid\""), "\"sheets\" names something twice"},
           {with("\"grid\"", "\"gird\""), "sheet \"gird\" is not known; known are"},
           {with("\"curved\"", "\"curvy\""), "cut family \"curvy\" is not known; known are"},
           {with("\"curved\"", "\"recut\""), "\"cut_families\" names something twice"},
           {text + "eigenvalue_cases = -1\n", "\"eigenvalue_cases\" must be between 0 and 1000000"},
           {with("cases = 3", "cases = 0"), "\"cases\" must be between 1 and 1000000"},
           {with("cases = 3", "cases = 3.5"), "\"cases\" has a value of the wrong kind"},
           {with("cases = 3", "cases = 99999999999999999999"), "line 5"},
           {with("knob = [0, 1]", "knobs = [0, 1]"), "did you mean \"knob\""},
           {with("knob = [0, 1]", "knob = 1"), "\"knob\" must be a list"},
           {with("name = ", "name = 1, nam = "), "unknown key \"nam\""},
           {with("\"conventional_split\"", "3"),
            "an entry of \"methods\" is a name, {name = ..., knob = [...]} or {name = ..., command = ...}"},
           {text + "scene = \"none.toml\"\ncut_time = 0\n", "none.toml: can't be read"},
           {text + "scene = \"of_a_file.toml\"\ncut_time = 0\n", "\"scene\" has a sheet from a file"},
           {text + "scene = \"of_a_family.toml\"\ncut_time = 0.1\n", "\"cut_time\" must lie within the scene's"},
           {campaign + "mesh_files = [\"none.off\"]\n", "there is no file"},
           {accuracy + "direct = [\"gauss\"]\nmembers = [1]\n", "solver \"gauss\" is not known"},
           {accuracy + "problems = [\"none\"]\ndirect = [\"cholmod\"]\nmembers = [1]\n", "none"},
           {accuracy + "direct = [\"cholmod\"]\nmembers = [1, 2]\n", "\"members\" must be as many numbers as"},
           {accuracy + "direct = [\"cholmod\"]\nmembers = [0]\n", "\"members\" are whole numbers from 1 to"},
           {accuracy + "direct = [\"cholmod\"]\npreconditioners = [\"cg\"]\niterations = [0]\nmembers = [1]\n",
            "\"iterations\" are whole numbers from 1 to 1000000"},
           {text + "chord_tolerance = nan\n", "\"chord_tolerance\" must be positive"},
           {std::string("claim = \"\0\1\"", 12), "line 1"},
           {"\x7f"
            "ELF\x02\x01\xff\xfe",
            "line 1"},
           {deep, "line 1"}})
    EXPECT_NE(experiment(bad).find(message), std::string::npos) << bad.substr(0, 300) << "\nsays " << experiment(bad);
  for (std::size_t n = 0; n < text.find("methods"); ++n) EXPECT_NE(experiment(text.substr(0, n)), "no InputError") << n;

  // What only the program knows: methods, their knobs, and the command line.
  write(folder_ / "e.toml", text);
  write(folder_ / "twice.toml", with("[0, 1]", "[0, 0]")), write(folder_ / "knob.toml", with("[0, 1]", "[0, 0.5]"));
  write(folder_ / "knobless.toml", with("\"conventional_split\"", "{name = \"conventional_split\", knob = [1]}"));
  expect_all({{"run twice.toml --out r", 2, "method \"bowyer_watson\" is there twice with rounds=0"},
              {"run knob.toml --out r", 2, "rounds must be a whole number"},
              {"run knobless.toml --out r", 2, "method \"conventional_split\" has no knob"},
              {"run e.toml --out r --shard 1/2x", 2, "--shard 1/2x"},
              {"run e.toml --out r --seed -1", 2, "--seed -1: give a whole number"},
              {"run e.toml --out r --seed 1e30", 2, "--seed 1e30: give a whole number"},
              {"run e.toml --out r --methods peer", 2, "--methods peer is not in the experiment"},
              {"run e.toml --out r --sweeps vertex", 2, "--sweeps is for an experiment that has [[sweeps]]"},
              {"run e.toml --out r --cases 0", 2, "--cases"},
              {"run e.toml --out r --repetitions 0", 2, "--repetitions"}});
}

}  // namespace
}  // namespace cutbench
