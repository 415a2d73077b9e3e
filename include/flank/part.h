/// Reading a part: CAD files (STEP, IGES, BREP) and triangle meshes (STL, OBJ, PLY).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/face.h"
#include "flank/triangle_mesh.h"

namespace flank {

/// A file as values, in millimetres. Either `faces` (CAD) or `mesh` with `mesh_faces` is filled.
struct Part {
  std::string file;
  std::string format;  ///< STEP, IGES, BREP, STL, OBJ, PLY
  std::string unit;    ///< of the file: mm, cm, m, in
  double millimetres_per_unit = 1.0;
  std::vector<Face> faces;                 ///< in the order of the file; faces[k].id == "F" + (k + 1)
  std::vector<std::string> surface_types;  ///< plane, cylinder, B-spline, ... as the file has them, for `inspect`
  int solids = 0;
  TriangleMesh mesh;
  std::vector<std::vector<int>> mesh_faces;  ///< triangles of F1, F2, ... (regions bounded by sharp edges)
  std::vector<std::string> repairs;          ///< what was repaired, one sentence each, with counts
  Box3 box;                                  ///< tight (of the tessellation, not of the poles)

  [[nodiscard]] bool is_mesh() const { return !mesh.triangles.empty(); }
  [[nodiscard]] int face_count() const { return static_cast<int>(is_mesh() ? mesh_faces.size() : faces.size()); }
};

/// Reads a part. `unit` ("mm", "cm", "m", "in") is needed for meshes, whose files have none, and refused for CAD files
/// that state another. Throws InputError naming the file and what would be accepted (missing, empty, truncated, not the
/// format that it claims, no unit, NaN coordinates, ...).
[[nodiscard]] Part read_part(const std::string& file, const std::optional<std::string>& unit = {});

/// Indices into faces (or mesh_faces) of a list such as "F1,F3". Throws InputError naming the face and the range that
/// exists.
[[nodiscard]] std::vector<int> parse_face_list(const Part& part, const std::string& list);

/// The triangles of one mesh face as a mesh of their own (vertices renumbered).
[[nodiscard]] TriangleMesh extract_mesh(const Part& part, const std::vector<int>& faces);

}  // namespace flank
