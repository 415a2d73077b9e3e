// The judge: swept distances, and the verdict over faces.
#include "flank/judge.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>

#include "arrays.h"
#include "bindings.h"
#include "flank/part.h"

namespace flank::python {
namespace {

struct SweptDistances {
  std::vector<SweptDistance> all;
};

SweptDistances swept(const Tool& tool, const Path& path, const Doubles& points, double horizon_mm) {
  const std::span<const Vec3> at = points_of(points, "points");
  const py::gil_scoped_release release;
  SweptDistances out{std::vector<SweptDistance>(at.size())};
  SweptVolume(tool, path).distances(at, horizon_mm, out.all);
  return out;
}

std::string verdict_text(Verdict verdict) {
  switch (verdict) {
    case Verdict::kNotRun:
      return "not run";
    case Verdict::kPass:
      return "pass";
    case Verdict::kOvercut:
      return "overcut";
    case Verdict::kGouge:
      return "gouge";
    case Verdict::kUnproved:
      return "unproved";
  }
  return "";
}

/// A face with its samples, and what owns its triangles.
struct JudgedFaces {
  std::vector<FaceSamples> samples;
  std::vector<TriangleMesh> meshes;
  std::vector<FaceShape> shapes;
};

JudgedFaces faces_of(const Part& part, const std::string& targets, const std::string& checked, double spacing_mm) {
  JudgedFaces judged;
  const std::vector<int> first = parse_face_list(part, targets);
  std::vector<int> all = first;
  if (!checked.empty())
    for (const int k : parse_face_list(part, checked))
      if (std::find(all.begin(), all.end(), k) == all.end()) all.push_back(k);
  judged.meshes.reserve(all.size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const bool target = k < first.size();
    if (part.is_mesh()) {
      judged.meshes.push_back(extract_mesh(part, {all[k]}));
      judged.samples.push_back(sample_mesh(part.face_id(all[k]), judged.meshes.back(), spacing_mm, target));
      judged.shapes.emplace_back(&judged.meshes.back());
    } else {
      const Face& face = part.faces[static_cast<std::size_t>(all[k])];
      judged.samples.push_back(sample_face(face, spacing_mm, target));
      judged.shapes.emplace_back(&face);
    }
  }
  return judged;
}

VerifyReport judge_faces(const Tool& tool, const Path& path, const Part& part, const std::string& faces,
                         double tolerance_mm, const std::string& check_faces, double spacing_mm) {
  const py::gil_scoped_release release;
  const JudgedFaces judged = faces_of(part, faces, check_faces, spacing_mm);
  JudgeOptions options;
  options.tolerance_mm = tolerance_mm;
  VerifyReport report = judge(tool, path, judged.samples, judged.shapes, options);
  for (const auto& [face, why] : part.left_out) report.unread_faces.push_back({part.face_id(face), why});
  return report;
}

void bind_swept(py::module_& module) {
  py::class_<SweptDistances> type(module, "SweptDistances",
                                  "How far N points are from the tool on its path, and where.");
  const auto column = [&](const char* name, auto member, const char* doc) {
    type.def_property_readonly(
        name,
        [member](const py::object& self) {
          const auto& all = self.cast<const SweptDistances&>().all;
          return member_view(all, &(first_of(all)->*member), 0, self);
        },
        doc);
  };
  column("f_mm", &SweptDistance::f, "(N,), mm; negative: gouge, positive: excess material. A view, not a copy.");
  column("strip", &SweptDistance::strip,
         "(N,): index of the pass, from 0; -1: the tool comes nowhere within horizon_mm. No copy.");
  column("t", &SweptDistance::t, "(N,): index of the CL point, and fraction. No copy.");
  column("s", &SweptDistance::s, "(N,), mm: arc length on the axis, in [0, L]. No copy.");
  module.def(
      "swept_distances", &swept, py::arg("tool"), py::arg("path"), py::arg("points"), py::arg("horizon_mm") = 1e300,
      "f(x) = least distance, over the whole path, from x to the tool: for N x 3 points, mm. Exact to about 1e-9 "
      "mm up to horizon_mm. Raises InputError for an invalid tool or invalid CL points.");
}

void bind_report_parts(py::module_& module) {
  py::class_<FaceVerdict>(module, "FaceVerdict", "The figures of one face.")
      .def_readonly("face", &FaceVerdict::face, "\"F1\".")
      .def_readonly("target", &FaceVerdict::target, "Whether the face is machined; else it is a check surface.")
      .def_readonly("area_mm2", &FaceVerdict::area_mm2, "Area, mm^2.")
      .def_readonly("copies", &FaceVerdict::copies,
                    "Equal faces that it stands for in the coverage of all, itself among them.")
      .def_readonly("overcut_mm", &FaceVerdict::overcut_mm, "Deepest gouge found, mm.")
      .def_readonly("overcut_bound_mm", &FaceVerdict::overcut_bound_mm, "Proved bound of the gouge, mm.")
      .def_readonly("undercut_mm", &FaceVerdict::undercut_mm, "Most excess material, mm (machined faces only).")
      .def_readonly("rms_mm", &FaceVerdict::rms_mm, "RMS of f, mm, where a pass goes over the face.")
      .def_readonly("coverage", &FaceVerdict::coverage, "Finished share of the area: |f| <= tolerance.")
      .def_readonly("coverage_reachable", &FaceVerdict::coverage_reachable, "Finished share of the accessible area.")
      .def("__repr__", [](const FaceVerdict& f) { return "<openflank.FaceVerdict " + f.face + ">"; });
  py::class_<WorstPlace>(module, "WorstPlace", "A place where a face is gouged.")
      .def_readonly("face", &WorstPlace::face, "\"F1\".")
      .def_property_readonly(
          "point", [](const py::object& self) { return view(self.cast<const WorstPlace&>().point.data(), {3}, self); },
          "(3,), mm. No copy.")
      .def_readonly("f_mm", &WorstPlace::f, "mm, negative.")
      .def_readonly("strip", &WorstPlace::strip, "0-based.")
      .def_readonly("t", &WorstPlace::t, "Index of the CL point, and fraction.")
      .def_readonly("s", &WorstPlace::s, "Arc length on the axis, mm.");
}

}  // namespace

void bind_judge(py::module_& module) {
  bind_swept(module);
  bind_report_parts(module);
  const auto numbers = [](std::vector<double> VerifyReport::*all) {
    return [all](const py::object& self) {
      const std::vector<double>& values = self.cast<const VerifyReport&>().*all;
      return view(values.data(), {static_cast<py::ssize_t>(values.size())}, self);
    };
  };
  py::class_<VerifyReport, std::shared_ptr<VerifyReport>>(
      module, "VerifyReport", "The check of a tool and a path: the surface that they really leave.")
      .def_property_readonly(
          "verdict", [](const VerifyReport& r) { return verdict_text(r.verdict); },
          "pass, overcut, gouge, unproved or not run.")
      .def_readonly("tolerance_mm", &VerifyReport::tolerance_mm, "mm.")
      .def_readonly("allowance_mm", &VerifyReport::allowance_mm,
                    "mm left on purpose: every error is measured from the faces moved out by this.")
      .def_readonly("coverage", &VerifyReport::coverage, "Finished share of the machined faces: |f| <= tolerance.")
      .def_readonly("coverage_reachable", &VerifyReport::coverage_reachable, "Finished share of the accessible area.")
      .def_readonly("reachable_share", &VerifyReport::reachable_share, "Share of the area that is accessible.")
      .def_readonly("overcut_mm", &VerifyReport::overcut_mm, "Deepest gouge found in a machined face, mm.")
      .def_readonly("overcut_bound_mm", &VerifyReport::overcut_bound_mm,
                    "Proved bound of the gouge of machined faces, mm.")
      .def_readonly("undercut_mm", &VerifyReport::undercut_mm, "Most excess material on a machined face, mm.")
      .def_readonly("rms_mm", &VerifyReport::rms_mm, "RMS of f, mm, where a pass goes over the face.")
      .def_readonly("gouge_mm", &VerifyReport::gouge_mm, "Deepest gouge found in a check surface, mm.")
      .def_readonly("gouge_bound_mm", &VerifyReport::gouge_bound_mm, "Proved bound of the gouge of check surfaces, mm.")
      .def_readonly("faces", &VerifyReport::faces, "The figures of each face.")
      .def_property_readonly(
          "unread_faces",
          [](const VerifyReport& r) {
            std::vector<std::pair<std::string, std::string>> all;
            for (const UnjudgedFace& face : r.unread_faces) all.emplace_back(face.face, face.why);
            return all;
          },
          "Faces of the file that could not be read and so were not checked, each with its reason.")
      .def_property_readonly(
          "largest_turn_deg",
          [](const VerifyReport& r) { return r.turn ? std::optional(r.turn->angle_deg) : std::nullopt; },
          "Largest change of the motion's direction within 1 % of the face's diagonal, degrees; None if not measured.")
      .def_readonly("worst", &VerifyReport::worst, "The deepest places, over all faces.")
      .def_property_readonly("histogram_edges_mm", numbers(&VerifyReport::histogram_edges_mm),
                             "Edges of the bins of f over the machined faces, mm. No copy.")
      .def_property_readonly("histogram_area_mm2", numbers(&VerifyReport::histogram_area_mm2),
                             "Area of each bin, mm^2. No copy.")
      .def("__repr__",
           [](const VerifyReport& r) { return "<openflank.VerifyReport, " + verdict_text(r.verdict) + ">"; });
  module.def("judge", &judge_faces, py::arg("tool"), py::arg("path"), py::arg("part"), py::arg("faces"),
             py::arg("tolerance_mm"), py::arg("check_faces") = "", py::arg("spacing_mm") = 1.0,
             "Checks tool and path on faces (\"F1,F3\") of a part at samples spacing_mm apart, mm, with a proved bound "
             "of every gouge. Raises UsageError and InputError.");
}

}  // namespace flank::python
