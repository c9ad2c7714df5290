// Bad input on the command line: options, and places that can't be read from or written to.
#include <sys/stat.h>
#include <sys/sysmacros.h>

#include "harness/files/mesh_file.h"
#include "harness/mesh/families.h"
#include "tests/bad_input.h"

namespace cutbench {
namespace {

const std::string good = "cut --method cgal_cdt --mesh sheet.off --path path.json --out out.obj";

std::string parameter(const std::string& method, const std::string& value) {
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
              {parameter("bowyer_watson", "rounds=0.5"), 2, "rounds must be a whole number from 0 to 6"},
              {parameter("cgal_refine", "bound=1"), 2, "bound must be 0, or a number from 2 to 1000"},
              {parameter("delaunay_refine", "bound=1001"), 2, "bound must be 0, or a number from 2 to 1000"},
              {parameter("longest_edge", "cap=101"), 2, "cap must be a number from 0 to 100"},
              {parameter("snap_or_split", "tolerance=0.6"), 2, "tolerance must be a number from 0 to 0.5"},
              {parameter("adaptive_remesh", "tip=0.05"), 2, "tip must be 0, or a number from 0.1 to 1"},
              {parameter("cut_polygons", "thinness=2"), 2, "thinness must be a number from 0 to 1"},
              {parameter("split_and_tie", "thinness=-1"), 2, "thinness must be a number from 0 to 0.3"},
              {parameter("vertex_snap", "reach=0.6"), 2, "reach must be a number from 0 to 0.5"},
              {parameter("active_node", "spacing=0.1"), 2, "spacing must be 0, or a number from 0.25 to 4"},
              {parameter("warp_and_refine", "reach=-1"), 2, "reach must be a number from 0 to 0.5"},
              {good + " --chord-tolerance 1x", 2, "\"1x\" is not a number"},
              {"simulate " + std::string(CUTBENCH_TEST_CASES) +
                   "/../../experiments/scenes/falling_piece.toml "
                   "--resolution -800",
               2, "--resolution"}});
}

TEST_F(BadInput, PlacesToReadFrom) {
  fs::create_directory(folder_ / "folder.obj");
  write(folder_ / "empty.off", "");
  write(folder_ / "empty.json", "");
  write(folder_ / "empty.toml", "");
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
  fs::create_directories(folder_ / "folder.obj");
  fs::create_directory(folder_ / "r");
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

}  // namespace
}  // namespace cutbench
