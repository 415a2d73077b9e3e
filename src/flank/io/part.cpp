#include "flank/part.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <string_view>
#include <utility>

#include "flank/base/sha256.h"
#include "flank/error.h"
#include "flank/io/isolated/cad_reader.h"
#include "flank/io/mesh/read_mesh_regions.h"
#include "flank/io/mesh/read_mesh_repair.h"
#include "flank/io/mesh/read_stl.h"
#include "flank/io/part_format.h"
#include "flank/io/part_range.h"
#include "flank/io/text/read_bytes.h"
#include "flank/io/text/read_unit.h"

namespace flank {
using namespace internal;
namespace {

/// "cm: 42.8 x 74.4 x 48.4 mm" for every unit, so that the user recognises the right one.
std::string sizes_by_unit(const Vec3& size) {
  std::string text;
  for (const char* unit : {"mm", "cm", "m", "in"}) {
    const Vec3 mm = millimetres_per(unit) * size;
    text += fmt::format("{}{} ({:.3g} x {:.3g} x {:.3g} mm)", text.empty() ? "" : ", ", unit, mm.x(), mm.y(), mm.z());
  }
  return text;
}

/// In the unit of the file.
TriangleMesh parse_mesh(const std::string& file, const PartFormat& format, std::string_view content) {
  TriangleMesh mesh = format.read(file, content);
  if (mesh.triangles.empty()) throw InputError(file + ": has no triangles; expected meshes with faces");
  return mesh;
}

/// The box of what the triangles use: a stray vertex is not part of the part.
Box3 used_box(const TriangleMesh& mesh) {
  Box3 box;
  for (const auto& t : mesh.triangles)
    for (const int v : t) box.add(mesh.vertices[static_cast<std::size_t>(v)]);
  return box;
}

/// A mesh as a part in millimetres, repaired, its regions as faces. Throws InputError.
Part read_mesh(const std::string& file, const PartFormat& format, std::string content,
               const std::optional<std::string>& unit) {
  TriangleMesh raw = parse_mesh(file, format, content);
  std::string().swap(content);  // a large file and all that follows need not be in memory together
  const Box3 box = used_box(raw);
  // Sizes in every unit help to tell which is right: only a person can know.
  if (!unit)
    throw InputError(
        fmt::format("{}: a mesh file has no unit; give `unit`: {}", file, sizes_by_unit(box.high - box.low)));
  Part part;
  part.file = file;
  part.format = format.name;
  part.unit = *unit;
  part.millimetres_per_unit = millimetres_per(*unit);
  // Before the repair: its tolerances and the messages are in millimetres.
  for (Vec3& v : raw.vertices) v *= part.millimetres_per_unit;
  part.box = used_box(raw);
  require_part_in_range(part);
  try {
    ReadMesh repaired = repair_read_mesh(std::move(raw), format.loose);
    part.mesh = std::move(repaired.mesh);
    part.repairs = std::move(repaired.repairs);
  } catch (const InputError& error) {
    throw InputError(file + ": " + error.what());
  }
  // After the repair: only then do triangles know their neighbours.
  part.mesh_faces = mesh_regions(part.mesh);
  part.surface_types.assign(part.mesh_faces.size(), "mesh");
  part.box = part.mesh.box();
  return part;
}

/// A unit that is wrong by 10, 25.4 or 1000 is the commonest fault of a file, and everything else looks right.
void note_doubtful_size(Part& part) {
  const double size = part.box.diagonal();
  if (size <= kLargestPartMm && size >= kSmallestPartMm) return;
  part.repairs.push_back(fmt::format("the part is {:.3g} mm across, {} {:g} mm: is its unit ({}) right?", size,
                                     size > kLargestPartMm ? "more than" : "less than",
                                     size > kLargestPartMm ? kLargestPartMm : kSmallestPartMm, part.unit));
}

}  // namespace

Part read_part(const std::string& file, const std::optional<std::string>& unit) {
  // A wrong unit is refused before a large file is read.
  if (unit) (void)millimetres_per(*unit);
  std::string content = read_bytes(file, accepted_part_files());
  // So that a result can tell later whether the file is still the same.
  std::string hash = sha256(content);
  // The header of a binary STL may hold any bytes.
  if (content.starts_with(kByteOrderMark) && !is_binary_stl(content)) content.erase(0, kByteOrderMark.size());
  const PartFormat& format = sniff_format(file, content);
  // CAD files go through a reader that can be replaced: in this process, or in a child that a damaged file may break.
  Part part = format.read != nullptr ? read_mesh(file, format, std::move(content), unit)
                                     : cad_reader()({file, std::string(format.name), unit, hash});
  part.sha256 = std::move(hash);
  require_part_in_range(part);
  note_doubtful_size(part);
  return part;
}

TriangleMesh extract_mesh(const Part& part, const std::vector<int>& faces) {
  TriangleMesh mesh;
  // New number of each vertex, in the order of first use: the same mesh whatever else the part holds.
  std::vector<int> number(part.mesh.vertices.size(), -1);
  for (const int face : faces) {
    for (const int t : part.mesh_faces[static_cast<std::size_t>(face)]) {
      std::array<int, 3> corners = part.mesh.triangles[static_cast<std::size_t>(t)];
      for (int& v : corners) {
        int& renumbered = number[static_cast<std::size_t>(v)];
        if (renumbered < 0) {
          renumbered = static_cast<int>(mesh.vertices.size());
          mesh.vertices.push_back(part.mesh.vertices[static_cast<std::size_t>(v)]);
        }
        v = renumbered;
      }
      mesh.triangles.push_back(corners);
    }
  }
  return mesh;
}

}  // namespace flank
