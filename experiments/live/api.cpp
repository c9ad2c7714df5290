#include <exception>
#include <map>
#include <memory>

#include "experiments/live/cutbench.h"
#include "experiments/live/judged.h"
#include "experiments/live/live_sheet.h"
#include "experiments/live/scene_json.h"
#include "harness/mesh/mesh_text.h"
#include "harness/path/path_text.h"
#include "methods/registry.h"

using namespace cutbench;
using live::LiveSheet;
using nlohmann::json;

namespace {

/// A sheet, and the arrays that were asked for last.
struct Held {
  explicit Held(const Scene& scene) : sheet(scene) {}
  LiveSheet sheet;
  MeshData mesh;
};

std::map<int, std::unique_ptr<Held>> sheets;
std::string answer;

LiveSheet& find(int sheet) {
  const auto found = sheets.find(sheet);
  if (found == sheets.end()) throw InputError("there is no sheet " + std::to_string(sheet));
  return found->second->sheet;
}

/// JSON of what `make` returns, or of its error.
template <class Make>
const char* answer_of(const Make& make) {
  try {
    answer = json(make()).dump();
  } catch (const std::exception& e) {
    answer = json{{"error", e.what()}}.dump(-1, ' ', false, json::error_handler_t::replace);
  }
  return answer.c_str();
}

const MeshData* mesh_of_sheet(int sheet) {
  const auto found = sheets.find(sheet);
  if (found == sheets.end()) return nullptr;
  found->second->mesh = found->second->sheet.mesh();
  return &found->second->mesh;
}

template <class Number, class Entries>
const Number* numbers_of(const Entries& entries, int* count) {
  *count = to_int(entries.size());
  return reinterpret_cast<const Number*>(entries.data());
}

template <class Work>
const char* worked(const char* scene, const char* path, const Work& work) {
  return answer_of([&] {
    const auto curves = read_path_text(path, "the path");
    if (curves.empty()) throw InputError("the path: no cut; give at least one");
    return work(live::scene_of(json::parse(scene)), curves);
  });
}

}  // namespace

const char* cutbench_make(const char* scene) {
  return answer_of([&] {
    auto made = std::make_unique<Held>(live::scene_of(json::parse(scene)));
    const int number = sheets.empty() ? 1 : sheets.rbegin()->first + 1;
    sheets[number] = std::move(made);
    return json{{"sheet", number}};
  });
}

void cutbench_free(int sheet) { sheets.erase(sheet); }

const char* cutbench_step(int sheet, int steps) {
  return answer_of([&] {
    LiveSheet& moving = find(sheet);
    const int made = moving.step(steps);
    if (!moving.fault().empty()) throw InputError(moving.fault());
    return json{{"steps", made}};
  });
}

const char* cutbench_pick(int sheet, double x, double y, double z, double dx, double dy, double dz) {
  return answer_of([&] {
    const Point2 rest = find(sheet).pick({x, y, z}, {dx, dy, dz});
    return json{{"rest", {rest.x, rest.y}}};
  });
}

const char* cutbench_cut(int sheet, const char* method, double parameter, const char* path) {
  return answer_of([&] { return find(sheet).cut(method, parameter, read_path_text(path, "the path")); });
}

const char* cutbench_undo(int sheet) {
  return answer_of([&] { return json{{"undone", find(sheet).undo()}}; });
}

const char* cutbench_grab(int sheet, double rest_x, double rest_y, double radius) {
  return answer_of([&] {
    find(sheet).grab({rest_x, rest_y}, radius);
    return json::object();
  });
}

void cutbench_drag(int sheet, double x, double y, double z) {
  if (sheets.count(sheet) != 0) find(sheet).drag({x, y, z});
}

void cutbench_release(int sheet) {
  if (sheets.count(sheet) != 0) find(sheet).release();
}

const char* cutbench_poke(int sheet, double rest_x, double rest_y, double radius, double vx, double vy, double vz) {
  return answer_of([&] {
    find(sheet).poke({rest_x, rest_y}, radius, {vx, vy, vz});
    return json::object();
  });
}

const char* cutbench_numbers(int sheet) {
  return answer_of([&] { return find(sheet).numbers(); });
}

const char* cutbench_obj(int sheet) {
  const MeshData* const mesh = mesh_of_sheet(sheet);
  answer = mesh ? obj_text(*mesh) : "";
  return answer.c_str();
}

const char* cutbench_places(int sheet, int count, const double* rest, double* space) {
  return answer_of([&] {
    const LiveSheet& moving = find(sheet);
    for (int i = 0; i < count; ++i) {
      const Point3 x = moving.place({rest[2 * i], rest[2 * i + 1]});
      space[3 * i] = x.x;
      space[3 * i + 1] = x.y;
      space[3 * i + 2] = x.z;
    }
    return json::object();
  });
}

const double* cutbench_positions(int sheet, int* count) {
  const MeshData* const mesh = mesh_of_sheet(sheet);
  return mesh ? numbers_of<double>(mesh->deformed, count) : nullptr;
}

const double* cutbench_rest(int sheet, int* count) {
  const MeshData* const mesh = mesh_of_sheet(sheet);
  return mesh ? numbers_of<double>(mesh->rest, count) : nullptr;
}

const int* cutbench_triangles(int sheet, int* count) {
  const MeshData* const mesh = mesh_of_sheet(sheet);
  return mesh ? numbers_of<int>(mesh->triangles, count) : nullptr;
}

const float* cutbench_draw(int sheet, int colour, int at_rest, int* count) {
  if (sheets.count(sheet) == 0) return nullptr;
  const std::vector<float>& soup = find(sheet).draw(static_cast<live::Colour>(colour), at_rest != 0);
  *count = to_int(soup.size() / LiveSheet::floats_per_triangle);
  return soup.data();
}

const char* cutbench_judge(const char* scene, const char* method, double parameter, const char* path) {
  return worked(scene, path,
                [&](const Scene& s, const auto& curves) { return live::judged(s, method, parameter, curves); });
}

const char* cutbench_time(const char* scene, const char* method, double parameter, const char* path) {
  return worked(scene, path,
                [&](const Scene& s, const auto& curves) { return live::timed(s, method, parameter, curves); });
}

const char* cutbench_methods(void) {
  return answer_of([] {
    json all = json::array();
    for (const MethodRow& row : all_methods())
      all.push_back(
          {{"name", row.name},
           {"summary", row.summary},
           {"parameter",
            {{"name", row.parameter.name}, {"value", row.parameter.value}, {"meaning", row.parameter.meaning}}}});
    return all;
  });
}
