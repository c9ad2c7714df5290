#include "harness/fem/algebra/workers.h"

#include <stdexcept>
#include <string>
#include <utility>

#include "harness/base/errors.h"

#ifdef __linux__
#include <sched.h>
#endif
#ifndef __EMSCRIPTEN__
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>
#endif

namespace cutbench {

namespace {

/// Of this thread: it does a job.
thread_local bool is_at_work = false;

class AtWork {
 public:
  AtWork() { is_at_work = true; }
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;
  ~AtWork() { is_at_work = false; }
};

}  // namespace

#ifdef __EMSCRIPTEN__

class Workers::Pool {
 public:
  bool is_alone() const { return true; }
  void run(const Task&) {}
};
int Workers::all_cores() { return 1; }

#else

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::microseconds longest_spin{100};   // longer than what a cycle leaves to one thread
constexpr std::chrono::microseconds expected_wait{100};  // beside as long as the caller worked itself
constexpr int alone_after_wait = 10;                     // times as long

void pause_shortly() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

/// Until is_over() or the time is up.
template <class IsOver>
bool spin(const IsOver& is_over, Clock::duration longest) {
  constexpr int pauses = 16;  // from look at the clock to look at the clock
  if (is_over()) return true;
  if (longest == Clock::duration::zero()) return false;
  for (const auto end = Clock::now() + longest; Clock::now() < end;)
    for (int k = 0; k < pauses; ++k) {
      if (is_over()) return true;
      pause_shortly();
    }
  return is_over();
}

}  // namespace

int Workers::all_cores() {
#ifdef __linux__
  cpu_set_t allowed;
  if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) return std::max(1, CPU_COUNT(&allowed));
#endif
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// One task at a time. A thread that takes part counts itself in `busy_`, and then looks whether the task is open; the
/// caller closes the task, and then waits until none is busy. So none looks at a task that is no more, and a thread
/// that comes late is not waited for.
///
/// They sleep by condition variables: std::atomic's wait() yields some times before it sleeps, and whoever yields on a
/// busy core comes back some milliseconds later.
class Workers::Pool {
 public:
  explicit Pool(int helpers) {
    if (helpers < all_cores()) spin_ = longest_spin;  // else it would take somebody's core
    for (int k = 0; k < helpers; ++k) helpers_.emplace_back([this] { help(); });
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;
  ~Pool() {
    is_over_ = true;
    call_helpers();
    for (auto& helper : helpers_) helper.join();
  }

  bool is_alone() const { return is_alone_ && Clock::now() < alone_until_; }
  /// By all threads.
  void run(const Task& task) {
    is_alone_ = false;
    task_ = task;
    next_ = 0;
    const auto start = Clock::now();
    is_open_ = true;
    call_helpers();
    work();
    is_open_ = false;
    wait_for_helpers(start);
    if (failed_) {
      failed_ = false;
      std::rethrow_exception(std::exchange(failure_, nullptr));
    }
  }

 private:
  void call_helpers() {
    ++calls_;
    if (sleeping_ == 0) return;
    const std::lock_guard lock(sleep_);
    called_.notify_all();
  }

  void work() {
    for (std::size_t k = next_++; k < task_.jobs; k = next_++) {
      try {
        task_.call(task_.object, k);
      } catch (...) {
        const std::lock_guard lock(failing_);
        if (!failed_ || k < failed_job_) {
          failure_ = std::current_exception();
          failed_job_ = k;
          failed_ = true;
        }
        next_ = task_.jobs;
      }
    }
  }

  void help() {
    const AtWork at_work;
    for (int heard = 0;;) {
      if (!spin([&] { return calls_ != heard; }, spin_)) sleep_until_called(heard);
      heard = calls_;
      if (is_over_) return;
      ++busy_;
      if (is_open_) work();
      if (--busy_ > 0 || !caller_sleeps_) continue;
      const std::lock_guard lock(sleep_);
      done_.notify_all();
    }
  }

  void sleep_until_called(int heard) {
    std::unique_lock lock(sleep_);
    ++sleeping_;
    while (calls_ == heard) called_.wait(lock);
    --sleeping_;
  }

  void sleep_until_done() {
    std::unique_lock lock(sleep_);
    caller_sleeps_ = true;
    while (busy_ != 0) done_.wait(lock);
    caller_sleeps_ = false;
  }

  void wait_for_helpers(Clock::time_point task_began) {
    if (busy_ == 0) return;
    const auto start = Clock::now();
    if (!spin([&] { return busy_ == 0; }, spin_)) sleep_until_done();
    const auto end = Clock::now();
    if (end - start < expected_wait + (start - task_began)) return;
    is_alone_ = true;
    alone_until_ = end + alone_after_wait * (end - start);
  }

  std::vector<std::thread> helpers_;
  Clock::duration spin_{};
  Task task_{};
  // Each in a cache line of its own: what one thread writes the others read.
  alignas(64) std::atomic<int> calls_ = 0;
  alignas(64) std::atomic<std::size_t> next_ = 0;
  alignas(64) std::atomic<int> busy_ = 0;
  alignas(64) std::atomic<bool> is_open_ = false, is_over_ = false;
  alignas(64) std::atomic<int> sleeping_ = 0;
  std::atomic<bool> caller_sleeps_ = false;
  std::mutex sleep_;
  std::condition_variable called_, done_;
  std::mutex failing_;
  std::exception_ptr failure_;  // with the next two: what a job has thrown
  std::size_t failed_job_ = 0;
  bool failed_ = false;
  bool is_alone_ = false;
  Clock::time_point alone_until_{};
};

#endif

Workers::Workers(int threads) : threads_(threads) {
  if (threads < 1)
    throw InputError("threads: " + std::to_string(threads) + " is not a number of threads; give 1 or more");
#ifdef __EMSCRIPTEN__
  threads_ = 1;
#else
  if (threads > 1) pool_ = std::make_unique<Pool>(threads - 1);
#endif
}

Workers::~Workers() = default;

Workers& Workers::none() {
  static Workers one(1);
  return one;
}

bool Workers::acts_alone() const { return !pool_ || pool_->is_alone(); }

void Workers::run_task(const Task& task) {
  if (is_at_work) throw std::logic_error("workers: a job can't have jobs done");
  const AtWork at_work;
  if (task.jobs > 1 && !acts_alone()) return pool_->run(task);
  for (std::size_t k = 0; k < task.jobs; ++k) task.call(task.object, k);
}

}  // namespace cutbench
