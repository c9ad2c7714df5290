// `cutbench score` as the author of another program meets it: its numbers, what it finds, what it refuses.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <set>

#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/files/path_file.h"
#include "harness/mesh/families.h"
#include "harness/path/curve.h"
#include "methods/registry.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string read(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write(const fs::path& file, const std::string& text) { std::ofstream(file) << text; }

/// The edge from corner k of a triangle.
struct Edge {
  std::size_t triangle, k;
};

class Score : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / ("cutbench_score_" + std::string(info->name()) + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  int run(const std::string& arguments) {
    const std::string command =
        "cd '" + folder_.string() + "' && '" CUTBENCH_PROGRAM "' " + arguments + " >stdout 2>stderr";
    const int status = std::system(command.c_str());
    out_ = read(folder_ / "stdout");
    error_ = read(folder_ / "stderr");
    return WEXITSTATUS(status);
  }
  int cut(const std::string& method) {
    return run("cut --mesh sheet.obj --path path.json --out out.obj --report cut.json --allow-miss --method " + method);
  }
  int score(const std::string& result, const std::string& more = "") {
    return run("score --mesh sheet.obj --path path.json --report score.json --result " + result + " " + more);
  }
  /// Exit code 1 and this verdict, first on stdout, in every problem line's place and in the report.
  void expect_verdict(const MeshData& result, const std::string& verdict, const std::string& more = "") {
    write_mesh(result, folder_ / "result.obj");
    EXPECT_EQ(score("result.obj", more), 1) << error_;
    EXPECT_EQ(out_.substr(0, out_.find('\n')), "failed: " + verdict) << out_;
    EXPECT_NE(out_.find('\n' + verdict + ": "), std::string::npos) << out_;
    const json report = json::parse(read(folder_ / "score.json"));
    EXPECT_EQ(report["verdict"], verdict);
    EXPECT_EQ(report["problems"][0].get<std::string>().find(verdict + ": "), 0u);
  }
  void expect_ok(const MeshData& result, const std::string& more = "") {
    write_mesh(result, folder_ / "result.obj");
    EXPECT_EQ(score("result.obj", more), 0) << out_ << error_;
    EXPECT_EQ(out_.substr(0, out_.find('\n')), "ok");
  }
  /// Exit code 2, one line that says `what`, and nothing written.
  void expect_refused(const std::string& arguments, const std::string& what) {
    fs::remove(folder_ / "score.json");
    EXPECT_EQ(run("score " + arguments), 2) << out_;
    EXPECT_EQ(std::count(error_.begin(), error_.end(), '\n'), 1) << error_;
    EXPECT_NE(error_.find(what), std::string::npos) << error_;
    EXPECT_EQ(out_, "");
    EXPECT_FALSE(fs::exists(folder_ / "score.json"));
  }

  /// A bent sheet of 128 triangles, the paper's grid in rest space, cut by `method` along the path.
  MeshData make_result(const std::vector<Curve>& path, const std::string& method) {
    sheet_ = lifted(make_sheet("grid", 8));
    write_mesh(sheet_, folder_ / "sheet.obj");
    write_path(path, folder_ / "path.json");
    EXPECT_EQ(cut(method), 0) << error_;
    return read_mesh(folder_ / "out.obj");
  }

  fs::path folder_;
  MeshData sheet_;
  std::string out_, error_;
};

const std::vector<Curve> across{{Curve::Kind::bezier, false, {{-0.1, 0.3}, {0.3, 0.9}, {0.6, 0.1}, {1.1, 0.7}}}};
const std::vector<Curve> inside{{Curve::Kind::polyline, false, {{0.11, 0.34}, {0.52, 0.49}, {0.91, 0.37}}}};
const std::vector<Curve> outside{{Curve::Kind::polyline, false, {{1.5, 0}, {1.6, 1}}}};

Point2 rest(const MeshData& mesh, std::int32_t v) { return mesh.rest[to_size(v)]; }

/// The corners at every place of the rest plane, by the vertices they have there.
std::map<std::pair<double, double>, std::vector<std::int32_t>> vertices_by_place(const MeshData& mesh) {
  std::map<std::pair<double, double>, std::vector<std::int32_t>> result;
  for (std::size_t v = 0; v < mesh.rest.size(); ++v) result[{mesh.rest[v].x, mesh.rest[v].y}].push_back(to_int32(v));
  return result;
}

std::int32_t copy_vertex(MeshData& mesh, std::int32_t v) {
  mesh.rest.push_back(Point2(rest(mesh, v)));
  mesh.deformed.push_back(Point3(mesh.deformed[to_size(v)]));
  return to_int32(mesh.rest.size() - 1);
}

