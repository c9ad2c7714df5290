// Ctrl-C in the middle of a sweep.
#pragma once

namespace cutbench {

/// From now on SIGINT and SIGTERM end the program as ever (a shell sees 130 or 143), but not without one line that says
/// how to go on. That is safe at any moment: what is on disk is always fit to be resumed, as after SIGKILL. Processes
/// forked from this one end in silence.
void explain_interruption();

}  // namespace cutbench
