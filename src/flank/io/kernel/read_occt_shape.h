/// A CAD file as an Open CASCADE shape. Private to io: no Open CASCADE type leaves this folder and io/cad.
#pragma once

#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Shape.hxx>
#include <optional>
#include <string>
#include <vector>

#include "flank/io/kernel/occt_unread_faces.h"

namespace flank::internal {

// The kernel's map copies by what may throw, and says that it does not.
struct OcctShape {                   // NOLINT(bugprone-exception-escape)
  TopoDS_Shape shape;                ///< in millimetres
  TopTools_IndexedMapOfShape faces;  ///< of the shape, in their order
  FileFaces left;                    ///< what the kernel left of the faces of the file
  std::string unit;                  ///< the file's own: mm, cm, m, in, or its name where it is another
  double millimetres_per_unit = 1.0;
  std::vector<std::string> notes;  ///< what did not go as the file says, one sentence each
};

/// Loads STEP, IGES or BREP. `unit` is that of the numbers in the file: a BREP file states none and is in millimetres otherwise; where
/// a STEP or IGES file states another one, a note says so. Open CASCADE prints nothing meanwhile. Throws InputError.
[[nodiscard]] OcctShape load_occt_shape(const std::string& file, const std::string& format,
                                        const std::optional<std::string>& unit);

}  // namespace flank::internal