/// The mesh with vertex v called number[v]: several may get the same, and those without a triangle go.
MeshData renumbered(const MeshData& mesh, const std::vector<std::int32_t>& number) {
  MeshData result;
  std::vector<std::int32_t> final_number(mesh.rest.size(), -1);
  for (const auto& triangle : mesh.triangles) {
    auto& made = result.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      const auto v = to_size(number[to_size(triangle[k])]);
      if (final_number[v] < 0) {
        final_number[v] = to_int32(result.rest.size());
        result.rest.push_back(mesh.rest[v]);
        result.deformed.push_back(mesh.deformed[v]);
      }
      made[k] = final_number[v];
    }
  }
  return result;
}

/// With the vertices at the places for which `wanted` holds made one per place.
template <class Wanted>
MeshData welded(const MeshData& mesh, Wanted wanted) {
  std::vector<std::int32_t> number(mesh.rest.size());
  for (const auto& [place, vertices] : vertices_by_place(mesh))
    for (std::int32_t v : vertices)
      number[to_size(v)] = wanted(Point2{place.first, place.second}) ? vertices.front() : v;
  return renumbered(mesh, number);
}

/// The triangle of the lower right square of the grid, far from every path here, whose first edge from `k` on lies on
/// the line y = 1/8 and is inside the sheet.
Edge level_edge(const MeshData& mesh) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& triangle = mesh.triangles[t];
      const Point2 a = rest(mesh, triangle[k]), b = rest(mesh, triangle[(k + 1) % 3]);
      if (a.y == 0.125 && b.y == 0.125 && a.x < b.x && a.x == 0.75) return {t, k};
    }
  throw std::logic_error("no such edge");
}

/// An edge of the incision, on one lip, in the middle of the sheet.
Edge lip_edge(const MeshData& mesh) {
  const auto places = vertices_by_place(mesh);
  std::set<std::pair<std::int32_t, std::int32_t>> edges;
  for (const auto& [a, b, c] : mesh.triangles) edges.insert({{a, b}, {b, c}, {c, a}});
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1) % 3];
      const Point2 p = rest(mesh, a), q = rest(mesh, b);
      if (p.x > 0.3 && p.x < 0.7 && !edges.contains({b, a}) && places.at({p.x, p.y}).size() == 2 &&
          places.at({q.x, q.y}).size() == 2)
        return {t, k};
    }
  throw std::logic_error("no such edge");
}

TEST_F(Score, AgreesWithTheReportOfEveryCut) {
  std::vector<NamedMesh> sheets{{"grid", make_sheet("grid", 9)}, {"delaunay", lifted(make_sheet("delaunay", 12))}};
  for (const auto& [name, mesh] : sheets) {
    write_mesh(mesh, folder_ / "sheet.obj");
    for (const char* family : {"curved", "several", "cut_out", "self_crossing", "u_turn", "along_edges"}) {
      write_path(make_case(family, 5, 1, Sheet(mesh)), folder_ / "path.json");
      for (const auto& row : all_methods()) {
        // `score` asks everybody for the exact incision, and here for the old vertices, too.
        if (!row.promises.exact_incision || !row.promises.keeps_vertices) continue;
        ASSERT_EQ(cut(row.name), 0) << error_;
        EXPECT_EQ(score("out.obj", "--keeps-vertices"), 0) << name << ' ' << family << ' ' << row.name << out_;
        const json by_cut = json::parse(read(folder_ / "cut.json")), scored = json::parse(read(folder_ / "score.json"));
        EXPECT_EQ(scored["problems"], json::array());
        for (const char* key : {"verdict", "pieces", "vertices_added", "deformed_vertices_added", "triangles_added",
                                "ar_max_all", "ar_p99_cut", "angle_min_deg_cut", "altitude_min_h_all", "over_3_cut",
                                "forced_corners", "wedge_triangles", "wedge_area_rest2"})
          EXPECT_EQ(scored.at(key), by_cut.at(key)) << key << ' ' << name << ' ' << family << ' ' << row.name;
        // Several cuts `cut` judges one by one, each sampled by itself.
        EXPECT_NEAR(scored["incision_error_h"], by_cut["incision_error_h"], 1e-4);
        EXPECT_NEAR(scored["area_change"], by_cut["area_change"], 1e-12);
      }
    }
  }
}

