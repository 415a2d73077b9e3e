/// What the faces of a wheel are: hub, blades, splitters, their sides, edges, tips and root fillets (docs/wheel.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "flank/feature/wheel_axis.h"
#include "flank/part.h"

namespace flank::internal {

/// Roles that the user gives; what is not given is found. Lists of faces as in parse_face_list.
struct WheelChoice {
  std::optional<std::string> hub;
  std::vector<std::string> blades, splitters;  ///< one list a blade
  std::optional<int> count;                    ///< of equal sectors
};

struct RootFillet {
  std::string face;
  double radius_mm = 0.0;              ///< median over the face
  double low_mm = 0.0, high_mm = 0.0;  ///< between a tenth and nine tenths of it
  [[nodiscard]] bool constant() const { return high_mm < 1.1 * low_mm; }
};

/// One blade. Sides: `ahead` looks the way that a right-handed turn about the axis goes, `behind` the other way.
struct WheelBlade {
  bool splitter = false;
  double angle_deg = 0.0;  ///< of its middle about the axis, from 0 to 360
  double area_mm2 = 0.0, height_mm = 0.0, thickness_mm = 0.0;
  std::vector<std::string> ahead, behind, edges, tips;
  std::vector<RootFillet> fillets;
  std::vector<std::string> buried;  ///< inside the hub's material, or below it

  /// One face goes all round the blade, and is both of its sides.
  [[nodiscard]] bool round() const { return !ahead.empty() && ahead == behind; }
  [[nodiscard]] std::vector<std::string> sides() const;
  /// Sides, edges and fillets: what is flow surface of a blade.
  [[nodiscard]] std::vector<std::string> flow() const;
  /// Its tips and what is buried, too.
  [[nodiscard]] std::vector<std::string> all() const;
};

struct WheelRoles {
  std::string file, part_sha256;
  WheelAxis axis;
  int count = 0;       ///< equal sectors in a whole turn
  bool whole = false;  ///< the part has all of them
  std::vector<std::string> hub;
  std::vector<std::string> shroud;  ///< faces over the tips; empty: an open wheel
  std::vector<WheelBlade> blades;   ///< main blades and splitters, by their angle
  std::vector<std::string> rest;    ///< not milled here: bore, back, chamfers
  std::vector<std::string>
      debris;  ///< of `rest`: solids that are no part of the wheel, small ones beside it and covers over it
  std::vector<Vec2> outline;  ///< along the axis and radius, mm: over the tips of the main blades
  [[nodiscard]] int mains() const;
  [[nodiscard]] int splitters() const { return static_cast<int>(blades.size()) - mains(); }
};

}  // namespace flank::internal
