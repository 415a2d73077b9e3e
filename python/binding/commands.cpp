// Commands that answer with JSON: inspect, example, machine.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>
#include <string>

#include "bindings.h"
#include "flank/example.h"
#include "flank/inspect.h"
#include "flank/machine.h"

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

}  // namespace

void bind_commands(py::module_& module) {
  module.def("inspect_json", &inspected, py::arg("part"), py::arg("sort"), py::arg("type"),
             "The text of flank inspect --json.");
  module.def("example_json", &written_example, py::arg("name"), py::arg("file"), py::arg("seed"),
             "Writes an example; the text of flank example --json.");
  module.def("example_names", &example_names, "The names that example knows.");
  module.def("machine_list_json", &machine_list_json, "The text of flank machine --list --json.");
  module.def("machine_json", &machine_json, py::arg("machine"), "The text of flank machine --json.");
}

}  // namespace flank::python
