#include "harness/processes/isolated.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

/// When one of these timers ends, a signal ends the process. 0 stops them.
void set_timers(double limit_s) {
  const auto set = [](int which, double seconds) {
    itimerval value{};
    const double whole = std::floor(seconds);
    value.it_value.tv_sec = static_cast<time_t>(whole);
    value.it_value.tv_usec = static_cast<suseconds_t>(1e6 * (seconds - whole));
    setitimer(which, &value, nullptr);
  };
  set(ITIMER_PROF, limit_s);
  set(ITIMER_REAL, 10 * limit_s);
}

/// In the child: what the work prints is discarded, no core file is written, and the child ends when its parent does.
void isolate_from(pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(0);  // it has ended already
  for (int signal_number : {SIGPROF, SIGALRM, SIGINT, SIGTERM}) std::signal(signal_number, SIG_DFL);
  if (const int nowhere = open("/dev/null", O_WRONLY); nowhere >= 0) {
    dup2(nowhere, 1);
    dup2(nowhere, 2);
  }
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
}

}  // namespace

std::vector<Fate> run_isolated(std::size_t n, const Isolation& isolation, const std::function<void(std::size_t)>& work,
                               const std::function<void(std::size_t)>& progress) {
  const auto cores = std::max(1u, std::thread::hardware_concurrency());
  const std::size_t count = std::min(n, isolation.workers > 0 ? to_size(isolation.workers) : std::size_t{cores});
  const SharedArray<Fate> fates(n + 1);         // the last one is for a worker that has not begun a piece
  const SharedArray<std::size_t> piece(count);  // per worker: the piece under way, or the last one done
  for (std::size_t w = 0; w < count; ++w) piece[w] = n;
  const SharedArray<std::atomic<std::size_t>> next(1);
  static_assert(std::atomic<std::size_t>::is_always_lock_free);

  // noexcept: an exception that the child's callers caught would let two processes continue as the parent.
  const auto do_piece = [&work](std::size_t i) noexcept { work(i); };
  const auto begin = [&](std::size_t worker) {
    const pid_t parent = getpid(), child = fork();
    if (child < 0) throw std::runtime_error(std::string("can't start a process: ") + std::strerror(errno));
    if (child > 0) return child;
    isolate_from(parent);
    for (std::size_t i; (i = next[0].fetch_add(1)) < n;) {
      piece[worker] = i;
      fates[i] = Fate::under_way;
      set_timers(isolation.time_limit_s);
      do_piece(i);
      set_timers(0);
      fates[i] = Fate::done;
    }
    _exit(0);
  };

  std::vector<pid_t> processes(count, 0);
  for (std::size_t w = 0; w < count; ++w) processes[w] = begin(w);
  for (std::size_t running = count; running > 0;) {
    bool idle = true;
    for (std::size_t w = 0; w < count; ++w) {
      int status = 0;
      if (processes[w] == 0 || waitpid(processes[w], &status, WNOHANG) == 0) continue;
      idle = false;
      processes[w] = 0;
      --running;
      if (Fate& fate = fates[piece[w]]; fate == Fate::under_way) {
        const bool timer = WIFSIGNALED(status) && (WTERMSIG(status) == SIGPROF || WTERMSIG(status) == SIGALRM);
        fate = timer ? Fate::timed_out : Fate::crashed;
      }
      if (next[0] < n) {
        processes[w] = begin(w);
        ++running;
      }
    }
    if (progress) progress(std::min<std::size_t>(n, next[0]));
    if (idle) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  std::vector<Fate> result(n);
  for (std::size_t i = 0; i < n; ++i) result[i] = fates[i];
  return result;
}

}  // namespace cutbench
