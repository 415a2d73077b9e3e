/// The formats of parts, a row each: whatever has to know which there are asks here.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "flank/triangle_mesh.h"

namespace flank::internal {

/// A format of CAD files, which the kernel reads by `name`, or one of meshes, which has a reader of its own.
struct PartFormat {
  std::string_view name;                    ///< "PLY"
  std::vector<std::string_view> endings;    ///< of file names, in lower case: ".ply"
  bool (*looks)(std::string_view content);  ///< whether the content has the format's marks
  /// Of what was cut off a file that looks like one, in words: "the closing line ... is missing"; empty: nothing, or not known.
  std::string_view (*lost_end)(std::string_view content) = nullptr;
  /// The triangles in the file's own unit, nothing merged or repaired; null: a CAD file. Throws InputError.
  TriangleMesh (*read)(const std::string& file, std::string_view content) = nullptr;
  bool loose = false;     ///< of meshes: every triangle has corners of its own, to be joined
  bool markless = false;  ///< some files have no mark: the name is believed, and the reader says what is wrong
};

/// In the order in which messages name them, which is that in which a content is tried: those whose marks can be chance are
/// behind those whose marks cannot.
[[nodiscard]] std::span<const PartFormat> part_format_rows();

/// By its ending: a file of a mesh, which says nothing of its unit.
[[nodiscard]] bool is_mesh_file(const std::string& file);

/// "STEP (.step .stp .p21), IGES (.iges .igs), ... or PLY (.ply)".
[[nodiscard]] std::string accepted_part_files();

/// The format of a file, by content; its name only has to agree. Throws InputError when the content is none of these, when
/// the extension is not one that is read, when the two disagree, and when the end of a file is missing (a truncated copy).
[[nodiscard]] const PartFormat& sniff_format(const std::string& file, std::string_view content);

}  // namespace flank::internal
