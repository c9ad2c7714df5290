#include "harness/programs/program.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <utility>

#include "harness/base/errors.h"
#include "harness/cut/cut_program.h"
#include "harness/files/mesh_file.h"
#include "harness/files/path_file.h"
#include "harness/judge/assessment.h"
#include "harness/path/cut_failed.h"
#include "harness/programs/adopt.h"

namespace cutbench {

namespace {

void replace_all(std::string& text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size())
    text.replace(at, what.size(), by);
}

/// The files that a program reads and writes.
struct Exchange {
  TemporaryFolder folder;
  std::filesystem::path mesh = folder.path() / "mesh.obj", path = folder.path() / "path.json",
                        out = folder.path() / "out.obj", time = folder.path() / "time.json";

  std::string filled_in(std::string command) const {
    replace_all(command, "{mesh}", quoted(mesh.string()));
    replace_all(command, "{path}", quoted(path.string()));
    replace_all(command, "{out}", quoted(out.string()));
    replace_all(command, "{time}", quoted(time.string()));
    return command;
  }
};

/// The microseconds in `{"us": 12.5}`; none where there is no such number.
double reported_us(const std::filesystem::path& file) {
  std::ifstream in(file);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  const std::size_t key = text.find("\"us\"");
  if (key == std::string::npos) return 0;
  const std::size_t begin = text.find_first_of("0123456789", key + 4);
  double value = 0;
  if (begin != std::string::npos) std::from_chars(text.data() + begin, text.data() + text.size(), value);
  return value;
}

class Program final : public CuttingMethod, public CutProgram {
 public:
  explicit Program(ProgramSettings settings) : settings_(std::move(settings)) {}

  CutProgram* program() override { return this; }
  const std::string& command() const override { return settings_.command; }

  double run(Sheet& sheet, Subdivision& trace, const Curve& curve, const CutOptions& options) override {
    const Exchange files;
    MeshData panels = sheet.to_mesh_data();
    panels.sewn.clear();  // `v` and `vt` have one number, as programs are told
    write_mesh(panels, files.mesh);
    write_path({curve}, files.path);
    const ProgramEnd end = run_program(files.filled_in(settings_.command), settings_.folder, settings_.limits);
    if (end.how == ProgramEnd::How::exited && end.code == exit_refused)
      throw CutRefused(end.message.empty() ? "the program refuses this cut, without a reason" : end.message);
    if (end.how == ProgramEnd::How::timed_out) throw CutFailed(Verdict::timed_out, end.text());
    if (!end.succeeded()) throw CutFailed(Verdict::crashed, end.text());
    const MeshData result = read_result(files.out);
    take_over(sheet, trace, result, curve, options, settings_.deletes);
    const double own = reported_us(files.time);
    if (own <= 0 && settings_.command.find("{time}") != std::string::npos) note_no_time();
    return own > 0 ? own : end.us;
  }

 private:
  /// Once in a process: a run makes many cuts.
  void note_no_time() const {
    static bool told = false;
    if (!std::exchange(told, true))
      std::fprintf(stderr, "note: %s wrote no {\"us\": NUMBER} to {time}; its time from start to end counts\n",
                   settings_.name.c_str());
  }

  static MeshData read_result(const std::filesystem::path& file) {
    if (std::error_code none; !std::filesystem::exists(file, none))
      throw CutFailed(Verdict::no_result, "the program ended well, but wrote no {out}");
    try {
      return read_mesh_as_is(file);
    } catch (const InputError& error) {
      throw CutFailed(Verdict::no_result, error.what());
    }
  }

  ProgramSettings settings_;
};

void check_settings(const ProgramSettings& settings) {
  const auto is_good = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || std::string("_-.:").find(c) != std::string::npos;
  };
  if (settings.name.empty() || !std::all_of(settings.name.begin(), settings.name.end(), is_good))
    throw InputError("program \"" + settings.name +
                     "\": the name of a method has letters, digits, `_`, `-`, `.` and `:`");
  for (const char* file : {"{mesh}", "{path}", "{out}"})
    if (settings.command.find(file) == std::string::npos)
      throw InputError("program \"" + settings.name + "\": its command lacks " + file +
                       "; such as: python3 mine.py {mesh} {path} {out}");
  if (std::error_code none; !std::filesystem::is_directory(settings.folder, none))
    throw InputError("program \"" + settings.name + "\": there is no folder " + settings.folder.string());
}

}  // namespace

MethodRow method_of_program(const ProgramSettings& settings) {
  check_settings(settings);
  return {.name = settings.name,
          .summary = "a program: " + settings.command,
          .parameter = {},
          .promises = settings.deletes ? promises_of_deleting_programs : promises_of_programs,
          .factory = [settings](double) { return std::make_unique<Program>(settings); }};
}

void take_over(Sheet& sheet, Subdivision& trace, const MeshData& result, const Curve& curve, const CutOptions& options,
               bool deletes) {
  const Promises& asked = deletes ? promises_of_deleting_programs : promises_of_everybody;
  const Assessment a = judge_result(sheet, result, {&curve, 1}, asked, options);
  if (!a.judgement.ok) {
    const Finding& f = a.findings.front();
    throw CutFailed(a.judgement.verdict, f.cause + ": " + f.text + "\nmend: " + f.mend);
  }
  adopt(sheet, result, deletes);
  trace.along.clear();  // what the path runs along is open as well
}

std::string fingerprint_of_program(const ProgramSettings& settings) {
  std::ostringstream text;
  text << settings.command << ' ' << settings.limits.time_s << ' ' << settings.limits.memory_mb
       << (settings.deletes ? " deletes" : "");
  std::istringstream command(settings.command);
  for (std::string word; command >> word;) {
    std::error_code none;
    const auto file = settings.folder / word;
    if (!std::filesystem::is_regular_file(file, none)) continue;
    text << ' ' << word << ' ' << std::filesystem::file_size(file, none) << ' '
         << std::filesystem::last_write_time(file, none).time_since_epoch().count();
  }
  return text.str();
}

}  // namespace cutbench
