// The catalogue as lines of JSON, one for each sheet that can be read: for a build that reads no files
// (tests/live/check).
#include <cmath>
#include <cstdio>

#include "harness/base/errors.h"
#include "harness/mesh/mesh_text.h"
#include "tests/catalogue.h"

int main() {
  using namespace cutbench;
  for (const std::string& name : catalogue_names()) {
    const CatalogueCase file = read_catalogue_case(name);
    for (const CatalogueMember& member : file.members) try {
        nlohmann::json line{{"name", file.name + (member.label.empty() ? "" : " " + member.label)},
                            {"obj", obj_text(sheet_of(member))},
                            {"path", member.path_text}};
        if (!std::isnan(file.chord_tolerance)) line["chord"] = file.chord_tolerance;
        std::puts(line.dump().c_str());
      } catch (const InputError&) {
        continue;  // a case of bad input
      }
  }
}
