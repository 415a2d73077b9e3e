/// Reading a part: CAD files and triangle meshes.
///
/// What is guaranteed of a part that was read:
/// - lengths are in mm, whatever the unit of the file; every number is finite
/// - faces keep the numbers that the file gives them: one that cannot be read has its number, no geometry, and a reason
///   (`left_out`), so that no verdict can pass over it
/// - every repair is one sentence of `repairs`
/// - the same file gives the same values; `sha256` is that of its bytes
///
/// Any bytes may be given: what is no part is refused by InputError, which names file and place (SECURITY.md).
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "flank/face.h"
#include "flank/triangle_mesh.h"

namespace flank {

/// A file as values, in millimetres. Either `faces` (CAD) or `mesh` with `mesh_faces` is filled.
struct Part {
  std::string file;
  std::string sha256;  ///< of the bytes of the file, 64 hexadecimal digits
  std::string format;  ///< one of part_formats()
  std::string unit;    ///< of the file: mm, cm, m, in
  double millimetres_per_unit = 1.0;
  /// In the order of the file; faces[k].id == "F" + (k + 1) as long as no face is replaced by its pieces (split_faces).
  std::vector<Face> faces;
  std::vector<std::string> surface_types;  ///< plane, cylinder, B-spline, ... as the file has them, for `inspect`
  /// Why faces could not be read, by index into `faces`; such a face has an id and nothing else, and is looked at by
  /// nobody.
  std::map<int, std::string> left_out;
  int solids = 0;
  TriangleMesh mesh;
  std::vector<std::vector<int>> mesh_faces;  ///< triangles of F1, F2, ... (regions bounded by sharp edges)
  std::vector<std::string> repairs;          ///< what was repaired, one sentence each, with counts
  Box3 box;                                  ///< tight (of the tessellation, not of the poles)

  [[nodiscard]] bool is_mesh() const { return !mesh.triangles.empty(); }
  [[nodiscard]] int face_count() const { return static_cast<int>(is_mesh() ? mesh_faces.size() : faces.size()); }
  /// "F3", or "F3b" for a piece of it.
  [[nodiscard]] std::string face_id(int face) const {
    return is_mesh() ? "F" + std::to_string(face + 1) : faces[static_cast<std::size_t>(face)].id;
  }
  [[nodiscard]] bool is_left_out(int face) const { return left_out.count(face) > 0; }
};

/// A part whose box is larger has a wrong unit, most likely: no machine takes it. It gets a note.
inline constexpr double kLargestPartMm = 20000.0;
/// The same for a smaller one: no flank could be milled with any tool there is.
inline constexpr double kSmallestPartMm = 1.0;
/// Coordinates beyond this are refused: they are no lengths of a part, and doubles resolve nanometres only up to it.
inline constexpr double kLargestCoordinateMm = 1e7;

/// A part whose box is smaller is refused: its details would be below what any machine and any judge resolves.
inline constexpr double kSmallestBoxMm = 1e-3;

/// The formats that are read: "STEP, IGES, BREP, STL, OBJ or PLY".
[[nodiscard]] std::string part_formats();

/// Reads a part. `unit` ("mm", "cm", "m", "in") is needed for meshes, whose files have none; a CAD file that states another
/// one is read in this one, with a note: `sha256` is that of the file, whatever unit its numbers are read in. Throws
/// InputError naming the file and what would be accepted (missing, empty, truncated, not the format that it claims, no
/// unit, coordinates that are NaN or no lengths of a part, ...).
[[nodiscard]] Part read_part(const std::string& file, const std::optional<std::string>& unit = {});

/// Replaces each face of which `list` names a piece ("F1a") by its pieces F1a, F1b, ...: the sides of an aerofoil and
/// the edges between them, told apart by curvature (docs/algorithms/pieces.md). Indices of later faces change.
/// Throws InputError for a face that does not split into pieces. Other faces stay as they are.
void split_faces(Part& part, const std::string& list);

/// Indices into faces (or mesh_faces) of a list such as "F1,F3-F5,F7a,S2". A range has both its ends; the name of a face
/// that is split means all its pieces; S2 is all faces of the second solid that could be read. Throws InputError naming
/// the face and the range that exists, or why a face was left out.
[[nodiscard]] std::vector<int> parse_face_list(const Part& part, const std::string& list);

/// The triangles of one mesh face as a mesh of their own (vertices renumbered).
[[nodiscard]] TriangleMesh extract_mesh(const Part& part, const std::vector<int>& faces);

}  // namespace flank
