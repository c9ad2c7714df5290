#include "harness/files/path_file.h"

#include "harness/files/whole_file.h"

namespace cutbench {

std::vector<Curve> read_path(const std::filesystem::path& file) { return read_path_text(text_of(file), file.string()); }

std::vector<AnyCurve> read_path_with_picks(const std::filesystem::path& file) {
  return read_path_text_with_picks(text_of(file), file.string());
}

void write_path(const std::vector<Curve>& cuts, const std::filesystem::path& file) {
  WholeFile(file, path_text(cuts)).place();
}

}  // namespace cutbench
