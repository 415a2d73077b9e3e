/// Open CASCADE shapes as the text of a STEP file. Private to io: no Open CASCADE type leaves this folder.
#pragma once

#include <TopoDS_Shape.hxx>
#include <string>
#include <vector>

namespace flank::internal {

/// What another program shows as one object.
struct OcctProduct {
  std::string name;
  TopoDS_Shape shape;  ///< millimetres
};

/// AP214, millimetres, every product under its name. The same shapes give the same bytes. Throws InternalError, naming
/// `title`, for shapes that have no form in STEP. To be called while an OcctSilence lives.
[[nodiscard]] std::string step_text(const std::string& title, const std::vector<OcctProduct>& products);

}  // namespace flank::internal
