/// The parts of the module openflank._core. Each function adds its classes and functions; the order matters, because a
/// docstring names only classes that are there already.
#pragma once

#include <pybind11/pybind11.h>

namespace flank::python {

void bind_errors(pybind11::module_& module);
void bind_tool(pybind11::module_& module);
void bind_part(pybind11::module_& module);
void bind_path(pybind11::module_& module);
void bind_judge(pybind11::module_& module);
void bind_jobs(pybind11::module_& module);
void bind_commands(pybind11::module_& module);

}  // namespace flank::python
