#include "harness/records/context.h"

#include <CGAL/version.h>
#include <dlfcn.h>

#include <Eigen/Core>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <thread>

#include "harness/base/conversions.h"
#include "harness/mesh/mesh_data.h"
#include "harness/records/built_commit.h"

#if CUTBENCH_GMP
#include <gmp.h>
#include <mpfr.h>
#else
#include <boost/version.hpp>
#endif

namespace cutbench {

namespace {

/// First line of what a command prints; nothing where it fails.
std::optional<std::string> first_line_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen((command + " 2>/dev/null").c_str(), "r"), pclose);
  std::array<char, 256> buffer{};
  if (!pipe || !std::fgets(buffer.data(), to_int(buffer.size()), pipe.get())) return {};
  std::string line(buffer.data());
  while (!line.empty() && line.back() == '\n') line.pop_back();
  return line;
}

std::string cpu_model() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown";
}

std::string dotted(int major, int minor, int patch) {
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

/// The libraries that CGAL's exact numbers and the oracle's are of.
std::map<std::string, std::string> exact_numbers() {
#if CUTBENCH_GMP
  return {{"GMP", gmp_version}, {"MPFR", mpfr_get_version()}};
#else
  return {{"Boost", BOOST_LIB_VERSION}};
#endif
}

/// The file of the BLAS that CHOLMOD calls: Debian's alternatives decide which one that is when the program starts. Of
/// OpenBLAS also for which processor its kernels are, as it finds out itself or as OPENBLAS_CORETYPE says.
std::string blas_in_use() {
  Dl_info info{};
  std::error_code error;
  if (void* gemm = dlsym(RTLD_DEFAULT, "dgemm_"); !gemm || !dladdr(gemm, &info)) return "unknown";
  const std::filesystem::path file = std::filesystem::canonical(info.dli_fname, error);
  if (error) return "unknown";
  const std::string name = (file.parent_path().filename() / file.filename()).string();
  using CoreName = const char* (*)();
  const auto core = reinterpret_cast<CoreName>(dlsym(RTLD_DEFAULT, "openblas_get_corename"));
  return core ? name + " " + core() : name;
}

}  // namespace

std::string Context::identity(bool with_times) const {
  nlohmann::json j{{"compiler", compiler}, {"flags", flags}, {"build_type", build_type}, {"versions", versions}};
  if (with_times) j["cpu"] = cpu;
  j["commit"] = commit.value_or("unknown");
  j["dirty"] = dirty ? nlohmann::json(*dirty) : nlohmann::json();
  std::error_code ignored;  // a commit says nothing of changes that were built but never committed
  j["built"] = std::filesystem::last_write_time("/proc/self/exe", ignored).time_since_epoch().count();
  return j.dump();
}

Context gather_context(const std::string& cholmod) {
  const std::string source = CUTBENCH_SOURCE_DIR, git = "git -C '" + source + "' ";
  Context context;
  if (const std::string commit = CUTBENCH_COMMIT; !commit.empty()) {
    context.commit = commit;
    const bool is_git = first_line_of(git + "rev-parse --show-toplevel") == source;
    context.dirty = CUTBENCH_DIRTY || (is_git && first_line_of(git + "status --porcelain").has_value());
  } else {
    std::string line;
    std::ifstream file(source + "/harness/records/commit.txt");
    if (std::getline(file, line) && line.find('$') == std::string::npos) context.commit = line;
  }
  context.compiler = CUTBENCH_COMPILER;
  context.flags = CUTBENCH_FLAGS;
  context.build_type = CUTBENCH_BUILD_TYPE;
  context.cpu = cpu_model();
  context.versions = exact_numbers();
  context.versions.insert({
      {"CGAL", CGAL_VERSION_STR},
      {"Eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"CHOLMOD", cholmod},
      {"BLAS", blas_in_use()},
  });
  std::array<char, 32> date{};
  const std::time_t now = std::time(nullptr);
  std::strftime(date.data(), date.size(), "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
  context.date = date.data();
  context.load = load_average();
  return context;
}

double load_average() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load : -1;
}

std::string busy_note(double load) {
  constexpr double most = 0.75;  // of the cores
  const auto cores = to_double(std::thread::hardware_concurrency());
  if (load <= most * cores) return {};
  char text[128];
  std::snprintf(text, sizeof text,
                "note: the machine was busy at the start (load %.1f on %.0f cores): times came out long\n", load,
                cores);
  return text;
}

std::uint64_t seed_of_commit(const Context& context) {
  if (!context.commit)
    throw InputError("--seed commit: this tree has neither .git nor an archived commit number; give a number instead");
  return std::stoull(context.commit->substr(0, 12), nullptr, 16);
}

}  // namespace cutbench
