// Commands that answer with JSON: inspect, example, machine, wheel.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <string>

#include "bindings.h"
#include "flank/error.h"
#include "flank/example.h"
#include "flank/inspect.h"
#include "flank/machine.h"
#include "flank/wheel.h"
#include "progress.h"

namespace flank::python {
namespace py = pybind11;
namespace {

std::string inspected(const std::shared_ptr<Part>& part, const std::string& sort, const std::string& type) {
  const py::gil_scoped_release release;
  return inspect_json(in_order(inspect(*part), {type, sort}));
}

std::string written_example(const std::string& name, const std::filesystem::path& file, std::uint64_t seed) {
  const py::gil_scoped_release release;
  ExampleOptions options;
  options.seed = seed;
  const Example example = make_example(name, options);
  return example_json(example, write_example(example, file.string()));
}

/// The text of plan.json, and what stopped it, or None.
py::tuple milled_wheel(const WheelRequest& request, const py::object& callback) {
  PythonProgress stop(callback);
  const Progress progress = stop.progress();
  std::string plan;
  try {
    const py::gil_scoped_release release;
    plan = mill_wheel(request, progress);
  } catch (const Stopped&) {
    // The operations that were finished lie in the folder.
    if (stop.reason().is_none()) throw;
  } catch (const InputError&) {
    // A fit that was stopped has no path to go on with.
    if (stop.reason().is_none()) throw;
  }
  return py::make_tuple(plan, stop.reason());
}

void bind_wheel(py::module_& module) {
  py::class_<WheelRequest>(module, "WheelRequest", "The request for a wheel.")
      .def(py::init<>())
      .def_readwrite("part", &WheelRequest::part)
      .def_readwrite("folder", &WheelRequest::folder)
      .def_readwrite("unit", &WheelRequest::unit)
      .def_readwrite("tolerance_mm", &WheelRequest::tolerance_mm)
      .def_readwrite("coverage", &WheelRequest::least_coverage)
      .def_readwrite("effort", &WheelRequest::effort)
      .def_readwrite("tool", &WheelRequest::tool)
      .def_readwrite("holder", &WheelRequest::holder)
      .def_readwrite("most_tools", &WheelRequest::most_tools)
      .def_readwrite("sample_mm", &WheelRequest::sample_mm)
      .def_readwrite("rough", &WheelRequest::rough)
      .def_readwrite("blank", &WheelRequest::blank)
      .def_readwrite("allowance_mm", &WheelRequest::allowance_mm)
      .def_readwrite("most_engagement_deg", &WheelRequest::most_engagement_deg)
      .def_readwrite("balance", &WheelRequest::balance)
      .def_readwrite("machine", &WheelRequest::machine)
      .def_readwrite("most_tilt_deg", &WheelRequest::most_tilt_deg)
      .def_readwrite("edges", &WheelRequest::edges)
      .def_readwrite("hub", &WheelRequest::hub)
      .def_readwrite("blades", &WheelRequest::blades)
      .def_readwrite("splitters", &WheelRequest::splitters)
      .def_readwrite("count", &WheelRequest::count);
  module.def("mill_wheel", &milled_wheel, py::arg("request"), py::arg("progress"),
             "Mills a wheel: (the text of plan.json, what stopped it or None).");
}

}  // namespace

void bind_commands(py::module_& module) {
  module.def("inspect_json", &inspected, py::arg("part"), py::arg("sort"), py::arg("type"),
             "The text of flank inspect --json.");
  module.def("example_json", &written_example, py::arg("name"), py::arg("file"), py::arg("seed"),
             "Writes an example; the text of flank example --json.");
  module.def("example_names", &example_names, "The names that example knows.");
  module.def("machine_list_json", &machine_list_json, "The text of flank machine --list --json.");
  module.def("machine_json", &machine_json, py::arg("machine"), "The text of flank machine --json.");
  bind_wheel(module);
}

}  // namespace flank::python
