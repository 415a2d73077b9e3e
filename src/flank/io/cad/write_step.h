/// Writing faces as a STEP file (AP214, millimetres).
#pragma once

#include <string>
#include <vector>

#include "flank/face.h"

namespace flank::internal {

/// Sheets that another program shows as one object of this name.
struct NamedFaces {
  std::string name;
  std::vector<Face> faces;
};

/// The text of a file of these objects, in order. The same faces give the same bytes. `title` stands in the file's
/// header.
[[nodiscard]] std::string faces_to_step(const std::string& title, const std::vector<NamedFaces>& objects);

/// Writes the faces as sheets, in order. Throws InputError if the file cannot be written; nothing half-written is left.
void write_step(const std::string& file, const std::vector<Face>& faces);

}  // namespace flank::internal
