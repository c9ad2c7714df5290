// Scenes, and simulations that Python steps.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>

#include "experiments/program/step_summary.h"
#include "experiments/python/arrays.h"
#include "experiments/python/held.h"
#include "harness/base/conversions.h"
#include "harness/base/errors.h"
#include "harness/scenes/scene_file.h"
#include "harness/simulation/simulation.h"

namespace cutbench::python {

namespace {

/// Rows that arrays of Python look at. They are made when they are first asked for, and brought up to date after each
/// step as long as somebody looks. After a cut new rows take their place: arrays of before stay as they were.
class SeenRows {
 public:
  Array<double> seen(std::span<const double> now, int dimension) {
    if (!rows_) rows_ = std::make_shared<std::vector<double>>(now.begin(), now.end());
    auto* const held = new std::shared_ptr<std::vector<double>>(rows_);
    const py::capsule owner(held, [](void* p) { delete static_cast<std::shared_ptr<std::vector<double>>*>(p); });
    Array<double> array(std::vector<py::ssize_t>{std::ssize(now) / dimension, dimension}, rows_->data(), owner);
    make_read_only(array);
    return array;
  }
  void follow(std::span<const double> now) {
    if (rows_.use_count() > 1 && rows_->size() == now.size())
      std::copy(now.begin(), now.end(), rows_->begin());
    else
      rows_.reset();
  }
  void leave() { rows_.reset(); }

 private:
  std::shared_ptr<std::vector<double>> rows_;
};

struct HeldSimulation {
  HeldSimulation(Scene of, const HeldMethod& method, double chord_tolerance, bool watched)
      : scene(std::move(of)),
        cutting(method.make()),
        options(options_of(chord_tolerance)),
        motion(Simulation::start(scene)),
        uncut(std::make_shared<Sheet>(motion->sheet())) {
    if (watched) motion->watch();
  }

  /// The step that is next, with the cuts that are due before it, as `cutbench simulate` makes it.
  StepReport step() {
    const Work work(*this);
    return motion->advance(++steps * scene.step, *cutting, options);
  }

  MotionCut cut(const std::vector<AnyCurve>& path) {
    const Work work(*this);
    return motion->cut_now(in_rest_space(path, motion->posed_sheet()), *cutting, options);
  }

  /// For whoever has the interpreter: nothing begins to step meanwhile. Throws InputError while another thread steps.
  Simulation& idle() const {
    if (at_work) throw InputError("simulation: is being stepped by another thread, or by this one; wait for it");
    return *motion;
  }

  /// A step or cut, without the interpreter.
  struct Work {
    explicit Work(HeldSimulation& held) : of(held) {
      if (of.at_work.exchange(true)) throw InputError("simulation: is being stepped by another thread; wait for it");
    }
    ~Work() {
      of.show();
      of.at_work = false;
    }
    Work(const Work&) = delete;
    Work& operator=(const Work&) = delete;
    HeldSimulation& of;
  };

  Array<double> seen_x() { return x.seen(idle().positions(), scene.physics.dimension); }
  Array<double> seen_v() { return v.seen(idle().velocities(), scene.physics.dimension); }

  /// After a step or cut, to whoever looks.
  void show() {
    if (motion->made_cuts().size() > cuts_seen) {
      cuts_seen = motion->made_cuts().size();
      x.leave();
      v.leave();
      return;
    }
    x.follow(motion->positions());
    v.follow(motion->velocities());
  }

