// SIGINT and SIGKILL in the middle of the work: what is on disk is whole, and the same command goes on.
#include <fcntl.h>

#include <chrono>
#include <csignal>
#include <regex>
#include <thread>

#include "harness/files/mesh_file.h"
#include "harness/mesh/families.h"
#include "tests/mesh_checks.h"
#include "tests/program.h"

namespace cutbench {
namespace {

using namespace std::chrono_literals;

class Interrupt : public Program {
 protected:
  /// Starts the program in the folder; returns its process.
  pid_t start(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), CUTBENCH_PROGRAM);
    std::vector<char*> argv;
    for (std::string& a : arguments) argv.push_back(a.data());
    argv.push_back(nullptr);
    const pid_t child = fork();
    if (child != 0) return child;
    const auto redirect = [](const char* file, int to) { dup2(open(file, O_WRONLY | O_CREAT | O_TRUNC, 0644), to); };
    if (chdir(folder_.c_str()) == 0) {
      redirect("stdout", STDOUT_FILENO);
      redirect("stderr", STDERR_FILENO);
    }
    execv(argv[0], argv.data());
    _exit(127);
  }

  /// The sweep, hit by `signal` once it has written some rows; false where it ended before that.
  bool sweep_hit_by(int signal) {
    const pid_t child = start({"run", "e.toml", "--out", "r"});
    int status = 0;
    while (lines_of(read(part())).size() < 8 && waitpid(child, &status, WNOHANG) == 0) std::this_thread::sleep_for(1ms);
    kill(child, signal);
    if (waitpid(child, &status, 0) != child) return false;
    if (!WIFSIGNALED(status)) return false;
    EXPECT_EQ(WTERMSIG(status), signal);
    return true;
  }

  fs::path part() const { return folder_ / "r/e/records.csv.part"; }
  fs::path records() const { return folder_ / "r/e/records.csv"; }
  std::string uninterrupted() {
    EXPECT_EQ(run("run e.toml --out whole").code, 0);
    return read(folder_ / "whole/e/records.csv");
  }
};

/// The rows of a .part, without its head.
std::vector<std::string> rows_of(const fs::path& part) {
  auto lines = lines_of(read(part));
  if (!lines.empty()) lines.erase(lines.begin());
  return lines;
}

TEST_F(Interrupt, SweepGoesOnWhereItStopped) {
  write(folder_ / "e.toml",
        std::regex_replace(small_experiment("every_edge = true\n"), std::regex("cases = 3"), "cases = 8"));
  const std::string whole = uninterrupted();
  for (int signal : {SIGINT, SIGTERM, SIGKILL}) {
    SCOPED_TRACE(signal);
    bool hit = false;
    for (int attempt = 0; attempt < 10 && !hit; ++attempt) {
      fs::remove_all(folder_ / "r");
      hit = sweep_hit_by(signal);
    }
    ASSERT_TRUE(hit);
    const std::string error = read(folder_ / "stderr"), message = "interrupted; run the same command again to go on\n";
    EXPECT_EQ(error.ends_with(message), signal != SIGKILL) << error;
    EXPECT_FALSE(fs::exists(records()));
    std::string left = read(part());
    left.resize(left.rfind('\n') + 1);
    write(part(), left + "2,curved,gr");  // killed in the middle of a row
    const auto before = rows_of(part());
    ASSERT_GT(before.size(), 5u);

    const Result again = run("run e.toml --out r");
    EXPECT_EQ(again.code, 0) << again.error;
    EXPECT_NE(again.error.find("resumed, " + std::to_string(before.size() - 1) + " rows were there"), std::string::npos)
        << again.error;
    // What was there is there to the letter, measured times included: it was not done again.
    const auto after = lines_of(read(records()));
    ASSERT_GT(after.size(), before.size());
    for (std::size_t i = 0; i + 1 < before.size(); ++i) EXPECT_EQ(after[i + 1], before[i]);
    EXPECT_EQ(without_times(read(records())), without_times(whole));
    EXPECT_FALSE(fs::exists(part()));
  }
}

