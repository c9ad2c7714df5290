#include "experiments/program/options.h"

#include <CLI/CLI.hpp>
#include <cstdint>

#include "harness/base/errors.h"

namespace cutbench {

Option Option::required() const { return Option(option_->required()); }
Option Option::shows_default() const { return Option(option_->capture_default_str()); }
Option Option::positive() const {
  return Option(option_->check([](const std::string& text) {
    double value = 0;
    return CLI::detail::lexical_cast(text, value) && value > 0 ? "" : text + " is not a number above 0";
  }));
}
Option Option::comma_separated() const { return Option(option_->delimiter(',')); }
Option Option::existing_folder() const { return Option(option_->check(CLI::ExistingDirectory)); }
Option Option::one_of(std::initializer_list<const char*> values) const {
  return Option(option_->check(CLI::IsMember(std::vector<std::string>(values.begin(), values.end()))));
}
Option Option::excludes(Option other) const { return Option(option_->excludes(other.option_)); }
bool Option::given() const { return option_->count() > 0; }

Options::Options(const std::string& description)
    : owned_(std::make_shared<CLI::App>(description)), app_(owned_.get()) {}

template <class Value>
Option Options::add_option(const std::string& name, Value& variable, const std::string& help) {
  return Option(app_->add_option(name, variable, help));
}
template Option Options::add_option(const std::string&, std::string&, const std::string&);
template Option Options::add_option(const std::string&, int&, const std::string&);
template Option Options::add_option(const std::string&, double&, const std::string&);
template Option Options::add_option(const std::string&, std::int64_t&, const std::string&);
template Option Options::add_option(const std::string&, std::uint64_t&, const std::string&);
template Option Options::add_option(const std::string&, std::vector<std::string>&, const std::string&);
template Option Options::add_option(const std::string&, std::vector<int>&, const std::string&);
template Option Options::add_option(const std::string&, std::optional<double>&, const std::string&);
template Option Options::add_option(const std::string&, std::optional<int>&, const std::string&);

Option Options::add_flag(const std::string& name, bool& variable, const std::string& help) {
  return Option(app_->add_flag(name, variable, help));
}
Options Options::add_subcommand(const std::string& name, const std::string& help) {
  return Options(app_->add_subcommand(name, help));
}
void Options::require_subcommand() { app_->require_subcommand(1); }
void Options::set_version(const std::function<std::string()>& text) { app_->set_version_flag("--version", text); }
void Options::footer(const std::string& text) { app_->footer(text); }

std::vector<std::string> Options::subcommands() const {
  std::vector<std::string> names;
  for (const CLI::App* command : app_->get_subcommands({})) names.push_back(command->get_name());
  return names;
}

bool Options::parsed() const { return app_->parsed(); }

std::optional<int> Options::parse(int argc, char** argv) {
  try {
    app_->parse(argc, argv);
    return {};
  } catch (const CLI::Success& asked) {  // --help, --version
    return app_->exit(asked);
  } catch (const CLI::ParseError& error) {
    const auto chosen = app_->get_subcommands();
    const std::string subcommand = chosen.empty() ? "" : chosen.front()->get_name() + " ";
    throw InputError(error.what() + ("; see cutbench " + subcommand) + "--help");
  }
}

}  // namespace cutbench