/// Vertices and triangles in another order, triangles begun at another corner: what other programs make of a mesh.
TEST_F(Score, DoesNotDependOnNumbers) {
  const MeshData result = make_result(across, "conventional_split");
  expect_ok(result, "--keeps-vertices");
  const json before = json::parse(read(folder_ / "score.json"));
  MeshData other = result;
  std::reverse(other.triangles.begin(), other.triangles.end());
  for (auto& triangle : other.triangles) std::rotate(triangle.begin(), triangle.begin() + 1, triangle.end());
  std::vector<std::int32_t> number(other.rest.size());
  std::iota(number.begin(), number.end(), 0);
  other = renumbered(other, number);
  expect_ok(other);
  const json after = json::parse(read(folder_ / "score.json"));
  for (const std::string over : {"_all", "_cut"})  // another corner first, sums in another order: other roundings
    for (const std::string measure : {"ar_max", "ar_mean", "ar_p99", "angle_min_deg", "angle_max_deg"}) {
      const double expected = before.at(measure + over);
      EXPECT_NEAR(after.at(measure + over), expected, 1e-12 * expected) << measure << over;
    }
  EXPECT_EQ(after.at("forced_corners"), before.at("forced_corners"));
  EXPECT_EQ(after["pieces"], before["pieces"]);
  expect_verdict(other, "moved_vertex", "--keeps-vertices");
}

