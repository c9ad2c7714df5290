// Threads that share the loops of a step. A loop is parted into jobs by its length alone, and each sum is taken in the
// order of its parts: so results are the same bits whatever the number of threads, and whoever does which job.
//
// A thread that finds no job spins for some microseconds, then it sleeps. On a busy machine a thread that has begun a
// job may lose its core, and the others wait for it. After such a wait the caller works alone for ten times as long.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>

namespace cutbench {

class Workers {
 public:
  /// \param threads  with the caller's own; in WebAssembly always one. Throws InputError below 1.
  explicit Workers(int threads);
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  ~Workers();
  /// The caller alone. Any number of callers may share it.
  static Workers& none();
  static int all_cores();

  int threads() const { return threads_; }
  /// The caller would do all jobs right now: there is nobody else, or the machine is busy.
  bool acts_alone() const;
  /// Calls job(k) once for each k below `jobs`, in any order and at the same time, and returns when all are done. Of
  /// what jobs throw the one of the lowest number is thrown here; others may not have been done then.
  /// \throw std::logic_error  from within a job
  template <class Job>
  void run(std::size_t jobs, const Job& job) {
    run_task({&job, [](const void* of, std::size_t k) { (*static_cast<const Job*>(of))(k); }, jobs});
  }
  /// Calls job(begin, end) for ranges that make up all numbers below n.
  template <class Job>
  void for_ranges(std::size_t n, const Job& job) {
    const std::size_t length = range_length(n);
    if (n <= length) return job(std::size_t{0}, n);
    run((n + length - 1) / length, [&](std::size_t k) { job(k * length, std::min(n, (k + 1) * length)); });
  }
  /// The sum of part(begin, end) over these ranges, one after the other.
  template <class Part>
  auto sum_ranges(std::size_t n, const Part& part) {
    std::array<decltype(part(n, n)), most_ranges> parts{};
    const std::size_t length = range_length(n);
    for_ranges(n, [&](std::size_t begin, std::size_t end) { parts[begin / length] = part(begin, end); });
    auto sum = parts[0];
    for (std::size_t k = 1; k * length < n; ++k) sum += parts[k];
    return sum;
  }

  static constexpr std::size_t most_ranges = 64, shortest_range = 512;

 private:
  struct Task {
    const void* object;
    void (*call)(const void* object, std::size_t job);
    std::size_t jobs;
  };
  static std::size_t range_length(std::size_t n) {
    return std::max(shortest_range, (n + most_ranges - 1) / most_ranges);
  }
  void run_task(const Task& task);

  class Pool;
  int threads_ = 1;
  std::unique_ptr<Pool> pool_;  // none for one thread
};

}  // namespace cutbench
