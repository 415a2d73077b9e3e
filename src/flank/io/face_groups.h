/// Faces told apart into pieces, and faces that belong together.
#pragma once

#include <string>
#include <vector>

#include "flank/part.h"

namespace flank::internal {

/// A piece of a face under its own name.
struct NamedPiece {
  Face face;          ///< with the id F1a
  bool edge = false;  ///< else a side
};

/// The pieces that a face of a CAD part is told apart into; empty if it is not, or is one already.
[[nodiscard]] std::vector<NamedPiece> pieces_of_face(const Part& part, int face);

/// Replaces each face that `list` names and that goes all round an aerofoil by its pieces. Throws InputError as parse_face_list does.
void split_two_sided(Part& part, const std::string& list);

}  // namespace flank::internal
