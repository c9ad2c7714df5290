#include "experiments/advice/which_method.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include "experiments/advice/which_method_text.h"
#include "harness/scenes/toml_reader.h"

namespace cutbench {

namespace {

std::vector<std::string> keys_of(const TomlReader& row, const char* key) {
  return row.has(key) ? row.list<std::string>(key) : std::vector<std::string>();
}

MethodChoice choice_of(const TomlReader& row) {
  return {.yes = keys_of(row, "yes"),
          .no = keys_of(row, "no"),
          .any = keys_of(row, "any"),
          .method = row.value<std::string>("method"),
          .setting = row.value<std::string>("setting", ""),
          .value = row.value<std::string>("value"),
          .says = row.value<std::string>("says"),
          .because = row.value<std::string>("because"),
          .runner_up = row.value<std::string>("runner_up"),
          .runner_up_because = row.value<std::string>("runner_up_because"),
          .but = row.value<std::string>("but", "")};
}

void print_command(const std::string& method) {
  std::printf("  cutbench simulate SCENE.toml --method %s\n", method.c_str());
}

}  // namespace

WhichMethod which_method_table() {
  const std::string name = "which_method.toml";
  const toml::table text = parse_toml_text(which_method_text, name);
  const TomlReader reader{text, name};
  WhichMethod table;
  for (const TomlReader& question : reader.sections("questions", "question", {"key", "asks"}))
    table.questions.push_back({question.value<std::string>("key"), question.value<std::string>("asks")});
  for (const TomlReader& row :
       reader.sections("rows", "row",
                       {"if", "yes", "no", "any", "method", "setting", "number", "value", "says", "because", "but",
                        "runner_up", "runner_up_because", "rests_on"}))
    table.rows.push_back(choice_of(row));
  return table;
}

const MethodChoice& choose_method(const WhichMethod& table, const std::function<bool(const Question&)>& answer) {
  std::map<std::string, bool> known;
  const auto is_yes = [&](const std::string& key) {
    if (const auto found = known.find(key); found != known.end()) return found->second;
    const auto question = std::find_if(table.questions.begin(), table.questions.end(),
                                       [&](const Question& candidate) { return candidate.key == key; });
    if (question == table.questions.end()) throw InputError("which_method.toml asks no question \"" + key + "\"");
    return known[key] = answer(*question);
  };
  const auto fits = [&](const MethodChoice& row) {
    return std::all_of(row.yes.begin(), row.yes.end(), is_yes) && std::none_of(row.no.begin(), row.no.end(), is_yes) &&
           (row.any.empty() || std::any_of(row.any.begin(), row.any.end(), is_yes));
  };
  const auto found = std::find_if(table.rows.begin(), table.rows.end(), fits);
  if (found == table.rows.end()) throw InputError("which_method.toml has no row for these answers");
  return *found;
}

void print_choice(const MethodChoice& choice) {
  std::string says = choice.says;
  if (const auto place = says.find("{}"); place != std::string::npos) says.replace(place, 2, choice.value);
  std::printf("take %s%s\n", choice.method.c_str(),
              choice.setting.empty() ? "" : (", with " + choice.setting + " in [physics] of the scene").c_str());
  std::printf("  %s (published records; in brackets 95 %%)\n", says.c_str());
  std::printf("  because: %s\n", choice.because.c_str());
  if (!choice.but.empty()) std::printf("  but: %s\n", choice.but.c_str());
  std::printf("runner-up: %s, %s\n", choice.runner_up.c_str(), choice.runner_up_because.c_str());
  std::printf("try both:\n");
  print_command(choice.method);
  print_command(choice.runner_up);
}

}  // namespace cutbench
