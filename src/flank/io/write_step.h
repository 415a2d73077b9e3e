/// Writing faces as a STEP file (AP214, millimetres).
#pragma once

#include <string>
#include <vector>

#include "flank/geom/face.h"

namespace flank {

/// Writes the faces as sheets, in order. Throws InputError if the file cannot be written; nothing half-written is left.
void write_step(const std::string& file, const std::vector<Face>& faces);

}  // namespace flank