  Scene scene;
  std::unique_ptr<CuttingMethod> cutting;
  CutOptions options;
  std::unique_ptr<Simulation> motion;
  std::shared_ptr<const Sheet> uncut;
  SeenRows x, v;
  std::size_t cuts_seen = 0;
  int steps = 0;
  std::atomic<bool> at_work = false;
};

py::dict dict_of(const Balance& balance) {
  py::dict result;
  const Energy& e = balance.energy;
  result["membrane"] = e.membrane;
  result["bending"] = e.bending;
  result["kinetic"] = e.kinetic;
  result["potential"] = e.potential;
  result["total"] = e.total();
  return result;
}

py::dict dict_of(const MotionCut& cut) {
  py::dict result;
  result["status"] = name_of(cut.cut.status);
  result["verdict"] = name_of(cut.verdict);
  result["reason"] = cut.reason;
  result["crossed_triangles"] = cut.cut.crossed_triangles;
  result["parts"] = cut.parts;
  result["energy_before"] = dict_of(cut.before);
  result["energy_after"] = dict_of(cut.after);
  result["cut_us"] = cut.cut.time_us.total();
  result["transfer_us"] = cut.transfer_us;
  result["pattern_us"] = cut.pattern_us;
  result["bending_us"] = cut.bending_us;
  return result;
}

/// Of the opened sheet, by slots of its vertices.
std::vector<std::array<std::int32_t, 3>> triangles_of(const Sheet& sheet) {
  std::vector<std::array<std::int32_t, 3>> rows;
  for (std::size_t t = 0; t < sheet.triangle_slots(); ++t)
    if (const Triangle& triangle = sheet.triangle(TriangleIndex(t)); triangle.alive())
      rows.push_back({triangle.deformed[0].value, triangle.deformed[1].value, triangle.deformed[2].value});
  return rows;
}

/// NaN where the slot is free.
std::vector<Point2> rest_of(const Sheet& sheet) {
  std::vector<Point2> rows(sheet.deformed_slots(), {std::nan(""), std::nan("")});
  for (std::size_t d = 0; d < rows.size(); ++d)
    if (const VertexIndex v = sheet.rest_vertex(DeformedIndex(d)); v.valid()) rows[d] = sheet.rest(v);
  return rows;
}

Pin pin_of(std::array<double, 4> box, std::array<bool, 3> axes, std::array<double, 3> velocity) {
  return {.where = {{box[0], box[1]}, {box[2], box[3]}},
          .axes = axes,
          .displacement = {},
          .velocity = {velocity[0], velocity[1], velocity[2]}};
}

void bind_scenes(py::module_& m) {
  py::class_<Scene>(m, "Scene")
      .def_readonly("stem", &Scene::stem)
      .def_readonly("step", &Scene::step)
      .def_readonly("duration", &Scene::duration)
      .def_property_readonly("dimension", [](const Scene& s) { return s.physics.dimension; })
      .def("idle_pins",
           [](const Scene& s, const HeldSimulation& motion) { return idle_pins(s, motion.idle().sheet()); })
      .def_property_readonly("at_rest", [](const Scene& s) { return s.integrator == Integrator::equilibrium; })
      .def("sheet", [](const Scene& s) { return std::make_shared<HeldSheet>(mesh_of(s)); })
      .def("with_sheet",
           [](Scene scene, const HeldSheet& sheet) {
             scene.family.clear();
             scene.mesh = sheet.mesh;
             return scene;
           })
      .def("with_resolution", [](Scene scene, int triangles) {
        if (scene.mesh) throw InputError("resolution: this scene's sheet is given; leave it out");
        scene.resolution = triangles;
        return scene;
      });
  m.def("read_scene", [](const std::filesystem::path& file) { return read_scene(file); });
  m.def("scene_of_text",
        [](const std::string& text, const std::filesystem::path& name) { return read_scene_text(text, name); });
}

}  // namespace

void bind_simulations(py::module_& m) {
  bind_scenes(m);
  using Released = py::call_guard<py::gil_scoped_release>;
  py::class_<Pin>(m, "Pin").def(py::init(&pin_of));
  py::class_<HeldSimulation>(m, "Simulation")
      .def(py::init<Scene, const HeldMethod&, double, bool>(), Released())
      .def(
          "step",
          [](HeldSimulation& s) {
            const StepReport report = s.step();
            return std::pair(std::string(name_of(report.verdict)), report.reason);
          },
          Released())
      .def("cut",
           [](HeldSimulation& s, const std::vector<AnyCurve>& path) {
             const MotionCut cut = [&] {
               const py::gil_scoped_release others_go_on;
               return s.cut(path);
             }();
             return dict_of(cut);
           })
      .def("pull",
           [](HeldSimulation& s, const Array<double>& force) {
             s.idle().pull({force.data(), to_size(force.size())});
           })
      .def("hold", [](HeldSimulation& s, const std::vector<Pin>& pins) { s.idle().hold(pins); })
      .def("holds_a_vertex",
           [](const HeldSimulation& s, const Pin& pin) { return holds_a_vertex({pin}, s.idle().sheet()); })
      .def_property_readonly("x", &HeldSimulation::seen_x)
      .def_property_readonly("v", &HeldSimulation::seen_v)
      .def_property_readonly("rest",
                             [](const HeldSimulation& s) { return array_of<double>(rest_of(s.idle().sheet())); })
      .def_property_readonly(
          "triangles", [](const HeldSimulation& s) { return array_of<std::int32_t>(triangles_of(s.idle().sheet())); })
      .def_property_readonly(
          "sheet", [](const HeldSimulation& s) { return std::make_shared<HeldSheet>(s.idle().posed_sheet(), s.uncut); })
      .def_property_readonly("energy", [](HeldSimulation& s) { return dict_of(s.idle().balance()); })
      .def_property_readonly("time", [](const HeldSimulation& s) { return s.idle().time(); })
      .def_property_readonly("outcome",
                             [](const HeldSimulation& s) {
                               const SimulationOutcome outcome = s.idle().outcome();
                               return py::make_tuple(name_of(outcome.verdict), outcome.reason, outcome.time,
                                                     outcome.refused, outcome.text());
                             })
      .def_property_readonly("cuts",
                             [](const HeldSimulation& s) {
                               py::list cuts;
                               for (const MotionCut& cut : s.idle().made_cuts()) cuts.append(dict_of(cut));
                               return cuts;
                             })
      .def("steps_csv", [](const HeldSimulation& s) { return table_of(s.idle().steps(), s.scene.step); })
      .def("summary_json",
           [](const HeldSimulation& s) {
             const auto counted = std::span(s.idle().steps()).first(s.idle().outcome().steps);
             return summary_of(counted, s.scene.step * to_double(counted.size())).dump();
           })
      .def("budget_csv",
           [](const HeldSimulation& s) { return s.idle().budget() ? s.idle().budget()->csv() : std::string(); });
}

}  // namespace cutbench::python
