// What Ctrl-C does during a run.
#pragma once

namespace cutbench {

/// From now on SIGINT and SIGTERM print one line that says how to resume, and then end the program as before (a shell
/// sees 130 or 143). That is safe at any moment: what is on disk can always be resumed, as after SIGKILL. Processes
/// forked from this one print nothing.
void explain_interruption();

}  // namespace cutbench
