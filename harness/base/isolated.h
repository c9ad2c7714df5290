// Work that may crash or hang, done piece by piece in processes of its own: a piece that does costs itself alone.
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
  int workers = 0;           ///< processes at a time; 0: one per core
  double time_limit_s = 10;  ///< processor time for one piece, which ends it; so do ten times as much by the clock
};

/// Calls work(i) once for each i < n, in forked processes: what it leaves must be in shared memory or in files. Where
/// it ends its process, by a signal, an exception or otherwise, or overruns the limit, another process goes on behind
/// it. Standard output and error of the work are discarded. `progress` is called now and then with the number begun.
/// Throws std::runtime_error where no process can be started.
std::vector<Fate> run_isolated(std::size_t n, const Isolation& isolation, const std::function<void(std::size_t)>& work,
                               const std::function<void(std::size_t)>& progress = {});

}  // namespace cutbench
