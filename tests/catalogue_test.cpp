// The catalogue of adversarial cases: each file of tests/cases/catalogue, cut by every method, comes out as it says.

#include "tests/catalogue.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <tuple>

#include "harness/base/conversions.h"
#include "harness/judge/assessment.h"
#include "harness/mesh/tolerances.h"
#include "harness/path/pick.h"
#include "methods/registry.h"
#include "tests/helpers.h"

namespace cutbench {
namespace {

using nlohmann::json;

/// Cases that don't come out as their files say they should, as "case" or "case, method", and why.
const std::map<std::string, std::string> known_failures{};

/// A case by one method with one value of its parameter.
struct Trial {
  const CatalogueCase& file;
  const MethodRow& row;
  double parameter;
  std::string method;  ///< with its parameter
};

std::vector<Trial> trials_of(const CatalogueCase& file, const MethodRow& row) {
  if (row.parameter.name != "rounds") return {{file, row, row.parameter.value, row.name}};
  std::vector<Trial> trials;
  for (int k : file.rounds) trials.push_back({file, row, to_double(k), row.name + "_" + std::to_string(k)});
  return trials;
}

/// `status` for all cuts, or a list with one for each.
std::string status_of(const json& expect, std::size_t cut) {
  const json& status = expect.at("status");
  return status.is_string() ? status : status.at(cut);
}

/// The error that reading must give is thrown; true where the case ends there.
template <class Read>
bool is_refused(const json& expect, const char* key, Read read) {
  try {
    read();
  } catch (const InputError& error) {
    const std::string what = error.what();
    if (!expect.contains(key)) {
      ADD_FAILURE() << "refused when read: " << what;
    } else {
      EXPECT_NE(what.find(expect[key].get<std::string>()), std::string::npos) << what;
    }
    EXPECT_EQ(what.find('\n'), std::string::npos) << "one line: " << what;
    return true;
  }
  EXPECT_FALSE(expect.contains(key)) << "read without an error";
  return expect.contains(key);
}

/// The audit excuses what the input forces, and says so.
void check_forced(const json& expect, const Sheet& before, const Sheet& after, const std::vector<Curve>& cuts) {
  const Assessment found = assess(before, after, {}, forced_corners_of(before, cuts));
  EXPECT_EQ(found.forced_corners, expect.at("forced_corners").get<std::size_t>());
  EXPECT_EQ(found.strict.ar_max < found.cut.ar_max, expect.at("worst_is_forced").get<bool>())
      << found.strict.ar_max << " without forced corners, " << found.cut.ar_max << " with them";
}

void run_member(const CatalogueMember& member, const Trial& trial, double chord) {
  const json expect = trial.file.expect_of(trial.method);
  const bool exact = trial.row.promises.exact_incision;
  MeshData mesh;
  if (is_refused(expect, "sheet_error", [&] { mesh = sheet_of(member); })) return;
  std::vector<Curve> cuts;
  const auto read_cuts = [&] {
    cuts = cuts_of(member);
    const std::vector<AnyCurve> path(cuts.begin(), cuts.end());
    cuts = curves_at_rest(path, Sheet(mesh), "path").curves;
  };
  if (is_refused(expect, "path_error", read_cuts)) return;
  std::string notes;
  for (const std::string& note : mesh.notes) notes += note + "\n";
  EXPECT_NE(notes.find(expect.value("note", "")), std::string::npos) << notes;
  EXPECT_EQ(notes.empty(), !expect.contains("note")) << notes;

  Table table(mesh, trial.row, trial.parameter);
  const Sheet uncut = table.sheet;
  bool whole = trial.row.promises.keeps_area;  // all of the sheet, and the method takes it
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    SCOPED_TRACE("cut " + std::to_string(i) + ": " + text_of(cuts[i]));
    const Sheet before = table.sheet;
    const bool refuses = table.why_unsupported().has_value();
    const std::string status = status_of(expect, i);
    std::string wrong = table.cut(cuts[i], chord);
    if (wrong == "deviated, ok: " + table.outcome.reason) wrong.clear();  // declared, and for the status to ask for
    whole &= !refuses;
    // A cut that was made elsewhere than asked for meets the next one elsewhere: there the oracle alone judges.
    if (!whole || (i > 0 && !exact)) {
      EXPECT_EQ(wrong, "");
      continue;
    }
    EXPECT_STREQ(name_of(table.outcome.status), status.c_str()) << wrong << table.outcome.reason;
    EXPECT_NE(table.outcome.reason.find(expect.value("reason", "")), std::string::npos) << table.outcome.reason;
    EXPECT_EQ(table.outcome.reason.find('\n'), std::string::npos) << "one line: " << table.outcome.reason;
    if (status == "refused" || status == "failed") {
      EXPECT_EQ(difference(before, table.sheet), "");
      EXPECT_NE(table.outcome.reason, "");
      continue;
    }
    EXPECT_EQ(wrong, "");
    // What is nearer than twice the snap distance to an edge goes along it. A Bezier's error is the oracle's affair.
    const bool declared = cuts[i].kind == Curve::Kind::polyline && table.outcome.status == Status::ok;
    if (exact && (expect.contains("incision_error") || declared)) {
      EXPECT_LE(table.judgement.incision_error, expect.value("incision_error", line_tolerance * table.sheet.snap()));
    }
  }
  if (whole && (exact || cuts.size() == 1)) {
    EXPECT_EQ(table.judgement.pieces, expect.value("pieces", table.judgement.pieces));
  }
  if (!exact) return;
  if (trial.row.promises.keeps_vertices || cuts.size() == 1) {  // else a later cut meets another mesh
    EXPECT_EQ(table.embedded_vertices(), expect.value("new_vertices", table.embedded_vertices()));
  }
  if (expect.contains("forced_corners")) check_forced(expect, uncut, table.sheet, cuts);
}

/// Why a trial is left out; empty: it isn't.
std::string why_left_out(const Trial& trial) {
  for (const std::string& name : {trial.file.name, trial.file.name + ", " + trial.method})
    if (const auto known = known_failures.find(name); known != known_failures.end())
      return "known failure of " + trial.method + ": " + known->second + "\n";
  return {};
}

class Catalogue : public testing::TestWithParam<std::tuple<std::string, const MethodRow*>> {};

TEST_P(Catalogue, ComesOutAsStated) {
  const auto& [name, row] = GetParam();
  const CatalogueCase file = read_catalogue_case(name);
  std::vector<double> chords{file.chord_tolerance};
  if (std::isnan(chords[0])) chords = {0.05, infinite};
  std::string left_out;
  for (const Trial& trial : trials_of(file, *row)) {
    const std::string reason = why_left_out(trial);
    left_out += reason;
    if (!reason.empty()) continue;
    for (const CatalogueMember& member : file.members)
      for (double chord : chords) {
        SCOPED_TRACE(trial.method + ", " + member.label + ", chord tolerance " + std::to_string(chord));
        run_member(member, trial, chord);
      }
  }
  if (!left_out.empty()) GTEST_SKIP() << left_out;
}

std::vector<const MethodRow*> rows() {
  std::vector<const MethodRow*> result;
  for (const MethodRow& row : all_methods()) result.push_back(&row);
  return result;
}

INSTANTIATE_TEST_SUITE_P(Cases, Catalogue,
                         testing::Combine(testing::ValuesIn(catalogue_names()), testing::ValuesIn(rows())),
                         [](const auto& parameters) {
                           return std::get<0>(parameters.param) + "_by_" + std::get<1>(parameters.param)->name;
                         });

std::vector<CatalogueCase> all_cases() {
  std::vector<CatalogueCase> cases;
  for (const std::string& name : catalogue_names()) cases.push_back(read_catalogue_case(name));
  return cases;
}

/// The outcome that a file states, in words.
std::string outcome_in_words(const json& expect) {
  if (expect.contains("sheet_error")) return "sheet refused: " + expect["sheet_error"].get<std::string>();
  if (expect.contains("path_error")) return "path refused: " + expect["path_error"].get<std::string>();
  std::string words;
  const json& status = expect.at("status");
  if (status.is_string()) words = status;
  for (const json& s : status.is_string() ? json::array() : status)
    words += (words.empty() ? "" : ", ") + s.get<std::string>();
  if (expect.contains("pieces")) words += "; pieces " + expect["pieces"].dump();
  if (expect.contains("new_vertices")) words += "; new vertices " + expect["new_vertices"].dump();
  if (expect.contains("incision_error")) words += "; incision error <= " + expect["incision_error"].dump();
  if (expect.contains("forced_corners")) words += "; forced corners " + expect["forced_corners"].dump();
  if (expect.contains("worst_is_forced"))
    words += expect["worst_is_forced"] ? "; worst triangle excused" : "; worst triangle not excused";
  if (expect.contains("reason")) words += "; reason: " + expect["reason"].get<std::string>();
  if (expect.contains("note")) words += "; note: " + expect["note"].get<std::string>();
  return words;
}

std::string table_of(const std::vector<CatalogueCase>& cases) {
  std::string table;
  for (const CatalogueCase& file : cases) {
    table += "| " + file.name.substr(0, 3) + " | " + file.name.substr(4) + " | " + file.about + " | " + file.source +
             " | " + std::to_string(file.members.size()) + " | " + outcome_in_words(file.expect_of(""));
    if (file.expect.contains("methods"))
      for (const auto& [method, differs] : file.expect["methods"].items())
        table += "; **" + method + "**: " + outcome_in_words(file.expect_of(method));
    table += " |\n";
  }
  return table;
}

TEST(CatalogueTable, HasEveryRow) {
  const std::vector<std::string> names = catalogue_names();
  for (int row = 1; row <= 31; ++row) {
    char prefix[16];
    std::snprintf(prefix, sizeof prefix, "G%02d_", row);
    EXPECT_TRUE(std::any_of(names.begin(), names.end(), [&](const auto& name) { return name.starts_with(prefix); }))
        << "no case file for row " << prefix;
  }
}

/// CUTBENCH_WRITE_CATALOGUE=1 writes the table into the README instead.
TEST(CatalogueTable, IsInTheReadme) {
  const std::string readme = CUTBENCH_TEST_CASES "/catalogue/README.md", head = "|---|---|---|---|---|---|\n";
  std::ifstream in(readme);
  std::ostringstream text;
  text << in.rdbuf();
  const std::string shown = text.str();
  const std::size_t begin = shown.find(head) + head.size();
  ASSERT_NE(shown.find(head), std::string::npos);
  const std::string table = table_of(all_cases());
  if (std::getenv("CUTBENCH_WRITE_CATALOGUE")) {
    std::ofstream(readme) << shown.substr(0, begin) << table;
  } else {
    EXPECT_EQ(shown.substr(begin), table) << "write it anew: CUTBENCH_WRITE_CATALOGUE=1";
  }
}

/// A list of failures that nobody looks at must not grow stale.
TEST(CatalogueTable, KnownFailuresAreOfCasesThereAre) {
  std::set<std::string> names;
  for (const CatalogueCase& file : all_cases()) {
    names.insert(file.name);
    for (const MethodRow& row : all_methods())
      for (const Trial& trial : trials_of(file, row)) names.insert(file.name + ", " + trial.method);
  }
  for (const auto& [name, bug] : known_failures) EXPECT_TRUE(names.contains(name)) << name;
}

}  // namespace
}  // namespace cutbench
