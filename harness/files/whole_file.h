// Files that are read whole, and files that appear whole or not at all.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace cutbench {

/// \throw InputError for a folder, or a file that can't be read.
std::string text_of(const std::filesystem::path& file);

/// Says before the work what would stop the writing after it. `what` begins the error, such as an option's name.
/// \throw InputError for a folder that isn't there or may not be written, or a `path` that is a folder.
void check_writable(const std::filesystem::path& path, const std::string& what);

/// Written beside `path`, `.tmp` added to its name, and renamed by place(); gone where that is never called. What a
/// symbolic link stands for is replaced, not the link. A device or pipe is written as it is, at once: renaming would
/// replace it.
class WholeFile {
 public:
  /// \throw OutputError where it can't be written, with the system's reason; nothing is left then.
  WholeFile(const std::filesystem::path& path, std::string_view text);
  WholeFile(WholeFile&& other) noexcept;
  WholeFile& operator=(WholeFile&&) = delete;
  ~WholeFile();
  /// \throw OutputError
  void place();

 private:
  std::filesystem::path path_, temporary_;  ///< temporary_ is empty where there is none, or no longer
};

}  // namespace cutbench
