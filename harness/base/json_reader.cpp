#include "harness/base/json_reader.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <set>
#include <vector>

#include "harness/base/conversions.h"
#include "harness/base/errors.h"

namespace cutbench {

namespace {

using nlohmann::json;

/// Finds where the text is wrong: a handler for json::sax_parse that keeps nothing else.
struct FaultFinder {
  std::size_t end = 0;  ///< bytes read when the fault was seen, the last of the faulty token among them
  bool too_large = false;

  bool null() { return true; }
  bool boolean(bool) { return true; }
  bool number_integer(json::number_integer_t) { return true; }
  bool number_unsigned(json::number_unsigned_t) { return true; }
  bool number_float(json::number_float_t, const std::string&) { return true; }
  bool string(std::string&) { return true; }
  bool binary(json::binary_t&) { return true; }
  bool start_object(std::size_t) { return true; }
  bool key(std::string&) { return true; }
  bool end_object() { return true; }
  bool start_array(std::size_t) { return true; }
  bool end_array() { return true; }
  bool parse_error(std::size_t position, const std::string&, const json::exception& error) {
    end = position;
    too_large = dynamic_cast<const json::out_of_range*>(&error) != nullptr;
    return false;
  }
};

bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '+' || c == '-' || c == '.'; }

/// The word or character around byte `at`.
std::string word_at(const std::string& text, std::size_t at) {
  if (!in_word(text[at])) return text.substr(at, 1);
  std::size_t first = at, last = at + 1;
  while (first > 0 && in_word(text[first - 1])) --first;
  while (last < text.size() && in_word(text[last])) ++last;
  return text.substr(first, last - first);
}

/// What to do about a character that may not stand at `at`.
std::string advice(const std::string& text, std::size_t at) {
  const std::size_t before = at > 0 ? text.find_last_not_of(" \t\r\n", at - 1) : std::string::npos;
  const char c = text[at], last = before == std::string::npos ? '\0' : text[before];
  if ((c == ']' || c == '}') && last == ',') return "delete the comma before it";
  if (c == '\'') return "write \" instead";
  if (c == '#' || c == '/') return "JSON has no comments; delete it";
  if (static_cast<unsigned char>(c) < 0x20) return "close the string with \" in its own line";
  if ((c == '[' || c == '{' || c == '"') && last != ',' && last != ':') return "is a comma missing before it?";
  return "check the commas, brackets and quotation marks before it";
}

std::string explain(const std::string& text) {
  if (text.find_first_not_of(" \t\r\n\xEF\xBB\xBF") == std::string::npos) return "it is empty";
  FaultFinder fault;
  json::sax_parse(text, &fault);
  const std::size_t end = std::min(fault.end, text.size());
  const std::string line = "line " + std::to_string(1 + std::count(text.begin(), text.begin() + to_index(end), '\n'));
  if (fault.end > text.size() || end == 0) return line + ": the file ends too soon; is it complete?";
  std::size_t at = end - 1;
  if (fault.too_large) {  // the number is known to be one by the character behind it, which may have been read
    while (at > 0 && !in_word(text[at])) --at;
    return line + ": the number " + word_at(text, at) + " is too large";
  }
  const std::string word = word_at(text, at);
  return line + ": \"" + word + "\" can't stand here; " +
         (std::isalpha(static_cast<unsigned char>(word.front())) ? "values are numbers, \"strings\", true or false"
                                                                 : advice(text, at));
}

}  // namespace

json parse_json(const std::string& text, const JsonFile& file) {
  std::vector<std::set<std::string>> keys;  // of the objects that are open
  const auto check = [&](int, json::parse_event_t event, json& value) {
    if (event == json::parse_event_t::object_start) keys.emplace_back();
    if (event == json::parse_event_t::object_end) keys.pop_back();
    if (event == json::parse_event_t::key && !keys.back().insert(value.get<std::string>()).second)
      throw InputError(file.name + ": the key " + value.dump() + " is there twice in one place; delete one");
    return true;
  };
  try {
    return json::parse(text, check);
  } catch (const json::exception&) {
    throw InputError(file.name + ": not " + file.kind + ": " + explain(text) + "; " + file.kind + " is " + file.shape);
  }
}

}  // namespace cutbench