TEST_F(Score, ReadsRestPositionsFromAPlane) {
  write(folder_ / "path.json", R"({"cuts":[{"polyline":[[-1,0.5],[2,0.5]]}]})");
  write(folder_ / "sheet.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
  const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0.5 0\n0.5 0.5 0\n1 0.5 0\n0 0.5 0\n0.5 0.5 0\n1 0.5 0\n";
  const std::vector<std::array<int, 3>> triangles{{0, 1, 5}, {0, 5, 4}, {1, 6, 5}, {8, 9, 2}, {8, 2, 3}, {7, 8, 3}};
  std::string obj, off = "OFF\n10 6 0\n" + vertices;
  std::istringstream lines(vertices);
  for (std::string line; std::getline(lines, line);) obj += "v " + line + "\r\n";
  for (const auto& [a, b, c] : triangles) {
    std::ostringstream relative, plain;
    relative << "f " << a - 10 << "//1 " << b - 10 << "//1 " << c - 10 << "//1\r\n";
    plain << "3 " << a << ' ' << b << ' ' << c << '\n';
    obj += relative.str();
    off += plain.str();
  }
  write(folder_ / "result.obj", obj);
  write(folder_ / "result.off", off);
  for (const char* result : {"result.obj", "result.off"}) {
    EXPECT_EQ(score(result), 0) << out_ << error_;
    EXPECT_EQ(json::parse(read(folder_ / "score.json"))["pieces"], 2);
  }
}

TEST_F(Score, NothingToCutIsOk) {
  make_result(outside, "conventional_split");
  expect_ok(sheet_, "--keeps-vertices");
  const json report = json::parse(read(folder_ / "score.json"));
  EXPECT_EQ(report["triangles_added"], 0);
  EXPECT_EQ(report["pieces"], 1);
  EXPECT_EQ(report.at("incision_error_h"), 0);
  EXPECT_NE(out_.find("changed triangles: 0"), std::string::npos) << out_;
}

/// The incision's chords and the path inclose slivers, which an incision beside the path lacks: score says so.
TEST_F(Score, SaysWhyAnotherNumberOfPiecesIsRight) {
  const MeshData result = make_result(across, "conventional_split");
  expect_ok(result);
  EXPECT_EQ(out_.find("are right, too"), std::string::npos) << out_;
  write_mesh(result, folder_ / "sheet.obj");  // cut again along the same path
  expect_ok(result);
  const json report = json::parse(read(folder_ / "score.json"));
  EXPECT_EQ(report["pieces"], 2);
  const int expected = report["expected_pieces"];
  ASSERT_GT(expected, 2);
  EXPECT_NE(out_.find("\n2 pieces instead of " + std::to_string(expected) + " are right, too: "), std::string::npos)
      << out_;
}

class Fault : public Score, public testing::WithParamInterface<std::size_t> {
 protected:
  void SetUp() override {
    Score::SetUp();
    // The path goes right across, so that every fault but the last is in a sheet of two pieces.
    result_ = make_result(across, all_methods()[GetParam()].name);
    expect_ok(result_, "--keeps-vertices");
    edge_ = level_edge(result_);
    lip_ = lip_edge(result_);
  }
  std::array<std::int32_t, 3>& triangle(const Edge& e) { return result_.triangles[e.triangle]; }
  std::int32_t& corner(const Edge& e, std::size_t step = 0) { return triangle(e)[(e.k + step) % 3]; }
  std::size_t vertex(const Edge& e, std::size_t step = 0) { return to_size(corner(e, step)); }
  std::int32_t other_lip() {
    const Point2 p = rest(result_, corner(lip_));
    const auto both = vertices_by_place(result_).at({p.x, p.y});
    return both[0] == corner(lip_) ? both[1] : both[0];
  }

  MeshData result_;
  Edge edge_{}, lip_{};
};

TEST_P(Fault, FlippedTriangle) {
  std::swap(triangle(edge_)[0], triangle(edge_)[1]);
  expect_verdict(result_, "inverted");
}

TEST_P(Fault, IndexOutOfRange) {
  corner(edge_) = to_int32(result_.rest.size());
  expect_verdict(result_, "bad_index");
  EXPECT_TRUE(json::parse(read(folder_ / "score.json")).at("ar_max_all").is_null());
  corner(edge_) = -1;  // 0 in the file
  expect_verdict(result_, "bad_index");
}

TEST_P(Fault, VertexTwiceInATriangle) {
  corner(edge_) = corner(edge_, 1);
  expect_verdict(result_, "bad_index");
}

TEST_P(Fault, VertexOfTheOtherLip) {
  corner(lip_) = other_lip();
  expect_verdict(result_, "non_manifold");
}

TEST_P(Fault, CornersOfTwoTrianglesSwapped) {
  std::swap(corner(edge_), corner(lip_));
  expect_verdict(result_, "inverted");
}

TEST_P(Fault, VertexOneUlpBehindAnEdge) {
  Point2& apex = result_.rest[vertex(edge_, 2)];
  const double level = 0.125;
  ASSERT_GT(apex.y, level);
  apex.y = level;
  expect_verdict(result_, "inverted");
  apex.y = std::nextafter(level, 0);
  expect_verdict(result_, "inverted");
}

TEST_P(Fault, LipMovedByOneUlp) {
  double& x = result_.rest[vertex(lip_)].x;
  x = std::nextafter(x, 2);
  expect_verdict(result_, "leak");
}

TEST_P(Fault, TriangleMissing) {
  result_.triangles.erase(result_.triangles.begin() + to_index(edge_.triangle));
  expect_verdict(result_, "leak");
}

TEST_P(Fault, TriangleTwice) {
  MeshData twice = result_;
  twice.triangles.push_back(triangle(edge_));
  expect_verdict(twice, "non_manifold");
  auto& again = result_.triangles.emplace_back(triangle(edge_));  // with its own vertices: an overlap
  for (std::int32_t& v : again) v = copy_vertex(result_, v);
  expect_verdict(result_, "leak");
}

TEST_P(Fault, UnsplitNeighbour) {
  const std::int32_t a = corner(edge_), b = corner(edge_, 1), c = corner(edge_, 2), middle = copy_vertex(result_, a);
  result_.rest.back() = 0.5 * (rest(result_, a) + rest(result_, b));
  triangle(edge_) = {a, middle, c};
  result_.triangles.push_back({middle, b, c});
  expect_verdict(result_, "leak");
}

TEST_P(Fault, UnopenedIncision) {
  expect_verdict(welded(result_, [](Point2) { return true; }), "wrong_pieces");
}

TEST_P(Fault, WeldedInOnePlace) {
  const Point2 p = rest(result_, corner(lip_));
  expect_verdict(welded(result_, [p](Point2 q) { return p == q; }), "non_manifold");
}

TEST_P(Fault, BridgeAcrossTheIncision) {
  const Point2 p = rest(result_, corner(lip_)), q = rest(result_, corner(lip_, 1));
  expect_verdict(welded(result_, [p, q](Point2 r) { return r == p || r == q; }), "wrong_pieces");
}

TEST_P(Fault, TriangleTornOff) {
  for (std::int32_t& v : triangle(edge_)) v = copy_vertex(result_, v);
  expect_verdict(result_, "wrong_pieces");
}

TEST_P(Fault, NotANumber) {
  MeshData lost = result_;
  lost.deformed[vertex(lip_)].z = std::nan("");
  expect_verdict(lost, "not_finite");
  result_.rest[vertex(edge_)].y = std::nan("");
  expect_verdict(result_, "not_finite");
  result_.rest[vertex(edge_)].y = -infinite;
  expect_verdict(result_, "not_finite");
}

TEST_P(Fault, FarAway) {
  for (const double far : {1e20, 1e155, 1e308}) {
    result_.rest[vertex(edge_)].x = far;
    expect_verdict(result_, "inverted");
  }
}

TEST_P(Fault, UnusedVertex) {
  copy_vertex(result_, corner(edge_));
  expect_verdict(result_, "unused_vertex");
}

TEST_P(Fault, MovedVertex) {
  double& x = result_.rest[vertex(edge_)].x;
  x = std::nextafter(x, 2);
  expect_ok(result_);
  expect_verdict(result_, "moved_vertex", "--keeps-vertices");
}

/// The path asked for is 1 % longer than what was cut, at one end; or the partial cut was never opened.
TEST_P(Fault, IncisionTooShort) {
  const auto& method = all_methods()[GetParam()].name;
  const MeshData result = make_result(inside, method);
  expect_ok(result);
  const auto& p = inside.front().points;
  const double length = std::sqrt(squared_length(p[1] - p[0])) + std::sqrt(squared_length(p[2] - p[1]));
  auto longer = inside;
  longer.front().points[2] = p[2] + 0.01 * length / std::sqrt(squared_length(p[2] - p[1])) * (p[2] - p[1]);
  write_path(longer, folder_ / "path.json");
  expect_verdict(result, "incision");
  EXPECT_NEAR(json::parse(read(folder_ / "score.json")).at("incision_error_h"),
              0.01 * length / Sheet(sheet_).mean_edge(), 1e-11);
  expect_ok(result, "--chord-tolerance 0.1");
  expect_verdict(welded(result, [](Point2) { return true; }), "incision", "--chord-tolerance inf");
}

/// Of the methods whose results are without fault by the standards of `score`.
std::vector<std::size_t> exact_methods() {
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < all_methods().size(); ++i)
    if (const Promises& p = all_methods()[i].promises; p.exact_incision && p.keeps_vertices) numbers.push_back(i);
  return numbers;
}

