// Where and how a run was made: every record travels with it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace cutbench {

struct Context {
  std::optional<std::string> commit;  ///< that was built; of an archive, from harness/records/commit.txt
  std::optional<bool> dirty;          ///< changes that are in no commit, when built or now; unknown in an archive
  std::string compiler, flags, build_type, cpu;
  std::map<std::string, std::string> versions;  ///< of libraries
  std::string date;                             ///< UTC
  double load = 0;                              ///< one-minute load average at the start

  /// What must agree for records of two runs to belong together: all but date and load; the processor, too, where the
  /// records hold times.
  std::string identity(bool with_times = true) const;
};

/// \param cholmod  version of the library of factors: cholmod_version() (harness/fem/linear/factor.h)
Context gather_context(const std::string& cholmod);

/// One-minute load average; -1 where it is not known.
double load_average();

/// What a timed command says at its end of a machine that others used; a whole line, empty where none did.
/// \param load  load_average() at its start
std::string busy_note(double load);

/// The seed that a commit's hash stands for. Throws InputError where the commit isn't known.
std::uint64_t seed_of_commit(const Context& context);

}  // namespace cutbench
