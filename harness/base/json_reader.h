// JSON text from a user's file, with errors that say where it is wrong and what to write there.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace cutbench {

struct JsonFile {
  std::string name;   ///< begins an error
  std::string kind;   ///< "a path file"
  std::string shape;  ///< how one is written, in short
};

/// Throws InputError: no JSON (with the line), a number too large for a double, or a key that stands twice in one
/// object, of which nlohmann::json would keep the last.
nlohmann::json parse_json(const std::string& text, const JsonFile& file);

}  // namespace cutbench