INSTANTIATE_TEST_SUITE_P(Methods, Fault, testing::ValuesIn(exact_methods()),
                         [](const auto& parameter) { return all_methods()[parameter.param].name; });

TEST_F(Score, BadInputIsRefused) {
  make_result(across, "conventional_split");
  write(folder_ / "empty.obj", "");
  write(folder_ / "curved.obj", "v 0 0 0\nv 1 0 1\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
  write(folder_ / "quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
  write(folder_ / "no_number.obj", "v 0 0 zero\nf 1 1 1\n");
  write(folder_ / "binary.obj", std::string("\0\1\2", 3));
  write(folder_ / "bad.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n");
  write(folder_ / "bad.json", "{}");
  const std::string files = "--mesh sheet.obj --path path.json --report score.json ";
  for (const auto& [result, what] : {std::pair<std::string, std::string>{"none.obj", "none.obj: no such file"},
                                     {"sheet.stl", "format"},
                                     {"empty.obj", "no triangles"},
                                     {"curved.obj", "no rest positions"},
                                     {"quad.obj", "4 corners"},
                                     {"no_number.obj", "'zero'"},
                                     {"binary.obj", "not a text file"},
                                     {"bad.off", "OFF"}})
    expect_refused(files + "--result " + result, what);
  expect_refused("--mesh none.obj --path path.json --result out.obj", "none.obj");
  expect_refused("--mesh curved.obj --rest vt --path path.json --result out.obj", "vt");
  EXPECT_EQ(run("score --mesh curved.obj --path path.json --result out.obj"), 2);
  EXPECT_NE(error_.find("path.json, cut 0: the sheet is unrolled, so places at rest mean nothing"), std::string::npos);
  expect_refused("--mesh sheet.obj --path none.json --result out.obj", "none.json");
  expect_refused("--mesh sheet.obj --path bad.json --result out.obj", "bad.json");
  expect_refused("--mesh sheet.obj --path path.json --result out.obj --report nowhere/s.json", "nowhere");
  expect_refused(files + "--result out.obj --chord-tolerance 0", "positive");
  expect_refused("--mesh sheet.obj --path path.json", "--result");
}

TEST_F(Score, FewDigitsWhereAskedFor) {
  MeshData result = make_result(inside, "conventional_split");
  for (Point2& p : result.rest) p = {std::round(1e7 * p.x) / 1e7, std::round(1e7 * p.y) / 1e7};
  expect_verdict(result, "rounded");
  EXPECT_NE(out_.find("--digits 8"), std::string::npos) << out_;
  expect_ok(result, "--keeps-vertices --digits 7");
  EXPECT_NE(out_.find("\nread with 7 digits: "), std::string::npos) << out_;
  EXPECT_EQ(json::parse(read(folder_ / "score.json"))["read"]["digits"], 7);
  expect_refused("--mesh sheet.obj --path path.json --result result.obj --report score.json --digits 0", "--digits 0");
}

}  // namespace
}  // namespace cutbench
