// A thousand small cuts in a row on one sheet, by every method: failures, what a crossed triangle costs at the start
// and at the end, whether that is for the cuts made before or for what they left of the sheet, and whether the memory
// is the mesh's.
#include <malloc.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <limits>
#include <span>

#include "experiments/program/options.h"
#include "harness/base/conversions.h"
#include "harness/cases/cut_families.h"
#include "harness/files/mesh_file.h"
#include "harness/files/path_file.h"
#include "harness/judge/oracle_request.h"
#include "harness/mesh/families.h"
#include "harness/records/context.h"
#include "harness/study/experiment.h"
#include "methods/registry.h"

namespace {

using namespace cutbench;

constexpr std::uint64_t seed = 1;
constexpr CutOptions options;

/// In use, large blocks included, which the C library maps by themselves.
double heap_bytes() {
  const auto info = mallinfo2();
  return to_double(info.uordblks) + to_double(info.hblkhd);
}

/// NaN of nothing.
double median(std::span<const double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::vector<double> sorted(values.begin(), values.end());
  const auto middle = sorted.begin() + std::ssize(sorted) / 2;
  std::nth_element(sorted.begin(), middle, sorted.end());
  return *middle;
}

bool is_sound(const Sheet& before, const Sheet& sheet, const Curve& curve, const Promises& promises) {
  return check(sheet).empty() &&
         oracle::judge(request_for(before, {&curve, 1}, promises, options, true), for_oracle(sheet)).ok;
}

void save(const Sheet& sheet, const Curve& curve, const std::filesystem::path& stem) {
  write_mesh(sheet.to_mesh_data(), stem.string() + ".obj");
  write_path({curve}, stem.string() + ".json");
}

/// A sheet with all that goes on from one cut to the next.
class CutSheet {
 public:
  explicit CutSheet(const MeshData& mesh) : sheet(mesh), locator_(sheet) {}
  CutOutcome cut(const Curve& curve, CuttingMethod& method) {
    const auto before = to_double(sheet.triangle_count());
    const CutOutcome outcome = cutter_.cut(sheet, locator_, curve, method, options);
    // A cut that meets next to nothing costs what it costs to be called.
    if (outcome.status != Status::ok || outcome.crossed_triangles < 20) return outcome;
    const auto units = to_double(outcome.crossed_triangles);
    cost.push_back(outcome.time_us.total() / units);
    made.push_back((to_double(sheet.triangle_count()) - before) / units);
    return outcome;
  }

  Sheet sheet;
  std::vector<double> cost, made;  ///< us and triangles added per crossed triangle, of cuts that cross 20 or more

