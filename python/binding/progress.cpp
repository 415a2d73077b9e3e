#include "progress.h"

#include <string>

namespace flank::python {

namespace py = pybind11;

void PythonProgress::keep_error() {
  PyObject *type = nullptr, *value = nullptr, *trace = nullptr;
  PyErr_Fetch(&type, &value, &trace);
  PyErr_NormalizeException(&type, &value, &trace);
  if (value != nullptr && trace != nullptr) PyException_SetTraceback(value, trace);
  if (reason_.is_none() && value != nullptr) reason_ = py::reinterpret_borrow<py::object>(value);
  Py_XDECREF(type);
  Py_XDECREF(value);
  Py_XDECREF(trace);
}

bool PythonProgress::stopped() {
  const py::gil_scoped_acquire lock;
  if (!reason_.is_none()) return true;
  const auto now = std::chrono::steady_clock::now();
  if (now - looked_ < kEvery) return false;
  looked_ = now;
  if (PyErr_CheckSignals() != 0) keep_error();
  return !reason_.is_none();
}

Progress PythonProgress::progress() {
  Progress progress;
  progress.cancelled = [this] { return stopped(); };
  if (callback_.is_none()) return progress;
  progress.report = [this](std::string_view stage, double share) {
    const py::gil_scoped_acquire lock;
    if (!reason_.is_none()) return;
    try {
      callback_(py::str(stage.data(), stage.size()), share);
    } catch (py::error_already_set& error) {
      error.restore();
      keep_error();
    }
  };
  return progress;
}

}  // namespace flank::python
