#include "harness/files/whole_file.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "harness/base/errors.h"

namespace cutbench {

namespace {

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
  throw OutputError(path.string() + ": can't be written (" + reason +
                    "); check that the folder exists, may be written and has room");
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : ".";
}

/// What there is at `path`, if anything, is neither a file nor a folder.
bool is_device(const std::filesystem::path& path) {
  std::error_code ignored;
  return is_other(status(path, ignored));
}

}  // namespace

std::string text_of(const std::filesystem::path& file) {
  std::error_code ignored;
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file, ignored))
    throw InputError(file.string() + ": can't be read; check the name and its permissions");
  return {std::istreambuf_iterator<char>(in), {}};
}

void check_writable(const std::filesystem::path& path, const std::string& what) {
  const std::string where = what + " " + path.string() + ": ", folder = folder_of(path).string();
  std::error_code ignored;
  if (path.empty()) throw InputError(what + ": the name is empty; give a file");
  if (std::filesystem::is_directory(path, ignored)) throw InputError(where + "is a folder; give a file in it");
  if (!std::filesystem::is_directory(folder, ignored))
    throw InputError(where + "there is no folder " + folder + "; make it first");
  if (access(is_device(path) ? path.c_str() : folder.c_str(), W_OK) != 0)
    throw InputError(where + "can't be written (" + std::strerror(errno) + "); choose another place");
}

WholeFile::WholeFile(const std::filesystem::path& path, std::string_view text) : path_(path) {
  if (!is_device(path)) {
    std::error_code error;
    path_ = weakly_canonical(path, error);
    if (error) fail(path, error.message());
    temporary_ = path_;
    temporary_ += ".tmp";
  }
  errno = 0;
  std::ofstream out(temporary_.empty() ? path_ : temporary_, std::ios::binary);
  out << text;
  out.close();
  if (out) return;
  const std::string reason = errno != 0 ? std::strerror(errno) : "unknown reason";
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
  fail(path, reason);
}

WholeFile::WholeFile(WholeFile&& other) noexcept
    : path_(std::move(other.path_)), temporary_(std::exchange(other.temporary_, {})) {}

WholeFile::~WholeFile() {
  std::error_code ignored;
  if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

void WholeFile::place() {
  if (temporary_.empty()) return;
  std::error_code error;
  std::filesystem::rename(temporary_, path_, error);
  if (error) fail(path_, error.message());
  temporary_.clear();
}

}  // namespace cutbench
