/// Tools inside the material. What is there from the beginning of a strip, and stays, enters no surface: no depth of a cut
/// shows it, and it may even touch the target, from within.
#pragma once

#include <span>
#include <vector>

#include "flank/judge.h"
#include "flank/path.h"
#include "flank/tool.h"
#include "flank/triangle_mesh.h"

namespace flank::internal::verify {

/// The strips that begin with the middle of their axis in a closed solid. One place decides: a tool that gets out, or in,
/// on its way enters a face there, which its depth shows, if all faces of the solid are judged.
[[nodiscard]] std::vector<BuriedStrip> strips_in_solids(std::span<const TriangleMesh> solids, const Tool& tool,
                                                        const Path& path);

/// On which side of a sheet, by its samples' normals, a strip runs where it is within a distance of the sheet.
struct SideVotes {
  int in_front = 0, behind = 0;  ///< places
  int from_behind = 0;        ///< those of `behind` that the tool touches along their normal, and not from beside a rim
  Vec3 point = Vec3::Zero();  ///< the one that the strip is nearest to
};
struct SheetVotes {
  std::vector<SideVotes> strips;
  int asked = 0;           ///< places of the sheet, near to a strip or not
  double place_mm2 = 0.0;  ///< of the sheet for each of them
  /// +1 if more places are in front than behind, or as many; else -1.
  [[nodiscard]] int side() const;
};
/// Of all strips of a path, whose swept volume this is, at some of the sheet's samples.
[[nodiscard]] SheetVotes side_votes(const SweptVolume& volume, const Path& path, const FaceSamples& sheet,
                                    double within_mm);

/// The strips that machine a sheet from behind. `votes` are those within the tolerance, of each sheet.
[[nodiscard]] std::vector<BuriedStrip> strips_behind(std::span<const SheetVotes> votes);

}  // namespace flank::internal::verify
