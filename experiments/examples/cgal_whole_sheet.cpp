// A foreign system behind files, as an adapter shows: CGAL triangulates the whole sheet anew, with the path among its
// constraints (harness/study/robustness/cgal_check.h), and knows nothing of the sheet it was.
// usage: cutbench_cgal_whole_sheet mesh.obj path.json out.obj
#include <cstdio>
#include <exception>

#include "harness/files/mesh_file.h"
#include "harness/files/path_file.h"
#include "harness/judge/oracle_request.h"
#include "harness/mesh/tolerances.h"
#include "harness/study/robustness/cgal_check.h"

int main(int argc, char** argv) {
  using namespace cutbench;
  if (argc != 4) return std::fprintf(stderr, "usage: cutbench_cgal_whole_sheet mesh.obj path.json out.obj\n"), 1;
  try {
    const Sheet sheet(read_mesh(argv[1]));
    const Curve cut = read_path(argv[2]).front();
    const oracle::CrossCheckResult made =
        oracle::cgal_whole_sheet_cut(for_oracle(sheet), for_oracle(cut), default_flatten_tolerance * sheet.mean_edge());
    if (made.refused) return std::fprintf(stderr, "%s\n", made.reason.c_str()), 3;
    MeshData result;
    for (const auto& [x, y] : made.mesh.rest) {
      result.rest.push_back({x, y});
      result.deformed.push_back({x, y, 0});
    }
    result.triangles = made.mesh.triangles;
    write_mesh(result, argv[3]);
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 1;
  }
  return 0;
}
