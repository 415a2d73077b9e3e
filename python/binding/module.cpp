// The module openflank._core: the front door of the library (include/flank) and nothing else.
#include <pybind11/pybind11.h>

#include "bindings.h"
#include "flank/threads.h"
#include "flank/version.h"

namespace py = pybind11;

PYBIND11_MODULE(_core, module) {
  module.doc() = "The library OpenFlank. Lengths are in millimetres, points in the frame of the part.";
  module.attr("__version__") = flank::kVersion;
  flank::python::bind_errors(module);
  flank::python::bind_tool(module);
  flank::python::bind_part(module);
  flank::python::bind_path(module);
  flank::python::bind_judge(module);
  flank::python::bind_jobs(module);
  flank::python::bind_commands(module);
  module.def(
      "set_thread_count", &flank::set_thread_count, py::arg("threads"),
      "Sets the number of threads that the library works with (>= 0); 0: all cores. Call it once, at the start. No "
      "result depends on it.");
  module.def("thread_count", &flank::thread_count, "The number of threads in force, at least 1.");
}
