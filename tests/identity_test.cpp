// A killed run goes on only where all is as it was: whatever changes in an experiment's file changes its identity.
#include <functional>
#include <map>
#include <sstream>

#include "harness/study/study_run.h"
#include "tests/program.h"

namespace cutbench {
namespace {

class Identity : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    for (const auto& entry : fs::directory_iterator(CUTBENCH_EXPERIMENTS))
      if (entry.path().extension() != ".toml") fs::create_symlink(entry.path(), folder_ / entry.path().filename());
  }

  std::string identity(const std::string& text) const {
    write(folder_ / "e.toml", text);
    return identity_of(read_experiment(folder_ / "e.toml"), Context());
  }
  std::string identity(const toml::table& table) const {
    std::ostringstream text;
    text << table;
    return identity(text.str());
  }
};

/// Other values of the same kind. Not all of them are allowed.
std::vector<toml::array> others(const toml::node& node) {
  std::vector<toml::array> values;
  const auto add = [&](const auto& value) { values.emplace_back().push_back(value); };
  if (const auto* number = node.as_integer()) {
    add(number->get() + 1);
    add(number->get() - 1);
    add(number->get() * 9);  // a resolution stays one
  }
  if (const auto* number = node.as_floating_point()) add(number->get() * 0.75);
  if (const auto* flag = node.as_boolean()) add(!flag->get());
  if (const auto* text = node.as_string())
    for (const char* other : {"other", "centre_crack", "scenes/stability_plane.toml", "cg", "vertex_snap"})
      if (text->get() != other) add(std::string(other));
  if (const auto* list = node.as_array()) {
    toml::array shorter(*list);
    if (shorter.size() > 1) shorter.pop_back();
    if (shorter.size() < list->size()) add(shorter);
    for (const auto& other : list->empty() ? std::vector<toml::array>() : others(list->front())) {
      toml::array changed(*list);
      changed.erase(changed.begin());
      changed.insert(changed.begin(), other.front());
      add(changed);
    }
  }
  if (const auto* table = node.as_table())
    for (const auto& [key, value] : *table)
      for (const auto& other : others(value)) {
        toml::table changed(*table);
        changed.insert_or_assign(key, other.front());
        add(changed);
      }
  return values;
}

/// The table with another value of one key, by that key; those of a section by "section.key".
std::multimap<std::string, toml::table> changes_of(const toml::table& table) {
  std::multimap<std::string, toml::table> changes;
  for (const auto& [key, value] : table) {
    const std::string name(key.str());
    for (const auto& other : others(value)) changes.emplace(name, table)->second.insert_or_assign(key, other.front());
    if (const toml::table* section = value.as_table())
      for (const auto& [inner, change] : changes_of(*section))
        changes.emplace(name + "." + inner, table)->second.insert_or_assign(key, change);
  }
  return changes;
}

/// Every kind of study with as many keys as it takes, and small scenes.
const std::vector<const char*> of_every_kind{
    R"(claim = "c"
sheets = ["grid", "delaunay"]
resolutions = [200, 800]
methods = ["example", {name = "bowyer_watson", parameter = [0, 1]}]
cut_families = ["curved", "recut"]
seed = 2
cases = 3
own_cuts = true
repetitions = 2
times = true
cold = false
quality = true
eigenvalue_cases = 1
every_edge = false
chord_tolerance = 0.05
scene = "scenes/stability_sheet.toml"
cut_time = 0.001
scene_cases = 1
)",
    R"(claim = "c"
sheets = ["grid", "delaunay"]
resolutions = [200, 800]
methods = ["example", "conventional_split"]
seed = 2
chord_tolerance = 0.05
[accuracy]
problems = ["kirsch_hole", "centre_crack"]
direct = ["cholmod", "cg"]
preconditioners = ["cg", "cholmod"]
iterations = [5, 10]
members = [2, 1]
members_nonlinear = [1, 1]
tip_functions = false
reference = true
graded_reference = true
)",
    R"(claim = "c"
