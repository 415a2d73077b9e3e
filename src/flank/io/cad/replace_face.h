/// Faces of a CAD part with other surfaces in their place, the rest of the part as it is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/face.h"
#include "flank/io/cad/new_surface.h"

namespace flank::internal {

/// The part with its new surfaces.
struct ReplacedFaces {
  std::vector<Face>
      faces;  ///< the new ones, trimmed, in the order of the request; ids are those of the file that is made
  std::vector<double>
      gap_mm;  ///< of each: largest distance of its borders, as the neighbours have them, from the new surface
  std::vector<double> moved_mm;  ///< of each: largest distance of its new borders from the old ones
  std::string step;              ///< the whole part, AP214, millimetres; empty where the faces cannot be replaced
  std::string why;               ///< why not: a sentence
};

/// Reads the file again, which must have been read before without complaint, and replaces its faces. Throws InputError where it cannot be read.
/// Faces with a seam, or with a border that is a point, are not replaced in the part; `faces` is empty then.
[[nodiscard]] ReplacedFaces replace_faces(const std::string& file, const std::string& format,
                                          const std::optional<std::string>& unit,
                                          const std::vector<NewSurface>& surfaces);

/// What the CAD kernel's checker says of a file.
struct CheckedSolids {
  int solids = 0;             ///< all of them
  int valid = 0;              ///< closed, without a fault, with a volume > 0
  bool shape_valid = false;   ///< no fault in any face, edge or vertex, of a solid or not
  double tolerance_mm = 0.0;  ///< largest that an edge needs
};
[[nodiscard]] CheckedSolids check_solids(const std::string& file, const std::string& format,
                                         const std::optional<std::string>& unit);

}  // namespace flank::internal
