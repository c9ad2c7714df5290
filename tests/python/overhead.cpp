// Arrays in, arrays out, in C++: what tests/python/measure.py compares cutbench.cut() with.
// usage: cutbench_python_overhead METHOD REPETITIONS < ARRAYS   prints the processor's microseconds of each repetition
// ARRAYS: three numbers (vertices, triangles, points of the polyline), and then theirs, as text.
#include <time.h>

#include <cstdio>
#include <iostream>
#include <string>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/cut/cut.h"
#include "harness/mesh/check_and_repair.h"
#include "methods/registry.h"

using namespace cutbench;

namespace {

double processor_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * to_double(now.tv_sec) + 1e-3 * to_double(now.tv_nsec);
}

/// What a Cut of Python holds.
struct Made {
  Sheet before, after;
  MeshData mesh, result;
};

Made cut(const std::vector<Point3>& vertices, const std::vector<std::array<std::int32_t, 3>>& triangles,
         const Curve& curve, const std::string& name) {
  Made made;
  made.mesh.deformed = vertices;
  made.mesh.triangles = triangles;
  check_and_repair(made.mesh, "sheet");
  made.before = Sheet(made.mesh);
  made.after = made.before;
  Locator locator(made.after);
  Cutter cutter;
  const MethodRow& row = find_method(name);
  const auto method = row.make(row.parameter.value);
  cutter.cut(made.after, locator, curve, *method, {});
  made.result = made.after.to_mesh_data();
  return made;
}

}  // namespace

int main(int, char** argv) {
  std::size_t n = 0, m = 0, k = 0;
  std::cin >> n >> m >> k;
  std::vector<Point3> vertices(n);
  std::vector<std::array<std::int32_t, 3>> triangles(m);
  Curve curve;
  curve.points.resize(k);
  for (auto& [x, y, z] : vertices) std::cin >> x >> y >> z;
  for (auto& [a, b, c] : triangles) std::cin >> a >> b >> c;
  for (auto& [x, y] : curve.points) std::cin >> x >> y;
  for (int i = 0; i < std::stoi(argv[2]); ++i) {
    const double start = processor_us();
    const Made made = cut(vertices, triangles, curve, argv[1]);
    const double us = processor_us() - start;
    std::printf("%.3f %zu\n", us, made.result.triangles.size());
  }
}
