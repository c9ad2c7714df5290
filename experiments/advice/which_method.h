// `cutbench recommend` without a scene: which method, by a few questions. The table is
// experiments/advice/which_method.toml, which is compiled in; README.md and docs/how-to/choose_a_method.md show it,
// too.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace cutbench {

struct Question {
  std::string key, asks;
};

/// A method, and the answers for which it is taken, by the keys of questions.
struct MethodChoice {
  std::vector<std::string> yes, no, any;  ///< all are yes; all are no; one is yes, where there are any
  std::string method, setting;            ///< setting: of a scene's [physics]; may be empty
  std::string value, says;                ///< a number of the published records, and a sentence with {} in its place
  std::string because, runner_up, runner_up_because;
  std::string but;  ///< what the method does not go with; may be empty
};

struct WhichMethod {
  std::vector<Question> questions;
  std::vector<MethodChoice> rows;  ///< the first one that fits is taken; the last one always does
};

/// The table that is compiled in.
WhichMethod which_method_table();

/// The first row that fits. Asks only what decides, each question at most once. \param answer  of a question: yes?
const MethodChoice& choose_method(const WhichMethod& table, const std::function<bool(const Question&)>& answer);

/// To standard output: the method, why, its number, the runner-up, and the commands that try both.
void print_choice(const MethodChoice& choice);

}  // namespace cutbench
