// A short run of fuzz_cut with any compiler: every input as it is, then changed ones. Unlike libFuzzer it doesn't look
// where an input came in the program. What it runs depends on its arguments alone.
// usage: cutbench_fuzz_short RUNS SEED FOLDER...     the input that ended it is in ./fuzz_input
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t max_size,
                                               unsigned seed);

namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t max_size = 8192;
const fs::path under_way = "fuzz_input";

Bytes read(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  Bytes bytes{std::istreambuf_iterator<char>(in), {}};
  bytes.resize(std::min(bytes.size(), max_size));
  return bytes;
}

void run(const Bytes& input) {
  std::ofstream(under_way, std::ios::binary)
      .write(reinterpret_cast<const char*>(input.data()), static_cast<std::streamsize>(input.size()));
  LLVMFuzzerTestOneInput(input.data(), input.size());
}

std::minstd_rand byte_random;

}  // namespace

/// Changes one byte, as libFuzzer's does among other things.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t) {
  if (size > 0) data[byte_random() % size] = static_cast<std::uint8_t>(byte_random());
  return size;
}

int main(int argc, char** argv) {
  if (argc < 4) return std::cerr << "usage: cutbench_fuzz_short RUNS SEED FOLDER...\n", 2;
  std::vector<fs::path> files;
  for (int i = 3; i < argc; ++i)
    for (const auto& entry : fs::directory_iterator(argv[i])) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<Bytes> inputs;
  for (const fs::path& file : files) inputs.push_back(read(file));
  for (const Bytes& input : inputs) run(input);

  std::minstd_rand random(static_cast<unsigned>(std::atoi(argv[2])));
  for (int runs = std::atoi(argv[1]); runs > 0 && !inputs.empty(); --runs) {
    Bytes input = inputs[random() % inputs.size()];
    std::size_t size = input.size();
    input.resize(max_size);
    for (auto changes = 1 + random() % 4; changes > 0; --changes)
      size = LLVMFuzzerCustomMutator(input.data(), size, max_size, static_cast<unsigned>(random()));
    input.resize(size);
    run(input);
  }
  fs::remove(under_way);
}