/// What was written by another commit, build or experiment has no place among this one's rows.
TEST_F(Interrupt, RowsOfAnotherRunAreNotMixedIn) {
  write(folder_ / "e.toml", small_experiment());
  const auto whole = without_times(uninterrupted());
  const auto lines = lines_of(read(folder_ / "whole/e/records.csv"));
  fs::create_directories(part().parent_path());
  write(part(), "# run 1\n" + lines[1] + "\n");
  const Result anew = run("run e.toml --out r");
  EXPECT_EQ(anew.code, 0);
  EXPECT_NE(anew.error.find("records.csv.part is of another program, experiment or shard: started anew"),
            std::string::npos)
      << anew.error;
  EXPECT_EQ(read(records()).find(lines[1]), std::string::npos);
  EXPECT_EQ(without_times(read(records())), whole);
}

TEST_F(Interrupt, RecordsAreReadBackAsFarAsTheyAreWhole) {
  const auto row = [](std::int64_t index) {
    Record record;
    record.set("case", index);
    record.set("geometry_us", 1.5);
    return record;
  };
  const auto rows_left = [&](const std::string& identity) {
    RecordFile file(folder_ / "f", identity);
    int n = 0;
    while (file.has(row(n).key())) ++n;
    return n;
  };
  const fs::path left = folder_ / "f/records.csv.part";
  {
    RecordFile file(folder_ / "f", "a");
    EXPECT_EQ(file.note(), "");
    for (int i = 0; i < 4; ++i) file.append(row(i));
  }
  const std::string text = read(left);
  const std::size_t last = text.rfind('\n', text.size() - 2) + 1;
  EXPECT_EQ(rows_left("a"), 4);
  EXPECT_EQ(read(left), text);
  for (std::size_t n = last; n < text.size(); ++n) {
    write(left, text.substr(0, n));
    EXPECT_EQ(rows_left("a"), 3) << n;
    EXPECT_EQ(read(left), text.substr(0, last));
  }
  write(left, text.substr(0, last) + std::string(100, '\0') + "\n" + text.substr(last));  // a disk without power
  EXPECT_EQ(rows_left("a"), 3);
  for (const std::string& head : {text.substr(0, 3), std::string()}) {
    write(left, head);
    EXPECT_EQ(rows_left("a"), 0);
  }
  write(left, text);
  EXPECT_EQ(rows_left("b"), 0);
  EXPECT_EQ(rows_left("a"), 0);  // they are gone
}

/// OUT is the old file or the new one, whenever the program dies.
TEST_F(Interrupt, CutIsWrittenWholeOrNotAtAll) {
  write_mesh(make_sheet("delaunay", 40), folder_ / "big.obj");
  write(folder_ / "path.json", R"({"cuts":[{"polyline":[[-0.1,0.31],[1.1,0.7]]}]})");
  const std::vector<std::string> arguments{"cut",      "--mesh",        "big.obj", "--path", "path.json",
                                           "--method", "bowyer_watson", "--out",   "out.obj"};
  int status = 0;
  const auto started = std::chrono::steady_clock::now();
  waitpid(start(arguments), &status, 0);
  const auto whole_time = std::chrono::steady_clock::now() - started;
  ASSERT_EQ(status, 0) << read(folder_ / "stderr");
  const std::string whole = read(folder_ / "out.obj"), old = read(folder_ / "big.obj");
  for (int tenths = 1; tenths <= 10; ++tenths) {
    write(folder_ / "out.obj", old);
    const pid_t child = start(arguments);
    std::this_thread::sleep_for(whole_time * tenths / 10);
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
    const std::string out = read(folder_ / "out.obj");
    EXPECT_TRUE(out == old || out == whole) << tenths;
  }
  EXPECT_EQ(run("cut --mesh big.obj --path path.json --method bowyer_watson --out out.obj").code, 0);
  EXPECT_EQ(read(folder_ / "out.obj"), whole);  // whatever was left beside it
  EXPECT_FALSE(fs::exists(folder_ / "out.obj.tmp"));
}

}  // namespace
}  // namespace cutbench