sheets = ["grid", "delaunay"]
resolutions = [200, 800]
methods = ["example", "conventional_split"]
seed = 2
cases = 3
chord_tolerance = 0.05
[robustness]
mesh_files = ["a.off", "b.off"]
time_limit_s = 10.0
cross_check = true
)",
    R"(claim = "c"
sheets = ["grid", "delaunay"]
resolutions = [200, 800]
methods = ["example", "conventional_split"]
seed = 2
cases = 3
time_limit_s = 20.0
chord_tolerance = 0.05
[[sweeps]]
name = "s"
scene = "scenes/stability_sheet.toml"
cases = 2
place = [0.5, 0.2]
cut = "past_vertex"
)"};

TEST_F(Identity, ChangesWithEveryKey) {
  for (const char* name : {"a.off", "b.off"}) write(folder_ / name, "OFF\n");
  std::map<std::string, int> read;  // changes of each key that are allowed
  std::vector<std::string> texts(of_every_kind.begin(), of_every_kind.end());
  texts.emplace_back(R"(claim = "c"
sheets = ["grid"]
resolutions = [200]
methods = ["example"]
cut_families = ["curved"]
times = true
)");  // other keys do not go with times = false
  for (const std::string& text : texts) {
    const toml::table table = toml::parse(text);
    const std::string before = identity(table);
    for (const auto& [key, changed] : changes_of(table)) {
      read.try_emplace(key, 0);
      std::string after;
      try {
        after = identity(changed);
      } catch (const InputError&) {
        continue;  // such as a resolution that no sheet has
      }
      ++read[key];
      EXPECT_NE(after, before) << key << '\n' << changed;
    }
    for (const auto& [key, value] : table) EXPECT_TRUE(read.contains(std::string(key.str()))) << key.str();
  }
  for (const auto& [key, n] : read) EXPECT_GT(n, 0) << "no change of " << key << " is allowed";
}

/// The known keys that `part`, a table within `whole`, does not have: as the message about an unknown one lists them.
std::vector<std::string> lacking(toml::table& part, const std::function<void()>& read_whole) {
  constexpr const char* unknown = "no such key, and none that is like it";
  part.insert(unknown, 1);
  std::string what;
  try {
    read_whole();
  } catch (const InputError& error) {
    what = error.what();
  }
  part.erase(unknown);
  const std::size_t known = what.find("known are ");
  if (known == std::string::npos) return {"(no list of known keys: " + what + ")"};
  std::vector<std::string> names;
  std::istringstream list(what.substr(known + 10));
  for (std::string name; std::getline(list >> std::ws, name, ',');)
    if (!part.contains(name)) names.push_back(name);
  return names;
}

TEST_F(Identity, IsTriedWithEveryKeyThereIs) {
  for (const char* name : {"a.off", "b.off"}) write(folder_ / name, "OFF\n");
  for (const char* text : of_every_kind) {
    toml::table table = toml::parse(text);
    const auto read_all = [&] { identity(table); };
    EXPECT_EQ(lacking(table, read_all), std::vector<std::string>()) << "write them into of_every_kind";
    for (const char* section : {"accuracy", "robustness"})
      if (toml::table* part = table[section].as_table()) {
        EXPECT_EQ(lacking(*part, read_all), std::vector<std::string>()) << "write them into of_every_kind";
      }
  }
}

TEST_F(Identity, DoesNotChangeWithCommentsAndOrder) {
  const std::string text = small_experiment();
  EXPECT_EQ(identity("# a comment\n" + text + "\n\nseed = 1\n"), identity("seed   =   1\n" + text));
}

TEST_F(Identity, ChangesWithTheFilesThatTheExperimentNames) {
  fs::create_directories(folder_ / "own");
  const std::string scene = read(fs::path(CUTBENCH_EXPERIMENTS) / "scenes/stability_sheet.toml");
  const std::string cuts = small_experiment("scene = \"own/scene.toml\"\ncut_time = 0.001\n");
  write(folder_ / "own/scene.toml", scene);
  const std::string before = identity(cuts);
  EXPECT_EQ(identity(cuts), before);
  write(folder_ / "own/scene.toml", scene + "\n# changed\n");
  EXPECT_NE(identity(cuts), before);
}

}  // namespace
}  // namespace cutbench
