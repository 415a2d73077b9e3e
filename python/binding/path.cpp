// Paths, motions and what a tool's motion envelops.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cmath>
#include <filesystem>

#include "arrays.h"
#include "bindings.h"
#include "flank/envelope.h"
#include "flank/path_file.h"
#include "flank/ruled_motion.h"
#include "flank/tool.h"

namespace flank::python {
namespace {

py::array poses_view(const std::vector<Pose>& poses, const py::object& owner) {
  const auto count = static_cast<py::ssize_t>(poses.size());
  return view(poses.empty() ? nullptr : poses.front().tip.data(), {count, 6}, owner);
}

/// An array that owns poses.
py::array poses_array(std::vector<Pose> poses) {
  auto* kept = new std::vector<Pose>(std::move(poses));
  const py::capsule owner(kept, [](void* p) { delete static_cast<std::vector<Pose>*>(p); });
  return poses_view(*kept, owner);
}

std::vector<Pose> poses_of(const Doubles& array, const std::string& where) {
  const std::size_t count = rows(array, 6, "poses");
  if (count == 0) throw UsageError("poses", where + " has none; expected at least one");
  std::vector<Pose> poses(count);
  const auto* first = reinterpret_cast<const Pose*>(array.data());
  for (std::size_t k = 0; k < count; ++k) {
    poses[k] = first[k];
    const double length = poses[k].axis.norm();
    if (!(std::abs(length - 1.0) <= kAxisLengthRounded) || !poses[k].tip.allFinite())
      throw UsageError(
          "poses", where + ", pose " + std::to_string(k) + ": expected x, y, z, i, j, k with a unit vector (i, j, k)");
    if (std::abs(length - 1.0) > kAxisLengthExact) poses[k].axis /= length;
  }
  return poses;
}

Path make_path(const std::vector<Doubles>& strips, const std::string& face, const std::string& kind) {
  Path path;
  for (const Doubles& strip : strips) {
    const int id = static_cast<int>(path.strips.size()) + 1;
    path.strips.push_back({id, kind, face, poses_of(strip, "strip " + std::to_string(id))});
  }
  if (path.strips.empty()) throw UsageError("strips", "expected at least one array of poses N x 6");
  return path;
}

Eigen::Matrix3Xd columns(const Doubles& points, const std::string& name) {
  const std::span<const Vec3> all = points_of(points, name);
  if (all.size() < 4) throw UsageError(name, "expected at least 4 points");
  Eigen::Matrix3Xd poles(3, static_cast<Eigen::Index>(all.size()));
  for (std::size_t k = 0; k < all.size(); ++k) poles.col(static_cast<Eigen::Index>(k)) = all[k];
  return poles;
}

RuledMotion make_motion(const Doubles& tip, const Doubles& direction, double axis_length_mm) {
  if (!(axis_length_mm > 0.0)) throw UsageError("axis_length_mm", "expected a length > 0 mm");
  RuledMotion motion;
  motion.axis_length = axis_length_mm;
  motion.tip.poles = columns(tip, "tip_poles");
  motion.direction.poles = columns(direction, "direction_poles");
  for (BSplineCurve3* rail : {&motion.tip, &motion.direction}) rail->knots = uniform_knots(rail->degree, rail->count());
  return motion;
}

/// Control points of a rail, n x 3: columns of the library are rows here.
py::array rail_view(const BSplineCurve3& rail, const py::object& owner) {
  return view(rail.poles.data(), {static_cast<py::ssize_t>(rail.count()), 3}, owner);
}

struct Envelope {
  std::vector<ContactPoint> points;
  py::ssize_t count_t = 0, count_s = 0;
  template <class T>
  [[nodiscard]] py::array grid(const T* first, py::ssize_t width, const py::object& owner) const {
    constexpr auto kStep = static_cast<py::ssize_t>(sizeof(ContactPoint));
    if (width == 0) return view(first, {count_t, count_s}, owner, {count_s * kStep, kStep});
    constexpr auto kOne = static_cast<py::ssize_t>(sizeof(T));
    return view(first, {count_t, count_s, width}, owner, {count_s * kStep, kStep, kOne});
  }
};

Envelope envelope_of(const RuledMotion& motion, const Tool& tool, int side, int count_t, int count_s) {
  if (side != 1 && side != -1) throw UsageError("side", std::to_string(side), "expected +1 or -1");
  if (count_t < 2 || count_s < 2) throw UsageError("count_t", "expected at least 2 steps of t and of s");
  const py::gil_scoped_release release;
  return {sample_envelope(motion, tool.radial, side, count_t, count_s), count_t, count_s};
}

void bind_path_classes(py::module_& module) {
  py::class_<Strip>(module, "Strip", "One pass.")
      .def_readonly("id", &Strip::id, "Number of the pass.")
      .def_readonly("kind", &Strip::kind, "flank, side, front, back, entry, link, ...")
      .def_readonly("layer", &Strip::layer, "Layer of a cavity, from 1 at the top; 0: no layer.")
      .def_readonly("face", &Strip::face, "The machined faces, \"F1\" or \"F1,F3\".")
      .def_property_readonly(
          "poses", [](const py::object& self) { return poses_view(self.cast<const Strip&>().poses, self); },
          "N x 6: tip x, y, z, mm, and unit vector i, j, k towards the holder. No copy.")
      .def("__len__", [](const Strip& s) { return s.poses.size(); });

  py::class_<Path, std::shared_ptr<Path>> type(
      module, "Path",
      "Passes in the order of machining; their CL points are joined by straight moves of tip and axis vector.");
  type.def(py::init(&make_path), py::arg("strips"), py::arg("face") = "F1", py::arg("kind") = "flank",
           "A path from arrays of CL points, each N x 6: tip x, y, z, mm, and unit vector i, j, k towards the holder. "
           "Raises UsageError naming pass and CL point.")
      .def_readonly("strips", &Path::strips, "The passes.")
      .def_property_readonly("pose_count", &Path::pose_count, "Number of CL points of all passes.")
      .def_static(
          "load", [](const std::filesystem::path& file) { return read_path(file.string()); }, py::arg("file"),
          "Reads a path.json. Raises InputError naming file, pass and CL point.")
      .def(
          "save", [](const Path& path, const std::filesystem::path& file) { write_path(path, file.string()); },
          py::arg("file"), "Writes a path.json, completely or not at all. Raises InputError.")
      .def("to_json", &path_to_json, "The text of path.json; its numbers are read back exactly.")
      .def_static(
          "from_json", [](const std::string& text) { return path_from_json(text, "text"); }, py::arg("text"),
          "The path of a path.json's text. Raises InputError naming pass and CL point.")
      .def("__len__", [](const Path& p) { return p.strips.size(); })
      .def("__repr__", [](const Path& p) {
        return "<openflank.Path, " + std::to_string(p.strips.size()) + " strips, " + std::to_string(p.pose_count()) +
               " poses>";
      });
}

}  // namespace

void bind_path(py::module_& module) {
  bind_path_classes(module);
  py::class_<Envelope>(module, "Envelope", "Contact points of a moving tool on a grid of times and arc lengths.")
      .def_property_readonly(
          "points",
          [](const py::object& self) {
            const auto& e = self.cast<const Envelope&>();
            return e.grid(e.points.front().point.data(), 3, self);
          },
          "count_t x count_s x 3, mm. No copy.")
      .def_property_readonly(
          "normals",
          [](const py::object& self) {
            const auto& e = self.cast<const Envelope&>();
            return e.grid(e.points.front().normal.data(), 3, self);
          },
          "count_t x count_s x 3, unit, from the axis to the contact point. No copy.")
      .def_property_readonly(
          "c",
          [](const py::object& self) {
            const auto& e = self.cast<const Envelope&>();
            return e.grid(&e.points.front().c, 0, self);
          },
          "count_t x count_s: axial slip c; a contact exists where |c| < 1. No copy.");

  py::class_<RuledMotion, std::shared_ptr<RuledMotion>>(
      module, "RuledMotion",
      "A rigid motion of the tool axis, t in [0, 1]: tip rail and direction rail, cubic B-splines.")
      .def(py::init(&make_motion), py::arg("tip_poles"), py::arg("direction_poles"), py::arg("axis_length_mm"),
           "A motion from control points of tip and direction, n x 3, n >= 4 (tip: mm, direction: near unit length).")
      .def_readonly("axis_length_mm", &RuledMotion::axis_length, "Length of the axis, mm.")
      .def_property_readonly(
          "tip_poles", [](const py::object& self) { return rail_view(self.cast<const RuledMotion&>().tip, self); },
          "Control points of the tip rail, n x 3, mm. No copy.")
      .def_property_readonly(
          "direction_poles",
          [](const py::object& self) { return rail_view(self.cast<const RuledMotion&>().direction, self); },
          "Control points of the direction rail, n x 3. No copy.")
      .def(
          "poses",
          [](const RuledMotion& motion, const Doubles& t) {
            std::vector<Pose> poses;
            for (const double at : numbers_of(t, "t")) poses.push_back(motion.pose(at));
            return poses_array(std::move(poses));
          },
          py::arg("t"), "CL points at times t (N,) in [0, 1]: N x 6, tip (mm) and unit vector towards the holder.")
      .def(
          "sample",
          [](const RuledMotion& motion, double chord_tolerance_mm) {
            SamplingOptions options;
            options.chord_tolerance_mm = chord_tolerance_mm;
            return poses_array(sample_motion(motion, options).poses);
          },
          py::arg("chord_tolerance_mm") = SamplingOptions().chord_tolerance_mm,
          "CL points N x 6, so dense that the chord error is at most chord_tolerance_mm: proved.")
      .def("envelope", &envelope_of, py::arg("tool"), py::arg("side") = 1, py::arg("count_t") = 101,
           py::arg("count_s") = 101,
           "Contact points of the tool under this motion, at equal steps of t and s; side +1 or -1 of the axis.");
}

}  // namespace flank::python
