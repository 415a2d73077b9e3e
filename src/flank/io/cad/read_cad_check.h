/// How truly a CAD file became values.
#pragma once

#include <string>
#include <vector>

namespace flank::internal {

/// The largest distance in mm between the file's surface and ours that is accepted as "the same", relative to the size
/// of the surface.
inline constexpr double kSurfaceConversionError = 1e-9;

/// How truly one face of a file became values: everything is compared with what the CAD kernel itself makes of the
/// file.
struct CadCheck {
  std::string face;
  double size_mm = 0.0;           ///< diagonal of the sampled surface
  double surface_error_mm = 0.0;  ///< largest distance between the two surfaces at the same parameters
  double edge_error_mm = 0.0;     ///< largest distance of our trims, on our surface, from the file's 3D edges
  double file_edge_gap_mm = 0.0;  ///< the same distance for the file's own trims: what the file itself leaves open
  int outward_samples = 0;        ///< points of the face, stepped off along the outward normal, that were looked at ...
  int outward_wrong = 0;          ///< ... and that came out inside the solid
};

/// Reads the file anew and compares every face with its conversion. For tests and for doubts about a file.
[[nodiscard]] std::vector<CadCheck> check_cad(const std::string& file, const std::string& format);

}  // namespace flank::internal
