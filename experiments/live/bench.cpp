// The same work in this build and in another: hashes of a motion with cuts, or times. tests/live/check and
// experiments/live/times run both.
// usage: live_bench motion   a line for each method: hash of all positions after 600 steps with three cuts
//        live_bench times    ms of warm cuts and of steps, the least of several rounds; a line for each
//        live_bench verdicts FILE   the oracle's verdicts on the cases in FILE (tests/live/catalogue_cases.cpp)
#include <algorithm>
#include <chrono>
#include <cinttypes>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <fstream>
#include <limits>
#include <string>

#include "experiments/live/judged.h"
#include "experiments/live/live_sheet.h"
#include "experiments/live/scene_json.h"
#include "harness/base/errors.h"
#include "harness/judge/judged_sheet.h"
#include "harness/mesh/check_and_repair.h"
#include "harness/mesh/mesh_text.h"
#include "harness/path/path_text.h"
#include "methods/registry.h"

using namespace cutbench;
using nlohmann::json;

namespace {

constexpr double usual = std::numeric_limits<double>::quiet_NaN();
const Curve first{Curve::Kind::bezier, false, {{0.25, 0.3}, {0.9, 0.2}, {0.9, 0.8}, {0.25, 0.7}}};
const Curve second{Curve::Kind::bezier, false, {{0.17, 0.46}, {0.4, 0.62}, {0.6, 0.38}, {0.83, 0.55}}};
const Curve third{Curve::Kind::polyline, false, {{0.5, -0.05}, {0.51, 0.35}}};

double milliseconds() {
  using namespace std::chrono;
  return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

Scene scene(int triangles) { return live::scene_of({{"triangles", triangles}}); }

std::uint64_t hash(std::span<const double> numbers) {
  std::uint64_t value = 0xCBF29CE484222325u;
  const auto* bytes = reinterpret_cast<const unsigned char*>(numbers.data());
  for (std::size_t i = 0; i < numbers.size_bytes(); ++i) value = (value ^ bytes[i]) * 0x100000001B3u;
  return value;
}

void motion() {
  for (const MethodRow& row : all_methods()) {
    live::LiveSheet sheet(scene(800));
    sheet.step(60);
    for (const Curve& curve : {first, second, third}) {
      sheet.cut(row.name, usual, {curve});
      sheet.step(180);
    }
    double sum = 0;
    for (const double x : sheet.positions()) sum += x * x;
    std::printf("%s %016" PRIx64 " %.15g%s\n", row.name.c_str(), hash(sheet.positions()), std::sqrt(sum),
                sheet.fault().empty() ? "" : " stopped");
  }
}

double step_time(live::LiveSheet& sheet) {
  double least = 1e300;
  for (int round = 0; round < 8; ++round) {
    const double from = milliseconds();
    sheet.step(15);
    least = std::min(least, (milliseconds() - from) / 15);
  }
  return least;
}

void times() {
  for (const int triangles : {800, 3200, 12800}) {
    for (const char* method :
         {"conventional_split", "bowyer_watson", "warp_and_refine", "cut_polygons", "adaptive_remesh"}) {
      double least = 1e300;
      for (int round = 0; round < 5; ++round)
        least = std::min(least, live::timed(scene(triangles), method, usual, {first})["ms"].get<double>());
      std::printf("cut %s %d %.4f\n", method, triangles, least);
    }
    live::LiveSheet sheet(scene(triangles));
    sheet.step(30);
    std::printf("step uncut %d %.4f\n", triangles, step_time(sheet));
    sheet.cut("warp_and_refine", usual, {first});
    std::printf("step warp_and_refine %d %.4f\n", triangles, step_time(sheet));
  }
}

void judge(const std::string& name, const Sheet& sheet, const std::vector<Curve>& curves, const CutOptions& options,
           const MethodRow& row) {
  JudgedSheet judged(sheet, row.promises, row.make(row.parameter.value));
  std::printf("%s, %s:", name.c_str(), row.name.c_str());
  for (const Curve& curve : curves) {
    JudgedSheet::Finding finding;
    try {
      finding = judged.cut(curve, options);
    } catch (const std::exception& e) {
      std::printf(" %s", e.what());
      break;
    }
    std::printf(" %s %s %d of %d;", name_of(judged.outcome.status), name_of(finding.verdict), judged.judgement.pieces,
                judged.judgement.expected_pieces);
    if (!finding.ok()) break;
  }
  std::printf("\n");
}

void verdicts(const char* file) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const json j = json::parse(line);
    const std::string name = j.at("name");
    MeshData mesh = read_obj(j.at("obj").get<std::string>(), name);
    check_and_repair(mesh, name);
    CutOptions options;
    if (j.contains("chord")) options.chord_tolerance = j.at("chord").is_null() ? HUGE_VAL : j.at("chord").get<double>();
    try {
      const auto curves = read_path_text(j.at("path"), name);
      for (const MethodRow& row : all_methods()) judge(name, Sheet(mesh), curves, options, row);
    } catch (const InputError& e) {
      std::printf("%s: %s\n", name.c_str(), e.what());
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc >= 2 ? argv[1] : "";
  if (what == "motion")
    motion();
  else if (what == "times")
    times();
  else if (what == "verdicts" && argc == 3)
    verdicts(argv[2]);
  else
    return 2;
  return 0;
}
