#include "part_face.h"

#include <pybind11/stl.h>

#include "arrays.h"
#include "flank/target.h"

namespace flank::python {
namespace {

const BSplineSurface& surface_of(const PartFace& face) {
  if (face.part->is_mesh()) throw UsageError("face", face.id(), "is of a mesh and has no B-spline surface");
  if (face.part->is_left_out(face.index)) throw InputError(face.id() + ": " + face.part->left_out.at(face.index));
  return face.face().surface;
}

std::string type_of(const PartFace& face) {
  if (face.part->is_mesh()) return "mesh";
  if (face.part->is_left_out(face.index)) return "not read";
  const auto k = static_cast<std::size_t>(face.index);
  return k < face.part->surface_types.size() ? face.part->surface_types[k] : "B-spline";
}

/// Points or unit normals (away from the material where the face bounds a solid) at N x 2 parameters.
py::array evaluate(const PartFace& face, const Doubles& uv, bool normals) {
  const BSplineSurface& surface = surface_of(face);
  const auto count = static_cast<py::ssize_t>(rows(uv, 2, "uv"));
  py::array_t<double> out({count, py::ssize_t{3}});
  const double sign = face.face().reversed ? -1.0 : 1.0;
  for (py::ssize_t k = 0; k < count; ++k) {
    const SurfaceJet jet = surface.jet(uv.at(k, 0), uv.at(k, 1));
    const Vec3 value = normals ? Vec3(sign * jet.du.cross(jet.dv).normalized()) : jet.p;
    for (int i = 0; i < 3; ++i) out.mutable_at(k, i) = value[i];
  }
  return out;
}

std::unique_ptr<Target> target_of(const PartFace& face) {
  const py::gil_scoped_release release;
  if (face.part->is_mesh()) return make_target(extract_mesh(*face.part, {face.index}));
  (void)surface_of(face);
  return make_target({face.face()});
}

py::array poles_of(const py::object& self) {
  const BSplineSurface& s = surface_of(self.cast<const PartFace&>());
  return view(s.poles.front().data(), {s.count_u, s.count_v, 3}, self);
}

py::array weights_of(const py::object& self) {
  const BSplineSurface& s = surface_of(self.cast<const PartFace&>());
  if (s.weights.empty()) return view<double>(nullptr, {0, 0}, self);
  return view(s.weights.data(), {s.count_u, s.count_v}, self);
}

py::array knots_of(const py::object& self, std::vector<double> BSplineSurface::*knots) {
  const std::vector<double>& all = surface_of(self.cast<const PartFace&>()).*knots;
  return view(all.data(), {static_cast<py::ssize_t>(all.size())}, self);
}

void bind_surface(py::class_<PartFace>& type) {
  type.def_property_readonly(
          "degree", [](const PartFace& f) { return py::make_tuple(surface_of(f).degree_u, surface_of(f).degree_v); },
          "Degrees of the B-spline along u and v.")
      .def_property_readonly("poles", &poles_of, "Control points, n_u x n_v x 3, mm. No copy.")
      .def_property_readonly("weights", &weights_of, "Weights, n_u x n_v; 0 x 0: polynomial. No copy.")
      .def_property_readonly(
          "knots_u", [](const py::object& self) { return knots_of(self, &BSplineSurface::knots_u); },
          "Knots along u, (n_u + degree + 1,). No copy.")
      .def_property_readonly(
          "knots_v", [](const py::object& self) { return knots_of(self, &BSplineSurface::knots_v); },
          "Knots along v, (n_v + degree + 1,). No copy.")
      .def(
          "points", [](const PartFace& f, const Doubles& uv) { return evaluate(f, uv, false); }, py::arg("uv"),
          "Points of the surface at parameters N x 2: N x 3, mm; also outside the trims.")
      .def(
          "normals", [](const PartFace& f, const Doubles& uv) { return evaluate(f, uv, true); }, py::arg("uv"),
          "Unit normals at parameters N x 2: N x 3, away from the material if the face bounds a solid.");
}

}  // namespace

void bind_part_face(py::module_& module) {
  py::class_<PartFace> type(module, "Face",
                            "A face of a part: a B-spline surface with its trims, or a region of a mesh.");
  type.def_property_readonly("id", &PartFace::id, "\"F1\", or \"F1a\" for a piece.")
      .def_property_readonly("type", &type_of, "plane, cylinder, B-spline, ... as the file has it; mesh; not read.")
      .def_property_readonly(
          "left_out",
          [](const PartFace& f) {
            const auto found = f.part->left_out.find(f.index);
            return found == f.part->left_out.end() ? std::string() : found->second;
          },
          "Why the face could not be read; empty if it could.")
      .def_property_readonly(
          "area_mm2", [](const PartFace& f) { return target_of(f)->area(); }, "Area inside its trims, mm^2.")
      .def_property_readonly(
          "box", [](const PartFace& f) { return box_array(target_of(f)->box()); },
          "Lowest and highest corner, 2 x 3, mm.")
      .def_property_readonly(
          "trims", [](const PartFace& f) { return f.part->is_mesh() ? 0 : static_cast<int>(f.face().loops.size()); },
          "Closed loops that trim it; 0: the whole parameter rectangle, or a mesh.")
      .def_property_readonly(
          "of_solid", [](const PartFace& f) { return !f.part->is_mesh() && f.face().of_solid; },
          "Whether it bounds a solid; else its normal says nothing about where the material is.");
  bind_surface(type);
  type.def("__repr__", [](const PartFace& f) { return "<openflank.Face " + f.id() + ", " + type_of(f) + ">"; });
}

}  // namespace flank::python
