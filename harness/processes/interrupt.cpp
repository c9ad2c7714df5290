#include "harness/processes/interrupt.h"

#include <unistd.h>

#include <csignal>
#include <cstddef>
#include <initializer_list>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

pid_t explaining_process = 0;

/// Installed for one signal (SA_RESETHAND): raised again, the signal has its default effect.
void explain(int signal) {
  constexpr char text[] = "\ninterrupted; run the same command again to go on\n";
  const std::size_t skipped = isatty(STDERR_FILENO) ? 0 : 1;  // a terminal shows ^C, perhaps on a line of progress
  if (getpid() == explaining_process && write(STDERR_FILENO, text + skipped, sizeof text - 1 - skipped) < 0) {
    // nobody to tell
  }
  raise(signal);
}

}  // namespace

void explain_interruption() {
  explaining_process = getpid();
  struct sigaction action {};
  action.sa_handler = explain;
  action.sa_flags = to_int(SA_RESETHAND);
  for (int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

}  // namespace cutbench
