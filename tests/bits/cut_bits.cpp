// Hashes of cuts, for builds by different compilers to be compared (tests/bits/compare).
// usage: cutbench_bits [each]   a line for each sheet and method; each: one for each cut
//
// A line: sheet, method, hash of the rest positions, deformed positions and triangles of all cuts, bit for bit. The
// method "-" is the sheet before any cut with all curves, so that a curve that differs is told from a cut that does.
#include <cinttypes>
#include <cstdint>
#include <cstdio>
#include <string>
#include <type_traits>
#include <vector>

#include "harness/cases/cut_families.h"
#include "harness/cut/cut_all.h"
#include "harness/mesh/families.h"
#include "methods/registry.h"

namespace cutbench {
namespace {

constexpr int triangles = 800;
constexpr std::size_t cases_of_family = 3;
constexpr std::uint64_t seed = 7;

/// FNV-1a over bytes.
class Hash {
 public:
  template <class T>
  void add(const std::vector<T>& values) {
    static_assert(std::has_unique_object_representations_v<T> || sizeof(T) % sizeof(double) == 0, "no padding");
    const auto* bytes = reinterpret_cast<const unsigned char*>(values.data());
    for (std::size_t i = 0; i < values.size() * sizeof(T); ++i) value_ = (value_ ^ bytes[i]) * 0x100000001B3u;
  }
  void add(const Sheet& sheet) {
    const MeshData data = sheet.to_mesh_data();
    add(data.rest);
    add(data.deformed);
    add(data.triangles);
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xCBF29CE484222325u;
};

struct Case {
  const char* family;
  std::size_t number;
  std::vector<Curve> curves;
};

std::vector<Case> cases_on(const Sheet& sheet) {
  std::vector<Case> cases;
  for (const char* family : cut_families())
    for (std::size_t i = 0; i < cases_of_family; ++i) cases.push_back({family, i, make_case(family, seed, i, sheet)});
  return cases;
}

void print(const std::string& what, const Hash& hash) {
  std::printf("%s %016" PRIx64 "\n", what.c_str(), hash.value());
}

void hash_curves(const Sheet& sheet, const char* sheet_name, const std::vector<Case>& cases, bool each) {
  Hash all;
  all.add(sheet);
  for (const Case& c : cases) {
    Hash one;
    for (const Curve& curve : c.curves) {
      all.add(curve.points);
      one.add(curve.points);
    }
    if (each) print(std::string(sheet_name) + " - " + c.family + " " + std::to_string(c.number), one);
  }
  print(std::string(sheet_name) + " -", all);
}

void hash_cuts(const Sheet& before, const char* sheet_name, const MethodRow& row, const std::vector<Case>& cases,
               bool each) {
  Hash all;
  for (const Case& c : cases) {
    Sheet sheet = before;
    Locator locator(sheet);
    Cutter cutter;
    const auto method = row.make(row.parameter.value);
    const CutRun run = cut_all(sheet, locator, cutter, c.curves, *method, {});
    all.add(sheet);
    if (!each) continue;
    Hash one;
    one.add(sheet);
    print(std::string(sheet_name) + " " + row.name + " " + c.family + " " + std::to_string(c.number) + " " +
              name_of(run.verdict),
          one);
  }
  print(std::string(sheet_name) + " " + row.name, all);
}

}  // namespace
}  // namespace cutbench

int main(int argc, char** argv) {
  using namespace cutbench;
  const bool each = argc > 1 && std::string(argv[1]) == "each";
  for (const char* name : sheet_families()) {
    const Sheet before(make_sheet(name, squares_per_side(triangles)));
    const std::vector<Case> cases = cases_on(before);
    hash_curves(before, name, cases, each);
    for (const MethodRow& row : all_methods()) hash_cuts(before, name, row, cases, each);
  }
}
