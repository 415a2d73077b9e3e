/// Loose faces sewn together, to know on which side of them the material is. Private to io: no Open CASCADE type leaves
/// this folder.
#pragma once

#include <TopTools_IndexedMapOfShape.hxx>
#include <string>
#include <vector>

namespace flank::internal {

/// Largest gap that is sewn over, as a share of the box of all faces. Only sides come from the sewn faces, surfaces and
/// trims stay those of the file: a loose gap costs no accuracy, and files of whole blades leave some 1e-4.
inline constexpr double kSewingShare = 1e-3;
/// More faces are left loose: sewing takes about a millisecond for each.
inline constexpr int kMostSewnFaces = 20000;

struct SewnFaces {
  int solids = 0;              ///< shells that close
  std::vector<int> solid;      ///< of each face: which of them, 0-based, or -1
  std::vector<bool> reversed;  ///< of each face: as oriented in its solid or, in an open shell, like its neighbours
  std::vector<std::string> notes;
};

/// Sews the faces of the map, in millimetres, `size_mm` across, which must have been triangulated. The faces of a shell
/// that closes get the orientation that they have in its solid; those of an open one agree with one another along shared
/// borders, most of them as they stand. What fails leaves the faces as they stand, with a note; throws nothing.
[[nodiscard]] SewnFaces sew_loose_faces(const TopTools_IndexedMapOfShape& faces, double size_mm);

}  // namespace flank::internal