 private:
  Locator locator_;
  Cutter cutter_;
};

constexpr std::size_t sample = 50;

double first_of(const std::vector<double>& all) { return median({all.data(), std::min(sample, all.size())}); }
double from(std::size_t first, const std::vector<double>& all) { return median(std::span(all).subspan(first)); }

/// Of the first cuts, made once more: a machine's speed drifts within minutes, and the last cuts have just been timed.
double first_cost(const MeshData& grid, std::size_t cuts, CuttingMethod& method) {
  CutSheet again(grid);
  for (std::size_t i = 0; i < cuts && again.cost.size() < sample; ++i)
    again.cut(make_small_cut(seed, i, again.sheet), method);
  return first_of(again.cost);
}

/// Prints the method's row; false where a cut failed or a result was wrong.
bool cut_in_a_row(const MethodRow& row, int n, std::size_t cuts, const std::string& folder) {
  // Bowyer-Watson without local split: each round would multiply the triangles.
  const auto make = [&row] { return row.make(row.name == "bowyer_watson" ? 0 : row.parameter.value); };
  const auto method = make();
  const MeshData grid = make_sheet("grid", n);
  const double heap_before = heap_bytes();
  CutSheet in_a_row(grid);
  const Sheet& sheet = in_a_row.sheet;
  std::size_t failed = 0, judged = 0, wrong = 0, refused = 0, crossed = 0;
  MeshData late;  // the sheet before the last tenth of the cuts, which are then made on it again
  std::vector<Curve> late_cuts;
  std::size_t late_sample = 0;  // of its costs the first in the last tenth
  const std::size_t last_tenth = cuts - (cuts + 9) / 10;
  double late_bytes = 0;
  for (std::size_t i = 0; i < cuts; ++i) {
    if (i == last_tenth) {
      late_bytes = -heap_bytes();
      late = sheet.to_mesh_data();
      late_bytes += heap_bytes();
      late_sample = in_a_row.cost.size();
    }
    const Curve curve = make_small_cut(seed, i, sheet);
    if (i >= last_tenth) late_cuts.push_back(curve);
    const bool judge = i % 250 == 249 || i + 1 == cuts;
    const Sheet before = judge ? sheet : Sheet();
    const CutOutcome outcome = in_a_row.cut(curve, *method);
    if (outcome.status == Status::failed) {
      ++failed;
      std::cerr << row.name << ", cut " << i << ": " << outcome.verdict << ": " << outcome.reason << '\n';
      if (!folder.empty()) save(sheet, curve, std::filesystem::path(folder) / (row.name + std::to_string(i)));
    } else if (outcome.status == Status::refused) {
      ++refused;
    } else if (judge && ++judged && !is_sound(before, sheet, curve, row.promises)) {
      ++wrong;
      std::cerr << row.name << ", cut " << i << ": wrong\n";
      if (!folder.empty()) save(before, curve, std::filesystem::path(folder) / (row.name + std::to_string(i)));
    }
    crossed += outcome.crossed_triangles;
  }
  const double heap_after = heap_bytes();
  CutSheet again(late);
  const auto same_method = make();
  for (const Curve& curve : late_cuts) failed += again.cut(curve, *same_method).status == Status::failed;
  std::printf("%-20s %7zu %7zu %6zu %6zu %8zu %9zu", row.name.c_str(), failed, refused, judged, wrong, crossed,
              sheet.triangle_count());
  const std::vector<double>& made = in_a_row.made;
  const auto triangles = to_double(sheet.triangle_count());
  const double bytes_anew = (heap_bytes() - heap_after) / to_double(again.sheet.triangle_count());
  const double first = first_cost(grid, cuts, *make()), last = from(late_sample, in_a_row.cost);
  std::printf(" %8.3f %8.3f %6.2f %8.3f %6.2f %6.2f %8.0f %8.0f\n", first, last, last / first, from(0, again.cost),
              first_of(made), from(late_sample, made), (heap_after - heap_before - late_bytes) / triangles, bytes_anew);
  std::fflush(stdout);
  return failed == 0 && wrong == 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const double load = load_average();
    int triangles = 12800;
    std::size_t cuts = 1000;
    std::vector<std::string> methods;
    std::string folder;
    Options app("A thousand small cuts in a row on one sheet, by every method");
    app.add_option("triangles", triangles, "of the uncut grid, 2 n^2").shows_default();
    app.add_option("cuts", cuts).shows_default().positive();
    app.add_option("--methods", methods, "these alone, comma-separated").comma_separated();
    app.add_option("--save", folder, "failing cuts in this folder, with the sheet before them").existing_folder();
    if (const auto exit = app.parse(argc, argv)) return *exit;
    const int n = squares_per_side(triangles);
    std::vector<MethodRow> rows;
    for (const std::string& name : methods) rows.push_back(find_method(name));
    if (rows.empty()) rows = all_methods();
    std::printf(
        "%zu cuts in a row on the grid of %d, chord tolerance %g h, seed %lu; every 250th and the last judged\n", cuts,
        2 * n * n, options.chord_tolerance, seed);
    std::printf("%-20s %7s %7s %6s %6s %8s %9s %8s %8s %6s %8s %6s %6s %8s %8s\n", "method", "failed", "refused",
                "judged", "wrong", "crossed", "triangles", "us first", "us last", "ratio", "us anew", "made", "last",
                "bytes", "B anew");
    bool ok = true;
    for (const MethodRow& row : rows) ok &= cut_in_a_row(row, n, cuts, folder);
    std::printf(
        "us: wall time of the geometry per crossed triangle; made: triangles added per crossed triangle; both medians "
        "of "
        "cuts that cross 20 "
        "or more, the first 50 and those in the last tenth (nan: none); the first are timed right after the last, on a "
        "sheet of their own\nbytes: heap per triangle in the end\nanew: the same, where the last tenth of the cuts is "
        "made once more on a sheet begun anew with the mesh before them: what history costs\n");
    std::fputs(busy_note(load).c_str(), stderr);
    return ok ? 0 : 1;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 2;
  }
}
