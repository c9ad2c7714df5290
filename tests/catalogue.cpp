#include "tests/catalogue.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>

#include "harness/base/conversions.h"
#include "harness/files/mesh_file.h"
#include "harness/files/path_file.h"
#include "harness/mesh/check_and_repair.h"
#include "harness/mesh/families.h"

namespace cutbench {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path folder = CUTBENCH_TEST_CASES "/catalogue";

void check_keys(const json& object, std::initializer_list<const char*> known, const std::string& where) {
  for (const auto& [key, value] : object.items())
    if (std::find(known.begin(), known.end(), key) == known.end()) throw InputError(where + ": unknown key " + key);
}

/// `c` moved `steps` representable numbers up or down.
double step(double c, int steps) {
  const double towards = std::copysign(std::numeric_limits<double>::infinity(), steps);
  for (int i = 0; i < std::abs(steps); ++i) c = std::nextafter(c, towards);
  return c;
}

/// How a member differs from what its file says.
struct Change {
  std::string label;
  double by = 0;
  int ulps = 0;
  double scale = 1, offset = 0;
};

std::vector<Change> changes_in(const json& document) {
  std::vector<Change> changes;
  for (const json& by : document.value("by", json::array())) changes.push_back({"by " + by.dump(), by});
  for (const json& ulps : document.value("by_ulps", json::array()))
    changes.push_back({"by " + ulps.dump() + " ulp", 0, ulps});
  for (const json& scale : document.value("scales", json::array()))
    changes.push_back({"scale " + scale.dump(), 0, 0, scale});
  for (const json& offset : document.value("offsets", json::array()))
    changes.push_back({"offset " + offset.dump(), 0, 0, 1, offset});
  if (changes.empty()) changes.emplace_back();
  return changes;
}

/// The text of a path file: the case's cuts without `nudge`, and with the change.
std::string path_text_of(const json& cuts, const Change& change) {
  json changed = cuts;
  for (json& cut : changed) {
    const json nudge = cut.value("nudge", json::array());
    cut.erase("nudge");
    for (const char* kind : {"polyline", "bezier"}) {
      if (!cut.contains(kind)) continue;
      for (std::size_t i = 0; i < cut[kind].size(); ++i)
        for (std::size_t axis = 0; axis < 2; ++axis) {
          double c = cut[kind][i][axis];
          if (i < nudge.size()) {
            const double n = nudge[i][axis];
            c = step(c + change.by * n, change.ulps * to_int(n));
          }
          cut[kind][i][axis] = change.scale * c + change.offset;
        }
    }
  }
  return json{{"cuts", changed}}.dump();
}

CatalogueCase read_case(const fs::path& file) {
  std::ifstream in(file);
  const json document = json::parse(in);
  check_keys(document,
             {"about", "source", "sheet", "cuts", "path_text", "by", "by_ulps", "scales", "offsets", "chord_tolerance",
              "rounds", "expect"},
             "the file");
  check_keys(document.at("expect"),
             {"status", "pieces", "new_vertices", "incision_error", "path_error", "sheet_error", "note",
              "forced_corners", "worst_is_forced", "reason", "methods"},
             "expect");
  CatalogueCase result;
  result.name = file.stem().string();
  result.about = document.at("about");
  result.source = document.at("source");
  result.chord_tolerance = document.value("chord_tolerance", std::numeric_limits<double>::quiet_NaN());
  result.rounds = document.value("rounds", std::vector<int>{0, 1, 3});
  result.expect = document.at("expect");
  for (const Change& change : changes_in(document)) {
    const std::string path = document.contains("path_text") ? document.at("path_text").get<std::string>()
                                                            : path_text_of(document.at("cuts"), change);
    result.members.push_back({change.label, document.at("sheet"), path, change.scale, change.offset});
  }
  return result;
}

/// `copies` of the sheet side by side, each `apart` from the one before.
MeshData repeated(const MeshData& one, std::size_t copies, double apart) {
  MeshData all;
  for (std::size_t copy = 0; copy < copies; ++copy) {
    const auto first = to_int32(all.rest.size());
    for (Point2 p : one.rest) all.rest.push_back({p.x + to_double(copy) * apart, p.y});
    for (const auto& [a, b, c] : one.triangles) all.triangles.push_back({first + a, first + b, first + c});
  }
  return all;
}

MeshData unchecked_sheet(const json& sheet) {
  if (sheet.contains("family")) {
    check_keys(sheet, {"family", "n", "copies", "apart"}, "sheet");
    return repeated(make_sheet(sheet.at("family"), sheet.at("n")), sheet.value("copies", std::size_t{1}),
                    sheet.value("apart", 0.0));
  }
  check_keys(sheet, {"rest", "triangles"}, "sheet");
  MeshData mesh;
  for (const json& p : sheet.at("rest")) mesh.rest.push_back({p.at(0), p.at(1)});
  mesh.triangles = sheet.at("triangles");
  return mesh;
}

}  // namespace

json CatalogueCase::expect_of(const std::string& method) const {
  json result = expect;
  result.erase("methods");
  if (expect.contains("methods") && expect["methods"].contains(method)) result.merge_patch(expect["methods"][method]);
  return result;
}

std::vector<std::string> catalogue_names() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

CatalogueCase read_catalogue_case(const std::string& name) {
  const fs::path file = folder / (name + ".json");
  try {
    return read_case(file);
  } catch (const std::exception& error) {
    throw InputError(file.string() + ": " + error.what());
  }
}

MeshData sheet_of(const CatalogueMember& member) {
  if (member.sheet.is_string()) return read_mesh(folder / member.sheet.get<std::string>());
  MeshData mesh = unchecked_sheet(member.sheet);
  for (Point2& p : mesh.rest) p = {member.scale * p.x + member.offset, member.scale * p.y + member.offset};
  mesh.deformed.clear();
  for (Point2 p : mesh.rest) mesh.deformed.push_back({p.x, p.y, 0});
  check_and_repair(mesh, "the sheet");
  return mesh;
}

std::vector<Curve> cuts_of(const CatalogueMember& member) {
  std::string folder_name = (fs::temp_directory_path() / "cutbench_XXXXXX").string();
  if (!mkdtemp(folder_name.data())) throw std::runtime_error("no temporary folder");
  const fs::path file = fs::path(folder_name) / "path.json";
  std::ofstream(file) << member.path_text;
  std::vector<Curve> cuts;
  std::string error;
  try {
    cuts = read_path(file);
  } catch (const InputError& e) {
    error = e.what();
  }
  fs::remove_all(folder_name);
  if (!error.empty()) throw InputError(error);
  return cuts;
}

}  // namespace cutbench
