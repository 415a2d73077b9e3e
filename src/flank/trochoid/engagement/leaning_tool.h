/// What a tool covers of a ring that it leans against.
#pragma once

#include <cmath>
#include <numbers>

#include "flank/trochoid/engagement/tool_profile.h"

namespace flank::internal {

/// A tool that leans against the axis of a ring, in the plane of the ring. What it covers there is not quite a circle, and near
/// its round ends not at all one.
struct LeaningTool {
  const ToolProfile& profile;
  double ring;      ///< radius, mm
  Vec2 foot, lean;  ///< where its axis meets the plane, and the part of its direction in the plane
  double height;    ///< its own, there
  double reach2;    ///< nothing is covered farther from the foot, mm^2
  [[nodiscard]] bool covers(double angle) const {
    const Vec2 from = Vec2(ring * std::cos(angle), ring * std::sin(angle)) - foot;
    if (from.squaredNorm() > reach2) return false;
    const double along = lean.dot(from);
    ToolProfile::Place place;
    return profile.at(height + along, place) && from.squaredNorm() - along * along <= place.radius * place.radius;
  }
  /// Half of the least arc about the foot's direction that holds all that may be covered; negative: nothing is.
  [[nodiscard]] double window() const {
    const double middle = height - lean.dot(foot), swing = ring * lean.norm();
    if (middle + swing < profile.low() || middle - swing > profile.high()) return -1.0;
    const double d = foot.norm(), reach = std::sqrt(reach2);
    if (d >= ring + reach || ring >= reach + d) return -1.0;
    return reach >= ring + d ? std::numbers::pi : std::acos((ring * ring + d * d - reach * reach) / (2.0 * ring * d));
  }
  /// Between an angle that is covered and one that is not: how far it is.
  [[nodiscard]] double edge(double inside, double outside) const {
    constexpr int kHalvings = 3;  // the ends of arcs are found exactly afterwards
    for (int k = 0; k < kHalvings; ++k) {
      const double middle = 0.5 * (inside + outside);
      (covers(middle) ? inside : outside) = middle;
    }
    return inside;
  }
};

}  // namespace flank::internal
