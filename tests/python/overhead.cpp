// Arrays in, arrays out, in C++: what tests/python/measure.py compares cutbench.cut() with.
// A library that it loads, so that both cut in one process, in turns.
#include <time.h>

#include <array>
#include <cstdint>
#include <string>
#include <utility>
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

Made cut(std::vector<Point3> vertices, std::vector<std::array<std::int32_t, 3>> triangles, const Curve& curve,
         const std::string& name) {
  Made made;
  made.mesh.deformed = std::move(vertices);
  made.mesh.triangles = std::move(triangles);
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

/// \param points  n x 3; \param corners  m x 3; \param path  k x 2, a polyline
/// \return  microseconds of the processor; -1 where the cut failed
extern "C" double us_of_a_cut(const char* method, std::size_t n, const Point3* points, std::size_t m,
                              const std::array<std::int64_t, 3>* corners, std::size_t k, const Point2* path) {
  Curve curve;
  curve.points.assign(path, path + k);
  const double start = processor_us();
  std::vector<std::array<std::int32_t, 3>> triangles(m);
  for (std::size_t t = 0; t < m; ++t)
    for (std::size_t i = 0; i < 3; ++i) triangles[t][i] = static_cast<std::int32_t>(corners[t][i]);
  const Made made = cut({points, points + n}, std::move(triangles), curve, method);
  const double us = processor_us() - start;
  return made.result.triangles.size() > m ? us : -1;
}
