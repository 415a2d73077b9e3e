/// Where the part sits on the table: from the frame of the part to that of the work.
#pragma once

#include <array>
#include <string>

#include "flank/path.h"
#include "flank/vec.h"

namespace flank::internal {

/// x_work = Rz(c) Ry(b) Rx(a) x_part + translation. Programs of a tool-centre control are in the turned frame of the part,
/// whose origin the work offset (G54) holds: the translation is typed into the control, the turn is how the part is clamped.
struct WorkSetup {
  Vec3 translation = Vec3::Zero();            ///< mm
  std::array<double, 3> angles_deg{0, 0, 0};  ///< a, b, c

  [[nodiscard]] Eigen::Matrix3d rotation() const;
  [[nodiscard]] Pose to_work(const Pose& part) const;
  [[nodiscard]] Pose to_part(const Pose& work) const;
};

/// "x,y,z,a,b,c" in mm and degrees, or "x,y,z". Throws UsageError about the field `setup`.
[[nodiscard]] WorkSetup parse_setup(const std::string& text);
/// As parse_setup reads it, to the digit.
[[nodiscard]] std::string setup_text(const WorkSetup& setup);

}  // namespace flank::internal
