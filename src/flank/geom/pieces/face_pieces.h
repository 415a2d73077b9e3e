/// A face that wraps round an edge, as the skin of an aerofoil does, told apart into its sides and its edges.
#pragma once

#include <vector>

#include "flank/face.h"

namespace flank::internal {

struct FacePiece {
  Face face;          ///< without an id of its own: that of the whole face
  bool edge = false;  ///< else a side
};

/// The sides, then the edges, each in the order of the parameters; empty for a face that is not to be told apart. Cuts run
/// along parameter lines. A closed surface is cut at its edges and not at its seam. Together the pieces are the face.
[[nodiscard]] std::vector<FacePiece> face_pieces(const Face& face);

/// Whether a face with these pieces has sides that face away from each other, as an aerofoil's do: its sections come back to where they
/// began, or nearly. The lobe of a rotor, whose roots are edges by their bend, does not go all round.
[[nodiscard]] bool goes_all_round(const Face& face, const std::vector<FacePiece>& pieces);

}  // namespace flank::internal
