// The three kinds of errors as exceptions, each with the field that its message is about.
#include <pybind11/pybind11.h>

#include <exception>

#include "bindings.h"
#include "flank/error.h"

namespace flank::python {

namespace py = pybind11;

namespace {

// Exceptions live as long as the interpreter; a translator can hold no state of its own.
PyObject *error_type = nullptr, *usage_type = nullptr, *input_type = nullptr, *internal_type = nullptr;

PyObject* new_exception(py::module_& module, const char* name, const char* doc, const py::tuple& bases) {
  const std::string full = std::string("openflank.") + name;
  py::dict members;
  members["field"] = "";
  PyObject* type = PyErr_NewExceptionWithDoc(full.c_str(), doc, bases.ptr(), members.ptr());
  if (type == nullptr) throw py::error_already_set();
  module.add_object(name, type);
  return type;
}

void raise(PyObject* type, const Error& error) {
  py::object exception = py::reinterpret_borrow<py::object>(type)(error.what());
  exception.attr("field") = error.field();
  PyErr_SetObject(type, exception.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const UsageError& e) {
    raise(usage_type, e);
  } catch (const InputError& e) {
    raise(input_type, e);
  } catch (const InternalError& e) {
    raise(internal_type, e);
  } catch (const Error& e) {
    raise(error_type, e);
  }
}

}  // namespace

void bind_errors(py::module_& module) {
  const py::handle runtime = PyExc_RuntimeError, value = PyExc_ValueError;
  error_type = new_exception(module, "Error",
                             "Base of every error that the library raises on purpose. field: name of the keyword that "
                             "the message is about, or empty.",
                             py::make_tuple(runtime));
  const py::handle base = error_type;
  usage_type = new_exception(module, "UsageError",
                             "A request is wrong. The message names the keyword and says what would be accepted.",
                             py::make_tuple(base, value));
  input_type = new_exception(
      module, "InputError",
      "A file or a part is refused. The message names the file, line or face and says what would be accepted.",
      py::make_tuple(base));
  internal_type = new_exception(module, "InternalError", "A fault of the library.", py::make_tuple(base));
  py::register_exception_translator(&translate);
}

}  // namespace flank::python
