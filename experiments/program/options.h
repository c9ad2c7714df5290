// Options of a command line: a thin layer over CLI11, whose headers only options.cpp reads.
#pragma once

#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {  // NOLINT(readability-identifier-naming): its name
class App;
class Option;
}  // namespace CLI

namespace cutbench {

/// An option that was added; belongs to its Options. Each function returns the option itself.
class Option {
 public:
  Option() = default;
  Option required() const;
  Option shows_default() const;    ///< in the help: the value that the variable has now
  Option positive() const;         ///< refuses what is not a number above zero
  Option comma_separated() const;  ///< the values of a list
  Option existing_folder() const;
  Option one_of(std::initializer_list<const char*> values) const;
  Option excludes(Option other) const;
  bool given() const;  ///< on the command line

 private:
  friend class Options;
  explicit Option(CLI::Option* option) : option_(option) {}
  CLI::Option* option_ = nullptr;
};

/// The options of a program or of one of its subcommands. Copies are the same options.
class Options {
 public:
  explicit Options(const std::string& description);

  /// `variable` must live until parse(); it keeps its value where the option is not given. A name without dashes is a
  /// positional one. Value: std::string, int, double, std::int64_t, std::uint64_t, or a std::vector or std::optional of
  /// one.
  template <class Value>
  Option add_option(const std::string& name, Value& variable, const std::string& help = "");
  Option add_flag(const std::string& name, bool& variable, const std::string& help);
  Options add_subcommand(const std::string& name, const std::string& help);
  void require_subcommand();
  void set_version(const std::function<std::string()>& text);  ///< of --version
  void footer(const std::string& text);                        ///< below the help

  std::vector<std::string> subcommands() const;
  bool parsed() const;  ///< this subcommand was chosen
  /// Sets the variables. Returns the exit code where help or the version was asked for and is printed. Throws
  /// InputError: one line that ends with the help to ask for.
  std::optional<int> parse(int argc, char** argv);

 private:
  explicit Options(CLI::App* subcommand) : app_(subcommand) {}
  std::shared_ptr<CLI::App> owned_;
  CLI::App* app_;
};

}  // namespace cutbench
