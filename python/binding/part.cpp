// Parts, their faces, and targets made of them.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>
#include <memory>

#include "arrays.h"
#include "bindings.h"
#include "flank/part.h"
#include "flank/target.h"
#include "part_face.h"

namespace flank::python {
namespace {

using SharedPart = std::shared_ptr<const Part>;

/// A target and all that Python sees of it.
struct Footpoints {
  std::vector<Footpoint> all;
};
struct Samples {
  std::vector<SurfaceSample> all;
};

SharedPart read(const std::filesystem::path& file, const std::optional<std::string>& unit, const std::string& pieces) {
  const py::gil_scoped_release release;
  Part part = read_part(file.string(), unit);
  if (!pieces.empty()) split_faces(part, pieces);
  return std::make_shared<const Part>(std::move(part));
}

std::vector<PartFace> faces_of(const SharedPart& part) {
  std::vector<PartFace> faces;
  for (int k = 0; k < part->face_count(); ++k) faces.push_back({part, k});
  return faces;
}

/// The target of faces named by a list such as "F1,F3-F5".
std::shared_ptr<Target> target_of(const SharedPart& part, const std::string& list, int side) {
  const py::gil_scoped_release release;
  if (side != 1 && side != -1) throw UsageError("side", std::to_string(side), "expected +1 or -1");
  const std::vector<int> chosen = parse_face_list(*part, list);
  if (part->is_mesh()) return make_target(extract_mesh(*part, chosen));
  std::vector<Face> faces;
  for (const int k : chosen) faces.push_back(part->faces[static_cast<std::size_t>(k)]);
  return make_target(std::move(faces), side);
}

Footpoints closest(const Target& target, const Doubles& points) {
  const std::span<const Vec3> queries = points_of(points, "points");
  const py::gil_scoped_release release;
  Footpoints found{std::vector<Footpoint>(queries.size())};
  target.closest_batch(queries, found.all);
  return found;
}

void bind_part_class(py::module_& module) {
  py::class_<Part, std::shared_ptr<Part>> type(
      module, "Part", "A part as values, in millimetres: faces as B-splines with trims, or a mesh. Made by read_part.");
  type.def_readonly("file", &Part::file, "Name of the file.")
      .def_readonly("sha256", &Part::sha256, "SHA-256 of the file, 64 hexadecimal digits.")
      .def_readonly("format", &Part::format, "Format of the file: STEP, STL, ...")
      .def_readonly("unit", &Part::unit, "Unit of the file: mm, cm, m or in.")
      .def_readonly("solids", &Part::solids, "Number of solids.")
      .def_readonly("repairs", &Part::repairs, "What was repaired, one sentence each.")
      .def_property_readonly("is_mesh", &Part::is_mesh, "Whether the part is a mesh.")
      .def_property_readonly(
          "box", [](const Part& p) { return box_array(p.box); },
          "Lowest and highest corner of the bounding box, 2 x 3, mm; tight.")
      .def_property_readonly(
          "faces", [](const std::shared_ptr<Part>& p) { return faces_of(p); },
          "The faces F1, F2, ... in the order of the file.")
      .def_property_readonly(
          "vertices", [](const py::object& self) { return points_view(self.cast<const Part&>().mesh.vertices, self); },
          "Vertices of a mesh: N x 3, mm. No copy.")
      .def_property_readonly(
          "triangles",
          [](const py::object& self) {
            const auto& all = self.cast<const Part&>().mesh.triangles;
            const auto count = static_cast<py::ssize_t>(all.size());
            return view(all.empty() ? nullptr : all.front().data(), {count, 3}, self);
          },
          "Triangles of a mesh: indices of vertices, M x 3, counter-clockwise seen from the machining side. No copy.");
  type.def(
      "__getitem__",
      [](const std::shared_ptr<Part>& part, const std::string& id) {
        const std::vector<int> found = parse_face_list(*part, id);
        if (found.size() != 1) throw UsageError("face", id, "is not one face");
        return PartFace{part, found.front()};
      },
      py::arg("id"), "The face of this name: part[\"F1\"]. Raises InputError, which names the faces of the part.");
  type.def(
      "target",
      [](const std::shared_ptr<Part>& part, const std::string& faces, int side) {
        return target_of(part, faces, side);
      },
      py::arg("faces"), py::arg("side") = 1,
      "The target of faces such as \"F1,F3-F5\"; side -1: machined from the other side of their normals. Raises "
      "InputError.");
  type.def("__repr__", [](const Part& p) {
    return "<openflank.Part " + p.file + ", " + p.format + ", " + std::to_string(p.face_count()) + " faces>";
  });
}

void bind_target_class(py::module_& module) {
  py::class_<Footpoints> footpoints(module, "Footpoints", "Closest points of a target, one for each of N queries.");
  const auto column = [&](const char* name, auto member, py::ssize_t width, const char* doc) {
    footpoints.def_property_readonly(
        name,
        [member, width](const py::object& self) {
          const auto& all = self.cast<const Footpoints&>().all;
          return member_view(all, member(*first_of(all)), width, self);
        },
        doc);
  };
  column(
      "points", [](const Footpoint& f) { return f.point.data(); }, 3, "N x 3, mm, on the target. No copy.");
  column(
      "normals", [](const Footpoint& f) { return f.normal.data(); }, 3,
      "N x 3, unit, towards the machining side. No copy.");
  column(
      "distances_mm", [](const Footpoint& f) { return &f.distance; }, 0,
      "(N,), mm, signed: negative on the material's side. No copy.");
  column(
      "k1", [](const Footpoint& f) { return &f.k1; }, 0,
      "(N,), 1/mm: the smaller principal curvature, positive where the target bends towards the machining side.");
  column(
      "k2", [](const Footpoint& f) { return &f.k2; }, 0, "(N,), 1/mm: the larger principal curvature. No copy.");
  column(
      "uv", [](const Footpoint& f) { return &f.u; }, 2, "N x 2: surface parameters. No copy.");
  column(
      "patch", [](const Footpoint& f) { return &f.patch; }, 0, "(N,): index of the target's face, or triangle.");

  py::class_<Samples> samples(module, "Samples",
                              "Dense samples of machined faces: the centres of N cells of the surface.");
  const auto sample = [&](const char* name, auto member, py::ssize_t width, const char* doc) {
    samples.def_property_readonly(
        name,
        [member, width](const py::object& self) {
          const auto& all = self.cast<const Samples&>().all;
          return member_view(all, member(*first_of(all)), width, self);
        },
        doc);
  };
  sample(
      "points", [](const SurfaceSample& s) { return s.point.data(); }, 3, "N x 3, mm. No copy.");
  sample(
      "normals", [](const SurfaceSample& s) { return s.normal.data(); }, 3,
      "N x 3, unit, towards the machining side. No copy.");
  sample(
      "areas_mm2", [](const SurfaceSample& s) { return &s.area; }, 0,
      "(N,), mm^2: the share of the area that each stands for. No copy.");

  py::class_<Target, std::shared_ptr<Target>> type(module, "Target", "The machined faces: trimmed faces or a mesh.");
  type.def_property_readonly("area_mm2", &Target::area, "Area, mm^2.")
      .def_property_readonly("diagonal_mm", &Target::diagonal, "Diagonal of the bounding box, mm.")
      .def_property_readonly(
          "box", [](const Target& t) { return box_array(t.box()); }, "Lowest and highest corner, 2 x 3, mm.")
      .def("closest", &closest, py::arg("points"), "The globally closest point for each of N x 3 points, mm.")
      .def(
          "samples",
          [](const Target& t, double spacing_mm) {
            if (!(spacing_mm > 0.0)) throw UsageError("spacing_mm", "expected a length > 0 mm");
            const py::gil_scoped_release release;
            return Samples{t.samples(spacing_mm)};
          },
          py::arg("spacing_mm"), "Samples about spacing_mm apart, in a fixed order.");
}

}  // namespace

void bind_part(py::module_& module) {
  bind_target_class(module);
  bind_part_face(module);
  bind_part_class(module);
  module.def(
      "read_part", &read, py::arg("file"), py::arg("unit") = py::none(), py::arg("pieces") = "",
      ("Reads a " + part_formats() +
       " file. unit (\"mm\", \"cm\", \"m\", \"in\") is required for a mesh, "
       "whose file has none. pieces: faces to be split into sides and edges, \"F1a\". Raises InputError naming the "
       "file and what would be accepted.")
          .c_str());
}

}  // namespace flank::python
