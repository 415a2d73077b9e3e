/// A face of a part, which it keeps alive.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "flank/part.h"

namespace flank::python {

struct PartFace {
  std::shared_ptr<const Part> part;
  int index = 0;
  /// Of a part that is no mesh.
  [[nodiscard]] const Face& face() const { return part->faces[static_cast<std::size_t>(index)]; }
  [[nodiscard]] std::string id() const { return part->face_id(index); }
};

void bind_part_face(pybind11::module_& module);

}  // namespace flank::python
