/// NumPy arrays over the library's memory, and the other way round: nothing is copied where the layout allows it.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <span>
#include <string>
#include <vector>

#include "flank/error.h"
#include "flank/vec.h"

namespace flank::python {

namespace py = pybind11;

static_assert(sizeof(Vec2) == 2 * sizeof(double) && sizeof(Vec3) == 3 * sizeof(double));
static_assert(sizeof(Pose) == 6 * sizeof(double), "a pose is tip and axis, one after the other");

/// What is read from arrays of Python: doubles in C order; other arrays and lists are converted.
using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// A read-only array of `shape` over memory that `owner` keeps alive; `strides` in bytes, none: contiguous.
template <class T>
[[nodiscard]] py::array view(const T* first, std::vector<py::ssize_t> shape, py::handle owner,
                             std::vector<py::ssize_t> strides = {}) {
  py::array_t<T> array(std::move(shape), std::move(strides), first, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// N x 3 or N x 2 over vectors of points.
template <class Point>
[[nodiscard]] py::array points_view(const std::vector<Point>& points, py::handle owner) {
  constexpr py::ssize_t kWidth = Point::RowsAtCompileTime;
  const auto count = static_cast<py::ssize_t>(points.size());
  return view(points.empty() ? nullptr : points.front().data(), {count, kWidth}, owner);
}

/// The first of a vector, or one that stands in where there is none, so that the place of a member can be told.
template <class Struct>
[[nodiscard]] const Struct* first_of(const std::vector<Struct>& all) {
  static const Struct none{};
  return all.empty() ? &none : all.data();
}

/// One member of each of a vector's structs, of `width` numbers (0: a plain number): N or N x width.
template <class Struct, class T>
[[nodiscard]] py::array member_view(const std::vector<Struct>& all, const T* first, py::ssize_t width,
                                    py::handle owner) {
  const auto count = static_cast<py::ssize_t>(all.size());
  constexpr auto kStep = static_cast<py::ssize_t>(sizeof(Struct)), kOne = static_cast<py::ssize_t>(sizeof(T));
  if (width == 0) return view(first, {count}, owner, {kStep});
  return view(first, {count, width}, owner, {kStep, kOne});
}

/// The rows of an N x width array. Throws UsageError naming the argument.
[[nodiscard]] inline std::size_t rows(const Doubles& array, py::ssize_t width, const std::string& name) {
  if (array.ndim() != 2 || array.shape(1) != width)
    throw UsageError(name, "expected an array N x " + std::to_string(width));
  return static_cast<std::size_t>(array.shape(0));
}

/// The rows of an N x 3 array as points, for as long as the array lives.
[[nodiscard]] inline std::span<const Vec3> points_of(const Doubles& array, const std::string& name) {
  const std::size_t count = rows(array, 3, name);
  return {reinterpret_cast<const Vec3*>(array.data()), count};
}

/// A copy of the rows of an N x 2 array.
[[nodiscard]] inline std::vector<Vec2> profile_of(const Doubles& array, const std::string& name) {
  const std::size_t count = array.size() == 0 ? 0 : rows(array, 2, name);
  const auto* first = reinterpret_cast<const Vec2*>(array.data());
  return {first, first + count};
}

/// A 1-D array of numbers. Throws UsageError naming the argument.
[[nodiscard]] inline std::span<const double> numbers_of(const Doubles& array, const std::string& name) {
  if (array.ndim() != 1) throw UsageError(name, "expected an array of one dimension");
  return {array.data(), static_cast<std::size_t>(array.size())};
}

/// 2 x 3: the lowest and the highest corner.
[[nodiscard]] inline py::array box_array(const Box3& box) {
  py::array_t<double> array({2, 3});
  for (int k = 0; k < 3; ++k) {
    array.mutable_at(0, k) = box.low[k];
    array.mutable_at(1, k) = box.high[k];
  }
  return array;
}

}  // namespace flank::python
