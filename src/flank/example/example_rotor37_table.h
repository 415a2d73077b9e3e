/// The published coordinates of NASA Rotor 37, a transonic compressor rotor (NASA TP 1337 and later reports; the
/// numbers are in share/examples/rotor37*.csv). The rotor turns about the X axis.
#pragma once

#include <array>
#include <vector>

#include "flank/vec.h"

namespace flank::internal {

inline constexpr int kRotor37Sections = 13;   ///< from the hub to the shroud
inline constexpr int kRotor37Stations = 100;  ///< of each section, from the leading to the trailing edge

/// One station of a section: a point on each side, both at the same Z and R. At the first and the last station the two
/// points are one, to the last digit of the table.
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
