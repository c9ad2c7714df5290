#include "harness/processes/subprocess.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "harness/base/conversions.h"

namespace cutbench {

namespace {

[[noreturn]] void fail(const std::string& what) {
  throw std::runtime_error("can't start a program: " + what + ": " + std::strerror(errno));
}

void limit(int resource, double value) {
  const rlimit both{static_cast<rlim_t>(value), static_cast<rlim_t>(value)};
  setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

/// In the child: becomes the program. It leads a process group, so that all it starts can be ended with it.
[[noreturn]] void become(const char* command, const char* folder, int error_pipe, const ProgramLimits& limits) {
  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  for (int signal_number : {SIGPROF, SIGALRM, SIGINT, SIGTERM, SIGPIPE}) std::signal(signal_number, SIG_DFL);
  if (const int nowhere = open("/dev/null", O_RDWR); nowhere >= 0) {
    dup2(nowhere, 0);
    dup2(nowhere, 1);
  }
  dup2(error_pipe, 2);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, std::ceil(limits.time_s) + 1);  // of what leaves the group
  limit(RLIMIT_DATA, limits.memory_mb * 1048576);
  if (chdir(folder) == 0) execl("/bin/sh", "sh", "-c", command, static_cast<char*>(nullptr));
  _exit(127);
}

/// The last line with something in it.
std::string last_line(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
  const std::size_t newline = text.rfind('\n');
  return newline == std::string::npos ? text : text.substr(newline + 1);
}

/// Takes what there is to read; false at the end of the file.
bool read_some(int pipe, std::string& text) {
  char bytes[4096];
  for (ssize_t n; (n = read(pipe, bytes, sizeof bytes)) != 0;) {
    if (n < 0) return errno == EAGAIN || errno == EINTR;
    text.append(bytes, to_size(n));
    if (text.size() > 16384) text.erase(0, text.size() - 8192);  // only its end is wanted
  }
  return false;
}

}  // namespace

std::string ProgramEnd::text() const {
  const std::string said = message.empty() ? "" : ": " + message;
  if (how == How::timed_out) return "ended at its time limit" + said;
  if (how == How::signalled) return "ended by signal " + std::to_string(code) + " (" + strsignal(code) + ")" + said;
  return "exit code " + std::to_string(code) + said;
}

ProgramEnd run_program(const std::string& command, const std::filesystem::path& folder, const ProgramLimits& limits) {
  using Clock = std::chrono::steady_clock;
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) fail("no pipe");
  const auto start = Clock::now();
  const pid_t child = fork();
  if (child == 0) become(command.c_str(), folder.c_str(), ends[1], limits);
  close(ends[1]);
  const int ended = child < 0 ? -1 : to_int(syscall(SYS_pidfd_open, child, 0));
  if (ended < 0) {
    close(ends[0]);
    if (child > 0) {
      kill(child, SIGKILL);
      waitpid(child, nullptr, 0);
    }
    fail("no process");
  }
  setpgid(child, child);  // whoever comes first
  fcntl(ends[0], F_SETFL, O_NONBLOCK);

  ProgramEnd end;
  std::string said;
  const auto deadline =
      start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limits.time_s));
  for (bool open = true;;) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    pollfd both[] = {{ended, POLLIN, 0}, {open ? ends[0] : -1, POLLIN, 0}};
    const int ready = left > 0 ? poll(both, 2, to_int(std::min<decltype(left)>(left, 1000000))) : 0;
    if (both[1].revents != 0) open = read_some(ends[0], said);
    if (ready > 0 && both[0].revents != 0) break;
    if (Clock::now() < deadline) continue;
    end.how = ProgramEnd::How::timed_out;
    break;
  }
  end.us = std::chrono::duration<double, std::micro>(Clock::now() - start).count();
  kill(-child, SIGKILL);  // also what it left running
  int status = 0;
  waitpid(child, &status, 0);
  read_some(ends[0], said);
  close(ends[0]);
  close(ended);
  end.message = last_line(said);
  if (end.how == ProgramEnd::How::timed_out) return end;
  const int code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);  // as the shell tells it
  const bool by_signal = code > 128 && code <= 128 + SIGRTMAX;
  end.how = by_signal ? ProgramEnd::How::signalled : ProgramEnd::How::exited;
  end.code = by_signal ? code - 128 : code;
  const std::string word = by_signal ? strsignal(end.code) : "";
  if (by_signal && (end.message == word || end.message == word + " (core dumped)"))  // the shell's, after the program's
    end.message = last_line(said.substr(0, said.rfind(word)));
  return end;
}

std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "cutbench_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) fail("no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace cutbench
