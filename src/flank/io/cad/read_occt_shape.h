/// A CAD file as an Open CASCADE shape. Private to io: no Open CASCADE type leaves this folder.
#pragma once

#include <TopoDS_Shape.hxx>
#include <optional>
#include <string>
#include <vector>

namespace flank::internal {

struct OcctShape {
  TopoDS_Shape shape;  ///< in millimetres
  std::string unit;    ///< the file's own: mm, cm, m, in, or its name where it is another
  double millimetres_per_unit = 1.0;
  std::vector<std::string> notes;  ///< what did not go as the file says, one sentence each
};

/// Loads STEP, IGES or BREP. A BREP file states no unit: millimetres unless `unit` says otherwise; STEP and IGES state
/// theirs and `unit` may only agree. Open CASCADE prints nothing meanwhile. Throws InputError.
[[nodiscard]] OcctShape load_occt_shape(const std::string& file, const std::string& format,
                                        const std::optional<std::string>& unit);

}  // namespace flank::internal
