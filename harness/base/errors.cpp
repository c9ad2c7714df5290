#include "harness/base/errors.h"

namespace cutbench {

namespace {

/// Messages quote what they complain of, which may be a megabyte, or bytes that a terminal obeys.
std::string one_line(std::string text) {
  constexpr std::size_t most = 600, head = 350, tail = 200;
  if (text.size() > most) text = text.substr(0, head) + " [...] " + text.substr(text.size() - tail);
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return text;
}

}  // namespace

InputError::InputError(const std::string& what) : std::runtime_error(one_line(what)) {}
OutputError::OutputError(const std::string& what) : std::runtime_error(one_line(what)) {}

}  // namespace cutbench
