// Changes that bytes alone would take ages to hit upon: paths that meet the mesh and themselves exactly or nearly.
#include <charconv>
#include <cmath>
#include <cstring>
#include <random>
#include <regex>
#include <string>
#include <vector>

#include "harness/base/conversions.h"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t max_size);

namespace {

using cutbench::to_index;
using cutbench::to_int;
using cutbench::to_size;
using Random = std::minstd_rand;

struct Span {
  std::size_t begin, length;
};

std::vector<Span> matches(const std::string& text, std::size_t from, std::size_t to, const char* pattern) {
  const std::regex regex(pattern);
  const auto begin = text.begin() + to_index(from), end = text.begin() + to_index(to);
  std::vector<Span> found;
  for (std::sregex_iterator i(begin, end, regex), last; i != last; ++i)
    found.push_back({from + to_size(i->position()), to_size(i->length())});
  return found;
}

std::vector<Span> numbers(const std::string& text, std::size_t from, std::size_t to) {
  return matches(text, from, to, R"([-+]?[0-9]+\.?[0-9]*([eE][-+]?[0-9]+)?)");
}

const Span& any(const std::vector<Span>& spans, Random& random) { return spans[random() % spans.size()]; }

/// A few units in the last place away, or a power of two times as large.
std::string changed(const std::string& number, Random& random) {
  double x = std::strtod(number.c_str(), nullptr);
  if (random() % 4 == 0) {
    x = std::ldexp(x, to_int(random() % 41) - 20);
  } else {
    const double direction = random() % 2 ? HUGE_VAL : -HUGE_VAL;
    for (auto steps = 1 + random() % 8; steps > 0; --steps) x = std::nextafter(x, direction);
  }
  if (!std::isfinite(x)) x = 0;
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, x).ptr};
}

/// False: there was nothing to change in that way.
bool mutate(std::string& text, Random& random) {
  const std::size_t path = std::min(text.find('{'), text.size());
  const std::vector<Span> path_numbers = numbers(text, path, text.size());
  const std::vector<Span> points = matches(text, path, text.size(), R"(\[[^\[\]{}]*\])");
  if (path_numbers.empty() || points.empty()) return false;
  const Span number = any(path_numbers, random), from = any(points, random), to = any(points, random);
  const std::string point = text.substr(from.begin, from.length);
  switch (random() % 6) {
    case 0: {  // a number of the mesh in the path
      const std::vector<Span> mesh_numbers = numbers(text, 0, path);
      if (mesh_numbers.empty()) return false;
      const Span source = any(mesh_numbers, random);
      text.replace(number.begin, number.length, text.substr(source.begin, source.length));
      return true;
    }
    case 1: {  // one number changed, of the path or of the mesh
      const std::vector<Span> all = numbers(text, random() % 4 ? path : 0, text.size());
      const Span one = any(all, random);
      text.replace(one.begin, one.length, changed(text.substr(one.begin, one.length), random));
      return true;
    }
    case 2:
      text.replace(to.begin, to.length, point);
      return true;
    case 3:
      text.insert(to.begin, point + ", ");
      return true;
    case 4: {  // beside another point
      std::string beside = point;
      for (const Span& n : numbers(point, 0, point.size())) {
        if (random() % 2) continue;
        beside.replace(n.begin, n.length, changed(point.substr(n.begin, n.length), random));
        break;  // the spans behind it have moved
      }
      text.replace(to.begin, to.length, beside);
      return true;
    }
    default: {  // one point less
      if (points.size() < 2 || text.compare(to.begin + to.length, 1, ",") != 0) return false;
      text.erase(to.begin, to.length + 1);
      return true;
    }
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed) {
  Random random(seed);
  std::string text(reinterpret_cast<const char*>(data), size);
  if (random() % 5 == 0 || !mutate(text, random) || text.size() > max_size)
    return LLVMFuzzerMutate(data, size, max_size);
  std::memcpy(data, text.data(), text.size());
  return text.size();
}
