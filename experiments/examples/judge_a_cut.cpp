// Every method cuts the sheet of a mesh file along a path file, and the oracle judges each cut. Links cutbench::judge
// and cutbench::files.
#include <cutbench/base/errors.h>
#include <cutbench/files/mesh_file.h>
#include <cutbench/files/path_file.h>
#include <cutbench/judge/judged_sheet.h>
#include <cutbench/methods/registry.h>

#include <cstdio>

using namespace cutbench;

namespace {

/// Whether all cuts are right. One that is refused is, if it left the sheet as it was.
bool judge(const MethodRow& row, const Sheet& sheet, const std::vector<Curve>& cuts) {
  JudgedSheet judged(sheet, row.promises, row.make(row.parameter.value));
  for (const Curve& cut : cuts) {
    const auto finding = judged.cut(cut, {});
    std::printf("%s: %s, %s", row.name.c_str(), name_of(judged.outcome.status), name_of(finding.verdict));
    if (!finding.ok()) {
      std::printf(": %s\n", finding.reason.c_str());
      return false;
    }
    if (judged.outcome.status == Status::ok)
      std::printf(", %d pieces, incision %.2g beside the path", judged.judgement.pieces,
                  judged.judgement.incision_error);
    std::printf("\n");
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: judge_a_cut MESH PATH\n");
    return 2;
  }
  try {
    const Sheet sheet(read_mesh(argv[1]));
    const std::vector<Curve> cuts = read_path(argv[2]);
    bool right = true;
    for (const MethodRow& row : all_methods()) right = judge(row, sheet, cuts) && right;
    return right ? 0 : 1;
  } catch (const InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
