// The suite: sheets and paths with the number of pieces that each must leave, to test programs that cut.
// The cases of tests/cases/catalogue first, then adversarial cuts, on twelve sheets in turn.
// usage: cutbench_suite_problems FOLDER PROBLEMS SEED     (by experiments/suite/problems)
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "harness/base/errors.h"
#include "harness/cases/adversarial.h"
#include "harness/cut/cut_all.h"
#include "harness/files/mesh_file.h"
#include "harness/files/path_file.h"
#include "harness/judge/assessment.h"
#include "harness/mesh/families.h"
#include "methods/registry.h"
#include "tests/catalogue.h"

namespace {

using namespace cutbench;

class SuiteProblems {
 public:
  SuiteProblems(const std::filesystem::path& folder, std::size_t wanted) : folder_(folder), wanted_(wanted) {
    for (const char* part : {"sheets", "paths"}) std::filesystem::create_directories(folder / part);
    list_.open(folder / "problems.csv");
    list_ << "id,sheet,path,family,cuts,expected_pieces\n";
  }

  bool is_full() const { return problems_ >= wanted_; }
  std::size_t problems() const { return problems_; }

  /// Leaves out what has no answer that `cutbench score` accepts: the split of the Delaunay kind finds one, or none is.
  void add(const std::string& id, const std::string& sheet_name, const Sheet& sheet, const std::string& family,
           const std::vector<Curve>& cuts) {
    if (is_full() || cuts.empty()) return;
    Sheet result = sheet;
    Locator locator(result);
    Cutter cutter;
    const MethodRow& row = find_method("conventional_split");
    if (cut_all(result, locator, cutter, cuts, *row.make(row.parameter.value), {}).status != Status::ok) return;
    const Assessment a = assess_result(sheet, result.to_mesh_data(), cuts, promises_of_everybody, {});
    if (!a.judgement.ok || a.judgement.pieces != a.judgement.expected_pieces) return;
    if (sheets_.insert(sheet_name).second) write_mesh(sheet.to_mesh_data(), folder_ / "sheets" / (sheet_name + ".obj"));
    write_path(cuts, folder_ / "paths" / (id + ".json"));
    list_ << id << ",sheets/" << sheet_name << ".obj,paths/" << id << ".json," << family << ',' << cuts.size() << ','
          << a.judgement.expected_pieces << '\n';
    ++problems_;
  }

 private:
  std::filesystem::path folder_;
  std::size_t wanted_, problems_ = 0;
  std::set<std::string> sheets_;
  std::ofstream list_;
};

void add_catalogue(SuiteProblems& problems) {
  for (const std::string& name : catalogue_names()) {
    std::size_t number = 0;
    for (const CatalogueMember& member : read_catalogue_case(name).members) try {
        const std::string id = name + (number++ == 0 ? "" : "_" + std::to_string(number));
        problems.add(id, id, Sheet(sheet_of(member)), "catalogue", cuts_of(member));
      } catch (const InputError&) {  // a case of bad input, which has no answer
      }
  }
}

void add_adversarial(SuiteProblems& problems, std::uint64_t seed) {
  std::vector<std::pair<std::string, Sheet>> sheets;
  for (const int resolution : {72, 200, 800})
    for (const char* family : {"grid", "alternating", "delaunay", "graded"})
      sheets.emplace_back(family + std::to_string(resolution), Sheet(make_sheet(family, squares_per_side(resolution))));
  for (std::size_t i = 0; !problems.is_full(); ++i) {
    const auto& [name, sheet] = sheets[i % sheets.size()];
    const AdversarialCase c = make_adversarial_case(seed, i / sheets.size(), sheet);
    problems.add(name + "_" + std::to_string(i / sheets.size()), name, sheet, c.family, c.cuts);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return std::fprintf(stderr, "usage: cutbench_suite_problems FOLDER PROBLEMS SEED\n"), 2;
  SuiteProblems problems(argv[1], std::stoul(argv[2]));
  add_catalogue(problems);
  std::fprintf(stderr, "%zu problems of the catalogue\n", problems.problems());
  add_adversarial(problems, std::stoull(argv[3]));
  return 0;
}
