// The cut zoo: sheets and paths with the number of pieces that each must leave, to test programs that cut.
// The cases of tests/cases/catalogue first, then cuts of the mixture, on twelve sheets in turn.
// usage: cutbench_zoo FOLDER PROBLEMS SEED     (by experiments/suite/zoo)
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>

#include "harness/base/errors.h"
#include "harness/cases/mixture.h"
#include "harness/cut/cut_all.h"
#include "harness/judge/assessment.h"
#include "harness/mesh/families.h"
#include "harness/mesh/mesh_io.h"
#include "methods/registry.h"
#include "tests/catalogue.h"

namespace {

using namespace cutbench;

class Zoo {
 public:
  Zoo(const std::filesystem::path& folder, std::size_t wanted) : folder_(folder), wanted_(wanted) {
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
    if (cut_all(result, locator, cutter, cuts, *row.make(row.knob.value), {}).status != Status::ok) return;
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

void add_catalogue(Zoo& zoo) {
  for (const std::string& name : catalogue_names()) {
    std::size_t number = 0;
    for (const CatalogueMember& member : read_catalogue_case(name).members) try {
        const std::string id = name + (number++ == 0 ? "" : "_" + std::to_string(number));
        zoo.add(id, id, Sheet(sheet_of(member)), "catalogue", cuts_of(member));
      } catch (const InputError&) {  // a case of bad input, which has no answer
      }
  }
}

void add_mixture(Zoo& zoo, std::uint64_t seed) {
  std::vector<std::pair<std::string, Sheet>> sheets;
  for (const int resolution : {72, 200, 800})
    for (const char* family : {"grid", "alternating", "delaunay", "graded"})
      sheets.emplace_back(family + std::to_string(resolution), Sheet(make_sheet(family, squares_per_side(resolution))));
  for (std::size_t i = 0; !zoo.is_full(); ++i) {
    const auto& [name, sheet] = sheets[i % sheets.size()];
    const MixtureCase c = make_mixture_case(seed, i / sheets.size(), sheet);
    zoo.add(name + "_" + std::to_string(i / sheets.size()), name, sheet, c.family, c.cuts);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return std::fprintf(stderr, "usage: cutbench_zoo FOLDER PROBLEMS SEED\n"), 2;
  Zoo zoo(argv[1], std::stoul(argv[2]));
  add_catalogue(zoo);
  std::fprintf(stderr, "%zu problems of the catalogue\n", zoo.problems());
  add_mixture(zoo, std::stoull(argv[3]));
  return 0;
}
