/// The published coordinates of NASA Rotor 37 (NASA TP 1337 and later reports; share/examples/rotor37*.csv), a transonic
/// compressor rotor. They are the metal when cold; the rotor turns about the X axis.
#pragma once

#include <array>
#include <vector>

#include "flank/vec.h"

namespace flank::internal {

inline constexpr int kRotor37Sections = 13;   ///< from the hub to the shroud
inline constexpr int kRotor37Stations = 100;  ///< of each section, from the leading to the trailing edge

/// One station of a section: a point of each side, at the same Z and R. Angles about the axis. At the first and the last
/// station the two points are one.
struct Rotor37Station {
  double z_mm = 0.0, radius_mm = 0.0;
  std::array<double, 2> theta_rad{};  ///< of side 1 and side 2

  /// (Z, R cos theta, R sin theta) of side 0 or 1.
  [[nodiscard]] Vec3 point(int side) const;
};

/// One section, the stations in their order.
using Rotor37Section = std::vector<Rotor37Station>;

/// Section 0 runs along the hub, section kRotor37Sections - 1 along the shroud.
[[nodiscard]] Rotor37Section rotor37_section(int section);

/// The hub's outline (x, radius), mm, x rising.
[[nodiscard]] std::vector<Vec2> rotor37_hub();

}  // namespace flank::internal
