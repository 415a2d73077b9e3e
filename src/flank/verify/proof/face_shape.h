/// A trimmed face as cells: rectangles of parameters, pieces of its border curves and of creases, and their ends.
#pragma once

#include <memory>

#include "flank/face.h"
#include "flank/verify/proof/shape.h"

namespace flank::internal::verify {

/// The face must outlive the shape.
[[nodiscard]] std::unique_ptr<Shape> make_shape(const Face& face);

}  // namespace flank::internal::verify
