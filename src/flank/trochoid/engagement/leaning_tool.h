/// What a tool covers of a ring that it leans against, a little or much.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "flank/trochoid/stock/near_poses.h"

namespace flank::internal {

/// A disc in the plane of a ring: its centre from the direction of motion, and its radius; not > 0: it is none.
struct RingDisc {
  Vec2 centre;
  double radius;
};

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
  /// Angles at which it is looked at, about `at`: so what is covered does not hang on what was asked for.
  struct Looks {
    double at, window;
    int count;
    [[nodiscard]] double step() const { return 2.0 * window / count; }
    [[nodiscard]] double angle(int k) const { return at + (k * step() - window); }
  };
  /// Calls visit(low, high) for what is covered of the window as far as it lies between two angles, or a look farther.
  template <class Visit>
  void visit_covered(const Looks& looks, double low, double high, const Visit& visit) const {
    const double from = low - looks.at + looks.window, to = high - looks.at + looks.window;
    if (to <= 0.0 || from >= 2.0 * looks.window) return;
    const int first = std::max(0, static_cast<int>(from / looks.step()));
    const int last = std::min(looks.count, static_cast<int>(to / looks.step()) + 1);
    double begin = looks.angle(first);
    bool before = covers(begin);
    for (int k = first + 1; k <= last; ++k) {
      const bool now = covers(looks.angle(k));
      if (now && !before) begin = edge(looks.angle(k), looks.angle(k - 1));
      if (!now && before) visit(begin, edge(looks.angle(k - 1), looks.angle(k)));
      before = now;
    }
    if (before) visit(begin, looks.angle(last));
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
