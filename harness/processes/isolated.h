// Work that may crash or hang, done piece by piece in child processes: the other pieces are not affected.
#pragma once

#include <sys/mman.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

namespace cutbench {

/// Values in memory that is shared with the processes forked after it was made.
template <class T>
class SharedArray {
  static_assert(std::is_trivially_destructible_v<T>);

 public:
  explicit SharedArray(std::size_t n) : bytes_(n * sizeof(T) + 1), n_(n) {
    data_ = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (data_ == MAP_FAILED) throw std::bad_alloc();
    std::uninitialized_value_construct_n(static_cast<T*>(data_), n);
  }
  ~SharedArray() { munmap(data_, bytes_); }
  SharedArray(const SharedArray&) = delete;
  SharedArray& operator=(const SharedArray&) = delete;

  T& operator[](std::size_t i) const { return static_cast<T*>(data_)[i]; }
  std::size_t size() const { return n_; }

 private:
  void* data_;
  std::size_t bytes_, n_;
};

enum class Fate : std::uint8_t { not_begun, under_way, done, crashed, timed_out };

struct Isolation {
  int workers = 0;  ///< processes at a time; 0: one per core
  double time_limit_s =
      10;  ///< of processor time; a piece that takes longer, or ten times as long by the clock, is ended
};

/// Calls work(i) once for each i < n, in forked processes: its results must be in shared memory or in files. Where a
/// piece ends its process, by a signal, an exception or otherwise, or exceeds the limit, another process continues with
/// the next piece. Standard output and error of the work are discarded. `progress` is called from time to time with the
/// number of pieces begun. Throws std::runtime_error where no process can be started.
std::vector<Fate> run_isolated(std::size_t n, const Isolation& isolation, const std::function<void(std::size_t)>& work,
                               const std::function<void(std::size_t)>& progress = {});

}  // namespace cutbench
